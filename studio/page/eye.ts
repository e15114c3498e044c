// The point of view on a drawing in space, with the same angles as the key `view` of patterns.

export interface Eye {
    readonly azimuth: number; // degrees to the right around the drawing
    readonly elevation: number; // degrees upwards, -90 to 90
    readonly distance: number | null; // for perspective, in radii of the drawing; null: parallel projection
}

const usualDistance = 4;

/// `AZIMUTH ELEVATION [perspective [DISTANCE]]`, or `front`, `side`, `top`; null for anything else.
export function readEye(text: string): Eye | null {
    const words = text
        .trim()
        .toLowerCase()
        .split(/[\s,]+/);
    const named: Record<string, [number, number]> = { front: [0, 0], side: [90, 0], top: [0, 90] };
    const start = named[words[0] ?? ""];
    const [azimuth, elevation] = start ?? [Number(words[0] || NaN), Number(words[1] || NaN)];
    const rest = words.slice(start ? 1 : 2);
    if (!Number.isFinite(azimuth) || !(Math.abs(elevation) <= 90) || rest.length > 2) return null;
    if (rest.length === 0) return { azimuth, elevation, distance: null };
    if (rest[0] !== "perspective") return null;
    const distance = rest[1] === undefined ? usualDistance : Number(rest[1]);
    return distance >= 1.01 && distance <= 1e6 ? { azimuth, elevation, distance } : null;
}

/// The value of the option `view`.
export function eyeText({ azimuth, elevation, distance }: Eye): string {
    const angles = `${rounded(between(azimuth))},${rounded(elevation)}`;
    return distance === null
        ? angles
        : distance === usualDistance
          ? `${angles},perspective`
          : `${angles},perspective,${rounded(distance)}`;
}

function rounded(value: number): number {
    return Math.round(value * 10) / 10 + 0;
}

/// The equivalent angle between -180 and 180 degrees.
export function between(degrees: number): number {
    const turned = ((degrees % 360) + 360) % 360;
    return turned > 180 ? turned - 360 : turned;
}

export function turnedEye({ azimuth, elevation, distance }: Eye, right: number, up: number): Eye {
    return { azimuth: between(azimuth + right), elevation: Math.max(-90, Math.min(90, elevation + up)), distance };
}

export type Vector = readonly [number, number, number];
export type Matrix = Float32Array; // 4 x 4, by columns

/// The unit vector from the drawing in a direction.
export function towards(azimuth: number, elevation: number): Vector {
    const [a, e] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
    return [Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e)];
}

/// The directions to the right, up and back, as seen from there.
export function axes(azimuth: number, elevation: number): { right: Vector; up: Vector; back: Vector } {
    const a = (azimuth * Math.PI) / 180;
    const right: Vector = [Math.cos(a), 0, -Math.sin(a)];
    const back = towards(azimuth, elevation);
    return { right, up: cross(back, right), back };
}

export function cross(one: Vector, other: Vector): Vector {
    return [
        one[1] * other[2] - one[2] * other[1],
        one[2] * other[0] - one[0] * other[2],
        one[0] * other[1] - one[1] * other[0],
    ];
}

export function dot(one: Vector, other: Vector): number {
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2];
}

/// The projection of a box around `middle`, seen along `axes`, that fits half its width and height to the picture. In
/// perspective, lengths at the middle do not change.
export function seenBy(
    frame: ReturnType<typeof axes>,
    middle: Vector,
    half: { across: number; up: number; deep: number },
    distance: number | null,
): Matrix {
    const { right, up, back } = frame;
    const view = [right, up, back].map((axis) => [...axis, -dot(axis, middle)]);
    const matrix = new Float32Array(16);
    const set = (row: number, values: number[]) =>
        values.forEach((value, column) => {
            matrix[column * 4 + row] = value;
        });
    const scaled = (row: number[], factor: number) => row.map((value) => value * factor);
    set(0, scaled(view[0]!, 1 / half.across));
    set(1, scaled(view[1]!, 1 / half.up));
    if (distance === null) {
        set(2, scaled(view[2]!, -1 / half.deep));
        set(3, [0, 0, 0, 1]);
        return matrix;
    }
    // z in the picture: -1 at `near` before the eye, 1 at `far`.
    const near = Math.max(distance - half.deep, distance / 200);
    const far = distance + half.deep;
    const sum = (near + far) / (far - near);
    const product = (2 * near * far) / (far - near);
    const away = scaled(view[2]!, -1).map((value, index) => (index === 3 ? value + distance : value)); // from the eye
    set(
        2,
        away.map((value, index) => (value * sum - (index === 3 ? product : 0)) / distance),
    );
    set(3, scaled(away, 1 / distance));
    return matrix;
}
