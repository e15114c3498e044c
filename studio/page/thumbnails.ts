// Small pictures of patterns, drawn in the back lane.
import type { Engine } from "./context";
import type { Options, PatternRequest, Pixels } from "./protocol";

/// Draws a pattern's page into a canvas, which gets the page's proportions and at most `size` pixels on each side.
export async function drawInto(
    canvas: HTMLCanvasElement,
    size: number,
    engine: Engine,
    pattern: PatternRequest,
    options: Options,
    key?: string,
): Promise<void> {
    const { json, bytes } = await engine.request<Pixels>(
        { do: "pixels", width: size, height: size, options, pattern },
        { lane: "back", seconds: 10, ...(key === undefined ? {} : { key }) },
    );
    canvas.width = json.width;
    canvas.height = json.height;
    const pixels = new ImageData(
        new Uint8ClampedArray(bytes.buffer as ArrayBuffer, bytes.byteOffset, bytes.length),
        json.width,
        json.height,
    );
    canvas.getContext("2d")!.putImageData(pixels, 0, 0);
}
