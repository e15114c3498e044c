// The bundled patterns and arrangements, a dozen picked ones first, with pictures that are drawn when they scroll into
// view.
import { openArrangement } from "./arrangements";
import { type MakePanel, RequestFailed, type Studio } from "./context";
import { button, choices, element } from "./elements";
import { given_kind, openGiven } from "./given";
import { askForFile } from "./open_file";
import { openPattern } from "./opening";
import { kindName, kinds as usualKinds, picked } from "./picked";
import { drawInto } from "./pictures";
import type { ArrangementEntry, Options, PatternEntry } from "./protocol";

const picture_size = 256; // pixels
const square_page: Options = [["size", "120x120mm"], ["margin", "6mm"]];

// A rank for sorting: kinds in the usual order, the user's own first.
function rank(kind: string): number {
    const at = usualKinds.indexOf(kind);
    return kind === given_kind ? -1 : at < 0 ? usualKinds.length : at;
}

function captioned(picture: HTMLElement, title: string, facts: string, source: string): HTMLButtonElement {
    const caption = element("span", { class: "caption" }, element("strong", {}, title), element("small", {}, facts));
    return element("button", { type: "button", class: "card", title: source }, picture, caption);
}

const containsAll = (text: string, words: string[]) => words.every((word) => text.toLowerCase().includes(word));

/// A card of a pattern.
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
        const facts = [kindName(entry.kind), entry.is_spatial ? "in space" : "", entry.is_melody ? "music" : ""]
            .filter(Boolean)
            .join(" · ");
        this.element = captioned(this.canvas, entry.title || entry.name, facts, entry.source);
        this.element.addEventListener("click", () => {
            if (entry.kind === given_kind && openGiven(studio, entry.name)) return;
            const panel = entry.is_spatial ? "space" : entry.is_melody ? "play" : "map";
            openPattern(studio, { name: `${entry.name}.lsys`, text: entry.text }, panel);
        });
    }

    matches(words: string[], kind: string): boolean {
        const { name, title, source, text, is_melody } = this.entry;
        if (kind && kind !== this.entry.kind && !(kind === "music" && is_melody)) return false;
        return containsAll(`${name} ${title} ${source} ${text}`, words);
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

/// A card of an arrangement, which shows the patterns of its parts.
class ArrangementCard {
    readonly element: HTMLButtonElement;

    constructor(
        private readonly entry: ArrangementEntry,
        studio: Studio,
    ) {
        const parts = [...entry.text.matchAll(/^pattern = "(.*)"/gm)].map((each) => each[1]!);
        const words = element("span", { class: "picture words", "aria-hidden": "true" }, parts.join("\n"));
        this.element = captioned(words, entry.title, `arrangement · ${entry.parts} parts`, entry.source);
        this.element.addEventListener("click", () => openArrangement(studio, `${entry.name}.toml`, entry.text));
    }

    matches(words: string[], kind: string): boolean {
        const { name, title, source, text } = this.entry;
        return ["", "arrangements", "music"].includes(kind) && containsAll(`${name} ${title} ${source} ${text}`, words);
    }

    draw(): void {}
}

let choose = (_kind: string): void => {};

/// Shows the patterns of a kind in the gallery; "": all.
export function showKind(kind: string): void {
    choose(kind);
}

export const makeGalleryPanel: MakePanel = (studio) => {
    const patterns = studio.patterns.toSorted((one, other) => rank(one.kind) - rank(other.kind));
    const cards: (Card | ArrangementCard)[] = patterns.map((entry) => new Card(entry, studio));
    const from = patterns.findIndex((entry) => rank(entry.kind) > rank("arrangements"));
    cards.splice(from, 0, ...studio.arrangements.map((entry) => new ArrangementCard(entry, studio)));
    const first = picked
        .map((name) => studio.patterns.find((entry) => entry.name === name))
        .filter((entry) => entry !== undefined)
        .map((entry) => new Card(entry, studio));
    const byElement = new Map<Element, Card | ArrangementCard>([...first, ...cards].map((card) => [card.element, card]));
    const count = cards.length;
    const kinds = [...new Set([...patterns.map((entry) => entry.kind), "arrangements"])].sort(
        (one, other) => rank(one) - rank(other),
    );
    let kind = "";

    const search = element("input", {
        type: "search",
        placeholder: "Search titles, sources and texts",
        "aria-label": "Search patterns",
    });
    choose = (chosen: string) => {
        const label = kindName(chosen) || "all";
        for (const each of chips.children) each.setAttribute("aria-pressed", String(each.textContent === label));
        kind = chosen;
        filter();
    };
    const labels = ["", ...kinds].map((each) => [each, kindName(each) || "all"] as const);
    const chips = choices({ class: "toolbar", "aria-label": "Kinds" }, labels, (chosen) => choose(chosen), "chip");
    const shown = element("p", { class: "gallery-count", role: "status" });
    const grid = element("div", { class: "cards" }, ...cards.map((card) => card.element));
    const beginning = element(
        "section",
        { class: "gallery-first", "aria-label": "To begin with" },
        element("h3", {}, "To begin with"),
        element("div", { class: "cards" }, ...first.map((card) => card.element)),
        element("h3", {}, "All patterns"),
    );
    const filter = () => {
        const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
        let found = 0;
        for (const card of cards) {
            card.element.hidden = !card.matches(words, kind);
            if (!card.element.hidden) ++found;
        }
        beginning.hidden = found !== count;
        shown.textContent =
            found === count
                ? `${patterns.length} patterns, most of them from the literature, and ${count - patterns.length} arrangements`
                : found === 0
                  ? "No pattern matches."
                  : `${found} of ${count} patterns and arrangements`;
    };
    search.addEventListener("input", filter);
    filter();

    const sight = new IntersectionObserver(
        (seen) => {
            for (const { target, isIntersecting } of seen) if (isIntersecting) void byElement.get(target)!.draw(studio);
        },
        { rootMargin: "200px" },
    );
    for (const card of byElement.keys()) sight.observe(card);

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
            beginning,
            grid,
        ),
        show() {},
        hide() {},
    };
};
