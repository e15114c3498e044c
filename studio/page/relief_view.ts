// Shows a relief before it is exported, as a small model that can be turned.
import { element } from "./elements";
import type { Eye } from "./eye";
import { readModel, type Model } from "./glb";
import { usualLight } from "./lamp";
import { isDark } from "./layout";
import { addOrbit, type Orbit } from "./orbit";
import { fittingHalf, Stage, type Staged } from "./space_stage";

const usualEye: Eye = { azimuth: -24, elevation: 46, distance: 4 };
const usualZoom = 1.25; // the ground may leave the picture

// The file has z up, for printers; the picture has y up, as the rotation of the file's node specifies.
function lay(model: Model): Model {
    const { low, high } = model;
    for (const { positions, normals } of model.parts) {
        for (const vectors of [positions, normals]) {
            for (let at = 0; at < vectors.length; at += 3) {
                const y = vectors[at + 1]!;
                vectors[at + 1] = vectors[at + 2]!;
                vectors[at + 2] = -y;
            }
        }
    }
    return { ...model, low: [low[0], low[2], -high[1]], high: [high[0], high[2], -low[1]] };
}

export class ReliefView implements Orbit {
    eye = usualEye;
    light = usualLight;
    zoom = usualZoom;
    private model: Staged | null = null;

    /// Null if the browser cannot show models.
    static make(size: number): ReliefView | null {
        const canvas = element("canvas", {
            class: "export-preview relief-preview",
            width: size,
            height: size,
            tabindex: 0,
            role: "img",
            "aria-label": "The relief; arrow keys turn it, plus and minus zoom, 0 resets the view",
        });
        const stage = Stage.on(canvas);
        return stage && new ReliefView(canvas, stage);
    }

    private constructor(
        readonly canvas: HTMLCanvasElement,
        private readonly stage: Stage,
    ) {
        addOrbit(canvas, this, 0.5, 12);
    }

    reset(): void {
        [this.eye, this.light, this.zoom] = [usualEye, usualLight, usualZoom];
        this.draw();
    }

    /// Shows a model of binary glTF.
    show(bytes: Uint8Array): void {
        const model = this.stage.add(lay(readModel(bytes)));
        if (this.model) this.stage.remove(this.model);
        this.model = model;
        this.draw();
    }

    draw(): void {
        const { model, canvas } = this;
        if (!model) return;
        this.stage.draw({
            models: [{ model, presence: 1 }],
            frame: model,
            eye: this.eye,
            half: fittingHalf(model, this.eye, canvas.width, canvas.height),
            zoom: this.zoom,
            shift: [0, 0],
            light: this.light,
            isDark: isDark(),
        });
    }
}
