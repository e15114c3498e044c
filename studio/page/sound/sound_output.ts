// Plays notes: a rendered sample through a filter, an envelope, the channel strip of its voice and the master.
import { Master } from "./master";
import type { Melody } from "./melody";
import { slideOf } from "./melody";
import type { Voiced } from "./renderer";
import { keyFrequency } from "./sample";
import type { Timbre } from "./timbres";
import { timbreNamed } from "./timbres";
import type { NoteSink } from "./transport";

/// The channel strip of a voice.
export interface VoiceSettings {
    timbre: string;
    volume: number;
    muted: boolean;
    solo: boolean;
}

/// False for a voice that is muted, or not among those that play alone.
export function isHeard(voices: readonly VoiceSettings[], index: number): boolean {
    const voice = voices[index];
    return voice !== undefined && !voice.muted && (voice.solo || !voices.some((each) => each.solo));
}

/// Source of buffers: Renderer, or a substitute in tests.
export interface Buffers {
    find(timbre: Timbre, key: number): Voiced | null;
}

interface Strip {
    gain: GainNode;
    pan: StereoPannerNode;
    send: GainNode;
}
interface Sounding {
    source: AudioBufferSourceNode;
    envelope: GainNode;
    vibrato: OscillatorNode | null;
    begin: number;
    end: number;
}

const most_sounding = 96;

export class SoundOutput implements NoteSink {
    readonly master: Master;
    melody: Melody | null = null;
    private voices: VoiceSettings[] = [];
    private strips: Strip[] = [];
    private sounding: Sounding[] = [];

    constructor(
        readonly context: BaseAudioContext,
        private readonly buffers: Buffers,
    ) {
        this.master = new Master(context);
    }

    setVoices(voices: VoiceSettings[]): void {
        this.voices = voices;
        while (this.strips.length < voices.length) this.addStrip();
        this.strips.forEach((strip, index) => {
            const voice = voices[index];
            const now = this.context.currentTime;
            const level = voice && isHeard(voices, index) ? voice.volume * voice.volume * 1.25 : 0;
            strip.gain.gain.setTargetAtTime(level, now, 0.012);
            strip.send.gain.setTargetAtTime(timbreNamed(voice?.timbre ?? "").reverb, now, 0.012);
            // Voices are spread to the left and right, the first in the middle.
            const place =
                voices.length < 2
                    ? 0
                    : (index % 2 === 0 ? 1 : -1)
                      * 0.5
                      * Math.min(1, Math.ceil(index / 2) / Math.max(1, (voices.length - 1) / 2));
            strip.pan.pan.setTargetAtTime(place, now, 0.02);
        });
    }

    private addStrip(): void {
        const gain = this.context.createGain();
        gain.gain.value = 0;
        const pan = this.context.createStereoPanner();
        const send = this.context.createGain();
        send.gain.value = 0.2;
        gain.connect(pan);
        pan.connect(this.master.dry);
        pan.connect(send).connect(this.master.wet);
        this.strips.push({ gain, pan, send });
    }

    note(index: number, time: number, seconds: number): void {
        const melody = this.melody;
        if (!melody) return;
        const voice = melody.voice[index];
        if (!isHeard(this.voices, voice)) return;
        const slide = slideOf(melody, index, seconds);
        this.strike(voice, melody.key[index], melody.velocity[index], time, seconds, slide);
    }

    strike(
        voice: number,
        key: number,
        velocity: number,
        time: number,
        seconds: number,
        slide = { semitones: 0, seconds: 0 },
    ): void {
        const timbre = timbreNamed(this.voices[voice].timbre);
        const voiced = this.buffers.find(timbre, key);
        if (!voiced) return;
        const { context } = this;
        const begin = Math.max(time, context.currentTime);
        const frequency = keyFrequency(key);
        const rate = voiced.frequency > 0 ? frequency / voiced.frequency : 1;
        const source = context.createBufferSource();
        source.buffer = voiced.buffer;
        source.loop = voiced.loops;
        source.playbackRate.value = rate;

        // Loud notes are brighter.
        const force = Math.min(1, velocity / 127);
        const filter = context.createBiquadFilter();
        filter.type = "lowpass";
        filter.Q.value = -3;
        const [dark, bright] = timbre.brightness;
        const cutoff = frequency * (dark + (bright - dark) * force ** 1.5);
        filter.frequency.value = Math.min(0.45 * context.sampleRate, Math.max(300 + 1500 * force, cutoff));

        const level = (timbre.trim ?? 1) * (velocity / 100) ** 1.3;
        const envelope = context.createGain();
        const attack = Math.min(timbre.attack, 0.7 * seconds);
        const end = begin + seconds;
        const tau = timbre.release / 5;
        envelope.gain.setValueAtTime(0, begin);
        envelope.gain.linearRampToValueAtTime(level, begin + attack);
        envelope.gain.setTargetAtTime(0, end, tau);
        if (slide.semitones !== 0) {
            source.playbackRate.setValueAtTime(rate, Math.max(begin, end - slide.seconds));
            source.playbackRate.exponentialRampToValueAtTime(rate * 2 ** (slide.semitones / 12), end);
        }
        source.connect(filter).connect(envelope).connect(this.strips[voice].gain);

        const vibrato = this.vibrato(timbre, source, begin, seconds, rate);
        const last = end + 9 * tau;
        // Loops begin at random positions, so that notes of one key are not identical.
        source.start(begin, voiced.loops ? ((begin * 7.31) % 1) * voiced.buffer.duration : 0);
        source.stop(last);
        vibrato?.stop(last);
        const sounding: Sounding = { source, envelope, vibrato, begin, end: last };
        this.sounding.push(sounding);
        source.onended = () => {
            envelope.disconnect();
            const at = this.sounding.indexOf(sounding);
            if (at >= 0) this.sounding.splice(at, 1);
        };
        if (this.sounding.length > most_sounding) {
            // Offline, all notes are sent before the first one ends.
            this.sounding = this.sounding.filter((each) => each.end > begin);
        }
        if (this.sounding.length > most_sounding) this.fade(this.sounding.shift()!, begin, 0.01);
    }

    private vibrato(
        timbre: Timbre,
        source: AudioBufferSourceNode,
        begin: number,
        seconds: number,
        rate: number,
    ): OscillatorNode | null {
        if (!timbre.vibrato || seconds < timbre.vibrato.delay + 0.15) return null;
        const { hertz, cents, delay } = timbre.vibrato;
        const oscillator = this.context.createOscillator();
        oscillator.frequency.value = hertz;
        const depth = this.context.createGain();
        depth.gain.value = 0;
        depth.gain.setValueAtTime(0, begin + delay);
        depth.gain.linearRampToValueAtTime(rate * (2 ** (cents / 1200) - 1), begin + delay + 0.4);
        oscillator.connect(depth).connect(source.playbackRate);
        oscillator.start(begin);
        return oscillator;
    }

    private fade(sounding: Sounding, time: number, tau: number): void {
        const { gain } = sounding.envelope;
        if (gain.cancelAndHoldAtTime) {
            gain.cancelAndHoldAtTime(time); // also works during an attack
        } else {
            const now = gain.value;
            gain.cancelScheduledValues(time);
            gain.setValueAtTime(now, time);
        }
        gain.setTargetAtTime(0, time, tau);
        sounding.source.stop(time + 9 * tau);
        sounding.vibrato?.stop(time + 9 * tau);
    }

    cancel(time: number): void {
        this.sounding = this.sounding.filter((each) => {
            if (each.begin <= time) return true;
            each.envelope.disconnect();
            each.source.stop();
            each.vibrato?.stop();
            return false;
        });
    }

    silence(): void {
        const now = this.context.currentTime;
        this.cancel(now);
        for (const each of this.sounding) this.fade(each, now, 0.018);
        this.sounding = [];
    }
}
