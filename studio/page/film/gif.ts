// Writes animated GIFs.

/// Red, green, blue of at most 256 colours, one after the other.
export type Palette = Uint8Array;

const most_colours = 256;

/// At most 256 colours for these pixels: all of them, or the means of boxes that the median cut makes.
/// @param pixels  RGBA
export function paletteOf(pixels: Uint8ClampedArray): Palette {
    const counts = new Map<number, number>();
    for (let at = 0; at < pixels.length; at += 4) {
        const colour = (pixels[at]! << 16) | (pixels[at + 1]! << 8) | pixels[at + 2]!;
        counts.set(colour, (counts.get(colour) ?? 0) + 1);
    }
    let boxes = [[...counts]];
    while (boxes.length < most_colours) {
        // The box with the widest range times the square root of its pixels is cut.
        let best = -1;
        let most = 0;
        boxes.forEach((box, at) => {
            if (box.length < 2) return;
            const weight = widest(box).width * Math.sqrt(box.reduce((sum, [, count]) => sum + count, 0));
            if (weight > most) [best, most] = [at, weight];
        });
        if (best < 0) break;
        boxes = [...boxes.slice(0, best), ...boxes.slice(best + 1), ...halves(boxes[best]!)];
    }
    const palette = new Uint8Array(3 * boxes.length);
    boxes.forEach((box, at) => palette.set(meanOf(box), 3 * at));
    return palette;
}

type Box = [colour: number, count: number][];
const part = (colour: number, shift: number) => (colour >> shift) & 255;

function widest(box: Box): { shift: number; width: number } {
    let found = { shift: 16, width: 0 };
    for (const shift of [16, 8, 0]) {
        let [low, high] = [255, 0];
        for (const [colour] of box) {
            low = Math.min(low, part(colour, shift));
            high = Math.max(high, part(colour, shift));
        }
        if (high - low > found.width) found = { shift, width: high - low };
    }
    return found;
}

function halves(box: Box): [Box, Box] {
    const { shift } = widest(box);
    const sorted = box.toSorted(([one], [other]) => part(one, shift) - part(other, shift));
    const half = sorted.reduce((sum, [, count]) => sum + count, 0) / 2;
    let cut = 0;
    for (let sum = 0; cut < sorted.length - 1 && sum < half; ++cut) sum += sorted[cut]![1];
    cut = Math.min(Math.max(1, cut), sorted.length - 1);
    return [sorted.slice(0, cut), sorted.slice(cut)];
}

function meanOf(box: Box): [number, number, number] {
    const total = box.reduce((sum, [, count]) => sum + count, 0);
    const mean = (shift: number) =>
        Math.round(box.reduce((sum, [colour, count]) => sum + part(colour, shift) * count, 0) / total);
    return [mean(16), mean(8), mean(0)];
}

export class GifWriter {
    private chunks: Uint8Array[] = [];
    private last: Uint8Array | null = null; // the picture shown, by colour number
    private pending: { box: [number, number, number, number]; delay: number } | null = null;
    private readonly nearest = new Map<number, number>();
    private readonly bits: number; // of a colour number

    constructor(
        readonly width: number,
        readonly height: number,
        private readonly palette: Palette,
    ) {
        this.bits = Math.max(2, Math.ceil(Math.log2(palette.length / 3)));
        const colours = new Uint8Array(3 * 2 ** this.bits);
        colours.set(palette);
        this.chunks.push(
            ascii("GIF89a"),
            Uint8Array.of(...two(width), ...two(height), 0xf0 | (this.bits - 1), 0, 0),
            colours,
            Uint8Array.of(0x21, 0xff, 11),
            ascii("NETSCAPE2.0"),
            Uint8Array.of(3, 1, 0, 0, 0), // repeats without end
        );
    }

    /// @param pixels  RGBA of the whole picture, opaque @param seconds  it is shown
    add(pixels: Uint8ClampedArray, seconds: number): void {
        const now = this.numbered(pixels);
        const delay = Math.max(2, Math.round(100 * seconds)); // players slow shorter ones down
        const box = this.last ? changed(this.last, now, this.width, this.height) : ([0, 0, this.width, this.height] as const);
        if (!box) {
            this.pending!.delay += delay;
            return;
        }
        this.flush();
        this.last = now;
        this.pending = { box: [...box], delay };
    }

    finish(): Uint8Array {
        this.flush();
        this.chunks.push(Uint8Array.of(0x3b));
        const whole = new Uint8Array(this.chunks.reduce((sum, { length }) => sum + length, 0));
        let at = 0;
        for (const chunk of this.chunks) {
            whole.set(chunk, at);
            at += chunk.length;
        }
        return whole;
    }

    // A picture is written when its delay is known.
    private flush(): void {
        const { pending, last } = this;
        if (!pending || !last) return;
        this.pending = null;
        const [left, top, width, height] = pending.box;
        const numbers = new Uint8Array(width * height);
        for (let row = 0; row < height; ++row) {
            const from = (top + row) * this.width + left;
            numbers.set(last.subarray(from, from + width), row * width);
        }
        this.chunks.push(
            Uint8Array.of(0x21, 0xf9, 4, 1 << 2, ...two(Math.min(pending.delay, 65535)), 0, 0),
            Uint8Array.of(0x2c, ...two(left), ...two(top), ...two(width), ...two(height), 0, this.bits),
            ...blocks(compressed(numbers, this.bits)),
        );
    }

    private numbered(pixels: Uint8ClampedArray): Uint8Array {
        const numbers = new Uint8Array(pixels.length / 4);
        for (let at = 0; at < numbers.length; ++at) {
            const colour = (pixels[4 * at]! << 16) | (pixels[4 * at + 1]! << 8) | pixels[4 * at + 2]!;
            let number = this.nearest.get(colour);
            if (number === undefined) this.nearest.set(colour, (number = this.find(colour)));
            numbers[at] = number;
        }
        return numbers;
    }

    private find(colour: number): number {
        const { palette } = this;
        let best = 0;
        let least = Infinity;
        for (let at = 0; at < palette.length; at += 3) {
            const distance =
                (palette[at]! - part(colour, 16)) ** 2 +
                (palette[at + 1]! - part(colour, 8)) ** 2 +
                (palette[at + 2]! - part(colour, 0)) ** 2;
            if (distance < least) [best, least] = [at / 3, distance];
        }
        return best;
    }
}

const two = (number: number) => [number & 255, number >> 8];
const ascii = (text: string) => Uint8Array.from(text, (letter) => letter.charCodeAt(0));

// The rectangle in which two pictures differ: left, top, width, height.
function changed(before: Uint8Array, now: Uint8Array, width: number, height: number): [number, number, number, number] | null {
    let [left, top, right, bottom] = [width, height, -1, -1];
    for (let at = 0; at < now.length; ++at) {
        if (before[at] === now[at]) continue;
        const [x, y] = [at % width, Math.floor(at / width)];
        left = Math.min(left, x);
        right = Math.max(right, x);
        top = Math.min(top, y);
        bottom = Math.max(bottom, y);
    }
    return right < 0 ? null : [left, top, right - left + 1, bottom - top + 1];
}

// LZW with codes of growing length, the lowest bit first.
function compressed(numbers: Uint8Array, bits: number): Uint8Array {
    const clear = 1 << bits;
    const bytes: number[] = [];
    let [held, count] = [0, 0]; // bits that do not fill a byte yet
    let size = bits + 1;
    const put = (code: number) => {
        held |= code << count;
        for (count += size; count >= 8; count -= 8) {
            bytes.push(held & 255);
            held >>>= 8;
        }
    };
    let codes = new Map<number, number>(); // of a code followed by a number
    let next = clear + 2;
    put(clear);
    let code = numbers[0]!;
    for (let at = 1; at < numbers.length; ++at) {
        const pair = (code << 8) | numbers[at]!;
        const known = codes.get(pair);
        if (known !== undefined) {
            code = known;
            continue;
        }
        put(code);
        if (next < 4096) {
            if (next === 1 << size && size < 12) ++size;
            codes.set(pair, next++);
        } else {
            put(clear);
            codes = new Map();
            next = clear + 2;
            size = bits + 1;
        }
        code = numbers[at]!;
    }
    put(code);
    if (next === 1 << size && size < 12) ++size;
    put(clear + 1); // the end
    if (count > 0) bytes.push(held & 255);
    return Uint8Array.from(bytes);
}

function blocks(bytes: Uint8Array): Uint8Array[] {
    const made: Uint8Array[] = [];
    for (let at = 0; at < bytes.length; at += 255) {
        const block = bytes.subarray(at, at + 255);
        made.push(Uint8Array.of(block.length), block);
    }
    return [...made, Uint8Array.of(0)];
}
