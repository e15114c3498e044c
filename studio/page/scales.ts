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

/// Each byte as a letter.
export function lettersOf(bytes: Uint8Array): string {
    const part = 8192; // bytes: a call takes only so many arguments
    let letters = "";
    for (let from = 0; from < bytes.length; from += part) {
        letters += String.fromCharCode(...bytes.subarray(from, from + part));
    }
    return letters;
}

export function bytesOf(letters: string): Uint8Array {
    return Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
}

export function keepScale(name: string, bytes: Uint8Array): void {
    try {
        localStorage.setItem(storage_key, JSON.stringify({ ...saved(), [name]: lettersOf(bytes) }));
    } catch {
        // without storage, the scale lasts as long as the page
    }
}

export function restoreScales(engine: Engine): void {
    for (const [name, text] of Object.entries(saved())) {
        engine.request({ do: "scale", name }, { bytes: bytesOf(text) }).catch(() => {});
    }
}
