// Scale files that the user opened: stored in the browser, and passed to the libraries at every start.
import type { Engine } from "./context";

const storage_key = "sikku-studio-scales";

function saved(): Record<string, string> {
    try {
        return JSON.parse(localStorage.getItem(storage_key) ?? "{}") as Record<string, string>;
    } catch {
        return {};
    }
}

export function keepScale(name: string, bytes: Uint8Array): void {
    try {
        localStorage.setItem(storage_key, JSON.stringify({ ...saved(), [name]: String.fromCharCode(...bytes) }));
    } catch {
        // without storage, the scale lasts as long as the page
    }
}

export function restoreScales(engine: Engine): void {
    for (const [name, text] of Object.entries(saved())) {
        const bytes = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
        engine.request({ do: "scale", name }, { bytes }).catch(() => {});
    }
}
