// The part of the endless plane that a view shows: arithmetic only.
import { exactOf, exactText, numberOf, readExact, type Exact } from "./decimal";

/// The centre of the view in turtle steps, y up, and the scale in turtle steps per CSS pixel.
export interface Camera {
    readonly x: Exact;
    readonly y: Exact;
    readonly scale: number;
}

export interface Size {
    readonly width: number;
    readonly height: number;
}

export const finestScale = 2 ** -40;
export const coarsestScale = 1e200;

export function limited(scale: number): number {
    return Math.min(coarsestScale, Math.max(finestScale, scale));
}

/// Reads a place of a work or a link as a camera; null if the place is invalid.
export function cameraOf(place: unknown): Camera | null {
    const { x, y, scale } = (place ?? {}) as Record<string, unknown>;
    if (typeof x !== "string" || typeof y !== "string" || typeof scale !== "number") return null;
    const [across, up] = [readExact(x), readExact(y)];
    if (across === null || up === null || !(scale > 0) || !Number.isFinite(scale)) return null;
    return { x: across, y: up, scale: limited(scale) };
}

/// The point of the plane under a pixel of the view, from its top left corner.
export function pointAt(camera: Camera, size: Size, left: number, top: number): { x: Exact; y: Exact } {
    return {
        x: camera.x + exactOf((left - size.width / 2) * camera.scale),
        y: camera.y + exactOf((size.height / 2 - top) * camera.scale),
    };
}

/// The camera that shows the point at the pixel.
export function cameraWith(
    point: { x: Exact; y: Exact },
    size: Size,
    left: number,
    top: number,
    scale: number,
): Camera {
    const kept = limited(scale);
    return {
        x: point.x - exactOf((left - size.width / 2) * kept),
        y: point.y - exactOf((size.height / 2 - top) * kept),
        scale: kept,
    };
}

/// Moves the picture by a number of pixels.
export function panned(camera: Camera, right: number, down: number): Camera {
    return {
        x: camera.x - exactOf(right * camera.scale),
        y: camera.y + exactOf(down * camera.scale),
        scale: camera.scale,
    };
}

/// Position of a point in the view, in CSS pixels from its top left corner.
export function pixelOf(camera: Camera, size: Size, x: Exact, y: Exact): { left: number; top: number } {
    return {
        left: size.width / 2 + numberOf(x - camera.x) / camera.scale,
        top: size.height / 2 - numberOf(y - camera.y) / camera.scale,
    };
}

/// The camera that shows a rectangle of the plane with a margin around it; null if the rectangle is a point or invalid.
export function fitting(extent: readonly [string, string, string, string], size: Size, margin: number): Camera | null {
    const [x0, y0, x1, y1] = extent.map(readExact);
    if (x0 == null || y0 == null || x1 == null || y1 == null || x1 < x0 || y1 < y0) return null;
    const across = numberOf(x1 - x0) / Math.max(1, size.width - 2 * margin);
    const up = numberOf(y1 - y0) / Math.max(1, size.height - 2 * margin);
    const scale = Math.max(across, up);
    if (!Number.isFinite(scale)) return null;
    return { x: (x0 + x1) / 2n, y: (y0 + y1) / 2n, scale: limited(scale > 0 ? scale : 1 / 40) };
}

/// The number of decimals that distinguishes neighbouring pixels.
export function decimalsOf(scale: number): number {
    return Math.max(0, Math.ceil(-Math.log10(scale)) + (scale < 1 ? 1 : 0));
}

/// The view, of the given size, as the `window` of a request.
export function windowOf(camera: Camera, size: Size): [string, string, string, string] {
    const across = exactOf((size.width / 2) * camera.scale);
    const up = exactOf((size.height / 2) * camera.scale);
    return [camera.x - across, camera.y - up, camera.x + across, camera.y + up].map((value) =>
        exactText(value, decimalsOf(camera.scale) + 6),
    ) as [string, string, string, string];
}
