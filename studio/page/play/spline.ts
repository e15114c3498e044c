// Shows the curves of splines in the view of the curve, as Picture does.
import type { Studio, Work } from "../context";
import type { Lines } from "../protocol";
import { styleOf } from "../sheet";
import type { Melody } from "../sound/melody";
import type { CurveView } from "./curve_view";
import { NoteCurves } from "./note_curves";

const patience = 5; // seconds

/// Replaces the control polygon of a melody's pattern with its curve, once it is known, while `isShown`.
export async function showSpline(
    studio: Studio,
    view: CurveView,
    melody: Melody,
    { pattern, draw, arrangement }: Work,
    isShown = () => true,
): Promise<void> {
    const facts = studio.opened?.facts;
    if (arrangement || !facts || !styleOf("line", facts, draw)?.startsWith("spline")) return;
    try {
        const { json, bytes } = await studio.engine.request<Lines>({ do: "lines", pattern }, { seconds: patience });
        if (isShown()) view.setCurves((before) => NoteCurves.of(json, bytes, melody, before));
    } catch {
        // the control polygon of a long curve stays: its steps are shorter than a pixel
    }
}
