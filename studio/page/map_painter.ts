// Paints the map, a page on a desk or the plane, from the pictures that are available.
import { pixelOf, pointAt, type Camera, type Size } from "./camera";
import { isDark } from "./layout";
import type { Bitmap } from "./pictures";
import type { Laid } from "./sheet";

/// A picture of a whole view: of the page, or of a part of the plane.
export interface Overview {
    readonly kind: "page" | "plane";
    readonly name: string; // of what it shows
    readonly pattern: { name: string; text: string };
    readonly bitmap: Bitmap;
    readonly ratio: number;
    readonly camera: Camera | null; // of a page: the camera that shows the plane as the page does
    readonly size: Size; // of the view, or of the part of it that the picture fills
    readonly laid: Laid; // of a page: its position
    readonly ground: string;
}

/// Tiles of one scale; `isWhole` if they cover the view.
export interface Layer {
    readonly isWhole: boolean;
    readonly pieces: readonly { bitmap: Bitmap; box: Edges }[];
}

export interface Edges {
    readonly left: number;
    readonly top: number;
    readonly right: number;
    readonly bottom: number;
}

/// A magnification of a page: the factor, and the shift in CSS pixels.
export interface Loupe {
    readonly zoom: number;
    readonly right: number;
    readonly down: number;
}

// In pixels of the canvas.
interface Box {
    readonly left: number;
    readonly top: number;
    readonly width: number;
    readonly height: number;
}

export class Painter {
    ratio = 1; // canvas pixels per CSS pixel
    private readonly context: CanvasRenderingContext2D;

    constructor(private readonly canvas: HTMLCanvasElement) {
        this.context = canvas.getContext("2d")!;
    }

    clear(): void {
        this.context.setTransform(1, 0, 0, 1, 0, 0);
        this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    }

    page(overview: Overview, laid: Laid, size: Size, loupe: Loupe): void {
        const place = (left: number, top: number) =>
            [
                Math.round(((left - size.width / 2) * loupe.zoom + size.width / 2 + loupe.right) * this.ratio),
                Math.round(((top - size.height / 2) * loupe.zoom + size.height / 2 + loupe.down) * this.ratio),
            ] as const;
        const [left, top] = place(laid.left, laid.top);
        const [right, bottom] = place(laid.left + laid.width, laid.top + laid.height);
        this.sheet(overview, { left, top, width: right - left, height: bottom - top }, 1);
    }

    /// A sheet on which there is nothing.
    blank(laid: Laid): void {
        const { ratio } = this;
        this.context.fillStyle = "#fff";
        this.context.fillRect(laid.left * ratio, laid.top * ratio, laid.width * ratio, laid.height * ratio);
    }

    private sheet(overview: Overview, { left, top, width, height }: Box, shade: number): void {
        const { context, ratio } = this;
        const darker = isDark() ? 2 : 1;
        for (const [blur, down, alpha] of [
            [28, 10, 0.2],
            [3, 1, 0.22],
        ] as const) {
            context.save();
            context.shadowColor = `rgba(${isDark() ? "0, 0, 0" : "60, 32, 12"}, ${alpha * darker * shade})`;
            context.shadowBlur = blur * ratio;
            context.shadowOffsetY = down * ratio;
            context.fillStyle = overview.ground === "none" ? "#fff" : overview.ground;
            context.fillRect(left, top, width, height);
            context.restore();
        }
        if (overview.ground === "none") this.checker({ left, top, width, height });
        context.imageSmoothingEnabled = true;
        context.imageSmoothingQuality = "high";
        context.drawImage(overview.bitmap.source, left, top, width, height);
    }

    /// @param entering  from 0 to 1: the page becomes the plane
    plane(overview: Overview, camera: Camera, size: Size, layers: readonly Layer[], entering: number): void {
        const { context, canvas } = this;
        const all = { left: 0, top: 0, width: canvas.width, height: canvas.height };
        if (overview.ground === "none") this.checker(all);
        const box = this.boxOf(overview, camera, size);
        if (entering < 1 && box) this.sheet(overview, box, 1 - entering);
        if (overview.ground !== "none") {
            context.globalAlpha = entering;
            context.fillStyle = overview.ground;
            context.fillRect(0, 0, canvas.width, canvas.height);
            context.globalAlpha = 1;
        }
        context.imageSmoothingEnabled = true;
        context.imageSmoothingQuality = "medium";
        if (box && !layers.some((layer) => layer.isWhole)) this.part(overview.bitmap, box);
        for (const layer of layers) {
            for (const { bitmap, box: edges } of layer.pieces) this.tile(bitmap, edges, overview.ground === "none");
        }
    }

    private tile(bitmap: Bitmap, edges: Edges, isTransparent: boolean): void {
        const left = Math.round(edges.left * this.ratio);
        const top = Math.round(edges.top * this.ratio);
        const box = {
            left,
            top,
            width: Math.round(edges.right * this.ratio) - left,
            height: Math.round(edges.bottom * this.ratio) - top,
        };
        if (box.width < 1 || box.height < 1) return;
        if (isTransparent) {
            this.context.clearRect(box.left, box.top, box.width, box.height);
            this.checker(box);
        }
        this.part(bitmap, box);
    }

    // The present position of an overview.
    private boxOf({ kind, camera: made, size: view, laid }: Overview, camera: Camera, size: Size): Box | null {
        if (!made) return null;
        const part = kind === "page" ? laid : { left: 0, top: 0, width: view.width, height: view.height };
        const from = pointAt(made, view, part.left, part.top);
        const to = pointAt(made, view, part.left + part.width, part.top + part.height);
        const low = pixelOf(camera, size, from.x, from.y);
        const high = pixelOf(camera, size, to.x, to.y);
        const box = {
            left: Math.round(low.left * this.ratio),
            top: Math.round(low.top * this.ratio),
            width: Math.round((high.left - low.left) * this.ratio),
            height: Math.round((high.top - low.top) * this.ratio),
        };
        return Object.values(box).every((value) => Math.abs(value) < 1e9) ? box : null;
    }

    // Draws only the part within the canvas, because browsers place distant corners imprecisely.
    private part(bitmap: Bitmap, box: Box): void {
        const left = Math.max(box.left, 0);
        const top = Math.max(box.top, 0);
        const width = Math.min(box.left + box.width, this.canvas.width) - left;
        const height = Math.min(box.top + box.height, this.canvas.height) - top;
        if (width <= 0 || height <= 0) return;
        const across = bitmap.width / box.width;
        const down = bitmap.height / box.height;
        const from = { left: (left - box.left) * across, top: (top - box.top) * down };
        this.context.drawImage(
            bitmap.source,
            from.left,
            from.top,
            width * across,
            height * down,
            left,
            top,
            width,
            height,
        );
    }

    // The pattern that shows through transparent ground.
    private checker({ left, top, width, height }: Box): void {
        const { context } = this;
        const side = Math.round(10 * this.ratio);
        context.save();
        context.beginPath();
        context.rect(left, top, width, height);
        context.clip();
        context.fillStyle = isDark() ? "#2b2622" : "#fbfaf7";
        context.fillRect(left, top, width, height);
        context.fillStyle = isDark() ? "#332d28" : "#efece5";
        const last = { x: Math.min(left + width, this.canvas.width), y: Math.min(top + height, this.canvas.height) };
        for (let y = Math.max(0, Math.floor(top / side)); y * side < last.y; ++y) {
            for (let x = Math.max(0, Math.floor(left / side)); x * side < last.x; ++x) {
                if ((x + y) % 2) context.fillRect(x * side, y * side, side, side);
            }
        }
        context.restore();
    }
}
