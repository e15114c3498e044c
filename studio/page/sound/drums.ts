// Drums for the keys of General MIDI's channel 10.
import { makeChance } from "./chance";
import { addKnock, onset, partials } from "./partials";
import type { Sample } from "./sample";
import { faded, keyFrequency } from "./sample";

/// A drum skin whose pitch falls as it decays.
function skin(rate: number, from: number, to: number, fall: number, seconds: number): Float32Array {
    const data = new Float32Array(Math.round(seconds * rate));
    let phase = 0;
    for (let i = 0; i < data.length; ++i) {
        const time = i / rate;
        phase += (2 * Math.PI * (to + (from - to) * Math.exp(-time / fall))) / rate;
        data[i] = Math.sin(phase) * Math.exp((-6.9 * time) / seconds);
    }
    return onset(data, rate, 0.0015);
}

/// Noise above a frequency: a cymbal, a snare, a shaker.
function hiss(rate: number, above: number, seconds: number, metal: number, seed: number): Float32Array {
    const data = new Float32Array(Math.round(seconds * rate));
    const chance = makeChance(seed);
    const share = Math.exp((-2 * Math.PI * above) / rate);
    const tones = [3.11, 4.07, 5.39, 6.17, 7.93, 8.71].map((x) => (2 * Math.PI * x * 1000) / rate);
    let before = 0;
    let high = 0;
    for (let i = 0; i < data.length; ++i) {
        let value = 2 * chance() - 1;
        if (metal > 0) for (const tone of tones) value += metal * Math.sign(Math.sin(tone * i)) * 0.4;
        high = share * (high + value - before);
        before = value;
        data[i] = high * Math.exp((-6.9 * i) / rate / seconds);
    }
    return onset(data, rate, 0.001);
}

function mixed(parts: [Float32Array, number][]): Float32Array {
    const data = new Float32Array(Math.max(...parts.map(([part]) => part.length)));
    for (const [part, level] of parts)
        part.forEach((value, i) => {
            data[i] += level * value;
        });
    return data;
}

/// A loaded skin, as on the mridangam, whose partials are nearly harmonic. Source: Raman 1934.
function loadedSkin(rate: number, key: number, seconds: number, closed: boolean): Float32Array {
    const list = [1, 2, 3.003, 4.006, 5.01].map((ratio, k) => ({
        ratio,
        level: [0.7, 1, 0.6, 0.4, 0.2][k],
        seconds: (closed ? 0.18 : seconds) / (1 + 0.4 * k),
    }));
    const data = onset(partials(list, key, rate, closed ? 0.25 : seconds, null, 3), rate, 0.001);
    addKnock(data, rate, 2600, 0.03, closed ? 1.1 : 0.5, key);
    return data;
}

function clap(rate: number): Float32Array {
    const one = hiss(rate, 900, 0.16, 0, 77);
    const data = new Float32Array(one.length + Math.round(0.03 * rate));
    for (const [delay, level] of [[0, 0.6], [0.011, 0.7], [0.022, 1]]) {
        const shift = Math.round(delay * rate);
        for (let i = 0; i < one.length; ++i) {
            const dies = delay < 0.02 ? Math.exp(-i / rate / 0.006) : 1;
            data[i + shift] += level * dies * one[i];
        }
    }
    return data;
}

/// A struck piece of metal or wood: partials as ratios to the key, with their levels.
function struckAt(key: number, rate: number, seconds: number, decay: number, ratios: [number, number][]): Float32Array {
    const list = ratios.map(([ratio, level]) => ({ ratio, level, seconds: decay }));
    return onset(partials(list, key, rate, seconds, null, 1), rate, 0.001);
}

const bell: [number, number][] = [[1, 1], [1.504, 0.7], [2.3, 0.2]];
const block: [number, number][] = [[1, 1], [2.6, 0.5], [4.1, 0.25]];
const triangle: [number, number][] = [[1, 1], [1.36, 0.8], [1.83, 0.6], [2.41, 0.4]];

type Stroke = (key: number, rate: number) => Float32Array;

const strokes: [keys: number[], Stroke][] = [
    [[35, 36], (key, rate) =>
        mixed([[skin(rate, 150, key === 35 ? 46 : 52, 0.028, 0.42), 1], [hiss(rate, 2500, 0.012, 0, 1), 0.25]])],
    [[37, 75], (_, rate) => mixed([[skin(rate, 1700, 1650, 0.01, 0.05), 1], [hiss(rate, 3000, 0.03, 0, 2), 0.5]])],
    [[38, 40], (key, rate) =>
        mixed([[skin(rate, 320, 185, 0.02, 0.16), 0.8], [hiss(rate, 1500, 0.22, 0, key), 0.7]])],
    [[39], (_, rate) => clap(rate)],
    [[42, 44, 54, 69, 70, 82], (key, rate) => hiss(rate, 7000, key === 44 ? 0.07 : 0.09, 0.6, key)],
    [[46], (key, rate) => hiss(rate, 6500, 0.5, 0.6, key)],
    [[49, 52, 55, 57], (key, rate) => hiss(rate, 3500, 1.6, 0.3, key)],
    [[51, 53, 59], (key, rate) =>
        mixed([[hiss(rate, 5000, 1.1, 1.1, key), 0.6], [skin(rate, 2900, 2900, 1, 0.6), 0.25]])],
    [[41, 43, 45, 47, 48, 50], (key, rate) => {
        const pitch = 75 * 2 ** ((key - 41) / 12);
        return mixed([[skin(rate, pitch * 1.7, pitch, 0.05, 0.5), 1], [hiss(rate, 2000, 0.02, 0, key), 0.2]]);
    }],
    [[56, 67, 68], (key, rate) => struckAt(key === 56 ? 73 : key + 16, rate, 0.4, 0.35, bell)],
    [[76, 77], (key, rate) => struckAt(key === 76 ? 84 : 79, rate, 0.2, 0.12, block)],
    [[80], (_, rate) => struckAt(99, rate, 0.25, 0.2, triangle)],
    [[81], (_, rate) => struckAt(99, rate, 1.6, 1.6, triangle)],
];

/// The sound of a key; keys without a drum are strokes of a mridangam at their pitch.
function stroke(key: number, rate: number): Float32Array {
    const found = strokes.find(([keys]) => keys.includes(key));
    return found ? found[1](key, rate) : loadedSkin(rate, Math.min(80, Math.max(40, key)), 0.9, key % 5 === 2);
}

export function drum(key: number, rate: number): Sample {
    return { data: faded(stroke(Math.round(key), rate), rate, 0.02), frequency: 0, loops: false };
}

/// A drum tuned to the melody.
export function tunedDrum(key: number, rate: number): Sample {
    return { data: faded(loadedSkin(rate, key, 0.9, false), rate, 0.1), frequency: keyFrequency(key), loops: false };
}
