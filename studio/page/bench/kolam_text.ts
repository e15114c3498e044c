// Reads the kolam of the bench from the text of a pattern, and keeps what the user edited there.

const dots_line = "dots: 0.2 step #fffaf0";
const fields_line = "fields: chessboard";

/// The text with keys for the dots and the filled fields that are wanted.
export function withLook(text: string, look: { hasDots: boolean; isFilled: boolean }): string {
    const lines = [...(look.hasDots ? [dots_line] : []), ...(look.isFilled ? [fields_line] : [])];
    return lines.length > 0 ? [text.trimEnd(), ...lines, ""].join("\n") : text;
}

export interface ReadKolam {
    grid: string; // its notation
    gaps: string; // digits
    isColoured: boolean;
    hasDots: boolean;
    isFilled: boolean;
}

/// The grid and the states of its gaps, if the libraries made the text.
export function readKolam(text: string): ReadKolam | null {
    const found = comments(text) ?? olderComments(text);
    if (!found) return null;
    const palette = /^palette:(.*)$/m.exec(text)?.[1].trim().split(/\s+/) ?? [];
    const hasDots = /^dots:(?!\s*none)/m.test(text);
    const isFilled = /^fields:\s*chessboard\s*$/m.test(text);
    return { ...found, isColoured: palette.length > 2, hasDots, isFilled };
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

/// Keys that the bench writes; all others belong to the user.
const own_keys = new Set(["title", "description", "derivation length", "angle factor", "heading", "axiom"]);

function otherKeys(text: string): Map<string, string> {
    const found = new Map<string, string>();
    for (const line of text.split("\n")) {
        const key = /^([a-z][a-z ]*?)\s*:/.exec(line)?.[1];
        if (key && !own_keys.has(key)) found.set(key, line);
    }
    return found;
}

/// The new text with the lines that the user edited in the old one. `made`: the old text as written by the libraries;
/// empty if unknown.
export function withEditsOf(old: string, made: string, fresh: string): string {
    const was = otherKeys(made);
    const now = otherKeys(fresh);
    let text = fresh;
    for (const [key, line] of otherKeys(old)) {
        const own = now.get(key);
        if (line === was.get(key) || line === own || line === dots_line || line === fields_line) continue;
        if (key === "palette" && was.get(key) !== own) continue; // the number of lines has changed
        text = own === undefined ? `${text.trimEnd()}\n${line}\n` : text.replace(own, () => line);
    }
    return text;
}
