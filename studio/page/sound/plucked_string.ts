// A plucked string: a wave in a delay loop that loses its high partials first.
// Source: Karplus & Strong 1983; Jaffe & Smith 1983 (tuning, pluck position, stretched decay).
import { makeChance } from "./chance";
import type { Sample } from "./sample";
import { faded, keyFrequency } from "./sample";

export interface PluckedString {
    seconds: number; // until the fundamental of C4 has decayed by 60 dB
    ring: number; // decay of a partial at 4 kHz as a share of that time, 0 to 1
    position: number; // position of the pluck as a share of the length
    hardness: number; // 0: a soft finger; 1: a plectrum
    noise: number; // of the attack, 0 to 1
    body: [number, number, number][]; // resonances: hertz, bandwidth in hertz, level
}

const bright_frequency = 4000;

/// Delay in samples of a first-order allpass at an angular frequency, solved for its coefficient.
const allpassFor = (delay: number, omega: number): number =>
    Math.sin(((1 - delay) * omega) / 2) / Math.sin(((1 + delay) * omega) / 2);

/// The one-zero filter's delay at zero, 0 to 0.5, so that a partial at 4 kHz has its decay relative to the first.
function dampingFor(ratio: number, omega: number, omega_bright: number): number {
    const curve = Math.cos(omega) - Math.cos(omega_bright);
    if (curve <= 0) return 0.02;
    const product = Math.min(0.25, (1 - ratio * ratio) / (2 * curve)); // s (1 - s)
    return Math.min(0.5, Math.max(0.02, 0.5 - Math.sqrt(0.25 - product)));
}

function excitation(length: number, string: PluckedString, rate: number, key: number): Float64Array {
    const chance = makeChance(key * 7919 + 17);
    const burst = new Float64Array(length);
    burst[0] = 1;
    for (let i = 0; i < length; ++i) burst[i] += (string.noise * (2 * chance() - 1)) / Math.sqrt(length);
    // The width of the finger or plectrum.
    const cutoff = 700 + 9000 * string.hardness ** 1.5 + 2 * keyFrequency(key);
    const share = 1 - Math.exp((-2 * Math.PI * cutoff) / rate);
    for (let pass = 0; pass < 2; ++pass) {
        let state = 0;
        for (let round = 0; round < 2; ++round) {
            for (let i = 0; i < length; ++i) {
                state += share * (burst[i] - state);
                if (round === 1) burst[i] = state;
            }
        }
    }
    scatter(burst);
    // Partials with a node at the position of the pluck are silent.
    const shift = Math.max(1, Math.round(string.position * length));
    return burst.map((value, i) => value - burst[(i + length - shift) % length]);
}

/// Shifts the phases of the partials: the pluck keeps its timbre but has a lower peak.
function scatter(burst: Float64Array): void {
    for (let pass = 0; pass < 24; ++pass) {
        let input = 0;
        let output = 0;
        for (let round = 0; round < 3; ++round) {
            for (let i = 0; i < burst.length; ++i) {
                output = 0.78 * (burst[i] - output) + input;
                input = burst[i];
                if (round === 2) burst[i] = output;
            }
        }
    }
}

export function pluckedString(string: PluckedString, key: number, rate: number): Sample {
    const frequency = keyFrequency(key);
    const omega = (2 * Math.PI * frequency) / rate;
    const period = rate / frequency;
    // Low strings sound longer.
    const decay = Math.min(9, Math.max(0.35, string.seconds * 2 ** ((60 - key) / 20)));
    const perLoop = 10 ** ((-3 * period) / (decay * rate));
    const bright = 10 ** ((-3 * period) / (decay * string.ring * rate));
    const damping = dampingFor(bright / perLoop, omega, (2 * Math.PI * bright_frequency) / rate);
    const re = 1 - damping + damping * Math.cos(omega);
    const im = -damping * Math.sin(omega);
    const gain = Math.min(0.99999, perLoop / Math.hypot(re, im));
    const filterDelay = -Math.atan2(im, re) / omega;
    const left = period - filterDelay;
    const whole = Math.max(1, Math.floor(left - 0.3));
    const allpass = allpassFor(left - whole, omega);

    const count = Math.round(rate * Math.min(6, 0.25 + 1.1 * decay));
    const data = new Float32Array(count);
    const loop = excitation(whole, string, rate, key);
    let last = 0;
    let allpassIn = 0;
    let allpassOut = 0;
    for (let i = 0, at = 0; i < count; ++i) {
        const value = loop[at];
        data[i] = value;
        const damped = gain * ((1 - damping) * value + damping * last);
        last = value;
        allpassOut = allpass * (damped - allpassOut) + allpassIn;
        allpassIn = damped;
        loop[at] = allpassOut;
        if (++at === whole) at = 0;
    }
    resonate(data, string.body, rate);
    return { data: faded(data, rate, 0.2), frequency, loops: false };
}

/// Adds the resonances of a body to its string.
function resonate(data: Float32Array, body: PluckedString["body"], rate: number): void {
    const dry = data.slice();
    for (const [frequency, bandwidth, level] of body) {
        const radius = Math.exp((-Math.PI * bandwidth) / rate);
        const a1 = 2 * radius * Math.cos((2 * Math.PI * frequency) / rate);
        const a2 = -radius * radius;
        const b = level * (1 - radius);
        let y1 = 0;
        let y2 = 0;
        for (let i = 0; i < data.length; ++i) {
            const y = b * (dry[i] - (i > 1 ? dry[i - 2] : 0)) + a1 * y1 + a2 * y2;
            y2 = y1;
            y1 = y;
            data[i] += y;
        }
    }
}
