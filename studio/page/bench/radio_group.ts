// Radio buttons with icons. The arrow keys choose among those that are not hidden.
import { element } from "../elements";

export class RadioGroup<Name> {
    readonly element: HTMLElement;
    readonly buttons: ReadonlyMap<Name, HTMLButtonElement>;

    constructor(
        attributes: { class: string; "aria-label": string },
        names: readonly Name[],
        make: (name: Name) => HTMLButtonElement,
        private readonly choose: (name: Name) => void,
    ) {
        this.buttons = new Map(names.map((name) => [name, make(name)]));
        this.element = element("div", { role: "radiogroup", ...attributes }, ...this.buttons.values());
        for (const [name, made] of this.buttons) {
            made.setAttribute("role", "radio");
            made.addEventListener("click", () => choose(name));
            made.addEventListener("keydown", (event) => this.move(event, name));
        }
    }

    private move(event: KeyboardEvent, from: Name): void {
        const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
        if (by === undefined) return;
        event.preventDefault();
        const offered = [...this.buttons].filter(([, each]) => !each.hidden);
        const at = offered.findIndex(([name]) => name === from);
        const [next, made] = offered[(at + by + offered.length) % offered.length];
        this.choose(next);
        made.focus();
    }

    update(chosen: Name): void {
        for (const [name, made] of this.buttons) {
            made.setAttribute("aria-checked", String(name === chosen));
            made.tabIndex = name === chosen ? 0 : -1;
        }
    }
}
