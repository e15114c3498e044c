// The layout of the page: widths, the parts shown on a narrow screen, and the light or dark theme.
import { byId, choices } from "./elements";
import { remember, remembered } from "./storage";

const least_side = 260;
const storage_key = "sikku-studio-layout";

interface Layout {
    side?: number;
    theme?: Theme;
}
export type Theme = "system" | "light" | "dark";

const saved = () => remembered<Layout>(storage_key, {});

function save(change: Layout): void {
    remember(storage_key, { ...saved(), ...change });
}

const prefersDark = () => matchMedia("(prefers-color-scheme: dark)");

export function theme(): Theme {
    return saved().theme ?? "system";
}

export function setTheme(chosen: Theme): void {
    save({ theme: chosen });
    applyTheme();
}

export function applyTheme(): void {
    const becomesDark = theme() === "dark" || (theme() === "system" && prefersDark().matches);
    document.documentElement.dataset["theme"] = becomesDark ? "dark" : "light";
}

/// True while the page has dark colours.
export function isDark(): boolean {
    return document.documentElement.dataset["theme"] === "dark";
}

/// Calls `act` after each change between light and dark.
export function onTheme(act: () => void): void {
    new MutationObserver(act).observe(document.documentElement, { attributeFilter: ["data-theme"] });
}

export function makeLayout(): void {
    prefersDark().addEventListener("change", applyTheme);
    makeDivider();
    makeSideTabs();
    for (const skip of document.querySelectorAll<HTMLElement>("[data-skip]")) {
        skip.addEventListener("click", () => {
            const target = byId(skip.dataset["skip"]!);
            (target.querySelector<HTMLElement>(".cm-content") ?? target).focus();
        });
    }
}

function makeDivider(): void {
    const divider = byId("divider");
    const workbench = byId("workbench");
    const most = () => Math.max(least_side, Math.round(innerWidth * 0.7));
    const set = (width: number) => {
        const side = Math.round(Math.min(Math.max(width, least_side), most()));
        workbench.style.setProperty("--side", `${side}px`);
        divider.ariaValueMin = String(least_side);
        divider.ariaValueMax = String(most());
        divider.ariaValueNow = String(side);
        save({ side });
    };
    set(saved().side ?? Math.min(440, Math.round(innerWidth * 0.34)));
    divider.addEventListener("pointerdown", (event) => divider.setPointerCapture(event.pointerId));
    divider.addEventListener("pointermove", (event) => {
        if (divider.hasPointerCapture(event.pointerId)) set(event.clientX);
    });
    divider.addEventListener("keydown", (event) => {
        const by = { ArrowLeft: -24, ArrowRight: 24 }[event.key];
        if (by === undefined) return;
        event.preventDefault();
        set(Number(divider.ariaValueNow) + by);
    });
}

// A narrow screen shows either the text or the values below the picture.
function makeSideTabs(): void {
    const side = byId("side-tabs").parentElement!;
    side.dataset["shown"] = "values";
    const attributes = { class: "segmented", "aria-label": "Below the picture" };
    const show = (name: string) => { side.dataset["shown"] = name; };
    byId("side-tabs").append(choices(attributes, [["values", "Values"], ["text", "Text"]], show));
}
