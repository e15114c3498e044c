// The kolam bench: a grid of dots with gaps in which lines cross, turn back or are joined. Every change is written
// to the text.
import { Board, placesAround, type Scene } from "./bench/board";
import { certificateText } from "./bench/certificate";
import { makeGrid, parseStates, statesText, crossed, joined, turned, type DotGrid, type GridSymmetry, type Place } from "./bench/dot_grid";
import { changeText, gapText, neighbour, placeText, statesTold } from "./bench/gap_names";
import { Kolam, type Change } from "./bench/kolam";
import { doubtsText, gapPlaces } from "./bench/doubts";
import { first_look, type Look, readKolam, usual_rows, withEditsOf, withLook, type Word, wordGrid, wordTitle } from "./bench/kolam_text";
import { forgetPhotograph, latestPhotograph, type Photograph, readPhotograph, requestReading, type Underlay, type View } from "./bench/photograph";
import { first_chances, Side, type Chances } from "./bench/side";
import { singleLineNear } from "./bench/symmetry";
import { makeTools, type Tool } from "./bench/tools";
import type { MakePanel, Panel, Studio } from "./context";
import { RequestFailed } from "./context";
import { element } from "./elements";
import { capital, counted, sentence } from "./numbers_shown";
import { withOption } from "./options";
import type { Dots, Examined, Grid, PatternRequest, Request, SymmetryName } from "./protocol";
import { makeChance } from "./sound/chance";
import { isAnother } from "./versions";

type GridRequest = Extract<Request, { do: "grid" }>;
type DotsRequest = Extract<Request, { do: "dots" }>;

const typing_pause = 250; // milliseconds after which a typed grid is checked
const state_keys: Record<string, number> = { t: turned, c: crossed, j: joined };

/// Looks that patterns set by keys.
const look_keys: [keyof Look, keys: string[]][] = [["ground", ["ground", "paper"]], ["hand", ["hand"]], ["isFilled", ["fields"]], ["hasDots", ["dots"]]];

/// The word of a notation such as `text 18:MEERA`.
function wordOf(notation: string): Word | null {
    const found = /^\s*text\s*(\d+)?\s*:\s*(.*\S)\s*$/i.exec(notation);
    return found && { letters: found[2], rows: Number(found[1] ?? usual_rows) };
}

class BenchPanel implements Panel {
    readonly name = "bench";
    readonly label = "Kolam bench";
    readonly element = element("div", { class: "bench" });

    private readonly kolam = new Kolam();
    private look: Look = first_look;
    private word: Word | null = null; // that the grid was made of
    private chances = first_chances;
    private tool: Tool = "next";

    private cursor = -1; // the gap or the place selected by pointer or keyboard
    private isReverse = false; // Shift is held
    private isDone = false; // the selected gap was changed and is not previewed again before the pointer leaves it
    private column: number | null = null; // kept while moving up and down with the keys
    private isKeyboard = false;
    private painting: number | null = null; // the state that a drag sets
    private isShown = false;
    private frame = 0;
    private typing = 0; // timer
    private laid: {
        photograph: Photograph | null;
        grid: DotGrid | null;
        shift?: Place | null;
        view?: View;
        made: Underlay | null;
    } = { photograph: null, grid: null, made: null };
    private around: { grid: DotGrid | null; places: Place[] } = { grid: null, places: [] };
    private made = ""; // the text of this kolam as written by the libraries
    private text = ""; // the same with the edits of the user
    private asked = 0; // number of the last request; earlier answers are ignored
    private editing: Promise<void> = Promise.resolve(); // the last change of dots

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
    private readonly tools = makeTools((tool) => this.setTool(tool));
    private readonly side = new Side({
        resize: (rows, columns) => this.resize(rows, columns),
        shape: (text) => this.setGrid(text),
        check: (text) => this.check(text),
        symmetry: (symmetry) => this.setSymmetry(symmetry),
        single: () => void this.makeSingle(),
        setAll: (change) => this.change(this.kolam.states.map(change)),
        chances: (chances) => void this.random(chances),
        look: (look) => this.setLook(look),
        word: (word) => void this.setWord(word),
        photograph: (file) => void readPhotograph(this.studio, file).then(() => this.update()),
        nextKolam: () => this.readNextKolam(),
        view: (view) => this.setView(view),
        forget: () => {
            forgetPhotograph();
            this.update();
        },
        nextDoubt: () => this.selectDoubt(),
        settle: (all) => this.settle(all),
    });

    constructor(private readonly studio: Studio) {
        this.element.append(
            element("div", { class: "bench-stage" }, this.canvas, this.tools.element, this.hover),
            this.side.element,
            this.spoken,
        );
        this.listen();
        this.update();
        if (!this.take(studio.store.work.pattern)) void this.begin();
    }

    private listen(): void {
        const { canvas } = this;
        canvas.addEventListener("pointermove", (event) => this.point(event));
        canvas.addEventListener("pointerdown", (event) => {
            if (event.button !== 0) return;
            this.point(event);
            if (this.cursor < 0) return;
            if (this.tool === "dots") {
                this.toggleDot();
                return;
            }
            canvas.setPointerCapture(event.pointerId);
            this.painting = this.kolam.stateAfter(this.cursor, this.gapChange);
            this.changeGap(this.painting);
        });
        for (const end of ["pointerup", "pointercancel"] as const) {
            canvas.addEventListener(end, () => {
                this.painting = null;
            });
        }
        canvas.addEventListener("pointerleave", () => this.leave());
        canvas.addEventListener("keydown", (event) => this.press(event));
        for (const type of ["keydown", "keyup"] as const) {
            addEventListener(type, ({ shiftKey }) => {
                if (this.isReverse === shiftKey || !this.isShown) return;
                this.isReverse = shiftKey;
                this.showHover();
                this.redraw();
            });
        }
        canvas.addEventListener("focus", () => {
            if (!canvas.matches(":focus-visible") || this.targets.length === 0) return;
            this.isKeyboard = true;
            this.cursor = Math.max(0, this.cursor);
            this.announce();
        });
        canvas.addEventListener("blur", () => {
            this.isKeyboard = false;
            this.leave();
        });
        this.studio.store.subscribe((work, before) => {
            if (work.pattern === before.pattern) return;
            if (work.pattern.text !== this.text) {
                this.take(work.pattern, before.pattern);
                return;
            }
            const dots = latestPhotograph()?.dots;
            const shift = dots?.shift;
            dots?.show(work.pattern, true);
            if (dots?.shift !== shift) this.update();
        });
    }

    // --- changes --------------------------------------------------------------------------------------------------

    /// Shows the first grid, without changing the text.
    private async begin(): Promise<void> {
        const mine = ++this.asked;
        const grid = await this.gridOf({ do: "dots", grid: "7x7" });
        if (!grid || mine !== this.asked) return;
        this.kolam.set(grid, new Uint8Array(grid.gaps.length).fill(crossed));
        this.update();
    }

    /// Reads the kolam from a pattern, for example after an undo. False if it is not a kolam of the bench.
    private take(pattern: PatternRequest, before = pattern): boolean {
        const { text } = pattern;
        const found = readKolam(text);
        if (!found) return false;
        const mine = ++this.asked;
        const take = (grid: DotGrid | null): void => {
            const states = grid && parseStates(grid, found.gaps);
            if (!grid || !states || mine !== this.asked) return; // the comments were edited
            const isSameGrid = grid.text === this.kolam.grid.text;
            if (!isSameGrid) this.cursor = -1;
            const isSame = isSameGrid && statesText(states) === statesText(this.kolam.states);
            latestPhotograph()?.dots.show(pattern, isSame && !isAnother(pattern, before));
            this.kolam.set(grid, states);
            const { isFilled, hasDots, hasCentredDots, rim, ground, hand, word } = found;
            const places = found.doubts.length > 0 ? gapPlaces(grid) : [];
            this.kolam.doubts = new Set(found.doubts.map((place) => places.indexOf(place)).filter((gap) => gap >= 0));
            this.kolam.setRim(rim);
            const isColoured = this.kolam.count > 1 ? found.isColoured : this.look.isColoured;
            this.look = { isColoured, isFilled, hasDots, hasCentredDots, rim, ground, hand };
            this.word = word;
            this.made = "";
            this.text = text;
            this.update();
            void this.examine();
        };
        const { grid } = this.kolam;
        if (grid.text === found.grid) take(grid);
        else void this.gridOf({ do: "dots", grid: found.grid }).then(take);
        return true;
    }

    /// Asks the libraries for a grid; null, with `refuse` called, if there is none.
    private async gridOf(
        request: DotsRequest,
        refuse?: (message: string) => void,
        key = "bench grid",
    ): Promise<DotGrid | null> {
        try {
            const { json } = await this.studio.engine.request<Dots>(request, { key });
            return makeGrid(json);
        } catch (error) {
            if (error instanceof RequestFailed) refuse?.(error.message);
            return null;
        }
    }

    private get gapChange(): Change {
        const { tool, isReverse } = this;
        return typeof tool === "number" ? tool : isReverse ? "previous" : "next";
    }

    private changeGap(change: Change): void {
        this.isDone = true;
        this.change(this.kolam.after(this.cursor, change));
    }

    private change(states: Uint8Array): void {
        this.kolam.setStates(states);
        this.commit();
    }

    private setSymmetry(symmetry: SymmetryName): void {
        if (this.kolam.setSymmetry(symmetry, true)) this.commit();
        else this.update();
    }

    private setTool(tool: Tool): void {
        const wasDots = this.tool === "dots";
        this.tool = tool;
        if (wasDots !== (tool === "dots")) this.cursor = -1;
        this.update();
    }

    private setLook(look: Look): void {
        this.look = look;
        this.kolam.setRim(look.rim);
        this.commit();
    }

    /// Writes a word in dots.
    private async setWord(word: Word): Promise<void> {
        if (wordTitle(word) === "") return;
        const refuse = (message: string): void =>
            this.side.refuse(capital(message) + (message.includes("gaps") ? "; fewer rows make fewer gaps" : ""));
        const grid = await this.gridOf({ do: "dots", grid: wordGrid(word) }, refuse);
        if (grid) this.takeGrid(grid, word);
    }

    private takeGrid(grid: DotGrid, word: Word | null): void {
        this.word = word;
        latestPhotograph()?.dots.leave();
        this.kolam.setGrid(grid, false);
        this.cursor = -1;
        this.commit();
    }

    private resize(rows: number, columns: number): void {
        const text = this.kolam.resized(rows, columns);
        if (text !== null) this.setGrid(text);
    }

    /// Describes a grid while it is typed.
    private check(text: string): void {
        clearTimeout(this.typing);
        const mine = (this.typing = window.setTimeout(() => {
            const refuse = (message: string): void => this.side.refuse(capital(message));
            void this.gridOf({ do: "dots", grid: text }, refuse, "bench typing").then((grid) => {
                if (grid && mine === this.typing) this.side.describe(grid);
            });
        }, typing_pause));
    }

    private async setGrid(text: string): Promise<void> {
        clearTimeout(this.typing);
        const grid = await this.gridOf({ do: "dots", grid: text }, (message) => this.side.refuse(capital(message)));
        if (grid) this.takeGrid(grid, wordOf(text));
    }

    /// Adds or removes the dot at the selected place, and its images under the symmetry.
    private toggleDot(): void {
        const place = this.places?.[this.cursor];
        if (!place) return;
        // One after the other, because each request starts from the grid before.
        this.editing = this.editing.then(async () => {
            const { grid, symmetry } = this.kolam;
            const isDot = grid.dots.some(({ x, level }) => x === place.x && level === place.level);
            const change = { [isDot ? "remove" : "add"]: [[place.x, place.level]] };
            const request: DotsRequest = { do: "dots", grid: grid.text, symmetry: symmetry.name, ...change };
            const edited = await this.gridOf(request, (message) => this.studio.say(sentence(message), "warning"));
            if (!edited) return;
            const { photograph } = this;
            photograph?.dots.follow(grid, edited);
            this.kolam.setGrid(edited, true);
            const { x, level } = { x: place.x + edited.moved.x, level: place.level + edited.moved.level };
            this.cursor = placesAround(edited).findIndex((each) => each.x === x && each.level === level);
            this.commit();
            if (this.isKeyboard) this.announce();
            if (photograph && !isDot) await this.readNewGaps(photograph, grid);
        });
    }

    /// Reads the gaps around added dots from the photograph.
    private async readNewGaps(photograph: Photograph, before: DotGrid): Promise<void> {
        const { grid } = this.kolam;
        const { x, level } = grid.moved;
        const old = new Set(before.gaps.map((gap) => `${gap.x + x} ${gap.level + level}`));
        try {
            const reading = { part: photograph.part, fixes: photograph.dots.fixes(grid) };
            const { found } = await requestReading(this.studio, photograph.file, reading);
            const read = parseStates(grid, found.gaps);
            if (photograph !== this.photograph || found.grid !== grid.text || grid !== this.kolam.grid || !read) return;
            const fresh = [...grid.gaps.keys()].filter((gap) => !old.has(`${grid.gaps[gap].x} ${grid.gaps[gap].level}`));
            const states = this.kolam.states.slice();
            for (const gap of fresh) states[gap] = read[gap];
            this.kolam.setStates(states);
            this.kolam.doubts = new Set([...this.kolam.doubts, ...fresh.filter((gap) => found.doubtful.includes(gap))]);
            this.commit();
        } catch (error) {
            if (error instanceof RequestFailed) this.studio.say(sentence(error.message), "warning");
        }
    }

    private async random(chances: Chances): Promise<void> {
        this.chances = chances;
        this.update();
        const { kolam } = this;
        const symmetry = kolam.isChosen ? kolam.symmetry.name : kolam.grid.symmetries[0].name;
        const { density, joined: share, composed, seed } = chances;
        await this.ask({ symmetry, seed: String(seed), density, joined: share, composed }, "kolam at random");
    }

    /// Without a chosen symmetry, those that the drawing can keep are tried from the largest.
    private async makeSingle(): Promise<void> {
        const { kolam } = this;
        if (kolam.count === 1) {
            this.studio.say("The kolam is already a single line.");
            return;
        }
        const { symmetries } = kolam.grid;
        const tried =
            kolam.isChosen || kolam.symmetry.name === "none"
                ? [kolam.symmetry]
                : symmetries.slice(symmetries.indexOf(kolam.symmetry));
        let obstacle = "";
        for (const symmetry of tried) {
            const reason = kolam.isJoined ? symmetry.obstacleIfJoined : symmetry.obstacle;
            const result = reason ?? (await this.makeSingleWith(symmetry));
            if (result === null) return;
            obstacle ||= result;
        }
        if (obstacle) this.studio.say(sentence(obstacle), "warning");
    }

    /// Returns why there is none, or null if it was made.
    private async makeSingleWith({ name, orbits }: GridSymmetry): Promise<string | null> {
        const { kolam, chances } = this;
        const { density, composed, joined: share, seed } = chances;
        const wanted: Partial<GridRequest> = { symmetry: name, seed: String(seed), single_line: true };
        if (name === "none") {
            return this.ask({ ...wanted, gaps: statesText(kolam.states) }, "kolam as one line");
        }
        const found = singleLineNear(kolam.grid, orbits, kolam.states, makeChance(seed));
        if (!found) return this.ask({ ...wanted, density, composed, joined: share }, "kolam as one line");
        kolam.setStates(found);
        kolam.setSymmetry(name, kolam.isChosen);
        this.commit();
        return null;
    }

    private request(more: Partial<GridRequest>): GridRequest {
        const { isColoured: coloured, hasCentredDots: centred, rim } = this.look;
        const title = this.word ? { title: wordTitle(this.word) } : {};
        return { do: "grid", grid: this.kolam.grid.text, coloured, centred, rim, ...title, ...more };
    }

    /// Asks the libraries for the gaps, and keeps the symmetry. Returns the obstacle if there is one, otherwise null.
    private async ask(wanted: Partial<GridRequest>, merge: string): Promise<string | null> {
        const mine = ++this.asked;
        const { engine } = this.studio;
        const { kolam } = this;
        try {
            const { json } = await engine.request<Grid>(this.request(wanted), { key: "bench" });
            if (mine !== this.asked) return null;
            const states = parseStates(kolam.grid, json.gaps);
            if (json.obstacle || !states) return json.obstacle ?? null;
            kolam.setStates(states);
            kolam.setSymmetry(wanted.symmetry ?? kolam.symmetry.name, kolam.isChosen);
            this.update();
            this.store(json.text, merge);
        } catch (error) {
            if (error instanceof RequestFailed) this.studio.say(sentence(error.message), "error");
        }
        return null;
    }

    /// Shows the change at once; the text is updated when the libraries have written it.
    private commit(): void {
        this.update();
        const mine = ++this.asked;
        const request = this.request({ gaps: statesText(this.kolam.states) });
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
        const { kolam, look } = this;
        const made = withLook(bare, look, this.word) + doubtsText(kolam.grid, kolam.doubts);
        const { pattern } = store.work;
        const isOurs = pattern.text === this.text || readKolam(pattern.text) !== null;
        this.text = isOurs ? withEditsOf(pattern.text, this.made, made) : made;
        this.made = made;
        const fresh = { name: "kolam.lsys", variant: "", settings: [] };
        // Only some kolams have productions. Keys that the bench has changed are no longer replaced by values.
        const before = readKolam(pattern.text);
        const changed = before ? look_keys.filter(([name]) => before[name] !== look[name]).map(([, key]) => key) : [];
        const settings = ["derivation length", ...changed.flat()].reduce(
            (rest, name) => withOption(rest, name, null),
            pattern.settings,
        );
        store.change({ pattern: { ...pattern, ...(isOurs ? { settings } : fresh), text: this.text }, place: null }, merge);
        latestPhotograph()?.dots.keep(store.work.pattern); // dots may have moved without a change of the text
        if (!isOurs) this.studio.say("The kolam has replaced the pattern. Undo restores it.");
        void this.examine();
    }

    // --- photograph ---------------------------------------------------------------------------------------------

    /// The photograph that the dots lie on.
    private get photograph(): Photograph | null {
        const latest = latestPhotograph();
        return latest?.dots.shift ? latest : null;
    }

    private setView(view: View): void {
        if (!this.photograph) return;
        this.photograph.view = view;
        this.update();
    }

    private readNextKolam(): void {
        const { photograph } = this;
        if (!photograph) return;
        void readPhotograph(this.studio, photograph.file, { part: (photograph.part % photograph.found.readable) + 1 });
    }

    /// Selects the next doubtful gap, in the order of gaps.
    private selectDoubt(): void {
        const { doubts } = this.kolam;
        if (doubts.size === 0) return;
        if (this.tool === "dots") this.setTool("next");
        const sorted = [...doubts].sort((a, b) => a - b);
        this.cursor = sorted.find((gap) => gap > this.cursor) ?? sorted[0];
        this.isKeyboard = true;
        this.isDone = false;
        this.announce();
    }

    /// The selected doubtful gap, or all of them, are right.
    private settle(all: boolean): void {
        const { kolam, cursor } = this;
        if (!all && !kolam.doubts.has(cursor)) {
            this.selectDoubt();
            return;
        }
        kolam.settle(all ? [...kolam.doubts] : kolam.orbits[cursor]);
        this.commit();
        if (kolam.doubts.size > 0) this.selectDoubt();
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

    private get places(): Place[] | null {
        if (this.tool !== "dots") return null;
        const { grid } = this.kolam;
        if (this.around.grid !== grid) this.around = { grid, places: placesAround(grid) };
        return this.around.places;
    }

    /// Targets of pointer and keyboard: gaps, or places for dots.
    private get targets(): Place[] {
        return this.places ?? this.kolam.grid.gaps;
    }

    private point(event: PointerEvent): void {
        const target = this.board.targetAt(this.scene(), event.offsetX, event.offsetY);
        this.isKeyboard = false;
        if (this.painting !== null && target >= 0 && this.kolam.states[target] !== this.painting) {
            this.cursor = target;
            this.changeGap(this.painting);
        }
        if (target === this.cursor) return;
        this.cursor = target;
        this.isDone = false;
        this.showHover();
        this.redraw();
    }

    private leave(): void {
        if (this.isKeyboard || this.painting !== null) return;
        this.cursor = -1;
        this.isDone = false;
        this.showHover();
        this.redraw();
    }

    private press(event: KeyboardEvent): void {
        const { targets } = this;
        if (event.ctrlKey || event.metaKey || event.altKey || targets.length === 0) return;
        const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
        const state = this.tool === "dots" ? undefined : state_keys[event.key.toLowerCase()];
        const doubt = this.tool === "dots" || this.kolam.doubts.size === 0 ? "" : event.key.toLowerCase();
        if (doubt === "n" || doubt === "r") {
            event.preventDefault();
            if (doubt === "n") this.selectDoubt();
            else this.settle(false);
            return;
        }
        const isChange = event.key === " " || event.key === "Enter" || state !== undefined;
        if (!way && !isChange) return;
        event.preventDefault();
        this.isKeyboard = true;
        this.isReverse = event.shiftKey;
        if (this.cursor < 0) {
            this.cursor = 0;
        } else if (way) {
            const here = targets[this.cursor].x;
            if (way[0] !== 0) this.column = null;
            else this.column ??= here;
            this.cursor = neighbour(targets, this.cursor, way[0], way[1], this.column ?? here);
            this.isDone = false;
        } else if (this.tool === "dots") {
            this.toggleDot();
            return;
        } else {
            this.changeGap(state ?? this.gapChange);
        }
        this.announce();
    }

    private announce(): void {
        if (this.cursor < 0) return;
        const { kolam, places } = this;
        this.spoken.textContent = places ? placeText(kolam, places[this.cursor]) : gapText(kolam, this.cursor);
        this.showHover();
        this.redraw();
    }

    private showHover(): void {
        const { kolam, cursor, places } = this;
        this.hover.textContent =
            cursor < 0 ? ""
            : places ? placeText(kolam, places[cursor])
            : changeText(kolam, cursor, this.gapChange);
    }

    // --- drawing ---------------------------------------------------------------------------------------------

    private scene(): Scene {
        const { grid, states, drawn: strands, lineOrbits, orbits } = this.kolam;
        const { cursor, isKeyboard, places } = this;
        const isGap = cursor >= 0 && !places;
        const after = isGap && !this.isDone && !isKeyboard ? this.kolam.after(cursor, this.gapChange) : null;
        const orbit = isGap ? orbits[cursor] : [];
        const { look, kolam: { doubts } } = this;
        const underlay = this.underlay();
        return { grid, states, strands, lineOrbits, look, doubts, underlay, cursor, orbit, after, places, isFocused: isKeyboard };
    }

    /// Made once for each state of the photograph, because the board compares it.
    private underlay(): Underlay | null {
        const { photograph, laid, kolam: { grid } } = this;
        const { view, dots: { shift = null } = {} } = photograph ?? {};
        if (laid.photograph !== photograph || laid.grid !== grid || laid.shift !== shift || laid.view !== view) {
            this.laid = { photograph, grid, shift, view, made: photograph?.underlay(grid) ?? null };
        }
        return this.laid.made;
    }

    private update(): void {
        const { kolam } = this;
        const { grid, count } = kolam;
        this.side.update({ kolam, chances: this.chances, look: this.look, word: this.word, photograph: this.photograph });
        this.tools.update(this.tool);
        this.canvas.setAttribute(
            "aria-label",
            `Kolam on ${counted(grid.dots.length, "dot")}: ${counted(count, "line")}, ${statesTold(kolam)}`,
        );
        this.showHover();
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

export const makeBenchPanel: MakePanel = (studio) => new BenchPanel(studio);
