// The kolam on the bench: a grid, the states of its gaps, and the symmetry that changes preserve.
import type { DotGrid, Lines } from "./dot_grid";
import { countLines, crossed, followLines, makeGrid, parseGrid } from "./dot_grid";
import type { Symmetry } from "./symmetry";
import { gapOrbits, hasSymmetry, symmetrised } from "./symmetry";

const isEven = (value: number): boolean => value % 2 === 0;

export class Kolam {
    grid: DotGrid;
    states: Uint8Array;
    symmetry: Symmetry = "none";
    orbits: number[][];
    lines: Lines;

    constructor(text: string) {
        this.grid = parseGrid(text);
        this.states = new Uint8Array(this.grid.gaps.length).fill(crossed);
        this.orbits = gapOrbits(this.grid, "none");
        this.lines = followLines(this.grid, this.states);
    }

    get count(): number {
        return this.lines.strands.length;
    }
    get crossings(): number {
        return this.states.reduce((sum, state) => sum + (state === crossed ? 1 : 0), 0);
    }

    /// Sets another grid with the states of its gaps; the symmetry stays if the grid has it.
    set(grid: DotGrid, states: Uint8Array): void {
        this.grid = grid;
        if (!hasSymmetry(grid, this.symmetry)) this.symmetry = "none";
        this.orbits = gapOrbits(grid, this.symmetry);
        this.setStates(states);
    }

    setStates(states: Uint8Array): void {
        this.states = Uint8Array.from(states);
        this.lines = followLines(this.grid, this.states);
    }

    /// The states after changing a gap and its images under the symmetry.
    after(gap: number): Uint8Array {
        const states = this.states.slice();
        const state = 1 - states[gap];
        for (const each of this.orbits[gap]) states[each] = state;
        return states;
    }

    countAfter(gap: number): number {
        return countLines(this.grid, this.after(gap));
    }

    /// Returns true if this changes the drawing.
    setSymmetry(symmetry: Symmetry): boolean {
        if (!hasSymmetry(this.grid, symmetry)) return false;
        this.symmetry = symmetry;
        this.orbits = gapOrbits(this.grid, symmetry);
        const before = this.states.join("");
        this.setStates(symmetrised(this.orbits, this.states));
        return this.states.join("") !== before;
    }

    /// Gaps that both grids have keep their states, aligned at the centre or at the upper left corner.
    setGrid(grid: DotGrid): void {
        const old = this.grid;
        const isCentred = isEven(grid.rows[0] - old.rows[0]) && isEven(grid.rows.length - old.rows.length);
        const dx = isCentred ? 0 : grid.dots[0].x - old.dots[0].x;
        const dy = isCentred ? 0 : grid.dots[0].y - old.dots[0].y;
        const states = new Map(old.gaps.map((gap, i) => [`${gap.x + dx} ${gap.y + dy}`, this.states[i]]));
        this.set(
            grid,
            Uint8Array.from(grid.gaps, (gap) => states.get(`${gap.x} ${gap.y}`) ?? crossed),
        );
        this.setStates(symmetrised(this.orbits, this.states));
    }

    /// The grid with more or fewer rows and columns; rows of different lengths change by two dots each. Null if nothing
    /// would be left. Throws an Error with a message for the user.
    resized(rows: number, columns: number): DotGrid | null {
        const old = this.grid.rows;
        const isRectangle = old.every((row) => row === old[0]);
        const widened = old.map((row) => row + columns * (isRectangle ? 1 : 2)).filter((row) => row > 0);
        const last = widened[widened.length - 1];
        const next = rows > 0 ? [...widened, last] : rows < 0 ? widened.slice(0, -1) : widened;
        return next.length === 0 || next.length !== old.length + rows ? null : makeGrid(next);
    }
}
