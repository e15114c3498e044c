// Gaps that a photograph does not show clearly: `sikku kolam --read` lists them in a comment of the pattern, by row and
// number (art/reading/kolam_report.h).
import type { DotGrid } from "./dot_grid";

const heading = "// doubtful gaps, as row,gap:";
const most_listed = 200;
const in_line = 16;

/// The place of each gap for users: `3,4` is the fourth gap of the third row. Rows of gaps count from the top: those
/// within a row of dots, then those to the next row.
export function gapPlaces({ gaps, dots }: DotGrid): string[] {
    let [row, number] = [1, 0];
    return gaps.map(({ from, side }, i) => {
        const before = gaps[i - 1];
        const isNext = before && ((side === 0) !== (before.side === 0) || dots[from].level !== dots[before.from].level);
        [row, number] = isNext ? [row + 1, 1] : [row, number + 1];
        return `${row},${number}`;
    });
}

/// The places in the comment of a pattern; none without the comment.
export function readDoubts(text: string): string[] {
    const found = new RegExp(`^${heading}((?:\n//(?: \\d+,\\d+)+)*)`, "m").exec(text);
    return found?.[1].match(/\d+,\d+/g) ?? [];
}

/// The comment; empty if no gap is doubtful.
export function doubtsText(grid: DotGrid, doubts: ReadonlySet<number>): string {
    const places = gapPlaces(grid).filter((_, gap) => doubts.has(gap));
    if (places.length === 0) return "";
    let text = heading;
    places.slice(0, most_listed).forEach((place, i) => {
        text += `${i % in_line === 0 ? "\n//" : ""} ${place}`;
    });
    return `\n${text}${places.length > most_listed ? " …" : ""}\n`;
}
