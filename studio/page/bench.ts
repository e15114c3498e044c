// The kolam bench: a grid of dots, whose gaps are crossed or turned back. Every change becomes the pattern's text.
import { Board, type Scene } from "./bench/board";
import { certificateText, type Examined } from "./bench/certificate";
import type { DotGrid } from "./bench/dot_grid";
import { countLines, crossed, crossingsText, followLines, gridText, makeGrid, parseCrossings, parseGrid } from "./bench/dot_grid";
import { kolamTitle, readKolam, withEditsOf } from "./bench/kolam_text";
import { gapOrbits, hasSymmetry, singleLineNear, symmetries, symmetrised, type Symmetry } from "./bench/symmetry";
import type { MakePanel, Panel, Studio } from "./context";
import { RequestFailed } from "./context";
import { button, element, icon } from "./elements";
import type { Grid } from "./protocol";
import { makeChance } from "./sound/chance";

const presets: [string, string[]][] = [
    ["Squares", ["3x3", "4x4", "5x5", "6x6", "7x7", "9x9", "11x11", "15x15"]],
    ["Diamonds", ["1-3-1", "1-3-5-3-1", "1-3-5-7-5-3-1", "1-3-5-7-9-7-5-3-1", "1-3-5-7-9-11-13-11-9-7-5-3-1", "2-4-6-6-4-2"]],
    ["Octagons", ["3-5-5-5-3", "3-5-7-7-7-5-3", "5-7-9-11-11-11-11-11-9-7-5"]],
    ["Other shapes", ["1-3-5-7", "1-3-5-7-9-11", "3-3-9-9-9-3-3", "5-1-5", "7-5-3-1-3-5-7", "4x7", "2x9"]],
];

const symmetry_icons: Record<Symmetry, string> = {
    "none": "M4 4h8v8H4z", "mirror-x": "M8 2v12M5.5 5L2.5 8l3 3zM10.5 5l3 3-3 3z", "mirror-y": "M2 8h12M5 5.5l3-3 3 3zM5 10.5l3 3 3-3z",
    "mirrors": "M8 2v12M2 8h12", "C2": "M12.5 6A5 5 0 0 0 4 5M3.5 2.5V5H6M3.5 10a5 5 0 0 0 8.5 1M12.5 13.5V11H10",
    "C4": "M8 2.5h3.5V6M13.5 8v3.5H10M8 13.5H4.5V10M2.5 8V4.5H6", "D4": "M8 1.5v13M1.5 8h13M3.5 3.5l9 9M12.5 3.5l-9 9",
};
const dice_icon = "M3 3h10v10H3zM5.7 5.7h.01M10.3 5.7h.01M8 8h.01M5.7 10.3h.01M10.3 10.3h.01";

const counted = (count: number, one: string, more = `${one}s`): string => `${count.toLocaleString("en")} ${count === 1 ? one : more}`;

class BenchPanel implements Panel {
    readonly name = "bench";
    readonly label = "Kolam bench";
    readonly element = element("div", { class: "bench" });

    private grid: DotGrid = parseGrid("7x7");
    private states = new Uint8Array(this.grid.gaps.length).fill(crossed);
    private symmetry: Symmetry = "none";
    private orbits: number[][] = gapOrbits(this.grid, "none");
    private lines = followLines(this.grid, this.states);
    private isColoured = true;
    private isFilled = false;
    private hasDots = true;
    private density = 0.7;
    private seed = 1;

    private cursor = -1;
    private goal: number | null = null; // the column that the keys keep to
    private isKeyboard = false;
    private painting: number | null = null; // the state that a drag gives
    private isShown = false;
    private frame = 0;
    private made = ""; // the text of this kolam, as the libraries made it
    private text = ""; // the same with the edits of the user
    private waiting = 0;

    private readonly board: Board;
    private readonly canvas = element("canvas", {
        class: "bench-board", tabindex: 0, role: "application", "aria-roledescription": "kolam board",
        "aria-describedby": "bench-keys",
    });
    private readonly spoken = element("p", { class: "unseen", role: "status", "aria-live": "assertive" });
    private readonly countLine = element("p", { class: "bench-count" });
    private readonly certificate = element("p", { class: "bench-certificate" });
    private readonly hover = element("p", { class: "bench-hover", "aria-hidden": "true" });
    private readonly gridField = element("input", { type: "text", id: "bench-grid", spellcheck: "false", autocomplete: "off" });
    private readonly preset = element("select", { "aria-label": "Shapes" });
    private readonly problem = element("p", { class: "note bench-problem", role: "alert", hidden: true });
    private readonly rowCount = element("output", { class: "number" });
    private readonly columnCount = element("output", { class: "number" });
    private readonly locks = new Map<Symmetry, HTMLButtonElement>();
    private readonly lockName = element("p", { class: "bench-lock-name" });
    private readonly densityField = element("input", { type: "range", id: "bench-density", min: 0, max: 100, step: 1 });
    private readonly seedField = element("input", { type: "text", id: "bench-seed", inputmode: "numeric", class: "number" });

    constructor(private readonly studio: Studio) {
        this.board = new Board(this.canvas, () => this.redraw());
        this.build();
        this.listen();
        const found = readKolam(studio.store.work.pattern.text);
        if (found) this.take(found.grid, found.states, found.isColoured, studio.store.work.pattern.text);
        this.update();
    }

    // --- the controls ---------------------------------------------------------------------------------------------

    private build(): void {
        this.preset.append(element("option", { value: "" }, "Shapes…"), ...presets.map(([label, texts]) =>
            element("optgroup", { label }, ...texts.map((text) => element("option", { value: text }, text.replace("x", " × "))))));
        const stepper = (label: string, output: HTMLElement, act: (by: number) => void) => element("div", { class: "bench-stepper" },
            element("span", { class: "label" }, label), button(`Fewer ${label.toLowerCase()}`, () => act(-1), { icon: "M4 8h8" }),
            output, button(`More ${label.toLowerCase()}`, () => act(1), { icon: "M4 8h8M8 4v8" }));
        const locks = element("div", { class: "bench-locks", role: "radiogroup", "aria-label": "Symmetry" },
            ...symmetries.map(({ name, label }) => this.lock(name, label)));
        const toggle = (label: string, isOn: boolean, act: (isOn: boolean) => void) => {
            const box = element("input", { type: "checkbox", checked: isOn });
            box.addEventListener("change", () => act(box.checked));
            return element("label", { class: "switch" }, box, label);
        };
        const side = element("aside", { class: "bench-side", "aria-label": "Kolam" },
            element("div", { class: "bench-facts" }, this.countLine, this.certificate),
            element("section", { class: "bench-section" },
                element("h3", {}, "Grid of dots"),
                element("div", { class: "bench-steppers" },
                    stepper("Rows", this.rowCount, (by) => this.step(by, 0)),
                    stepper("Columns", this.columnCount, (by) => this.step(0, by))),
                element("div", { class: "bench-pair" },
                    element("div", { class: "field" }, element("label", { for: "bench-grid" }, "Dots in each row"), this.gridField),
                    this.preset),
                this.problem),
            element("section", { class: "bench-section" }, element("h3", {}, "Symmetry"), locks, this.lockName),
            element("section", { class: "bench-section" },
                element("h3", {}, "Gaps"),
                element("div", { class: "toolbar" },
                    button("Make it one line", () => void this.makeSingle(), { kind: "primary" }),
                    button("Cross all", () => this.setAll(() => 1)),
                    button("Turn all back", () => this.setAll(() => 0)),
                    button("Swap all", () => this.setAll((state) => 1 - state))),
                element("div", { class: "bench-random" },
                    element("div", { class: "slider bench-density" }, element("label", { for: "bench-density" }, "Crossed"), this.densityField,
                        element("output", { class: "number", for: "bench-density" })),
                    element("div", { class: "bench-dice" },
                        element("label", { for: "bench-seed" }, "Seed"), this.seedField,
                        button("Throw the dice", () => void this.random(this.seed + 1), { icon: dice_icon, shows: true })))),
            element("section", { class: "bench-section" },
                element("h3", {}, "Look"),
                toggle("Each line in its own colour", this.isColoured, (isOn) => {
                    this.isColoured = isOn;
                    this.commit();
                }),
                toggle("Fill every other field", this.isFilled, (isOn) => {
                    this.isFilled = isOn;
                    this.redraw();
                }),
                toggle("Dots", this.hasDots, (isOn) => {
                    this.hasDots = isOn;
                    this.redraw();
                })),
            element("p", { class: "bench-keys", id: "bench-keys" }, "Click a gap between two dots to cross the lines there or turn them back; drag to "
                + "change several. On the board, arrow keys move from gap to gap and space changes one."));
        this.element.append(element("div", { class: "bench-stage" }, this.canvas, this.hover), side, this.spoken);
    }

    private lock(name: Symmetry, label: string): HTMLButtonElement {
        const made = element("button", { type: "button", class: "bench-lock", role: "radio", "aria-label": label, title: label }, icon(symmetry_icons[name]));
        made.addEventListener("click", () => this.setSymmetry(name));
        made.addEventListener("keydown", (event) => {
            const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
            if (by === undefined) return;
            event.preventDefault();
            const offered = symmetries.map((each) => each.name).filter((each) => hasSymmetry(this.grid, each));
            const next = offered[(offered.indexOf(name) + by + offered.length) % offered.length];
            this.setSymmetry(next);
            this.locks.get(next)!.focus();
        });
        this.locks.set(name, made);
        return made;
    }

    private listen(): void {
        const { canvas } = this;
        canvas.addEventListener("pointermove", (event) => this.point(event));
        canvas.addEventListener("pointerdown", (event) => {
            if (event.button !== 0) return;
            this.point(event);
            if (this.cursor < 0) return;
            canvas.setPointerCapture(event.pointerId);
            this.painting = 1 - this.states[this.cursor];
            this.toggle(this.cursor);
        });
        for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { this.painting = null; });
        canvas.addEventListener("pointerleave", () => this.leave());
        canvas.addEventListener("keydown", (event) => this.press(event));
        canvas.addEventListener("focus", () => {
            if (!canvas.matches(":focus-visible")) return;
            this.isKeyboard = true;
            if (this.cursor < 0) this.cursor = 0;
            this.announce();
        });
        canvas.addEventListener("blur", () => {
            this.isKeyboard = false;
            this.leave();
        });
        this.gridField.addEventListener("change", () => this.setGridText(this.gridField.value));
        this.preset.addEventListener("change", () => {
            if (this.preset.value) this.setGridText(this.preset.value);
            this.preset.value = "";
        });
        this.densityField.addEventListener("input", () => {
            this.density = this.densityField.valueAsNumber / 100;
            void this.random(this.seed);
        });
        this.seedField.addEventListener("change", () => {
            const seed = Number(this.seedField.value);
            void this.random(Number.isSafeInteger(seed) && seed >= 0 ? seed : this.seed);
        });
        this.studio.store.subscribe((work, before) => {
            if (work.pattern === before.pattern || work.pattern.text === this.text) return;
            const found = readKolam(work.pattern.text);
            if (found) this.take(found.grid, found.states, found.isColoured, work.pattern.text);
        });
    }

    // --- changes --------------------------------------------------------------------------------------------------

    /// What the text says, as after an undo.
    private take(grid: DotGrid, states: Uint8Array, isColoured: boolean, text: string): void {
        if (gridText(grid) !== gridText(this.grid)) {
            this.grid = grid;
            if (!hasSymmetry(grid, this.symmetry)) this.symmetry = "none";
            this.orbits = gapOrbits(grid, this.symmetry);
            this.cursor = -1;
        }
        this.states = Uint8Array.from(states);
        if (countLines(grid, states) > 1) this.isColoured = isColoured;
        this.made = "";
        this.text = text;
        ++this.waiting; // answers to earlier changes are late
        this.update();
        void this.examine();
    }

    private toggle(gap: number): void {
        const state = 1 - this.states[gap];
        for (const each of this.orbits[gap]) this.states[each] = state;
        this.commit();
    }

    private setAll(change: (state: number) => number): void {
        this.states = this.states.map(change);
        this.commit();
    }

    private setSymmetry(symmetry: Symmetry): void {
        if (!hasSymmetry(this.grid, symmetry)) return;
        this.symmetry = symmetry;
        this.orbits = gapOrbits(this.grid, symmetry);
        const before = this.states.join("");
        this.states = Uint8Array.from(symmetrised(this.orbits, this.states));
        if (this.states.join("") !== before) this.commit();
        else this.update();
    }

    private setGridText(text: string): void {
        try {
            this.setGrid(parseGrid(text));
        } catch (error) {
            this.problem.textContent = (error as Error).message;
            this.problem.hidden = false;
            this.gridField.setAttribute("aria-invalid", "true");
        }
    }

    /// Rows and columns more or fewer; grids with rows of several lengths grow by two dots in each row.
    private step(rows: number, columns: number): void {
        const old = this.grid.rows;
        const isRectangle = old.every((row) => row === old[0]);
        const widened = old.map((row) => row + columns * (isRectangle ? 1 : 2)).filter((row) => row > 0);
        const next = rows > 0 ? [...widened, widened[widened.length - 1]] : rows < 0 ? widened.slice(0, -1) : widened;
        if (next.length === 0 || next.length !== old.length + rows) return;
        try {
            this.setGrid(makeGrid(next));
        } catch (error) {
            this.studio.say((error as Error).message, "warning");
        }
    }

    /// Gaps of the old grid that the new one has keep their states: from the middle, or from the upper left corner.
    private setGrid(grid: DotGrid): void {
        const old = this.grid;
        const even = (value: number): boolean => value % 2 === 0;
        const isCentred = even(grid.rows[0] - old.rows[0]) && even(grid.rows.length - old.rows.length);
        const dx = isCentred ? 0 : grid.dots[0].x - old.dots[0].x;
        const dy = isCentred ? 0 : grid.dots[0].y - old.dots[0].y;
        const states = new Map(old.gaps.map((gap, i) => [`${gap.x + dx} ${gap.y + dy}`, this.states[i]]));
        this.grid = grid;
        this.states = Uint8Array.from(grid.gaps, (gap) => states.get(`${gap.x} ${gap.y}`) ?? crossed);
        if (!hasSymmetry(grid, this.symmetry)) this.symmetry = "none";
        this.orbits = gapOrbits(grid, this.symmetry);
        this.states = Uint8Array.from(symmetrised(this.orbits, this.states));
        this.cursor = -1;
        this.commit();
    }

    private async random(seed: number): Promise<void> {
        this.seed = seed;
        await this.ask({ seed: String(seed), density: this.density }, "kolam at random");
    }

    private async makeSingle(): Promise<void> {
        if (this.lines.strands.length === 1) {
            this.studio.say("The kolam is one line already.");
            return;
        }
        if (this.symmetry !== "none") {
            const found = singleLineNear(this.grid, this.orbits, this.states, makeChance(this.seed));
            if (found) {
                this.states = Uint8Array.from(found);
                this.commit();
                return;
            }
        }
        const crossings = this.symmetry === "none" ? { crossings: crossingsText(this.grid, this.states) } : {};
        await this.ask({ seed: String(this.seed), density: this.density, single_line: true, ...crossings }, "kolam as one line");
    }

    /// Lets the libraries find the crossings.
    private async ask(what: { seed: string; density: number; single_line?: boolean; crossings?: string }, merge: string): Promise<void> {
        const mine = ++this.waiting;
        try {
            const { json } = await this.studio.engine.request<Grid>({
                do: "grid", grid: gridText(this.grid), symmetry: this.symmetry, coloured: this.isColoured, title: kolamTitle(this.grid), ...what,
            }, { key: "bench" });
            if (mine !== this.waiting) return;
            if (json.obstacle) this.studio.say(sentence(json.obstacle), "warning");
            const states = parseCrossings(this.grid, json.crossings);
            if (!states || (json.obstacle && what.single_line)) return;
            this.states = Uint8Array.from(states);
            this.update();
            this.store(json.text, merge);
        } catch (error) {
            if (error instanceof RequestFailed) this.studio.say(error.message, "error");
        }
    }

    /// Shows the change at once; the text follows when the libraries have written it.
    private commit(): void {
        this.update();
        const mine = ++this.waiting;
        this.studio.engine.request<Grid>({
            do: "grid", grid: gridText(this.grid), crossings: crossingsText(this.grid, this.states),
            coloured: this.isColoured, title: kolamTitle(this.grid),
        }, { key: "bench" }).then(({ json }) => {
            if (mine === this.waiting) this.store(json.text, "kolam");
        }, (error) => {
            if (error instanceof RequestFailed) this.studio.say(error.message, "error");
        });
    }

    private store(made: string, merge: string): void {
        const { store } = this.studio;
        const { pattern } = store.work;
        const isOurs = pattern.text === this.text || readKolam(pattern.text) !== null;
        this.text = isOurs ? withEditsOf(pattern.text, this.made, made) : made;
        this.made = made;
        const next = isOurs ? { ...pattern, text: this.text }
            : { name: "kolam.lsys", text: this.text, variant: "", settings: [] };
        store.change({ pattern: next, place: null }, merge);
        void this.examine();
    }

    /// The certificate comes from the libraries, which examine the curve and not the grid.
    private async examine(): Promise<void> {
        const { pattern } = this.studio.store.work;
        if (pattern.text !== this.text) return;
        try {
            const { json } = await this.studio.engine.request<Examined>({ do: "kolam", pattern }, { key: "bench kolam" });
            if (this.studio.store.work.pattern.text === this.text) this.certificate.textContent = certificateText(json);
        } catch (error) {
            if (error instanceof RequestFailed) this.certificate.textContent = "";
        }
    }

    // --- the pointer and the keys ---------------------------------------------------------------------------------

    private point(event: PointerEvent): void {
        const gap = this.board.gapAt(this.scene(), event.offsetX, event.offsetY);
        this.isKeyboard = false;
        if (this.painting !== null && gap >= 0 && this.states[gap] !== this.painting) {
            this.cursor = gap;
            this.toggle(gap);
        }
        if (gap === this.cursor) return;
        this.cursor = gap;
        this.showHover();
        this.redraw();
    }

    private leave(): void {
        if (this.isKeyboard || this.painting !== null) return;
        this.cursor = -1;
        this.showHover();
        this.redraw();
    }

    private press(event: KeyboardEvent): void {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        if (event.key === " " || event.key === "Enter") {
            event.preventDefault();
            this.isKeyboard = true;
            if (this.cursor < 0) this.cursor = 0;
            else this.toggle(this.cursor);
            this.announce();
            return;
        }
        const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
        if (!way) return;
        event.preventDefault();
        this.isKeyboard = true;
        this.cursor = this.cursor < 0 ? 0 : this.neighbour(way[0], way[1]);
        this.announce();
    }

    /// The next gap in its row of gaps, or the nearest one of the next row.
    private neighbour(dx: number, dy: number): number {
        const { gaps } = this.grid;
        const here = gaps[this.cursor];
        if (dx !== 0) this.goal = null;
        else this.goal ??= here.x;
        const goal = this.goal ?? here.x;
        let nearest = Infinity;
        let found = this.cursor;
        gaps.forEach((gap, i) => {
            const ahead = dx !== 0 ? (gap.x - here.x) * dx : (gap.y - here.y) * dy;
            const aside = dx !== 0 ? Math.abs(gap.y - here.y) * 1000 : Math.abs(gap.x - goal);
            if (ahead <= 0 || aside >= 1000) return;
            const distance = ahead * 100 + aside;
            if (distance < nearest) {
                nearest = distance;
                found = i;
            }
        });
        return found;
    }

    private dotName(dot: number): string {
        const { dots, rows } = this.grid;
        const row = (rows.length - 1 - dots[dot].y) / 2;
        return `row ${row + 1} dot ${(dots[dot].x + rows[row] - 1) / 2 + 1}`;
    }

    private announce(): void {
        const { from, to } = this.grid.gaps[this.cursor];
        const state = this.states[this.cursor] === crossed ? "crossed" : "turned back";
        this.spoken.textContent = `Gap between ${this.dotName(from)} and ${this.dotName(to)}: ${state}; ${counted(this.lines.strands.length, "line")}`;
        this.showHover();
        this.redraw();
    }

    private showHover(): void {
        if (this.cursor < 0) {
            this.hover.textContent = "";
            return;
        }
        const after = this.states.slice();
        for (const gap of this.orbits[this.cursor]) after[gap] = 1 - after[gap];
        const now = this.lines.strands.length;
        const then = countLines(this.grid, after);
        const act = this.states[this.cursor] === crossed ? "Turn back" : "Cross";
        const gaps = this.orbits[this.cursor].length;
        const result = then === now ? `still ${counted(now, "line")}` : `${now} → ${counted(then, "line")}`;
        this.hover.textContent = `${act}${gaps > 1 ? ` in ${gaps} gaps` : ""}: ${result}`;
    }

    // --- what is seen ---------------------------------------------------------------------------------------------

    private scene(): Scene {
        return {
            grid: this.grid, states: this.states, strands: this.lines.strands, isColoured: this.isColoured,
            isFilled: this.isFilled, hasDots: this.hasDots, cursor: this.cursor,
            orbit: this.cursor < 0 ? [] : this.orbits[this.cursor], isFocused: this.isKeyboard,
        };
    }

    private update(): void {
        this.lines = followLines(this.grid, this.states);
        const lines = this.lines.strands.length;
        this.countLine.textContent = counted(lines, "line");
        this.countLine.classList.toggle("single", lines === 1);
        const crossings = this.states.reduce((sum, state) => sum + (state === crossed ? 1 : 0), 0);
        this.certificate.textContent = `${counted(this.grid.dots.length, "dot")}, ${crossings} of ${counted(this.grid.gaps.length, "gap")} crossed.`;
        this.canvas.setAttribute("aria-label", `Kolam on ${gridText(this.grid)} dots: ${counted(lines, "line")}, ${crossings} of ${this.grid.gaps.length} gaps crossed`);
        const { rows } = this.grid;
        this.rowCount.textContent = String(rows.length);
        this.columnCount.textContent = String(Math.max(...rows));
        if (document.activeElement !== this.gridField || this.problem.hidden) this.gridField.value = gridText(this.grid);
        this.gridField.removeAttribute("aria-invalid");
        this.problem.hidden = true;
        for (const [name, lock] of this.locks) {
            const isOffered = hasSymmetry(this.grid, name);
            lock.disabled = !isOffered;
            lock.setAttribute("aria-checked", String(name === this.symmetry));
            lock.tabIndex = name === this.symmetry ? 0 : -1;
        }
        this.lockName.textContent = symmetries.find(({ name }) => name === this.symmetry)!.label;
        const percent = Math.round(this.density * 100);
        this.densityField.valueAsNumber = percent;
        this.densityField.style.setProperty("--at", `${percent}%`);
        this.densityField.setAttribute("aria-valuetext", `${percent} percent of the gaps`);
        this.densityField.nextElementSibling!.textContent = `${percent} %`;
        this.seedField.value = String(this.seed);
        if (this.cursor >= 0) this.showHover();
        this.redraw();
    }

    private redraw(): void {
        if (this.frame !== 0 || !this.isShown) return;
        this.frame = requestAnimationFrame(() => {
            this.frame = 0;
            this.board.draw(this.scene());
        });
    }

    show(): void {
        this.isShown = true;
        this.redraw();
        void this.examine();
    }

    hide(): void { this.isShown = false; }
}

const sentence = (text: string): string => `${text.slice(0, 1).toUpperCase()}${text.slice(1)}${text.endsWith(".") ? "" : "."}`;

export const makeBenchPanel: MakePanel = (studio) => new BenchPanel(studio);
