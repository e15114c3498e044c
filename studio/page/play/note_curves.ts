// The curves of notes in drawings whose lines are splines: each note lies on the part of the curve that its steps control.
import type { Lines } from "../protocol";
import type { Melody } from "../sound/melody";

const most_points = 30_000; // beyond that, steps are too short for the curve to differ from them
const parts = 8; // of the curve, for each step
const least_share = 0.5; // of the notes that have a place on the curve
const grain = 1e4; // places per step at which points are compared

/// A stroke as points of its curve, `parts` for each step, and the ends of the steps.
interface Stroke {
    readonly first: number; // number of its first control point
    readonly steps: number;
    readonly curve: Float64Array; // x, y …
}

/// A part of a stroke, in steps; backwards if `to` is less than `from`.
interface Range {
    readonly stroke: Stroke;
    readonly from: number;
    readonly to: number;
}

export interface CurvePen {
    moveTo(x: number, y: number): void;
    lineTo(x: number, y: number): void;
}
export type Mapped = (value: number) => number;

/// Evaluates the uniform cubic B-spline of points x, y … as engine/geometry/spline.h makes it: closed where it ends at its
/// beginning, otherwise from its first point to its last. A control point corresponds to the curve at its Greville
/// abscissa.
export function curveOf(points: Float64Array): Float64Array {
    const count = points.length / 2;
    const steps = count - 1;
    const isClosed = steps > 1 && same(points, 0, steps);
    const made = new Float64Array(2 * (steps * parts + 1));
    const put = (at: number, [x, y]: [number, number]) => {
        made[2 * at] = x;
        made[2 * at + 1] = y;
    };
    if (isClosed) {
        const at = (i: number) => ((i % steps) + steps) % steps;
        for (let step = 0; step < steps; ++step) {
            const four = [at(step - 1), at(step), at(step + 1), at(step + 2)] as const;
            for (let part = 0; part < parts; ++part) put(step * parts + part, uniform(points, four, part / parts));
        }
        put(steps * parts, [made[0]!, made[1]!]);
        return made;
    }
    // Short strokes triple their ends, others have clamped knots.
    const isShort = steps < 4;
    const controls = isShort ? [0, 0, ...Array.from({ length: count }, (_, i) => i), steps, steps] : null;
    const size = controls?.length ?? count;
    const control = (i: number) => controls?.[i] ?? i;
    const knot = (i: number) => (isShort ? i - 3 : Math.min(size - 3, Math.max(0, i - 3)));
    const greville = (i: number) => (knot(i + 1) + knot(i + 2) + knot(i + 3)) / 3;
    for (let step = 0; step < steps; ++step) {
        const shift = isShort ? 2 : 0;
        // The ends of a short stroke are those of its curve.
        const low = isShort && step === 0 ? 0 : greville(step + shift);
        const high = isShort && step === steps - 1 ? size - 3 : greville(step + 1 + shift);
        for (let part = 0; part <= parts; ++part) {
            put(step * parts + part, deBoor(points, control, knot, size, low + ((high - low) * part) / parts));
        }
    }
    return made;
}

function same(points: Float64Array, one: number, other: number): boolean {
    const near = (axis: number) => Math.abs(points[2 * one + axis]! - points[2 * other + axis]!) < 1 / grain;
    return near(0) && near(1);
}

function uniform(points: Float64Array, [a, b, c, d]: readonly [number, number, number, number], t: number): [number, number] {
    const weights = [(1 - t) ** 3, 3 * t ** 3 - 6 * t ** 2 + 4, -3 * t ** 3 + 3 * t ** 2 + 3 * t + 1, t ** 3];
    const along = (axis: number) =>
        [a, b, c, d].reduce((sum, point, i) => sum + (weights[i]! / 6) * points[2 * point + axis]!, 0);
    return [along(0), along(1)];
}

function deBoor(
    points: Float64Array,
    control: (i: number) => number,
    knot: (i: number) => number,
    size: number,
    u: number,
): [number, number] {
    const span = Math.min(size - 1, Math.max(3, Math.floor(u) + 3)); // the knots are whole, and one apart
    const x = [0, 1, 2, 3].map((i) => points[2 * control(span - 3 + i)]!);
    const y = [0, 1, 2, 3].map((i) => points[2 * control(span - 3 + i) + 1]!);
    for (let level = 1; level <= 3; ++level) {
        for (let i = 3; i >= level; --i) {
            const low = knot(span - 3 + i);
            const high = knot(span + 1 + i - level);
            const share = high > low ? (u - low) / (high - low) : 0;
            x[i] = (1 - share) * x[i - 1]! + share * x[i]!;
            y[i] = (1 - share) * y[i - 1]! + share * y[i]!;
        }
    }
    return [x[3]!, y[3]!];
}

export class NoteCurves {
    private readonly notes: (Range | null)[];
    private readonly runs: (Range | null)[]; // from the end of another note to the beginning of each

    private constructor(
        private readonly strokes: Stroke[],
        melody: Melody,
        places: Places,
        before: Int32Array,
    ) {
        const last = new Map<number, number>(); // the control point at which a voice stopped
        const { path } = melody;
        this.notes = Array.from({ length: melody.count }, (_, note) => {
            const at = 4 * note;
            const ends = [path[at]!, path[at + 1]!, path[at + 2]!, path[at + 3]!] as const;
            const found = places.find(ends, last.get(melody.voice[note]!) ?? 0);
            if (found) last.set(melody.voice[note]!, found.stroke.first + found.to);
            return found;
        });
        this.runs = this.notes.map((range, note) => {
            const old = before[note]! >= 0 ? this.notes[before[note]!] : null;
            if (!range || !old || old.stroke !== range.stroke || old.to === range.from) return null;
            return places.isStraight(old.stroke, old.to, range.from) ? { ...range, from: old.to, to: range.from } : null;
        });
    }

    /// The curves of a melody; null if the lines are too long, or not those that it was read from.
    /// @param before  the note that leads to each, -1 for none
    static of(lines: Lines, bytes: Uint8Array, melody: Melody, before: Int32Array): NoteCurves | null {
        const count = lines.begins.at(-1) ?? 0;
        if (count === 0 || count > most_points || bytes.byteLength < 16 * count) return null;
        const aligned = bytes.byteOffset % 8 === 0 ? bytes : bytes.slice();
        const points = new Float64Array(aligned.buffer, aligned.byteOffset, 2 * count);
        const strokes = lines.begins.slice(0, -1).map((first, i): Stroke => {
            const end = lines.begins[i + 1]!;
            return { first, steps: end - first - 1, curve: curveOf(points.subarray(2 * first, 2 * end)) };
        });
        const curves = new NoteCurves(strokes, melody, new Places(points, strokes), before);
        const known = curves.notes.filter((range) => range !== null).length;
        return known >= least_share * melody.count ? curves : null;
    }

    has(note: number): boolean {
        return this.notes[note] !== null;
    }

    /// Traces all lines of the drawing.
    traceAll(pen: CurvePen, x: Mapped, y: Mapped): void {
        for (const stroke of this.strokes) trace(pen, { stroke, from: 0, to: stroke.steps }, 1, x, y);
    }

    /// Traces the run that leads to a note, and a share of the note's own part of the curve.
    trace(pen: CurvePen, note: number, share: number, x: Mapped, y: Mapped): void {
        const run = this.runs[note];
        if (run) trace(pen, run, 1, x, y);
        trace(pen, this.notes[note]!, share, x, y);
    }

    /// The place after a share of a note.
    placeAt(note: number, share: number): [number, number] {
        return placeAt(this.notes[note]!, share);
    }
}

function placeAt({ stroke, from, to }: Range, share: number): [number, number] {
    const at = parts * (from + share * (to - from));
    const low = Math.min(stroke.steps * parts - 1, Math.floor(at));
    const part = at - low;
    const along = (axis: number) => {
        const start = stroke.curve[2 * low + axis]!;
        return start + part * (stroke.curve[2 * low + 2 + axis]! - start);
    };
    return [along(0), along(1)];
}

function trace(pen: CurvePen, range: Range, share: number, x: Mapped, y: Mapped): void {
    const { stroke, from, to } = range;
    const begin = parts * from;
    const end = parts * (from + share * (to - from));
    const step = to < from ? -1 : 1;
    pen.moveTo(x(stroke.curve[2 * begin]!), y(stroke.curve[2 * begin + 1]!));
    for (let at = begin + step; step * (end - at) >= 0; at += step) {
        pen.lineTo(x(stroke.curve[2 * at]!), y(stroke.curve[2 * at + 1]!));
    }
    const [lastX, lastY] = placeAt(range, share);
    pen.lineTo(x(lastX), y(lastY));
}

// The control points of a drawing by their places.
class Places {
    private readonly byPlace = new Map<string, { stroke: Stroke; at: number }[]>();

    constructor(
        private readonly points: Float64Array,
        strokes: Stroke[],
    ) {
        for (const stroke of strokes) {
            for (let at = 0; at <= stroke.steps; ++at) {
                const name = this.nameOf(points[2 * (stroke.first + at)]!, points[2 * (stroke.first + at) + 1]!);
                const here = this.byPlace.get(name);
                if (here) here.push({ stroke, at });
                else this.byPlace.set(name, [{ stroke, at }]);
            }
        }
    }

    private nameOf(x: number, y: number): string {
        return `${Math.round(x * grain)} ${Math.round(y * grain)}`;
    }

    /// The steps that lead straight from one place to another: the first ones after a control point, else the first.
    find([x0, y0, x1, y1]: readonly [number, number, number, number], after: number): Range | null {
        const begins = this.byPlace.get(this.nameOf(x0, y0)) ?? [];
        const end = this.nameOf(x1, y1);
        let first: Range | null = null;
        for (const { stroke, at } of begins) {
            for (const direction of [1, -1]) {
                const to = this.walk(stroke, at, direction, end);
                if (to === null) continue;
                const found = { stroke, from: at, to };
                if (stroke.first + at >= after) return found;
                first ??= found;
            }
        }
        return first;
    }

    // The control point at which a straight walk arrives; null if it turns before.
    private walk(stroke: Stroke, from: number, direction: number, end: string): number | null {
        for (let at = from + direction; at >= 0 && at <= stroke.steps; at += direction) {
            if (!this.isStraight(stroke, from, at)) return null;
            const point = 2 * (stroke.first + at);
            if (this.nameOf(this.points[point]!, this.points[point + 1]!) === end) return at;
        }
        return null;
    }

    /// True if the last step of a walk has the direction of the first.
    isStraight(stroke: Stroke, from: number, to: number): boolean {
        const direction = to < from ? -1 : 1;
        const step = (at: number): [number, number] => {
            const one = 2 * (stroke.first + at);
            const other = one + 2 * direction;
            return [this.points[other]! - this.points[one]!, this.points[other + 1]! - this.points[one + 1]!];
        };
        const [x0, y0] = step(from);
        const [x1, y1] = step(to - direction);
        return Math.abs(x0 * y1 - x1 * y0) < 1e-6 && x0 * x1 + y0 * y1 > 0;
    }
}
