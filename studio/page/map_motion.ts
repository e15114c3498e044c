// Motion of the map's camera: jumps, smooth zooms and flights.
import { cameraWith, panned, pointAt, type Camera, type Size } from "./camera";
import { eased, flight, followed, rung, type Zoom } from "./flight";

interface Journey {
    at(share: number): Camera;
    start: number;
    milliseconds: number;
    arrive: () => void;
}

export class Motion {
    camera: Camera = { x: 0n, y: 0n, scale: 0.1 };
    private zoom: Zoom | null = null;
    private journey: Journey | null = null;

    get isMoving(): boolean {
        return this.zoom !== null || this.journey !== null;
    }

    stop(): void {
        this.zoom = null;
        this.journey = null;
    }

    jump(camera: Camera): void {
        this.stop();
        this.camera = camera;
    }

    pan(right: number, down: number): void {
        this.jump(panned(this.camera, right, down));
    }

    /// Zooms in by a factor around a pixel of the view. A zoom in progress is extended from its target.
    zoomBy(factor: number, size: Size, left: number, top: number, bounded: (scale: number) => number): void {
        this.journey = null;
        const near = this.zoom && Math.hypot(this.zoom.left - left, this.zoom.top - top) < 2 ? this.zoom : null;
        const target = bounded((near?.target ?? this.camera.scale) / factor);
        const point = near?.point ?? pointAt(this.camera, size, left, top);
        if (isStill()) this.jump(cameraWith(point, size, left, top, target));
        else this.zoom = { point, left, top, target: rung(target) };
    }

    zoomAtOnce(factor: number, size: Size, left: number, top: number, bounded: (scale: number) => number): void {
        const point = pointAt(this.camera, size, left, top);
        this.jump(cameraWith(point, size, left, top, bounded(this.camera.scale / factor)));
    }

    /// Flies to a camera; the farther it is, the longer it takes.
    travel(to: Camera, arrive: () => void = () => {}): void {
        this.stop();
        if (isStill()) {
            this.camera = to;
            arrive();
            return;
        }
        const octaves = Math.abs(Math.log2(to.scale / this.camera.scale));
        const milliseconds = Math.min(2400, 280 + 60 * octaves);
        this.journey = { at: flight(this.camera, to), start: performance.now(), milliseconds, arrive };
    }

    /// Advances by a frame. @param passed  milliseconds since the last one
    advance(now: number, passed: number, size: Size): void {
        if (this.journey) {
            const { at, start, milliseconds, arrive } = this.journey;
            const share = Math.min(1, Math.max(0, (now - start) / milliseconds));
            this.camera = at(share >= 1 ? 1 : eased(share));
            if (share < 1) return;
            this.journey = null;
            arrive();
        } else if (this.zoom) {
            const { camera, isThere } = followed(this.camera, this.zoom, size, passed);
            this.camera = camera;
            if (isThere) this.zoom = null;
        }
    }
}

/// True if the user prefers reduced motion.
export function isStill(): boolean {
    return window.matchMedia("(prefers-reduced-motion: reduce)").matches;
}
