// Sends notes, clock, start and stop to connected MIDI instruments.
import type { Melody } from "./melody";
import { slideOf } from "./melody";
import type { NoteSink } from "./transport";

export interface MidiPort {
    send(bytes: number[], time?: number): void;
    clear?(): void;
}

const bend_range = 2; // semitones up and down: the default of instruments
const wide_range = 24; // of melodies with notes that slide
const slide_cents = 3; // widest step of a slide
const slide_seconds = 0.004; // shortest
const percussion = 9;

/// The channel of a voice. Voices have separate channels for their pitch bends, and avoid the channel of drums.
export function channelOf(voice: number, isDrums: boolean): number {
    if (isDrums) return percussion;
    const channel = voice % 15;
    return channel < percussion ? channel : channel + 1;
}

/// The nearest key, and the pitch bend from it.
export function bentKey(key: number, range = bend_range): { key: number; bend: number } {
    const whole = Math.min(127, Math.max(0, Math.round(key)));
    return { key: whole, bend: bendOf(key - whole, range) };
}

function bendOf(semitones: number, range: number): number {
    return Math.min(16383, Math.max(0, Math.round(8192 + (semitones / range) * 8192)));
}

/// The song position of MIDI: sixteenth notes from the beginning.
export function songPosition(tick: number, ticks: number): number[] {
    const sixteenths = Math.min(16383, Math.round((4 * tick) / ticks));
    return [0xf2, sixteenths & 127, sixteenths >> 7];
}

export interface MidiVoice {
    program: number;
    isDrums: boolean;
    isHeard: boolean;
    volume: number;
}

export class MidiOutput implements NoteSink {
    melody: Melody | null = null;
    sendsClock = true;
    private voices: MidiVoice[] = [];
    private bends = new Map<number, number>(); // by channel
    private on: { channel: number; key: number; begin: number; end: number }[] = [];

    /// `wallTime`: milliseconds of the browser's clock for a time of the sound's clock.
    constructor(
        readonly port: MidiPort,
        private readonly wallTime: (time: number) => number,
    ) {}

    setVoices(voices: MidiVoice[]): void {
        this.voices = voices;
        this.sendSettings();
    }

    private sendSettings(): void {
        this.voices.forEach((voice, index) => {
            const channel = channelOf(index, voice.isDrums);
            if (!voice.isDrums) this.port.send([0xc0 | channel, voice.program & 127]);
            if (!voice.isDrums && this.range() !== bend_range) {
                for (const [controller, value] of [[101, 0], [100, 0], [6, this.range()], [38, 0], [101, 127], [100, 127]]) {
                    this.port.send([0xb0 | channel, controller, value]);
                }
            }
            this.port.send([0xb0 | channel, 7, Math.round(127 * Math.min(1, Math.max(0, voice.volume)))]);
        });
    }

    /// Semitones of a full bend.
    private range(): number {
        return this.melody && this.melody.glides.size > 0 ? wide_range : bend_range;
    }

    started(tick: number, time: number): void {
        const at = this.wallTime(time);
        this.bends.clear();
        this.sendSettings();
        if (!this.sendsClock || !this.melody) return;
        if (tick < 1) {
            this.port.send([0xfa], at);
        } else {
            this.port.send(songPosition(tick, this.melody.ticks), at - 1);
            this.port.send([0xfb], at);
        }
    }

    stopped(time: number): void {
        this.port.clear?.();
        this.allOff();
        if (this.sendsClock) this.port.send([0xfc], Math.max(this.wallTime(time), performance.now()));
    }

    clock(time: number): void {
        if (this.sendsClock) this.port.send([0xf8], this.wallTime(time));
    }

    note(index: number, time: number, seconds: number): void {
        const melody = this.melody;
        const voice = melody ? this.voices[melody.voice[index]] : undefined;
        if (!melody || !voice?.isHeard) return;
        const channel = channelOf(melody.voice[index], voice.isDrums);
        const { key, bend } = bentKey(melody.key[index], this.range());
        const at = this.wallTime(time);
        const off = this.wallTime(time + Math.max(0.01, seconds - 0.004));
        const velocity = Math.max(1, Math.min(127, melody.velocity[index]));
        this.bend(channel, bend, at);
        this.port.send([0x90 | channel, key, velocity], at);
        const last = voice.isDrums ? key : this.slide(index, channel, key, velocity, time, seconds);
        this.port.send([0x80 | channel, last, 64], off);
        this.on = this.on.filter((each) => each.end > at - 2000);
        this.on.push({ channel, key: last, begin: at, end: off });
    }

    private bend(channel: number, bend: number, at: number): void {
        if ((this.bends.get(channel) ?? 8192) === bend) return;
        this.bends.set(channel, bend);
        this.port.send([0xe0 | channel, bend & 127, bend >> 7], at);
    }

    /// Bends a note while it slides; a key that is too far away is struck anew. Returns the key that sounds at the end.
    private slide(index: number, channel: number, key: number, velocity: number, time: number, seconds: number): number {
        const slide = slideOf(this.melody!, index, seconds);
        if (slide.semitones === 0) return key;
        const wanted = Math.ceil((100 * Math.abs(slide.semitones)) / slide_cents);
        const steps = Math.max(1, Math.min(wanted, Math.floor(slide.seconds / slide_seconds)));
        const begin = time + seconds - slide.seconds;
        let struck = key;
        for (let i = 0; i < steps; ++i) {
            const at = this.wallTime(begin + Math.min((i * slide.seconds) / steps, slide.seconds - 0.005));
            const pitch = this.melody!.key[index] + (slide.semitones * (i + 1)) / steps;
            if (Math.abs(pitch - struck) > this.range()) {
                this.port.send([0x80 | channel, struck, 64], at);
                struck = Math.round(pitch);
                this.bend(channel, bendOf(pitch - struck, this.range()), at);
                this.port.send([0x90 | channel, struck, velocity], at);
            } else {
                this.bend(channel, bendOf(pitch - struck, this.range()), at);
            }
        }
        return struck;
    }

    /// Messages cannot be cancelled individually: drops all of them, and sends the ends of the sounding notes again.
    cancel(time: number): void {
        if (!this.port.clear) return;
        this.port.clear();
        const now = this.wallTime(time);
        for (const each of this.on) {
            if (each.begin <= now && each.end > now) this.port.send([0x80 | each.channel, each.key, 64], each.end);
        }
        this.on = this.on.filter((each) => each.begin <= now);
    }

    silence(): void {
        this.port.clear?.();
        this.allOff();
    }

    private allOff(): void {
        for (let channel = 0; channel < 16; ++channel) {
            this.port.send([0xb0 | channel, 123, 0]);
            this.port.send([0xe0 | channel, 0, 64]);
        }
        for (const each of this.on) this.port.send([0x80 | each.channel, each.key, 64]);
        this.on = [];
        this.bends.clear();
    }
}
