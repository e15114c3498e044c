// What newcomers meet, without a page: corrections, angles, the words of each step, GIF and WAV files, lines of an SVG.
import assert from "node:assert/strict";
import { test } from "node:test";
import { anyBridge } from "./any_bridge.mjs";
import { load } from "./load.mjs";

globalThis.window = globalThis;
globalThis.Worker ??= class {};
globalThis.document = { addEventListener() {} };

const { correctedLine } = await load("corrections");
const { angleAt, readAngle, degreesOf } = await load("angles");
const { partsOf, plainProductions } = await load("steps/rewriting");
const { GifWriter, paletteOf } = await load("film/gif");
const { wavOf } = await load("film/wav");
const { polylinesOf } = await load("film/outlines");
const { withSettings } = await load("pattern_text");
const { isArrangement, titleOfArrangement } = await load("arrangements");
const { viewedLink, linkIn, frameFor } = await load("viewing");
const { troubleOf } = await load("trouble");
const { picked } = await load("picked");
const { curveOf, NoteCurves } = await load("play/note_curves");
const { readMelody } = await load("sound/melody");
const { leastStroke } = await load("least_pen");
const { readArrangement } = await load("link_contents");
const ask = await anyBridge();

const faults = (text) =>
    ask({ do: "open", pattern: { name: "a.lsys", text } }).error?.diagnostics.filter((each) => !each.warning) ?? [];

test("lines in other notations are corrected until the pattern has no errors", () => {
    for (const line of [
        "F → F+F", "F -> F+F", "F => F+F", "F = F+F", "F := F+F", "F –> F+F", "F: F+F", "F ⟶ F−F", "n: 4", "angle: 60",
        "  F -> F+F", "rules: (F → F+X), (X → FF)", "n=5, δ=25.7°", "angel factor: 4", "1. F → F+F", "variables: F",
    ]) {
        const lines = ["title: Corrected", "axiom: F", line];
        const first = faults(lines.join("\n"));
        assert.ok(first.length > 0, line);
        for (const fault of first) {
            const corrected = correctedLine(lines[fault.line - 1], fault.message);
            assert.notEqual(corrected, null, `${line}: ${fault.message}`);
            lines[fault.line - 1] = corrected;
        }
        assert.deepEqual(faults(lines.join("\n")), [], `${line} became ${lines.at(-1)}`);
    }
});

test("messages without a correction offer none", () => {
    for (const [line, message] of [
        ["a b c", "expected 'key: value' or a production with '-->'"],
        ["F → X", "'→' is not the arrow of a production; write 'F --> XXXX…'"],
        ["F -> X", "'->' is not the arrow of a production; write each in its own line: 'F --> X', 'X --> F' …"],
        ["x", "'=>' is not an operator; did you mean '>='?"],
        ["x", "unknown key 'y'; did you mean 'z'?"],
    ]) assert.equal(correctedLine(line, message), null, message);
});

test("the angle turns continuously, and keeps fractions of a circle", () => {
    assert.deepEqual(angleAt(90.4, 4), { key: "angle factor", value: "4" });
    assert.deepEqual(angleAt(84, 4), { key: "angle increment", value: "84" });
    assert.deepEqual(angleAt(27.5, 13), { key: "angle factor", value: "13" });
    const seen = new Set();
    for (let degrees = 60; degrees <= 120; degrees += 0.5) {
        const turned = degreesOf(angleAt(degrees, 4));
        assert.ok(Math.abs(turned - degrees) < 0.6);
        seen.add(turned);
    }
    assert.equal(seen.size, 121);
    for (const [text, key, value] of [
        ["360/5", "angle factor", "5"], ["72", "angle factor", "5"], ["72°", "angle factor", "5"],
        ["22.5", "angle factor", "16"], ["25.7", "angle increment", "25.7"], ["0", "angle increment", "0"],
        ["-30", "angle increment", "-30"],
    ]) assert.deepEqual(readAngle(text), { key, value }, text);
    for (const text of ["", "x", "360/x", "1e999"]) assert.equal(readAngle(text), null, text);
});

test("an angle that is written into the text replaces the other kind", () => {
    const text = "axiom: F\nangle factor: 4\nF --> F+F\n";
    const written = withSettings({ name: "a", text, settings: [["angle increment", "84.5"]] });
    assert.equal(written, "axiom: F\nangle increment: 84.5\nF --> F+F\n");
    assert.deepEqual(faults(written), []);
});

test("parts of the next word come from the letters of the word before", () => {
    const pattern = (n) => ({
        name: "a.lsys",
        text: `axiom: f+Xf+f+Xf\nderivation length: ${n}\nangle factor: 4\nX --> Xf-f-f+Xf+f+Xf-f-f+X\n`,
    });
    const productions = plainProductions(pattern(2).text, ask({ do: "open", pattern: pattern(2) }));
    assert.deepEqual([...productions], [["X", "Xf-f-f+Xf+f+Xf-f-f+X"]]);
    const word = (n) => new TextDecoder().decode(ask.whole({ do: "derive", pattern: pattern(n) }).bytes).trim();
    for (let n = 0; n < 4; ++n) {
        const parts = partsOf(word(n), word(n + 1), productions);
        assert.equal(parts.length, word(n).length);
        assert.equal(parts[word(n).indexOf("X")], "Xf-f-f+Xf+f+Xf-f-f+X");
    }
    assert.equal(partsOf(word(0), word(2), productions), null);
    for (const text of [
        "axiom: A(1)\nA(x) --> A(x+1)F\n",
        "axiom: A\nA --> F : 0.5\nA --> FF : 0.5\n",
        "axiom: AB\nA < B --> BA\n",
    ]) {
        const facts = ask({ do: "open", pattern: { name: "a.lsys", text } });
        assert.equal(facts.error, undefined, text);
        assert.equal(plainProductions(text, facts), null, text);
    }
});

// Reads a GIF by its specification, without the writer's code: the pictures as RGB, with their delays.
function readGif(bytes) {
    const word = (at) => bytes[at] | (bytes[at + 1] << 8);
    assert.equal(String.fromCharCode(...bytes.subarray(0, 6)), "GIF89a");
    const [width, height] = [word(6), word(8)];
    const colours = bytes.subarray(13, 13 + 3 * 2 ** ((bytes[10] & 7) + 1));
    let at = 13 + colours.length;
    const screen = new Uint8Array(3 * width * height);
    const frames = [];
    let delay = 0;
    const blocks = () => {
        const all = [];
        for (; bytes[at] !== 0; at += bytes[at] + 1) all.push(...bytes.subarray(at + 1, at + 1 + bytes[at]));
        ++at;
        return all;
    };
    for (;;) {
        const kind = bytes[at++];
        if (kind === 0x3b) return { width, height, frames, end: at };
        if (kind === 0x21) {
            if (bytes[at] === 0xf9) delay = word(at + 3);
            ++at;
            blocks();
            continue;
        }
        assert.equal(kind, 0x2c);
        const [left, top, w, h] = [word(at), word(at + 2), word(at + 4), word(at + 6)];
        const least = bytes[at + 9];
        at += 10;
        const numbers = unpack(blocks(), least);
        assert.equal(numbers.length, w * h);
        numbers.forEach((number, i) => {
            const place = 3 * ((top + Math.floor(i / w)) * width + left + (i % w));
            screen.set(colours.subarray(3 * number, 3 * number + 3), place);
        });
        frames.push({ delay, picture: screen.slice() });
    }
}

function unpack(data, least) {
    const clear = 1 << least;
    let [size, table, before, bit] = [least + 1, [], null, 0];
    const made = [];
    for (;;) {
        let code = 0;
        for (let i = 0; i < size; ++i, ++bit) code |= ((data[bit >> 3] >> (bit & 7)) & 1) << i;
        if (code === clear) {
            table = Array.from({ length: clear + 2 }, (_, i) => [i]);
            [size, before] = [least + 1, null];
            continue;
        }
        if (code === clear + 1) return made;
        const entry = table[code] ?? [...before, before[0]];
        for (const each of entry) made.push(each);
        if (before && table.length < 4096) table.push([...before, entry[0]]);
        if (table.length === 1 << size && size < 12) ++size;
        before = entry;
    }
}

test("GIFs are read again as they were written", () => {
    const [width, height] = [97, 61];
    let state = 1;
    const random = () => (state = Math.imul(state, 48271) & 0x7fffffff) / 0x80000000;
    const colours = Array.from({ length: 200 }, () => [0, 0, 0].map(() => Math.floor(random() * 256)));
    const frames = Array.from({ length: 4 }, (_, frame) => {
        const pixels = new Uint8ClampedArray(4 * width * height).fill(255);
        for (let i = 0; i < width * height; ++i) {
            const isSame = frame > 0 && i % width < 30;
            pixels.set(colours[isSame ? 7 : Math.floor(random() ** (frame + 1) * colours.length)], 4 * i);
        }
        return pixels;
    });
    const all = new Uint8ClampedArray(frames.flatMap((each) => [...each]));
    const writer = new GifWriter(width, height, paletteOf(all));
    frames.forEach((pixels, at) => writer.add(pixels, 0.1 * (at + 1)));
    writer.add(frames[3], 1);
    const bytes = writer.finish();
    const read = readGif(bytes);
    assert.deepEqual([read.width, read.height, read.end], [width, height, bytes.length]);
    assert.deepEqual(read.frames.map(({ delay }) => delay), [10, 20, 30, 140]);
    read.frames.forEach(({ picture }, at) => {
        for (let i = 0; i < width * height; ++i) {
            const wanted = [...frames[at].subarray(4 * i, 4 * i + 3)];
            assert.deepEqual([...picture.subarray(3 * i, 3 * i + 3)], wanted, `frame ${at}, pixel ${i}`);
        }
    });
});

test("a palette of 256 colours is near to all colours of a picture", () => {
    const pixels = new Uint8ClampedArray(4 * 64 * 64);
    for (let i = 0; i < 64 * 64; ++i) pixels.set([4 * (i % 64), 4 * Math.floor(i / 64), 90, 255], 4 * i);
    const palette = paletteOf(pixels);
    assert.equal(palette.length, 3 * 256);
    const writer = new GifWriter(64, 64, palette);
    writer.add(pixels, 0.1);
    const [{ picture }] = readGif(writer.finish()).frames;
    for (let i = 0; i < 64 * 64; ++i) {
        for (let c = 0; c < 3; ++c) assert.ok(Math.abs(picture[3 * i + c] - pixels[4 * i + c]) <= 16);
    }
});

test("WAV files have the header of the format, and clipped samples", () => {
    const bytes = wavOf([Float32Array.of(0, 1, -2), Float32Array.of(0.5, -1, 0)], 44100);
    const view = new DataView(bytes.buffer);
    assert.equal(String.fromCharCode(...bytes.subarray(0, 4), ...bytes.subarray(8, 16)), "RIFFWAVEfmt ");
    assert.equal(view.getUint32(4, true), bytes.length - 8);
    assert.deepEqual([view.getUint16(20, true), view.getUint16(22, true), view.getUint32(24, true)], [1, 2, 44100]);
    assert.deepEqual([view.getUint32(28, true), view.getUint16(32, true), view.getUint16(34, true)], [176400, 4, 16]);
    assert.equal(view.getUint32(40, true), 12);
    const samples = Array.from({ length: 6 }, (_, i) => view.getInt16(44 + 2 * i, true));
    assert.deepEqual(samples, [0, 16384, 32767, -32767, -32767, 0]);
});

test("paths of prints are split into lines", () => {
    assert.deepEqual(polylinesOf("M1 2h3v-1 2l-1-1zm10 0H5"), [[1, 2, 4, 2, 4, 1, 4, 3, 3, 2, 1, 2], [11, 2, 5, 2]]);
    const [curve] = polylinesOf("M0 0c0 1 1 1 1 0");
    assert.equal(curve.length, 22);
    assert.deepEqual(curve.slice(-2).map((each) => Math.round(each * 1e9) / 1e9), [1, 0]);
    assert.ok(Math.abs(curve[11] - 0.75) < 1e-9);
    assert.throws(() => polylinesOf("M0 0A1 1 0 0 0 1 1"), /command A/);
    // 256 steps of the quadratic Koch island, by the length of the path and that of its first step.
    const { bytes } = ask.whole({
        do: "make", interpreter: "draw", format: "svg", options: [],
        pattern: { name: "a.lsys", text: "axiom: F+F+F+F\nderivation length: 2\nangle factor: 4\nF --> F+F-F-FF+F+F-F\n" },
    });
    const paths = [...new TextDecoder().decode(bytes).matchAll(/<path d="([^"]*)"/g)].flatMap(([, d]) => polylinesOf(d));
    let sum = 0;
    let least = Infinity;
    for (const line of paths) {
        for (let i = 2; i < line.length; i += 2) {
            const length = Math.hypot(line[i] - line[i - 2], line[i + 1] - line[i - 1]);
            sum += length;
            least = Math.min(least, length);
        }
    }
    assert.ok(Math.abs(sum / least / 256 - 1) < 0.01, `${sum / least} steps`);
});

test("bundled arrangements are listed, played and exported", () => {
    const { arrangements } = ask({ do: "arrangements" });
    assert.ok(arrangements.length >= 9);
    for (const { name, title, text, parts } of arrangements) {
        assert.ok(isArrangement(text), name);
        assert.equal(titleOfArrangement({ name, text }), title);
        const { json, bytes } = ask.whole({ do: "notes", arrangement: { name: `${name}.toml`, text } });
        assert.equal(json.error, undefined, name);
        assert.ok(json.count > 20 && bytes.length >= 80 * json.count, name);
        assert.ok(json.parts.length >= Math.min(parts, 2), name);
    }
    const arrangement = { name: "x.toml", text: arrangements[0].text };
    const made = ask.whole({ do: "make", interpreter: "play", format: "mid", options: [], arrangement });
    assert.deepEqual(made.json.outputs.map(({ name }) => name), ["x.mid"]);
    assert.equal(new TextDecoder().decode(made.bytes.subarray(0, 4)), "MThd");
    assert.match(ask({ do: "make", interpreter: "draw", format: "svg", arrangement }).error.message, /no picture/);
    const wrong = (text) => ask({ do: "notes", arrangement: { name: "x.toml", text } }).error.message;
    assert.match(wrong('[[track]]\npattern = "/sikku/none"\n'), /neither bundled nor in the file/);
    assert.match(wrong("[[track]\n"), /x\.toml/);
    assert.match(wrong('[[track]]\npattern = "hilbert"\nnonsense = 1\n'), /nonsense/);
});

test("links that only show are told from others", () => {
    assert.equal(viewedLink("#sikku1.abc&view=only"), "sikku1.abc");
    assert.equal(viewedLink("#sikku1.abc"), null);
    assert.equal(viewedLink("#sikku1.abc&view=onlyx"), null);
    assert.equal(linkIn("https://a.b/c?d=e&f#sikku1.x&view=only"), "sikku1.x");
    assert.equal(linkIn("sikku1.x"), "sikku1.x");
    assert.ok(!frameFor("https://a/#x", '"><script>').includes("<script"));
});

test("a page that cannot start gives a sentence", () => {
    assert.match(troubleOf(new Error("WebAssembly is not defined")).sentence, /needs WebAssembly/);
    assert.equal(troubleOf(new Error("WebAssembly.compile(): blocked by CSP")).isAboutWork, false);
    assert.equal(troubleOf(new Error("x is null")).isAboutWork, true);
});

test("the picked patterns exist", () => {
    const names = new Set(ask({ do: "patterns" }).patterns.map(({ name }) => name));
    assert.equal(new Set(picked).size, 12);
    for (const name of picked) assert.ok(names.has(name), name);
});

const splines = [
    "axiom: F+F+F+F\nangle factor: 4\nline: spline\n", // closed
    "axiom: FF+F-F-FF+F+F\nangle factor: 4\nline: spline\n",
    "axiom: F+F\nangle factor: 4\nline: spline\n", // three control points
    "axiom: F+F-F\nangle factor: 5\nline: spline\n",
];

/// The answer to a request with its bytes in memory of their own.
function owned(request) {
    const { json, bytes } = ask.whole(request);
    return { json, bytes: Uint8Array.from(bytes) };
}
const lines = (pattern) => owned({ do: "lines", pattern });

/// The points of the control polygon, and those of the print, which the program draws by other means.
function splineOf(text) {
    const { json, bytes } = lines({ name: "a.lsys", text });
    const points = new Float64Array(bytes.buffer);
    const options = [["step", "10mm"]];
    const made = ask.whole({ do: "make", interpreter: "draw", format: "svg", options, pattern: { name: "a.lsys", text } });
    const svg = Buffer.from(made.bytes).toString();
    const printed = polylinesOf(/<path[^>]* d="([^"]*)"/.exec(svg)[1])[0];
    return { points, printed };
}

test("splines are drawn as in prints", () => {
    for (const text of splines) {
        const { points, printed } = splineOf(text);
        const curve = curveOf(points);
        const middle = (list, axis) => {
            const all = [...list].filter((_, i) => i % 2 === axis);
            return (Math.min(...all) + Math.max(...all)) / 2;
        };
        // In prints y points downwards, and the unit differs.
        const factor = (list) => Math.max(...[0, 1].map((axis) => {
            const all = [...list].filter((_, i) => i % 2 === axis);
            return Math.max(...all) - Math.min(...all);
        }));
        const scale = factor(printed) / factor(curve);
        const places = Array.from({ length: printed.length / 2 }, (_, i) => [
            (printed[2 * i] - middle(printed, 0)) / scale,
            -(printed[2 * i + 1] - middle(printed, 1)) / scale,
        ]);
        for (let i = 0; i < curve.length; i += 2) {
            const [x, y] = [curve[i] - middle(curve, 0), curve[i + 1] - middle(curve, 1)];
            const away = Math.min(...places.slice(1).map((to, k) => {
                const [x0, y0] = places[k];
                const [dx, dy] = [to[0] - x0, to[1] - y0];
                const share = Math.min(1, Math.max(0, ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy || 1)));
                return Math.hypot(x - x0 - share * dx, y - y0 - share * dy);
            }));
            assert.ok(away < 0.02, `${text}: point ${i / 2} is ${away} steps away from the print`);
        }
    }
});

test("notes of a kolam lie on its curve", () => {
    const { text } = ask({ do: "patterns" }).patterns.find(({ name }) => name === "snake-kolam");
    const pattern = { name: "a.lsys", text };
    const notes = owned({ do: "notes", pattern });
    const melody = readMelody(notes.json, notes.bytes);
    const { json, bytes } = lines(pattern);
    const before = new Int32Array(melody.count).fill(-1);
    const curves = NoteCurves.of(json, bytes, melody, before);
    assert.ok(curves, "the melody was read from these lines");
    let known = 0;
    let least = Infinity;
    for (let i = 0; i < melody.count; ++i) {
        if (!curves.has(i)) continue;
        ++known;
        const [x, y] = curves.placeAt(i, 0.5);
        const [x0, y0, x1, y1] = melody.path.slice(4 * i, 4 * i + 4);
        // A B-spline stays within a step of its control polygon.
        assert.ok(Math.hypot(x - (x0 + x1) / 2, y - (y0 + y1) / 2) <= 1);
        least = Math.min(least, Math.hypot(x - (x0 + x1) / 2, y - (y0 + y1) / 2));
    }
    assert.equal(known, melody.count);
    assert.ok(least < 0.2);
    let traced = 0;
    curves.traceAll({ moveTo: () => ++traced, lineTo: () => {} }, Number, Number);
    assert.equal(traced, json.begins.length - 1);
    // Other lines are not drawn in place of the melody's.
    const other = lines({ name: "a.lsys", text: splines[0] });
    assert.equal(NoteCurves.of(other.json, other.bytes, melody, before), null);
});

test("pens in steps do not vanish in large variants", () => {
    assert.equal(leastStroke("0.22 step #fffaf0", [0, 0, 400, 300], 88, 0.7), "0.7mm #fffaf0");
    assert.equal(leastStroke("0.22 step #fffaf0", [0, 0, 20, 27], 88, 0.7), null); // 0.22 * 88 / 27 = 0.717 mm
    assert.equal(leastStroke("0.2mm navy", [0, 0, 4000, 300], 88, 0.7), null);
    assert.equal(leastStroke("none", [0, 0, 4000, 300], 88, 0.7), null);
});

test("arrangements in links are checked", () => {
    const text = '[[track]]\npattern = "hilbert"\n';
    assert.deepEqual(readArrangement(JSON.stringify({ name: "a.toml", text })), { name: "a.toml", text });
    for (const wrong of [undefined, "", "[]", "3", "null", "{}", JSON.stringify({ name: "../a.toml", text }),
        JSON.stringify({ name: "a\nb", text }), JSON.stringify({ name: "a.toml", text: "axiom: F" }),
        JSON.stringify({ name: 3, text })]) {
        assert.equal(readArrangement(wrong), null, String(wrong));
    }
});
