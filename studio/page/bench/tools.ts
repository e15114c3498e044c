// The tools above the board: what a click changes.
import { element, icon } from "../elements";
import { crossed, joined, turned } from "./dot_grid";

/// Steps through the states of a gap, sets one of them, or adds and removes dots.
export type Tool = "next" | number | "dots";

const tools: { tool: Tool; label: string; title: string; path: string }[] = [
    {
        tool: "next",
        label: "Next",
        title: "A click changes a gap: crossed, turned back, joined (with Shift backwards)",
        path: "M12.5 5.5A5 5 0 0 0 3.2 7M12.8 2.5v3.2H9.6M3.5 10.5a5 5 0 0 0 9.3-1.5M3.2 13.5v-3.2h3.2",
    },
    { tool: crossed, label: "Cross", title: "A click crosses the lines in a gap", path: "M3 3l10 10M13 3L3 13" },
    {
        tool: turned,
        label: "Turn back",
        title: "A click turns the lines back, each around its dot",
        path: "M3 2.5c4.6 3 4.6 8 0 11M13 2.5c-4.6 3-4.6 8 0 11",
    },
    {
        tool: joined,
        label: "Join",
        title: "A click joins two dots: each line runs past both of them",
        path: "M2.5 3c3 4.6 8 4.6 11 0M2.5 13c3-4.6 8-4.6 11 0",
    },
    {
        tool: "dots",
        label: "Dots",
        title: "A click removes a dot, or adds one",
        path: "M5 8.5h.01M3.6 8.5a1.4 1.4 0 1 0 2.8 0a1.4 1.4 0 1 0-2.8 0M11.5 6v5M9 8.5h5",
    },
];

export class Tools {
    readonly element = element("div", { class: "bench-tools", role: "radiogroup", "aria-label": "What a click does" });
    private readonly buttons = new Map<Tool, HTMLButtonElement>();

    constructor(choose: (tool: Tool) => void) {
        tools.forEach(({ tool, label, title, path }, at) => {
            const made = element("button", { type: "button", class: "bench-tool", role: "radio", title });
            made.append(icon(path), element("span", {}, label));
            made.addEventListener("click", () => choose(tool));
            made.addEventListener("keydown", (event) => {
                const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
                if (by === undefined) return;
                event.preventDefault();
                const next = tools[(at + by + tools.length) % tools.length].tool;
                choose(next);
                this.buttons.get(next)!.focus();
            });
            this.buttons.set(tool, made);
            this.element.append(made);
        });
    }

    update(chosen: Tool): void {
        for (const [tool, made] of this.buttons) {
            made.setAttribute("aria-checked", String(tool === chosen));
            made.tabIndex = tool === chosen ? 0 : -1;
        }
    }
}
