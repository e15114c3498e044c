// Exact coordinates: decimal numbers of any length, stored as integer multiples of 10^-64. Drawings can be 10^18 steps
// wide and more, and are viewed at the scale of a step; doubles are not precise enough.

/// A multiple of 10^-64.
export type Exact = bigint;

const places = 64;
const one = 10n ** BigInt(places);
const longestText = 5000; // digits
const largestExponent = 5000;

/// Reads a number such as `-12.5` or `3e18`; digits after the 64th decimal are cut off. Null for invalid text.
export function readExact(text: string): Exact | null {
    const clean = text
        .trim()
        .replace(/\u2212/g, "-")
        .replace(/[\s_\u202f\u2009]/g, "");
    if (clean.length > longestText) return null;
    const match = /^([+-]?)(\d*)(?:\.(\d*))?(?:[eE]([+-]?\d{1,5}))?$/.exec(clean);
    if (!match) return null;
    const whole = match[2] ?? "";
    const fraction = match[3] ?? "";
    if (whole === "" && fraction === "") return null;
    const exponent = Number(match[4] ?? "0");
    if (Math.abs(exponent) > largestExponent) return null;
    const shift = places + exponent - fraction.length;
    const figures = BigInt(whole + fraction);
    const value = shift >= 0 ? figures * 10n ** BigInt(shift) : figures / 10n ** BigInt(-shift);
    return match[1] === "-" ? -value : value;
}

/// The shortest text that reads back as the same number; or rounded to `decimals` places, without trailing zeros.
export function exactText(value: Exact, decimals = places): string {
    let rest = value < 0n ? -value : value;
    if (decimals < places) {
        const unit = 10n ** BigInt(places - Math.max(0, decimals));
        rest = ((rest + unit / 2n) / unit) * unit;
    }
    const figures = rest.toString().padStart(places + 1, "0");
    const fraction = figures.slice(-places).replace(/0+$/, "");
    const text = figures.slice(0, -places) + (fraction === "" ? "" : "." + fraction);
    return value < 0n && text !== "0" ? "-" + text : text;
}

/// Formats for display: with a minus sign, and thin spaces between groups of three digits.
export function grouped(text: string): string {
    const [whole = "", fraction] = text.replace("-", "\u2212").split(".");
    const spaced = whole.replace(/\B(?=(\d{3})+$)/g, "\u202f");
    return fraction === undefined ? spaced : `${spaced}.${fraction}`;
}

/// Exact down to 10^-64. The number must be finite.
export function exactOf(value: number): Exact {
    if (!Number.isFinite(value)) throw new RangeError("a coordinate is not finite");
    if (value === 0) return 0n;
    // A double is a whole number of 53 bits times a power of two.
    const exponent = Math.max(-1074, Math.floor(Math.log2(Math.abs(value))) - 53);
    const mantissa = exponent < -1000 ? value * 2 ** 600 * 2 ** (-exponent - 600) : value * 2 ** -exponent;
    const scaled = BigInt(Math.round(mantissa)) * one;
    return exponent >= 0 ? scaled << BigInt(exponent) : divideRounded(scaled, 1n << BigInt(-exponent));
}

/// The nearest double, or infinity.
export function numberOf(value: Exact): number {
    const size = value < 0n ? -value : value;
    const length = size.toString(2).length;
    // Both parts fit a double; the quotient is right in all but the last bit.
    if (length < 900) return Number(value) / Number(one);
    return Number(value / one);
}

/// The largest whole number of `unit` that is not above `value`.
export function wholes(value: Exact, unit: Exact): bigint {
    const quotient = value / unit;
    return value < 0n && quotient * unit !== value ? quotient - 1n : quotient;
}

function divideRounded(value: bigint, by: bigint): bigint {
    const half = by / 2n;
    return value < 0n ? (value - half) / by : (value + half) / by;
}
