// The kolam on the bench: a grid, the states of its gaps, and the symmetry that changes preserve.
import type { RimName, SymmetryName } from "../protocol";
import type { DotGrid, GridSymmetry, Lines, Place } from "./dot_grid";
import { agrees, countLines, crossed, followLines, joined, lineOrbits, no_grid, turned } from "./dot_grid";
import { Rim } from "./rims";
import { roundedStrands } from "./rounded_lines";
import { isSymmetric, symmetrised } from "./symmetry";

/// States that a click steps through: crossed, turned back, joined.
const next_state = [joined, turned, crossed];
const state_before = [crossed, joined, turned];

/// A change of gaps: to the next or the previous state, or to a certain one.
export type Change = "next" | "previous" | number;

export class Kolam {
    grid: DotGrid = no_grid;
    states = new Uint8Array(0);
    lines: Lines = followLines(no_grid, this.states);
    drawn: number[][] = []; // the control points of the lines
    rim: RimName = "round";
    shaped = 0; // loops at the rim that have its shape
    doubts: ReadonlySet<number> = new Set(); // gaps that a photograph does not show clearly
    lineOrbits: number[] = []; // see lineOrbits()
    symmetry: GridSymmetry = no_grid.symmetries[0];
    /// The user has chosen the symmetry; otherwise it follows the drawing.
    isChosen = false;

    get count(): number {
        return this.lines.strands.length;
    }
    get orbits(): number[][] {
        return this.symmetry.orbits;
    }
    get isJoined(): boolean {
        return this.states.includes(joined);
    }
    countOf(state: number): number {
        return this.states.reduce((sum, each) => sum + (each === state ? 1 : 0), 0);
    }
    symmetryNamed(name: SymmetryName): GridSymmetry | undefined {
        return this.grid.symmetries.find((each) => each.name === name);
    }

    /// Sets another grid with the states of its gaps. A chosen symmetry stays if the grid has it, any other if the
    /// drawing has it. No gap is doubtful.
    set(grid: DotGrid, states: Uint8Array): void {
        const { name } = this.symmetry;
        this.grid = grid;
        const same = this.symmetryNamed(name);
        this.isChosen &&= same !== undefined;
        const stays = same && (this.isChosen || isSymmetric(same.orbits, states));
        this.symmetry = stays ? same : grid.symmetries[grid.symmetries.length - 1];
        this.doubts = new Set();
        this.setStates(states);
    }

    /// Removes the doubts about gaps that change.
    setStates(states: Uint8Array): void {
        const before = this.states;
        if (this.doubts.size > 0) this.settle([...this.doubts].filter((gap) => before[gap] !== states[gap]));
        this.states = Uint8Array.from(states);
        this.lines = followLines(this.grid, this.states);
        this.shape();
        this.lineOrbits = lineOrbits(this.grid, this.states, this.lines);
    }

    setRim(rim: RimName): void {
        if (rim === this.rim) return;
        this.rim = rim;
        this.shape();
    }

    private shape(): void {
        const rim = new Rim(this.grid, this.states, this.rim);
        this.shaped = rim.shaped;
        this.drawn = roundedStrands(this.grid, this.states, this.lines, rim);
    }

    /// Removes the doubts about some gaps.
    settle(gaps: Iterable<number>): void {
        const doubts = new Set(this.doubts);
        for (const gap of gaps) doubts.delete(gap);
        this.doubts = doubts;
    }

    stateAfter(gap: number, change: Change): number {
        const state = this.states[gap];
        return change === "next" ? next_state[state] : change === "previous" ? state_before[state] : change;
    }

    /// The states after changing a gap and its images under the symmetry.
    after(gap: number, change: Change): Uint8Array {
        const states = this.states.slice();
        const state = this.stateAfter(gap, change);
        for (const each of this.orbits[gap]) states[each] = state;
        return states;
    }

    countAfter(gap: number, change: Change): number {
        return countLines(this.grid, this.after(gap, change));
    }

    /// Returns true if this changes the drawing.
    setSymmetry(name: SymmetryName, isChosen: boolean): boolean {
        const found = this.symmetryNamed(name);
        if (!found) return false;
        this.symmetry = found;
        this.isChosen = isChosen;
        if (isSymmetric(this.orbits, this.states)) return false;
        this.setStates(symmetrised(this.orbits, this.states));
        return true;
    }

    /// Gaps that both grids have keep their states: after editing in their places, otherwise aligned at the middle or
    /// at the first dot.
    setGrid(grid: DotGrid, isEdited: boolean): void {
        const old = this.grid;
        let shift: Place = isEdited ? grid.moved : { x: 0, level: 0 };
        if (!agrees(old, grid, shift) && old.dots.length > 0) {
            shift = { x: grid.dots[0].x - old.dots[0].x, level: grid.dots[0].level - old.dots[0].level };
        }
        const known = new Map<string, number>(); // gaps of the old grid
        if (agrees(old, grid, shift)) {
            old.gaps.forEach((gap, i) => known.set(`${gap.x + shift.x} ${gap.level + shift.level}`, i));
        }
        const { states, doubts } = this;
        const before = grid.gaps.map((gap) => known.get(`${gap.x} ${gap.level}`) ?? -1);
        this.set(grid, Uint8Array.from(before, (gap) => states[gap] ?? crossed));
        this.doubts = new Set([...before.keys()].filter((gap) => doubts.has(before[gap])));
        this.setStates(symmetrised(this.orbits, this.states));
    }

    /// The notation of a grid with more or fewer rows and columns. Rows of different lengths change by two dots, in
    /// interlaced grids by one; a grid that is the same from above and below grows and shrinks at both ends. Null for
    /// shapes with holes, and if nothing would be left.
    resized(rows: number, columns: number): string | null {
        const { grid } = this;
        const isRectangle = grid.rows.every((row) => row === grid.rows[0]);
        const step = isRectangle || grid.isTriangular ? 1 : 2;
        let made = grid.rows.map((row) => row + columns * step);
        if (!grid.isSolid || made.length === 0 || made.some((row) => row < 1)) return null;
        if (isRectangle && !grid.isTriangular) {
            if (rows > 0) made.push(made[0]);
            else if (rows < 0) made.pop();
        } else if (made.every((row, i) => row === made[made.length - 1 - i])) {
            if (rows > 0) {
                const end = made[0] > step ? made[0] - step : made[0];
                made = [end, ...made.map((row) => row + end + step - made[0]), end];
            } else if (rows < 0) {
                made = made.slice(1, -1);
            }
        } else if (rows > 0) {
            const [before, last] = made.slice(-2);
            made.push(before < last ? last + step : last > step ? last - step : last + grid.sides / 2 - 2);
        } else if (rows < 0) {
            made.pop();
        }
        return made.length === 0 ? null : made.join(",");
    }
}
