// A rendered note, and its level.

export interface Sample {
    data: Float32Array;
    frequency: number; // in hertz; 0: without pitch
    loops: boolean; // the whole of `data` repeats without a seam
}

export const keyFrequency = (key: number): number => 440 * 2 ** ((key - 69) / 12);

const window_seconds = 0.25;
const loudness = 0.07; // root mean square of the loudest quarter of a second
const most_peak = 1.25; // the master limits sums of notes

/// The loudest quarter of a second, or the whole if that is shorter.
export function loudestLevel(data: Float32Array, rate: number): number {
    const length = Math.min(data.length, Math.round(window_seconds * rate));
    const step = Math.max(1, Math.round(rate / 50));
    let sum = 0;
    let most = 0;
    for (let i = 0; i < data.length; ++i) {
        sum += data[i] * data[i];
        if (i >= length) sum -= data[i - length] * data[i - length];
        if (i + 1 === data.length || i % step === 0) most = Math.max(most, sum);
    }
    return Math.sqrt(most / length);
}

/// The perceived level of a note: the loudest moment if it decays; between that and the mean if it is sustained.
export function levelOf({ data, loops }: Sample, rate: number): number {
    const loudest = loudestLevel(data, rate);
    if (!loops) return loudest;
    const power = data.reduce((sum, value) => sum + value * value, 0) / data.length;
    return Math.sqrt(loudest * Math.sqrt(power));
}

/// Scales to the loudness that all timbres share; high notes, which seem louder, are made a little softer.
export function levelled(sample: Sample, rate: number, key: number): Float32Array {
    const { data } = sample;
    const level = levelOf(sample, rate);
    if (!(level > 0)) return data;
    let peak = 0;
    for (const value of data) peak = Math.max(peak, Math.abs(value));
    const slope = 10 ** (-(1.5 * Math.max(0, key - 72)) / 12 / 20);
    const factor = Math.min((loudness * slope) / level, most_peak / peak);
    for (let i = 0; i < data.length; ++i) data[i] *= factor;
    return data;
}

/// Fades a sound out at its end.
export function faded(data: Float32Array, rate: number, seconds: number): Float32Array {
    const length = Math.min(data.length, Math.round(seconds * rate));
    for (let i = 0; i < length; ++i) {
        data[data.length - 1 - i] *= 0.5 - 0.5 * Math.cos((Math.PI * i) / length);
    }
    return data;
}
