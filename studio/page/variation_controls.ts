// Controls of variations: the values to keep, and the ranges of the values to vary.
import { element, icon } from "./elements";
import type { Parameter } from "./variants";

export interface AxisChoice {
    readonly parameter: Parameter;
    readonly from: number;
    readonly to: number;
}

const lock = "M4.5 7.5V5.2a3.5 3.5 0 0 1 7 0v2.3M3.5 7.5h9v6.5h-9z";
const longest = 24; // characters of a production

/// A button for each parameter, which locks it.
export function makeLocks(
    parameters: readonly Parameter[],
    kept: ReadonlySet<string>,
    keep: (parameter: Parameter, isKept: boolean) => void,
): HTMLElement {
    const chips = parameters.map((parameter) => {
        const { name, kind, label } = parameter;
        const isKept = kept.has(name);
        const chip = element(
            "button",
            {
                type: "button",
                class: "chip",
                id: `keep-${name.replace(/\W+/g, "-")}`,
                "aria-pressed": String(isKept),
                title: label,
            },
            icon(lock),
            element("span", { class: kind === "production" ? "mono" : "" }, textOf(parameter)),
        );
        chip.addEventListener("click", () => keep(parameter, !isKept));
        return chip;
    });
    return element(
        "div",
        { class: "variations-locks", role: "group", "aria-label": "Keep unchanged" },
        element("span", { class: "variations-word" }, "Keep"),
        ...chips,
    );
}

function textOf({ kind, label, value }: Parameter): string {
    if (kind === "production") return label.length > longest ? `${label.slice(0, longest - 1)}…` : label;
    return label.endsWith("/") ? label + value : `${label} ${value}`;
}

/// A parameter, and its first and last value.
export function makeAxisRow(
    id: string,
    label: string,
    axis: AxisChoice,
    parameters: readonly Parameter[],
    change: (axis: AxisChoice) => void,
): HTMLElement {
    const select = element(
        "select",
        { id: `vary-${id}`, "aria-label": `${label}: value` },
        ...parameters.map(({ name, label: text }) =>
            element("option", { value: name, selected: name === axis.parameter.name }, text),
        ),
    );
    select.addEventListener("change", () =>
        change({ ...axis, parameter: parameters.find(({ name }) => name === select.value) ?? axis.parameter }),
    );
    const end = (name: "from" | "to") => {
        const input = element("input", {
            type: "text",
            inputmode: "decimal",
            class: "number",
            id: `vary-${id}-${name}`,
            value: String(axis[name]),
            "aria-label": `${label}: ${name}`,
        });
        input.addEventListener("change", () => {
            const value = Number(input.value);
            const isWrong = input.value.trim() === "" || !Number.isFinite(value);
            input.setAttribute("aria-invalid", String(isWrong));
            if (!isWrong) change({ ...axis, [name]: value });
        });
        return input;
    };
    const word = (text: string, isRead = true) =>
        element("span", { class: "variations-word", "aria-hidden": isRead ? null : "true" }, text);
    return element("div", { class: "variations-axis" }, word(label), select, end("from"), word("to", false), end("to"));
}
