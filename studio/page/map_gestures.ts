// Pointer, wheel and keys on the map.
import type { MapView } from "./map_view";

const least = 4; // pixels: shorter drags are clicks

interface Finger {
    left: number;
    top: number;
}

/// @param onPointer  where the pointer is, in CSS pixels of the view; null when it has left
export function addGestures(view: MapView, onPointer: (at: Finger | null) => void): void {
    const { canvas } = view;
    const fingers = new Map<number, Finger>();
    let isDragging = false; // once the pointer has moved far enough
    const at = (event: MouseEvent): Finger => {
        const box = canvas.getBoundingClientRect();
        return { left: event.clientX - box.left, top: event.clientY - box.top };
    };

    canvas.addEventListener("pointerdown", (event) => {
        if (event.pointerType === "mouse" && event.button !== 0 && event.button !== 1) return;
        canvas.setPointerCapture(event.pointerId);
        fingers.set(event.pointerId, at(event));
        isDragging = fingers.size > 1;
        canvas.classList.add("held");
    });
    canvas.addEventListener("pointermove", (event) => {
        const now = at(event);
        onPointer(now);
        const before = fingers.get(event.pointerId);
        if (!before) return;
        if (!isDragging && distance(before, now) < least) return;
        isDragging = true;
        fingers.set(event.pointerId, now);
        if (fingers.size === 1) {
            view.panBy(now.left - before.left, now.top - before.top);
        } else if (fingers.size === 2) {
            const other = [...fingers].find(([id]) => id !== event.pointerId)![1];
            view.pinch(
                middle(before, other),
                middle(now, other),
                distance(now, other) / Math.max(1, distance(before, other)),
            );
        }
    });
    const release = (event: PointerEvent) => {
        fingers.delete(event.pointerId);
        if (fingers.size === 0) canvas.classList.remove("held");
    };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
    canvas.addEventListener("pointerleave", () => onPointer(null));
    canvas.addEventListener("dblclick", (event) => {
        const { left, top } = at(event);
        view.zoomBy(event.shiftKey ? 0.5 : 2, left, top);
    });
    canvas.addEventListener(
        "wheel",
        (event) => {
            event.preventDefault();
            const { left, top } = at(event);
            onPointer({ left, top }); // the wheel may turn before the pointer has moved
            const unit =
                event.deltaMode === WheelEvent.DOM_DELTA_LINE
                    ? 33
                    : event.deltaMode === WheelEvent.DOM_DELTA_PAGE
                      ? 400
                      : 1;
            const distance = Math.max(-400, Math.min(400, event.deltaY * unit));
            // Browsers report a pinch on a touchpad as a wheel with the control key.
            const octaves = -distance / (event.ctrlKey ? 60 : 220);
            view.zoomBy(2 ** octaves, left, top, event.ctrlKey);
        },
        { passive: false },
    );

    canvas.addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const share = event.shiftKey ? 0.5 : 0.12;
        const across = view.size.width * share;
        const along = view.size.height * share;
        const act: Record<string, () => void> = {
            ArrowLeft: () => view.panBy(across, 0),
            ArrowRight: () => view.panBy(-across, 0),
            ArrowUp: () => view.panBy(0, along),
            ArrowDown: () => view.panBy(0, -along),
            "+": () => view.zoomBy(2),
            "=": () => view.zoomBy(2),
            "-": () => view.zoomBy(0.5),
            _: () => view.zoomBy(0.5),
            0: () => view.showPage(),
            Home: () => view.showPage(),
            f: () => view.showDrawing(),
        };
        const chosen = act[event.key];
        if (!chosen) return;
        event.preventDefault();
        chosen();
    });
}

function middle(one: Finger, other: Finger): Finger {
    return { left: (one.left + other.left) / 2, top: (one.top + other.top) / 2 };
}

function distance(one: Finger, other: Finger): number {
    return Math.hypot(one.left - other.left, one.top - other.top);
}
