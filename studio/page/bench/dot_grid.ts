// Kolams on a grid of dots: the gaps between dots, and the lines that they form. Follows the rules of
// art/kolam/dot_grid.h, but in the page, so that clicks take effect at once.

/// A gap's state is a number so that states are a Uint8Array.
export const turned = 0; // the lines turn back on both sides
export const crossed = 1; // two lines cross
export type GapState = typeof turned | typeof crossed; // later: joined, where two dots share a loop

/// Sides of a dot, anticlockwise: right, up, left, down. Arc s lies between the sides s and s + 1.
const side_x = [1, 0, -1, 0];
const side_y = [0, 1, 0, -1];

export interface Point {
    x: number;
    y: number;
} // twice the distance from the middle, y up
export interface Gap {
    from: number;
    to: number;
    side: number;
    x: number;
    y: number;
} // side of `from`: 0 or 3

export interface DotGrid {
    rows: number[];
    dots: Point[];
    gaps: Gap[]; // row by row: those within the row, then those to the next row
    gapAt: Int32Array; // by 4 * dot + side, -1 at the border
    dotAt(x: number, y: number): number; // -1: none
}

const most_gaps = 1000; // that a pattern can list and the bench can read back

const tooLarge = (): Error => new Error(`A grid has at most ${most_gaps} gaps, such as 22 x 22 dots.`);

/// Throws an Error with a message for the user.
export function makeGrid(rows: number[]): DotGrid {
    if (rows.length === 0 || rows.some((row) => !Number.isInteger(row) || row < 1)) {
        throw new Error("Enter rows and columns, such as 7x7, or the dots of each row, such as 1-3-5-3-1.");
    }
    if (rows.some((row) => row % 2 !== rows[0] % 2)) {
        throw new Error("All rows must have an odd number of dots, or all an even one, because they are centred.");
    }
    const count = rows.reduce((sum, row) => sum + row, 0);
    if (count > most_gaps) throw tooLarge();
    const dots: Point[] = [];
    const begins: number[] = [];
    rows.forEach((length, row) => {
        begins.push(dots.length);
        for (let i = 0; i < length; ++i) dots.push({ x: 2 * i - (length - 1), y: rows.length - 1 - 2 * row });
    });
    const dotAt = (x: number, y: number): number => {
        const row = (rows.length - 1 - y) / 2;
        const column = (x + (rows[row] ?? 0) - 1) / 2;
        return rows[row] !== undefined && Number.isInteger(column) && column >= 0 && column < rows[row]
            ? begins[row] + column
            : -1;
    };
    const gaps: Gap[] = [];
    const gapAt = new Int32Array(4 * count).fill(-1);
    const add = (from: number, to: number, side: number): void => {
        gapAt[4 * from + side] = gapAt[4 * to + ((side + 2) % 4)] = gaps.length;
        gaps.push({ from, to, side, x: (dots[from].x + dots[to].x) / 2, y: (dots[from].y + dots[to].y) / 2 });
    };
    rows.forEach((length, row) => {
        const begin = begins[row];
        for (let dot = begin; dot + 1 < begin + length; ++dot) add(dot, dot + 1, 0);
        for (let dot = begin; dot < begin + length; ++dot) {
            const below = dotAt(dots[dot].x, dots[dot].y - 2);
            if (below >= 0) add(dot, below, 3);
        }
    });
    if (gaps.length > most_gaps) throw tooLarge();
    return { rows, dots, gaps, gapAt, dotAt };
}

/// `7x7`, or `1-3-5-3-1`.
export function parseGrid(text: string): DotGrid {
    const clean = text.trim().toLowerCase().replaceAll("×", "x").replaceAll(/\s+/g, "");
    const sides = /^(\d+)x(\d+)$/.exec(clean);
    if (sides) {
        const [rows, columns] = [Number(sides[1]), Number(sides[2])];
        return makeGrid(rows > 0 && rows <= most_gaps ? Array<number>(rows).fill(columns) : []);
    }
    return makeGrid(/^\d+([-,]\d+)*$/.test(clean) ? clean.split(/[-,]/).map(Number) : []);
}

export function gridText({ rows }: DotGrid): string {
    return rows.every((row) => row === rows[0]) ? `${rows.length}x${rows[0]}` : rows.join("-");
}

/// A digit for each gap; each row of gaps is a word, as in the comment of a pattern.
export function crossingsText({ gaps, dots }: DotGrid, states: Uint8Array): string {
    let text = "";
    gaps.forEach((gap, i) => {
        const before = gaps[i - 1];
        if (before && (gap.side !== before.side || dots[gap.from].y !== dots[before.from].y)) text += " ";
        text += states[i];
    });
    return text;
}

export function parseCrossings(grid: DotGrid, text: string): Uint8Array | null {
    const digits = text.replaceAll(/[\s,/]/g, "");
    if (digits.length !== grid.gaps.length || /[^01]/.test(digits)) return null;
    return Uint8Array.from(digits, Number);
}

// --- lines --------------------------------------------------------------------------------------------------------

export interface Lines {
    /// Each line as the midpoints of the sides that it crosses: x, y, x, y …
    strands: number[][];
    lineOfArc: Int32Array; // by 4 * dot + arc
}

export function followLines(grid: DotGrid, states: Uint8Array): Lines {
    const { dots, gaps, gapAt } = grid;
    const lineOfArc = new Int32Array(4 * dots.length).fill(-1);
    const strands: number[][] = [];
    for (let start = 0; start < lineOfArc.length; ++start) {
        if (lineOfArc[start] >= 0) continue;
        const points: number[] = [];
        let dot = start >> 2;
        let arc = start & 3;
        let isAnticlockwise = true;
        do {
            lineOfArc[4 * dot + arc] = strands.length;
            const entry = isAnticlockwise ? arc : (arc + 1) & 3;
            points.push(dots[dot].x + side_x[entry], dots[dot].y + side_y[entry]);
            const exit: number = isAnticlockwise ? (arc + 1) & 3 : arc;
            const gap: number = gapAt[4 * dot + exit];
            if (gap >= 0 && states[gap] === crossed) {
                dot = gaps[gap].from === dot ? gaps[gap].to : gaps[gap].from;
                arc = (exit + (isAnticlockwise ? 1 : 2)) & 3;
                isAnticlockwise = !isAnticlockwise;
            } else {
                arc = (arc + (isAnticlockwise ? 1 : 3)) & 3;
            }
        } while (!(4 * dot + arc === start && isAnticlockwise));
        strands.push(points);
    }
    return { strands, lineOfArc };
}

export function countLines(grid: DotGrid, states: Uint8Array): number {
    return followLines(grid, states).strands.length;
}

/// True if two different lines meet in a gap.
export function joinsTwoLines(grid: DotGrid, states: Uint8Array, lines: Lines, index: number): boolean {
    const { from, to, side } = grid.gaps[index];
    const first = lines.lineOfArc[4 * from + side];
    const second =
        states[index] === crossed
            ? lines.lineOfArc[4 * from + ((side + 3) & 3)]
            : lines.lineOfArc[4 * to + ((side + 2) & 3)];
    return first !== second;
}
