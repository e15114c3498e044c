// Small pictures of patterns, drawn in the back lane.
import type { Engine } from "./context";
import { imageOf, putImage } from "./pictures";
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
    const answer = await engine.request<Pixels>(
        { do: "pixels", width: size, height: size, options, pattern },
        { lane: "back", seconds: 10, ...(key === undefined ? {} : { key }) },
    );
    putImage(canvas, imageOf(answer));
}
