// Describes gaps in words, and finds neighbouring gaps for the keyboard.
import { counted } from "../numbers_shown";
import type { DotGrid, Place } from "./dot_grid";
import { crossed, joined, state_names, turned } from "./dot_grid";
import type { Change, Kolam } from "./kolam";

function dotName({ dots, rows }: DotGrid, dot: number): string {
    const row = (rows.length - 1 - dots[dot].level) / 2;
    const before = rows.slice(0, row).reduce((sum, count) => sum + count, 0);
    return `row ${row + 1} dot ${dot - before + 1}`;
}

/// `Gap between row 2 dot 3 and row 2 dot 4: crossed, doubtful; 3 lines`
export function gapText({ grid, states, count, doubts }: Kolam, gap: number): string {
    const { from, to } = grid.gaps[gap];
    const state = state_names[states[gap]] + (doubts.has(gap) ? ", doubtful" : "");
    return `Gap between ${dotName(grid, from)} and ${dotName(grid, to)}: ${state}; ${counted(count, "line")}`;
}

/// `Row 2 dot 3: remove the dot and its images`, or where there is none: `No dot here: add one`
export function placeText({ grid, symmetry }: Kolam, place: Place): string {
    const dot = grid.dots.findIndex(({ x, level }) => x === place.x && level === place.level);
    const images = symmetry.name === "none" ? "" : " and its images";
    if (dot < 0) return `No dot here: add one${images}`;
    return `${dotName(grid, dot)}: remove the dot${images}`.replace("row", "Row");
}

const acts = { [turned]: "Turn back", [crossed]: "Cross", [joined]: "Join" };

/// The effect of a click: `Turn back in 4 gaps: 3 → 5 lines`
export function changeText(kolam: Kolam, gap: number, change: Change): string {
    const state = kolam.stateAfter(gap, change);
    const gaps = kolam.orbits[gap].length;
    if (state === kolam.states[gap]) return `${gaps > 1 ? `${gaps} gaps are` : "The gap is"} ${state_names[state]}`;
    const then = kolam.countAfter(gap, change);
    const lines = counted(then, "line");
    const result = then === kolam.count ? `still ${lines}` : `${kolam.count.toLocaleString("en")} → ${lines}`;
    return `${acts[state as keyof typeof acts]}${gaps > 1 ? ` in ${gaps} gaps` : ""}: ${result}`;
}

/// `60 gaps crossed, 20 turned back, 4 joined`
export function statesTold(kolam: Kolam): string {
    const told = [crossed, turned, joined]
        .map((state) => ({ count: kolam.countOf(state), name: state_names[state] }))
        .filter(({ count }) => count > 0)
        .map(({ count, name }, i) => `${i === 0 ? counted(count, "gap") : count} ${name}`);
    return told.join(", ") || "no gaps";
}

/// The next gap or place for a dot in its row, or the one of the next row that is nearest to a column.
export function neighbour(places: Place[], from: number, dx: number, dy: number, column: number): number {
    const here = places[from];
    let nearest = Infinity;
    let found = from;
    places.forEach((each, i) => {
        const ahead = dx !== 0 ? (each.x - here.x) * dx : (each.level - here.level) * dy;
        const isBeside = dx !== 0 && each.level !== here.level;
        if (ahead <= 0 || isBeside) return;
        const distance = ahead * 1000 + (dx !== 0 ? 0 : Math.abs(each.x - column));
        if (distance < nearest) {
            nearest = distance;
            found = i;
        }
    });
    return found;
}
