// The panel that shows a drawing as a model in space, with controls to turn, light and grow it.
import type { MakePanel, Studio, Work } from "./context";
import { button, checkbox, element, labelled, slideTo } from "./elements";
import { between, eyeText, readEye, turnedEye, type Eye } from "./eye";
import { showKind } from "./gallery";
import { Growth, type Grown } from "./growth";
import { makeLamp, usualLight } from "./lamp";
import { isDark, onTheme } from "./layout";
import { isStill } from "./map_motion";
import { openPattern } from "./opening";
import { withOption } from "./options";
import { addOrbit, type Orbit } from "./orbit";
import { Pace } from "./pace";
import { isAbort } from "./pictures";
import type { Opened } from "./protocol";
import { styleOf } from "./sheet";
import { Refusal } from "./refusal";
import { fittingHalf, Stage, type Staged } from "./space_stage";
import { isAnother } from "./versions";

const mostSegments = 150_000; // larger models would take hundreds of megabytes
const patience = 300; // milliseconds until the panel reports that it is making a model
const growing = 700; // milliseconds for each derivation length
const turning = 380; // milliseconds of the transition between two models
const usualPlant = "bush-3d";
const front: Eye = { azimuth: 0, elevation: 0, distance: null };

const icons = {
    play: "M5 3.2v9.6l8-4.8z",
    pause: "M5 3v10M11 3v10",
    turn: "M13.5 8a5.5 5.5 0 1 1-1.8-4.1M13.5 1.8v2.7h-2.7",
    reset: "M3 8l5-5 5 5M4.5 6.8V13h7V6.8",
};

export const makeSpacePanel: MakePanel = (studio) => {
    const panel = element("div", { class: "space" });
    let view: SpaceView | null = null;
    let hasFailed = false;
    return {
        name: "space",
        label: "Space",
        element: panel,
        show() {
            if (!view && !hasFailed) {
                view = SpaceView.make(studio, panel);
                hasFailed = view === null;
                if (hasFailed) {
                    panel.append(
                        element(
                            "div",
                            { class: "empty" },
                            element(
                                "p",
                                {},
                                "Models cannot be shown: this browser has no WebGL2. Prints of drawings in space " +
                                    "and OBJ and GLB files work without it.",
                            ),
                        ),
                    );
                }
            }
            view?.show();
        },
        hide() {
            view?.hide();
        },
    };
};

const flatReason = "This pattern is flat: prints show it from above, so they need no view.";

class SpaceView implements Orbit {
    eye: Eye = front;
    light = usualLight;
    zoom = 1;
    private readonly growth: Growth;
    private readonly note = element("div", { class: "note space-note", role: "status", hidden: true });
    private readonly refusal: Refusal;
    private readonly slider = element("input", { type: "range", id: "space-n", min: 0, max: 1, step: 1 });
    private readonly count = element("output", { class: "number space-n", for: "space-n" });
    private readonly facts = element("p", { class: "space-facts number" });
    private readonly play: HTMLButtonElement;
    private readonly turn: HTMLButtonElement;
    private readonly perspective = checkbox((isChecked) => {
        this.eye = { ...this.eye, distance: isChecked ? 4 : null };
        this.draw();
    });
    private readonly use: HTMLButtonElement;
    private readonly flat = element("p", { class: "space-flat", hidden: true }, flatReason);
    private readonly lamp = makeLamp((light) => {
        this.light = light;
        this.draw();
    });
    private readonly useLength: HTMLButtonElement;

    private isShown = false;
    private work: Work;
    private opened: Opened | null = null;
    private subject = "";
    private half = 0; // of the picture; 0: unknown
    private shift: [number, number] = [0, 0];
    private n = 0;
    private most = 0;
    private model: Grown | null = null;
    private before: { model: Grown; since: number } | null = null; // fading into this one
    private whole: Staged | null = null; // the model that the picture is framed for
    private isTurning = false;
    private isGrowing = false;
    private grownAt = 0;
    private frame = 0;
    private last = 0;
    private readonly pace = new Pace();
    private restTimer = 0;
    private asked = 0;
    private waitTimer = 0;

    static make(studio: Studio, panel: HTMLElement): SpaceView | null {
        const canvas = element("canvas", {
            class: "space-canvas",
            tabindex: 0,
            role: "img",
            "aria-label": "Model",
            "aria-describedby": "space-hint",
        });
        const stage = Stage.on(canvas);
        return stage && new SpaceView(studio, panel, canvas, stage);
    }

    private constructor(
        private readonly studio: Studio,
        private readonly panel: HTMLElement,
        private readonly canvas: HTMLCanvasElement,
        private readonly stage: Stage,
    ) {
        this.growth = new Growth(studio.engine, studio.help, stage);
        this.refusal = new Refusal(studio, this.note);
        this.work = studio.store.work;
        this.play = button("Grow", () => this.grow(!this.isGrowing), { icon: icons.play });
        this.turn = button("Turn around", () => this.spin(!this.isTurning), { icon: icons.turn });
        this.use = button("Use this view for prints", () => this.useView());
        this.useLength = button("Use this n", () => this.studio.store.setting("derivation length", String(this.n)));
        this.useLength.hidden = true;
        panel.append(
            canvas,
            element(
                "p",
                { class: "unseen", id: "space-hint" },
                "Arrow keys turn the drawing, plus and minus zoom, 0 resets the view. Dragging with the right " +
                    "mouse button or with Alt moves the light.",
            ),
            this.note,
            this.facts,
            this.makeTools(),
            this.lamp.element,
        );
        this.wire();
    }

    private makeTools(): HTMLElement {
        const reset = button("Reset the view (0)", () => this.reset(), { icon: icons.reset });
        return element(
            "div",
            { class: "space-tools" },
            element(
                "div",
                { class: "space-growth" },
                this.play,
                element("label", { for: "space-n" }, "Growth"),
                this.slider,
                this.count,
                this.useLength,
            ),
            element(
                "div",
                { class: "toolbar" },
                this.turn,
                reset,
                labelled(this.perspective, "Perspective"),
                this.use,
            ),
            this.flat,
        );
    }

    private wire(): void {
        const { canvas, studio } = this;
        addOrbit(canvas, this, 0.3, 40);
        this.slider.addEventListener("input", () => {
            this.grow(false);
            this.seek(Number(this.slider.value));
        });
        canvas.addEventListener("webglcontextlost", () => {
            this.hide();
            this.problem("The graphics driver has lost the model. Reload the page to show it again.");
        });
        new ResizeObserver(() => this.draw()).observe(canvas);
        onTheme(() => this.draw());
        studio.onOpened((facts, work) => this.open(facts, work));
        studio.onChecked(() => this.sayWaiting());
        studio.store.subscribe((work, before) => {
            if (isAnother(work.pattern, before.pattern)) this.forget();
            if (this.opened && work.draw !== before.draw && work.pattern === before.pattern)
                this.open(this.opened, work);
        });
    }

    show(): void {
        this.isShown = true;
        const { opened, store } = this.studio;
        // While a new text has errors, there is nothing to show.
        if (opened && !isAnother(opened.work.pattern, store.work.pattern)) this.open(opened.facts, opened.work);
    }

    hide(): void {
        this.isShown = false;
        this.grow(false);
        this.spin(false);
        cancelAnimationFrame(this.frame);
        this.frame = 0;
    }

    private problem(text: string, offersPlant = false): void {
        this.refusal.clear();
        this.note.textContent = text;
        this.note.hidden = text === "";
        if (offersPlant) this.offerPlant();
    }

    // Whoever looks for drawings in space finds one here.
    private offerPlant(): void {
        const entry = this.studio.patterns.find(({ name }) => name === usualPlant);
        if (!entry) return;
        const open = button("Open a plant", () => {
            openPattern(this.studio, { name: `${entry.name}.lsys`, text: entry.text }, "space");
        });
        const more = button("All plants", () => {
            this.studio.store.change({ panel: "gallery" });
            showKind("plants");
        });
        this.note.append(element("div", { class: "toolbar space-offer" }, open, more));
    }

    // Another pattern: nothing that is shown belongs to it.
    private forget(): void {
        ++this.asked;
        this.model = this.before = this.whole = null;
        this.subject = "";
        this.facts.textContent = "";
        this.canvas.setAttribute("aria-label", "Model");
        this.wait();
        this.draw();
    }

    // After a moment, reports that a model is being made, and dims the previous one.
    private wait(): void {
        clearTimeout(this.waitTimer);
        this.refusal.clear();
        this.waitTimer = window.setTimeout(() => {
            this.panel.classList.add("stale");
            this.sayWaiting();
        }, patience);
    }

    private sayWaiting(): void {
        if (!this.panel.classList.contains("stale")) return;
        this.problem(this.studio.hasErrors ? "The text has errors." : "Making the model…");
    }

    private endWait(): void {
        clearTimeout(this.waitTimer);
        this.panel.classList.remove("stale");
    }

    // The text or the values have changed: the last model stays until the next one is ready.
    private open(facts: Opened, work: Work): void {
        if (!this.isShown) return;
        const { name } = Growth.subject(this.studio.help, work);
        const isOther = this.opened === null || isAnother(work.pattern, this.work.pattern);
        const n = Number(facts.n);
        const isSame = name === this.subject && n === this.most;
        this.work = work;
        this.opened = facts;
        this.use.disabled = !facts.is_spatial;
        this.use.title = facts.is_spatial ? "" : flatReason;
        this.flat.hidden = facts.is_spatial;
        this.subject = name;
        if (isOther) {
            this.whole = null;
            this.reset();
        }
        if (isSame && this.model) {
            this.endWait();
            return this.draw();
        }
        this.grow(false);
        this.most = n;
        this.slider.max = String(n);
        this.seek(n);
    }

    private get isSpline(): boolean {
        return this.opened !== null && !!styleOf("line", this.opened, this.work.draw)?.startsWith("spline");
    }

    /// The reason why the drawing cannot have a model; empty if none is known.
    private get obstacle(): string {
        const facts = this.opened;
        if (!facts) return "";
        if (this.isSpline) {
            return (
                "Here plants and other drawings in space can be turned. This pattern draws a spline in the plane; " +
                "models consist of straight lines."
            );
        }
        const segments = Number(facts.cost.segments);
        if (!facts.cost.is_derivable)
            return "This drawing is too large for a model. Reduce the derivation length.";
        if (!(segments > mostSegments)) return "";
        return (
            `This drawing has ${segments.toLocaleString("en")} segments; a model can have at most ` +
            `${mostSegments.toLocaleString("en")}. Reduce the derivation length.`
        );
    }

    private seek(n: number): void {
        this.n = n;
        slideTo(this.slider, n);
        this.count.textContent = `n = ${n}`;
        this.useLength.hidden = n === this.most;
        void this.load(n);
    }

    private async load(n: number): Promise<void> {
        const { work } = this;
        const asked = ++this.asked;
        const { obstacle } = this;
        if (obstacle && (n === this.most || this.isSpline)) {
            this.drop();
            this.problem(obstacle, this.isSpline);
            return;
        }
        this.wait();
        try {
            const model = await this.growth.make(work, n, { key: "space" });
            if (asked !== this.asked) return;
            this.endWait();
            this.take(model, n);
            const isEmpty = model === "empty" && n === this.most;
            this.problem(isEmpty ? "This pattern draws nothing." : "", isEmpty);
        } catch (error) {
            if (isAbort(error) || asked !== this.asked) return;
            this.drop();
            this.refusal.show(error, work.pattern);
            if (!this.opened?.is_spatial) this.offerPlant();
        }
    }

    // Shows no model, because the drawing has none.
    private drop(): void {
        this.endWait();
        this.model = this.before = this.whole = null;
        this.facts.textContent = "";
        this.draw();
    }

    private take(model: Grown, n: number): void {
        if (this.model && this.model !== model && !isStill() && this.isGrowing) {
            this.before = { model: this.model, since: performance.now() };
        }
        this.model = model;
        if (model !== "empty" && n === this.most) {
            if (this.whole === null) this.half = 0;
            this.whole = model;
        }
        this.facts.textContent =
            model === "empty"
                ? "Nothing yet"
                : `${model.triangles.toLocaleString("en").replaceAll(",", "\u202f")} triangles`;
        this.describe();
        this.draw();
    }

    private describe(): void {
        const facts = this.opened;
        this.canvas.setAttribute(
            "aria-label",
            [
                `Model of ${facts?.title || "the drawing"}`,
                `derivation length ${this.n}`,
                `azimuth ${Math.round(between(this.eye.azimuth))} degrees`,
                `elevation ${Math.round(this.eye.elevation)} degrees`,
            ].join(", "),
        );
    }

    // --- motion

    shiftBy(right: number, down: number): void {
        this.shift = [
            Math.max(-2, Math.min(2, this.shift[0] + (2 * right) / this.canvas.clientWidth)),
            Math.max(-2, Math.min(2, this.shift[1] - (2 * down) / this.canvas.clientHeight)),
        ];
        this.draw();
    }

    stop(): void {
        this.spin(false);
    }

    reset(): void {
        const text = this.opened ? styleOf("view", this.opened, this.work.draw) : undefined;
        this.eye = readEye(text ?? "front") ?? front;
        this.zoom = 1;
        this.half = 0;
        this.shift = [0, 0];
        this.light = usualLight;
        this.draw();
    }

    private spin(isTurning: boolean): void {
        if (this.isTurning === isTurning) return;
        this.isTurning = isTurning;
        this.turn.setAttribute("aria-pressed", String(isTurning));
        this.last = performance.now();
        this.draw();
    }

    private grow(isGrowing: boolean): void {
        if (this.isGrowing === isGrowing) return;
        this.isGrowing = isGrowing;
        this.play.setAttribute("aria-pressed", String(isGrowing));
        this.play.setAttribute("aria-label", isGrowing ? "Stop growing" : "Grow");
        this.play.title = isGrowing ? "Stop growing" : "Grow";
        this.play.querySelector("path")?.setAttribute("d", isGrowing ? icons.pause : icons.play);
        if (!isGrowing) return;
        if (this.n >= this.most) this.seek(0);
        this.grownAt = performance.now();
        void this.lookAhead();
        this.draw();
    }

    // Makes the next models in advance.
    private async lookAhead(): Promise<void> {
        const { work } = this;
        for (let n = this.n; n <= this.most && this.isGrowing && work === this.work; ++n) {
            try {
                await this.growth.make(work, n, { key: "space-ahead", isAhead: true });
            } catch {
                return;
            }
        }
    }

    private advance(now: number): void {
        if (this.isTurning) {
            this.eye = turnedEye(this.eye, Math.min(60, now - this.last) * 0.018, 0);
        }
        if (this.before && now - this.before.since > turning) this.before = null;
        if (this.isGrowing && now - this.grownAt > growing) {
            if (this.n >= this.most) {
                this.grow(false);
            } else if (this.growth.kept(this.work, this.n + 1)) {
                this.grownAt = now;
                this.seek(this.n + 1);
            }
        }
        this.last = now;
    }

    draw(): void {
        if (!this.isShown || this.frame) return;
        this.frame = requestAnimationFrame((now) => {
            this.frame = 0;
            this.pace.frame(now);
            this.advance(now);
            this.paint(now);
            if (this.isTurning || this.isGrowing || this.before) this.draw();
            this.rest();
        });
    }

    // Motion may have been drawn at a lower resolution; a still picture has the full one.
    private rest(): void {
        clearTimeout(this.restTimer);
        if (this.pace.quality === 1) return;
        this.restTimer = window.setTimeout(() => {
            this.pace.rest();
            if (this.isShown && !this.frame) this.paint(performance.now());
        }, 250);
    }

    private paint(now: number): void {
        const { canvas } = this;
        const ratio = Math.min(2, window.devicePixelRatio || 1) * this.pace.quality;
        const width = Math.round(canvas.clientWidth * ratio);
        const height = Math.round(canvas.clientHeight * ratio);
        if (width === 0 || height === 0) return;
        if (canvas.width !== width || canvas.height !== height) {
            canvas.width = width;
            canvas.height = height;
        }
        this.perspective.checked = this.eye.distance !== null;
        this.lamp.show(this.light);
        const current = this.model;
        const frame = this.whole ?? (current !== "empty" ? current : null);
        if (!frame) return this.stage.clear();
        // The controls cover the bottom of the picture.
        const covered = Math.min(height / 3, 78 * ratio);
        if (this.half === 0)
            this.half =
                (fittingHalf(frame, this.eye, width, height - covered * 1.6) * Math.min(width, height)) /
                Math.min(width, height - covered * 1.6);
        const share = this.before ? Math.min(1, (now - this.before.since) / turning) : 1;
        const models = [
            ...(this.before && this.before.model !== "empty"
                ? [{ model: this.before.model, presence: 1 - share }]
                : []),
            ...(current && current !== "empty" ? [{ model: current, presence: share }] : []),
        ];
        this.stage.draw({
            models,
            frame,
            eye: this.eye,
            half: this.half,
            zoom: this.zoom,
            shift: [this.shift[0], this.shift[1] + covered / height],
            light: this.light,
            isDark: isDark(),
        });
    }

    private useView(): void {
        const view = eyeText(this.eye);
        this.studio.store.change({ draw: withOption(this.work.draw, "view", view) }, "view");
        this.work = this.studio.store.work;
        this.studio.say(`Prints now use this view: view ${view}.`);
    }
}
