// Makes elements: the only way in which the page turns data into markup.

type Attributes = Record<string, string | number | boolean | null | undefined>;

/// Makes an element with attributes (true: present; false, null: absent) and children; strings become text nodes.
export function element<Name extends keyof HTMLElementTagNameMap>(
    name: Name,
    attributes: Attributes = {},
    ...children: (Node | string)[]
): HTMLElementTagNameMap[Name] {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
        if (value === true) made.setAttribute(key, "");
        else if (value !== false && value !== null && value !== undefined) made.setAttribute(key, String(value));
    }
    made.append(...children);
    return made;
}

/// Finds an element of the page.
export function byId(id: string): HTMLElement {
    return document.getElementById(id)!;
}

/// Makes an icon of 16 x 16 pixels from an SVG path.
export function icon(path: string): SVGSVGElement {
    const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    svg.setAttribute("viewBox", "0 0 16 16");
    svg.setAttribute("aria-hidden", "true");
    const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
    line.setAttribute("d", path);
    svg.append(line);
    return svg;
}

/// Makes a field with its label, which refers to the input by its id.
export function field(label: string, input: HTMLElement, ...more: HTMLElement[]): HTMLElement {
    return element("div", { class: "field" }, element("label", { for: input.id }, label), input, ...more);
}

/// Makes a check box. @param change  is called after each change
export function checkbox(change: (isChecked: boolean) => void, attributes: Attributes = {}): HTMLInputElement {
    const box = element("input", { type: "checkbox", ...attributes });
    box.addEventListener("change", () => change(box.checked));
    return box;
}

/// Puts a check box before its label.
export function labelled(box: HTMLInputElement, label: string): HTMLElement {
    return element("label", { class: "switch" }, box, label);
}

/// Makes a group of buttons of which one is pressed, initially the first.
export function choices<Name extends string>(
    attributes: Attributes, // of the group
    names: readonly (readonly [Name, label: string])[],
    choose: (name: Name) => void,
    kind?: string, // class of the buttons
): HTMLElement {
    const buttons = names.map(([name, label], at) => {
        const made = element("button", { type: "button", class: kind, "aria-pressed": String(at === 0) }, label);
        made.addEventListener("click", () => {
            for (const each of buttons) each.setAttribute("aria-pressed", String(each === made));
            choose(name);
        });
        return made;
    });
    return element("div", { role: "group", ...attributes }, ...buttons);
}

/// Moves a slider to a value. @param said  the value for screen readers
export function slideTo(range: HTMLInputElement, value: number, said?: string): void {
    range.valueAsNumber = value;
    const [least, most] = [Number(range.min), Number(range.max)];
    range.style.setProperty("--at", `${(100 * (range.valueAsNumber - least)) / (most - least || 1)}%`);
    if (said !== undefined) range.setAttribute("aria-valuetext", said);
}

/// Makes a button with a text, or with an icon and a text for screen readers and the tooltip.
export function button(
    label: string,
    act: (event: MouseEvent) => void,
    options: { kind?: string; icon?: string; shows?: boolean } = {},
): HTMLButtonElement {
    const made = element("button", { type: "button", class: `button ${options.kind ?? ""}`.trim() });
    if (options.icon) {
        made.append(icon(options.icon));
        if (options.shows) {
            made.append(element("span", {}, label));
        } else {
            made.classList.add("icon");
            made.setAttribute("aria-label", label);
        }
        made.title = label;
    } else {
        made.append(label);
    }
    made.addEventListener("click", act);
    return made;
}
