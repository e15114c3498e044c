// The symmetries of a grid of dots, and the orbits of its gaps.
import type { DotGrid } from "./dot_grid";
import { countLines } from "./dot_grid";

export type Symmetry = "none" | "C2" | "C4" | "mirror-x" | "mirror-y" | "mirrors" | "D4";

type Isometry = readonly [number, number, number, number]; // xx, xy, yx, yy

const half_turn: Isometry = [-1, 0, 0, -1];
const quarter_turn: Isometry = [0, -1, 1, 0];
const left_and_right: Isometry = [-1, 0, 0, 1];
const top_and_bottom: Isometry = [1, 0, 0, -1];

const generators: Record<Symmetry, Isometry[]> = {
    "none": [],
    "C2": [half_turn],
    "C4": [quarter_turn],
    "mirror-x": [left_and_right],
    "mirror-y": [top_and_bottom],
    "mirrors": [left_and_right, top_and_bottom],
    "D4": [quarter_turn, left_and_right],
};

export const symmetries: { name: Symmetry; label: string }[] = [
    { name: "none", label: "No symmetry" },
    { name: "mirror-x", label: "Left-right mirror" },
    { name: "mirror-y", label: "Top-bottom mirror" },
    { name: "mirrors", label: "Both mirrors" },
    { name: "C2", label: "Half turn" },
    { name: "C4", label: "Quarter turn" },
    { name: "D4", label: "Turns and mirrors" },
];

const moved = ([xx, xy, yx, yy]: Isometry, x: number, y: number): [number, number] => [
    xx * x + xy * y,
    yx * x + yy * y,
];

export function hasSymmetry(grid: DotGrid, symmetry: Symmetry): boolean {
    return generators[symmetry].every((isometry) =>
        grid.dots.every(({ x, y }) => grid.dotAt(...moved(isometry, x, y)) >= 0),
    );
}

/// For each gap, the gaps of its orbit, including itself.
export function gapOrbits(grid: DotGrid, symmetry: Symmetry): number[][] {
    const byPlace = new Map(grid.gaps.map((gap, i) => [`${gap.x} ${gap.y}`, i]));
    const orbits: number[][] = grid.gaps.map(() => []);
    grid.gaps.forEach((_, first) => {
        if (orbits[first].length > 0) return;
        const orbit = [first];
        orbits[first] = orbit;
        for (let at = 0; at < orbit.length; ++at) {
            const gap = grid.gaps[orbit[at]];
            for (const isometry of generators[symmetry]) {
                const [x, y] = moved(isometry, gap.x, gap.y);
                const image = byPlace.get(`${x} ${y}`);
                if (image === undefined || orbits[image].length > 0) continue;
                orbits[image] = orbit;
                orbit.push(image);
            }
        }
        orbit.sort((a, b) => a - b);
    });
    return orbits;
}

/// Sets each orbit to the state of most of its gaps.
export function symmetrised(orbits: number[][], states: Uint8Array): Uint8Array {
    const result = states.slice();
    for (const orbit of new Set(orbits)) {
        const crossings = orbit.reduce((sum, gap) => sum + states[gap], 0);
        for (const gap of orbit) result[gap] = 2 * crossings >= orbit.length ? 1 : 0;
    }
    return result;
}

/// Changes whole orbits as long as that reduces the number of lines, with few changes to the drawing. Null if several
/// lines remain.
export function singleLineNear(
    grid: DotGrid,
    orbits: number[][],
    states: Uint8Array,
    chance: () => number,
): Uint8Array | null {
    const all = [...new Set(orbits)];
    const tries = 40;
    for (let attempt = 0; attempt < tries; ++attempt) {
        const found = states.slice();
        // Later attempts start a few changes away.
        for (let i = 0; i < attempt; ++i) flip(found, all[Math.floor(chance() * all.length)]);
        let lines = countLines(grid, found);
        for (let isImproved = true; isImproved && lines > 1;) {
            isImproved = false;
            for (const orbit of shuffled(all, chance)) {
                flip(found, orbit);
                const now = countLines(grid, found);
                if (now < lines) {
                    lines = now;
                    isImproved = true;
                } else {
                    flip(found, orbit);
                }
                if (lines === 1) break;
            }
        }
        if (lines === 1) return found;
    }
    return null;
}

function flip(states: Uint8Array, orbit: number[]): void {
    for (const gap of orbit) states[gap] = 1 - states[gap];
}

function shuffled<T>(values: readonly T[], chance: () => number): T[] {
    const order = [...values];
    for (let i = order.length; i > 1; --i) {
        const other = Math.floor(chance() * i);
        [order[i - 1], order[other]] = [order[other], order[i - 1]];
    }
    return order;
}
