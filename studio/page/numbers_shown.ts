// Formats numbers for display.

/// Digits as superscripts.
export function raised(exponent: number | string): string {
    return [...String(exponent)].map((digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)]).join("");
}

/// Formats a count: "3,239", "1.2 million", or as given by the libraries: "about 10^24081".
export function count(text: string): string {
    if (!/^\d+$/.test(text)) return text.replace(/\^(\d+)/g, (_, exponent: string) => raised(exponent));
    if (text.length > 15) return `about 10${raised(text.length - 1)}`;
    const number = Number(text);
    if (number < 1e6) return number.toLocaleString("en");
    const units: [number, string][] = [[1e12, "trillion"], [1e9, "billion"], [1e6, "million"]];
    const [size, unit] = units.find(([each]) => number >= each)!;
    return `${(number / size).toPrecision(3)} ${unit}`;
}

/// A count with its noun: "1 symbol", "3,239 symbols".
export function counted(number: string | number, noun: string): string {
    const text = String(number);
    return `${count(text)} ${noun}${text === "1" ? "" : "s"}`;
}

/// The length of a range of decimal strings of any length, for display.
export function span(from: string, to: string): string {
    const size = Math.abs(Number(to) - Number(from));
    if (!Number.isFinite(size))
        return `10${raised(Math.max(from.replace("-", "").length, to.replace("-", "").length) - 1)}`;
    if (size >= 1e9)
        return size.toExponential(2).replace(/e\+?(\d+)/, (_, exponent: string) => ` × 10${raised(exponent)}`);
    return size.toLocaleString("en", { maximumSignificantDigits: 6 });
}

/// A size in bytes.
export function bytes(size: number): string {
    if (size < 1000) return `${size} bytes`;
    return size < 1e6 ? `${(size / 1e3).toFixed(size < 1e4 ? 1 : 0)} kB` : `${(size / 1e6).toFixed(1)} MB`;
}

/// A number with only as many digits as its step needs.
export function rounded(number: number, step: number): string {
    const digits = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));
    return String(Number(number.toFixed(digits)));
}

/// The text with its first letter capitalised.
export function capital(text: string): string {
    return text.slice(0, 1).toUpperCase() + text.slice(1);
}

/// The same with a full stop, unless it ends a sentence.
export function sentence(text: string): string {
    return capital(text) + (/[.!?`]$/.test(text) ? "" : ".");
}
