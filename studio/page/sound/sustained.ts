// Sustained sounds, as signals that loop seamlessly, made from a spectrum with noise.
// Source: Nasca 2005 (PADsynth): a harmonic that is spread over some bins of the transform sounds like an ensemble.
import { makeChance } from "./chance";
import { signalOf } from "./fourier";
import type { Sample } from "./sample";
import { keyFrequency } from "./sample";

export interface Sustained {
    /// The level of harmonic k (from 1) at a frequency.
    level(k: number, hertz: number, key: number): number;
    spread: number; // width of the harmonics in cents: 0 for one player, 20 and more for many
    breath: number; // noise, relative to the level of the tone
    breath_hertz?: [number, number]; // of its band; absent: around the harmonics
}

const bits = 16;
const wide_bits = 17;

export function sustained(sound: Sustained, key: number, rate: number): Sample {
    const size = 1 << (sound.spread > 0 ? wide_bits : bits);
    const bin = rate / size;
    const fundamental = Math.max(2, Math.round(keyFrequency(key) / bin));
    const amplitude = new Float64Array(size / 2);
    const phase = new Float64Array(size / 2);
    const chance = makeChance(key * 131 + 7);
    for (let k = 0; k < phase.length; ++k) phase[k] = 2 * Math.PI * chance();
    const highest = Math.min(0.42 * rate, 14000) / bin;
    let power = 0;
    for (let k = 1; k * fundamental < highest; ++k) {
        const level = sound.level(k, k * fundamental * bin, key);
        power += level * level;
        const width = ((2 ** (sound.spread / 1200) - 1) * fundamental * k ** 0.9) / 2;
        if (width < 0.4) amplitude[k * fundamental] += level;
        else spread(amplitude, k * fundamental, width, level);
    }
    if (sound.breath > 0) breathe(sound, amplitude, fundamental, bin, Math.sqrt(power), chance);
    return { data: signalOf(size, amplitude, phase), frequency: fundamental * bin, loops: true };
}

/// A bell-shaped band of bins with the power of a single bin.
function spread(amplitude: Float64Array, centre: number, width: number, level: number): void {
    const reach = Math.ceil(3 * width);
    let sum = 0;
    for (let d = -reach; d <= reach; ++d) sum += Math.exp((-d * d) / (width * width));
    for (let d = -reach; d <= reach; ++d) {
        const at = centre + d;
        if (at < 1 || at >= amplitude.length) continue;
        const share = level * Math.sqrt(Math.exp((-d * d) / (width * width)) / sum);
        amplitude[at] = Math.hypot(amplitude[at], share);
    }
}

function breathe(
    sound: Sustained,
    amplitude: Float64Array,
    fundamental: number,
    bin: number,
    level: number,
    chance: () => number,
): void {
    const [low, high] = sound.breath_hertz ?? [fundamental * bin * 0.5, Math.min(12000, fundamental * bin * 12)];
    const noise = new Float64Array(amplitude.length);
    let power = 0;
    for (let k = Math.ceil(low / bin); k < Math.min(high / bin, noise.length); ++k) {
        const near = Math.abs(((k / fundamental + 0.5) % 1) - 0.5) * 2; // 0 at a harmonic, 1 between two
        const tilt = Math.sqrt(low / (k * bin));
        noise[k] = chance() * tilt * (sound.breath_hertz ? 1 : Math.exp(-3 * near) + 0.15);
        power += noise[k] * noise[k];
    }
    if (power === 0) return;
    const factor = (sound.breath * level) / Math.sqrt(power);
    for (let k = 0; k < noise.length; ++k) amplitude[k] = Math.hypot(amplitude[k], factor * noise[k]);
}

/// Resonances that do not depend on the key, as in a voice or a violin: hertz, bandwidth, level.
export function formants(list: readonly [number, number, number][], floor: number): (hertz: number) => number {
    return (hertz) =>
        list.reduce((sum, [centre, bandwidth, level]) => {
            const distance = (hertz - centre) / bandwidth;
            return sum + level / (1 + distance * distance);
        }, floor);
}
