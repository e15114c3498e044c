// The position of the map: coordinates, a scale bar, and a form to go to a place.
import { decimalsOf, limited, pointAt } from "./camera";
import { exactOf, exactText, grouped, readExact, type Exact } from "./decimal";
import { button, element, field } from "./elements";
import type { MapView } from "./map_view";
import { raised } from "./numbers_shown";
import { sheetOf } from "./sheet";
import type { Studio } from "./context";

const manyDigits = 40; // written smaller

/// A coordinate for display, as precise as a pixel; one with more than `most` digits is shortened in the middle.
function shortText(value: Exact, scale: number, most: number): string {
    const decimals = Math.max(0, decimalsOf(scale));
    const [whole = "", fraction = ""] = exactText(value, decimals).split(".");
    // With zeros at the end, so that the digits tell the precision and do not jump.
    const text = decimals > 0 ? `${whole}.${fraction.padEnd(decimals, "0")}` : whole;
    if (text.length <= most) return grouped(text);
    const half = Math.floor(most / 2);
    return `${text.slice(0, half)}…${text.slice(-half)}`;
}

/// The number of digits for which a view has room, on three lines.
function roomFor(width: number): number {
    return Math.max(26, 3 * Math.floor((width - 250) / 7.5));
}

/// A short text for a number of steps.
export function stepsText(steps: number): string {
    if (steps >= 1e6) {
        const exponent = Math.floor(Math.log10(steps));
        const factor = Math.round(steps / 10 ** exponent);
        return `${factor === 1 ? "" : `${factor} × `}10${raised(exponent)} steps`;
    }
    const text = grouped(exactText(exactOf(steps), decimalsOf(steps / 10)));
    return text === "1" ? "1 step" : `${text} steps`;
}

/// A round length for a scale bar of at most `most` pixels.
export function barLength(scale: number, most: number): number {
    const room = scale * most;
    const power = 10 ** Math.floor(Math.log10(room));
    return [5, 2, 1].map((factor) => factor * power).find((steps) => steps <= room) ?? power;
}

export interface PlaceBar {
    readonly element: HTMLElement;
    update(pointer: { left: number; top: number } | null): void;
}

export function makePlaceBar(view: MapView, { help, store }: Studio): PlaceBar {
    const bar = element("div", { class: "map-scale", "aria-hidden": "true" });
    const barText = element("span", { class: "map-scale-text number" });
    const barLine = element("span", { class: "map-scale-line" });
    bar.append(barText, barLine);
    const sheet = element("p", { class: "map-chip map-sheet" });
    const x = element("span", { class: "number" });
    const y = element("span", { class: "number" });
    const whose = element("span", { class: "map-whose" });
    const toggle = element(
        "button",
        {
            type: "button",
            class: "map-chip map-coordinates",
            "aria-expanded": "false",
            "aria-haspopup": "dialog",
            title: "Exact coordinates: go to a place",
        },
        whose,
        x,
        y,
    );
    const form = makeForm(view, () => open(false));
    toggle.setAttribute("aria-controls", form.element.id);
    const whole = element("div", { class: "map-place" }, form.element, bar, sheet, toggle);

    function open(isOpen: boolean): void {
        form.element.hidden = !isOpen;
        toggle.setAttribute("aria-expanded", String(isOpen));
        if (isOpen) form.fill();
        else toggle.focus();
    }
    toggle.addEventListener("click", () => open(form.element.hidden !== false));
    form.element.addEventListener("keydown", (event) => {
        if (event.key !== "Escape") return;
        event.stopPropagation();
        open(false);
    });

    return {
        element: whole,
        update(pointer) {
            const isPlane = view.mode === "plane";
            bar.hidden = !isPlane;
            sheet.hidden = isPlane || view.isMagnified;
            toggle.hidden = !isPlane;
            if (!isPlane) {
                sheet.textContent = sheetOf(help, store.work.draw).name;
                if (!form.element.hidden) open(false);
                return;
            }
            const { camera, size } = view;
            const steps = barLength(camera.scale, Math.min(150, size.width * 0.3));
            barText.textContent = stepsText(steps);
            barLine.style.width = `${steps / camera.scale}px`;
            const point = pointer ? pointAt(camera, size, pointer.left, pointer.top) : camera;
            whose.textContent = pointer ? "Pointer" : "Centre";
            const most = roomFor(size.width);
            const texts = [shortText(point.x, camera.scale, most), shortText(point.y, camera.scale, most)] as const;
            x.textContent = `x ${texts[0]}`;
            y.textContent = `y ${texts[1]}`;
            toggle.classList.toggle("long", texts.some((text) => text.length > manyDigits));
        },
    };
}

function makeForm(view: MapView, close: () => void) {
    const text = (id: string, label: string) => {
        const input = element("input", { type: "text", id, class: "number", autocomplete: "off", spellcheck: "false" });
        return { input, row: field(label, input) };
    };
    const x = text("map-x", "Centre x, in steps");
    const y = text("map-y", "Centre y, in steps");
    const scale = text("map-steps", "Steps per pixel");
    const wrong = element("p", { class: "note error", role: "alert", hidden: true });
    const form = element(
        "form",
        { class: "map-form", id: "map-form", hidden: true, "aria-label": "Go to a place" },
        x.row,
        y.row,
        scale.row,
        wrong,
        element(
            "div",
            { class: "toolbar" },
            element("button", { type: "submit", class: "button primary" }, "Go there"),
            button("Close", close, { kind: "quiet" }),
        ),
    );
    form.addEventListener("submit", (event) => {
        event.preventDefault();
        const to = { x: readExact(x.input.value), y: readExact(y.input.value), scale: Number(scale.input.value) };
        const faults = [
            [x, to.x === null],
            [y, to.y === null],
            [scale, !(to.scale > 0 && Number.isFinite(to.scale))],
        ] as const;
        for (const [each, isWrong] of faults) each.input.setAttribute("aria-invalid", String(isWrong));
        const fault = faults.find(([, isWrong]) => isWrong);
        wrong.hidden = !fault;
        if (fault || to.x === null || to.y === null) {
            wrong.textContent =
                fault?.[0] === scale
                    ? "The scale must be a number above 0, such as 0.5 or 2e6."
                    : "A coordinate must be a decimal number of any length, such as -12.5.";
            fault?.[0].input.focus();
            return;
        }
        view.travel({ x: to.x, y: to.y, scale: limited(to.scale) });
    });
    return {
        element: form,
        fill() {
            const { camera } = view;
            x.input.value = exactText(camera.x, decimalsOf(camera.scale) + 1);
            y.input.value = exactText(camera.y, decimalsOf(camera.scale) + 1);
            scale.input.value = String(Number(camera.scale.toPrecision(6)));
            x.input.focus();
            x.input.select();
        },
    };
}
