// The browser's buttons Back and Forward, which return to the patterns that were open before and after.
import type { Studio, Work } from "./context";

let at = 0; // of the browser's entries that this page has made
let works: Work[] = []; // as they were left, by entry

const entryOf = (state: unknown): number => {
    const entry: unknown = (state as { opened?: unknown } | null)?.opened;
    return typeof entry === "number" ? entry : 0;
};

/// The state of the present entry.
export const presentEntry = () => ({ opened: at });

/// Makes an entry of the browser's history. @param left  the work before a pattern was opened
export function leave(left: Work): void {
    works = [...works.slice(0, at), left];
    ++at;
    history.pushState(presentEntry(), "");
}

/// Returns to earlier and later patterns as steps of their own, so that nothing is lost.
export function watchBack(studio: Studio): void {
    at = entryOf(history.state); // after a reload
    addEventListener("popstate", ({ state }) => {
        if (location.hash !== "") return; // a link
        const entry = entryOf(state);
        if (entry === at) return;
        works[at] = studio.store.work;
        at = entry;
        const work = works[entry];
        if (!work) return; // before the page was loaded again
        studio.store.change({ ...work });
        studio.store.change({ panel: work.panel });
    });
}
