// Transitions from one camera to another.
import { cameraWith, limited, type Camera, type Size } from "./camera";
import { exactOf, numberOf, type Exact } from "./decimal";

/// A flight: the camera at a fraction of the way, from 0 to 1. The logarithm of the scale changes evenly, around the
/// one point that both cameras show at the same place.
export function flight(from: Camera, to: Camera): (share: number) => Camera {
    const octaves = Math.log2(to.scale / from.scale);
    if (Math.abs(octaves) < 0.01) {
        return (share) => {
            if (share >= 1) return to;
            const count = BigInt(Math.round(share * 2 ** 48));
            const on = (one: Exact, other: Exact) => one + (((other - one) * count) >> 48n);
            return { x: on(from.x, to.x), y: on(from.y, to.y), scale: from.scale };
        };
    }
    // Computed from the finer camera, so that none of its digits is lost.
    const [fine, coarse] = to.scale < from.scale ? [to, from] : [from, to];
    const share = fine.scale / (coarse.scale - fine.scale);
    const x = fine.x - exactOf(numberOf(coarse.x - fine.x) * share);
    const y = fine.y - exactOf(numberOf(coarse.y - fine.y) * share);
    const left = numberOf(x - fine.x) / fine.scale;
    const up = numberOf(y - fine.y) / fine.scale;
    return (part) => {
        if (part >= 1) return to;
        const scale = from.scale * 2 ** (octaves * part);
        return { x: x - exactOf(left * scale), y: y - exactOf(up * scale), scale };
    };
}

/// Easing: slow, fast, slow.
export function eased(share: number): number {
    return share < 0.5 ? 4 * share ** 3 : 1 - (2 - 2 * share) ** 3 / 2;
}

/// A zoom that approaches its target; the point under the pointer stays in place.
export interface Zoom {
    readonly point: { x: Exact; y: Exact };
    readonly left: number;
    readonly top: number;
    readonly target: number; // scale
}

/// The camera after a number of milliseconds of a zoom, and whether it has arrived.
export function followed(
    camera: Camera,
    zoom: Zoom,
    size: Size,
    milliseconds: number,
): { camera: Camera; isThere: boolean } {
    const octaves = Math.log2(zoom.target / camera.scale);
    const isThere = Math.abs(octaves) < 0.004;
    const scale = isThere ? zoom.target : camera.scale * 2 ** (octaves * (1 - Math.exp(-milliseconds / 65)));
    return { camera: cameraWith(zoom.point, size, zoom.left, zoom.top, scale), isThere };
}

/// The nearest of 32 scales per octave, so that tiles can be reused.
export function rung(scale: number): number {
    return limited(2 ** (Math.round(Math.log2(scale) * 32) / 32));
}
