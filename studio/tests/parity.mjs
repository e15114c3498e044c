// Compares the libraries as WebAssembly with the native ones and with the program, byte for byte.
//     node parity.mjs NATIVE_BUILD [--quick]
// NATIVE_BUILD contains bin/sikku and bin/sikku-bridge; the module is in build/studio.
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join, resolve } from "node:path";
import { load } from "./load.mjs";
import { loadBridge, root } from "../load_bridge.mjs";

const build = resolve(process.argv[2] ?? join(root, "build/dev"));
const is_quick = process.argv.includes("--quick");
const failures = [];
const counts = new Map();

/// Sends requests to the native program, one after another.
function native_bridge() {
    const program = spawn(join(build, "bin/sikku-bridge"), { stdio: ["pipe", "pipe", "inherit"] });
    const output = program.stdout[Symbol.asyncIterator]();
    let rest = Buffer.alloc(0);
    const more = async () => {
        const { value, done } = await output.next();
        if (done) throw new Error("the native bridge ended");
        return value;
    };
    const line = async () => {
        while (!rest.includes(10)) rest = Buffer.concat([rest, await more()]);
        const end = rest.indexOf(10);
        const text = rest.subarray(0, end).toString();
        rest = rest.subarray(end + 1);
        return text;
    };
    const take = async (size) => {
        const pieces = [rest];
        for (let length = rest.length; length < size; length += pieces.at(-1).length) pieces.push(await more());
        const all = Buffer.concat(pieces);
        rest = all.subarray(size);
        return all.subarray(0, size);
    };
    return {
        async ask(json, bytes) {
            const text = Buffer.from(json);
            program.stdin.write(`${text.length} ${bytes.length}\n`);
            program.stdin.write(text);
            program.stdin.write(bytes);
            const [json_size, bytes_size] = (await line()).split(" ").map(Number);
            return { json: (await take(json_size)).toString(), bytes: await take(bytes_size) };
        },
        end: () => program.stdin.end(),
    };
}

const native = native_bridge();
const web = await loadBridge();

function fail(request, what) {
    failures.push(`${request.do} ${request.format ?? ""} ${request.pattern?.name ?? request.name ?? ""}: ${what}`);
}

/// The position where two texts differ.
function difference(a, b) {
    let at = 0;
    while (at < a.length && a[at] === b[at]) ++at;
    return `native …${a.slice(Math.max(at - 40, 0), at + 60)}… web …${b.slice(Math.max(at - 40, 0), at + 60)}…`;
}

/// Returns the native reply. Pixels may differ by one level.
async function compare(request, bytes = Buffer.alloc(0)) {
    const kind = `${request.do} ${request.format ?? ""}`.trim();
    counts.set(kind, (counts.get(kind) ?? 0) + 1);
    const json = JSON.stringify({ seconds: 1200, ...request }); // neither stops because the machine is busy
    const expected = await native.ask(json, bytes);
    const got = web(json, bytes);
    if (expected.json !== got.json) fail(request, difference(expected.json, got.json));
    else if (request.do === "pixels") {
        let most = 0;
        for (let i = 0; i < expected.bytes.length; ++i) {
            const apart = Math.abs(expected.bytes[i] - got.bytes[i]);
            if (apart > most) most = apart;
        }
        if (expected.bytes.length !== got.bytes.length || most > 1) fail(request, `pixels differ by ${most}`);
    } else if (!expected.bytes.equals(Buffer.from(got.bytes))) {
        fail(request, difference(expected.bytes.toString("latin1"), Buffer.from(got.bytes).toString("latin1")));
    }
    return expected;
}

// Vector formats, models, scores. Picture files differ because their writers differ; `pixels` compares the pictures.
const drawn = ["svg", "pdf", "eps", "hpgl", "gcode", "dxf", "obj", "glb", "stl"];
const played = ["mid", "musicxml", "mxl", "ly", "abc", "csd", "sco", "strudel", "notes.svg", "html"];

async function compare_pattern(pattern, rich) {
    await compare({ do: "open", pattern });
    for (const format of rich ? drawn : ["svg"]) await compare({ do: "make", interpreter: "draw", format, pattern });
    for (const format of rich ? played : ["mid"]) await compare({ do: "make", interpreter: "play", format, pattern });
    await compare({ do: "measure", pattern });
    await compare({ do: "kolam", pattern });
    await compare({ do: "check", pattern });
    if (rich) await compare({ do: "pixels", width: 300, height: 300, pattern });
    if (rich) await compare({ do: "notes", pattern });
}

const { patterns } = JSON.parse((await compare({ do: "patterns" })).json);
await compare({ do: "help" });
for (const { name, text } of patterns) {
    await compare_pattern({ name: `${name}.lsys`, text, settings: [] }, !is_quick);
}

// Variants, and other options.
for (const { name, text } of patterns) {
    const { variants, has_view } = JSON.parse(
        (await compare({ do: "open", pattern: { name: `${name}.lsys`, text, settings: [["seed", "7"]] } })).json);
    const pattern = { name: `${name}.lsys`, text, settings: [] };
    for (const variant of variants ?? []) {
        await compare({ do: "make", interpreter: "draw", format: "svg", pattern: { ...pattern, variant } });
    }
    const options = [["size", "A3"], ["landscape", "true"], ["margin", "7mm"], ["rotate", "17"], ["stroke", "0.4mm navy"]];
    await compare({ do: "make", interpreter: "draw", format: "svg", options, pattern });
    if (has_view) {
        const window = ["-3.5", "-2.25", "40", "41.25"];
        const deep = { ...pattern, settings: [["derivation length", "40"]] };
        await compare({ do: "pixels", width: 256, height: 256, window, pattern: is_quick ? pattern : deep });
    }
}

// Damaged patterns: parts removed, doubled or exchanged, characters replaced; the same in every run.
let state = 1;
const random = (below) => {
    state = (Math.imul(state, 1103515245) + 12345) >>> 0;
    return (state >>> 8) % below;
};
const damage = (text) => {
    for (let round = 0; round < 1 + random(3); ++round) {
        const at = random(text.length);
        const end = Math.min(at + 1 + random(12), text.length);
        const piece = text.slice(at, end);
        const strange = ["[", "]", "(", ")", "--", ":", "\u00e9", "\u0000", "\n", "999999999", "{", "@", "é", "-1e309"];
        text = [
            text.slice(0, at) + text.slice(end),
            text.slice(0, end) + piece + text.slice(end),
            text.slice(0, at) + strange[random(strange.length)] + text.slice(end),
            text.slice(0, at) + strange[random(strange.length)] + text.slice(at),
        ][random(4)];
    }
    return text;
};
for (let i = 0; i < (is_quick ? 60 : 200); ++i) {
    const { name, text } = patterns[random(patterns.length)];
    await compare_pattern({ name: `${name}.lsys`, text: damage(text), settings: [] }, false);
}

// Links and their contents, including damaged links.
for (const { name, text } of patterns) {
    const pattern = { name: `${name}.lsys`, text, variant: "", settings: [["derivation length", "3"], ["seed", "7"]] };
    const shared = { pattern, draw: [["size", "A3"], ["dots", ""]], play: [["tempo", "90"]], page: { panel: "map" } };
    const { link } = JSON.parse((await compare({ do: "link", shared })).json);
    await compare({ do: "read_link", link });
    await compare({ do: "read_link", link: `https://example.org/#${link}` });
    for (let i = 0; i < 3; ++i) await compare({ do: "read_link", link: damage(link) });
}

// Grids, and systems of other programs.
for (const grid of ["5-3 idukku", "15x9-9x3", "oo./ooo", "5 to 4", "40x40"]) await compare({ do: "dots", grid });
await compare({ do: "dots", grid: "5x5", symmetry: "C4", remove: [[4, 2]], add: [[6, 0]] });
for (const grid of ["7x7", "1-3-5-7-5-3-1", "3x5", "2-4-3", "7-4 idukku", "oo./ooo/.oo"]) {
    for (const symmetry of ["none", "C2", "C4", "C6", "mirror-x", "D4", "D6"]) {
        for (const single_line of [false, true]) await compare({ do: "grid", grid, symmetry, single_line, joined: 0.3, seed: "5" });
    }
}
for (const seed of ["1", "2", "3"]) {
    await compare({ do: "grid", grid: "9-5 idukku", symmetry: "D6", composed: true, coloured: true, strands: true, seed });
}
for (const rim of ["pointed", "petal", "horn", "crescent"]) {
    for (const grid of ["1-3-5-7-5-3-1", "7-4 idukku"]) await compare({ do: "grid", grid, rim, composed: true, seed: "4", strands: true });
}
// Photographs, as the pixels of drawn kolams.
for (const grid of ["5x5", "5-3 idukku", "oo./ooo/.oo"]) {
    const { text } = JSON.parse(web(JSON.stringify({ do: "grid", grid, composed: true, seed: "2" })).json);
    const pattern = { name: "photo.lsys", text: `${text}dots: 0.2 step #fffaf0\n` };
    const drawn = { do: "pixels", width: 420, height: 420, options: [["size", "70x70mm"], ["rotate", "7"]], pattern };
    const pixels = Buffer.from(web(JSON.stringify(drawn)).bytes);
    await compare({ do: "read", width: 420, height: 420, source: "photo.png" }, pixels);
    await compare({ do: "read", width: 420, height: 420, source: "photo.png", fixes: ["1,1: turn"] }, pixels);
}
await compare({ do: "read", width: 20, height: 20, source: "photo.png" }, Buffer.alloc(1600, 80));
const imports = join(root, "tests/corpus/import");
for (const name of readdirSync(imports, { recursive: true })) {
    if (/\.(l|frm)$/.test(name)) await compare({ do: "import", name: basename(name) }, readFileSync(join(imports, name)));
}

// Compares with the files of the program.
const folder = mkdtempSync(join(tmpdir(), "sikku-parity-"));
const sikku = (...command) => execFileSync(join(build, "bin/sikku"), command, { maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "pipe"] });
const asked = (request) => {
    const reply = web(JSON.stringify(request));
    return JSON.parse(reply.json).error ? null : Buffer.from(reply.bytes);
};
const same = (request, run) => {
    const kind = `program ${request.do}`;
    counts.set(kind, (counts.get(kind) ?? 0) + 1);
    let expected = null;
    try {
        expected = run();
    } catch { /* both have to refuse */ }
    const got = asked(request);
    if ((expected === null) !== (got === null)) fail(request, `only ${got === null ? "the program" : "the web build"} has a result`);
    else if (got !== null && !expected.equals(got)) fail(request, `differs from the program: ${difference(expected.toString("latin1"), got.toString("latin1"))}`);
};
for (const { name, text } of patterns.filter((_, i) => !is_quick || i % 4 === 0)) {
    const pattern = { name: `${name}.lsys`, text, settings: [] };
    const written = (command, format) => {
        const file = join(folder, `${name}.${format}`);
        sikku("-q", command, name, "-o", file);
        return readFileSync(file);
    };
    same({ do: "make", interpreter: "draw", format: "svg", pattern }, () => written("draw", "svg"));
    same({ do: "make", interpreter: "draw", format: "pdf", pattern }, () => written("draw", "pdf"));
    same({ do: "make", interpreter: "play", format: "mid", pattern }, () => written("play", "mid"));
    same({ do: "measure", pattern }, () => sikku("-q", "measure", name, "--json"));
    same({ do: "kolam", pattern }, () => sikku("-q", "kolam", name, "--json"));
}
// Compares files that the program makes from links.
for (const { name, text } of patterns.filter((_, i) => i % (is_quick ? 8 : 2) === 0)) {
    const pattern = { name: `${name}.lsys`, text, variant: "", settings: [["seed", "7"]] };
    const [draw, play] = [[["size", "A5"], ["rotate", "17"], ["stroke", "0.4mm navy"]], [["humanise", "0.5"]]];
    const { link } = JSON.parse(web(JSON.stringify({ do: "link", shared: { pattern, draw, play } })).json);
    const written = (command, format) => {
        const file = join(folder, `link.${format}`);
        sikku("-q", command, `#${link}`, "-o", file);
        return readFileSync(file);
    };
    same({ do: "make", interpreter: "draw", format: "svg", options: draw, pattern }, () => written("draw", "svg"));
    same({ do: "make", interpreter: "play", format: "mid", options: play, pattern }, () => written("play", "mid"));
}

// The commands shown by the page write the same files as the page: of bundled and changed patterns in an empty
// folder, and of long texts where the pattern was saved.
const { commandSource } = await load("command_source");
const engine = { request: async (request) => ({ json: JSON.parse(web(JSON.stringify(request)).json) }) };
const changes = [
    (text) => text,
    (text) => `${text}\n// It's changed: "$HOME" \\ \`date\` ✓\n`,
    (text) => text + Array.from({ length: 4000 }, (_, i) => `// ${Math.imul(i, 2654435761) >>> 0}\n`).join(""),
];
for (const [name, interpreter, format, options, settings] of [
    ["snake-kolam", "draw", "svg", [["dots", ""], ["border", "kaavi"], ["size", "A3"]], [["derivation length", "3"]]],
    ["plant-d", "draw", "svg", [["stroke", "0.3mm navy"], ["landscape", "true"]], [["seed", "11"]]],
    ["honda-trees", "draw", "pdf", [["rotate", "30"], ["ground", "#fed"]], []],
    ["hilbert", "play", "mid", [["scale", "dorian"], ["tempo", "96"]], [["derivation length", "5"]]],
]) {
    const { text: unchanged } = patterns.find((pattern) => pattern.name === name);
    for (const [at, change] of changes.entries()) {
        const pattern = { name: `${name}.lsys`, text: change(unchanged), settings };
        const source = await commandSource(engine, patterns, pattern);
        const isSaved = source === pattern.name;
        if (isSaved !== (at === 2) || (source === name) !== (at === 0)) fail({ do: "command", pattern }, `the source is ${source.slice(0, 60)}`);
        const empty = mkdtempSync(join(folder, "command-"));
        if (isSaved) writeFileSync(join(empty, pattern.name), pattern.text);
        const asked = { do: "command", interpreter, format, options, pattern, source };
        const { command } = JSON.parse(web(JSON.stringify(asked)).json);
        same({ do: "make", interpreter, format, options, pattern }, () => {
            execFileSync("sh", ["-c", command.replace(/^sikku/, `"${join(build, "bin/sikku")}" -q`)], { cwd: empty, stdio: "ignore" });
            return readFileSync(join(empty, `${name}.${format}`));
        });
    }
}

// Models and reliefs of the program, and the size of pictures, whose writers differ.
for (const [name, more, options] of [
    ["snake-kolam", ["-n", "2"], []],
    ["penrose-rhombs", ["-n", "3", "--relief", "2mm,3mm"], [["relief", "2mm,3mm"]]],
    ["bush-3d", ["-n", "4"], []],
]) {
    const { text, is_spatial } = patterns.find((pattern) => pattern.name === name);
    const pattern = { name: `${name}.lsys`, text, settings: [["derivation length", more[1]]] };
    for (const format of is_spatial ? ["glb"] : ["stl", "glb"]) {
        same({ do: "make", interpreter: "draw", format, options, pattern }, () => {
            const file = join(folder, `${name}.${format}`);
            sikku("-q", "draw", name, ...more, "-o", file);
            return readFileSync(file);
        });
    }
    const file = join(folder, `${name}.png`);
    const flat = more.filter((each) => !/relief|mm/.test(each));
    sikku("-q", "draw", name, ...flat, "--dpi", "72", "-o", file);
    const request = { do: "make", interpreter: "draw", format: "png", options: [["dpi", "72"]], pattern };
    const [ours, theirs] = [asked(request).length, readFileSync(file).length];
    if (ours > theirs * 1.02) fail(request, `the picture has ${ours} bytes, and the program's ${theirs}`);
}
rmSync(folder, { recursive: true });
native.end();

for (const [kind, count] of counts) console.log(`${kind}: ${count}`);
for (const failure of failures.slice(0, 40)) console.log(`DIFFERENT: ${failure}`);
const total = [...counts.values()].reduce((sum, count) => sum + count, 0);
console.log(`${total - failures.length} of ${total} equal`);
process.exit(failures.length > 0 ? 1 : 0);
