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

/// Makes a button with a text, or with an icon and a text for screen readers and the tooltip.
export function button(
    label: string,
    act: (event: MouseEvent) => void,
    options: { kind?: string; icon?: string; shows?: boolean } = {},
): HTMLButtonElement {
    const made = element("button", { type: "button", class: `button ${options.kind ?? ""}`.trim() });
    if (options.icon) {
        made.append(icon(options.icon));
        if (options.shows) made.append(element("span", {}, label));
        else made.classList.add("icon");
        if (!options.shows) made.setAttribute("aria-label", label);
        made.title = label;
    } else {
        made.append(label);
    }
    made.addEventListener("click", act);
    return made;
}
