// Suggestions for curves that give no melody.
import { optionOf, withOption } from "../options";
import type { Options, PatternRequest } from "../protocol";

export interface Remedy {
    label: string;
    options?: Options;
    pattern?: Required<PatternRequest>;
}

/// The pattern with moves (f) replaced by drawn steps (F), without changing places in the text. Null if it already
/// draws, or does not move.
export function withMovesDrawn(pattern: Required<PatternRequest>): Required<PatternRequest> | null {
    let inWord = false;
    let draws = false;
    const lines = pattern.text.split("\n").map((line) => {
        // Productions, the axiom, and the lines that continue them.
        const isWord = /^\s*axiom\s*:|-->/.test(line) || (inWord && /^\s/.test(line));
        inWord = isWord;
        if (!isWord) return line;
        const at = Math.max(0, line.search(/:|-->/));
        const word = line.slice(at);
        draws ||= word.includes("F");
        return line.slice(0, at) + word.replaceAll("f", "F");
    });
    const text = lines.join("\n");
    return draws || text === pattern.text ? null : { ...pattern, text };
}

/// The suggestions for an error, in the order in which they are shown.
export function remediesFor(message: string, pattern: Required<PatternRequest>, options: Options): Remedy[] {
    const found: Remedy[] = [];
    const suggest = (label: string, name: string, value: string) => {
        if (optionOf(options, name) !== value) found.push({ label, options: withOption(options, name, value) });
    };
    if (message.includes("too many voices")) suggest("Play branches one after another", "mapping", "counterpoint");
    if (message.includes("no notes")) {
        const drawn = withMovesDrawn(pattern);
        if (drawn) {
            found.push({ label: "Play moves (f) as if they were drawn (F)", pattern: drawn });
        } else {
            suggest("Play vertical runs", "vertical", "voice");
            suggest("Read symbols as notes", "mapping", "symbols");
        }
    }
    return found;
}
