// Arrangements: several patterns played as one piece. The work keeps its pattern; the view Play plays the arrangement.
import { leave } from "./back";
import type { Studio } from "./context";
import type { ArrangementRequest } from "./protocol";

/// True for the text of an arrangement, which has a line `[[track]]`.
export function isArrangement(text: string): boolean {
    return /^[ \t]*\[\[[ \t]*track[ \t]*\]\]/m.test(text);
}

/// The title of an arrangement, or its name if it has none.
export function titleOfArrangement({ name, text }: ArrangementRequest): string {
    return /^title[ \t]*=[ \t]*"([^"\n]*)"/m.exec(text)?.[1] || name.replace(/\.toml$/i, "");
}

/// Plays an arrangement instead of the pattern, from now on.
export function openArrangement(studio: Studio, name: string, text: string): void {
    const arrangement = { name, text };
    leave(studio.store.work);
    studio.store.change({ arrangement, play: [], panel: "play" });
    studio.say(`Opened ${titleOfArrangement(arrangement)}. Undo returns to the pattern.`);
}
