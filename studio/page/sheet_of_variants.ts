// Finds valid variants and draws thumbnails of them. Variants that fail, draw nothing, cost too much or do not pass the
// filters are left out.
import { hashOf } from "./chance";
import { RequestFailed, type Engine } from "./context";
import { leastStroke } from "./least_pen";
import { optionOf } from "./options";
import { imageOf, isAbort } from "./pictures";
import { thumbnailOptions } from "./option_scopes";
import { valueInText } from "./pattern_text";
import type { Examined, Help, Options, Pixels } from "./protocol";
import type { Variant } from "./variants";

export interface Filter {
    readonly name: string;
    readonly label: string;
    readonly help: string;
    readonly refused: string; // what the variants that it leaves out do
}

export const filters: readonly Filter[] = [
    { name: "closed", label: "Closed", help: "Only closed lines", refused: "have open lines" },
    { name: "single", label: "Single line", help: "Only drawings with a single line", refused: "have several lines" },
    { name: "avoiding", label: "Self-avoiding", help: "Only lines that do not meet themselves", refused: "meet themselves" },
    { name: "kolam", label: "Kolam", help: "Only kolams: all dots surrounded, all lines closed, nothing drawn twice", refused: "are not kolams" },
];

/// A variant that has been found, with its picture as RGBA bytes.
export interface Found {
    readonly index: number;
    readonly variant: Variant;
    readonly picture: ImageData;
}

export interface Search {
    /// The variants to try for an index, of which the first valid one is used; null after the last.
    readonly candidates: (index: number) => readonly Variant[] | null;
    readonly count: number; // number of valid variants wanted
    readonly most: number; // candidates to try
    readonly milliseconds: number; // time limit for trying candidates
    readonly side: number; // pixels
    readonly ratio: number;
    readonly filters: ReadonlySet<string>;
    readonly help: Help;
    readonly draw: Options;
    readonly isDistinct: boolean; // leave out duplicate pictures
    readonly signal: AbortSignal;
    readonly onFound: (found: Found) => void;
    readonly onTried: (tried: number, found: number) => void;
}

// The budget in nodes: a sheet takes about a second.
const page: Options = [["size", "100x100mm"], ["margin", "6mm"], ["budget", "3000000"]];
const room = 88; // millimetres within the margins
const leastPen = 0.7; // millimetres: one pixel of a thumbnail
const seconds = 2;

/// What became of the candidates.
export interface Tally {
    tried: number;
    undrawn: number; // with errors, too large, or without anything to be seen
    repeated: number; // like one before
    refused: Map<string, number>; // by the name of the filter; a variant may be refused by several
}

/// Tries candidates until enough are found or none is left.
export async function searchVariants(engine: Engine, search: Search): Promise<Tally> {
    const options = [...thumbnailOptions(search.help, search.draw), ...page];
    const seen = new Set<string>(); // pictures
    const known = new Set<number>(); // patterns
    const start = performance.now();
    const valid: number[] = []; // indices
    const tally: Tally = { tried: 0, undrawn: 0, repeated: 0, refused: new Map() };
    let next = 0;
    let isOver = false;

    async function tryOne(index: number, lane: "front" | "back"): Promise<void> {
        for (const variant of search.candidates(index) ?? []) {
            if (search.isDistinct) {
                const number = hashOf(JSON.stringify(variant.pattern));
                if (known.has(number)) {
                    ++tally.repeated;
                    continue;
                }
                known.add(number);
            }
            const picture = await drawn(engine, variant, search, options, lane, tally);
            if (search.signal.aborted) return;
            if (!picture) continue;
            const print = search.isDistinct ? fingerprint(picture.data) : "";
            if (search.isDistinct && seen.has(print)) {
                ++tally.repeated;
                continue;
            }
            seen.add(print);
            valid.push(index);
            search.onFound({ index, variant, picture });
            return;
        }
    }
    // One lane per worker; the user waits for the first.
    async function work(lane: "front" | "back"): Promise<void> {
        while (
            !isOver &&
            !search.signal.aborted &&
            valid.length < search.count &&
            next < search.most &&
            performance.now() - start < search.milliseconds
        ) {
            const index = next++;
            if (search.candidates(index) === null) {
                isOver = true;
                return;
            }
            await tryOne(index, lane);
            search.onTried(++tally.tried, valid.length);
        }
    }
    const lanes = Array.from({ length: Math.max(1, engine.workers) }, (_, index) => (index === 0 ? "front" : "back"));
    await Promise.all(lanes.map((lane) => work(lane as "front" | "back")));
    return tally;
}

async function drawn(
    engine: Engine,
    { pattern }: Variant,
    search: Search,
    options: Options,
    lane: "front" | "back",
    tally: Tally,
): Promise<ImageData | null> {
    const settings = { lane, seconds, signal: search.signal };
    try {
        const refused = await refusedBy(engine, pattern, search.filters, settings);
        for (const name of refused) tally.refused.set(name, (tally.refused.get(name) ?? 0) + 1);
        if (refused.length > 0) return null;
        const pen = await seenPen(engine, pattern, search, settings);
        const answer = await engine.request<Pixels>(
            { do: "pixels", width: search.side, height: search.side, ratio: search.ratio, options: [...options, ...pen], pattern },
            settings,
        );
        const image = imageOf(answer);
        if (!isBlank(image.data)) return image;
    } catch (error) {
        if (!isAbort(error) && !(error instanceof RequestFailed)) throw error;
    }
    ++tally.undrawn; // not a valid variant
    return null;
}

// The names of the filters that a pattern does not pass.
async function refusedBy(
    engine: Engine,
    pattern: Variant["pattern"],
    wanted: ReadonlySet<string>,
    settings: Parameters<Engine["request"]>[1],
): Promise<string[]> {
    if (wanted.size === 0) return [];
    if (wanted.has("closed")) {
        // measured without deriving
        const { json } = await engine.request<{ closed: boolean | null }>({ do: "measure", pattern }, settings);
        if (json.closed !== true) return ["closed"];
        if (wanted.size === 1) return [];
    }
    const { json } = await engine.request<Examined>({ do: "kolam", pattern }, settings);
    const passed: Record<string, boolean> = {
        single: json.lines === 1,
        avoiding: json.meetings === 0 && json.reused_edges === 0,
        kolam: json.kolam,
    };
    return [...wanted].filter((name) => passed[name] === false);
}

// A wider stroke, if its width in steps would vanish in a large variant.
async function seenPen(
    engine: Engine,
    pattern: Variant["pattern"],
    search: Search,
    settings: Parameters<Engine["request"]>[1],
): Promise<Options> {
    const stroke =
        optionOf(search.draw, "stroke") ?? optionOf(pattern.settings, "stroke") ?? valueInText(pattern, "stroke");
    if (!stroke?.includes("step")) return [];
    try {
        const { json } = await engine.request<{ box?: (string | number)[] }>({ do: "measure", pattern }, settings);
        const wider = json.box && leastStroke(stroke, json.box.map(Number), room, leastPen);
        return wider ? [["stroke", wider]] : [];
    } catch (error) {
        if (error instanceof RequestFailed) return []; // maps, and drawings in space
        throw error;
    }
}

// True if hardly anything can be seen: fewer than one pixel in a thousand differs from the first, the ground.
function isBlank(values: Uint8ClampedArray): boolean {
    const least = values.length / 4 / 1000;
    let seen = 0;
    for (let at = 4; at < values.length; at += 4) {
        let away = 0;
        for (let part = 0; part < 4; ++part) away += Math.abs(values[at + part]! - values[part]!);
        if (away > 30 && ++seen > least) return false;
    }
    return true;
}

// FNV-1a of every third pixel.
function fingerprint(data: Uint8ClampedArray): string {
    const words = new Uint32Array(data.buffer, data.byteOffset, data.byteLength >> 2);
    let one = 0x811c9dc5;
    let other = 0x01000193;
    for (let index = 0; index < words.length; index += 3) {
        one = Math.imul(one ^ words[index]!, 0x01000193);
        other = Math.imul(other + words[index]!, 0x85ebca6b) ^ (other >>> 13);
    }
    return `${one >>> 0}-${other >>> 0}`;
}
