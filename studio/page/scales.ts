// Scale files that the user opened: stored in the browser, and passed to the libraries at every start.
import type { Engine } from "./context";
import { remember, remembered } from "./storage";

const storage_key = "sikku-studio-scales";

const saved = () => remembered<Record<string, string>>(storage_key, {});

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
    remember(storage_key, { ...saved(), [name]: lettersOf(bytes) });
}

export function restoreScales(engine: Engine): void {
    for (const [name, text] of Object.entries(saved())) {
        engine.request({ do: "scale", name }, { bytes: bytesOf(text) }).catch(() => {});
    }
}
