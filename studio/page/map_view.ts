// The map: what it shows, and how it comes to the screen. The drawing never disappears: what was there last stays,
// moved and scaled, until better pictures have come.
import { cameraWith, fitting, limited, panned, pixelOf, pointAt, windowOf, type Camera, type Size } from "./camera";
import { RequestFailed, type Studio, type Work } from "./context";
import { decimalsOf } from "./camera";
import { exactOf, exactText, readExact } from "./decimal";
import { eased, flight, followed, rung, type Zoom } from "./flight";
import { bitmapAtOnce, isAbort, TileLoader, type Bitmap, type Subject } from "./pictures";
import type { Opened, Pixels } from "./protocol";
import { cameraOfSheet, isComposed, laidOut, pageOptions, planeOptions, sheetOf, styleOf, type Laid } from "./sheet";
import { levelScale, seenTiles, tileBox, tileGrid, type TileGrid } from "./tiles";

/// A picture of a whole view: of the page, or of a part of the plane.
interface Overview {
    readonly kind: "page" | "plane";
    readonly name: string; // of what it shows
    readonly bitmap: Bitmap;
    readonly ratio: number;
    readonly camera: Camera | null; // of a page: under which the plane lies as the drawing does
    readonly size: Size; // of the view, or of the part of it that the picture fills
    readonly laid: Laid; // of a page: where it lay
    readonly ground: string;
}

const restAfter = 140; // milliseconds without motion until pictures at exactly this scale are made
const keepAfter = 300; // … until the work learns what is looked at
const mostNamed = 16e6; // characters of patterns whose pictures are known by name
const slowPicture = 28; // milliseconds: slower pictures are made smaller while a slider moves

export class MapView {
    size: Size = { width: 0, height: 0 };
    mode: "page" | "plane" = "page";
    camera: Camera = { x: 0n, y: 0n, scale: 0.1 };
    problem = ""; // why the last picture is missing

    private readonly context: CanvasRenderingContext2D;
    private readonly tiles: TileLoader;
    private readonly names = new Map<string, string>();
    private named = 0;
    private namedLength = 0;
    private ratio = 1;
    private grid: TileGrid = tileGrid(1);
    private isShown = false;
    private facts: { facts: Opened; pattern: Work["pattern"] } | null = null;
    private work: Work;
    private pageName = "";
    private planeName = "";
    private overview: Overview | null = null;
    private refused = ""; // what cannot be drawn
    private asked = ""; // the overview that is being made
    private count = 0; // of overviews asked for
    private shown = 0; // number of the one that is shown
    private readonly busy = [0, 0]; // requests for overviews
    private quality = 1; // of overviews while a slider moves
    private fineTime = 0; // milliseconds that the last one at full quality took
    private isCoarseQuicker = true;
    private changed = -1e9; // time of the last change of the work
    private moved = -1e9; // time of the last motion
    private entered = -1e9; // time the plane was entered
    private zoom: Zoom | null = null;
    private journey: { at(share: number): Camera; start: number; milliseconds: number; then: () => void } | null = null;
    private loupe = { zoom: 1, right: 0, down: 0 }; // of pages that have no plane
    private frame = 0;
    private before = 0; // time of the last frame
    private restTimer = 0;
    private keepTimer = 0;
    private kept: Work["place"] = null;

    /// @param onChange  after every frame that shows something else
    constructor(
        private readonly studio: Studio, readonly canvas: HTMLCanvasElement, private readonly onChange: () => void,
    ) {
        this.context = canvas.getContext("2d")!;
        this.tiles = new TileLoader(studio.engine, () => this.draw());
        this.work = studio.store.work;
        this.setWork(this.work);
        if (studio.opened) this.setFacts(studio.opened.facts, studio.opened.work);
    }

    // --- what is to be seen

    show(): void {
        this.isShown = true;
        this.resize();
        this.setWork(this.studio.store.work);
    }

    hide(): void {
        this.isShown = false;
        this.tiles.want(null);
        cancelAnimationFrame(this.frame);
        this.frame = 0;
    }

    resize(): void {
        const { clientWidth: width, clientHeight: height } = this.canvas;
        if (width === 0 || height === 0) return;
        const ratio = Math.min(3, window.devicePixelRatio || 1);
        const isNew = width !== this.size.width || height !== this.size.height || ratio !== this.ratio;
        this.size = { width, height };
        this.ratio = ratio;
        this.grid = tileGrid(ratio);
        if (!isNew) return;
        this.canvas.width = Math.round(width * ratio);
        this.canvas.height = Math.round(height * ratio);
        this.paint(performance.now());
        this.rest();
    }

    setWork(work: Work): void {
        const isOther = work.pattern !== this.work.pattern || work.draw !== this.work.draw;
        this.work = work;
        if (isOther || this.pageName === "") {
            this.pageName = this.nameOf("page", work, pageOptions(work.draw));
            this.planeName = this.nameOf("plane", work, planeOptions(work.draw));
        }
        if (isOther) {
            this.changed = performance.now();
            this.loupe = { zoom: 1, right: 0, down: 0 };
        }
        this.takePlace();
        this.refresh();
        this.draw();
    }

    setFacts(facts: Opened, work: Work): void {
        this.facts = { facts, pattern: work.pattern };
        if (!facts.extent && !facts.is_spatial) void this.measure(facts, work);
        if (this.mode === "plane" && facts.is_spatial) this.mode = "page";
        this.refresh();
        this.draw();
    }

    // Of splines, the extent is that of the points that guide them.
    private async measure(facts: Opened, { pattern }: Work): Promise<void> {
        try {
            const { json } = await this.studio.engine.request<{ box?: (string | number)[] }>({ do: "measure", pattern },
                { key: "map-extent", seconds: 3 });
            const box = json.box?.map((side) => exactText(readExact(String(side)) ?? 0n));
            if (box?.length !== 4 || this.facts?.facts !== facts) return;
            this.setFacts({ ...facts, extent: box as [string, string, string, string] }, this.studio.opened?.work ?? this.work);
        } catch {
            // too long to be measured: the drawing has a page only
        }
    }

    /// The facts of the work that is shown; null while they are unknown.
    get known(): Opened | null {
        return this.facts?.pattern === this.work.pattern ? this.facts.facts : null;
    }

    /// True if parts of the plane can be shown.
    get hasPlane(): boolean {
        const facts = this.facts?.facts;
        return !!facts?.extent && !facts.is_spatial;
    }

    /// True if the view shows no place where the drawing can be.
    get isElsewhere(): boolean {
        const extent = this.known?.extent?.map(readExact);
        if (this.mode !== "plane" || !extent) return false;
        const [x0, y0, x1, y1] = extent;
        if (x0 == null || y0 == null || x1 == null || y1 == null) return false;
        const low = pointAt(this.camera, this.size, 0, this.size.height);
        const high = pointAt(this.camera, this.size, this.size.width, 0);
        const pen = exactOf(1); // lines are wider than their positions
        return high.x < x0 - pen || low.x > x1 + pen || high.y < y0 - pen || low.y > y1 + pen;
    }

    private get isTiled(): boolean {
        const facts = this.known;
        return !!facts?.has_view && !isComposed(facts, this.work.draw);
    }

    /// True if less than the whole page is seen.
    get isMagnified(): boolean { return this.mode === "page" && this.loupe.zoom > 1; }

    get isMoving(): boolean {
        return this.zoom !== null || this.journey !== null;
    }

    private nameOf(kind: string, work: Work, options: unknown): string {
        const text = JSON.stringify([kind, work.pattern, options]);
        let name = this.names.get(text);
        if (name === undefined) {
            name = `${kind}-${++this.named}`;
            this.names.set(text, name);
            this.namedLength += text.length;
            for (const [oldest] of this.names) {
                if (this.namedLength < mostNamed || oldest === text) break;
                this.names.delete(oldest);
                this.namedLength -= oldest.length;
            }
        }
        return name;
    }

    // The place of the work, if it was changed elsewhere: by a link, or by undo.
    private takePlace(): void {
        const { place } = this.work;
        if (JSON.stringify(place) === JSON.stringify(this.kept)) return;
        this.kept = place;
        if (!place) {
            this.mode = "page";
            return;
        }
        const x = readExact(place.x);
        const y = readExact(place.y);
        if (x === null || y === null || !(place.scale > 0)) return;
        this.stop();
        this.mode = "plane";
        this.camera = { x, y, scale: limited(place.scale) };
    }

    private keepSoon(): void {
        clearTimeout(this.keepTimer);
        this.keepTimer = window.setTimeout(() => this.keep(), keepAfter);
    }

    private keep(): void {
        if (this.isMoving) return this.keepSoon();
        const { x, y, scale } = this.camera;
        const decimals = decimalsOf(scale) + 3;
        this.kept = this.mode === "plane"
            ? { x: exactText(x, decimals), y: exactText(y, decimals), scale: Number(scale.toPrecision(12)) } : null;
        this.studio.store.change({ place: this.kept }, "place");
    }

    // --- moving about

    private get laid(): Laid { return laidOut(sheetOf(this.work.draw), this.size); }

    private get pageCamera(): Camera | null {
        const facts = this.known;
        return facts && cameraOfSheet(sheetOf(this.work.draw), this.laid, this.size, facts, this.work.draw);
    }

    private stop(): void {
        this.zoom = null;
        this.journey = null;
    }

    // Leaves the page for the plane; false where there is none, or where it does not lie as the page does.
    private enter(mayJump = false): boolean {
        if (this.mode === "plane") return true;
        const facts = this.known;
        if (!facts?.extent || !this.hasPlane) return false;
        const camera = this.pageCamera ?? (mayJump ? fitting(facts.extent, this.size, 48) : null);
        if (!camera) return false;
        this.camera = camera;
        this.mode = "plane";
        this.entered = performance.now();
        return true;
    }

    panBy(right: number, down: number): void {
        this.stop();
        if (this.mode === "page" && this.loupe.zoom > 1) {
            this.loupe = { ...this.loupe, right: this.loupe.right + right, down: this.loupe.down + down };
        } else if (this.enter()) {
            this.camera = panned(this.camera, right, down);
        }
        this.hasMoved();
    }

    /// Zooms in by a factor around a pixel of the view; at once, or as a short motion.
    zoomBy(factor: number, left = this.size.width / 2, top = this.size.height / 2, isAtOnce = false): void {
        if (!this.enter()) return this.loupeBy(factor, left, top);
        this.journey = null;
        const near = this.zoom && Math.hypot(this.zoom.left - left, this.zoom.top - top) < 2 ? this.zoom : null;
        const target = this.bounded((near?.target ?? this.camera.scale) / factor);
        const point = near?.point ?? pointAt(this.camera, this.size, left, top);
        if (isAtOnce || isStill()) {
            this.zoom = null;
            this.camera = cameraWith(point, this.size, left, top, target);
        } else {
            this.zoom = { point, left, top, target: rung(target) };
        }
        this.hasMoved();
    }

    // Coarser than this there is nothing but a speck.
    private bounded(scale: number): number {
        const extent = this.known?.extent;
        const whole = extent && fitting(extent, this.size, 48);
        return limited(whole ? Math.min(scale, Math.max(whole.scale * 32, this.camera.scale)) : scale);
    }

    private loupeBy(factor: number, left: number, top: number): void {
        const zoom = Math.min(8, Math.max(1, this.loupe.zoom * factor));
        const change = zoom / this.loupe.zoom;
        const across = left - this.size.width / 2;
        const along = top - this.size.height / 2;
        this.loupe = zoom === 1 ? { zoom, right: 0, down: 0 } : {
            zoom, right: across + (this.loupe.right - across) * change, down: along + (this.loupe.down - along) * change,
        };
        this.hasMoved();
    }

    /// Two fingers: what was under their middle follows it.
    pinch(from: { left: number; top: number }, to: { left: number; top: number }, factor: number): void {
        this.panBy(to.left - from.left, to.top - from.top);
        this.zoomBy(factor, to.left, to.top, true);
    }

    showPage(): void {
        this.stop();
        this.loupe = { zoom: 1, right: 0, down: 0 };
        const to = this.mode === "plane" ? this.pageCamera : null;
        const arrive = () => {
            this.mode = "page";
            this.refresh();
            this.hasMoved();
        };
        if (to) this.travel(to, arrive);
        else arrive();
    }

    /// Fits the drawing into the view.
    showDrawing(): void {
        const extent = this.known?.extent;
        const to = extent && fitting(extent, this.size, Math.min(this.size.width, this.size.height) < 480 ? 24 : 56);
        if (to && this.enter(true)) this.travel(to);
    }

    /// Goes to a camera; motion takes longer the farther it is.
    travel(to: Camera, then: () => void = () => {}, milliseconds?: number): void {
        if (!this.enter(true)) return;
        this.stop();
        const octaves = Math.abs(Math.log2(to.scale / this.camera.scale));
        const time = milliseconds ?? Math.min(2400, 280 + 60 * octaves);
        if (isStill()) {
            this.camera = to;
            then();
            return this.hasMoved();
        }
        this.journey = { at: flight(this.camera, to), start: performance.now(), milliseconds: time, then };
        this.hasMoved();
    }

    private hasMoved(): void {
        this.moved = performance.now();
        this.rest();
        this.keepSoon();
        this.draw();
    }

    // When all has been still for a moment, exact pictures are made.
    private rest(): void {
        clearTimeout(this.restTimer);
        this.restTimer = window.setTimeout(() => {
            if (this.isMoving) return this.rest();
            this.refresh();
            this.draw();
        }, restAfter);
    }

    // --- pictures

    private get isResting(): boolean {
        const now = performance.now();
        return !this.isMoving && now - this.moved > restAfter - 20 && now - this.changed > restAfter - 20;
    }

    // Asks for a picture of the whole view if the last one does not serve.
    private refresh(): void {
        if (!this.isShown || this.size.width === 0) return;
        if (this.mode === "page") this.refreshPage();
        else this.refreshPlane();
    }

    private refreshPage(): void {
        const { width } = this.laid;
        const isCurrent = this.overview?.kind === "page" && this.overview.name === this.pageName;
        const fine = this.ratio * this.loupe.zoom;
        if (isCurrent) {
            const pixels = this.overview!.bitmap.width;
            const wanted = Math.min(4096, width * fine);
            if (Math.abs(pixels - wanted) < 2 || (pixels > wanted && pixels < 2 * wanted)) return;
            if (!this.isResting) return this.rest();
            void this.askPage(fine);
        } else {
            void this.askPage(Math.min(1, this.ratio) * this.quality);
        }
    }

    private async askPage(ratio: number): Promise<void> {
        const { laid, size, work, pageName: name } = this;
        const camera = this.pageCamera;
        const most = Math.min(1, 4096 / (Math.max(laid.width, laid.height) * ratio));
        await this.ask(`${name} ${ratio} ${laid.width}`, {
            do: "pixels", width: Math.max(16, Math.round(laid.width * ratio * most)),
            height: Math.max(16, Math.round(laid.height * ratio * most)),
            ratio: ratio * most, options: pageOptions(work.draw), pattern: work.pattern,
        }, (bitmap) => ({ kind: "page", name, bitmap, ratio, camera, size, laid, ground: this.groundOf(work) }));
    }

    private refreshPlane(): void {
        const { overview } = this;
        const isOfPage = overview?.kind === "page" && overview.name === this.pageName && overview.camera !== null;
        const isCurrent = isOfPage || (overview?.kind === "plane" && overview.name === this.planeName);
        if (!isCurrent) return void this.askPlane(Math.min(1, this.ratio) * this.quality, 0);
        if (!this.known || this.isTiled) return;
        const isHere = overview?.kind === "plane" && overview.ratio === this.ratio && covers(overview, this.camera, this.size);
        if (isHere) return;
        if (!this.isResting) return this.rest();
        void this.askPlane(this.ratio, 0.2);
    }

    // `around`: so much of the view beyond its edges.
    private async askPlane(ratio: number, around: number): Promise<void> {
        const { camera, work, planeName: name } = this;
        const pixels = (length: number) => Math.max(16, Math.round(length * (1 + 2 * around) * ratio));
        const [across, down] = [pixels(this.size.width), pixels(this.size.height)];
        const size = { width: across / ratio, height: down / ratio };
        await this.ask(`${name} ${ratio} ${camera.x} ${camera.y} ${camera.scale} ${across}`, {
            do: "pixels", width: across, height: down, window: windowOf(camera, size), ratio,
            options: planeOptions(work.draw), pattern: work.pattern,
        }, (bitmap) => ({ kind: "plane", name, bitmap, ratio, camera, size, laid: this.laid, ground: this.groundOf(work) }));
    }

    private async ask(
        what: string, request: Parameters<Studio["engine"]["request"]>[0], made: (bitmap: Bitmap) => Overview,
    ): Promise<void> {
        if (what === this.asked || what === this.refused) return;
        this.asked = what;
        const number = ++this.count;
        const start = performance.now();
        try {
            const answer = await this.requestOverview<Pixels>(request);
            const overview = made(bitmapAtOnce(answer));
            if (number < this.shown) return overview.bitmap.close(); // a later one was quicker
            this.shown = number;
            this.note(performance.now() - start, overview.ratio / Math.min(1, this.ratio));
            if (this.asked === what) this.asked = "";
            if (overview.kind !== this.mode && this.overview) return overview.bitmap.close();
            this.overview?.bitmap.close();
            this.overview = overview;
            const warnings = overview.kind === "page" ? answer.json.remarks.filter((remark) => remark.is_warning) : [];
            this.setProblem(warnings.map(({ text }) => text).join("\n"));
            this.draw();
            this.rest();
        } catch (error) {
            if (this.asked === what) this.asked = "";
            if (isAbort(error)) return;
            this.refused = what;
            const isOfText = error instanceof RequestFailed && error.failure.kind === "pattern"; // the editor shows it
            this.setProblem(isOfText ? "" : error instanceof Error ? error.message : String(error));
        }
    }

    // With workers to spare, two pictures are made at a time while a slider moves.
    private async requestOverview<Json>(request: Parameters<Studio["engine"]["request"]>[0]) {
        const slots = this.studio.engine.workers >= 4 ? 2 : 1;
        const slot = slots > 1 && this.busy[0]! > this.busy[1]! ? 1 : 0;
        ++this.busy[slot]!;
        try {
            return await this.studio.engine.request<Json>(request, { key: `map-${slot}`, lane: "front" });
        } finally {
            --this.busy[slot]!;
        }
    }

    private setProblem(text: string): void {
        this.problem = text;
        this.onChange();
    }

    // How good pictures may be while a slider moves: coarser ones, if they are slow and coarser ones are quicker.
    private note(milliseconds: number, quality: number): void {
        if (quality >= 1) {
            const isNew = milliseconds > 2 * this.fineTime || milliseconds < this.fineTime / 2;
            if (isNew) this.isCoarseQuicker = true;
            this.fineTime = milliseconds;
        } else if (milliseconds > 0.75 * this.fineTime) {
            this.isCoarseQuicker = false;
        }
        this.quality = milliseconds < slowPicture || !this.isCoarseQuicker ? 1 : 0.5;
    }

    // For tests.
    private tell({ name, ratio }: Overview): void {
        const text = `${name} at ${ratio}`;
        if (this.canvas.dataset["shows"] !== text) this.canvas.dataset["shows"] = text;
    }

    private groundOf(work: Work): string {
        const facts = this.facts?.facts;
        const text = facts ? styleOf("ground", facts, work.draw) ?? "white" : "white";
        return text === "none" ? "none" : CSS.supports("color", text) ? text : "white";
    }

    private wantTiles(now: number): void {
        if (this.mode !== "plane" || !this.isTiled || this.size.width === 0) return this.tiles.want(null);
        if (now - this.changed < 60) return;
        const isMoving = this.isMoving || now - this.moved < restAfter - 30;
        const scale = isMoving ? levelScale(this.camera.scale) : this.camera.scale;
        const subject: Subject = {
            name: this.planeName, pattern: this.work.pattern, options: planeOptions(this.work.draw),
        };
        this.tiles.want(subject, seenTiles(this.camera, this.size, this.grid, scale), this.grid, this.ratio);
    }

    // --- painting

    draw(): void {
        if (!this.isShown || this.frame) return;
        this.frame = requestAnimationFrame((now) => {
            this.frame = 0;
            this.advance(now);
            this.paint(now);
            this.wantTiles(performance.now());
            if (this.isMoving || now - this.entered < 260) this.draw();
            this.before = now;
            this.onChange();
        });
    }

    private advance(now: number): void {
        const passed = Math.min(50, Math.max(1, now - this.before));
        if (this.journey) {
            const { at, start, milliseconds, then } = this.journey;
            const share = Math.min(1, Math.max(0, (now - start) / milliseconds));
            this.camera = at(share >= 1 ? 1 : eased(share));
            this.moved = performance.now();
            if (share >= 1) {
                this.journey = null;
                then();
                this.rest();
            }
        } else if (this.zoom) {
            const { camera, isThere } = followed(this.camera, this.zoom, this.size, passed);
            this.camera = camera;
            this.moved = performance.now();
            if (isThere) {
                this.zoom = null;
                this.rest();
            }
        }
    }

    private paint(now: number): void {
        const { context, canvas } = this;
        context.setTransform(1, 0, 0, 1, 0, 0);
        context.clearRect(0, 0, canvas.width, canvas.height);
        const { overview } = this;
        if (!overview) return;
        this.tell(overview);
        if (this.mode === "page" && overview.kind === "page") this.paintPage(overview);
        else this.paintPlane(overview, now);
    }

    // The sheet, which may be seen through the loupe.
    private paintPage(overview: Overview): void {
        const { laid, loupe, size, ratio } = this;
        const place = (left: number, top: number) => [
            Math.round(((left - size.width / 2) * loupe.zoom + size.width / 2 + loupe.right) * ratio),
            Math.round(((top - size.height / 2) * loupe.zoom + size.height / 2 + loupe.down) * ratio),
        ] as const;
        const [left, top] = place(laid.left, laid.top);
        const [right, bottom] = place(laid.left + laid.width, laid.top + laid.height);
        this.paintSheet(overview, left, top, right - left, bottom - top, 1);
    }

    private paintSheet(overview: Overview, left: number, top: number, width: number, height: number, shade: number): void {
        const { context, ratio } = this;
        const isDark = document.documentElement.dataset["theme"] === "dark";
        for (const [blur, down, alpha] of [[28, 10, 0.2], [3, 1, 0.22]] as const) {
            context.save();
            context.shadowColor = isDark ? `rgba(0, 0, 0, ${alpha * 2 * shade})` : `rgba(60, 32, 12, ${alpha * shade})`;
            context.shadowBlur = blur * ratio;
            context.shadowOffsetY = down * ratio;
            context.fillStyle = overview.ground === "none" ? "#fff" : overview.ground;
            context.fillRect(left, top, width, height);
            context.restore();
        }
        if (overview.ground === "none") this.checker(left, top, width, height);
        context.imageSmoothingEnabled = true;
        context.imageSmoothingQuality = "high";
        context.drawImage(overview.bitmap.source, left, top, width, height);
    }

    private paintPlane(overview: Overview, now: number): void {
        const { context, canvas, ratio } = this;
        const isOfPage = overview.kind === "page" && overview.camera !== null;
        const entering = isOfPage ? Math.min(1, Math.max(0, (now - this.entered) / 240)) : 1;
        if (overview.ground === "none") this.checker(0, 0, canvas.width, canvas.height);
        const box = this.boxOf(overview);
        if (entering < 1 && box) this.paintSheet(overview, box.left, box.top, box.width, box.height, 1 - entering);
        if (overview.ground !== "none") {
            context.globalAlpha = entering;
            context.fillStyle = overview.ground;
            context.fillRect(0, 0, canvas.width, canvas.height);
            context.globalAlpha = 1;
        }
        context.imageSmoothingEnabled = true;
        context.imageSmoothingQuality = "medium";
        const hasTiles = overview.kind === "plane" ? overview.name === this.planeName : overview.name === this.pageName;
        const layers = hasTiles && entering >= 1 ? this.layers() : [];
        if (box && !layers.some((layer) => layer.isWhole)) drawPart(context, canvas, overview.bitmap, box);
        for (const layer of layers) {
            for (const { bitmap, box: tile } of layer.pieces) {
                const left = Math.round(tile.left * ratio);
                const top = Math.round(tile.top * ratio);
                const width = Math.round(tile.right * ratio) - left;
                const height = Math.round(tile.bottom * ratio) - top;
                if (width < 1 || height < 1) continue;
                if (overview.ground === "none") {
                    context.clearRect(left, top, width, height);
                    this.checker(left, top, width, height);
                }
                drawPart(context, canvas, bitmap, { left, top, width, height });
            }
        }
    }

    // Tiles that are there, the best last; none below a layer that covers all.
    private layers() {
        const layers: { isWhole: boolean; away: number; pieces: { bitmap: Bitmap; box: ReturnType<typeof tileBox> }[] }[] = [];
        const scales = this.tiles.scalesOf(this.planeName)
            .map((scale) => ({ scale, away: Math.log2(scale / this.camera.scale) }))
            .filter(({ away }) => away > -2.6 && away < 12)
            .sort((one, other) => badness(one.away) - badness(other.away));
        for (const { scale, away } of scales) {
            const seen = seenTiles(this.camera, this.size, this.grid, scale, 160);
            const pieces = seen.flatMap((tile) => {
                const bitmap = this.tiles.picture(this.planeName, tile);
                return bitmap ? [{ bitmap, box: tileBox(tile, this.camera, this.size, this.grid) }] : [];
            });
            if (pieces.length === 0) continue;
            const isWhole = pieces.length === seen.length;
            layers.unshift({ isWhole, away, pieces });
            if (isWhole || layers.length >= 6) break;
        }
        return layers;
    }

    // Where an overview lies now, in pixels of the canvas.
    private boxOf(overview: Overview): Box | null {
        const { camera, size, laid } = overview;
        if (!camera) return null;
        const part = overview.kind === "page" ? laid : { left: 0, top: 0, width: size.width, height: size.height };
        const from = pointAt(camera, size, part.left, part.top);
        const to = pointAt(camera, size, part.left + part.width, part.top + part.height);
        const low = pixelOf(this.camera, this.size, from.x, from.y);
        const high = pixelOf(this.camera, this.size, to.x, to.y);
        const { ratio } = this;
        const box = {
            left: Math.round(low.left * ratio), top: Math.round(low.top * ratio),
            width: Math.round((high.left - low.left) * ratio), height: Math.round((high.top - low.top) * ratio),
        };
        return Object.values(box).every((value) => Math.abs(value) < 1e9) ? box : null;
    }

    private checker(left: number, top: number, width: number, height: number): void {
        const { context, ratio } = this;
        const side = Math.round(10 * ratio);
        const isDark = document.documentElement.dataset["theme"] === "dark";
        context.save();
        context.beginPath();
        context.rect(left, top, width, height);
        context.clip();
        context.fillStyle = isDark ? "#2b2622" : "#fbfaf7";
        context.fillRect(left, top, width, height);
        context.fillStyle = isDark ? "#332d28" : "#efece5";
        const last = { x: Math.min(left + width, this.canvas.width), y: Math.min(top + height, this.canvas.height) };
        for (let y = Math.max(0, Math.floor(top / side)); y * side < last.y; ++y) {
            for (let x = Math.max(0, Math.floor(left / side)); x * side < last.x; ++x) {
                if ((x + y) % 2) context.fillRect(x * side, y * side, side, side);
            }
        }
        context.restore();
    }
}

interface Box { readonly left: number; readonly top: number; readonly width: number; readonly height: number }

// Finer tiles are better than coarser ones of the same distance.
function badness(away: number): number {
    return away > 0 ? away : -away * 0.9;
}

// Only the part within the canvas: browsers draw far-off corners imprecisely.
function drawPart(context: CanvasRenderingContext2D, canvas: HTMLCanvasElement, bitmap: Bitmap, box: Box): void {
    const left = Math.max(box.left, 0);
    const top = Math.max(box.top, 0);
    const right = Math.min(box.left + box.width, canvas.width);
    const bottom = Math.min(box.top + box.height, canvas.height);
    if (right <= left || bottom <= top) return;
    const across = bitmap.width / box.width;
    const down = bitmap.height / box.height;
    context.drawImage(bitmap.source, (left - box.left) * across, (top - box.top) * down, (right - left) * across,
        (bottom - top) * down, left, top, right - left, bottom - top);
}

// True if a picture of the plane shows all of the view at its scale.
function covers(overview: Overview, camera: Camera, size: Size): boolean {
    if (!overview.camera || Math.abs(overview.camera.scale / camera.scale - 1) > 1e-6) return false;
    const corner = pixelOf(overview.camera, overview.size, camera.x, camera.y);
    return Math.abs(corner.left - overview.size.width / 2) <= (overview.size.width - size.width) / 2 + 0.5
        && Math.abs(corner.top - overview.size.height / 2) <= (overview.size.height - size.height) / 2 + 0.5;
}

/// True if motion is to be avoided.
export function isStill(): boolean {
    return window.matchMedia("(prefers-reduced-motion: reduce)").matches;
}
