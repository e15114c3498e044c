// The piano roll: time to the right, pitch upwards, bars with their numbers.
import { isStill } from "../map_motion";
import type { Melody } from "../sound/melody";
import { barAt, barsOf, barStart, beatsIn, eachSounding, keyName, placeText } from "../sound/melody";
import type { Loop } from "../sound/transport";
import type { Ink } from "./surface";
import { readInk, Surface } from "./surface";
import { voiceColour } from "./voice_colours";

const ruler = 24; // pixels
const gutter = 34;
const head_share = 0.3; // share of the width: the current position while the notes move
const drag_start = 6; // pixels

export interface RollActs {
    seek(tick: number): void;
    loop(loop: Loop): void;
    point(text: string | null): void; // describes the note under the pointer
    redraw(): void;
}

export class RollView {
    follows = true;
    shownLoop: Loop | null = null;
    muted: (voice: number) => boolean = () => false;
    private readonly surface: Surface;
    private melody: Melody | null = null;
    private ink: Ink = readInk();
    private left = 0; // tick at the left edge
    private pixels = 0.05; // per tick
    private low = 55;
    private high = 75;
    private drag: { x: number; left: number; isRuler: boolean; tick: number; moved: boolean } | null = null;

    constructor(
        readonly canvas: HTMLCanvasElement,
        private readonly acts: RollActs,
    ) {
        this.surface = new Surface(canvas, () => this.reset());
        canvas.addEventListener("pointerdown", (event) => this.press(event));
        canvas.addEventListener("pointermove", (event) => this.move(event));
        canvas.addEventListener("pointerup", (event) => this.release(event));
        canvas.addEventListener("pointercancel", () => {
            this.drag = null;
        });
        canvas.addEventListener("pointerleave", () => this.acts.point(null));
        canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    }

    show(melody: Melody | null): void {
        const isFirst = this.melody === null;
        this.melody = melody;
        if (melody) {
            const middle = (melody.lowest + melody.highest) / 2;
            const half = Math.max(7, (melody.highest - melody.lowest) / 2 + 1.5);
            this.low = Math.floor(middle - half);
            this.high = Math.ceil(middle + half);
            if (isFirst) this.zoomTo(melody, 4.5 * melody.bar);
            this.scrollTo(this.left);
        }
        this.reset();
    }

    reset(): void {
        this.surface.fit();
        this.ink = readInk();
        this.acts.redraw();
    }

    private get span(): number {
        return Math.max(1, this.surface.width - gutter) / this.pixels;
    }

    private zoomTo(melody: Melody, ticks: number): void {
        this.surface.fit();
        const width = Math.max(1, this.surface.width - gutter);
        const least = width / (melody.end + melody.bar);
        this.pixels = Math.min(1.5, Math.max(Math.min(least, 0.2), width / ticks));
    }

    /// Zooms by a factor, around a point of the canvas or the current position.
    zoom(factor: number, x = gutter + head_share * (this.surface.width - gutter)): void {
        if (!this.melody) return;
        const tick = this.tickOf(x);
        this.zoomTo(this.melody, this.span / factor);
        this.scrollTo(tick - (x - gutter) / this.pixels);
        this.acts.redraw();
    }

    private scrollTo(tick: number): void {
        if (!this.melody) return;
        this.left = Math.max(0, Math.min(tick, this.melody.end + 0.1 * this.span - this.span * 0.9));
    }

    private tickOf(x: number): number {
        return this.left + (x - gutter) / this.pixels;
    }
    private x(tick: number): number {
        return gutter + (tick - this.left) * this.pixels;
    }
    private rowHeight(): number {
        return (this.surface.height - ruler) / (this.high - this.low + 1);
    }
    private y(key: number): number {
        return ruler + (this.high - key + 0.5) * this.rowHeight();
    }

    /// Follows the music: scrolls under the playhead, or turns pages if the user prefers reduced motion.
    follow(tick: number, isPlaying: boolean): void {
        if (!this.melody || !this.follows || this.drag) return;
        if (isPlaying && !isStill()) this.scrollTo(tick - head_share * this.span);
        else if (tick < this.left || tick > this.left + 0.95 * this.span) this.scrollTo(tick - 0.08 * this.span);
    }

    draw(tick: number): void {
        const { surface, melody, ink } = this;
        const { context, width, height } = surface;
        context.clearRect(0, 0, width, height);
        if (!melody) return;
        context.save();
        context.beginPath();
        context.rect(gutter, 0, width - gutter, height);
        context.clip();
        this.drawRows(context);
        this.drawBars(context, melody);
        this.drawNotes(context, melody, tick);
        this.drawHead(context, tick);
        context.restore();
        this.drawKeys(context);
        context.fillStyle = ink.line;
        context.fillRect(0, ruler - 1, width, 1);
    }

    private drawRows(context: CanvasRenderingContext2D): void {
        const height = this.rowHeight();
        context.fillStyle = this.ink.isDark ? "rgb(255 255 255 / 3%)" : "rgb(70 40 10 / 4%)";
        for (let key = this.low; key <= this.high; ++key) {
            if ([1, 3, 6, 8, 10].includes(((key % 12) + 12) % 12)) {
                context.fillRect(gutter, this.y(key) - height / 2, this.surface.width, height);
            }
        }
    }

    private drawKeys(context: CanvasRenderingContext2D): void {
        context.fillStyle = this.ink.faint;
        context.font = `11px ${getComputedStyle(this.canvas).fontFamily}`;
        context.textBaseline = "middle";
        context.textAlign = "right";
        const spare = this.rowHeight() * 12;
        for (let key = Math.ceil(this.low / 12) * 12; key <= this.high; key += 12) {
            if (spare > 14) context.fillText(keyName(key), gutter - 7, this.y(key));
        }
        context.textAlign = "left";
    }

    private drawBars(context: CanvasRenderingContext2D, melody: Melody): void {
        const { ink, surface } = this;
        const right = Math.min(this.left + this.span, melody.end);
        if (this.shownLoop) {
            const x0 = this.x(this.shownLoop.from);
            const x1 = this.x(this.shownLoop.to);
            context.fillStyle = ink.accent;
            context.globalAlpha = 0.09;
            context.fillRect(x0, ruler, x1 - x0, surface.height);
            context.globalAlpha = 0.9;
            context.fillRect(x0, ruler - 5, x1 - x0, 4);
            context.globalAlpha = 1;
        }
        let every = 1;
        while (every * melody.bar * this.pixels < 34) every *= 2;
        context.font = `11px ${getComputedStyle(this.canvas).fontFamily}`;
        context.textBaseline = "middle";
        const isWide = melody.beat * this.pixels > 14;
        const last = Math.min(barsOf(melody), Math.ceil(barAt(melody, right)));
        const first = Math.max(0, Math.floor(barAt(melody, Math.max(0, this.left)) / every) * every);
        for (let bar = first; bar <= last; bar += every) {
            const x = Math.round(this.x(barStart(melody, bar)));
            context.fillStyle = ink.line;
            context.fillRect(x, 0, 1, surface.height);
            context.fillStyle = ink.faint;
            if (bar < barsOf(melody)) context.fillText(String(bar + melody.firstBar), x + 5, ruler / 2 - 1);
            if (!isWide || every > 1) continue;
            context.fillStyle = ink.line;
            context.globalAlpha = 0.5;
            for (const at of beatsIn(melody, bar)) {
                if (at > 0 && at < melody.end) context.fillRect(Math.round(this.x(at)), ruler, 1, surface.height);
            }
            context.globalAlpha = 1;
        }
    }

    private drawNotes(context: CanvasRenderingContext2D, melody: Melody, tick: number): void {
        const height = Math.max(3, Math.min(15, this.rowHeight() * 0.82));
        const lastX = new Float64Array(melody.voices).fill(-1);
        const lastKey = new Float64Array(melody.voices).fill(-1);
        eachSounding(melody, this.left, this.left + this.span, (i) => {
            const voice = melody.voice[i];
            const x = this.x(melody.onset[i]);
            const width = melody.duration[i] * this.pixels;
            // Draws only one of the notes that fall on the same pixel.
            if (width < 0.7 && x - lastX[voice] < 0.7 && melody.key[i] === lastKey[voice]) return;
            lastX[voice] = x;
            lastKey[voice] = melody.key[i];
            const isSounding = melody.onset[i] <= tick && tick < melody.onset[i] + melody.duration[i];
            const isPast = melody.onset[i] + melody.duration[i] <= tick;
            context.globalAlpha = this.muted(voice) ? 0.16 : isSounding ? 1 : isPast ? 0.75 : 0.42;
            context.fillStyle = voiceColour(voice, this.ink.isDark);
            const y = this.y(melody.key[i]) - height / 2;
            const shown = Math.max(1, width - (width > 4 ? 1.5 : 0));
            context.beginPath();
            if (shown > 4) context.roundRect(x, y, shown, height, Math.min(3, height / 2));
            else context.rect(x, y, shown, height);
            context.fill();
            if (isSounding && !this.muted(voice)) {
                context.lineWidth = 1.5;
                context.strokeStyle = this.ink.ink;
                context.stroke();
            }
        });
        context.globalAlpha = 1;
    }

    private drawHead(context: CanvasRenderingContext2D, tick: number): void {
        const x = this.x(tick);
        context.fillStyle = this.ink.accent;
        context.fillRect(x - 0.75, ruler - 6, 1.5, this.surface.height);
        context.beginPath();
        context.moveTo(x - 5, ruler - 12);
        context.lineTo(x + 5, ruler - 12);
        context.lineTo(x, ruler - 4);
        context.fill();
    }

    // --- pointer --------------------------------------------------------------------------------------------------

    private place(event: MouseEvent): { x: number; y: number } {
        const box = this.canvas.getBoundingClientRect();
        return { x: event.clientX - box.left, y: event.clientY - box.top };
    }

    private press(event: PointerEvent): void {
        if (!this.melody || event.button !== 0) return;
        const { x, y } = this.place(event);
        this.canvas.setPointerCapture(event.pointerId);
        this.drag = { x, left: this.left, isRuler: y < ruler, tick: this.tickOf(x), moved: false };
    }

    private move(event: PointerEvent): void {
        const { melody, drag } = this;
        if (!melody) return;
        const { x, y } = this.place(event);
        this.acts.point(this.textAt(melody, x, y));
        if (!drag) return;
        if (Math.abs(x - drag.x) > drag_start) drag.moved = true;
        if (!drag.moved) return;
        if (drag.isRuler) {
            this.acts.loop(this.wholeBars(melody, drag.tick, this.tickOf(x)));
        } else {
            this.follows = false;
            this.scrollTo(drag.left - (x - drag.x) / this.pixels);
        }
        this.acts.redraw();
    }

    private wholeBars(melody: Melody, a: number, b: number): Loop {
        const from = Math.max(0, Math.floor(barAt(melody, Math.min(a, b))));
        const to = Math.max(from + 1, Math.min(barsOf(melody), Math.ceil(barAt(melody, Math.max(a, b)))));
        return { from: barStart(melody, from), to: Math.min(barStart(melody, to), melody.end) };
    }

    private release(event: PointerEvent): void {
        const { drag } = this;
        this.drag = null;
        if (!drag || drag.moved) return;
        const { x } = this.place(event);
        this.follows = true;
        this.acts.seek(Math.max(0, this.tickOf(Math.max(gutter, x))));
    }

    private wheel(event: WheelEvent): void {
        if (!this.melody) return;
        if (event.ctrlKey || event.metaKey) {
            event.preventDefault();
            this.zoom(2 ** (-event.deltaY / 240), this.place(event).x);
            return;
        }
        const by = Math.abs(event.deltaX) > Math.abs(event.deltaY) ? event.deltaX : event.shiftKey ? event.deltaY : 0;
        if (by === 0) return;
        event.preventDefault();
        this.follows = false;
        this.scrollTo(this.left + by / this.pixels);
        this.acts.redraw();
    }

    private textAt(melody: Melody, x: number, y: number): string | null {
        const tick = this.tickOf(x);
        if (x < gutter || tick < 0 || tick >= melody.end) return null;
        const place = placeText(melody, tick);
        const key = this.high - Math.floor((y - ruler) / this.rowHeight());
        let name: string | null = null;
        eachSounding(melody, tick, tick + 1e-6, (i) => {
            if (melody.onset[i] <= tick && Math.abs(melody.key[i] - key) < 0.75) name = keyName(melody.key[i]);
        });
        return name ? `${place}, ${name}` : place;
    }
}
