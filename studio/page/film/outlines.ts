// The lines of an SVG as polylines, so that they can be drawn little by little.

/// A line or an area: its points x, y one after the other.
export interface Outline {
    points: Float64Array;
    stroke: string; // a colour; empty: none
    width: number;
    fill: string; // a colour; empty: none
    isRound: boolean; // ends and corners
    length: number;
}

const parts_of_curve = 10;
const most_points = 600_000;

/// Splits the data of a path into polylines. Knows M, L, H, V, C, Q, Z in both cases. @throws Error for others
export function polylinesOf(data: string): number[][] {
    const tokens = data.match(/[a-zA-Z]|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?/g) ?? [];
    const lines: number[][] = [];
    let line: number[] = [];
    let [x, y] = [0, 0];
    let [startX, startY] = [0, 0];
    let command = "";
    let at = 0;
    const number = () => Number(tokens[at++]);
    const begin = () => {
        line = [x, y];
        lines.push(line);
    };
    const go = (toX: number, toY: number) => {
        if (line.length === 0) begin();
        [x, y] = [toX, toY];
        line.push(x, y);
    };
    while (at < tokens.length) {
        if (/[a-zA-Z]/.test(tokens[at]!)) command = tokens[at++]!;
        const [dx, dy] = command === command.toLowerCase() ? [x, y] : [0, 0];
        switch (command.toUpperCase()) {
            case "M":
                [x, y] = [number() + dx, number() + dy];
                [startX, startY] = [x, y];
                begin();
                command = command === "m" ? "l" : "L";
                break;
            case "L":
                go(number() + dx, number() + dy);
                break;
            case "H":
                go(number() + dx, y);
                break;
            case "V":
                go(x, number() + dy);
                break;
            case "C": {
                const [x1, y1, x2, y2, x3, y3] = [number() + dx, number() + dy, number() + dx, number() + dy, number() + dx, number() + dy];
                curve(go, [x, y], [x1, y1], [x2, y2], [x3, y3]);
                break;
            }
            case "Q": {
                const [x1, y1, x3, y3] = [number() + dx, number() + dy, number() + dx, number() + dy];
                const near = (from: number, to: number) => from + (2 / 3) * (to - from);
                curve(go, [x, y], [near(x, x1), near(y, y1)], [near(x3, x1), near(y3, y1)], [x3, y3]);
                break;
            }
            case "Z":
                if (x !== startX || y !== startY) go(startX, startY);
                line = [];
                break;
            default:
                throw new Error(`the path has the command ${command}`);
        }
    }
    return lines;
}

type Point = [number, number];
function curve(go: (x: number, y: number) => void, [x0, y0]: Point, [x1, y1]: Point, [x2, y2]: Point, [x3, y3]: Point): void {
    for (let i = 1; i <= parts_of_curve; ++i) {
        const t = i / parts_of_curve;
        const [a, b, c, d] = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3];
        go(a * x0 + b * x1 + c * x2 + d * x3, a * y0 + b * y1 + c * y2 + d * y3);
    }
}

/// A drawing: its size and what is drawn, in order.
export interface Drawing {
    width: number;
    height: number;
    ground: string;
    outlines: Outline[];
    length: number; // of all
}

/// Reads an SVG that the libraries made. @throws Error if it has too many lines, or parts that are not lines
export function readDrawing(svg: string): Drawing {
    const root = new DOMParser().parseFromString(svg, "image/svg+xml").documentElement;
    const [, , width = 1, height = 1] = (root.getAttribute("viewBox") ?? "").split(/[\s,]+/).map(Number);
    const drawing: Drawing = { width, height, ground: "", outlines: [], length: 0 };
    let points = 0;
    for (const shape of root.querySelectorAll("path, rect, circle, image")) {
        if (shape.closest("defs, clipPath, mask")) continue;
        if (shape.tagName === "rect") {
            drawing.ground ||= inherited(shape, "fill");
            continue;
        }
        if (shape.tagName === "image") throw new Error("this drawing is a picture, not lines");
        const { scale, left, top } = placeOf(shape);
        const stroke = colour(inherited(shape, "stroke"));
        const fill = colour(inherited(shape, "fill") || "#000");
        const looks = {
            stroke,
            fill,
            width: Number(inherited(shape, "stroke-width") || 1) * scale,
            isRound: inherited(shape, "stroke-linejoin") === "round",
        };
        const lines = shape.tagName === "circle" ? [circle(shape)] : polylinesOf(shape.getAttribute("d") ?? "");
        if (fill !== "" && lines.length > 1) throw new Error("the drawing has areas with holes");
        for (const line of lines) {
            points += line.length / 2;
            if (points > most_points) throw new Error("the drawing has too many lines for a film of the line");
            const placed = Float64Array.from(line, (value, at) => value * scale + (at % 2 === 0 ? left : top));
            const length = lengthOf(placed);
            drawing.length += length;
            drawing.outlines.push({ ...looks, points: placed, length });
        }
    }
    return drawing;
}

const colour = (text: string) => (text === "none" ? "" : text);

function inherited(shape: Element, name: string): string {
    return shape.closest(`[${name}]`)?.getAttribute(name) ?? "";
}

// Scale and offset of all groups around a shape. @throws Error for rotations
function placeOf(shape: Element): { scale: number; left: number; top: number } {
    let [scale, left, top] = [1, 0, 0];
    for (let each: Element | null = shape; each; each = each.parentElement) {
        for (const [, name, values] of [...(each.getAttribute("transform") ?? "").matchAll(/(\w+)\(([^)]*)\)/g)].reverse()) {
            const [a = 0, b = 0] = values!.split(/[\s,]+/).map(Number);
            if (name === "scale") [scale, left, top] = [scale * a, left * a, top * a];
            else if (name === "translate") [left, top] = [left + a, top + b];
            else throw new Error(`the drawing is placed by ${name}`);
        }
    }
    return { scale, left, top };
}

function circle(shape: Element): number[] {
    const [x, y, radius] = ["cx", "cy", "r"].map((name) => Number(shape.getAttribute(name) ?? 0)) as [number, number, number];
    return Array.from({ length: 33 }, (_, i) => [
        x + radius * Math.cos((Math.PI * i) / 16), y + radius * Math.sin((Math.PI * i) / 16),
    ]).flat();
}

function lengthOf(points: Float64Array): number {
    let sum = 0;
    for (let at = 2; at < points.length; at += 2) {
        sum += Math.hypot(points[at]! - points[at - 2]!, points[at + 1]! - points[at - 1]!);
    }
    return sum;
}

/// Draws a drawing little by little: each call goes on where the last one ended.
export class Pen {
    private outline = 0;
    private point = 0; // of the outline, in pairs
    private into = 0; // length of the piece after that point that is drawn already
    private drawn = 0;

    constructor(
        private readonly context: CanvasRenderingContext2D,
        private readonly drawing: Drawing,
        private readonly scale: number, // pixels per unit
    ) {
        context.fillStyle = "#fff";
        context.fillRect(0, 0, context.canvas.width, context.canvas.height);
        context.fillStyle = drawing.ground || "#fff";
        context.fillRect(0, 0, context.canvas.width, context.canvas.height);
    }

    /// Draws up to a share of the whole length, from 0 to 1.
    drawTo(share: number): void {
        const { drawing } = this;
        const target = share >= 1 ? Infinity : share * drawing.length;
        while (this.outline < drawing.outlines.length && this.drawn < target) {
            if (!this.drawOn(drawing.outlines[this.outline]!, target)) return;
            ++this.outline;
            this.point = this.into = 0;
        }
    }

    // True if the outline is complete.
    private drawOn({ points, stroke, width, fill, isRound }: Outline, target: number): boolean {
        const { context, scale } = this;
        context.lineWidth = width * scale;
        context.lineCap = isRound ? "round" : "butt";
        context.lineJoin = isRound ? "round" : "miter";
        context.strokeStyle = stroke || fill;
        const isArea = fill !== "";
        if (!isArea) context.beginPath();
        const place = (at: number, share: number): [number, number] => {
            const next = Math.min(2 * at + 2, points.length - 2);
            const [x, y] = [points[2 * at]!, points[2 * at + 1]!];
            return [scale * (x + share * (points[next]! - x)), scale * (y + share * (points[next + 1]! - y))];
        };
        let isComplete = true;
        let isFirst = true;
        for (; 2 * this.point + 2 < points.length; ++this.point) {
            const at = 2 * this.point;
            const length = Math.hypot(points[at + 2]! - points[at]!, points[at + 3]! - points[at + 1]!);
            if (isFirst && !isArea) context.moveTo(...place(this.point, length > 0 ? this.into / length : 0));
            isFirst = false;
            const left = length - this.into;
            if (this.drawn + left > target) {
                const step = target - this.drawn;
                this.into += step;
                this.drawn = target;
                if (!isArea) context.lineTo(...place(this.point, this.into / length));
                isComplete = false;
                break;
            }
            this.drawn += left;
            this.into = 0;
            if (!isArea) context.lineTo(...place(this.point + 1, 0));
        }
        if (!isArea) context.stroke();
        else if (isComplete) this.fillArea(points, stroke, fill);
        return isComplete;
    }

    private fillArea(points: Float64Array, stroke: string, fill: string): void {
        const { context, scale } = this;
        context.beginPath();
        for (let at = 0; at < points.length; at += 2) context.lineTo(scale * points[at]!, scale * points[at + 1]!);
        context.closePath();
        context.fillStyle = fill;
        context.fill();
        if (stroke) context.stroke();
    }
}
