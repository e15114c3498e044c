// The colours of stroke and ground.
import type { Application } from "./application";
import { element } from "./elements";
import { plainGround } from "./floors";
import { optionOf } from "./options";
import { valueInText } from "./pattern_text";
import type { Opened } from "./protocol";
import { joinedStroke, splitStroke } from "./stroke";

// A CSS colour as #rrggbb; null if it is not a colour.
function plain(colour: string): string | null {
    if (!CSS.supports("color", colour)) return null;
    const context = document.createElement("canvas").getContext("2d")!;
    context.fillStyle = colour;
    return /^#[\da-f]{6}$/.test(context.fillStyle) ? context.fillStyle : null;
}

export function makeColours(application: Application): { element: HTMLElement; update(facts: Opened): void } {
    const { store } = application;
    const value = (name: string, absent: string) =>
        optionOf(store.work.pattern.settings, name) ?? valueInText(store.work.pattern, name) ?? absent;

    const field = (id: string, label: string, write: (colour: string) => void) => {
        const input = element("input", { type: "color", id });
        input.addEventListener("input", () => write(input.value));
        return { input, row: element("div", { class: "colour-field" }, input, element("label", { for: id }, label)) };
    };
    const stroke = field("stroke-colour", "Stroke", (colour) => {
        const { width, unit } = splitStroke(value("stroke", "0.4mm black"));
        store.setting("stroke", joinedStroke(width || "0.4", unit, colour), "setting stroke colour");
    });
    const ground = field("ground-colour", "Ground", (colour) => store.setting("ground", colour, "setting ground"));

    return {
        element: element(
            "div",
            { class: "colour-row", role: "group", "aria-label": "Colours" },
            stroke.row,
            ground.row,
        ),
        update() {
            stroke.input.value = plain(splitStroke(value("stroke", "0.4mm black")).rest || "black") ?? "#000000";
            ground.input.value = plain(plainGround(value("ground", "white"))) ?? "#ffffff";
        },
    };
}
