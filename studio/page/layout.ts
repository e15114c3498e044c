// The layout of the page: widths, the parts shown on a narrow screen, and the light or dark theme.
import { byId, element } from "./elements";

const least_side = 260;
const storage_key = "sikku-studio-layout";

interface Layout {
    side?: number;
    theme?: Theme;
}
export type Theme = "system" | "light" | "dark";

function saved(): Layout {
    try {
        return JSON.parse(localStorage.getItem(storage_key) ?? "{}") as Layout;
    } catch {
        return {};
    }
}

function save(change: Layout): void {
    try {
        localStorage.setItem(storage_key, JSON.stringify({ ...saved(), ...change }));
    } catch {
        // without storage, the layout lasts as long as the page
    }
}

const prefers_dark = matchMedia("(prefers-color-scheme: dark)");

export function theme(): Theme {
    return saved().theme ?? "system";
}

export function setTheme(chosen: Theme): void {
    save({ theme: chosen });
    applyTheme();
}

export function applyTheme(): void {
    const isDark = theme() === "dark" || (theme() === "system" && prefers_dark.matches);
    document.documentElement.dataset["theme"] = isDark ? "dark" : "light";
}

prefers_dark.addEventListener("change", applyTheme);

export function makeLayout(): void {
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
        for (const [name, value] of [
            ["min", least_side],
            ["max", most()],
            ["now", side],
        ] as const) {
            divider.setAttribute(`aria-value${name}`, String(value));
        }
        save({ side });
    };
    const now = () => Number(divider.getAttribute("aria-valuenow"));
    set(saved().side ?? Math.min(440, Math.round(innerWidth * 0.34)));
    divider.addEventListener("pointerdown", (event) => divider.setPointerCapture(event.pointerId));
    divider.addEventListener("pointermove", (event) => {
        if (divider.hasPointerCapture(event.pointerId)) set(event.clientX);
    });
    divider.addEventListener("keydown", (event) => {
        const by = { ArrowLeft: -24, ArrowRight: 24 }[event.key];
        if (by === undefined) return;
        event.preventDefault();
        set(now() + by);
    });
}

// A narrow screen shows either the text or the values below the picture.
function makeSideTabs(): void {
    const side = byId("side-tabs").parentElement!;
    const group = element("div", { class: "segmented", role: "group", "aria-label": "Below the picture" });
    const buttons = (
        [
            ["values", "Values"],
            ["text", "Text"],
        ] as const
    ).map(([name, label]) => {
        const choice = element("button", { type: "button", "aria-pressed": String(name === "values") }, label);
        choice.addEventListener("click", () => {
            side.dataset["shown"] = name;
            for (const each of buttons) each.setAttribute("aria-pressed", String(each === choice));
        });
        return choice;
    });
    side.dataset["shown"] = "values";
    group.append(...buttons);
    byId("side-tabs").append(group);
}
