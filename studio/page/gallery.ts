// The bundled patterns, with pictures that are drawn when they scroll into view.
import { type MakePanel, RequestFailed, type Studio } from "./context";
import { button, choices, element } from "./elements";
import { given_kind, openGiven } from "./given";
import { askForFile } from "./open_file";
import { openPattern } from "./opening";
import { drawInto } from "./pictures";
import type { Options, PatternEntry } from "./protocol";

const picture_size = 256; // pixels
const square_page: Options = [["size", "120x120mm"], ["margin", "6mm"]];

class Card {
    readonly element: HTMLButtonElement;
    readonly canvas = element("canvas", {
        class: "picture", width: picture_size, height: picture_size, "aria-hidden": "true",
    });
    isDrawn = false;

    constructor(
        readonly entry: PatternEntry,
        studio: Studio,
    ) {
        const facts = [entry.kind, entry.is_spatial ? "in space" : "", entry.is_melody ? "music" : ""]
            .filter(Boolean)
            .join(" · ");
        this.element = element(
            "button",
            { type: "button", class: "card", title: entry.source },
            this.canvas,
            element("span", { class: "caption" }, element("strong", {}, entry.title || entry.name),
                element("small", {}, facts)),
        );
        this.element.addEventListener("click", () => {
            if (entry.kind === given_kind && openGiven(studio, entry.name)) return;
            const panel = entry.is_spatial ? "space" : entry.is_melody ? "play" : "map";
            openPattern(studio, { name: `${entry.name}.lsys`, text: entry.text }, panel);
        });
    }

    matches(words: string[], kind: string): boolean {
        const { name, title, source, text, is_melody } = this.entry;
        if (kind && kind !== this.entry.kind && !(kind === "music" && is_melody)) return false;
        const all = `${name} ${title} ${source} ${text}`.toLowerCase();
        return words.every((word) => all.includes(word));
    }

    // Shows axiom and productions instead of a picture.
    private wordCard(): HTMLElement {
        const lines = this.entry.text
            .split("\n")
            .filter((line) => /-->|^axiom:/.test(line))
            .slice(0, 12);
        return element("span", { class: "picture words", "aria-hidden": "true" }, lines.join("\n"));
    }

    async draw(studio: Studio): Promise<void> {
        if (this.isDrawn) return;
        this.isDrawn = true;
        try {
            const pattern = { name: `${this.entry.name}.lsys`, text: this.entry.text };
            await drawInto(this.canvas, picture_size, studio.engine, pattern, square_page);
            this.canvas.classList.add("drawn");
        } catch (error) {
            if (error instanceof RequestFailed) this.canvas.replaceWith(this.wordCard()); // nothing to draw
            else this.isDrawn = false;
        }
    }
}

export const makeGalleryPanel: MakePanel = (studio) => {
    const cards = studio.patterns.map((entry) => new Card(entry, studio));
    const byElement = new Map<Element, Card>(cards.map((card) => [card.element, card]));
    const kinds = [...new Set(studio.patterns.map((entry) => entry.kind))].sort();
    let kind = "";

    const search = element("input", {
        type: "search",
        placeholder: "Search titles, sources and texts",
        "aria-label": "Search patterns",
    });
    const choose = (chosen: string) => {
        kind = chosen;
        filter();
    };
    const labels = ["", ...kinds].map((each) => [each, each || "all"] as const);
    const chips = choices({ class: "toolbar", "aria-label": "Kinds" }, labels, choose, "chip");
    const shown = element("p", { class: "gallery-count", role: "status" });
    const grid = element("div", { class: "cards" }, ...cards.map((card) => card.element));
    const filter = () => {
        const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
        let count = 0;
        for (const card of cards) {
            card.element.hidden = !card.matches(words, kind);
            if (!card.element.hidden) ++count;
        }
        shown.textContent =
            count === cards.length
                ? `${count} patterns, most of them from the literature`
                : count === 0
                  ? "No pattern matches."
                  : `${count} of ${cards.length} patterns`;
    };
    search.addEventListener("input", filter);
    filter();

    const sight = new IntersectionObserver(
        (seen) => {
            for (const { target, isIntersecting } of seen) if (isIntersecting) void byElement.get(target)!.draw(studio);
        },
        { rootMargin: "200px" },
    );
    for (const card of cards) sight.observe(card.element);

    return {
        name: "gallery",
        label: "Gallery",
        element: element(
            "div",
            { class: "gallery" },
            element(
                "div",
                { class: "gallery-head" },
                search,
                chips,
                shown,
                button("Open a file…", () => askForFile(studio)),
            ),
            grid,
        ),
        show() {},
        hide() {},
    };
};
