// The panel with a sheet of variants: other seeds, one value against another, or edited productions. A click uses one.
import { messageOf, type MakePanel, type Studio, type Work } from "./context";
import { button, choices, element } from "./elements";
import { count as digits, counted } from "./numbers_shown";
import { putImage } from "./pictures";
import type { Opened } from "./protocol";
import { filters, searchVariants, type Found, type Tally } from "./sheet_of_variants";
import { makeAxisRow, makeLocks, type AxisChoice } from "./variation_controls";
import {
    mutantOf,
    parametersOf,
    productionsOf,
    rangeOf,
    seedVariant,
    sheetVariants,
    valuesOf,
    type Axis,
    type Parameter,
    type Variant,
} from "./variants";
import { isAnother } from "./versions";

type Mode = "mutations" | "values" | "seeds";

const count = 24;
const columns = 6;
const mostTried = { plain: 480, filtered: 6000 };
const mostTime = { plain: 6_000, filtered: 15_000 }; // milliseconds
const modes: readonly [Mode, string][] = [["mutations", "Mutations"], ["values", "Two values"], ["seeds", "Seeds"]];

export const makeVariationsPanel: MakePanel = (studio) => {
    const variations = new Variations(studio);
    return {
        name: "variations",
        label: "Variations",
        element: variations.element,
        show: () => variations.show(),
        hide: () => variations.hide(),
    };
};

class Variations {
    readonly element = element("div", { class: "variations" });
    private readonly settings = element("div", { class: "variations-settings" });
    private readonly status = element("p", { class: "variations-status", role: "status" });
    private readonly sheet = element("div", { class: "variations-sheet", role: "group", "aria-label": "Variants" });
    private readonly filterChips: { name: string; label: string; chip: HTMLButtonElement }[];
    private readonly filterGroup: HTMLElement;
    private readonly again: HTMLButtonElement;
    private readonly fromHere: HTMLButtonElement;

    private isShown = false;
    private mode: Mode = "mutations";
    private readonly filters = new Set<string>();
    private readonly kept = new Set<string>(["derivation length", "seed"]);
    private readonly axes: { across: AxisChoice | null; down: AxisChoice | null } = { across: null, down: null };
    private base: { facts: Opened; work: Work } | null = null; // what is varied
    private adopted: Work["pattern"] | null = null; // the pattern that this panel put into the work
    private isStale = false; // the sheet is incomplete, or drawn with other options
    private first = 0; // index of the first candidate
    private tried = 0;
    private search: AbortController | null = null;
    private timer = 0;

    constructor(private readonly studio: Studio) {
        const segmented = choices({ class: "segmented", "aria-label": "What varies" }, modes, (mode) => {
            this.mode = mode;
            this.restart();
        });
        this.filterChips = filters.map(({ name, label, help }) => {
            const chip = element(
                "button",
                { type: "button", class: "chip", "aria-pressed": "false", title: help },
                label,
            );
            chip.addEventListener("click", () => {
                if (!this.filters.delete(name)) this.filters.add(name);
                chip.setAttribute("aria-pressed", String(this.filters.has(name)));
                this.restart();
            });
            return { name, label, chip };
        });
        this.filterGroup = element(
            "div",
            { class: "variations-filters", role: "group", "aria-label": "Show only" },
            element("span", { class: "variations-word" }, "Only"),
            ...this.filterChips.map(({ chip }) => chip),
        );
        this.again = button("Next 24", () => this.more());
        this.fromHere = button("Vary the chosen one", () => this.adopt(), { kind: "primary" });
        this.fromHere.hidden = true;
        this.element.append(
            element(
                "div",
                { class: "variations-bar" },
                segmented,
                this.filterGroup,
                element("div", { class: "variations-actions" }, this.status, this.fromHere, this.again),
            ),
            this.settings,
            this.sheet,
        );
        this.sheet.addEventListener("keydown", (event) => this.move(event));
        studio.onOpened((facts, work) => this.opened(facts, work));
        studio.store.subscribe((work, before) => {
            // The variants of another pattern cannot be chosen any more.
            if (isAnother(work.pattern, before.pattern) && work.pattern !== this.adopted) this.setStale(true);
            if (work.draw !== before.draw) this.setDraw(work.draw);
        });
    }

    show(): void {
        this.isShown = true;
        const { opened } = this.studio;
        if (!opened) return;
        if (!this.base || (opened.work.pattern !== this.base.work.pattern && opened.work.pattern !== this.adopted)) {
            this.setBase(opened.facts, opened.work);
        } else if (this.isStale) {
            void this.run();
        }
    }

    hide(): void {
        this.isShown = false;
        clearTimeout(this.timer);
        if (!this.search) return;
        this.search.abort();
        this.search = null;
        this.isStale = true;
    }

    private opened(facts: Opened, work: Work): void {
        if (!this.isShown) return;
        if (work.pattern === this.adopted) {
            this.setStale(false);
            this.fromHere.hidden = false;
            return;
        }
        if (work.pattern === this.base?.work.pattern) {
            this.setStale(false);
            return this.markTaken();
        }
        clearTimeout(this.timer);
        this.timer = window.setTimeout(() => this.setBase(facts, work), 250);
    }

    private setStale(isStale: boolean): void {
        this.sheet.inert = isStale;
        this.sheet.classList.toggle("stale", isStale);
    }

    private setBase(facts: Opened, work: Work): void {
        const isOther = !this.base || isAnother(work.pattern, this.base.work.pattern);
        this.setStale(false);
        this.base = { facts, work };
        this.adopted = null;
        this.fromHere.hidden = true;
        if (isOther) {
            this.kept.clear();
            for (const name of ["derivation length", "seed"]) this.kept.add(name);
            this.axes.across = this.axes.down = null;
        }
        for (const name of work.locked ?? []) this.kept.add(name);
        this.restart();
    }

    // The same variants, drawn differently.
    private setDraw(draw: Work["draw"]): void {
        if (!this.base) return;
        this.base = { ...this.base, work: { ...this.base.work, draw } };
        clearTimeout(this.timer);
        if (this.isShown) this.timer = window.setTimeout(() => void this.run(), 250);
        else this.isStale = true;
    }

    // Varies the chosen variant from now on.
    private adopt(): void {
        const { opened } = this.studio;
        if (opened) this.setBase(opened.facts, opened.work);
        this.sheet.querySelector<HTMLElement>("button")?.focus();
    }

    private restart(): void {
        this.first = 0;
        this.showSettings();
        void this.run();
    }

    private more(): void {
        this.first += Math.max(this.tried, count);
        void this.run();
    }

    // --- what varies

    private showSettings(): void {
        const base = this.base;
        if (!base) return;
        const had =
            document.activeElement instanceof HTMLElement && this.settings.contains(document.activeElement)
                ? document.activeElement.id
                : "";
        this.settings.replaceChildren();
        this.again.hidden = this.mode === "values";
        // Only lines in the plane can be examined.
        const hasLines = !base.facts.is_map && !base.facts.is_spatial;
        this.filterGroup.hidden = !hasLines;
        if (!hasLines && this.filters.size > 0) {
            this.filters.clear();
            for (const { chip } of this.filterChips) chip.setAttribute("aria-pressed", "false");
        }
        if (this.mode === "mutations") {
            const all = [...parametersOf(base.facts), ...productionsOf(base.facts)];
            this.settings.append(makeLocks(all, this.kept, (parameter, isKept) => this.keep(parameter, isKept)));
        }
        if (this.mode === "values") this.settings.append(...this.axisRows(base.facts));
        const seedNote = !base.facts.is_random
            ? "This pattern makes no random choices, so all seeds draw the same. " +
              "Add weights to productions for random choices: F --> FF : 0.8"
            : this.isSeedLocked
              ? "The seed is locked."
              : "";
        if (this.mode === "seeds" && seedNote !== "") this.settings.append(element("p", { class: "note" }, seedNote));
        this.settings.hidden = this.settings.childElementCount === 0;
        if (had !== "") document.getElementById(had)?.focus();
    }

    // Values are locked everywhere, productions only here.
    private keep({ name, kind }: Parameter, isKept: boolean): void {
        if (isKept) this.kept.add(name);
        else this.kept.delete(name);
        if (kind !== "production") {
            const others = (this.studio.store.work.locked ?? []).filter((each) => each !== name);
            this.studio.store.change({ locked: isKept ? [...others, name] : others });
        }
        this.restart();
    }

    private get isSeedLocked(): boolean {
        return this.studio.store.work.locked?.includes("seed") ?? false;
    }

    private axisRows(facts: Opened): HTMLElement[] {
        const locked = this.studio.store.work.locked ?? [];
        const free = parametersOf(facts).filter(({ name }) => !locked.includes(name));
        const parameters = free.length > 0 ? free : parametersOf(facts);
        const preferred = [...parameters].sort((one, other) => rank(one) - rank(other));
        const choice = (old: AxisChoice | null, parameter: Parameter): AxisChoice =>
            parameters.some(({ name }) => name === old?.parameter.name)
                ? old!
                : { parameter, ...rangeOf(parameter, facts.cost.most) };
        this.axes.across = choice(this.axes.across, preferred[0]!);
        this.axes.down = choice(this.axes.down, preferred[1] ?? preferred[0]!);
        const row = (which: "across" | "down", label: string) =>
            makeAxisRow(which, label, this.axes[which]!, parameters, (axis) => {
                const isOther = axis.parameter !== this.axes[which]!.parameter;
                this.axes[which] = isOther ? { ...axis, ...rangeOf(axis.parameter, facts.cost.most) } : axis;
                this.restart();
            });
        return [row("across", "Across"), row("down", "Down")];
    }

    private axis(choice: AxisChoice, most: number): Axis {
        return { parameter: choice.parameter, values: valuesOf(choice.parameter, choice.from, choice.to, most) };
    }

    // --- the sheet

    private async run(): Promise<void> {
        this.search?.abort();
        const search = (this.search = new AbortController());
        this.isStale = false;
        const base = this.base;
        if (!base || !this.isShown) return;
        const { pattern, draw } = base.work;
        const plan = this.plan(base);
        if (!plan) {
            this.sheet.replaceChildren();
            this.status.textContent = "";
            return;
        }
        this.status.textContent = "Searching…";
        const cells = this.prepare(plan.cells, plan.headings);
        const found: Found[] = [];
        let tally: Tally = { tried: 0, undrawn: 0, repeated: 0, refused: new Map() };
        const side = 160;
        const ratio = Math.min(2, Math.max(1, window.devicePixelRatio || 1));
        const start = performance.now();
        const kind = this.filters.size > 0 ? "filtered" : "plain";
        let told = start;
        const add = (one: Found) => {
            if (search.signal.aborted) return;
            found.push(one);
            found.sort((left, right) => left.index - right.index);
            if (plan.isFixed) this.fill(cells[one.index]!, one);
            else found.slice(0, count).forEach((each, at) => this.fill(cells[at]!, each));
        };
        try {
            tally = await searchVariants(this.studio.engine, {
                help: this.studio.help,
                candidates: plan.candidates,
                count: plan.cells,
                most: plan.isFixed ? plan.cells : mostTried[kind],
                milliseconds: mostTime[kind],
                side: Math.round(side * ratio),
                ratio,
                filters: this.filters,
                draw,
                isDistinct: !plan.isFixed && this.mode === "mutations",
                signal: search.signal,
                onFound: add,
                onTried: (count, valid) => {
                    if (search.signal.aborted || performance.now() - told < 400) return;
                    told = performance.now();
                    this.status.textContent = `Searching… ${valid} of ${count} are valid`;
                },
            });
        } catch (error) {
            if (search.signal.aborted) return;
            this.studio.say(`The variants cannot be drawn: ${messageOf(error)}`, "error");
        }
        if (search.signal.aborted) return;
        this.search = null;
        const { tried } = tally;
        this.tried = tried;
        for (const cell of cells) {
            cell.classList.remove("waits");
            if (cell.disabled && !plan.isFixed) cell.remove(); // no empty frames
        }
        const shown = Math.min(found.length, plan.cells);
        this.element.dataset["milliseconds"] = String(Math.round(performance.now() - start));
        this.status.textContent =
            shown === plan.cells
                ? ""
                : shown === 0
                  ? ""
                  : plan.isFixed
                    ? `${shown} of ${plan.cells} are valid`
                    : `${shown} found among ${tried}`;
        if (shown === 0) this.explainNothing(tally);
        this.markTaken(pattern);
        const focused = cells.find((cell) => cell.tabIndex === 0 && !cell.disabled);
        if (!focused) cells.find((cell) => !cell.disabled)?.setAttribute("tabindex", "0");
    }

    // Why there are no variants, and what to do instead of looking at empty frames.
    private explainNothing({ tried, undrawn, repeated, refused }: Tally): void {
        const reasons = [
            ...filters.flatMap(({ name, refused: what }) => {
                const number = refused.get(name) ?? 0;
                return number > 0 ? [`${digits(String(number))} ${what}`] : [];
            }),
            ...(undrawn > 0 ? [`${digits(String(undrawn))} cannot be drawn`] : []),
            ...(repeated > 0 ? [`${digits(String(repeated))} are repetitions`] : []),
        ];
        const head = this.filters.size > 0 ? "No variant passes the filters." : "No variant can be drawn.";
        const why = tried > 0 && reasons.length > 0 ? `Of ${counted(tried, "variant")}: ${reasons.join(", ")}. ` : "";
        const what =
            this.filters.size > 0
                ? "Remove a filter, or search among other variants."
                : this.mode === "mutations"
                  ? "Keep fewer values, or vary two values instead."
                  : this.mode === "values"
                    ? "Choose smaller ranges, or other values."
                    : "Search among other seeds.";
        const most = [...refused].sort((one, other) => other[1] - one[1])[0]?.[0];
        const remedies = this.filterChips
            .filter(({ name }) => this.filters.has(name))
            .map(({ name, label, chip }) =>
                button(`Without “${label}”`, () => chip.click(), { kind: name === most ? "primary" : "" }),
            );
        if (this.mode !== "values") remedies.push(button("Search further", () => this.more()));
        const note = element(
            "div",
            { class: "note variations-nothing", role: "status" },
            element("p", {}, element("strong", {}, head), ` ${why}${what}`),
            element("div", { class: "toolbar" }, ...remedies),
        );
        this.sheet.replaceChildren(note);
    }

    private plan(base: { facts: Opened; work: Work }): Plan | null {
        const {
            facts,
            work: { pattern },
        } = base;
        if (this.mode === "seeds") {
            if (!facts.is_random || this.isSeedLocked) return null;
            const from = BigInt(/^\d+$/.test(facts.seed) ? facts.seed : "0") + BigInt(this.first);
            return { cells: count, isFixed: false, candidates: (index) => [seedVariant(pattern, from, index)] };
        }
        if (this.mode === "mutations") {
            const seed = 1;
            const isAllKept = [...parametersOf(facts), ...productionsOf(facts)].every(({ name }) =>
                this.kept.has(name),
            );
            if (isAllKept) return null;
            return {
                cells: count,
                isFixed: false,
                candidates: (index) => {
                    const mutant = mutantOf(pattern, facts, this.kept, seed, this.first + index);
                    return mutant ? [mutant] : [];
                },
            };
        }
        if (!this.axes.across || !this.axes.down) return null;
        const across = this.axis(this.axes.across, columns);
        const down = this.axis(this.axes.down, count / columns);
        const wide = across.values.length;
        return {
            cells: wide * down.values.length,
            isFixed: true,
            headings: { across, down },
            candidates: (index) => sheetVariants(pattern, across, down, index % wide, Math.floor(index / wide)),
        };
    }

    // Empty cells, so that nothing moves while pictures arrive.
    private prepare(cells: number, headings?: Plan["headings"]): HTMLButtonElement[] {
        this.sheet.classList.toggle("of-values", !!headings);
        this.sheet.style.setProperty("--columns", String(headings ? headings.across.values.length : columns));
        const made = Array.from({ length: cells }, (_, index) => {
            const cell = element(
                "button",
                { type: "button", class: "card variant waits", disabled: true, tabindex: index === 0 ? 0 : -1 },
                element("canvas", { class: "picture", width: 1, height: 1, "aria-hidden": "true" }),
                element("span", { class: "caption", "aria-hidden": "true" }, "\u00a0"),
                element("span", { class: "unseen" }, "Not drawn yet"),
            );
            cell.addEventListener("click", () => this.take(cell));
            return cell;
        });
        if (!headings) {
            this.sheet.replaceChildren(...made);
            return made;
        }
        const { across, down } = headings;
        const children: HTMLElement[] = [
            element(
                "span",
                { class: "variations-corner", "aria-hidden": "true" },
                `${down.parameter.label} ↓  ${across.parameter.label} →`,
            ),
        ];
        for (const value of across.values)
            children.push(element("span", { class: "variations-heading number" }, value));
        down.values.forEach((value, row) => {
            children.push(element("span", { class: "variations-heading row number" }, value));
            children.push(...made.slice(row * across.values.length, (row + 1) * across.values.length));
        });
        this.sheet.replaceChildren(...children);
        return made;
    }

    private readonly variants = new WeakMap<HTMLElement, Variant>();

    private fill(cell: HTMLButtonElement, { variant, picture }: Found): void {
        if (this.variants.get(cell) === variant) return;
        this.variants.set(cell, variant);
        putImage(cell.querySelector("canvas")!, picture);
        const caption = cell.querySelector(".caption")!;
        const { part } = variant;
        if (part) {
            const mark = element("mark", { class: part.changed === "" ? "gone" : "" }, part.changed);
            caption.replaceChildren(`${part.predecessor.split("(")[0]} → ${part.before}`, mark, part.after);
        } else {
            caption.textContent = variant.label;
        }
        cell.title = variant.label;
        cell.querySelector(".unseen")!.textContent = `Use ${variant.label}`;
        cell.disabled = false;
        cell.classList.remove("waits");
    }

    private take(cell: HTMLButtonElement): void {
        const variant = this.variants.get(cell);
        if (!variant) return;
        this.adopted = variant.pattern;
        this.studio.store.change({ pattern: variant.pattern });
        this.adopted = this.studio.store.work.pattern;
        this.studio.say(`Using ${variant.label}`);
        this.markTaken();
        for (const each of this.cells) each.tabIndex = each === cell ? 0 : -1;
    }

    private get cells(): HTMLButtonElement[] {
        return [...this.sheet.querySelectorAll<HTMLButtonElement>(".variant")];
    }

    private markTaken(pattern = this.studio.store.work.pattern): void {
        const text = JSON.stringify(pattern);
        for (const cell of this.cells) {
            const variant = this.variants.get(cell);
            cell.setAttribute(
                "aria-pressed",
                String(variant !== undefined && JSON.stringify(variant.pattern) === text),
            );
        }
    }

    private move(event: KeyboardEvent): void {
        const cells = this.cells;
        const at = cells.indexOf(event.target as HTMLButtonElement);
        if (at < 0) return;
        const tops = new Set(cells.map((cell) => cell.offsetTop));
        const wide = Math.max(1, Math.round(cells.length / tops.size));
        const step = {
            ArrowRight: 1,
            ArrowLeft: -1,
            ArrowDown: wide,
            ArrowUp: -wide,
            Home: -at,
            End: cells.length - 1 - at,
        }[event.key];
        if (step === undefined) return;
        event.preventDefault();
        const sign = Math.sign(step) || 1;
        let to = at + step;
        while (cells[to]?.disabled) to += sign;
        const next = cells[to];
        if (!next) return;
        for (const each of cells) each.tabIndex = each === next ? 0 : -1;
        next.focus();
    }
}

interface Plan {
    readonly cells: number;
    readonly isFixed: boolean; // each candidate has its own cell
    readonly candidates: (index: number) => readonly Variant[] | null;
    readonly headings?: { across: Axis; down: Axis };
}

// Order in which values are suggested.
function rank({ kind }: Parameter): number {
    return { define: 0, angle: 1, n: 2, seed: 3, production: 4 }[kind];
}
