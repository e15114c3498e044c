// Values that the browser keeps between visits, as JSON.

/// `absent` if the browser has none, or no storage.
export function remembered<Value>(name: string, absent: Value): Value {
    try {
        return JSON.parse(localStorage.getItem(name) ?? "null") ?? absent;
    } catch {
        return absent;
    }
}

/// The name under which the history of the work is stored.
export const work_key = "sikku-studio";

/// True if an earlier visit has saved work.
export function hasSavedWork(): boolean {
    return remembered<unknown>(work_key, null) !== null;
}

/// False if the browser has no room for it, or no storage: then it lasts as long as the page.
export function remember(name: string, value: unknown): boolean {
    try {
        localStorage.setItem(name, JSON.stringify(value));
        return true;
    } catch {
        return false;
    }
}
