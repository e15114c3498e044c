// Copying text, also where the page has no clipboard: from a file, or over plain http.
import type { Studio } from "./context";
import { element } from "./elements";

/// Copies the text of a thing, or selects it if the browser does not allow that, and reports which.
export async function copyOrSelect(studio: Studio, thing: string, text: string, select: () => void): Promise<void> {
    let isCopied = true;
    try {
        await navigator.clipboard.writeText(text);
    } catch {
        isCopied = copySelected(text);
    }
    if (isCopied) return studio.say(`The ${thing} is copied.`);
    select();
    studio.say(`The browser does not let the page copy; the ${thing} is selected.`, "warning");
}

// In a dialog, nothing outside of it can be selected.
function copySelected(text: string): boolean {
    const focused = document.activeElement;
    const field = element("textarea", { readonly: true, class: "unseen", "aria-hidden": "true", tabindex: -1 });
    field.value = text;
    (focused?.closest("dialog") ?? document.querySelector("dialog[open]") ?? document.body).append(field);
    field.select();
    const isCopied = document.execCommand("copy");
    field.remove();
    if (focused instanceof HTMLElement) focused.focus();
    return isCopied;
}
