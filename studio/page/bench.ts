// The kolam bench: a grid of dots with gaps in which lines cross or turn back. Every change is written to the text.
import { Board, type Scene } from "./bench/board";
import { certificateText, type Examined } from "./bench/certificate";
import type { DotGrid } from "./bench/dot_grid";
import { crossingsText, gridText, parseCrossings, parseGrid } from "./bench/dot_grid";
import { changeText, counted, gapText, neighbour } from "./bench/gap_names";
import { Kolam } from "./bench/kolam";
import { kolamTitle, readKolam, withDots, withEditsOf } from "./bench/kolam_text";
import { Side, type Chances, type Look } from "./bench/side";
import { singleLineNear, type Symmetry } from "./bench/symmetry";
import type { MakePanel, Panel, Studio } from "./context";
import { RequestFailed } from "./context";
import { element } from "./elements";
import type { Grid, Request } from "./protocol";
import { makeChance } from "./sound/chance";

type GridRequest = Extract<Request, { do: "grid" }>;

class BenchPanel implements Panel {
    readonly name = "bench";
    readonly label = "Kolam bench";
    readonly element = element("div", { class: "bench" });

    private readonly kolam = new Kolam("7x7");
    private look: Look = { isColoured: true, isFilled: false, hasDots: true };
    private chances: Chances = { density: 0.7, seed: 1 };

    private cursor = -1; // the gap selected by pointer or keyboard
    private column: number | null = null; // kept while moving up and down with the keys
    private isKeyboard = false;
    private painting: number | null = null; // the state that a drag sets
    private isShown = false;
    private frame = 0;
    private made = ""; // the text of this kolam as written by the libraries
    private text = ""; // the same with the edits of the user
    private asked = 0; // number of the last request; earlier answers are ignored

    private readonly canvas = element("canvas", {
        class: "bench-board",
        tabindex: 0,
        role: "application",
        "aria-roledescription": "kolam board",
        "aria-describedby": "bench-keys",
    });
    private readonly board = new Board(this.canvas, () => this.redraw());
    private readonly spoken = element("p", { class: "unseen", role: "status", "aria-live": "assertive" });
    private readonly hover = element("p", { class: "bench-hover", "aria-hidden": "true" });
    private readonly side = new Side({
        resize: (rows, columns) => this.resize(rows, columns),
        shape: (text) => this.setGrid(() => parseGrid(text), true),
        symmetry: (symmetry) => this.setSymmetry(symmetry),
        single: () => void this.makeSingle(),
        setAll: (change) => this.change(this.kolam.states.map(change)),
        chances: (chances) => void this.random(chances),
        look: (look) => this.setLook(look),
    });

    constructor(private readonly studio: Studio) {
        this.element.append(
            element("div", { class: "bench-stage" }, this.canvas, this.hover),
            this.side.element,
            this.spoken,
        );
        this.listen();
        if (!this.take(studio.store.work.pattern.text)) this.update();
    }

    private listen(): void {
        const { canvas } = this;
        canvas.addEventListener("pointermove", (event) => this.point(event));
        canvas.addEventListener("pointerdown", (event) => {
            if (event.button !== 0) return;
            this.point(event);
            if (this.cursor < 0) return;
            canvas.setPointerCapture(event.pointerId);
            this.painting = 1 - this.kolam.states[this.cursor];
            this.toggle(this.cursor);
        });
        for (const end of ["pointerup", "pointercancel"] as const) {
            canvas.addEventListener(end, () => {
                this.painting = null;
            });
        }
        canvas.addEventListener("pointerleave", () => this.leave());
        canvas.addEventListener("keydown", (event) => this.press(event));
        canvas.addEventListener("focus", () => {
            if (!canvas.matches(":focus-visible") || this.kolam.grid.gaps.length === 0) return;
            this.isKeyboard = true;
            this.cursor = Math.max(0, this.cursor);
            this.announce();
        });
        canvas.addEventListener("blur", () => {
            this.isKeyboard = false;
            this.leave();
        });
        this.studio.store.subscribe((work, before) => {
            if (work.pattern !== before.pattern && work.pattern.text !== this.text) this.take(work.pattern.text);
        });
    }

    // --- changes --------------------------------------------------------------------------------------------------

    /// Reads the kolam from the text, for example after an undo. False if it is not a kolam of the bench.
    private take(text: string): boolean {
        const found = readKolam(text);
        if (!found) return false;
        if (gridText(found.grid) !== gridText(this.kolam.grid)) this.cursor = -1;
        this.kolam.set(found.grid, found.states);
        const isColoured = this.kolam.count > 1 ? found.isColoured : this.look.isColoured;
        this.look = { ...this.look, isColoured, hasDots: found.hasDots };
        this.made = "";
        this.text = text;
        ++this.asked;
        this.update();
        void this.examine();
        return true;
    }

    private toggle(gap: number): void {
        this.change(this.kolam.after(gap));
    }

    private change(states: Uint8Array): void {
        this.kolam.setStates(states);
        this.commit();
    }

    private setSymmetry(symmetry: Symmetry): void {
        if (this.kolam.setSymmetry(symmetry)) this.commit();
        else this.update();
    }

    private setLook(look: Look): void {
        const isOther = look.isColoured !== this.look.isColoured || look.hasDots !== this.look.hasDots;
        this.look = look;
        if (isOther) this.commit();
        else this.update();
    }

    private resize(rows: number, columns: number): void {
        const { kolam } = this;
        this.setGrid(() => kolam.resized(rows, columns), false);
    }

    private setGrid(make: () => DotGrid | null, isTyped: boolean): void {
        try {
            const grid = make();
            if (!grid) return;
            this.kolam.setGrid(grid);
            this.cursor = -1;
            this.commit();
        } catch (error) {
            const { message } = error as Error;
            if (isTyped) this.side.refuse(message);
            else this.studio.say(message, "warning");
        }
    }

    private async random(chances: Chances): Promise<void> {
        this.chances = chances;
        this.update();
        await this.ask({ seed: String(chances.seed), density: chances.density }, "kolam at random");
    }

    private async makeSingle(): Promise<void> {
        const { kolam, chances } = this;
        if (kolam.count === 1) {
            this.studio.say("The kolam is already a single line.");
            return;
        }
        if (kolam.symmetry !== "none") {
            const found = singleLineNear(kolam.grid, kolam.orbits, kolam.states, makeChance(chances.seed));
            if (found) {
                this.change(found);
                return;
            }
        }
        const crossings = kolam.symmetry === "none" ? { crossings: crossingsText(kolam.grid, kolam.states) } : {};
        const wanted = { seed: String(chances.seed), density: chances.density, single_line: true, ...crossings };
        await this.ask(wanted, "kolam as one line");
    }

    private request(more: Partial<GridRequest>): GridRequest {
        const { grid } = this.kolam;
        return { do: "grid", grid: gridText(grid), coloured: this.look.isColoured, title: kolamTitle(grid), ...more };
    }

    /// Asks the libraries for the crossings.
    private async ask(wanted: Partial<GridRequest>, merge: string): Promise<void> {
        const mine = ++this.asked;
        const { engine } = this.studio;
        try {
            const request = this.request({ symmetry: this.kolam.symmetry, ...wanted });
            const { json } = await engine.request<Grid>(request, { key: "bench" });
            if (mine !== this.asked) return;
            if (json.obstacle) this.studio.say(sentence(json.obstacle), "warning");
            const states = parseCrossings(this.kolam.grid, json.crossings);
            if (!states || (json.obstacle && wanted.single_line)) return;
            this.kolam.setStates(states);
            this.update();
            this.store(json.text, merge);
        } catch (error) {
            if (error instanceof RequestFailed) this.studio.say(error.message, "error");
        }
    }

    /// Shows the change at once; the text is updated when the libraries have written it.
    private commit(): void {
        this.update();
        const mine = ++this.asked;
        const request = this.request({ crossings: crossingsText(this.kolam.grid, this.kolam.states) });
        this.studio.engine.request<Grid>(request, { key: "bench" }).then(
            ({ json }) => {
                if (mine === this.asked) this.store(json.text, "kolam");
            },
            (error) => {
                if (error instanceof RequestFailed) this.studio.say(error.message, "error");
            },
        );
    }

    private store(bare: string, merge: string): void {
        const { store } = this.studio;
        const made = withDots(bare, this.look.hasDots);
        const { pattern } = store.work;
        const isOurs = pattern.text === this.text || readKolam(pattern.text) !== null;
        this.text = isOurs ? withEditsOf(pattern.text, this.made, made) : made;
        this.made = made;
        const fresh = { name: "kolam.lsys", variant: "", settings: [] };
        store.change({ pattern: { ...pattern, ...(isOurs ? {} : fresh), text: this.text }, place: null }, merge);
        if (!isOurs) this.studio.say("The kolam has replaced the pattern. Undo restores it.");
        void this.examine();
    }

    /// Requests the certificate from the libraries, which examine the curve, not the grid.
    private async examine(): Promise<void> {
        const { engine, store } = this.studio;
        const { pattern } = store.work;
        if (pattern.text !== this.text) return;
        try {
            const { json } = await engine.request<Examined>({ do: "kolam", pattern }, { key: "bench kolam" });
            if (store.work.pattern.text === this.text) this.side.certificate.textContent = certificateText(json);
        } catch (error) {
            if (error instanceof RequestFailed) this.side.certificate.textContent = "";
        }
    }

    // --- pointer and keyboard ---------------------------------------------------------------------------------

    private point(event: PointerEvent): void {
        const gap = this.board.gapAt(this.scene(), event.offsetX, event.offsetY);
        this.isKeyboard = false;
        if (this.painting !== null && gap >= 0 && this.kolam.states[gap] !== this.painting) {
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
        if (event.ctrlKey || event.metaKey || event.altKey || this.kolam.grid.gaps.length === 0) return;
        const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
        const isChange = event.key === " " || event.key === "Enter";
        if (!way && !isChange) return;
        event.preventDefault();
        this.isKeyboard = true;
        if (this.cursor < 0) {
            this.cursor = 0;
        } else if (isChange) {
            this.toggle(this.cursor);
        } else if (way) {
            const { grid } = this.kolam;
            const here = grid.gaps[this.cursor].x;
            if (way[0] !== 0) this.column = null;
            else this.column ??= here;
            this.cursor = neighbour(grid, this.cursor, way[0], way[1], this.column ?? here);
        }
        this.announce();
    }

    private announce(): void {
        if (this.kolam.grid.gaps.length === 0) return;
        this.spoken.textContent = gapText(this.kolam, this.cursor);
        this.showHover();
        this.redraw();
    }

    private showHover(): void {
        this.hover.textContent = this.cursor < 0 ? "" : changeText(this.kolam, this.cursor);
    }

    // --- drawing ---------------------------------------------------------------------------------------------

    private scene(): Scene {
        const { grid, states, lines, orbits } = this.kolam;
        const { cursor, isKeyboard } = this;
        const orbit = cursor < 0 ? [] : orbits[cursor];
        return { grid, states, strands: lines.strands, ...this.look, cursor, orbit, isFocused: isKeyboard };
    }

    private update(): void {
        const { grid, count, crossings } = this.kolam;
        this.side.update(this.kolam, this.chances, this.look);
        const gaps = `${crossings} of ${grid.gaps.length} gaps crossed`;
        this.canvas.setAttribute("aria-label", `Kolam on ${gridText(grid)} dots: ${counted(count, "line")}, ${gaps}`);
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

    hide(): void {
        this.isShown = false;
    }
}

const sentence = (text: string): string =>
    `${text.slice(0, 1).toUpperCase()}${text.slice(1)}${text.endsWith(".") ? "" : "."}`;

export const makeBenchPanel: MakePanel = (studio) => new BenchPanel(studio);
