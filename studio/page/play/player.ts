// Plays the melody of the work by the clock of the audio device; without a device, plays silently.
import type { Studio } from "../context";
import { MidiOutput, type MidiPort } from "../sound/midi_output";
import type { Melody } from "../sound/melody";
import { firstFrom } from "../sound/melody";
import { Renderer } from "../sound/renderer";
import { isHeard, SoundOutput, type VoiceSettings } from "../sound/sound_output";
import { timbreNamed, timbreOf } from "../sound/timbres";
import { Timer } from "../sound/timer";
import type { NoteSink } from "../sound/transport";
import { Transport } from "../sound/transport";

const interval = 25; // milliseconds between scheduling notes
const most_prepared = 60; // keys rendered before the first note
const audition_notes = 5;
const prepare_seconds = 1.5; // longest wait of the first note for them

export interface Voice extends VoiceSettings {
    name: string;
    chosen: string; // a timbre; empty: that of the part's instrument
}

export class Player {
    readonly transport: Transport;
    melody: Melody | null = null;
    voices: Voice[] = [];
    volume = 0.8;
    onChange: () => void = () => {}; // called when playback or voices change
    isStarting = false;

    private context: AudioContext | null = null;
    private output: SoundOutput | null = null;
    private renderer: Renderer | null = null;
    private midi: MidiOutput | null = null;
    private isSilent = false; // only MIDI plays
    private readonly timer = new Timer(() => this.tick());
    private lastPrepared = 0;
    private wallOffset = Infinity; // from the page's clock to the sound's, milliseconds

    constructor(private readonly studio: Studio) {
        const each = (act: (sink: NoteSink) => void): void => {
            if (this.output && !this.isSilent) act(this.output);
            if (this.midi) act(this.midi);
        };
        this.transport = new Transport(
            () => this.now(),
            [
                {
                    note: (index, time, seconds) => each((sink) => sink.note(index, time, seconds)),
                    cancel: (time) => each((sink) => sink.cancel(time)),
                    silence: () => each((sink) => sink.silence()),
                    started: (tick, time) => this.midi?.started(tick, time),
                    stopped: (time) => this.midi?.stopped(time),
                    clock: (time) => this.midi?.clock(time),
                },
            ],
        );
        this.transport.onEnd = () => {
            this.timer.stop();
            this.onChange();
        };
    }

    private now(): number {
        return this.context ? this.context.currentTime : performance.now() / 1000;
    }

    /// The time of the sound being heard now.
    heard(): number {
        const { context } = this;
        if (!context) return this.now();
        const plain = context.currentTime - Math.min(0.5, context.outputLatency || context.baseLatency || 0);
        const stamp = context.getOutputTimestamp?.();
        if (!stamp?.contextTime || !stamp.performanceTime) return plain;
        // Between two blocks of the device, the clock of the page fills in.
        const smooth = stamp.contextTime + (performance.now() - stamp.performanceTime) / 1000;
        return Math.abs(smooth - plain) < 0.12 ? smooth : plain;
    }

    /// The position in the music that the listener hears now.
    place(): number {
        return this.transport.tickAt(this.heard());
    }

    setMelody(melody: Melody | null): void {
        this.melody = melody;
        if (this.output) this.output.melody = melody;
        if (this.midi) this.midi.melody = melody;
        this.nameVoices();
        this.transport.setMelody(melody);
        if (this.transport.playing) this.prepareAhead(true);
        this.onChange();
    }

    private nameVoices(): void {
        const { melody } = this;
        if (!melody) return;
        const old = this.voices;
        this.voices = Array.from({ length: melody.voices }, (_, index) => {
            const part = melody.parts[melody.partOfVoice[index]];
            const before = old[index];
            const name = melody.parts.length > 1 && part ? `${part.name}, ${index + 1}` : `Voice ${index + 1}`;
            return {
                name,
                chosen: before?.chosen ?? "",
                timbre: before?.chosen || this.instrumentOf(index),
                volume: before?.volume ?? 0.8,
                muted: before?.muted ?? false,
                solo: before?.solo ?? false,
            };
        });
        this.applyVoices();
    }

    instrumentOf(voice: number): string {
        const part = this.melody?.parts[this.melody.partOfVoice[voice]];
        return part?.drums ? "drums" : timbreOf(part?.program ?? 0).name;
    }

    change(voice: number, change: Partial<Voice>): void {
        Object.assign(this.voices[voice], change);
        this.voices[voice].timbre = this.voices[voice].chosen || this.instrumentOf(voice);
        this.applyVoices();
        if ("chosen" in change) {
            if (this.transport.playing) void this.prepareAhead(true);
            else void this.audition(voice);
        }
        this.onChange();
    }

    /// Plays a few notes of a voice in its timbre.
    private async audition(voice: number): Promise<void> {
        const { melody } = this;
        this.open();
        const { context, renderer, output } = this;
        if (!melody || !context || !renderer || !output) return;
        const keys: number[] = [];
        for (let i = firstFrom(melody, this.place()); i < melody.count && keys.length < audition_notes; ++i) {
            if (melody.voice[i] === voice) keys.push(melody.key[i]);
        }
        const timbre = timbreNamed(this.voices[voice].timbre);
        await context.resume();
        await renderer.prepare(keys.map((key) => [timbre, key] as const));
        if (this.transport.playing || timbre.name !== this.voices[voice].timbre) return;
        output.silence();
        const seconds = timbre.attack > 0.1 ? 0.5 : 0.22;
        keys.forEach((key, i) => output.strike(voice, key, 90, context.currentTime + 0.05 + i * seconds, seconds));
    }

    isHeard(voice: number): boolean {
        return isHeard(this.voices, voice);
    }

    private applyVoices(): void {
        this.output?.setVoices(this.voices);
        this.midi?.setVoices(
            this.voices.map((voice, index) => ({
                program: this.melody?.parts[this.melody.partOfVoice[index]]?.program ?? 0,
                isDrums: voice.timbre === "drums",
                isHeard: this.isHeard(index),
                volume: voice.volume,
            })),
        );
    }

    setVolume(volume: number): void {
        this.volume = volume;
        this.output?.master.setVolume(volume);
    }

    /// Sends notes to a port, in addition to the sound or instead of it.
    setMidi(port: MidiPort | null, isAlone: boolean, sendsClock: boolean): void {
        const wasPlaying = this.transport.playing;
        if (wasPlaying) this.transport.pause();
        this.isSilent = port !== null && isAlone;
        this.midi = port && new MidiOutput(port, (time) => this.wallTime(time));
        if (this.midi) {
            this.midi.melody = this.melody;
            this.midi.sendsClock = sendsClock;
            this.applyVoices();
        }
        if (wasPlaying) this.transport.play();
    }

    /// Milliseconds of the page's clock at which a time of the sound is heard. The two clocks are compared repeatedly
    /// and averaged, because a single comparison can be off by a block of the device.
    private wallTime(time: number): number {
        const offset = performance.now() - this.heard() * 1000;
        const isNear = Math.abs(offset - this.wallOffset) < 40;
        this.wallOffset = isNear ? this.wallOffset + 0.02 * (offset - this.wallOffset) : offset;
        return time * 1000 + this.wallOffset;
    }

    private open(): void {
        if (this.context || typeof AudioContext === "undefined") return;
        try {
            const context = new AudioContext({ latencyHint: "interactive" });
            this.renderer = new Renderer(context);
            this.output = new SoundOutput(context, this.renderer);
            this.output.melody = this.melody;
            this.output.master.setVolume(this.volume);
            this.context = context;
            this.applyVoices();
        } catch {
            this.context = null;
            this.studio.say("This browser cannot play sound; the curve plays silently.", "warning");
        }
    }

    async toggle(): Promise<void> {
        if (this.transport.playing) this.pause();
        else await this.play();
    }

    async play(): Promise<void> {
        if (!this.melody || this.melody.count === 0 || this.isStarting || this.transport.playing) return;
        this.isStarting = true;
        this.onChange();
        this.open();
        const patience = (seconds: number) => new Promise<void>((done) => setTimeout(done, seconds * 1000));
        if (this.context && this.context.state !== "running") {
            await Promise.race([this.context.resume().catch(() => {}), patience(1)]);
            if ((this.context.state as string) !== "running") this.loseSound();
        }
        await Promise.race([this.prepareAhead(true), patience(prepare_seconds)]);
        this.isStarting = false;
        this.transport.play();
        this.timer.start(interval);
        this.onChange();
    }

    private loseSound(): void {
        void this.context?.close().catch(() => {});
        this.renderer?.close();
        this.context = this.output = this.renderer = null;
        this.studio.say("The browser could not open a sound device; the curve plays silently.", "warning");
    }

    pause(): void {
        this.transport.pause();
        this.timer.stop();
        this.onChange();
    }

    stop(): void {
        this.pause();
        this.transport.seek(this.transport.loop?.from ?? 0);
        this.onChange();
    }

    seek(tick: number): void {
        this.transport.seek(tick);
        this.prepareAhead(true);
        this.onChange();
    }

    private tick(): void {
        this.transport.schedule();
        this.prepareAhead(false);
    }

    /// Renders the notes of the next seconds.
    private prepareAhead(isUrgent: boolean): Promise<void> {
        const { melody, renderer } = this;
        const now = performance.now();
        if (!melody || !renderer || (!isUrgent && now - this.lastPrepared < 500)) return Promise.resolve();
        this.lastPrepared = now;
        const wanted = new Map<string, [ReturnType<typeof timbreNamed>, number]>();
        const from = this.transport.tickAt(this.now());
        const until = this.transport.tickAfter(from, 8);
        for (let i = firstFrom(melody, from); i < melody.count && melody.onset[i] < until; ++i) {
            const timbre = timbreNamed(this.voices[melody.voice[i]]?.timbre ?? "piano");
            wanted.set(`${timbre.name} ${Math.round(melody.key[i])}`, [timbre, melody.key[i]]);
            if (wanted.size >= most_prepared) break;
        }
        return renderer.prepare(wanted.values());
    }
}
