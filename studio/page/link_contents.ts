// Checks the values that a link sets on the page. Links are untrusted.
import { isArrangement } from "./arrangements";
import { cameraOf } from "./camera";
import type { Work } from "./context";
import type { ArrangementRequest, Help, Shared } from "./protocol";

function parsed(text: string | undefined): unknown {
    try {
        return JSON.parse(text ?? "null");
    } catch {
        return null;
    }
}

/// A place in the plane; null if the text is none.
export function readPlace(text: string | undefined): Work["place"] {
    const place = parsed(text) as Work["place"];
    const camera = cameraOf(place);
    return place && camera && { x: place.x, y: place.y, scale: camera.scale };
}

/// Reads the names of locked values; an empty list if the text is not a list of strings.
export function readLocked(text: string | undefined): string[] {
    const names = parsed(text);
    return Array.isArray(names) && names.every((name) => typeof name === "string") ? [...new Set(names)] : [];
}

/// An arrangement that is played instead of the pattern; null if the text is not one. Its name has no folders.
export function readArrangement(text: string | undefined): ArrangementRequest | null {
    const { name, text: tables } = (parsed(text) ?? {}) as Partial<Record<keyof ArrangementRequest, unknown>>;
    const isName = typeof name === "string" && /^[^./\\\p{C}][^/\\\p{C}]{0,200}$/u.test(name);
    return isName && typeof tables === "string" && isArrangement(tables) ? { name, text: tables } : null;
}

/// The names of options that no option of the program has.
export function unknownOptions(contents: Shared, help: Pick<Help, "draw" | "play">): string[] {
    return (["draw", "play"] as const).flatMap((interpreter) => {
        const known = new Set(help[interpreter].options.map((option) => option.name));
        return (contents[interpreter] ?? []).map(([name]) => name).filter((name) => !known.has(name));
    });
}

/// The beginning of a text, and how many characters follow it.
export function excerpt(text: string, most: number): { text: string; rest: number } {
    if (text.length <= most) return { text, rest: 0 };
    const end = /[\ud800-\udbff]/.test(text[most - 1]!) ? most - 1 : most; // no half of a character
    return { text: `${text.slice(0, end)}…`, rest: text.length - end };
}
