// The keyboard shortcuts of the page, and the list that shows them. The editor and the views handle their own keys.
import { openDialog } from "./dialog";
import { element } from "./elements";

export interface Shortcut {
    keys: string; // for display: "Ctrl+Z"
    label: string;
    act?: () => void; // absent: handled elsewhere
    everywhere?: boolean; // also in fields
}

export const isMac = /Mac|iPhone|iPad/.test(navigator.platform);

/// The keys in the notation of this system.
export function shown(keys: string): string {
    return isMac ? keys.replaceAll("Ctrl", "⌘").replaceAll("Alt", "⌥").replaceAll("Shift", "⇧") : keys;
}

function pressed(event: KeyboardEvent): string {
    const names = [
        event.ctrlKey || event.metaKey ? "Ctrl" : "",
        event.altKey ? "Alt" : "",
        (event.shiftKey && event.key.length > 1) || (event.shiftKey && event.ctrlKey) ? "Shift" : "",
    ];
    // Some systems type other letters with Alt, so the position of the key counts.
    const place = /^(?:Key|Digit)(.)$/.exec(event.code)?.[1];
    const key =
        event.altKey && place
            ? place
            : event.key.length === 1
              ? event.key.toUpperCase()
              : event.key.replace("Arrow", "");
    return [...names.filter(Boolean), key].join("+");
}

function isField(target: EventTarget | null): boolean {
    return (
        target instanceof HTMLElement &&
        (target.isContentEditable ||
            target.matches(
                "textarea, select, input:not([type='range'], [type='checkbox'], [type='radio'], [type='color'])",
            ))
    );
}

export function listen(shortcuts: Shortcut[]): void {
    addEventListener("keydown", (event) => {
        if (event.defaultPrevented) return;
        const keys = pressed(event);
        const found = shortcuts.find((each) => each.act && each.keys === keys);
        if (!found || (isField(event.target) && !found.everywhere) || document.querySelector("dialog[open]")) return;
        event.preventDefault();
        found.act!();
    });
}

export function openShortcuts(shortcuts: Shortcut[]): void {
    const dialog = openDialog("Keyboard");
    dialog.body.append(
        element(
            "dl",
            { class: "shortcuts" },
            ...shortcuts.flatMap(({ keys, label }) => [
                element(
                    "dt",
                    {},
                    ...shown(keys)
                        .split(" or ")
                        .flatMap((each, at) => [...(at > 0 ? [" or "] : []), element("kbd", {}, each)]),
                ),
                element("dd", {}, label),
            ]),
        ),
    );
}
