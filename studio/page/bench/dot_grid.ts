// Kolams on a grid of dots: the gaps between dots, and the lines that they form. The libraries read the notation of a
// grid; lines are followed here by the rules of art/kolam/dot_grid_lines.h, so that clicks take effect at once.
import type { Dots, SymmetryName } from "../protocol";

/// A gap's state is a number, the digit of the pattern's comment, so that states are a Uint8Array.
export const turned = 0; // the lines turn back, each around its dot
export const crossed = 1; // they cross
export const joined = 2; // each runs past both dots, on its side of the gap
export const state_names = ["turned back", "crossed", "joined"] as const;

const square_ways = [[2, 0], [0, 2], [-2, 0], [0, -2]];
const triangular_ways = [[2, 0], [1, 2], [-1, 2], [-2, 0], [-1, -2], [1, -2]];

/// A place of the lattice: half spacings to the right of the middle, half distances of rows above it.
export interface Place {
    x: number;
    level: number;
}
export interface Gap {
    from: number;
    to: number;
    side: number; // of `from`
    x: number; // where it is drawn, in half spacings, y up
    y: number;
    level: number;
}
export interface GridSymmetry {
    name: SymmetryName;
    orbits: number[][]; // for each gap, the gaps of its orbit, including itself
    obstacle?: string; // why no single line has it
    obstacleIfJoined?: string; // the same if gaps may be joined
}

export interface DotGrid {
    text: string; // canonical notation
    isSolid: boolean; // centred rows without holes
    isTriangular: boolean;
    sides: number; // of a dot, anticlockwise from the right: 4 or 6. Arc s lies between the sides s and s + 1
    rise: number; // half the distance of rows, in half spacings
    rows: number[]; // dots of each row from the top
    dots: Place[];
    gaps: Gap[]; // row by row: those within the row, then those to the next row
    gapAt: Int32Array; // by sides * dot + side, -1 at the border
    symmetries: GridSymmetry[]; // that the grid has, the largest first, `none` last
    gapImages: number[][]; // under each of the grid's rotations and mirrors
    arcImages: number[][];
    moved: Place; // by editing: from the place of a dot before to its place now
}

/// The steps from a dot to its neighbours, by side, as x and level.
export function waysOf({ isTriangular }: Pick<DotGrid, "isTriangular">): number[][] {
    return isTriangular ? triangular_ways : square_ways;
}

export function makeGrid(answer: Dots): DotGrid {
    const isTriangular = answer.lattice === "triangular";
    const sides = isTriangular ? 6 : 4;
    const rise = isTriangular ? Math.sqrt(3) / 2 : 1;
    const dots = answer.dots.map(([x, level]) => ({ x, level }));
    const gapAt = new Int32Array(sides * dots.length).fill(-1);
    const gaps = answer.gaps.map(([from, to, side], index) => {
        gapAt[sides * from + side] = gapAt[sides * to + ((side + sides / 2) % sides)] = index;
        const level = (dots[from].level + dots[to].level) / 2;
        return { from, to, side, x: (dots[from].x + dots[to].x) / 2, y: level * rise, level };
    });
    const symmetries = answer.symmetries.map(({ name, orbits, obstacle, joined_obstacle }) => {
        return { name, orbits: members(orbits), obstacle, obstacleIfJoined: joined_obstacle };
    });
    const moved = { x: answer.moved[0], level: answer.moved[1] };
    const { grid: text, is_solid: isSolid, rows, gap_images: gapImages, arc_images: arcImages } = answer;
    const shape = { text, isSolid, isTriangular, sides, rise, rows };
    return { ...shape, dots, gaps, gapAt, symmetries, gapImages, arcImages, moved };
}

function members(orbits: number[]): number[][] {
    const found: number[][] = [];
    orbits.forEach((orbit, gap) => (found[orbit] ??= []).push(gap));
    return orbits.map((orbit) => found[orbit]);
}

/// Shown until the libraries have described a grid.
export const no_grid: DotGrid = makeGrid({
    grid: "",
    lattice: "square",
    rows: [],
    is_solid: true,
    dots: [],
    gaps: [],
    symmetries: [{ name: "none", orbits: [] }],
    gap_images: [],
    arc_images: [],
    moved: [0, 0],
});

/// True if a shift takes places of one lattice to places of the other.
export function agrees(a: DotGrid, b: DotGrid, shift: Place): boolean {
    if (a.isTriangular !== b.isTriangular || a.dots.length === 0 || b.dots.length === 0) return false;
    const x = a.dots[0].x + shift.x - b.dots[0].x;
    const level = a.dots[0].level + shift.level - b.dots[0].level;
    return level % 2 === 0 && (x - (a.isTriangular ? level / 2 : 0)) % 2 === 0;
}

/// The digits of a pattern's comment; null if they do not fit the grid.
export function parseStates(grid: DotGrid, text: string): Uint8Array | null {
    const digits = text.replaceAll(/[\s,/]/g, "");
    if (digits.length !== grid.gaps.length || /[^012]/.test(digits)) return null;
    return Uint8Array.from(digits, Number);
}

export const statesText = (states: Uint8Array): string => states.join("");

// --- lines --------------------------------------------------------------------------------------------------------

export interface Lines {
    /// Each line as the midpoints of the sides that it passes: x, y, x, y …
    strands: number[][];
    lineOfArc: Int32Array; // by sides * dot + arc
}

/// A step of a line along an arc of a dot.
export interface Step {
    dot: number;
    arc: number;
    isAnticlockwise: boolean;
}
/// The sides of the dot where a step begins and ends.
export const entryOf = ({ sides }: DotGrid, { arc, isAnticlockwise }: Step): number =>
    isAnticlockwise ? arc : (arc + 1) % sides;
export const exitOf = ({ sides }: DotGrid, { arc, isAnticlockwise }: Step): number =>
    isAnticlockwise ? (arc + 1) % sides : arc;

/// Calls `visit` for each step of a line: along arc `arc` of a dot, from an arc on that it passes anticlockwise.
export function walkLine(
    { gaps, gapAt, sides }: DotGrid,
    states: Uint8Array,
    start: number,
    visit: (dot: number, arc: number, isAnticlockwise: boolean) => void,
): void {
    let dot = Math.floor(start / sides);
    let arc = start % sides;
    let isAnticlockwise = true;
    do {
        visit(dot, arc, isAnticlockwise);
        const exit: number = isAnticlockwise ? (arc + 1) % sides : arc;
        const gap: number = gapAt[sides * dot + exit];
        if (gap < 0 || states[gap] === turned) {
            arc = (arc + (isAnticlockwise ? 1 : sides - 1)) % sides;
        } else {
            dot = gaps[gap].from === dot ? gaps[gap].to : gaps[gap].from;
            isAnticlockwise = (states[gap] === crossed) !== isAnticlockwise;
            arc = (exit + sides / 2 + (isAnticlockwise ? 0 : sides - 1)) % sides;
        }
    } while (!(sides * dot + arc === start && isAnticlockwise));
}

export function followLines(grid: DotGrid, states: Uint8Array): Lines {
    const { dots, sides, rise } = grid;
    const ways = waysOf(grid);
    const lineOfArc = new Int32Array(sides * dots.length).fill(-1);
    const strands: number[][] = [];
    for (let start = 0; start < lineOfArc.length; ++start) {
        if (lineOfArc[start] >= 0) continue;
        const points: number[] = [];
        walkLine(grid, states, start, (dot, arc, isAnticlockwise) => {
            lineOfArc[sides * dot + arc] = strands.length;
            const entry = isAnticlockwise ? arc : (arc + 1) % sides;
            points.push(dots[dot].x + ways[entry][0] / 2, (dots[dot].level + ways[entry][1] / 2) * rise);
        });
        strands.push(points);
    }
    return { strands, lineOfArc };
}

/// A number for each line; lines that the drawing's own symmetries take to each other share one, and a colour.
export function lineOrbits(grid: DotGrid, states: Uint8Array, { strands, lineOfArc }: Lines): number[] {
    const parents = strands.map((_, line) => line);
    const first = (line: number): number => {
        let at = line;
        while (parents[at] !== at) at = parents[at];
        return at;
    };
    grid.gapImages.forEach((images, isometry) => {
        if (!states.every((state, gap) => state === states[images[gap]])) return;
        grid.arcImages[isometry].forEach((image, arc) => {
            const [a, b] = [first(lineOfArc[arc]), first(lineOfArc[image])];
            parents[Math.max(a, b)] = Math.min(a, b);
        });
    });
    const numbers = new Map<number, number>();
    return parents.map((_, line) => {
        const root = first(line);
        if (!numbers.has(root)) numbers.set(root, numbers.size);
        return numbers.get(root)!;
    });
}

/// The middles of the fields between four crossed gaps, as crossed_cells() of the libraries finds them.
export function crossedCells(grid: DotGrid, states: Uint8Array): Place[] {
    const { dots, gaps, gapAt, sides, isTriangular } = grid;
    if (isTriangular) return [];
    const [right, down] = [0, 3];
    const gapOf = (dot: number, side: number): number => gapAt[sides * dot + side];
    const isCrossed = (dot: number, side: number): boolean => gapOf(dot, side) >= 0 && states[gapOf(dot, side)] === crossed;
    const beyond = (dot: number, side: number): number => {
        const { from, to } = gaps[gapOf(dot, side)];
        return from === dot ? to : from;
    };
    return dots.flatMap(({ x, level }, dot) => {
        const isCell = isCrossed(dot, right) && isCrossed(dot, down)
            && isCrossed(beyond(dot, right), down) && isCrossed(beyond(dot, down), right);
        return isCell ? [{ x: x + 1, level: level - 1 }] : [];
    });
}

export function countLines(grid: DotGrid, states: Uint8Array): number {
    return followLines(grid, states).strands.length;
}
