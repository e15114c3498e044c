// The map: what it shows, and when pictures are asked for. The drawing never disappears: what was there last stays,
// moved and scaled, until better pictures have come; if it is not that of the work, it is dimmed.
import { cameraOf, decimalsOf, fitting, limited, pixelOf, pointAt, windowOf, type Camera, type Size } from "./camera";
import { RequestFailed, type Studio, type Work } from "./context";
import { exactOf, exactText, readExact } from "./decimal";
import { plainGround } from "./floors";
import { layersOf } from "./layers";
import { Motion } from "./map_motion";
import { Painter, type Loupe, type Overview } from "./map_painter";
import { Overviews } from "./overviews";
import { colourOf, TileLoader, type Bitmap, type Colour, type Subject } from "./pictures";
import { pageOptions, planeOptions } from "./option_scopes";
import type { Opened, Options, Request } from "./protocol";
import { cameraOfSheet, isComposed, laidOut, sheetOf, styleOf, type Laid } from "./sheet";
import { Subjects } from "./subjects";
import { levelScale, seenTiles, tileGrid, type TileGrid } from "./tiles";
import { isAnother } from "./versions";

const restAfter = 140; // milliseconds without motion until pictures at exactly this scale are requested
const keepAfter = 300; // … until the position is stored in the work
const enteringTime = 240; // milliseconds of the transition from the page to the plane
const widest = 4096; // pixels of a page's picture
export const drawing = "Drawing…";
const patience = 300; // milliseconds without a new picture until the map reports that it is drawing
const noLoupe: Loupe = { zoom: 1, right: 0, down: 0 };

export class MapView {
    size: Size = { width: 0, height: 0 };
    mode: "page" | "plane" = "page";
    problem = ""; // what is wrong with the last picture

    private readonly motion = new Motion();
    private readonly painter: Painter;
    private readonly overviews: Overviews;
    private readonly tiles: TileLoader;
    private readonly subjects = new Subjects();
    private ratio = 1;
    private grid: TileGrid = tileGrid(1);
    private isShown = false;
    private facts: { facts: Opened; pattern: Work["pattern"] } | null = null;
    private work: Work;
    private pageName = "";
    private planeName = "";
    private overview: Overview | null = null;
    private isForeign = false; // the overview shows another pattern
    private failed: { error: unknown; pattern: Work["pattern"] } | null = null; // why the picture is missing
    private since = performance.now(); // time of the last picture, or of the first change after it
    private waitTimer = 0;
    private wasCurrent = false; // before the change
    private loupe = noLoupe; // over pages that have no plane
    private changed = -1e9; // time of the last change of the work
    private moved = -1e9; // time of the last motion
    private entered = -1e9; // time when the plane was entered
    private frame = 0;
    private before = 0; // time of the last frame
    private restTimer = 0;
    private keepTimer = 0;
    private kept: Work["place"] = null;
    private bare: { ground: string; colour: Colour } | null = null; // what a picture without lines looks like

    /// @param onChange  after every frame
    constructor(
        private readonly studio: Studio,
        readonly canvas: HTMLCanvasElement,
        private readonly onChange: () => void,
    ) {
        this.painter = new Painter(canvas);
        this.overviews = new Overviews(
            studio.engine,
            (...taken) => this.take(...taken),
            (error) => this.fail(error),
        );
        this.tiles = new TileLoader(studio.engine, () => this.draw());
        this.work = studio.store.work;
        this.setWork(this.work);
        if (studio.opened) this.setFacts(studio.opened.facts, studio.opened.work);
    }

    get camera(): Camera {
        return this.motion.camera;
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
        if (width === this.size.width && height === this.size.height && ratio === this.ratio) return;
        this.size = { width, height };
        this.ratio = this.painter.ratio = ratio;
        this.grid = tileGrid(ratio);
        this.canvas.width = Math.round(width * ratio);
        this.canvas.height = Math.round(height * ratio);
        this.paint(performance.now());
        this.rest();
    }

    setWork(work: Work): void {
        const before = this.work;
        this.work = work;
        const isOther = work.pattern !== before.pattern || work.draw !== before.draw;
        this.wasCurrent = this.isCurrent;
        if (isOther || this.pageName === "") {
            this.pageName = this.subjects.nameOf("page", work.pattern, pageOptions(this.studio.help, work.draw));
            this.planeName = this.subjects.nameOf("plane", work.pattern, planeOptions(this.studio.help, work.draw));
        }
        if (isOther) this.change();
        if (work.pattern !== before.pattern) document.getElementById("draft")?.remove();
        if (isAnother(work.pattern, before.pattern)) {
            this.loupe = noLoupe;
            this.problem = "";
        }
        this.takePlace();
        this.refresh();
        this.draw();
        if (isOther) this.onChange(); // now, not in the next frame
    }

    // The picture is that of an earlier work from now on.
    private change(): void {
        this.changed = performance.now();
        if (this.wasCurrent || this.failed || this.studio.hasErrors) this.since = this.changed;
        this.failed = null;
        this.isForeign = this.overview !== null && isAnother(this.overview.pattern, this.work.pattern);
        this.waitOn();
    }

    private waitOn(): void {
        clearTimeout(this.waitTimer);
        this.waitTimer = window.setTimeout(() => this.draw(), patience + 10);
    }

    private get isCurrent(): boolean {
        const { overview } = this;
        return overview !== null && overview.name === (overview.kind === "plane" ? this.planeName : this.pageName);
    }

    /// Reason why the work has no picture; null if it has one, or none yet. Errors of the text are shown there.
    get failure(): { error: unknown; pattern: Work["pattern"] } | null {
        const { failed } = this;
        const isOfText = failed?.error instanceof RequestFailed && failed.error.failure.kind === "pattern";
        return isOfText && this.known === null ? null : failed;
    }

    /// Describes what the map is waiting for; empty if it shows the picture of the work, or is expected to soon.
    get waiting(): string {
        if (this.isCurrent || this.failure) return "";
        if (this.studio.hasErrors) {
            return this.isForeign ? "The text has errors: this is the picture of the previous pattern." : "";
        }
        if (this.failed) return "";
        return performance.now() - this.since > patience ? drawing : "";
    }

    /// True if the map shows another work, and the picture of this one is late.
    get isStale(): boolean {
        return !this.isCurrent && (this.isForeign || this.failed !== null || this.waiting !== "");
    }

    setFacts(facts: Opened, work: Work): void {
        this.facts = { facts, pattern: work.pattern };
        if (this.overview) this.overview = this.placed(this.overview);
        if (!facts.extent && !facts.is_spatial) void this.measure(facts, work);
        if (this.mode === "plane" && facts.is_spatial) this.mode = "page";
        this.refresh();
        this.draw();
    }

    // The extent of a spline is that of its control points.
    private async measure(facts: Opened, work: Work): Promise<void> {
        try {
            const { json } = await this.studio.engine.request<{ box?: (string | number)[] }>(
                { do: "measure", pattern: work.pattern },
                { key: "map-extent", seconds: 3 },
            );
            const box = json.box?.map((side) => exactText(readExact(String(side)) ?? 0n));
            if (box?.length !== 4 || this.facts?.facts !== facts) return;
            this.setFacts({ ...facts, extent: box as [string, string, string, string] }, work);
        } catch {
            // too long to be measured: only the page can be shown
        }
    }

    /// The facts of the work shown; null while they are unknown.
    get known(): Opened | null {
        return this.facts?.pattern === this.work.pattern ? this.facts.facts : null;
    }

    /// True if parts of the plane can be shown.
    get hasPlane(): boolean {
        const facts = this.facts?.facts;
        return !!facts?.extent && !facts.is_spatial;
    }

    /// True if the drawing lies outside the view.
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

    /// True if the pictures of this part of the plane are complete, and the drawing has no line in it.
    get isEmpty(): boolean {
        if (this.mode !== "plane" || this.size.width === 0 || !this.isResting) return false;
        const { camera, size, overview } = this;
        if (overview?.kind === "plane" && overview.name === this.planeName && covers(overview, camera, size)) {
            if (this.isBare(overview.bitmap)) return true;
        }
        if (!this.isTiled) return false;
        const seen = seenTiles(camera, size, this.grid, camera.scale);
        return seen.length > 0 && seen.every((tile) => this.isBare(this.tiles.picture(this.planeName, tile)));
    }

    // True of a picture of the ground alone; one within a line is plain, too.
    private isBare(bitmap: Bitmap | undefined): boolean {
        if (!bitmap?.plain) return bitmap?.isEmpty ?? false;
        if (bitmap.isEmpty || bitmap.plain[3] === 0) return true;
        const ground = this.groundOf(this.work);
        if (this.bare?.ground !== ground) this.bare = { ground, colour: colourOf(ground) };
        return this.bare.colour.every((part, at) => Math.abs(part - bitmap.plain![at]!) <= 1);
    }

    /// True if the view shows only part of the page.
    get isMagnified(): boolean {
        return this.mode === "page" && this.loupe.zoom > 1;
    }

    private get isTiled(): boolean {
        const facts = this.known;
        return !!facts?.has_view && !isComposed(facts, this.work.draw);
    }

    // Adopts the place of the work if a link or an undo changed it.
    private takePlace(): void {
        const { place } = this.work;
        if (JSON.stringify(place) === JSON.stringify(this.kept)) return;
        this.kept = place;
        if (!place) {
            this.mode = "page";
            return;
        }
        const camera = cameraOf(place);
        if (!camera) return;
        this.mode = "plane";
        this.motion.jump(camera);
    }

    private keepSoon(): void {
        clearTimeout(this.keepTimer);
        this.keepTimer = window.setTimeout(() => this.keep(), keepAfter);
    }

    private keep(): void {
        if (this.motion.isMoving) return this.keepSoon();
        const { x, y, scale } = this.camera;
        const decimals = decimalsOf(scale) + 3;
        const place = { x: exactText(x, decimals), y: exactText(y, decimals), scale: Number(scale.toPrecision(12)) };
        this.kept = this.mode === "plane" ? place : null;
        this.studio.store.change({ place: this.kept }, "place");
    }

    // --- motion

    private get laid(): Laid {
        return laidOut(sheetOf(this.studio.help, this.work.draw), this.size);
    }

    private get pageCamera(): Camera | null {
        const facts = this.known;
        const { laid, size, studio, work } = this;
        return facts && cameraOfSheet(sheetOf(studio.help, work.draw), laid, size, facts, studio.help, work.draw);
    }

    // Changes from the page to the plane; false if there is none, or if it does not match the page.
    private enter(mayJump = false): boolean {
        if (this.mode === "plane") return true;
        const facts = this.known;
        if (!facts?.extent || !this.hasPlane) return false;
        const camera = this.pageCamera ?? (mayJump ? fitting(facts.extent, this.size, 48) : null);
        if (!camera) return false;
        this.motion.jump(camera);
        this.mode = "plane";
        this.entered = performance.now();
        return true;
    }

    panBy(right: number, down: number): void {
        if (this.isMagnified) {
            this.loupe = { ...this.loupe, right: this.loupe.right + right, down: this.loupe.down + down };
        } else if (this.enter()) {
            this.motion.pan(right, down);
        }
        this.hasMoved();
    }

    /// Zooms in by a factor around a pixel of the view, at once or smoothly.
    zoomBy(factor: number, left = this.size.width / 2, top = this.size.height / 2, isAtOnce = false): void {
        const bounded = (scale: number) => this.bounded(scale);
        if (!this.enter()) this.magnify(factor, left, top);
        else if (isAtOnce) this.motion.zoomAtOnce(factor, this.size, left, top, bounded);
        else this.motion.zoomBy(factor, this.size, left, top, bounded);
        this.hasMoved();
    }

    // At coarser scales the drawing is only a speck.
    private bounded(scale: number): number {
        const extent = this.known?.extent;
        const whole = extent && fitting(extent, this.size, 48);
        return limited(whole ? Math.min(scale, Math.max(whole.scale * 32, this.camera.scale)) : scale);
    }

    private magnify(factor: number, left: number, top: number): void {
        const zoom = Math.min(8, Math.max(1, this.loupe.zoom * factor));
        const change = zoom / this.loupe.zoom;
        const across = left - this.size.width / 2;
        const along = top - this.size.height / 2;
        const right = across + (this.loupe.right - across) * change;
        this.loupe = zoom === 1 ? noLoupe : { zoom, right, down: along + (this.loupe.down - along) * change };
    }

    /// Two fingers: the point under their midpoint follows it.
    pinch(from: { left: number; top: number }, to: { left: number; top: number }, factor: number): void {
        this.panBy(to.left - from.left, to.top - from.top);
        this.zoomBy(factor, to.left, to.top, true);
    }

    showPage(): void {
        this.loupe = noLoupe;
        const to = this.mode === "plane" ? this.pageCamera : null;
        const arrive = () => {
            this.mode = "page";
            this.refresh();
            this.hasMoved();
        };
        if (to) this.motion.travel(to, arrive);
        else arrive();
        this.hasMoved();
    }

    /// Fits the drawing into the view.
    showDrawing(): void {
        const extent = this.known?.extent;
        const to = extent && fitting(extent, this.size, Math.min(this.size.width, this.size.height) < 480 ? 24 : 56);
        if (to) this.travel(to);
    }

    /// Goes to a camera.
    travel(to: Camera): void {
        if (!this.enter(true)) return;
        this.motion.travel(to, () => this.rest());
        this.hasMoved();
    }

    private hasMoved(): void {
        this.moved = performance.now();
        this.rest();
        this.keepSoon();
        this.draw();
    }

    // Requests exact pictures when nothing has moved for a moment.
    private rest(): void {
        clearTimeout(this.restTimer);
        this.restTimer = window.setTimeout(() => {
            if (this.motion.isMoving) return this.rest();
            this.refresh();
            this.draw();
        }, restAfter);
    }

    private get isResting(): boolean {
        const since = performance.now() - Math.max(this.moved, this.changed);
        return !this.motion.isMoving && since > restAfter - 20;
    }

    // --- pictures

    // Requests a picture of the whole view unless the last one is good enough.
    private refresh(): void {
        if (!this.isShown || this.size.width === 0) return;
        if (this.mode === "page") this.refreshPage();
        else this.refreshPlane();
    }

    private refreshPage(): void {
        const { overview } = this;
        if (overview?.kind !== "page" || overview.name !== this.pageName) {
            return this.askPage(Math.min(1, this.ratio) * this.overviews.quality);
        }
        const fine = this.ratio * this.loupe.zoom;
        const pixels = overview.bitmap.width;
        const wanted = Math.min(widest, this.laid.width * fine);
        if (Math.abs(pixels - wanted) < 2 || (pixels > wanted && pixels < 2 * wanted)) return;
        if (this.isResting) this.askPage(fine);
        else this.rest();
    }

    // Requests a picture of the work, which becomes an overview.
    private ask(
        what: string,
        picture: Omit<Extract<Request, { do: "pixels" }>, "do" | "pattern">,
        rest: Omit<Overview, "pattern" | "bitmap" | "ground">,
    ): void {
        const { work } = this;
        const { pattern } = work;
        const made = (bitmap: Bitmap) => ({ ...rest, pattern, bitmap, ground: this.groundOf(work) });
        void this.overviews.ask(what, { do: "pixels", ...picture, pattern }, Math.min(1, this.ratio), made);
    }

    private askPage(ratio: number): void {
        const { laid, size, work, pageName: name } = this;
        const camera = this.pageCamera;
        const used = ratio * Math.min(1, widest / (Math.max(laid.width, laid.height) * ratio));
        const pixels = (length: number) => Math.max(16, Math.round(length * used));
        const options = pageOptions(this.studio.help, work.draw);
        this.ask(
            `${name} ${ratio} ${laid.width}`,
            { width: pixels(laid.width), height: pixels(laid.height), ratio: used, options },
            { kind: "page", name, ratio, camera, size, laid },
        );
    }

    // Adds camera and ground to a page that was requested before the facts of its pattern were known.
    private placed(overview: Overview): Overview {
        const { facts, studio, work } = this;
        if (overview.camera || overview.kind !== "page" || overview.name !== this.pageName || !this.known) return overview;
        const sheet = sheetOf(studio.help, work.draw);
        const camera = cameraOfSheet(sheet, overview.laid, overview.size, facts!.facts, studio.help, work.draw);
        return { ...overview, camera, ground: this.groundOf(work) };
    }

    private refreshPlane(): void {
        const { overview } = this;
        const isOfPage = overview?.kind === "page" && overview.name === this.pageName && overview.camera !== null;
        const isOfPlane = overview?.kind === "plane" && overview.name === this.planeName;
        if (!isOfPage && !isOfPlane) return this.askPlane(Math.min(1, this.ratio) * this.overviews.quality, 0);
        if (!this.known || this.isTiled) return;
        if (isOfPlane && overview.ratio === this.ratio && covers(overview, this.camera, this.size)) return;
        if (this.isResting) this.askPlane(this.ratio, 0.2);
        else this.rest();
    }

    // `around`: the share of the view to add beyond its edges.
    private askPlane(ratio: number, around: number): void {
        const { camera, laid, work, planeName: name } = this;
        const pixels = (length: number) => Math.max(16, Math.round(length * (1 + 2 * around) * ratio));
        const [across, down] = [pixels(this.size.width), pixels(this.size.height)];
        const size = { width: across / ratio, height: down / ratio };
        const options = this.planeOptionsOf(work);
        this.ask(
            `${name} ${ratio} ${camera.x} ${camera.y} ${camera.scale} ${across}`,
            { width: across, height: down, window: windowOf(camera, size), ratio, options },
            { kind: "plane", name, ratio, camera, size, laid },
        );
    }

    private take(overview: Overview, warnings: string[]): void {
        if (overview.kind !== this.mode && this.overview) return overview.bitmap.close();
        this.overview?.bitmap.close();
        this.overview = this.placed(overview);
        this.isForeign = isAnother(overview.pattern, this.work.pattern);
        this.since = performance.now();
        if (this.isCurrent) this.failed = null;
        else this.waitOn();
        this.problem = overview.kind === "page" ? warnings.join("\n") : "";
        this.draw();
        this.rest();
    }

    private fail(error: unknown): void {
        const { failed } = this;
        if (failed && failed.error === error && failed.pattern === this.work.pattern) return;
        this.failed = { error, pattern: this.work.pattern };
        this.problem = "";
        // The last picture stays, unless it is of another pattern.
        if (this.failure && this.overview && this.isForeign) {
            this.overview.bitmap.close();
            this.overview = null;
            this.isForeign = false;
        }
        this.draw();
        this.onChange();
    }

    private groundOf(work: Work): string {
        const facts = this.facts?.facts;
        const text = plainGround((facts && styleOf("ground", facts, work.draw)) ?? "white");
        return text === "none" || CSS.supports("color", text) ? text : "white";
    }

    // The texture of a floor has a size in millimetres, and the plane has none: there the ground is plain.
    private planeOptionsOf(work: Work): Options {
        const options = planeOptions(this.studio.help, work.draw);
        const facts = this.facts?.facts;
        const text = facts && styleOf("ground", facts, work.draw);
        if (text === undefined || plainGround(text) === text) return options;
        return [...options.filter(([name]) => name !== "ground"), ["ground", plainGround(text)]];
    }

    private wantTiles(now: number): void {
        if (this.mode !== "plane" || !this.isTiled || this.size.width === 0) return this.tiles.want(null);
        if (now - this.changed < 60) return;
        const isMoving = this.motion.isMoving || now - this.moved < restAfter - 30;
        const scale = isMoving ? levelScale(this.camera.scale) : this.camera.scale;
        const subject: Subject = {
            name: this.planeName,
            pattern: this.work.pattern,
            options: this.planeOptionsOf(this.work),
        };
        this.tiles.want(subject, seenTiles(this.camera, this.size, this.grid, scale), this.grid, this.ratio);
    }

    // --- frames

    draw(): void {
        if (!this.isShown || this.frame) return;
        this.frame = requestAnimationFrame((now) => {
            this.frame = 0;
            if (this.motion.isMoving) {
                this.motion.advance(now, Math.min(50, Math.max(1, now - this.before)), this.size);
                this.moved = performance.now();
                if (!this.motion.isMoving) this.rest();
            }
            this.before = now;
            this.paint(now);
            this.wantTiles(performance.now());
            if (this.motion.isMoving || now - this.entered < enteringTime + 20) this.draw();
            this.onChange();
        });
    }

    private paint(now: number): void {
        const { overview, painter } = this;
        painter.clear();
        if (overview || this.failure) document.getElementById("draft")?.remove();
        if (!overview) {
            if (this.failure) painter.blank(this.laid);
            return;
        }
        this.tell(overview);
        if (this.mode === "page" && overview.kind === "page") {
            painter.page(overview, this.laid, this.size, this.loupe);
            return;
        }
        const isOfPage = overview.kind === "page" && overview.camera !== null;
        const entering = isOfPage ? Math.min(1, Math.max(0, (now - this.entered) / enteringTime)) : 1;
        const layers = layersOf(this.tiles, this.planeName, this.camera, this.size, this.grid);
        painter.plane(overview, this.camera, this.size, this.isCurrent && entering >= 1 ? layers : [], entering);
    }

    // For tests.
    private tell({ name, ratio }: Overview): void {
        const text = `${name} at ${ratio}`;
        if (this.canvas.dataset["shows"] !== text) this.canvas.dataset["shows"] = text;
    }
}

// True if a picture of the plane covers the view at its scale.
function covers(overview: Overview, camera: Camera, size: Size): boolean {
    if (!overview.camera || Math.abs(overview.camera.scale / camera.scale - 1) > 1e-6) return false;
    const middle = pixelOf(overview.camera, overview.size, camera.x, camera.y);
    return (
        Math.abs(middle.left - overview.size.width / 2) <= (overview.size.width - size.width) / 2 + 0.5 &&
        Math.abs(middle.top - overview.size.height / 2) <= (overview.size.height - size.height) / 2 + 0.5
    );
}
