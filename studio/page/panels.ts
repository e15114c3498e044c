// The tabs, and the panels below them. If a panel fails, the others still work.
import type { MakePanel, Panel, Studio } from "./context";
import { byId, element } from "./elements";

export class Panels {
    private readonly panels: Panel[] = [];
    private shown: Panel | null = null;

    constructor(private readonly studio: Studio) {
        studio.store.subscribe((work) => this.choose(work.panel));
    }

    /// Builds panels, and shows that of the work, or the first one.
    build(makers: MakePanel[]): void {
        for (const note of byId("panels").querySelectorAll(":scope > .empty, :scope > .broken")) note.remove();
        for (const make of makers) {
            try {
                this.add(make(this.studio));
            } catch (error) {
                console.error(error);
                this.studio.say(`One view failed to start: ${String(error)}`, "error");
            }
        }
        byId("panels").querySelector(":scope > .draft")?.remove(); // the map has failed to start
        this.choose(this.studio.store.work.panel);
    }

    private add(panel: Panel): void {
        panel.element.classList.add("panel");
        panel.element.id = `panel-${panel.name}`;
        panel.element.setAttribute("role", "tabpanel");
        panel.element.setAttribute("aria-labelledby", `tab-${panel.name}`);
        panel.element.hidden = true;
        panel.element.prepend(element("h2", { class: "unseen" }, panel.label));
        const tab = element(
            "button",
            {
                type: "button",
                class: "tab",
                role: "tab",
                id: `tab-${panel.name}`,
                "aria-selected": "false",
                "aria-controls": panel.element.id,
                tabindex: -1,
            },
            panel.label,
        );
        tab.addEventListener("click", () => this.studio.store.change({ panel: panel.name }));
        tab.addEventListener("keydown", (event) => this.move(event, panel));
        byId("tabs").append(tab);
        byId("panels").append(panel.element);
        this.panels.push(panel);
    }

    private tab(panel: Panel): HTMLElement {
        return byId(`tab-${panel.name}`);
    }

    private choose(name: string): void {
        const panel = this.panels.find((each) => each.name === name) ?? this.panels[0];
        if (!panel || panel === this.shown) return;
        if (this.shown) {
            this.shown.element.hidden = true;
            this.shown.hide();
        }
        for (const each of this.panels) {
            this.tab(each).setAttribute("aria-selected", String(each === panel));
            this.tab(each).tabIndex = each === panel ? 0 : -1;
        }
        this.tab(panel).scrollIntoView({ block: "nearest", inline: "nearest" });
        this.shown = panel;
        byId("workbench").dataset["panel"] = panel.name;
        panel.element.hidden = false;
        panel.show();
    }

    private move(event: KeyboardEvent, panel: Panel): void {
        const at = this.panels.indexOf(panel);
        const count = this.panels.length;
        const to = { ArrowRight: (at + 1) % count, ArrowLeft: (at + count - 1) % count, Home: 0, End: count - 1 }[
            event.key
        ];
        if (to === undefined) return;
        event.preventDefault();
        const next = this.panels[to]!;
        this.studio.store.change({ panel: next.name });
        this.tab(next).focus();
    }
}
