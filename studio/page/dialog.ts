// Dialogs and menus, which use the browser's own elements to contain and restore the focus.
import { button, element } from "./elements";

export interface Dialog {
    element: HTMLDialogElement;
    body: HTMLElement;
    footer: HTMLElement;
    close(): void;
}

let last = 0;

/// Opens a dialog, which is removed from the page when it is closed.
export function openDialog(title: string, options: { wide?: boolean; closed?: () => void } = {}): Dialog {
    const id = `dialog-${++last}`;
    const body = element("div", { class: "body", tabindex: -1 });
    const footer = element("footer");
    const close = button("Close", () => dialog.close(), { kind: "quiet", icon: "M3.5 3.5l9 9m0-9l-9 9" });
    const dialog = element(
        "dialog",
        { class: `dialog ${options.wide ? "wide" : ""}`.trim(), "aria-labelledby": id },
        element("header", {}, element("h2", { id }, title), close),
        body,
        footer,
    );
    dialog.addEventListener("close", () => {
        dialog.remove();
        options.closed?.();
    });
    dialog.addEventListener("pointerdown", (event) => {
        if (event.target === dialog) dialog.close();
    });
    document.body.append(dialog);
    dialog.showModal();
    return { element: dialog, body, footer, close: () => dialog.close() };
}

export interface MenuItem {
    label: string;
    detail?: string;
    act: () => void;
}

/// Makes a button open a menu below itself; arrow keys move in the menu, Escape closes it.
export function menuButton(opener: HTMLButtonElement, items: () => (MenuItem | null)[]): void {
    const menu = element("div", { class: "menu", popover: "auto", role: "menu", id: `menu-${++last}` });
    opener.setAttribute("aria-haspopup", "menu");
    opener.setAttribute("aria-expanded", "false");
    opener.after(menu);
    menu.addEventListener("toggle", () => opener.setAttribute("aria-expanded", String(menu.matches(":popover-open"))));
    menu.addEventListener("keydown", (event) => {
        const entries = [...menu.querySelectorAll("button")];
        const at = entries.indexOf(document.activeElement as HTMLButtonElement);
        const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
        if (by === undefined) return;
        event.preventDefault();
        entries[(at + by + entries.length) % entries.length]?.focus();
    });
    opener.addEventListener("click", () => {
        menu.replaceChildren(
            ...items().map((item) => {
                if (!item) return element("hr");
                const entry = element("button", { type: "button", role: "menuitem" }, item.label);
                if (item.detail) entry.append(element("kbd", {}, item.detail));
                entry.addEventListener("click", () => {
                    menu.hidePopover();
                    item.act();
                });
                return entry;
            }),
        );
        if (menu.matches(":popover-open")) {
            menu.hidePopover();
            return;
        }
        menu.showPopover();
        place(menu, opener);
        menu.querySelector("button")?.focus();
    });
}

/// Places a popover below its opener, within the window.
export function place(popover: HTMLElement, opener: HTMLElement): void {
    const at = opener.getBoundingClientRect();
    const width = popover.offsetWidth;
    popover.style.left = `${Math.max(8, Math.min(at.left, innerWidth - width - 8))}px`;
    popover.style.top = `${at.bottom + 6}px`;
}
