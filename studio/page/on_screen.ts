// Converts the current view to options of `sikku draw`: the options of the work, and the window of the map.
import { cameraOf, windowOf } from "./camera";
import type { Studio } from "./context";
import { withOption } from "./options";
import type { Options } from "./protocol";

const usual = { width: 1000, height: 800 }; // used before the map has been shown

/// The window of the map; null while it shows the whole page.
export function windowOnScreen(studio: Studio): string | null {
    const camera = cameraOf(studio.store.work.place);
    if (!camera || !studio.opened?.facts.has_view) return null;
    const canvas = document.querySelector<HTMLElement>(".map-canvas");
    const size = canvas?.clientWidth ? { width: canvas.clientWidth, height: canvas.clientHeight } : usual;
    return windowOf(camera, size).join(",");
}

export function drawOptions(studio: Studio, withWindow: boolean): Options {
    return withOption(studio.store.work.draw, "window", withWindow ? windowOnScreen(studio) : null);
}
