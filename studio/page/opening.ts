// Opens a pattern instead of the present one, which stays in the history.
import { leave } from "./back";
import type { Studio, Work } from "./context";
import { titleOf } from "./pattern_text";
import type { PatternRequest } from "./protocol";

export function openPattern(studio: Studio, opened: PatternRequest, panel = "map", more: Partial<Work> = {}): void {
    const { name, text, variant = "", settings = [] } = opened;
    const pattern = { name, text, variant, settings };
    leave(studio.store.work);
    studio.store.change({ pattern, draw: [], play: [], place: null, locked: [], arrangement: null, ...more });
    studio.store.change({ panel });
    studio.say(`Opened ${titleOf(pattern)}. Undo returns to the previous pattern.`);
}
