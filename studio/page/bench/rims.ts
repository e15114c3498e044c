// Shapes the loops at the rim of a kolam as the libraries do (art/kolam/kolam_rim.h).
import type { RimName } from "../protocol";
import type { DotGrid, Step } from "./dot_grid";
import { entryOf, exitOf, turned, waysOf } from "./dot_grid";
import { traceSegments } from "./strand_path";

export const rim_labels: Record<RimName, string> = {
    round: "Round",
    pointed: "Pointed",
    petal: "Petals",
    horn: "Horns",
    crescent: "Crescents",
};
export const rim_names = Object.keys(rim_labels) as RimName[];

/// Control points of a loop from the right to the left, looking outwards: the distance from the dot in half spacings
/// and the angle from the direction outwards in degrees. Tips are marked.
type RimPoint = [radius: number, angle: number, isTip?: boolean];
const rim_points: Record<RimName, readonly RimPoint[]> = {
    round: [],
    pointed: [[1, -40], [1.64, 0, true], [1, 40]],
    petal: [[1.08, -62], [1.36, -28], [1.9, 0, true], [1.36, 28], [1.08, 62]],
    horn: [[1.08, -48], [1.7, -12], [2.2, 28, true], [1.24, 20], [0.96, 50]],
    crescent: [[1.16, -58], [2, -25, true], [1.16, 0], [2, 25, true], [1.16, 58]],
};

type Point = [x: number, y: number];
const leftOf = ([x, y]: Point): Point => [-y, x];
const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1];
const unit = ([x, y]: Point): Point => [x / Math.hypot(x, y), y / Math.hypot(x, y)];

/// The loop around a place. @param aside  negative for a horn that bends to the right, 0 for a straight one
function loopAround([x, y]: Point, outwards: Point, rim: RimName, aside: number): Point[] {
    const sign = aside < 0 ? -1 : 1;
    const left = leftOf(outwards);
    const points = rim_points[Math.abs(aside) < 1e-6 ? "pointed" : rim].flatMap(([radius, degrees, isTip]): Point[] => {
        const angle = (sign * degrees * Math.PI) / 180;
        const [u, v] = [Math.cos(angle), Math.sin(angle)];
        const ray: Point = [u * outwards[0] + v * left[0], u * outwards[1] + v * left[1]];
        const [px, py] = [x + radius * ray[0], y + radius * ray[1]];
        // Control points that nearly coincide make a corner.
        const apart = 0.02 * sign;
        return isTip
            ? [[px + apart * ray[1], py - apart * ray[0]], [px, py], [px - apart * ray[1], py + apart * ray[0]]]
            : [[px, py]];
    });
    return sign < 0 ? points.reverse() : points;
}

/// The loops at the rim that are not round: their control points anticlockwise, by dot.
export class Rim {
    private readonly outwards = new Map<number, Point>();
    private readonly shapes = new Map<number, Point[]>();
    private readonly places: Point[];
    private readonly dotAt: Map<string, number>;

    constructor(private readonly grid: DotGrid, states: Uint8Array, rim: RimName) {
        this.places = grid.dots.map(({ x, level }) => [x, level * grid.rise]);
        this.dotAt = new Map(grid.dots.map(({ x, level }, i) => [`${x} ${level}`, i]));
        if (rim === "round") return;
        this.findLoops(states, rim);
        for (const each of this.loopsThatMeet()) {
            this.shapes.set(each, loopAround(this.places[each], this.outwards.get(each)!, "pointed", 1));
        }
        for (const each of this.loopsThatMeet()) this.shapes.delete(each);
    }

    get shaped(): number {
        return this.shapes.size;
    }

    private ray(side: number): Point {
        const [x, level] = waysOf(this.grid)[side % this.grid.sides];
        return unit([x, level * this.grid.rise]);
    }

    private findLoops(states: Uint8Array, rim: RimName): void {
        const { sides, gapAt, dots } = this.grid;
        const centre = this.places.reduce(([x, y], each) => [x + each[0], y + each[1]], [0, 0]);
        const middleOf: Point = [centre[0] / dots.length, centre[1] / dots.length];
        for (let each = 0; each < dots.length; ++each) {
            const gap = (side: number): number => gapAt[sides * each + (side % sides)];
            const turns = (side: number): boolean => gap(side) < 0 || states[gap(side)] === turned;
            for (let first = 0; first < sides; ++first) {
                let length = 0;
                while (length < sides && turns(first + length)) ++length;
                if (turns(first + sides - 1) || length <= sides / 2) continue;
                const [middle, other] = [first + Math.floor((length - 1) / 2), first + Math.floor(length / 2)];
                if (gap(middle) >= 0 || gap(other) >= 0) continue;
                const [a, b] = [this.ray(middle), this.ray(other)];
                const outwards = unit([a[0] + b[0], a[1] + b[1]]);
                this.outwards.set(each, outwards);
                const aside = rim === "horn" ? this.roomAside(each, outwards, middleOf) : 1;
                this.shapes.set(each, loopAround(this.places[each], outwards, rim, aside));
            }
        }
    }

    /// Positive if a horn has room on the left, negative for the right: where there are fewer dots, or away from the
    /// axis through the middle of the dots. Near 0 if it would break a symmetry.
    private roomAside(each: number, outwards: Point, [cx, cy]: Point): number {
        const left = leftOf(outwards);
        let room = 0;
        for (let side = 0; side < this.grid.sides; ++side) {
            if (this.grid.gapAt[this.grid.sides * each + side] < 0) room += dot(this.ray(side), left);
        }
        const [x, y] = this.places[each];
        return Math.abs(room) > 0.1 ? room : dot([x - cx, y - cy], left);
    }

    private loopsThatMeet(): number[] {
        const [least, least_from_dots, reach] = [0.24, 1, 5];
        const outlines = new Map([...this.shapes].map(([each, shape]) => [each, dense(shape)]));
        const isNear = (a: Point, b: Point, distance: number): boolean =>
            (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 < distance ** 2;
        return [...outlines].filter(([each, outline]) => {
            const { x, level } = this.grid.dots[each];
            for (let up = -reach; up <= reach; ++up) {
                for (let across = -reach; across <= reach; ++across) {
                    const other = this.dotAt.get(`${x + across} ${level + up}`);
                    if (other === undefined || other === each) continue;
                    const beside = outlines.get(other) ?? [];
                    const meets = (point: Point): boolean =>
                        isNear(point, this.places[other], least_from_dots)
                        || beside.some((near) => isNear(point, near, least));
                    if (outline.some(meets)) return true;
                }
            }
            return false;
        }).map(([each]) => each);
    }

    /// Replaces the control points of a line in the loops, except the first and the last of each.
    /// @param points  where the steps end: x, y, x, y …
    reshaped(steps: readonly Step[], points: number[]): number[] {
        const { grid, shapes } = this;
        const count = steps.length;
        const turnsBack = (i: number): boolean => {
            const [from, to] = [steps[i % count], steps[(i + 1) % count]];
            return from.dot === to.dot && from.isAnticlockwise === to.isAnticlockwise
                && exitOf(grid, from) === entryOf(grid, to);
        };
        let begin = 0; // not within a loop
        while (begin < count && turnsBack(begin)) ++begin;
        if (shapes.size === 0 || begin === count) return points;
        const result: number[] = [];
        const put = (i: number): void => void result.push(points[2 * (i % count)], points[2 * (i % count) + 1]);
        for (let i = begin; i < begin + count;) {
            let end = i;
            while (turnsBack(end)) ++end;
            const { dot: at, isAnticlockwise } = steps[i % count];
            const shape = shapes.get(at);
            const isLoop = end - i > grid.sides / 2 && shape !== undefined;
            put(i);
            if (isLoop) result.push(...(isAnticlockwise ? shape : shape.toReversed()).flat());
            for (++i; i < end; ++i) if (!isLoop || i + 1 === end) put(i);
        }
        return result;
    }
}

/// Adds points between those of a shape.
function dense(shape: Point[]): Point[] {
    const parts = 4;
    return shape.flatMap((a, i) => {
        const b = shape[i + 1];
        if (!b) return [a];
        return Array.from({ length: parts }, (_, part): Point => {
            const t = part / parts;
            return [a[0] * (1 - t) + b[0] * t, a[1] * (1 - t) + b[1] * t];
        });
    });
}

/// An icon of 16 x 16 pixels, as an SVG path: a dot with the loop around it.
export function rimIcon(rim: RimName): string {
    const loop = rim === "round" ? [[0, 1]] : loopAround([0, 0], [0, 1], rim, 1);
    const foot: Point[] = [[-1.2, -2.4], [-1, -2], [0, -1], [1, 0]];
    const mirrored = foot.toReversed().map(([x, y]): Point => [-x, y]);
    const points = [...foot, ...loop, ...mirrored].map(([x, y]) => [8 + 4.3 * x, 10.4 - 4.3 * y]).flat();
    const parts: string[] = [];
    const put = (letter: string, ...values: number[]): void => {
        parts.push(letter + values.map((value) => value.toFixed(2)).join(" "));
    };
    const pen = {
        moveTo: (x: number, y: number) => put("M", x, y),
        bezierCurveTo: (...values: number[]) => put("C", ...values),
        closePath: () => {},
    };
    traceSegments(pen, points, 1, points.length / 2 - 3);
    return `${parts.join("")}M8 10.4h.01`;
}
