// Copying text, also where the page has no clipboard: from a file, or over plain http.
import { element } from "./elements";

/// False if the browser does not allow it.
export async function copyText(text: string): Promise<boolean> {
    try {
        await navigator.clipboard.writeText(text);
        return true;
    } catch {
        return copySelected(text);
    }
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
