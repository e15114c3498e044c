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
    for (const [delay, level] of [
        [0, 0.6],
        [0.011, 0.7],
        [0.022, 1],
    ]) {
        const shift = Math.round(delay * rate);
        for (let i = 0; i < one.length; ++i) {
            const dies = delay < 0.02 ? Math.exp(-i / rate / 0.006) : 1;
            data[i + shift] += level * dies * one[i];
        }
    }
    return data;
}

/// The sound of a key; keys without a drum are strokes of a mridangam at their pitch.
function stroke(key: number, rate: number): Float32Array {
    switch (key) {
        case 35:
        case 36:
            return mixed([
                [skin(rate, 150, key === 35 ? 46 : 52, 0.028, 0.42), 1],
                [hiss(rate, 2500, 0.012, 0, 1), 0.25],
            ]);
        case 37:
        case 75:
            return mixed([
                [skin(rate, 1700, 1650, 0.01, 0.05), 1],
                [hiss(rate, 3000, 0.03, 0, 2), 0.5],
            ]);
        case 38:
        case 40:
            return mixed([
                [skin(rate, 320, 185, 0.02, 0.16), 0.8],
                [hiss(rate, 1500, 0.22, 0, key), 0.7],
            ]);
        case 39:
            return clap(rate);
        case 42:
        case 44:
        case 54:
        case 69:
        case 70:
        case 82:
            return hiss(rate, 7000, key === 44 ? 0.07 : 0.09, 0.6, key);
        case 46:
            return hiss(rate, 6500, 0.5, 0.6, key);
        case 49:
        case 52:
        case 55:
        case 57:
            return hiss(rate, 3500, 1.6, 0.3, key);
        case 51:
        case 53:
        case 59:
            return mixed([
                [hiss(rate, 5000, 1.1, 1.1, key), 0.6],
                [skin(rate, 2900, 2900, 1, 0.6), 0.25],
            ]);
        case 41:
        case 43:
        case 45:
        case 47:
        case 48:
        case 50: {
            const pitch = 75 * 2 ** ((key - 41) / 12);
            return mixed([
                [skin(rate, pitch * 1.7, pitch, 0.05, 0.5), 1],
                [hiss(rate, 2000, 0.02, 0, key), 0.2],
            ]);
        }
        case 56:
        case 67:
        case 68: {
            const list = [
                [1, 1],
                [1.504, 0.7],
                [2.3, 0.2],
            ].map(([ratio, level]) => ({ ratio, level, seconds: 0.35 }));
            return onset(partials(list, key === 56 ? 73 : key + 16, rate, 0.4, null, 1), rate, 0.001);
        }
        case 76:
        case 77: {
            const list = [
                [1, 1],
                [2.6, 0.5],
                [4.1, 0.25],
            ].map(([ratio, level]) => ({ ratio, level, seconds: 0.12 }));
            return onset(partials(list, key === 76 ? 84 : 79, rate, 0.2, null, 1), rate, 0.001);
        }
        case 80:
        case 81: {
            const list = [
                [1, 1],
                [1.36, 0.8],
                [1.83, 0.6],
                [2.41, 0.4],
            ].map(([ratio, level]) => ({ ratio, level, seconds: key === 80 ? 0.2 : 1.6 }));
            return onset(partials(list, 99, rate, key === 80 ? 0.25 : 1.6, null, 1), rate, 0.001);
        }
        default:
            return loadedSkin(rate, Math.min(80, Math.max(40, key)), 0.9, key % 5 === 2);
    }
}

export function drum(key: number, rate: number): Sample {
    return { data: faded(stroke(Math.round(key), rate), rate, 0.02), frequency: 0, loops: false };
}

/// A drum tuned to the melody.
export function tunedDrum(key: number, rate: number): Sample {
    return { data: faded(loadedSkin(rate, key, 0.9, false), rate, 0.1), frequency: keyFrequency(key), loops: false };
}
