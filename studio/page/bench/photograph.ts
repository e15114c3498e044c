// Photographs of kolams: the page decodes them, the libraries read the kolam, and the board shows the photograph,
// straightened, under its lines. It stays in memory until another one is read or the page is closed.
import { messageOf, type Studio } from "../context";
import { element } from "../elements";
import { counted, sentence } from "../numbers_shown";
import { openPattern } from "../opening";
import type { ReadPhotograph } from "../protocol";
import type { DotGrid, Place } from "./dot_grid";
import { first_look, readKolam, withLook } from "./kolam_text";
import { PhotographDots } from "./photograph_dots";

/// The layers that the board shows.
export interface Underlay {
    picture: CanvasImageSource;
    box: [x0: number, y0: number, x1: number, y1: number]; // half spacings, y up
    shift: { x: number; y: number }; // of the box, because the middle of the grid has moved
    missing: Place[]; // places that may have a dot
    hasLines: boolean; // the lines of the kolam are drawn over it
}

export type View = "photograph" | "both" | "kolam";

const longest_side = 4000; // pixels that are read; the bytes of larger pictures would exceed the limit of a request

export class Photograph {
    readonly dots: PhotographDots;
    private readonly veiled: HTMLCanvasElement; // the picture below lines
    view: View = "both";

    /// `text`: of the pattern that was read.
    constructor(
        readonly file: File,
        readonly part: number,
        readonly found: ReadPhotograph,
        private readonly picture: HTMLCanvasElement,
        text: string,
    ) {
        this.veiled = veiled(picture);
        this.dots = new PhotographDots(text);
    }

    underlay({ rise, dots }: DotGrid): Underlay | null {
        const { shift } = this.dots;
        if (!shift || this.view === "kolam") return null;
        const missing = [...this.found.missing, ...this.found.open_ends]
            .map(([x, level]) => ({ x: x + shift.x, level: level + shift.level }))
            .filter(({ x, level }) => !dots.some((dot) => dot.x === x && dot.level === level));
        return {
            picture: this.view === "both" ? this.veiled : this.picture,
            box: this.found.picture.box,
            shift: { x: shift.x, y: shift.level * rise },
            missing,
            hasLines: this.view === "both",
        };
    }
}

/// The photograph that was read last.
let latest: Photograph | null = null;
export const latestPhotograph = (): Photograph | null => latest;
export function forgetPhotograph(): void {
    latest = null;
}

/// Pictures that browsers may decode.
export const isPicture = (file: File): boolean =>
    /^image\/(?!svg)/.test(file.type) || /\.(jpe?g|png|webp|avif|gif|bmp|heic|heif|tiff?)$/i.test(file.name);

/// The pixels of a picture, upright, and reduced if it is large.
async function pixelsOf(file: File): Promise<ImageData> {
    const bitmap = await createImageBitmap(file).catch(() => {
        throw new Error("this browser cannot decode it; expected a JPEG, PNG or WebP picture");
    });
    const factor = Math.min(1, longest_side / Math.max(bitmap.width, bitmap.height));
    const [width, height] = [bitmap.width, bitmap.height].map((side) => Math.max(1, Math.round(side * factor)));
    const context = element("canvas", { width, height }).getContext("2d", { willReadFrequently: true })!;
    context.imageSmoothingQuality = "high";
    context.drawImage(bitmap, 0, 0, width, height);
    bitmap.close();
    return context.getImageData(0, 0, width, height);
}

function canvasOf(bytes: Uint8Array, { width, height }: ReadPhotograph["picture"]): HTMLCanvasElement {
    const canvas = element("canvas", { width, height });
    const image = canvas.getContext("2d")!.createImageData(width, height);
    image.data.set(bytes);
    canvas.getContext("2d")!.putImageData(image, 0, 0);
    return canvas;
}

/// A darker copy of a picture.
function veiled(picture: HTMLCanvasElement): HTMLCanvasElement {
    const { width, height } = picture;
    const canvas = element("canvas", { width, height });
    const context = canvas.getContext("2d")!;
    context.drawImage(picture, 0, 0);
    context.globalCompositeOperation = "source-atop";
    context.fillStyle = "rgb(20 10 6 / 26%)";
    context.fillRect(0, 0, width, height);
    return canvas;
}

export interface Reading {
    part?: number; // which of several kolams
    grid?: string; // the dots that the kolam has
    fixes?: string[];
}

export async function requestReading(
    { engine }: Studio,
    file: File,
    { part = 1, ...more }: Reading,
): Promise<{ found: ReadPhotograph; picture: HTMLCanvasElement }> {
    const { data, width, height } = await pixelsOf(file);
    const { json, bytes } = await engine.request<ReadPhotograph>(
        { do: "read", width, height, source: file.name, part: String(part), ...more },
        { bytes: new Uint8Array(data.buffer), key: "photograph", seconds: 60 },
    );
    return { found: json, picture: canvasOf(bytes, json.picture) };
}

/// Reads the kolam of a photograph, and opens it on the bench. False if there is none, with a message.
export async function readPhotograph(studio: Studio, file: File, reading: Reading = {}): Promise<boolean> {
    studio.say(`Reading ${file.name}…`);
    try {
        const { found, picture } = await requestReading(studio, file, reading);
        const name = `${file.name.replace(/\.\w+$/, "")}.lsys`;
        const text = withLook(found.text, first_look);
        latest = new Photograph(file, reading.part ?? 1, found, picture, text);
        // If the pattern is open already, the bench is not told.
        if (studio.store.work.pattern.text === text) latest.dots.show(studio.store.work.pattern, false);
        openPattern(studio, { name, text }, readKolam(text) ? "bench" : "map"); // the bench takes up to 1000 gaps
        const doubts = found.doubtful.length;
        const doubtful = doubts === 0 ? "no gap is doubtful" : `${counted(doubts, "gap")} ${doubts === 1 ? "is" : "are"} doubtful`;
        studio.say(`${file.name}: ${found.summary}; ${doubtful}.`, doubts > 0 ? "warning" : "fact");
        return true;
    } catch (error) {
        if (error instanceof DOMException && error.name === "AbortError") return false;
        studio.say(`${file.name}: ${sentence(messageOf(error))}`, "error");
        return false;
    }
}
