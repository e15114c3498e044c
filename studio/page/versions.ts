// Whether two texts are versions of one pattern, and the names of patterns, which come from their titles.
import { titleIn } from "./pattern_text";

type Named = { name: string; text: string };

const longest_name = 60; // characters
const unnamed = "pattern"; // the name of texts without a title

// The lines that make the pattern; and without the title, which may be edited alone.
function linesOf(text: string): Set<string> {
    const lines = new Set<string>();
    for (const line of text.split("\n")) {
        const content = line.trim();
        if (content !== "" && !/^title[ \t]*:/.test(content)) lines.add(content);
    }
    return lines;
}

let last: { one: Named; other: Named; isAnother: boolean } | null = null; // each view asks about the same change

/// True if one text is not an edited version of the other: most lines differ, or the title and other lines do.
/// Under the same title another name also indicates another pattern, because an edit changes the name only with
/// the title.
export function isAnother(one: Named, other: Named): boolean {
    if (one.text === other.text) return false;
    if (last?.one !== one || last.other !== other) last = { one, other, isAnother: compare(one, other) };
    return last.isAnother;
}

function compare(one: Named, other: Named): boolean {
    const [few, many] = [linesOf(one.text), linesOf(other.text)].sort((a, b) => a.size - b.size) as [
        Set<string>,
        Set<string>,
    ];
    let common = 0;
    for (const line of few) if (many.has(line)) ++common;
    if (titleIn(one.text) !== titleIn(other.text)) return common < many.size;
    return one.name !== other.name || common * 2 < few.size || (few.size === 0 && many.size > 0);
}

/// A name for a file, with the letters of every script: `hilbert-curve` for "Hilbert curve".
export function fileName(title: string): string {
    const words = title.normalize("NFC").toLowerCase().match(/[\p{L}\p{M}\p{N}]+/gu) ?? [];
    return [...words.join("-")].slice(0, longest_name).join("").replace(/-$/, "");
}

/// The pattern with the name that its text has after an edit: the same while the title stays, otherwise that of the
/// title. A pattern that was opened under a name of its own keeps it.
export function renamed<Pattern extends Named>(pattern: Pattern, before: Named): Pattern {
    if (pattern.name !== before.name || pattern.text === before.text) return pattern;
    const title = titleIn(pattern.text);
    if (title === titleIn(before.text) && !isAnother(pattern, before)) return pattern;
    return { ...pattern, name: `${fileName(title) || unnamed}.lsys` };
}
