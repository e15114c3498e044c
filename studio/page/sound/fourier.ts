// The inverse Fourier transform, which makes a sound from its spectrum.

/// The real signal of `size` samples from the amplitude and phase of each bin; `size` is a power of two.
export function signalOf(size: number, amplitude: Float64Array, phase: Float64Array): Float32Array {
    // Even and odd samples are the real and imaginary parts of a signal of half the size. Bin k of the whole and its
    // conjugate at size - k become bins k and half - k of that signal.
    const half = size / 2;
    const real = new Float64Array(half);
    const imaginary = new Float64Array(half);
    for (let k = 1; k < Math.min(half, amplitude.length); ++k) {
        if (amplitude[k] === 0) continue;
        const re = 0.5 * amplitude[k] * Math.cos(phase[k]);
        const im = 0.5 * amplitude[k] * Math.sin(phase[k]);
        const c = Math.cos((2 * Math.PI * k) / size);
        const s = Math.sin((2 * Math.PI * k) / size);
        real[k] += re * (1 - s) - im * c;
        imaginary[k] += re * c + im * (1 - s);
        real[half - k] += re * (1 + s) + im * c;
        imaginary[half - k] += re * c - im * (1 + s);
    }
    transform(real, imaginary);
    const signal = new Float32Array(size);
    for (let i = 0; i < half; ++i) {
        signal[2 * i] = real[i];
        signal[2 * i + 1] = imaginary[i];
    }
    return signal;
}

const roots = new Map<number, { cosines: Float64Array; sines: Float64Array }>();

/// e^(i pi k / half) for k below half.
function rootsOf(half: number): { cosines: Float64Array; sines: Float64Array } {
    let found = roots.get(half);
    if (!found) {
        found = { cosines: new Float64Array(half), sines: new Float64Array(half) };
        for (let k = 0; k < half; ++k) {
            found.cosines[k] = Math.cos((Math.PI * k) / half);
            found.sines[k] = Math.sin((Math.PI * k) / half);
        }
        roots.set(half, found);
    }
    return found;
}

/// Transforms in place, with positive exponents and without scaling.
function transform(real: Float64Array, imaginary: Float64Array): void {
    const size = real.length;
    for (let i = 1, j = 0; i < size; ++i) {
        let bit = size >> 1;
        for (; j & bit; bit >>= 1) j ^= bit;
        j ^= bit;
        if (i < j) {
            const re = real[i];
            const im = imaginary[i];
            real[i] = real[j];
            imaginary[i] = imaginary[j];
            real[j] = re;
            imaginary[j] = im;
        }
    }
    for (let half = 1; half < size; half *= 2) {
        const { cosines, sines } = rootsOf(half);
        for (let begin = 0; begin < size; begin += 2 * half) {
            for (let k = 0, a = begin, b = begin + half; k < half; ++k, ++a, ++b) {
                const x = real[b] * cosines[k] - imaginary[b] * sines[k];
                const y = real[b] * sines[k] + imaginary[b] * cosines[k];
                real[b] = real[a] - x;
                imaginary[b] = imaginary[a] - y;
                real[a] += x;
                imaginary[a] += y;
            }
        }
    }
}
