// The derivation step by step: the word of each derivation length beside its picture, with the letters that the next
// step replaces, and what they become.
import type { MakePanel, Studio, Work } from "./context";
import { button, element } from "./elements";
import { counted } from "./numbers_shown";
import { withOption } from "./options";
import { drawInto, isAbort } from "./pictures";
import type { Derived, Opened, Options } from "./protocol";
import { partsOf, plainProductions } from "./steps/rewriting";
import { isAnother } from "./versions";

const most_rows = 12;
const longest = 4000; // letters of the last word that is shown
const most_letters = 500; // shown of each
const picture_size = 220; // pixels
const square_page: Options = [["size", "120x120mm"], ["margin", "6mm"]];

interface Row {
    element: HTMLElement;
    canvas: HTMLCanvasElement;
    word: string;
    letters: HTMLElement[]; // of the shown beginning
}

function withLength(pattern: Work["pattern"], n: number): Work["pattern"] {
    return { ...pattern, settings: withOption(pattern.settings, "derivation length", String(n)) };
}

class Steps {
    private isShown = false;
    private isStale = true;
    private generation = 0;
    private stop = new AbortController();
    private readonly intro = element("div", { class: "steps-intro" });
    private readonly list = element("ol", { class: "steps-list" });
    private readonly rest = element("p", { class: "steps-rest", role: "status" });
    readonly element = element("div", { class: "steps-view" }, this.intro, this.list, this.rest);

    constructor(private readonly studio: Studio) {
        studio.onOpened((facts, work) => this.open(facts, work));
        studio.store.subscribe((work, before) => {
            if (isAnother(work.pattern, before.pattern)) this.clear();
        });
    }

    show(): void {
        this.isShown = true;
        const { opened, store } = this.studio;
        if (this.isStale && opened && !isAnother(opened.work.pattern, store.work.pattern)) {
            this.open(opened.facts, opened.work);
        }
    }

    hide(): void {
        this.isShown = false;
    }

    private clear(): void {
        ++this.generation;
        this.stop.abort();
        this.isStale = true;
        this.list.replaceChildren();
        this.rest.textContent = "";
    }

    private open(facts: Opened, work: Work): void {
        if (!this.isShown) {
            this.isStale = true;
            return;
        }
        this.isStale = false;
        this.stop.abort();
        this.stop = new AbortController();
        this.explain(facts);
        void this.derive(facts, work, ++this.generation);
    }

    private explain(facts: Opened): void {
        const rows = facts.productions.slice(0, 8).map(({ predecessor, successor }) => {
            const short = successor.length > 90 ? `${successor.slice(0, 90)}…` : successor;
            return element("li", {}, element("code", {}, `${predecessor} --> ${short}`));
        });
        const more = facts.productions.length - rows.length;
        const what = facts.is_map
            ? "n = 0 is the map at the beginning. Each step divides its cells and replaces its edges, all at once."
            : "n = 0 is the axiom. Each step replaces every letter that has a production, all at once; the others stay.";
        this.intro.replaceChildren(
            element("p", {}, what),
            element("ul", {}, ...rows, ...(more > 0 ? [element("li", {}, `and ${more} more`)] : [])),
        );
    }

    private async derive(facts: Opened, work: Work, generation: number): Promise<void> {
        const productions = plainProductions(work.pattern.text, facts);
        const last = Number(facts.n);
        const rows: Row[] = [];
        let end = "";
        for (let n = 0; n <= Math.min(last, most_rows - 1) && end === ""; ++n) {
            try {
                const pattern = withLength(work.pattern, n);
                const { bytes } = await this.studio.engine.request<Derived>(
                    { do: "derive", pattern },
                    { seconds: 5, signal: this.stop.signal },
                );
                if (generation !== this.generation) return;
                const word = new TextDecoder().decode(bytes).trim();
                const row = this.makeRow(n, word, n < last ? productions : null, facts);
                const before = rows.at(-1);
                const parts = before && productions && partsOf(before.word, word, productions);
                if (before && parts) connect(before, row, parts);
                rows.push(row);
                // The first answer replaces the rows of the text before.
                if (n === 0) this.list.replaceChildren(row.element);
                else this.list.append(row.element);
                void this.draw(row, pattern);
                if (word.length > longest && n < last) end = "The words become too long to read";
            } catch (error) {
                if (isAbort(error) || generation !== this.generation) return;
                end = n === 0 ? "This pattern has no words to show" : "The next word takes too long";
            }
        }
        const shown = rows.length - 1;
        if (end === "" && shown < last) end = "Further steps go on in the same way";
        this.rest.textContent = end === "" ? "" : `${end}: the picture has n = ${last}.`;
    }

    private makeRow(n: number, word: string, productions: ReadonlyMap<string, string> | null, facts: Opened): Row {
        const canvas = element("canvas", { width: picture_size, height: picture_size, "aria-hidden": "true" });
        const points = [...word];
        const letters = points
            .slice(0, most_letters)
            .map((letter) => element("span", productions?.has(letter) ? { class: "replaced" } : {}, letter));
        const rest = points.length - letters.length;
        const text = element(
            "p",
            { class: "steps-word mono" },
            ...letters,
            rest > 0 ? ` … and ${counted(rest, "more character")}` : "",
        );
        if (word === "") text.append("(the empty word)");
        const set = button(`Set n = ${n}`, () => this.studio.store.setting("derivation length", String(n)), {
            kind: "quiet",
        });
        set.hidden = n === Number(facts.n);
        const head = element("div", { class: "steps-head" }, element("h3", {}, `n = ${n}`), set);
        const body = element("div", { class: "steps-body" }, head, text);
        return { element: element("li", {}, canvas, body), canvas, word, letters };
    }

    private async draw(row: Row, pattern: Work["pattern"]): Promise<void> {
        try {
            await drawInto(row.canvas, picture_size, this.studio.engine, pattern, square_page);
            row.canvas.classList.add("drawn");
        } catch {
            // nothing to draw: the axiom is often a letter without meaning for the pen
        }
    }
}

// Marks what the letters of a word become, and shows it while the pointer is over either.
function connect(before: Row, row: Row, parts: string[]): void {
    let at = 0;
    parts.forEach((part, index) => {
        const letter = before.letters[index];
        const made = row.letters.slice(at, (at += [...part].length));
        if (!letter?.classList.contains("replaced")) return;
        for (const each of made) each.classList.add("made");
        made[0]?.classList.add("first");
        made.at(-1)?.classList.add("last");
        const show = (isShown: boolean) => {
            for (const each of [letter, ...made]) each.classList.toggle("pointed", isShown);
        };
        for (const each of [letter, ...made]) {
            each.addEventListener("pointerenter", () => show(true));
            each.addEventListener("pointerleave", () => show(false));
        }
    });
}

export const makeStepsPanel: MakePanel = (studio) => {
    const steps = new Steps(studio);
    return {
        name: "steps",
        label: "Steps",
        element: steps.element,
        show: () => steps.show(),
        hide: () => steps.hide(),
    };
};
