// The seed, with buttons to lock it and to choose the previous, the next or a random one.
import type { Application } from "./application";
import { button, element, icon } from "./elements";
import { optionOf } from "./options";
import type { Opened } from "./protocol";

const lock_closed = "M4 7.5h8v6H4zM5.5 7.5V5a2.5 2.5 0 0 1 5 0v2.5";
const lock_open = "M4 7.5h8v6H4zM5.5 7.5V5a2.5 2.5 0 0 1 4.7-1.2";
const dice = "M3 3h10v10H3zM6 6h.01M10 6h.01M6 10h.01M10 10h.01M8 8h.01";
const largest_thrown = 1_000_000;

export function makeSeed(application: Application): { element: HTMLElement; update(facts: Opened): void } {
    const { store } = application;
    let facts: Opened | null = null;
    const isLocked = () => store.work.locked?.includes("seed") ?? false;
    const change = (value: string) => {
        if (isLocked()) application.say("The seed is locked.", "warning");
        else store.setting("seed", value, "setting seed");
    };
    const now = () => optionOf(store.work.pattern.settings, "seed") ?? facts?.seed ?? "0";
    const step = (by: bigint) => {
        const next = BigInt(now()) + by;
        if (next >= 0n) change(String(next));
    };

    const field = element("input", {
        type: "text",
        id: "seed",
        inputmode: "numeric",
        pattern: "[0-9]*",
        class: "number",
        autocomplete: "off",
    });
    field.addEventListener("change", () => {
        if (/^\d+$/.test(field.value.trim())) change(field.value.trim());
        else field.value = now();
    });
    const lock = button(
        "Lock the seed",
        () => {
            const locked = (store.work.locked ?? []).filter((each) => each !== "seed");
            store.change({ locked: isLocked() ? locked : [...locked, "seed"] });
        },
        { kind: "quiet", icon: lock_open },
    );
    const moves = [
        button("Previous seed", () => step(-1n), { icon: "M10 3 5 8l5 5" }),
        button("Next seed", () => step(1n), { icon: "M6 3l5 5-5 5" }),
        button("Random seed", () => change(String(Math.floor(Math.random() * largest_thrown))), { icon: dice }),
    ];
    const row = element(
        "div",
        { class: "seed-row" },
        element("label", { for: "seed" }, "seed"),
        field,
        element("div", { class: "toolbar" }, ...moves, lock),
    );

    const refresh = () => {
        const locked = isLocked();
        lock.setAttribute("aria-pressed", String(locked));
        lock.replaceChildren(icon(locked ? lock_closed : lock_open));
        field.readOnly = locked;
        for (const each of moves) each.disabled = locked;
        if (document.activeElement !== field) field.value = now();
    };
    store.subscribe(refresh);
    refresh();
    return {
        element: row,
        update(opened) {
            facts = opened;
            row.hidden = !opened.is_random;
            refresh();
        },
    };
}
