// The board: rice powder on red earth or another ground, or on a photograph. The gap under the pointer previews the
// effect of a click; while dots are edited, rings show where dots can be placed.
import { element } from "../elements";
import { Surface } from "../play/surface";
import { makeChance } from "../sound/chance";
import type { DotGrid, Place } from "./dot_grid";
import { crossedCells, followLines } from "./dot_grid";
import { type GroundLook, type GroundName, grounds } from "./grounds";
import type { Look } from "./kolam_text";
import type { Underlay } from "./photograph";
import { roundedStrands } from "./rounded_lines";
import { traceSegments, traceStrand } from "./strand_path";

/// After the ink of the ground.
const line_colours = ["#f2b632", "#7fc8a9", "#e77f67", "#8fb8de", "#d6a2e8", "#c5d86d", "#f7b2ad"];
/// As in the pattern: 0.16 of a step, which is the diagonal of a unit square, or half a spacing of interlaced dots.
const lineWidth = ({ isTriangular }: DotGrid): number => 0.16 * (isTriangular ? 1 : Math.SQRT2);
const margin = 1.55; // around the outermost dots
const rim_margin = 2.4; // with a shaped rim
const side_margin = 14; // pixels that stay free on the left and on the right
const bar_height = 46; // pixels that stay free above and below, for tools and texts

export interface Scene {
    grid: DotGrid;
    states: Uint8Array;
    strands: number[][]; // control points of the lines
    lineOrbits: number[]; // lines with the same number have the same colour
    look: Look;
    doubts: ReadonlySet<number>; // gaps
    underlay: Underlay | null; // the photograph
    cursor: number; // gap or place selected by pointer or keyboard, -1: none
    orbit: number[]; // gaps that change with it
    after: Uint8Array | null; // the states after the change, if it is previewed
    places: Place[] | null; // while dots are edited: where they can be
    isFocused: boolean; // the gap was selected by keyboard
}

/// The places of the lattice in the grid's box and around it, from the top, where dots can be added or removed.
export function placesAround({ dots, isTriangular }: DotGrid): Place[] {
    if (dots.length === 0) return [];
    const extreme = (value: (dot: Place) => number): [number, number] =>
        dots.reduce(([low, high], dot) => [Math.min(low, value(dot)), Math.max(high, value(dot))], [Infinity, -Infinity]);
    const [left, right] = extreme((dot) => dot.x);
    const [bottom, top] = extreme((dot) => dot.level);
    const [{ x: first, level }] = dots;
    const places: Place[] = [];
    for (let row = top + 2; row >= bottom - 2; row -= 2) {
        const shift = isTriangular ? (row - level) / 2 : 0;
        const isOff = (left - first - shift) % 2 !== 0;
        for (let x = isOff ? left - 1 : left - 2; x <= right + 2; x += 2) places.push({ x, level: row });
    }
    return places;
}

export class Board {
    private readonly surface: Surface;
    private scale = 1; // pixels per unit, which is half the dot spacing
    private readonly powders = new Map<string, HTMLCanvasElement>(); // by colour
    private ground: { name: GroundName; canvas: HTMLCanvasElement } | null = null;
    private still: CanvasRenderingContext2D; // all but the preview
    private shown: unknown[] = []; // what `still` shows

    constructor(canvas: HTMLCanvasElement, redraw: () => void) {
        const resized = () => {
            this.renew();
            redraw();
        };
        this.surface = new Surface(canvas, resized, 2);
        this.still = this.surface.layer();
    }

    // The size has changed.
    private renew(): void {
        this.still = this.surface.layer();
        this.ground = null;
        this.shown = [];
    }

    private place({ grid, look, places }: Scene): void {
        const around = (places ? 1.2 : 0) + (look.rim === "round" ? margin : rim_margin);
        const across = grid.dots.reduce((most, { x }) => Math.max(most, Math.abs(x)), 0) + around;
        const up = (grid.rows.length - 1) * grid.rise + around;
        const { width, height } = this.surface;
        this.scale = Math.min((width - 2 * side_margin) / (2 * across), (height - 2 * bar_height) / (2 * up), 56);
    }

    /// The gap nearest to a point of the canvas, or the place for a dot; -1 outside the grid.
    targetAt(scene: Scene, x: number, y: number): number {
        this.place(scene);
        const px = (x - this.surface.width / 2) / this.scale;
        const py = (this.surface.height / 2 - y) / this.scale;
        const { grid, places } = scene;
        let nearest = 1;
        let found = -1;
        const look = (across: number, up: number, index: number): void => {
            const straight = Math.hypot(across, up);
            // In the square lattice the fields of gaps are squares on their corners.
            const distance = grid.isTriangular ? straight : 0.5 * (Math.max(Math.abs(across), Math.abs(up)) + straight);
            if (distance >= nearest) return;
            nearest = distance;
            found = index;
        };
        if (places) places.forEach((place, i) => look(place.x - px, place.level * grid.rise - py, i));
        else grid.gaps.forEach((gap, i) => look(gap.x - px, gap.y - py, i));
        return found;
    }

    private toScene(context: CanvasRenderingContext2D): void {
        const { width, height, ratio } = this.surface;
        const s = this.scale * ratio;
        context.setTransform(s, 0, 0, -s, (width * ratio) / 2, (height * ratio) / 2);
    }

    draw(scene: Scene): void {
        if (this.surface.fit()) this.renew();
        this.place(scene);
        const shown = [scene.strands, ...Object.values(scene.look), scene.places, scene.doubts, scene.underlay];
        if (shown.some((each, i) => each !== this.shown[i])) this.drawStill(scene);
        this.shown = shown;
        const { context } = this.surface;
        context.setTransform(1, 0, 0, 1, 0, 0);
        context.drawImage(this.still.canvas, 0, 0);
        this.toScene(context);
        if (scene.cursor < 0) return;
        if (scene.places) this.drawPlace(context, scene, scene.places[scene.cursor]);
        else this.drawGap(context, scene);
    }

    private drawStill(scene: Scene): void {
        const { still } = this;
        const { look, places, underlay } = scene;
        if (this.ground?.name !== look.ground) this.ground = { name: look.ground, canvas: this.makeGround(look.ground) };
        still.setTransform(1, 0, 0, 1, 0, 0);
        still.drawImage(this.ground.canvas, 0, 0);
        this.toScene(still);
        if (underlay) drawUnderlay(still, underlay);
        if (look.isFilled && !underlay) this.drawFields(still, scene);
        if (places) this.drawPlaces(still, scene);
        if (places || (look.hasDots && !underlay)) this.drawDots(still, scene);
        still.globalAlpha = places ? 0.36 : 1; // while dots are edited
        if (!underlay) this.drawLines(still, scene);
        else if (underlay.hasLines) this.traceLines(still, scene);
        still.globalAlpha = 1;
        if (!places) this.drawDoubts(still, scene);
        if (underlay) this.drawMissing(still, scene, underlay);
    }

    /// Earth or another ground: uneven, darker towards the edges. Paper is plain.
    private makeGround(name: GroundName): HTMLCanvasElement {
        const { width, height } = this.surface.canvas;
        const canvas = element("canvas", { width, height });
        const context = canvas.getContext("2d")!;
        const { colour, grain, tone } = grounds[name];
        context.fillStyle = colour;
        context.fillRect(0, 0, width, height);
        if (grain === 0) return canvas;
        const reach = Math.hypot(width, height) * 0.6;
        const light = context.createRadialGradient(width * 0.42, height * 0.36, 0, width / 2, height / 2, reach);
        light.addColorStop(0, `rgb(${tone.join(" ")} / 17%)`);
        light.addColorStop(0.55, `rgb(${tone.join(" ")} / 0%)`);
        light.addColorStop(1, "rgb(30 12 8 / 42%)");
        context.fillStyle = light;
        context.fillRect(0, 0, width, height);
        context.fillStyle = context.createPattern(grainTile(7, 26 * grain, 34 * grain, tone), "repeat")!;
        context.fillRect(0, 0, width, height);
        return canvas;
    }

    /// Dashed rings around gaps that the photograph does not show clearly.
    private drawDoubts(context: CanvasRenderingContext2D, { grid, doubts }: Scene): void {
        for (const gap of doubts) {
            const { x, y } = grid.gaps[gap];
            drawDashedRing(context, x, y, grid.isTriangular ? 0.52 : 0.74, "#ffb02e");
        }
    }

    /// Rings where a dot may be that was not seen.
    private drawMissing(context: CanvasRenderingContext2D, { grid }: Scene, { missing }: Underlay): void {
        for (const { x, level } of missing) drawDashedRing(context, x, level * grid.rise, 0.3, "#ff6a5c");
    }

    /// Thin lines, which can be told from those of a photograph.
    private traceLines(context: CanvasRenderingContext2D, scene: Scene): void {
        const width = lineWidth(scene.grid);
        context.lineJoin = "round";
        for (const [share, colour] of [[0.62, "rgb(6 30 40 / 70%)"], [0.36, "#37e0e6"]] as const) {
            context.lineWidth = width * share;
            context.strokeStyle = colour;
            for (const path of this.paths(scene)) context.stroke(path);
        }
    }

    private drawFields(context: CanvasRenderingContext2D, { strands }: Scene): void {
        context.beginPath();
        for (const strand of strands) traceStrand(context, strand);
        context.fillStyle = "rgb(246 190 120 / 30%)";
        context.fill("evenodd");
    }

    /// Rings where dots can be placed.
    private drawPlaces(context: CanvasRenderingContext2D, { grid, look, places }: Scene): void {
        context.strokeStyle = look.ground === "white" ? "rgb(125 51 36 / 50%)" : "rgb(253 243 226 / 42%)";
        context.lineWidth = 0.05;
        context.beginPath();
        for (const { x, level } of places!) {
            const y = level * grid.rise;
            context.moveTo(x + 0.16, y);
            context.arc(x, y, 0.16, 0, 2 * Math.PI);
        }
        context.stroke();
    }

    private drawPlace(context: CanvasRenderingContext2D, { grid, look, isFocused }: Scene, { x, level }: Place): void {
        const y = level * grid.rise;
        context.strokeStyle = grounds[look.ground].mark;
        context.lineWidth = isFocused ? 0.12 : 0.08;
        context.beginPath();
        context.arc(x, y, 0.46, 0, 2 * Math.PI);
        context.stroke();
    }

    private drawDots(context: CanvasRenderingContext2D, { grid, states, look, places }: Scene): void {
        const chance = makeChance(5);
        context.fillStyle = look.ground === "white" ? grounds.white.ink : "#f6ecd9";
        const size = (grid.isTriangular ? 0.8 : 1) * (places ? 1.5 : 1);
        const centres = look.hasCentredDots && !places ? crossedCells(grid, states) : [];
        for (const { x, level } of [...grid.dots, ...centres]) {
            const y = level * grid.rise;
            // Dots look placed by hand: none is perfectly round or exactly in place.
            const radius = size * (0.125 + 0.022 * chance());
            const tilt = Math.PI * chance();
            const dx = 0.022 * (chance() - 0.5);
            const dy = 0.022 * (chance() - 0.5);
            context.beginPath();
            context.ellipse(x + dx, y + dy, radius, radius * (0.86 + 0.1 * chance()), tilt, 0, 2 * Math.PI);
            context.fill();
        }
    }

    private paths({ strands }: Scene): Path2D[] {
        return strands.map((strand) => {
            const path = new Path2D();
            traceStrand(path, strand);
            return path;
        });
    }

    private drawLines(context: CanvasRenderingContext2D, scene: Scene): void {
        const paths = this.paths(scene);
        const line_width = lineWidth(scene.grid);
        context.lineJoin = "round";
        const ground = grounds[scene.look.ground];
        if (ground.grain > 0) {
            // The shadow of the powder on the earth.
            context.save();
            context.translate(0.025, -0.045);
            context.strokeStyle = "rgb(40 10 4 / 34%)";
            context.lineWidth = line_width * 1.1;
            for (const path of paths) context.stroke(path);
            context.restore();
        }
        const colours = scene.look.isColoured ? [ground.ink, ...line_colours] : [ground.ink];
        const scale = 1 / (this.scale * this.surface.ratio);
        paths.forEach((path, index) => {
            const powder = context.createPattern(this.powder(colours[scene.lineOrbits[index] % colours.length]), "repeat")!;
            powder.setTransform(new DOMMatrix([scale, 0, 0, scale, 0, 0]));
            context.strokeStyle = powder;
            context.lineWidth = line_width * 0.96;
            context.stroke(path);
            if (scene.places) return;
            // The amount of powder varies along the line.
            context.lineWidth = line_width * 1.14;
            context.lineCap = "round";
            context.setLineDash([0.5, 1.3, 1.1, 1.6, 0.3, 1.9]);
            context.lineDashOffset = index * 0.7;
            context.stroke(path);
            context.setLineDash([]);
        });
    }

    private powder(colour: string): HTMLCanvasElement {
        let made = this.powders.get(colour);
        if (!made) this.powders.set(colour, (made = powderTile(colour)));
        return made;
    }

    private drawGap(context: CanvasRenderingContext2D, scene: Scene): void {
        const { grid, cursor } = scene;
        if (scene.after) this.drawPreview(context, scene, scene.after);
        if (!scene.isFocused) return;
        const { x, y } = grid.gaps[cursor];
        const ring = scene.look.ground === "white" && !scene.underlay ? "#ffffff" : "#ffe9c4";
        for (const [width, colour] of [[0.16, "rgb(40 12 6 / 80%)"], [0.08, ring]] as const) {
            context.lineWidth = width;
            context.strokeStyle = colour;
            context.beginPath();
            context.arc(x, y, grid.isTriangular ? 0.5 : 0.72, 0, 2 * Math.PI);
            context.stroke();
        }
    }

    /// The pieces that a click would draw, on a patch of earth.
    private drawPreview(context: CanvasRenderingContext2D, scene: Scene, after: Uint8Array): void {
        const { grid, cursor, orbit, underlay } = scene;
        const ground = grounds[scene.look.ground];
        const cover = underlay ? 0.6 : 1;
        const line_width = lineWidth(grid);
        const reach = grid.isTriangular ? 0.7 : 0.95;
        const places = new Set(orbit.map((gap) => `${grid.gaps[gap].x} ${grid.gaps[gap].y}`));
        for (const gap of orbit) {
            const { x, y } = grid.gaps[gap];
            const patch = context.createRadialGradient(x, y, 0.2, x, y, reach);
            const colour = patchOf(ground, cover * (gap === cursor ? 94 : 78));
            patch.addColorStop(0, colour);
            patch.addColorStop(0.45, colour);
            patch.addColorStop(1, patchOf(ground, 0));
            context.fillStyle = patch;
            context.beginPath();
            context.arc(x, y, reach, 0, 2 * Math.PI);
            context.fill();
        }
        context.strokeStyle = underlay ? lamp : ground.mark;
        context.lineWidth = line_width * 0.82;
        context.lineCap = "round";
        context.setLineDash([0.02, line_width * 1.3]);
        context.beginPath();
        const lines = followLines(grid, after);
        // Pieces at gaps are the same with every rim.
        roundedStrands(grid, after, lines).forEach((controls, line) => {
            const strand = lines.strands[line];
            for (let i = 0; i < strand.length / 2; ++i) {
                if (places.has(`${strand[2 * i]} ${strand[2 * i + 1]}`)) traceSegments(context, controls, i - 1, 2);
            }
        });
        context.stroke();
        context.setLineDash([]);
    }
}

function tile(size: number, value: (chance: () => number) => [number, number, number, number]): HTMLCanvasElement {
    const canvas = element("canvas", { width: size, height: size });
    const context = canvas.getContext("2d")!;
    const image = context.createImageData(size, size);
    const chance = makeChance(size);
    for (let i = 0; i < image.data.length; i += 4) image.data.set(value(chance), i);
    context.putImageData(image, 0, 0);
    return canvas;
}

const lamp = "#ffd58a";

/// A patch that hides the lines below a preview: the ground in shadow, or paper. @param share  percent
function patchOf({ colour, grain }: GroundLook, share: number): string {
    const shade = grain === 0 ? 1 : 0.78;
    const [r, g, b] = [1, 3, 5].map((at) => Math.round(shade * parseInt(colour.slice(at, at + 2), 16)));
    return `rgb(${r} ${g} ${b} / ${share}%)`;
}

function drawUnderlay(context: CanvasRenderingContext2D, { picture, box, shift }: Underlay): void {
    const [x0, y0, x1, y1] = box;
    context.save();
    context.scale(1, -1); // pictures are upright with y down
    context.imageSmoothingQuality = "high";
    context.drawImage(picture, x0 + shift.x, -(y1 + shift.y), x1 - x0, y1 - y0);
    context.restore();
}

function drawDashedRing(context: CanvasRenderingContext2D, x: number, y: number, radius: number, colour: string): void {
    for (const [width, stroke] of [[0.17, "rgb(40 12 6 / 75%)"], [0.09, colour]] as const) {
        context.lineWidth = width;
        context.strokeStyle = stroke;
        context.setLineDash(width > 0.1 ? [] : [0.24, 0.14]);
        context.beginPath();
        context.arc(x, y, radius, 0, 2 * Math.PI);
        context.stroke();
    }
    context.setLineDash([]);
}

/// Grains of a ground, light and dark.
function grainTile(seed: number, dark: number, light: number, tone: GroundLook["tone"]): HTMLCanvasElement {
    return tile(240 + seed, (chance) => {
        const grain = chance();
        if (grain < 0.5) return [30, 8, 4, dark * chance()];
        return grain > 0.9 ? [...tone, light * chance()] : [0, 0, 0, 0];
    });
}

/// Powder of a colour: soft specks of earth show through it.
function powderTile(colour: string): HTMLCanvasElement {
    const canvas = element("canvas", { width: 256, height: 256 });
    const context = canvas.getContext("2d")!;
    context.fillStyle = colour;
    context.fillRect(0, 0, 256, 256);
    context.globalCompositeOperation = "destination-out";
    const chance = makeChance(211);
    for (let speck = 0; speck < 5200; ++speck) {
        const radius = 0.35 + 0.75 * chance() ** 3;
        context.fillStyle = `rgb(0 0 0 / ${(6 + 26 * chance() ** 2).toFixed(0)}%)`;
        const x = 256 * chance();
        const y = 256 * chance();
        context.beginPath();
        context.arc(x, y, radius, 0, 2 * Math.PI);
        context.fill();
    }
    return canvas;
}
