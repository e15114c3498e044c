// Describes gaps in words, and finds neighbouring gaps for the keyboard.
import type { DotGrid } from "./dot_grid";
import { crossed } from "./dot_grid";
import type { Kolam } from "./kolam";

export function counted(count: number, one: string, more = `${one}s`): string {
    return `${count.toLocaleString("en")} ${count === 1 ? one : more}`;
}

function dotName({ dots, rows }: DotGrid, dot: number): string {
    const row = (rows.length - 1 - dots[dot].y) / 2;
    return `row ${row + 1} dot ${(dots[dot].x + rows[row] - 1) / 2 + 1}`;
}

/// `Gap between row 2 dot 3 and row 2 dot 4: crossed; 3 lines`
export function gapText({ grid, states, count }: Kolam, gap: number): string {
    const { from, to } = grid.gaps[gap];
    const state = states[gap] === crossed ? "crossed" : "turned back";
    return `Gap between ${dotName(grid, from)} and ${dotName(grid, to)}: ${state}; ${counted(count, "line")}`;
}

/// The effect of a click: `Turn back in 4 gaps: 3 → 5 lines`
export function changeText(kolam: Kolam, gap: number): string {
    const then = kolam.countAfter(gap);
    const act = kolam.states[gap] === crossed ? "Turn back" : "Cross";
    const gaps = kolam.orbits[gap].length;
    const lines = counted(then, "line");
    const result = then === kolam.count ? `still ${lines}` : `${kolam.count.toLocaleString("en")} → ${lines}`;
    return `${act}${gaps > 1 ? ` in ${gaps} gaps` : ""}: ${result}`;
}

/// The next gap in its row of gaps, or the one of the next row that is nearest to a column.
export function neighbour({ gaps }: DotGrid, gap: number, dx: number, dy: number, column: number): number {
    const here = gaps[gap];
    let nearest = Infinity;
    let found = gap;
    gaps.forEach((each, i) => {
        const ahead = dx !== 0 ? (each.x - here.x) * dx : (each.y - here.y) * dy;
        const isBeside = dx !== 0 && each.y !== here.y;
        if (ahead <= 0 || isBeside) return;
        const distance = ahead * 1000 + (dx !== 0 ? 0 : Math.abs(each.x - column));
        if (distance < nearest) {
            nearest = distance;
            found = i;
        }
    });
    return found;
}
