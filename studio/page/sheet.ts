// The page of a print, as set by its options, and the position of the drawing on it.
import { hasScope } from "./option_scopes";
import { optionOf } from "./options";
import type { Help, Opened, Options } from "./protocol";
import type { Camera, Size } from "./camera";
import { exactOf, numberOf, readExact } from "./decimal";

/// In millimetres.
export interface Sheet {
    readonly width: number;
    readonly height: number;
    readonly margin: number;
    readonly name: string;
}

const joined = (name: string): string => name.trim().toLowerCase().replaceAll(/[\s_-]/g, "");
const millimetres: Readonly<Record<string, number>> = { mm: 1, cm: 10, in: 25.4, pt: 25.4 / 72, px: 25.4 / 300 };

/// Reads a length such as `12mm`; `unit` is the default unit.
export function lengthOf(text: string, unit = "mm"): number | null {
    const match = /^\s*(\d*\.?\d+)\s*(mm|cm|in|pt|px)?\s*$/i.exec(text);
    const factor = millimetres[(match?.[2] ?? unit).toLowerCase()];
    return match && factor !== undefined ? Number(match[1]) * factor : null;
}

function sizeOf(text: string): [number, number] | null {
    const clean = text.trim().toLowerCase().replaceAll("×", "x");
    const match = /^([\d.]+)\s*(mm|cm|in|pt|px)?\s*x\s*([\d.]+)\s*(mm|cm|in|pt|px)?$/.exec(clean);
    if (!match) return null;
    const unit = match[4] ?? match[2] ?? "mm";
    const width = lengthOf(match[1] ?? "", match[2] ?? unit);
    const height = lengthOf(match[3] ?? "", unit);
    return width && height ? [width, height] : null;
}

/// The page that the options set: by default A4 with a margin of 10 mm.
export function sheetOf({ sizes }: Pick<Help, "sizes">, options: Options): Sheet {
    const text = optionOf(options, "size") ?? "A4";
    const named = sizes[joined(text)];
    const size = named ?? sizeOf(text) ?? [210, 297];
    const isLandscape = optionOf(options, "landscape") !== undefined && size[0] < size[1];
    const [width, height] = isLandscape ? [size[1], size[0]] : size;
    const margin = lengthOf(optionOf(options, "margin") ?? "10mm") ?? 10;
    const letters = named ? text.trim().replace(/^[a-c](?=\d)/, (letter) => letter.toUpperCase()) : "";
    const measures = `${round(width)} × ${round(height)} mm`;
    return { width, height, margin, name: letters ? `${letters}, ${measures}` : measures };
}

function round(value: number): number {
    return Math.round(value * 10) / 10;
}

/// The position of the page in a view, in CSS pixels.
export interface Laid {
    readonly left: number;
    readonly top: number;
    readonly width: number;
    readonly height: number;
}

export function laidOut(sheet: Sheet, size: Size): Laid {
    const narrow = Math.min(size.width, size.height) < 480;
    const around = narrow ? 16 : 40;
    const beside = narrow ? 16 : 62; // space for the buttons
    const below = narrow ? 48 : 64; // space for the text below the page
    const right = narrow ? 60 : beside;
    const room = {
        width: Math.max(40, size.width - beside - right),
        height: Math.max(40, size.height - around - below),
    };
    const factor = Math.min(room.width / sheet.width, room.height / sheet.height);
    const width = sheet.width * factor;
    const height = sheet.height * factor;
    // Centred, unless the buttons would cover it.
    const left = Math.min((size.width - width) / 2, size.width - right - width);
    return { left, top: around + (room.height - height) / 2, width, height };
}

/// The value of a style key: from an option, or else from the pattern.
export function styleOf(name: string, facts: Opened, options: Options): string | undefined {
    return optionOf(options, name) ?? facts.keys.find((key) => key.name === name)?.value;
}

const borderShare = 1.6 / 24; // share of the shorter side that a border takes beyond the margin

/// The camera that shows the endless plane exactly as the page shows the drawing; null if there is none: for drawings
/// in space, rotated drawings, and several drawings on a page.
export function cameraOfSheet(
    sheet: Sheet,
    laid: Laid,
    size: Size,
    facts: Opened,
    help: Help,
    options: Options,
): Camera | null {
    if (hasScope(help, options, "turn") || optionOf(options, "generations") !== undefined) return null;
    if (!facts.extent || facts.is_spatial) return null;
    const [x0, y0, x1, y1] = facts.extent.map(readExact);
    if (x0 == null || y0 == null || x1 == null || y1 == null) return null;
    const across = numberOf(x1 - x0);
    const up = numberOf(y1 - y0);
    if (!(across > 0 || up > 0) || !Number.isFinite(across + up)) return null;
    const pen = /^\s*([\d.]+)\s*(step|mm|cm|in|pt|px)?/i.exec(styleOf("stroke", facts, options) ?? "0.4mm");
    const width = pen ? Number(pen[1]) : 0;
    const isInSteps = pen?.[2]?.toLowerCase() === "step";
    const inSteps = isInSteps ? width : 0;
    const inMillimetres = isInSteps ? 0 : (lengthOf(`${width}${pen?.[2] ?? "mm"}`) ?? 0);
    const share = Number.parseFloat(facts.keys.find((key) => key.name === "scale factor")?.value ?? "100") / 100;
    const fixed = optionOf(options, "step");
    const border = optionOf(options, "border") === undefined ? 0 : Math.min(sheet.width, sheet.height) * borderShare;
    const fit = (room: number, extent: number) =>
        (room - 2 * (sheet.margin + border) - inMillimetres) / (extent + inSteps);
    const step =
        fixed !== undefined ? lengthOf(fixed) : Math.min(fit(sheet.width, across), fit(sheet.height, up)) * share;
    if (!step || !(step > 0)) return null;
    const scale = sheet.width / laid.width / step;
    const right = laid.left + laid.width / 2 - size.width / 2;
    const down = laid.top + laid.height / 2 - size.height / 2;
    return { x: (x0 + x1) / 2n - exactOf(right * scale), y: (y0 + y1) / 2n + exactOf(down * scale), scale };
}

/// True if any part of the drawing requires the whole drawing to be read.
export function isComposed(facts: Opened, options: Options): boolean {
    return (
        optionOf(options, "dots") !== undefined ||
        optionOf(options, "colour-by") !== undefined ||
        facts.keys.some((key) => key.name === "dots" && key.value !== "none")
    );
}
