// The tools above the board: what a click changes.
import { element, icon } from "../elements";
import { crossed, joined, turned } from "./dot_grid";
import { RadioGroup } from "./radio_group";

/// Steps through the states of a gap, sets one of them, or adds and removes dots.
export type Tool = "next" | number | "dots";

const tools = new Map<Tool, { label: string; title: string; path: string }>([
    ["next", {
        label: "Next",
        title: "A click changes a gap: crossed, turned back, joined (with Shift backwards)",
        path: "M12.5 5.5A5 5 0 0 0 3.2 7M12.8 2.5v3.2H9.6M3.5 10.5a5 5 0 0 0 9.3-1.5M3.2 13.5v-3.2h3.2",
    }],
    [crossed, { label: "Cross", title: "A click crosses the lines in a gap", path: "M3 3l10 10M13 3L3 13" }],
    [turned, {
        label: "Turn back",
        title: "A click turns the lines back, each around its dot",
        path: "M3 2.5c4.6 3 4.6 8 0 11M13 2.5c-4.6 3-4.6 8 0 11",
    }],
    [joined, {
        label: "Join",
        title: "A click joins two dots: each line runs past both of them",
        path: "M2.5 3c3 4.6 8 4.6 11 0M2.5 13c3-4.6 8-4.6 11 0",
    }],
    ["dots", {
        label: "Dots",
        title: "A click removes a dot, or adds one",
        path: "M5 8.5h.01M3.6 8.5a1.4 1.4 0 1 0 2.8 0a1.4 1.4 0 1 0-2.8 0M11.5 6v5M9 8.5h5",
    }],
]);

export function makeTools(choose: (tool: Tool) => void): RadioGroup<Tool> {
    const make = (tool: Tool) => {
        const { label, title, path } = tools.get(tool)!;
        return element("button", { type: "button", class: "bench-tool", title }, icon(path), element("span", {}, label));
    };
    return new RadioGroup({ class: "bench-tools", "aria-label": "What a click does" }, [...tools.keys()], make, choose);
}
