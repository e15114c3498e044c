// Patterns that `sikku studio PATTERN…` wrote into the page.
import type { Studio } from "./context";
import { byId } from "./elements";
import { openPattern } from "./opening";
import { titleOf } from "./pattern_text";
import type { Options, PatternEntry, PatternRequest } from "./protocol";

type Given = PatternRequest & { draw?: Options; play?: Options };

export const given_kind = "yours"; // beside `kolams`, `plants`

const list = (): Given[] => JSON.parse(byId("sikku-patterns").textContent || "[]") as Given[];

/// Returns the given patterns as entries of the gallery.
export function givenEntries(): PatternEntry[] {
    return list().map((given) => ({
        name: given.name.replace(/\.lsys$/, ""),
        kind: given_kind,
        title: titleOf(given),
        source: "",
        text: given.text,
        is_melody: false,
        is_spatial: false,
    }));
}

/// Opens one of them with its values and options. False if none has the name.
export function openGiven(studio: Studio, name: string): boolean {
    const given = list().find((each) => each.name.replace(/\.lsys$/, "") === name);
    if (!given) return false;
    openPattern(studio, given, "map", { draw: given.draw ?? [], play: given.play ?? [] });
    return true;
}
