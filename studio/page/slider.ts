// A name, a slider, a field for the value, and a button that resets it to the value in the text.
import { button, element, slideTo } from "./elements";

const reset_icon = "M3 6h6.5a3.5 3.5 0 0 1 0 7H6M3 6l3-3M3 6l3 3";

export interface SliderState {
    value: string; // as written
    number: number; // position of the thumb
    least: number;
    most: number;
    step: number | "any";
    isChanged: boolean; // differs from the text
    description?: string; // announced with the value
}

export interface Slider {
    element: HTMLElement;
    set(state: SliderState): void;
    /// Marks the value as invalid.
    setInvalid(isInvalid: boolean): void;
}

let last = 0;

function finite(number: number, otherwise: number): number {
    return Number.isFinite(number) ? number : otherwise;
}

/// `slide` receives the position of the thumb, `type` the text of the field.
export function makeSlider(
    label: string,
    acts: {
        slide(number: number): void;
        type(text: string): void;
        reset(): void;
        explain?(): string; // help while the pointer is on the name
    },
): Slider {
    const id = `slider-${++last}`;
    const name = element("label", { for: id, title: label }, label);
    const range = element("input", { type: "range", id, title: "Double-click to reset" });
    const field = element("input", {
        type: "text",
        "aria-label": `${label}, value`,
        spellcheck: "false",
        autocomplete: "off",
    });
    const reset = button(`Reset ${label}`, acts.reset, { kind: "quiet", icon: reset_icon });
    let shown = ""; // the value last set
    const row = element("div", { class: "slider" }, name, range, field, reset);

    name.addEventListener("pointerenter", () => {
        name.title = acts.explain?.() || label;
    });
    range.addEventListener("input", () => acts.slide(range.valueAsNumber));
    range.addEventListener("dblclick", acts.reset);
    name.addEventListener("dblclick", acts.reset);
    field.addEventListener("change", () => acts.type(field.value.trim()));
    field.addEventListener("keydown", (event) => {
        if (event.key === "Enter") acts.type(field.value.trim());
        if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
        event.preventDefault();
        if (event.key === "ArrowUp") range.stepUp();
        else range.stepDown();
        acts.slide(range.valueAsNumber);
    });

    return {
        element: row,
        setInvalid(isInvalid) {
            field.setAttribute("aria-invalid", String(isInvalid));
        },
        set(state) {
            // A value such as 1e400 may be typed; the libraries say what is wrong with it.
            const least = finite(state.least, 0);
            const most = finite(state.most, Math.max(least, 0) + 1);
            const number = Math.min(Math.max(finite(state.number, state.number > 0 ? most : least), least), most);
            range.min = String(least);
            range.max = String(most);
            range.step = String(state.step);
            slideTo(range, number, state.description ?? state.value);
            // A late answer does not overwrite what is being typed.
            const isTyping = document.activeElement === field && field.value !== "";
            if (!isTyping || (state.value !== shown && Number(field.value) !== Number(state.value))) field.value = state.value;
            shown = state.value;
            row.classList.toggle("changed", state.isChanged);
            reset.style.visibility = state.isChanged ? "visible" : "hidden";
        },
    };
}
