// Explains L-systems and n, in one sentence each, beside the places where they appear.
import { button, element } from "./elements";
import { remember, remembered } from "./storage";

const storage_key = "sikku-studio-explained";

/// The sentence below the text, until it is closed. @param start  starts the guide
export function makeExplanation(start: () => void): HTMLElement {
    const close = button(
        "Hide this explanation",
        () => {
            remember(storage_key, true);
            strip.hidden = true;
        },
        { kind: "quiet", icon: "M4 4l8 8m0-8l-8 8" },
    );
    const guide = element("button", { type: "button", class: "as-link" }, "Show me");
    guide.addEventListener("click", start);
    const strip = element(
        "div",
        { class: "explanation", hidden: remembered(storage_key, false) },
        element(
            "p",
            {},
            "This is an L-system: a first word (",
            element("code", {}, "axiom"),
            "), and productions (",
            element("code", {}, "-->"),
            ") that replace its letters again and again. The letters of the last word move a pen. ",
            guide,
        ),
        close,
    );
    return strip;
}

/// The sentence for n. @param isMap  its cells are divided instead
export function whatIsN(isMap: boolean): string {
    return isMap ? "divides all cells n times" : "replaces all letters n times";
}
