// Sends notes, clock, start and stop to connected MIDI instruments.
import type { Melody } from "./melody";
import type { NoteSink } from "./transport";

export interface MidiPort {
    send(bytes: number[], time?: number): void;
    clear?(): void;
}

const bend_range = 2; // semitones up and down: the default of instruments
const percussion = 9;

/// The channel of a voice. Voices have separate channels for their pitch bends, and avoid the channel of drums.
export function channelOf(voice: number, isDrums: boolean): number {
    if (isDrums) return percussion;
    const channel = voice % 15;
    return channel < percussion ? channel : channel + 1;
}

/// The nearest key, and the pitch bend from it.
export function bentKey(key: number): { key: number; bend: number } {
    const whole = Math.min(127, Math.max(0, Math.round(key)));
    const bend = Math.round(8192 + ((key - whole) / bend_range) * 8192);
    return { key: whole, bend: Math.min(16383, Math.max(0, bend)) };
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
            this.port.send([0xb0 | channel, 7, Math.round(127 * Math.min(1, Math.max(0, voice.volume)))]);
        });
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
        const { key, bend } = bentKey(melody.key[index]);
        const at = this.wallTime(time);
        const off = this.wallTime(time + Math.max(0.01, seconds - 0.004));
        if ((this.bends.get(channel) ?? 8192) !== bend) {
            this.bends.set(channel, bend);
            this.port.send([0xe0 | channel, bend & 127, bend >> 7], at);
        }
        this.port.send([0x90 | channel, key, Math.max(1, Math.min(127, melody.velocity[index]))], at);
        this.port.send([0x80 | channel, key, 64], off);
        this.on = this.on.filter((each) => each.end > at - 2000);
        this.on.push({ channel, key, begin: at, end: off });
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
