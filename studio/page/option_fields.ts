// Fields for the options of prints and scores, made from the libraries' table of names, values, limits and help.
import { element } from "./elements";
import { capital } from "./numbers_shown";
import { optionOf } from "./options";
import type { OptionHelp, Options } from "./protocol";

export interface OptionAct {
    (name: string, value: string | null): void;
}

let last = 0;

// Help texts end with the default: `page size (A4)`.
function defaultOf(option: OptionHelp): string {
    return option.value.includes(",") ? "" : (/\(([^()]+)\)$/.exec(option.help)?.[1] ?? "");
}

/// The values that the help names: `page size: A0 to A6, letter, legal, or WIDTHxHEIGHT`.
export function namedValues(help: string): string[] {
    const list = /: (.+?),? or /.exec(help)?.[1] ?? "";
    return list.split(", ").flatMap((part) => {
        const range = /^([A-Z]+)(\d+) to \1(\d+)$/.exec(part);
        const letters = /^([A-Za-z]+-)([A-Z]) to \1([A-Z])$/.exec(part);
        const code = (letter: string | undefined): number => (letter ?? "A").charCodeAt(0);
        if (letters) {
            const [first, last] = [code(letters[2]), code(letters[3])];
            return Array.from({ length: last - first + 1 }, (_, at) => letters[1] + String.fromCharCode(first + at));
        }
        if (!range) return part === "" ? [] : [part];
        const [first, last] = [Number(range[2]), Number(range[3])];
        return Array.from({ length: Math.max(0, last - first + 1) }, (_, at) => `${range[1]}${first + at}`);
    });
}

// Values that are listed: `grbl|z`.
function choicesOf(option: OptionHelp): string[] {
    return /^[a-z\d]+(\|[a-z\d]+)+$/.test(option.value) ? option.value.split("|") : [];
}

/// The field of one option; `value` is undefined if the option is not set.
export function optionField(option: OptionHelp, value: string | undefined, act: OptionAct): HTMLElement {
    const id = `option-${++last}`;
    const help = element("p", { class: "option-help", id: `${id}-help` }, capital(option.help));
    const name = capital(option.name.replaceAll("-", " "));
    const onlyValue = /^[a-z]+$/.test(option.value) ? option.value : "";
    const mayBeEmpty = option.value.startsWith("["); // the value may be left out: `--dots`, `--dots=2mm`
    if (option.kind === "flag" || mayBeEmpty || onlyValue !== "") {
        const on = mayBeEmpty ? "" : onlyValue || "true";
        const box = element("input", { type: "checkbox", id, "aria-describedby": help.id });
        box.checked = value === undefined ? option.is_on : value !== "false";
        box.addEventListener("change", () =>
            act(option.name, box.checked === option.is_on ? null : box.checked ? on : "false"),
        );
        const row = element("div", { class: "field" }, element("label", { class: "switch", for: id }, box, name), help);
        if (!mayBeEmpty) return row;
        const detail = element("input", {
            type: "text",
            "aria-label": `${name}, value`,
            placeholder: option.value.slice(1, -1).toLowerCase(),
            spellcheck: "false",
            value: value ?? "",
        });
        detail.addEventListener("change", () => {
            box.checked = true;
            act(option.name, detail.value.trim());
        });
        row.insertBefore(detail, help);
        return row;
    }
    const choices = choicesOf(option);
    const input =
        choices.length > 0
            ? element(
                  "select",
                  { id, "aria-describedby": help.id },
                  ...["", ...choices].map((each) =>
                      element("option", { value: each }, each || defaultOf(option) || "default"),
                  ),
              )
            : element("input", {
                  type: "text",
                  id,
                  placeholder: defaultOf(option),
                  spellcheck: "false",
                  inputmode: option.kind === "text" ? null : "decimal",
                  "aria-describedby": help.id,
              });
    input.value = value ?? "";
    input.addEventListener("change", () => act(option.name, input.value.trim() || null));
    const field = element("div", { class: "field" }, element("label", { for: id }, name), input, help);
    if (option.name === "size") {
        input.setAttribute("list", `${id}-list`);
        field.append(
            element(
                "datalist",
                { id: `${id}-list` },
                ...namedValues(option.help).map((each) => element("option", { value: each })),
            ),
        );
    }
    return field;
}

/// All options in closed groups; the heading of a group shows how many of its options are set.
export function optionGroups(options: OptionHelp[], values: Options, act: OptionAct, first = "Page"): HTMLElement[] {
    const groups = new Map<string, OptionHelp[]>();
    for (const option of options) {
        const group = option.group || first;
        groups.set(group, [...(groups.get(group) ?? []), option]);
    }
    return [...groups].map(([group, members]) => {
        const fields = members.map((option) => optionField(option, optionOf(values, option.name), act));
        const set = members.filter((option) => optionOf(values, option.name) !== undefined).length;
        return element(
            "details",
            { class: "group", "data-group": group },
            element("summary", {}, capital(group) + (set > 0 ? ` (${set} set)` : "")),
            element("div", { class: "fields" }, ...fields),
        );
    });
}
