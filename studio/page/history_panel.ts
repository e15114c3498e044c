// The history as a list of pictures: a click returns to a step.
import type { Application } from "./application";
import type { Work } from "./context";
import { place } from "./dialog";
import { element } from "./elements";
import { drawInto } from "./pictures";

const rest = 700; // milliseconds without a change until a step is drawn
const picture_size = 72;

function ago(time: number): string {
    const minutes = Math.round((Date.now() - time) / 60_000);
    if (minutes < 1) return "now";
    if (minutes < 60) return `${minutes} min ago`;
    return minutes < 1440 ? `${Math.round(minutes / 60)} h ago` : new Date(time).toLocaleDateString();
}

export function makeHistory(application: Application, opener: HTMLButtonElement): void {
    const { store } = application;
    const list = element("ol", { class: "steps" });
    const popover = element(
        "div",
        { class: "menu history", popover: "auto", id: "history", "aria-label": "History", role: "dialog" },
        list,
    );
    opener.setAttribute("aria-haspopup", "dialog");
    opener.setAttribute("aria-expanded", "false");
    opener.after(popover);

    const show = () => {
        if (!popover.matches(":popover-open")) return;
        const focused = [...list.querySelectorAll("button")].indexOf(document.activeElement as HTMLButtonElement);
        list.replaceChildren(
            ...store.history
                .map((step, at) => {
                    const picture = step.picture
                        ? element("img", { src: step.picture, alt: "", width: 44, height: 44 })
                        : element("span", { class: "no-picture" });
                    const entry = element(
                        "button",
                        { type: "button", "aria-current": at === store.position ? "step" : null },
                        picture,
                        element("span", {}, step.label),
                        element("small", {}, ago(step.time)),
                    );
                    entry.addEventListener("click", () => store.go(at));
                    return element("li", {}, entry);
                })
                .reverse(),
        );
        if (focused >= 0) list.querySelectorAll("button")[focused]?.focus();
    };
    store.watch(show);
    popover.addEventListener("toggle", () => {
        const isOpen = popover.matches(":popover-open");
        opener.setAttribute("aria-expanded", String(isOpen));
        if (!isOpen) return;
        show();
        void drawMissing(application, popover);
        place(popover, opener);
        list.querySelector<HTMLElement>("[aria-current]")?.focus();
    });
    opener.addEventListener("click", () => popover.togglePopover());

    let timer = 0;
    const drawSoon = (work: Work) => {
        clearTimeout(timer);
        timer = window.setTimeout(() => void drawStep(application, work), rest);
    };
    application.onOpened((_, work) => drawSoon(work));
    if (application.opened && !store.history[store.position]?.picture) drawSoon(application.opened.work);
}

// Draws steps that had no time to be drawn, the newest first, when the list is opened.
async function drawMissing(application: Application, popover: HTMLElement): Promise<void> {
    for (const { work, picture } of application.store.history.toReversed()) {
        if (!popover.matches(":popover-open")) return;
        if (!picture) await drawStep(application, work);
    }
}

async function drawStep(application: Application, work: Work): Promise<void> {
    const canvas = element("canvas", { width: picture_size, height: picture_size });
    try {
        await drawInto(canvas, picture_size, application.engine, work.pattern, work.draw, "history");
        application.store.picture(work, canvas.toDataURL("image/webp", 0.8));
    } catch {
        // the step keeps no picture
    }
}
