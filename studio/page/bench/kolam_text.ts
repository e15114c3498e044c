// Reads the kolam of the bench from the text of a pattern, and keeps what the user edited there.

import type { RimName } from "../protocol";
import { readDoubts } from "./doubts";
import { type GroundName, groundOf, grounds, isGroundLine } from "./grounds";
import { rim_names } from "./rims";

const dots_line = "dots: 0.2 step #fffaf0";
const fields_line = "fields: chessboard";

export interface Look {
    isColoured: boolean;
    isFilled: boolean;
    hasDots: boolean;
    hasCentredDots: boolean; // in fields between four crossed gaps, see crossedCells()
    rim: RimName;
    ground: GroundName;
    hand: number; // 0 to 1
}
export const first_look: Look = {
    isColoured: true,
    isFilled: false,
    hasDots: true,
    hasCentredDots: false,
    rim: "round",
    ground: "earth",
    hand: 0,
};

/// A word written in dots.
export interface Word {
    letters: string; // `/` begins a new line
    rows: number; // of dots, of a capital letter
}
export const usual_rows = 12;
/// The notation of its grid.
export const wordGrid = ({ letters, rows }: Word): string => `text ${rows}:${letters}`;
export const wordTitle = ({ letters }: Word): string => letters.replaceAll("/", " ").trim();

/// Keys by which the looks are read again. The libraries write the colours, the rim and centred dots.
function lookLines({ hasDots, isFilled, hand, ground }: Look): string[] {
    return [
        ...(hasDots ? [dots_line] : []),
        ...(isFilled ? [fields_line] : []),
        ...(hand > 0 ? [`hand: ${hand}`] : []),
        ...(ground === "white" ? [grounds.white.line] : []),
    ];
}

/// The text of the libraries with keys for the look that is wanted, and a comment that names the word of the grid.
export function withLook(text: string, look: Look, word: Word | null = null): string {
    const lines = lookLines(look);
    let made = lines.length > 0 ? [text.trimEnd(), ...lines, ""].join("\n") : text;
    if (look.ground !== "white" && look.ground !== "earth") made = made.replace(/^ground: .*$/m, grounds[look.ground].line);
    // A backslash at the end would continue the comment.
    if (word && !word.letters.includes("\\")) {
        made = made.replace(/^\/\/ gaps:.*$/m, (line) => `${line}\n// letters: ${word.rows} ${word.letters}`);
    }
    return made;
}

export interface ReadKolam extends Look {
    grid: string; // its notation
    gaps: string; // digits
    word: Word | null;
    doubts: string[]; // places of gaps, see gapPlaces()
}

/// The grid and the states of its gaps, if the libraries made the text.
export function readKolam(text: string): ReadKolam | null {
    const found = comments(text) ?? olderComments(text);
    if (!found) return null;
    const palette = /^palette:(.*)$/m.exec(text)?.[1].trim().split(/\s+/) ?? [];
    const letters = /^\/\/ letters: (\d+) (.+)$/m.exec(text);
    return {
        ...found,
        isColoured: palette.length > 2,
        hasDots: /^dots:(?!\s*none)/m.test(text),
        hasCentredDots: /^\/\/ centred dots: yes$/m.test(text),
        isFilled: /^fields:\s*chessboard\s*$/m.test(text),
        rim: rimOf(text),
        ground: groundOf(text),
        hand: Math.min(1, Number(/^hand:\s*(\d*\.?\d+)\s*$/m.exec(text)?.[1] ?? 0)),
        word: letters && { rows: Number(letters[1]), letters: letters[2] },
        doubts: readDoubts(text),
    };
}

/// The command that made a kolam. It no longer makes it after an edit.
const command_line = /^source:\s*sikku kolam .*$/m;

/// The rim that the libraries name, or the command in patterns of the kolam library. Commands behind the axiom were
/// kept by earlier benches, for kolams that were edited.
function rimOf(text: string): RimName {
    const command = command_line.exec(text.split(/^axiom:/m, 1)[0])?.[0] ?? "";
    const name = /^\/\/ rim: (\w+)$/m.exec(text)?.[1] ?? /--rim (\w+)/.exec(command)?.[1];
    return rim_names.find((each) => each === name) ?? "round";
}

type Comments = Pick<ReadKolam, "grid" | "gaps">;

function comments(text: string): Comments | null {
    // Blanks in the drawing of a shape say how its rows are shifted, so only the one behind the colon is skipped.
    const grid = /^\/\/ grid: (.*)$/m.exec(text);
    const gaps = /^\/\/ gaps:([\d ]*)$/m.exec(text);
    return grid && gaps && { grid: grid[1], gaps: gaps[1] };
}

/// Kolams made before there were interlaced grids name the grid only in the title.
function olderComments(text: string): Comments | null {
    const title = /^title:.*?\bon ([\dx-]+) dots/m.exec(text);
    const crossings = /^\/\/ crossings:([\d ]*)$/m.exec(text);
    // Numbers were rows from the top; two numbers with a dash now are the longest row and the last.
    return title && crossings && { grid: title[1].replaceAll("-", ","), gaps: crossings[1] };
}

/// Keys that the libraries write; all others belong to the user.
const own_keys = new Set(["title", "description", "derivation length", "angle factor", "heading", "axiom"]);

function otherKeys(text: string): Map<string, string> {
    const found = new Map<string, string>();
    for (const line of text.split("\n")) {
        const key = /^([a-z][a-z ]*?)\s*:/.exec(line)?.[1];
        if (key && !own_keys.has(key)) found.set(key, line);
    }
    return found;
}

/// True for a line that the bench writes. Another line for the hand belongs to the bench, too, which reads its value.
const isOurs = (line: string): boolean =>
    line === dots_line || line === fields_line || isGroundLine(line) || /^hand:\s*\d*\.?\d+\s*$/.test(line);

/// The new text with the lines that the user edited in the old one. `made`: the old text as written by the libraries;
/// empty if unknown.
export function withEditsOf(old: string, made: string, fresh: string): string {
    const was = otherKeys(made);
    const now = otherKeys(fresh);
    let text = fresh;
    for (const [key, line] of otherKeys(old)) {
        const own = now.get(key);
        if (line === was.get(key) || line === own || isOurs(line) || command_line.test(line)) continue;
        if (key === "ground" && own !== grounds.earth.line) continue; // a floor was chosen
        if (key === "palette" && was.get(key) !== own) continue; // the number of lines has changed
        text = own === undefined ? `${text.trimEnd()}\n${line}\n` : text.replace(own, () => line);
    }
    return text;
}
