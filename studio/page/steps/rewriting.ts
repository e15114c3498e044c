// How one word becomes the next: which part of it comes from which letter. Only for productions that need nothing but
// the letter itself; others depend on neighbours, parameters, chance or tables.
import type { Opened } from "../protocol";

/// The productions of a pattern by letter; null if they depend on more than the letter.
export function plainProductions(text: string, facts: Opened): Map<string, string> | null {
    if (facts.is_map || facts.is_random || facts.keys.some(({ name }) => name === "mirror")) return null;
    const lines = text.split("\n");
    const found = new Map<string, string>();
    for (const { line, predecessor, successor, table } of facts.productions) {
        if (table === "interpret") continue; // for the pen only
        const letter = predecessor.trim();
        // The left side, which may have contexts and a condition, is the letter alone.
        const isAlone = lines[line - 1]?.split("-->", 1)[0]!.trim() === letter;
        if (!isAlone || [...letter].length !== 1 || table !== "" || found.has(letter) || /[()]/.test(successor)) return null;
        found.set(letter, successor.replace(/\s+/g, ""));
    }
    return found.size > 0 ? found : null;
}

/// The parts of the next word that the letters of a word become; null if the next word is another.
export function partsOf(word: string, next: string, productions: ReadonlyMap<string, string>): string[] | null {
    const parts = [...word].map((letter) => productions.get(letter) ?? letter);
    return parts.join("") === next ? parts : null;
}
