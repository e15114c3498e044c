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

const long_help = 90; // characters
const usual_sizes: readonly [value: string, label: string][] = [
    ["A6", "A6 (postcard)"], ["A5", "A5"], ["A3", "A3"], ["A2", "A2"], ["A1", "A1"], ["A0", "A0"],
    ["letter", "Letter"], ["legal", "Legal"], ["tabloid", "Tabloid"],
    ["30x30cm", "30 × 30 cm"], ["30x40cm", "30 × 40 cm"], ["50x70cm", "50 × 70 cm"], ["100x150mm", "100 × 150 mm"],
];

const shownName = (name: string): string => capital(name.replaceAll("-", " "));

/// The help without the names of the command line: `'step' sets …` becomes “Step” sets …
export function plainHelp(help: string, names: ReadonlySet<string>): string {
    return help
        .replaceAll(/--([a-z][a-z-]*)/g, (whole, name: string) => (names.has(name) ? `“${shownName(name)}”` : whole))
        .replaceAll(/'([a-z][a-z-]*)'/g, (whole, name: string) => (names.has(name) ? `“${shownName(name)}”` : whole));
}

/// The beginning of a help text, which says what the option does, and the rest, which may be empty.
export function dividedHelp(help: string): [string, string] {
    if (help.length <= long_help) return [help, ""];
    const end = /^.{8,}?(?=[;:] |, or )/.exec(help)?.[0].length ?? help.lastIndexOf(" ", long_help);
    return [help.slice(0, end), help.slice(end).replace(/^[;:,]?\s*/, "")];
}

// A help text; the rest of a long one is shown on demand. Empty if it only repeats the name: `landscape page`.
function helpElement(help: string, name: string, id: string): HTMLElement {
    if (help.toLowerCase() === `${name} page`) return element("p", { class: "option-help", id, hidden: true }, capital(help));
    const [first, rest] = dividedHelp(help);
    if (rest === "") return element("p", { class: "option-help", id }, capital(help));
    return element(
        "details",
        { class: "option-help", id },
        element("summary", {}, `${capital(first)} …`),
        element("p", {}, capital(rest)),
    );
}

// The usual sizes of paper, and a field for others.
function sizeField(input: HTMLInputElement, value: string, act: (value: string | null) => void): HTMLElement {
    const other = "other";
    const select = element(
        "select",
        {},
        element("option", { value: "" }, "A4"),
        ...usual_sizes.map(([each, label]) => element("option", { value: each }, label)),
        element("option", { value: other }, "Other…"),
    );
    const known = usual_sizes.find(([each]) => each.toLowerCase() === value.toLowerCase());
    select.value = value === "" || value.toLowerCase() === "a4" ? "" : (known?.[0] ?? other);
    input.hidden = select.value !== other;
    input.placeholder = "width x height, such as 50x70cm";
    input.setAttribute("aria-label", "Other size");
    select.addEventListener("change", () => {
        input.hidden = select.value !== other;
        if (input.hidden) act(select.value || null);
        else input.focus();
    });
    return select;
}

/// The field of one option; `value` is undefined if the option is not set.
export function optionField(
    option: OptionHelp,
    value: string | undefined,
    act: OptionAct,
    names: ReadonlySet<string> = new Set(),
): HTMLElement {
    const field = plainField(option, value, act, names);
    field.dataset["option"] = option.name;
    return field;
}

function plainField(option: OptionHelp, value: string | undefined, act: OptionAct, names: ReadonlySet<string>): HTMLElement {
    const id = `option-${++last}`;
    const name = shownName(option.name);
    const help = helpElement(plainHelp(option.help, names), option.name, `${id}-help`);
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
    if (option.name === "size" && input instanceof HTMLInputElement) {
        const select = sizeField(input, value ?? "", (chosen) => act(option.name, chosen));
        select.id = id;
        input.removeAttribute("id");
        input.setAttribute("list", `${id}-list`);
        input.before(select);
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
    const names = new Set(options.map(({ name }) => name));
    return [...groups].map(([group, members]) => {
        const fields = members.map((option) => optionField(option, optionOf(values, option.name), act, names));
        const set = members.filter((option) => optionOf(values, option.name) !== undefined).length;
        return element(
            "details",
            { class: "group", "data-group": group },
            element("summary", {}, capital(group) + (set > 0 ? ` (${set} set)` : "")),
            element("div", { class: "fields" }, ...fields),
        );
    });
}

/// Hides the fields of options that cannot be used, and groups without other fields. Options that are set stay.
export function showFit(groups: HTMLElement, unfit: ReadonlySet<string>, values: Options): void {
    for (const group of groups.children as Iterable<HTMLElement> & HTMLCollection) {
        const fields = [...group.querySelectorAll<HTMLElement>("[data-option]")];
        for (const field of fields) {
            const name = field.dataset["option"]!;
            field.hidden = unfit.has(name) && optionOf(values, name) === undefined && !field.contains(document.activeElement);
        }
        (group as HTMLElement).hidden = fields.length > 0 && fields.every((field) => field.hidden);
    }
}
