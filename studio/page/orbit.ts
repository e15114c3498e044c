// Turns a drawing in space with pointer, wheel and keys.

export interface Orbit {
    turn(right: number, up: number): void; // degrees
    shift(right: number, down: number): void; // pixels
    zoom(factor: number): void;
    light(right: number, up: number): void; // degrees
    reset(): void;
    stop(): void; // ends automatic motion
}

const degreesOfPixel = 0.4;

export function addOrbit(canvas: HTMLCanvasElement, orbit: Orbit): void {
    const fingers = new Map<number, { x: number; y: number }>();
    canvas.addEventListener("pointerdown", (event) => {
        canvas.setPointerCapture(event.pointerId);
        fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        canvas.classList.add("held");
        orbit.stop();
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
            orbit.zoom(apart(now) / Math.max(1, apart(before)));
            orbit.shift(right / 2, down / 2);
        } else if (event.altKey || event.buttons === 2) {
            orbit.light(right * degreesOfPixel, -down * degreesOfPixel);
        } else if (event.shiftKey || event.buttons === 4) {
            orbit.shift(right, down);
        } else {
            orbit.turn(-right * degreesOfPixel, down * degreesOfPixel);
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
            orbit.zoom(2 ** (-Math.max(-400, Math.min(400, event.deltaY * unit)) / (event.ctrlKey ? 60 : 300)));
        },
        { passive: false },
    );
    canvas.addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const step = event.shiftKey ? 15 : 5;
        const act: Record<string, () => void> = {
            ArrowLeft: () => orbit.turn(-step, 0),
            ArrowRight: () => orbit.turn(step, 0),
            ArrowUp: () => orbit.turn(0, step),
            ArrowDown: () => orbit.turn(0, -step),
            "+": () => orbit.zoom(1.25),
            "=": () => orbit.zoom(1.25),
            "-": () => orbit.zoom(0.8),
            _: () => orbit.zoom(0.8),
            0: () => orbit.reset(),
            Home: () => orbit.reset(),
        };
        const chosen = act[event.key];
        if (!chosen) return;
        event.preventDefault();
        orbit.stop();
        chosen();
    });
}
