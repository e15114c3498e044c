// The symmetries of kolams on the bench. The libraries give the orbits of a grid's gaps.
import type { SymmetryName } from "../protocol";
import type { DotGrid } from "./dot_grid";
import { countLines, crossed, turned } from "./dot_grid";

export const symmetry_labels: Record<SymmetryName, string> = {
    "none": "No symmetry",
    "mirror-x": "Left-right mirror",
    "mirror-y": "Top-bottom mirror",
    "diagonal": "Diagonal mirror",
    "mirrors": "Both mirrors",
    "diagonals": "Both diagonals",
    "C2": "Half turn",
    "C3": "Third of a turn",
    "C4": "Quarter turn",
    "C6": "Sixth of a turn",
    "D3": "Thirds and upright mirrors",
    "D3-y": "Thirds and level mirrors",
    "D4": "Quarter turns and mirrors",
    "D6": "Sixths and mirrors",
};

export function isSymmetric(orbits: number[][], states: Uint8Array): boolean {
    return orbits.every((orbit, gap) => states[orbit[0]] === states[gap]);
}

/// Sets each orbit to the state that most of its gaps have; of several to the most crossed one.
export function symmetrised(orbits: number[][], states: Uint8Array): Uint8Array {
    const result = states.slice();
    for (const orbit of new Set(orbits)) {
        const counts = [0, 0, 0];
        for (const gap of orbit) ++counts[states[gap]];
        const most = Math.max(...counts);
        const state = counts[crossed] === most ? crossed : counts.indexOf(most);
        for (const gap of orbit) result[gap] = state;
    }
    return result;
}

const most_steps = 3e6; // along lines, a second on a slow machine

/// Changes whole orbits as long as that reduces the number of lines, with few changes to the drawing. Null if several
/// lines remain.
export function singleLineNear(
    grid: DotGrid,
    orbits: number[][],
    states: Uint8Array,
    chance: () => number,
): Uint8Array | null {
    const all = [...new Set(orbits)];
    let left = most_steps / (grid.sides * grid.dots.length);
    for (let attempt = 0; left > 0; ++attempt) {
        const found = states.slice();
        // Later attempts start a few changes away.
        for (let i = 0; i < attempt; ++i) change(found, all[Math.floor(chance() * all.length)]);
        let lines = countLines(grid, found);
        for (let isImproved = true; isImproved && lines > 1;) {
            isImproved = false;
            for (const orbit of shuffled(all, chance)) {
                const before = found[orbit[0]];
                change(found, orbit);
                const now = countLines(grid, found);
                --left;
                if (now < lines) {
                    lines = now;
                    isImproved = true;
                } else {
                    for (const gap of orbit) found[gap] = before;
                }
                if (lines === 1) break;
            }
        }
        if (lines === 1) return found;
        if (all.length === 0) return null;
    }
    return null;
}

/// Crossings turn back, other gaps become crossings.
function change(states: Uint8Array, orbit: number[]): void {
    const state = states[orbit[0]] === crossed ? turned : crossed;
    for (const gap of orbit) states[gap] = state;
}

function shuffled<T>(values: readonly T[], chance: () => number): T[] {
    const order = [...values];
    for (let i = order.length; i > 1; --i) {
        const other = Math.floor(chance() * i);
        [order[i - 1], order[other]] = [order[other], order[i - 1]];
    }
    return order;
}
