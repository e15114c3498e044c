// The word of a pattern that draws nothing, in place of its picture.
import { isAbort } from "./pictures";
import type { Studio, Work } from "./context";
import { button, element } from "./elements";
import { counted } from "./numbers_shown";
import type { Derived } from "./protocol";

const most_letters = 4000;
const most_seconds = 5;

export interface MapWord {
    readonly element: HTMLElement;
    show(pattern: Work["pattern"]): void;
    hide(): void;
}

export function makeMapWord(studio: Studio): MapWord {
    const head = element("h3", {});
    const text = element("p", { class: "map-word-text mono", tabindex: 0, "aria-label": "Word" });
    const toSteps = button("All steps", () => studio.store.change({ panel: "steps" }));
    const why = element("p", { class: "map-word-why", role: "status" }, "This pattern draws no line, polygon or disc.");
    const top = element("div", { class: "map-word-head" }, head, toSteps);
    const place = element("div", { class: "map-word", hidden: true }, top, text, why);
    let shown: Work["pattern"] | null = null;

    async function derive(pattern: Work["pattern"]): Promise<void> {
        try {
            const asked = { do: "derive", pattern } as const;
            const { json, bytes } = await studio.engine.request<Derived>(asked, { key: "map-word", seconds: most_seconds });
            if (shown !== pattern) return;
            const letters = [...new TextDecoder().decode(bytes).trim()];
            const n = studio.opened?.work.pattern === pattern ? studio.opened.facts.n : "";
            const rest = letters.length - most_letters;
            head.textContent = n === "" ? "The word" : `The word after ${counted(n, "step")}`;
            const more = `${json.is_whole ? counted(rest, "more character") : "more"}`;
            text.textContent = letters.slice(0, most_letters).join("") + (rest > 0 ? ` … and ${more}` : "");
            if (letters.length === 0) text.textContent = "(the empty word)";
            place.hidden = false;
        } catch (error) {
            if (!isAbort(error)) place.hidden = true; // the message says that nothing is drawn
        }
    }

    return {
        element: place,
        show(pattern) {
            if (shown === pattern) return;
            shown = pattern;
            void derive(pattern);
        },
        hide() {
            shown = null;
            place.hidden = true;
        },
    };
}
