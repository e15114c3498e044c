// Turns a drawing in space with pointer, wheel and keys.
import { turnedEye, type Eye } from "./eye";
import { turnedLight, type Light } from "./lamp";

/// A view of a drawing in space.
export interface Orbit {
    eye: Eye;
    light: Light;
    zoom: number;
    draw(): void;
    reset(): void;
    shiftBy?(right: number, down: number): void; // pixels; absent: the drawing stays centred
    stop?(): void; // ends automatic motion
}

const degreesOfPixel = 0.4;

export function addOrbit(canvas: HTMLCanvasElement, orbit: Orbit, leastZoom: number, mostZoom: number): void {
    const turn = (right: number, up: number) => {
        orbit.eye = turnedEye(orbit.eye, right, up);
        orbit.draw();
    };
    const zoom = (factor: number) => {
        orbit.zoom = Math.max(leastZoom, Math.min(mostZoom, orbit.zoom * factor));
        orbit.draw();
    };
    const fingers = new Map<number, { x: number; y: number }>();
    canvas.addEventListener("pointerdown", (event) => {
        canvas.setPointerCapture(event.pointerId);
        fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        canvas.classList.add("held");
        orbit.stop?.();
    });
    canvas.addEventListener("pointermove", (event) => {
        const before = fingers.get(event.pointerId);
        if (!before) return;
        const now = { x: event.clientX, y: event.clientY };
        const [right, down] = [now.x - before.x, now.y - before.y];
        fingers.set(event.pointerId, now);
        if (fingers.size === 2) {
            const other = [...fingers].find(([id]) => id !== event.pointerId)![1];
            const apart = (point: { x: number; y: number }) => Math.hypot(point.x - other.x, point.y - other.y);
            zoom(apart(now) / Math.max(1, apart(before)));
            orbit.shiftBy?.(right / 2, down / 2);
        } else if (event.altKey || event.buttons === 2) {
            orbit.light = turnedLight(orbit.light, right * degreesOfPixel, -down * degreesOfPixel);
            orbit.draw();
        } else if (event.shiftKey || event.buttons === 4) {
            orbit.shiftBy?.(right, down);
        } else {
            turn(-right * degreesOfPixel, down * degreesOfPixel);
        }
    });
    const release = (event: PointerEvent) => {
        fingers.delete(event.pointerId);
        if (fingers.size === 0) canvas.classList.remove("held");
    };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("dblclick", () => orbit.reset());
    canvas.addEventListener(
        "wheel",
        (event) => {
            event.preventDefault();
            const unit = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 33 : 1;
            zoom(2 ** (-Math.max(-400, Math.min(400, event.deltaY * unit)) / (event.ctrlKey ? 60 : 300)));
        },
        { passive: false },
    );
    canvas.addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const step = event.shiftKey ? 15 : 5;
        const act: Record<string, () => void> = {
            ArrowLeft: () => turn(-step, 0),
            ArrowRight: () => turn(step, 0),
            ArrowUp: () => turn(0, step),
            ArrowDown: () => turn(0, -step),
            "+": () => zoom(1.25),
            "=": () => zoom(1.25),
            "-": () => zoom(0.8),
            _: () => zoom(0.8),
            0: () => orbit.reset(),
            Home: () => orbit.reset(),
        };
        const chosen = act[event.key];
        if (!chosen) return;
        event.preventDefault();
        orbit.stop?.();
        chosen();
    });
}
