// Writes the kolam of the bench into the text of a pattern, and reads it back.
import type { DotGrid } from "./dot_grid";
import { gridText, parseCrossings, parseGrid } from "./dot_grid";

const dots_line = "dots: 0.2 step #fffaf0";

/// The text with dots added if wanted.
export function withDots(text: string, hasDots: boolean): string {
    return hasDots ? `${text.trimEnd()}\n${dots_line}\n` : text;
}

export const kolamTitle = (grid: DotGrid): string => `Kolam on ${gridText(grid)} dots`;

export interface ReadKolam {
    grid: DotGrid;
    states: Uint8Array;
    isColoured: boolean;
    hasDots: boolean;
}

/// The grid and its crossings, if the bench made the text.
export function readKolam(text: string): ReadKolam | null {
    const title = /^title:.*?\bon ([\dx-]+) dots/m.exec(text);
    const crossings = /^\/\/ crossings:([\d ]*)$/m.exec(text);
    if (!title || !crossings) return null;
    try {
        const grid = parseGrid(title[1]);
        const states = parseCrossings(grid, crossings[1]);
        const palette = /^palette:(.*)$/m.exec(text)?.[1].trim().split(/\s+/) ?? [];
        const hasDots = /^dots:(?!\s*none)/m.test(text);
        return states && { grid, states, isColoured: palette.length > 2, hasDots };
    } catch {
        return null; // the title was edited
    }
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
        if (line === was.get(key) || line === own || line === dots_line) continue;
        if (key === "palette" && was.get(key) !== own) continue; // the number of lines has changed
        text = own === undefined ? `${text.trimEnd()}\n${line}\n` : text.replace(own, () => line);
    }
    return text;
}
