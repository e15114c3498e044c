// Angles of the turtle: a slider turns them continuously, and keeps the exact fractions of a circle that a pattern's
// `angle factor` has.

const nearest = 0.5; // degrees within which a fraction of a circle is meant
const fractions = [2, 3, 4, 5, 6, 7, 8, 9, 10, 12];

/// A value of `angle factor` or `angle increment`.
export interface Angle {
    key: "angle factor" | "angle increment";
    value: string;
}

/// The angle that a position of the slider means. @param factor  of the text, which is a fraction, too
export function angleAt(degrees: number, factor: number): Angle {
    const near = [factor, ...fractions].find((each) => each > 0 && Math.abs(360 / each - degrees) < nearest);
    if (near !== undefined) return { key: "angle factor", value: String(near) };
    return { key: "angle increment", value: String(Math.round(degrees * 100) / 100) };
}

/// Reads what was typed: `360/5`, `72`, `72.5°`; null if it is neither a fraction nor a number.
export function readAngle(text: string): Angle | null {
    const fraction = /^360\s*°?\s*\/\s*(\d+)$/.exec(text);
    if (fraction) return { key: "angle factor", value: fraction[1]! };
    const degrees = Number(text.replace(/\s*°$/, ""));
    if (text.trim() === "" || !Number.isFinite(degrees)) return null;
    const factor = 360 / degrees;
    const isWhole = degrees > 0 && Math.abs(factor - Math.round(factor)) < 1e-9;
    return isWhole ? { key: "angle factor", value: String(Math.round(factor)) } : { key: "angle increment", value: String(degrees) };
}

/// The degrees of an angle.
export function degreesOf({ key, value }: Angle): number {
    return key === "angle factor" ? 360 / Number(value) : Number(value);
}
