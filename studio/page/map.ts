// The panel with the picture: the page as it will be printed, and the endless plane behind it.
import { messageOf, type MakePanel, type Studio } from "./context";
import { exactText } from "./decimal";
import { decimalsOf } from "./camera";
import { button, element } from "./elements";
import { onTheme } from "./layout";
import { addGestures } from "./map_gestures";
import { makePlaceBar, stepsText } from "./map_place";
import { drawing, MapView } from "./map_view";
import { makeMapWord } from "./map_word";
import type { Opened } from "./protocol";
import { Refusal } from "./refusal";
import { sheetOf } from "./sheet";

const describeAfter = 500; // milliseconds

const icons = {
    closer: "M8 3v10M3 8h10",
    farther: "M3 8h10",
    drawing: "M2.5 6V2.5H6M10 2.5h3.5V6M13.5 10v3.5H10M6 13.5H2.5V10",
    page: "M4 1.8h5.5L12.5 5v9.2H4zM9.3 2v3.2h3",
};

export const makeMapPanel: MakePanel = (studio) => {
    const hint = element(
        "p",
        { class: "unseen", id: "map-hint" },
        "Arrow keys move the view, plus and minus zoom, 0 shows the whole page, f fits the drawing into the view.",
    );
    const canvas = element("canvas", {
        class: "map-canvas",
        tabindex: 0,
        role: "img",
        "aria-label": "Picture",
        "aria-describedby": "map-hint",
    });
    const problem = element("div", { class: "note map-problem", role: "status", hidden: true });
    const refusal = new Refusal(studio, problem);
    let pointer: { left: number; top: number } | null = null;

    const view = new MapView(studio, canvas, () => update());
    const place = makePlaceBar(view, studio);
    const toDrawing = button("Fit the drawing (F)", () => view.showDrawing(), { icon: icons.drawing });
    const toPage = button("Whole page (0)", () => view.showPage(), { icon: icons.page });
    const tools = element(
        "div",
        { class: "map-tools", role: "toolbar", "aria-label": "View", "aria-orientation": "vertical" },
        element(
            "div",
            { class: "map-pair" },
            button("Zoom in (+)", () => view.zoomBy(2), { icon: icons.closer }),
            button("Zoom out (−)", () => view.zoomBy(0.5), { icon: icons.farther }),
        ),
        element("div", { class: "map-pair" }, toDrawing, toPage),
    );
    const word = makeMapWord(studio);
    const draft = document.getElementById("draft") ?? "";
    const panel = element("div", { class: "map" }, draft, canvas, hint, word.element, problem, tools, place.element);

    addGestures(view, (at) => {
        pointer = at;
        place.update(pointer);
    });
    const describer = describeSoon(studio, view, canvas);
    let shown: string | MapView["failure"] = "";
    function update(): void {
        panel.dataset["mode"] = view.mode;
        panel.classList.toggle("stale", view.isStale);
        panel.setAttribute("aria-busy", String(view.waiting === drawing));
        place.update(pointer);
        toDrawing.disabled = !view.hasPlane;
        toPage.setAttribute("aria-pressed", String(view.mode === "page" && !view.isMagnified));
        const empty = view.isElsewhere
            ? "The drawing is outside this view; press F to fit it."
            : view.isEmpty
              ? "No line in this view; press F to fit the drawing."
              : "";
        const now = view.failure ?? (view.waiting || view.problem || empty);
        if (now !== shown) {
            shown = now;
            refusal.clear();
            if (typeof now === "string") {
                word.hide();
                problem.textContent = now;
                problem.hidden = now === "";
            } else {
                refusal.show(now.error, now.pattern);
                // Patterns of the folder words are read rather than drawn.
                if (/no visible line/.test(messageOf(now.error))) {
                    word.show(now.pattern);
                } else {
                    word.hide();
                }
            }
        }
        problem.classList.toggle("quiet", view.failure === null && (view.waiting !== "" || view.problem === ""));
        describer();
    }

    new ResizeObserver(() => view.resize()).observe(canvas);
    onTheme(() => view.draw());
    studio.store.subscribe((work) => view.setWork(work));
    studio.onOpened((facts, work) => view.setFacts(facts, work));
    studio.onChecked(() => view.draw()); // with an error the picture of the previous text remains
    return { name: "map", label: "Picture", element: panel, show: () => view.show(), hide: () => view.hide() };
};

// Describes the picture for screen readers.
function describeSoon(studio: Studio, view: MapView, canvas: HTMLCanvasElement): () => void {
    let timer = 0;
    let measured: { facts: Opened | null; isClosed: boolean } | null = null;
    async function measure(facts: Opened): Promise<void> {
        const pattern = studio.opened!.work.pattern;
        try {
            const { json } = await studio.engine.request<{ closed?: boolean }>(
                { do: "measure", pattern },
                { key: "map-measure", lane: "back", seconds: 3 },
            );
            measured = { facts, isClosed: json.closed === true };
        } catch {
            measured = { facts, isClosed: false }; // too long to be measured, or not made of lines
        }
        describe();
    }
    function describe(): void {
        const facts = view.known;
        if (!facts) return;
        if (measured?.facts !== facts && !facts.is_spatial) void measure(facts);
        const parts = [
            `${facts.title || "Drawing"}, derivation length ${facts.n}`,
            facts.cost.segments && facts.cost.segments !== "0" ? `${facts.cost.segments} segments` : "",
            measured?.facts === facts && measured.isClosed ? "closed" : "",
            facts.is_spatial ? "in space" : "",
            view.mode === "page" ? `whole page, ${sheetOf(studio.help, studio.store.work.draw).name}` : placeText(view),
        ];
        canvas.setAttribute("aria-label", parts.filter((part) => part !== "").join(", "));
    }
    return () => {
        if (timer !== 0) return;
        timer = window.setTimeout(() => {
            timer = 0;
            describe();
        }, describeAfter);
    };
}

function placeText({ camera, size }: MapView): string {
    const decimals = decimalsOf(camera.scale);
    return (
        `a part ${stepsText(camera.scale * size.width)} wide around x ${exactText(camera.x, decimals)}, ` +
        `y ${exactText(camera.y, decimals)}`
    );
}
