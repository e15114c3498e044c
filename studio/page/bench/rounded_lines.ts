// Rounds the lines of interlaced kolams as the libraries do (art/kolam/rounded_lines.h), so that the board shows what
// will be drawn.
import type { DotGrid, Lines, Step } from "./dot_grid";
import { crossed, exitOf, turned, walkLine, waysOf } from "./dot_grid";
import type { Rim } from "./rims";

// In half spacings.
const least_radius = 0.64;
const rim_radius = 1;
const crossed_radius = 0.72;
const turned_radius = 0.84;
const middle = Math.sqrt(3) / 3; // of three dots, from the middle of a gap

const tension = 0.3;
const precise = 2e-9;
const most_sweeps = 400;

/// The control points of the spline along each line: its midpoints on straight grids, unless the rim is shaped.
export function roundedStrands(
    grid: DotGrid,
    states: Uint8Array,
    { strands, lineOfArc }: Lines,
    rim: Rim | null = null,
): number[][] {
    if (!grid.isTriangular && !rim?.shaped) return strands;
    const starts: number[] = [];
    lineOfArc.forEach((line, arc) => {
        if (line === starts.length) starts.push(arc);
    });
    return starts.map((start) => roundedLine(grid, states, start, rim));
}

function roundedLine(grid: DotGrid, states: Uint8Array, start: number, rim: Rim | null): number[] {
    const { dots, gapAt, isTriangular, sides, rise } = grid;
    const ways = waysOf(grid);
    const originX: number[] = [], originY: number[] = [], rayX: number[] = [], rayY: number[] = [];
    const least: number[] = [], most: number[] = [], at: number[] = [];
    const points: number[] = [];
    const steps: Step[] = [];
    // A control point on a ray, where a step leaves its dot.
    const add = (x: number, y: number, dx: number, dy: number, low: number, high: number, first: number): void => {
        originX.push(x), originY.push(y), rayX.push(dx), rayY.push(dy);
        least.push(low), most.push(high), at.push(first);
        points.push(x + first * dx, y + first * dy);
    };
    walkLine(grid, states, start, (dot, arc, isAnticlockwise) => {
        const step = { dot, arc, isAnticlockwise };
        steps.push(step);
        const side = exitOf(grid, step);
        const [x, y] = [dots[dot].x, dots[dot].level * rise];
        const [dx, dy] = [ways[side][0] / 2, (ways[side][1] / 2) * rise];
        const gap = gapAt[sides * dot + side];
        if (!isTriangular) add(x, y, dx, dy, 1, 1, 1);
        else if (gap < 0) add(x, y, dx, dy, least_radius, rim_radius, least_radius);
        else if (states[gap] === turned) add(x, y, dx, dy, least_radius, turned_radius, least_radius);
        else if (states[gap] === crossed) add(x, y, dx, dy, crossed_radius, 2 - crossed_radius, 1);
        else {
            const sign = isAnticlockwise ? 1 : -1;
            add(x + dx, y + dy, sign * dy, -sign * dx, middle / 2, middle, middle);
        }
    });
    const count = at.length;
    for (let sweep = 0; isTriangular && sweep < most_sweeps; ++sweep) {
        let moved = 0;
        for (let i = 0; i < count; ++i) {
            const [a, b, c, d] = [i + count - 2, i + count - 1, i + 1, i + 2].map((k) => 2 * (k % count));
            const weight = 6 + 2 * tension;
            const x = ((4 + tension) * (points[b] + points[c]) - points[a] - points[d]) / weight - originX[i];
            const y =
                ((4 + tension) * (points[b + 1] + points[c + 1]) - points[a + 1] - points[d + 1]) / weight - originY[i];
            const now = Math.min(Math.max(x * rayX[i] + y * rayY[i], least[i]), most[i]);
            moved = Math.max(moved, Math.abs(now - at[i]));
            at[i] = now;
            points[2 * i] = originX[i] + now * rayX[i];
            points[2 * i + 1] = originY[i] + now * rayY[i];
        }
        if (moved < precise) break;
    }
    // From the exits of steps to their entries.
    const shaped = rim ? rim.reshaped(steps, points) : points;
    return [...shaped.slice(-2), ...shaped.slice(0, -2)];
}
