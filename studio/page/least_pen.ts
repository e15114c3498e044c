// Pens of small pictures: a width in turtle steps vanishes where the drawing has many steps.
import { joinedStroke, splitStroke } from "./stroke";

/// The stroke of a drawing that is fitted into a square, if its pen would be thinner than `least`; else null.
/// @param box  of the drawing in turtle steps: x0, y0, x1, y1
/// @param room  side of the square in millimetres, without its margins
/// @param least  millimetres
export function leastStroke(stroke: string, box: readonly number[], room: number, least: number): string | null {
    const { width, unit, rest } = splitStroke(stroke);
    const [x0 = 0, y0 = 0, x1 = 0, y1 = 0] = box;
    const extent = Math.max(x1 - x0, y1 - y0);
    if (unit !== "step" || width === "" || !(extent > 0)) return null;
    const wide = (Number(width) * room) / extent;
    return wide < least ? joinedStroke(String(least), "mm", rest) : null;
}
