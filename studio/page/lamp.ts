// The light on a drawing in space, with its controls.
import { element, field, slideTo } from "./elements";
import { between } from "./eye";

/// The direction of the light: degrees around the drawing and upwards.
export interface Light {
    readonly azimuth: number;
    readonly elevation: number;
}

export const usualLight: Light = { azimuth: -38, elevation: 46 };
const lowest = 5; // degrees: below this, shadows are endless

export function turnedLight({ azimuth, elevation }: Light, right: number, up: number): Light {
    return { azimuth: between(azimuth + right), elevation: Math.max(lowest, Math.min(90, elevation + up)) };
}

export function makeLamp(change: (light: Light) => void): { element: HTMLElement; show(light: Light): void } {
    let light = usualLight;
    const slider = (id: string, least: number, most: number, part: keyof Light) => {
        const input = element("input", { type: "range", id, min: least, max: most, step: 1 });
        input.addEventListener("input", () => {
            light = { ...light, [part]: Number(input.value) };
            change(light);
        });
        return { input, show: () => slideTo(input, light[part]) };
    };
    const around = slider("space-light-around", -180, 180, "azimuth");
    const height = slider("space-light-height", lowest, 90, "elevation");
    const fields = element(
        "div",
        { class: "space-light-fields" },
        field("Direction", around.input),
        field("Height", height.input),
        element("p", { class: "space-light-note" }, "Prints keep their own light."),
    );
    return {
        element: element("details", { class: "space-light" }, element("summary", {}, "Light"), fields),
        show(now) {
            light = now;
            around.show();
            height.show();
        },
    };
}
