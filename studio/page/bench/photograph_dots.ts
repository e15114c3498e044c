// Where the dots of a kolam lie on those of its photograph. A notation does not say this: many kolams are on 3x3, and
// a column added on one side and removed on the other leads to the same notation, with all dots moved.
import { dotFixes } from "./dot_fixes";
import type { DotGrid, Place } from "./dot_grid";

interface Pattern {
    text: string;
}

const unmoved: Place = { x: 0, level: 0 };

export class PhotographDots {
    /// From the places of dots in the grid that was read to their places on the bench; null while the bench shows
    /// another kolam.
    shift: Place | null = null;
    private first: readonly Place[] | null = null; // dots that were read, once they are edited
    private readonly shifts = new WeakMap<Pattern, Place | null>(); // undo returns to the same patterns

    /// `text`: of the pattern that was read.
    constructor(private readonly text: string) {}

    /// The bench shows a pattern. `isSame`: with the kolam that it has shown before.
    show(pattern: Pattern, isSame: boolean): void {
        const known = this.shifts.get(pattern);
        const read = pattern.text === this.text ? unmoved : null;
        this.shift = known !== undefined ? known : ((isSame ? this.shift : null) ?? read);
        this.keep(pattern);
    }

    /// The pattern has the kolam that the bench shows.
    keep(pattern: Pattern): void {
        this.shifts.set(pattern, this.shift);
    }

    /// Another grid was chosen.
    leave(): void {
        this.shift = null;
    }

    /// Dots were added or removed.
    follow(before: DotGrid, { moved }: DotGrid): void {
        if (!this.shift) return;
        this.first ??= before.dots;
        this.shift = { x: this.shift.x + moved.x, level: this.shift.level + moved.level };
    }

    /// The fixes that turn the dots that were read into those of the grid on the bench.
    fixes({ dots }: DotGrid): string[] {
        const { x: right, level: up } = this.shift ?? unmoved;
        return dotFixes(this.first ?? dots, dots.map(({ x, level }) => ({ x: x - right, level: level - up })));
    }
}
