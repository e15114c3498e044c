// The curve as it is played: the whole path faint, past notes in the colour of their voice, current notes bright, and
// the current position.
import type { Melody } from "../sound/melody";
import { eachSounding, firstFrom } from "../sound/melody";
import type { NoteCurves } from "./note_curves";
import type { Ink } from "./surface";
import { readInk, Surface } from "./surface";
import { voiceColour } from "./voice_colours";

const room = 28; // pixels around the curve
const most_traced = 6000; // notes that a frame adds to a layer, because browsers paint asynchronously
const fine_scale = 4; // pixels per step below which a magnifier shows the current notes
const glass_scale = 15;
const glass_notes = 500; // before and after the current one

export class CurveView {
    private readonly surface: Surface;
    private melody: Melody | null = null;
    private ink: Ink = readInk();
    private faint: CanvasRenderingContext2D | null = null;
    private done: CanvasRenderingContext2D | null = null;
    private faintCount = 0; // notes that the layers show
    private doneCount = 0;
    private byEnd = new Uint32Array(0);
    private before: Int32Array = new Int32Array(0); // the note that leads to each without a jump
    private scale = 1; // pixels per turtle step
    private left = 0;
    private top = 0;
    private muted: (voice: number) => boolean = () => false;
    private curves: NoteCurves | null = null; // of splines
    private readonly toX = (value: number): number => this.x(value);
    private readonly toY = (value: number): number => this.y(value);

    constructor(
        readonly canvas: HTMLCanvasElement,
        private readonly redraw: () => void,
    ) {
        this.surface = new Surface(canvas, () => this.reset());
    }

    show(melody: Melody | null): void {
        this.melody = melody;
        this.curves = null;
        this.byEnd = new Uint32Array(0);
        if (melody) {
            const end = (i: number) => melody.onset[i] + melody.duration[i];
            this.byEnd = Uint32Array.from({ length: melody.count }, (_, i) => i);
            let isOrdered = true;
            for (let i = 1; i < melody.count && isOrdered; ++i) isOrdered = end(i - 1) <= end(i);
            if (!isOrdered) this.byEnd.sort((a, b) => end(a) - end(b) || a - b);
            this.before = leading(melody);
        }
        this.reset();
    }

    /// Draws the curves of splines instead of their control polygons.
    /// @param find  makes them, with the note that leads to each
    setCurves(find: (before: Int32Array) => NoteCurves | null): void {
        this.curves = find(this.before);
        if (this.curves) this.reset();
    }

    setMuted(muted: (voice: number) => boolean): void {
        this.muted = muted;
        this.reset();
    }

    reset(): void {
        this.surface.fit();
        this.ink = readInk();
        this.faint = this.surface.layer();
        this.done = this.surface.layer();
        this.faintCount = this.doneCount = 0;
        if (this.melody) this.place(this.melody);
        this.redraw();
    }

    private place(melody: Melody): void {
        const [x0, y0, x1, y1] = melody.box;
        const width = Math.max(1e-9, x1 - x0);
        const height = Math.max(1e-9, y1 - y0);
        this.scale = Math.min((this.surface.width - 2 * room) / width, (this.surface.height - 2 * room) / height, 64);
        this.left = this.surface.width / 2 - (this.scale * (x0 + x1)) / 2;
        this.top = this.surface.height / 2 + (this.scale * (y0 + y1)) / 2;
    }

    private x(value: number): number {
        return this.left + this.scale * value;
    }
    private y(value: number): number {
        return this.top - this.scale * value;
    }
    private get thickness(): number {
        return Math.min(6, Math.max(Math.min(1.3, this.scale * 0.8), this.scale * 0.17));
    }

    /// True if work is left for the next frame.
    draw(tick: number): boolean {
        const { surface, melody, faint, done } = this;
        const { context } = surface;
        context.clearRect(0, 0, surface.width, surface.height);
        if (!melody || !faint || !done) return false;
        this.drawFaint(melody, faint);
        this.drawDone(melody, done, tick);
        surface.put(faint);
        surface.put(done);
        this.drawSounding(melody, tick, this.scale);
        if (this.scale < fine_scale) this.drawGlass(melody, tick);
        return this.faintCount < melody.count || this.isBehind(melody, tick);
    }

    private drawFaint(melody: Melody, layer: CanvasRenderingContext2D): void {
        if (this.faintCount === melody.count) return;
        layer.strokeStyle = this.ink.strong;
        layer.globalAlpha = this.ink.isDark ? 0.62 : 0.5;
        layer.lineWidth = Math.min(2, this.thickness * 0.55);
        layer.lineCap = "round";
        layer.lineJoin = "round";
        const end = this.curves ? melody.count : Math.min(melody.count, this.faintCount + most_traced);
        layer.beginPath();
        this.curves?.traceAll(layer, this.toX, this.toY);
        for (let i = this.faintCount; i < end; ++i) if (!this.curves?.has(i)) this.trace(melody, layer, i, 1);
        layer.stroke();
        this.faintCount = end;
    }

    /// Traces the run that leads to the note, and a share of the note's own piece.
    private trace(melody: Melody, layer: CanvasRenderingContext2D, i: number, share: number): void {
        if (this.curves?.has(i)) return this.curves.trace(layer, i, share, this.toX, this.toY);
        const { path } = melody;
        const before = this.before[i];
        const x0 = path[4 * i];
        const y0 = path[4 * i + 1];
        if (before >= 0) {
            layer.moveTo(this.x(path[4 * before + 2]), this.y(path[4 * before + 3]));
            layer.lineTo(this.x(x0), this.y(y0));
        } else {
            layer.moveTo(this.x(x0), this.y(y0));
        }
        layer.lineTo(this.x(x0 + share * (path[4 * i + 2] - x0)), this.y(y0 + share * (path[4 * i + 3] - y0)));
    }

    /// The place after a share of a note, in turtle steps.
    private placeAt({ path }: Melody, i: number, share: number): [number, number] {
        if (this.curves?.has(i)) return this.curves.placeAt(i, share);
        const along = (axis: number) => path[4 * i + axis] + share * (path[4 * i + 2 + axis] - path[4 * i + axis]);
        return [along(0), along(1)];
    }

    private ended(melody: Melody, at: number, tick: number): boolean {
        const i = this.byEnd[at];
        return melody.onset[i] + melody.duration[i] <= tick;
    }

    private isBehind(melody: Melody, tick: number): boolean {
        return this.doneCount < melody.count && this.ended(melody, this.doneCount, tick);
    }

    private drawDone(melody: Melody, layer: CanvasRenderingContext2D, tick: number): void {
        if (this.doneCount > 0 && !this.ended(melody, this.doneCount - 1, tick)) {
            layer.clearRect(0, 0, this.surface.width, this.surface.height); // moved back to an earlier position
            this.doneCount = 0;
        }
        layer.lineCap = "round";
        layer.lineJoin = "round";
        layer.lineWidth = this.thickness;
        const begin = this.doneCount;
        while (this.doneCount < begin + most_traced && this.isBehind(melody, tick)) ++this.doneCount;
        if (this.doneCount === begin) return;
        for (let voice = 0; voice < melody.voices; ++voice) {
            layer.strokeStyle = voiceColour(voice, this.ink.isDark);
            layer.globalAlpha = this.muted(voice) ? 0.18 : 0.85;
            layer.beginPath();
            for (let at = begin; at < this.doneCount; ++at) {
                const i = this.byEnd[at];
                if (melody.voice[i] === voice) this.trace(melody, layer, i, 1);
            }
            layer.stroke();
        }
    }

    /// A magnifier for curves that are too fine: the notes around the current one, enlarged.
    private drawGlass(melody: Melody, tick: number): void {
        const { context, width, height } = this.surface;
        const side = Math.min(220, height * 0.5, width * 0.4);
        const now = Math.max(0, firstFrom(melody, tick + 1e-6) - 1);
        const share = Math.min(1, Math.max(0, (tick - melody.onset[now]) / melody.duration[now]));
        const [x, y] = this.placeAt(melody, now, share);
        const whole = [this.scale, this.left, this.top] as const;
        const [left, top] = [width - side - 14, height - side - 14];
        context.save();
        context.beginPath();
        context.roundRect(left, top, side, side, 10);
        context.fillStyle = this.ink.raised;
        context.fill();
        context.strokeStyle = this.ink.strong;
        context.lineWidth = 1;
        context.stroke();
        context.clip();
        this.scale = glass_scale;
        this.left = left + side / 2 - glass_scale * x;
        this.top = top + side / 2 + glass_scale * y;
        context.lineCap = context.lineJoin = "round";
        for (let i = Math.max(0, now - glass_notes); i < Math.min(melody.count, now + glass_notes); ++i) {
            const isPast = melody.onset[i] + melody.duration[i] <= tick;
            context.strokeStyle = isPast ? voiceColour(melody.voice[i], this.ink.isDark) : this.ink.strong;
            context.globalAlpha = isPast ? 0.85 : 0.5;
            context.lineWidth = this.thickness * (isPast ? 1 : 0.55);
            context.beginPath();
            this.trace(melody, context, i, 1);
            context.stroke();
        }
        this.drawSounding(melody, tick, this.scale);
        context.restore();
        [this.scale, this.left, this.top] = whole;
    }

    private drawSounding(melody: Melody, tick: number, scale: number): void {
        const { context } = this.surface;
        context.lineCap = "round";
        context.lineJoin = "round";
        if (tick <= 0 && melody.count > 0) this.drawHead(melody, 0, 0, scale);
        eachSounding(melody, tick, tick + 1e-6, (i) => {
            if (melody.onset[i] > tick) return;
            const share = Math.min(1, (tick - melody.onset[i]) / melody.duration[i]);
            const isMuted = this.muted(melody.voice[i]);
            context.strokeStyle = voiceColour(melody.voice[i], this.ink.isDark);
            for (const [width, alpha] of isMuted
                ? [[1, 0.3]]
                : [
                      [3.6, 0.16],
                      [2.2, 0.3],
                      [1.25, 1],
                  ]) {
                context.globalAlpha = alpha;
                context.lineWidth = this.thickness * width;
                context.beginPath();
                this.trace(melody, context, i, share);
                context.stroke();
            }
            context.globalAlpha = 1;
            if (!isMuted) this.drawHead(melody, i, share, scale);
        });
        context.globalAlpha = 1;
    }

    private drawHead(melody: Melody, i: number, share: number, scale: number): void {
        const { context } = this.surface;
        const [right, up] = this.placeAt(melody, i, share);
        const [x, y] = [this.x(right), this.y(up)];
        const radius = Math.max(scale < fine_scale ? 3.5 : 4.5, this.thickness * 1.1);
        const colour = voiceColour(melody.voice[i], this.ink.isDark);
        context.globalAlpha = 0.22;
        context.fillStyle = colour;
        context.beginPath();
        context.arc(x, y, radius * 2.3, 0, 2 * Math.PI);
        context.fill();
        context.globalAlpha = 1;
        context.beginPath();
        context.arc(x, y, radius, 0, 2 * Math.PI);
        context.fillStyle = this.ink.isDark ? "#fff6e8" : "#fffdf8";
        context.fill();
        context.lineWidth = 2;
        context.strokeStyle = colour;
        context.stroke();
    }

    /// The tick of the piece nearest to a point of the canvas, within 40 pixels.
    tickAt(x: number, y: number): number | null {
        const { melody } = this;
        if (!melody) return null;
        let nearest = 40 * 40;
        let found: number | null = null;
        const shares = [0.1, 0.3, 0.5, 0.7, 0.9];
        for (let i = 0; i < melody.count; ++i) {
            if (this.curves?.has(i)) {
                for (const share of shares) {
                    const [right, up] = this.curves.placeAt(i, share);
                    const distance = (x - this.x(right)) ** 2 + (y - this.y(up)) ** 2;
                    if (distance >= nearest) continue;
                    nearest = distance;
                    found = melody.onset[i] + share * melody.duration[i];
                }
                continue;
            }
            const x0 = this.x(melody.path[4 * i]);
            const y0 = this.y(melody.path[4 * i + 1]);
            const dx = this.x(melody.path[4 * i + 2]) - x0;
            const dy = this.y(melody.path[4 * i + 3]) - y0;
            const length = dx * dx + dy * dy;
            const share = length > 0 ? Math.min(1, Math.max(0, ((x - x0) * dx + (y - y0) * dy) / length)) : 0;
            const distance = (x - x0 - share * dx) ** 2 + (y - y0 - share * dy) ** 2;
            if (distance < nearest) {
                nearest = distance;
                found = melody.onset[i] + Math.min(share, 0.999) * melody.duration[i];
            }
        }
        return found;
    }
}

/// The note of the same voice from whose end a straight run leads to each note; -1 where the curve jumps, or if
/// another voice plays that run.
function leading(melody: Melody): Int32Array {
    const before = new Int32Array(melody.count).fill(-1);
    const last = new Int32Array(melody.voices).fill(-1);
    const { path } = melody;
    const run = (x0: number, y0: number, x1: number, y1: number): string =>
        x0 < x1 || (x0 === x1 && y0 < y1) ? `${x0} ${y0} ${x1} ${y1}` : `${x1} ${y1} ${x0} ${y0}`;
    const sounded = new Set<string>();
    if (melody.voices > 1) {
        for (let i = 0; i < 4 * melody.count; i += 4) sounded.add(run(path[i], path[i + 1], path[i + 2], path[i + 3]));
    }
    for (let i = 0; i < melody.count; ++i) {
        const old = last[melody.voice[i]];
        last[melody.voice[i]] = i;
        if (old < 0) continue;
        const [x0, y0, x1, y1] = [path[4 * old + 2], path[4 * old + 3], path[4 * i], path[4 * i + 1]];
        const isStraight = Math.abs(x1 - x0) < 1e-6 || Math.abs(y1 - y0) < 1e-6;
        if (isStraight && !(melody.voices > 1 && sounded.has(run(x0, y0, x1, y1)))) before[i] = old;
    }
    return before;
}
