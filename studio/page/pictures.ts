// Pictures of patterns: of pages, of the whole view of the map, and tiles of the endless plane.
import type { Answer, Engine } from "./context";
import { element } from "./elements";
import type { Options, PatternRequest, Pixels } from "./protocol";
import { Recent } from "./recent";
import { tileName, tileWindow, type Tile, type TileGrid } from "./tiles";

/// Red, green, blue, alpha: 0 to 255.
export type Colour = readonly [number, number, number, number];

export interface Bitmap {
    readonly source: CanvasImageSource;
    readonly width: number;
    readonly height: number;
    readonly bytes: number;
    readonly isEmpty: boolean; // the drawing has no line there
    readonly plain: Colour | null; // the only colour in it
    close(): void;
}

// The colour of a picture that has only one.
function plainOf(values: Uint8ClampedArray): Colour | null {
    for (let at = 4; at < values.length; ++at) if (values[at] !== values[at - 4]) return null;
    return [values[0]!, values[1]!, values[2]!, values[3]!];
}

// The remark is that of the libraries.
function isEmpty({ remarks }: Pixels): boolean {
    return remarks.some(({ text }) => text === "the window contains no part of the drawing");
}

/// The answer to `pixels` as an image.
export function imageOf({ json: { width, height }, bytes }: Answer<Pixels>): ImageData {
    const values = new Uint8ClampedArray(bytes.buffer as ArrayBuffer, bytes.byteOffset, width * height * 4);
    return new ImageData(values, width, height);
}

/// Shows the image in a canvas, which gets its size.
export function putImage(canvas: HTMLCanvasElement, image: ImageData): void {
    canvas.width = image.width;
    canvas.height = image.height;
    canvas.getContext("2d")!.putImageData(image, 0, 0);
}

/// Draws a pattern's page into a canvas in the back lane. The canvas gets the page's proportions and at most `size`
/// pixels on each side.
export async function drawInto(
    canvas: HTMLCanvasElement,
    size: number,
    engine: Engine,
    pattern: PatternRequest,
    options: Options,
    key?: string,
): Promise<void> {
    const answer = await engine.request<Pixels>(
        { do: "pixels", width: size, height: size, options, pattern },
        { lane: "back", seconds: 10, ...(key === undefined ? {} : { key }) },
    );
    putImage(canvas, imageOf(answer));
}

function factsOf(json: Pixels, { width, height, data }: ImageData) {
    return { width, height, bytes: data.length, isEmpty: isEmpty(json), plain: plainOf(data) };
}

/// Makes a bitmap from the answer to `pixels`.
async function bitmapOf(answer: Answer<Pixels>): Promise<Bitmap> {
    const image = imageOf(answer);
    const source = await createImageBitmap(image);
    return { source, ...factsOf(answer.json, image), close: () => source.close() };
}

/// The same synchronously, for pictures that are needed at once.
export function bitmapAtOnce(answer: Answer<Pixels>): Bitmap {
    const image = imageOf(answer);
    const source = element("canvas");
    putImage(source, image);
    const close = () => { source.width = source.height = 0; };
    return { source, ...factsOf(answer.json, image), close };
}

/// A colour of CSS as a picture contains it.
export function colourOf(text: string): Colour {
    const canvas = element("canvas", { width: 1, height: 1 });
    const context = canvas.getContext("2d")!;
    context.fillStyle = text === "none" ? "transparent" : text;
    context.fillRect(0, 0, 1, 1);
    const [red = 0, green = 0, blue = 0, alpha = 0] = context.getImageData(0, 0, 1, 1).data;
    return [red, green, blue, alpha];
}

export function isAbort(error: unknown): boolean {
    return error instanceof DOMException && error.name === "AbortError";
}

/// The subject of a tile: a pattern and how it is drawn, with a unique name.
export interface Subject {
    readonly name: string;
    readonly pattern: PatternRequest;
    readonly options: Options;
}

const mostBytes = 64 * 1024 * 1024;
const patience = 400; // milliseconds that a tile may go on for after it has left the view

/// Loads the wanted tiles, those in the middle first, and caches the most recently used.
export class TileLoader {
    readonly cache = new Recent<Bitmap>(mostBytes);
    private readonly running = new Map<string, { stop: AbortController; since: number; subject: string }>();
    private readonly failed = new Set<string>();
    private readonly scales = new Map<string, Map<number, number>>(); // by subject, with times of use
    private wanted: { subject: Subject; tiles: Tile[]; grid: TileGrid; ratio: number } | null = null;
    private count = 0;

    constructor(
        private readonly engine: Engine,
        private readonly onTile: () => void,
    ) {}

    /// The cached picture of a tile, if any.
    picture(subject: string, tile: Tile): Bitmap | undefined {
        return this.cache.get(`${subject} ${tileName(tile)}`);
    }

    /// Scales of the subject's tiles that may be cached.
    scalesOf(subject: string): number[] {
        return [...(this.scales.get(subject)?.keys() ?? [])];
    }

    /// Sets the wanted tiles; null: none.
    want(subject: Subject | null, tiles: Tile[] = [], grid: TileGrid = { side: 0, css: 0 }, ratio = 1): void {
        this.wanted = subject ? { subject, tiles, grid, ratio } : null;
        const names = new Set(subject ? tiles.map((tile) => `${subject.name} ${tileName(tile)}`) : []);
        const now = performance.now();
        for (const [name, { stop, since, subject: whose }] of this.running) {
            if (!names.has(name) && (whose !== subject?.name || now - since > patience)) stop.abort();
        }
        this.next();
    }

    private next(): void {
        const wanted = this.wanted;
        if (!wanted) return;
        const most = Math.max(1, this.engine.workers - 1);
        for (const tile of wanted.tiles) {
            if (this.running.size >= most) return;
            const name = `${wanted.subject.name} ${tileName(tile)}`;
            if (this.running.has(name) || this.failed.has(name) || this.cache.has(name)) continue;
            void this.load(name, tile, wanted);
        }
    }

    private async load(name: string, tile: Tile, wanted: NonNullable<TileLoader["wanted"]>): Promise<void> {
        const stop = new AbortController();
        const { subject, grid, ratio } = wanted;
        this.running.set(name, { stop, since: performance.now(), subject: subject.name });
        try {
            const answer = await this.engine.request<Pixels>(
                {
                    do: "pixels",
                    width: grid.side,
                    height: grid.side,
                    window: tileWindow(tile, grid),
                    ratio,
                    options: subject.options,
                    pattern: subject.pattern,
                },
                { lane: "back", signal: stop.signal, seconds: 10 },
            );
            this.cache.add(name, await bitmapOf(answer));
            this.note(subject.name, tile.scale);
            this.onTile();
        } catch (error) {
            if (!isAbort(error)) this.failed.add(name);
        } finally {
            this.running.delete(name);
            this.next();
        }
    }

    // Drops scales not used for long, whose tiles have left the cache or will.
    private note(subject: string, scale: number): void {
        let scales = this.scales.get(subject);
        if (!scales) this.scales.set(subject, (scales = new Map()));
        scales.set(scale, ++this.count);
        if (scales.size > 80) {
            const oldest = [...scales].sort(([, one], [, other]) => one - other)[0];
            if (oldest) scales.delete(oldest[0]);
        }
        if (this.scales.size > 40) this.scales.delete([...this.scales.keys()][0]!);
    }
}
