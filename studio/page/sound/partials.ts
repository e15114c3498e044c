// Sounds as sums of independently decaying partials: bells, bars, pianos, strings on a curved bridge.
import { makeChance } from "./chance";
import type { Sample } from "./sample";
import { faded, keyFrequency } from "./sample";

export interface Partial {
    ratio: number; // of its frequency to the fundamental
    level: number;
    seconds: number; // until it has decayed by 60 dB
}

const step = 32; // samples between two points of the envelopes

/// `level(partial, seconds)` is an envelope applied in addition to the decay, in linear segments.
export function partials(
    list: readonly Partial[],
    key: number,
    rate: number,
    seconds: number,
    shape: ((partial: number, time: number) => number) | null,
    seed: number,
): Float32Array {
    const count = Math.ceil((seconds * rate) / step) * step;
    const data = new Float32Array(count);
    const fundamental = keyFrequency(key);
    const chance = makeChance(seed + key);
    list.forEach(({ ratio, level, seconds: decay }, index) => {
        const omega = (2 * Math.PI * fundamental * ratio) / rate;
        const phase = 2 * Math.PI * chance();
        if (omega > 0.9 * Math.PI || level === 0) return;
        const turnX = Math.cos(omega);
        const turnY = Math.sin(omega);
        const fade = 10 ** ((-3 * step) / (decay * rate));
        let x = Math.cos(phase);
        let y = Math.sin(phase);
        let envelope = 1;
        let before = level * (shape ? shape(index, 0) : 1);
        for (let begin = 0; begin < count; begin += step) {
            envelope *= fade;
            if (level * envelope < 2e-5) break;
            const after = level * envelope * (shape ? shape(index, (begin + step) / rate) : 1);
            let amplitude = before;
            const slope = (after - before) / step;
            for (let i = begin; i < begin + step; ++i) {
                data[i] += amplitude * y;
                amplitude += slope;
                const next = x * turnX - y * turnY;
                y = x * turnY + y * turnX;
                x = next;
            }
            before = after;
        }
    });
    return data;
}

/// Fades in within a few milliseconds, because random phases would click.
export function onset(data: Float32Array, rate: number, seconds: number): Float32Array {
    const length = Math.min(data.length, Math.max(1, Math.round(seconds * rate)));
    for (let i = 0; i < length; ++i) data[i] *= 0.5 - 0.5 * Math.cos((Math.PI * i) / length);
    return data;
}

/// A knock: noise in a band that decays.
export function addKnock(
    data: Float32Array,
    rate: number,
    hertz: number,
    seconds: number,
    level: number,
    seed: number,
): void {
    const chance = makeChance(seed);
    const share = 1 - Math.exp((-2 * Math.PI * hertz) / rate);
    const fade = 10 ** (-3 / (seconds * rate));
    let low = 0;
    let lower = 0;
    let envelope = level;
    for (let i = 0; i < Math.min(data.length, 2 * seconds * rate); ++i) {
        low += share * (2 * chance() - 1 - low);
        lower += 0.3 * share * (low - lower);
        data[i] += envelope * (low - lower);
        envelope *= fade;
    }
}

export interface Struck {
    partials: Partial[]; // decay at C5
    stretch: number; // number of times that an octave down doubles the decay
    attack: number; // seconds
    knock?: [number, number, number]; // hertz, seconds, level
}

export function struck(bar: Struck, key: number, rate: number): Sample {
    const factor = 2 ** ((bar.stretch * (72 - key)) / 12);
    const list = bar.partials.map((partial) => ({ ...partial, seconds: Math.min(9, partial.seconds * factor) }));
    const longest = Math.max(...list.map((partial) => partial.seconds));
    const seconds = Math.min(4.5, Math.max(0.3, longest));
    const data = onset(partials(list, key, rate, seconds, null, 11), rate, bar.attack);
    if (bar.knock) addKnock(data, rate, bar.knock[0], bar.knock[1], bar.knock[2], key + 5);
    return { data: faded(data, rate, 0.15), frequency: keyFrequency(key) * bar.partials[0].ratio, loops: false };
}

/// A piano: pairs of slightly detuned stiff strings, which decay quickly at first and slowly afterwards.
export function piano(key: number, rate: number): Sample {
    const fundamental = keyFrequency(key);
    const stiffness = 0.000018 * 2 ** ((key - 48) / 9);
    const stretched = (k: number): number => k * Math.sqrt((1 + stiffness * k * k) / (1 + stiffness));
    const decay = Math.min(11, 8 * 2 ** ((60 - key) / 18));
    const damping = 0.16 + Math.max(0, key - 30) * 0.006;
    const highest = Math.min(8000, rate * 0.45);
    const list: Partial[] = [];
    for (let k = 1; k <= 40 && fundamental * stretched(k) < highest; ++k) {
        const level = (Math.abs(Math.sin(Math.PI * k * 0.12)) * Math.exp(-(k - 1) * damping)) / k ** 0.35;
        if (level > 3e-4) list.push({ ratio: stretched(k), level, seconds: decay / (1 + 0.28 * k) });
    }
    // Two strings, 0.35 cents above and below, beat; the struck one loses most of its energy within a second.
    const shape = (index: number, time: number): number => {
        const apart = Math.PI * 2 * fundamental * (index + 1) * 0.0002 * time;
        return 0.42 * Math.exp((-9 * time * (1 + 0.28 * index)) / decay) + 0.58 * (0.75 + 0.25 * Math.cos(apart));
    };
    const data = onset(partials(list, key, rate, Math.min(4.5, decay * 0.9), shape, 29), rate, 0.0025);
    addKnock(data, rate, 900, 0.06, 0.16, key);
    return { data: faded(data, rate, 0.3), frequency: fundamental, loops: false };
}

/// An electric piano: a tine with a tone bar. Source: Chowning 1973 (frequency modulation).
export function electricPiano(key: number, rate: number): Sample {
    const frequency = keyFrequency(key);
    const omega = (2 * Math.PI * frequency) / rate;
    const decay = Math.min(7, 4.5 * 2 ** ((60 - key) / 24));
    const data = new Float32Array(Math.round(Math.min(4, decay) * rate));
    const body = 10 ** (-3 / (decay * rate));
    const index_fade = 10 ** (-3 / (0.55 * decay * rate));
    const ping_fade = 10 ** (-3 / (0.5 * rate));
    let level = 1;
    let index = 1.15 * 2 ** ((60 - key) / 36);
    let ping = 13 * omega < 0.8 * Math.PI ? 0.16 : 0;
    for (let i = 0; i < data.length; ++i) {
        data[i] = level * Math.sin(omega * i + index * Math.sin(omega * i)) + level * ping * Math.sin(13 * omega * i);
        level *= body;
        index *= index_fade;
        ping *= ping_fade;
    }
    return { data: faded(onset(data, rate, 0.002), rate, 0.3), frequency, loops: false };
}

/// A string on a curved bridge, as on the veena, the sitar and the tanpura: its overtones swell one after another, the
/// high ones first.
export interface CurvedBridge {
    seconds: number; // until the fundamental of C4 has decayed by 60 dB
    begin: number; // the loudest partial at first
    end: number; // the loudest partial at the end
    fall: number; // seconds
    buzz: number; // boost of the loudest partial
    position: number; // position of the pluck
    attack: number;
}

export function curvedBridge(string: CurvedBridge, key: number, rate: number): Sample {
    const fundamental = keyFrequency(key);
    const decay = Math.min(12, string.seconds * 2 ** ((60 - key) / 24));
    const list: Partial[] = [];
    for (let k = 1; k <= 44 && k * fundamental < Math.min(9500, 0.45 * rate); ++k) {
        list.push({
            ratio: k,
            level: (0.25 + Math.abs(Math.sin(Math.PI * k * string.position))) / k ** 1.05,
            seconds: decay / (1 + 0.035 * k),
        });
    }
    const highest = Math.min(string.begin, list.length);
    const shape = (index: number, time: number): number => {
        const centre = string.end + (highest - string.end) * Math.exp((-3 * time) / string.fall);
        const distance = (index + 1 - centre) / (1.5 + 0.22 * centre);
        const swell = 1 - Math.exp(-time / 0.04);
        return 1 + string.buzz * Math.exp(-distance * distance) * swell * Math.min(1, (index + 1) / 4);
    };
    const data = onset(partials(list, key, rate, Math.min(5, decay), shape, 41), rate, string.attack);
    return { data: faded(data, rate, 0.3), frequency: fundamental, loops: false };
}
