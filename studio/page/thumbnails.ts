// Small pictures of patterns, drawn in the back lane.
import type { Engine } from "./context";
import type { Options, PatternRequest, Pixels } from "./protocol";

/// Draws the page of a pattern to fit a canvas; false if the request was cancelled.
export async function drawInto(
    canvas: HTMLCanvasElement,
    engine: Engine,
    pattern: PatternRequest,
    options: Options,
    request: { key?: string; signal?: AbortSignal } = {},
): Promise<boolean> {
    const { json, bytes } = await engine.request<Pixels>(
        { do: "pixels", width: canvas.width, height: canvas.height, options, pattern },
        { lane: "back", seconds: 10, ...request },
    );
    canvas.width = json.width;
    canvas.height = json.height;
    const pixels = new ImageData(
        new Uint8ClampedArray(bytes.buffer as ArrayBuffer, bytes.byteOffset, bytes.length),
        json.width,
        json.height,
    );
    canvas.getContext("2d")!.putImageData(pixels, 0, 0);
    return true;
}
