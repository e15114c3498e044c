// Random numbers that are the same in every browser, so that a timbre always sounds the same.

/// A generator of numbers in [0, 1). Source: Steele, Lea & Flood 2014, reduced to 32 bits (mulberry32).
export function makeChance(seed: number): () => number {
    let state = seed >>> 0;
    return () => {
        state = (state + 0x6d2b79f5) >>> 0;
        let z = state;
        z = Math.imul(z ^ (z >>> 15), z | 1);
        z ^= z + Math.imul(z ^ (z >>> 7), z | 61);
        return ((z ^ (z >>> 14)) >>> 0) / 4294967296;
    };
}
