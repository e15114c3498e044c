// Texts of patterns, what links contain, the history in the browser's storage, and scales: without a page.
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { load } from "./load.mjs";

// What the modules use of a page.
const stored = new Map();
let quota = Infinity; // characters
globalThis.window = globalThis;
globalThis.addEventListener = () => {};
globalThis.document = { addEventListener() {} };
const storage = {
    getItem: (name) => stored.get(name) ?? null,
    setItem(name, text) {
        let size = text.length;
        for (const [each, kept] of stored) if (each !== name) size += kept.length;
        if (size > quota) throw new DOMException("full", "QuotaExceededError");
        stored.set(name, text);
    },
    removeItem: (name) => stored.delete(name),
};
Object.defineProperty(globalThis, "localStorage", { value: storage, configurable: true });

const { titleOf, valueInText, withSettings } = await load("pattern_text");
const { readPlace, readLocked, unknownOptions, excerpt } = await load("link_contents");
const { History, putAside } = await load("store");
const { windowOnScreen } = await load("on_screen");
const { lettersOf, bytesOf, keepScale } = await load("scales");
const { namedValues, plainHelp, dividedHelp } = await load("option_fields");
const { shellWords } = await load("shell_words");

beforeEach(() => {
    stored.clear();
    quota = Infinity;
});

function fast(run) {
    const start = performance.now();
    run();
    const time = performance.now() - start;
    assert.ok(time < 1000, `${time} ms`);
}

test("values in a text are found and written", () => {
    const text = "title: A curve\n  define r = 0.5\nangle factor : 4\nvariant a: r = 0.8, n = 3\n\n\n";
    const pattern = { name: "a.lsys", text };
    assert.equal(titleOf(pattern), "A curve");
    assert.equal(titleOf({ name: "a.lsys", text: "axiom: F" }), "a");
    assert.equal(valueInText(pattern, "r"), "0.5");
    assert.equal(valueInText({ ...pattern, variant: "a" }, "r"), "0.8");
    assert.equal(valueInText(pattern, "factor"), null);
    const settings = [["r", "0.7"], ["angle factor", "6"], ["seed", "2"]];
    assert.equal(
        withSettings({ ...pattern, settings }),
        "title: A curve\n  define r = 0.7\nangle factor : 6\nvariant a: r = 0.8, n = 3\nseed: 2\n",
    );
    assert.equal(withSettings({ name: "b", text: "title:\nr: 1\n", settings: [["title", "x"]] }), "title:x\nr: 1\n");
});

test("texts of millions of empty lines are read at once", () => {
    const many = 2_000_000;
    for (const part of ["\n", " ", "\t", "\r\n", " \n", "define", "define ", "title", "title \n", "define\n"]) {
        const text = part.repeat(many) + "x";
        fast(() => titleOf({ name: "a.lsys", text }));
        fast(() => valueInText({ name: "a.lsys", text, variant: "v" }, "r"));
        fast(() => withSettings({ name: "a.lsys", text, settings: [["seed", "1"]] }));
    }
});

test("places of links are checked", () => {
    const read = (place) => readPlace(JSON.stringify(place));
    assert.deepEqual(read({ x: "1.5", y: "-2e20", scale: 0.5 }), { x: "1.5", y: "-2e20", scale: 0.5 });
    assert.equal(readPlace('{"x":"0","y":"0","scale":1e999}'), null);
    assert.equal(read({ x: "0", y: "0", scale: 1e308 }).scale, 1e200);
    for (const place of [
        null,
        5,
        [],
        { x: "one", y: "0", scale: 1 },
        { x: 1, y: 2, scale: 1 },
        { x: "0", y: "0", scale: -1 },
        { x: "0", y: "0", scale: "1" },
        { x: "9".repeat(6000), y: "0", scale: 1 },
    ]) {
        assert.equal(read(place), null, JSON.stringify(place).slice(0, 60));
    }
    assert.equal(readPlace("{"), null);
    assert.equal(readPlace(undefined), null);
});

test("the window of a wrong place is none", () => {
    document.querySelector = () => null;
    const at = (place) => windowOnScreen({ store: { work: { place } }, opened: { facts: { has_view: true } } });
    assert.equal(at({ x: "0", y: "0", scale: 1 }), "-500,-400,500,400");
    assert.equal(at({ x: "0", y: "0", scale: Infinity }), null);
    assert.equal(at({ x: 0, y: "0", scale: 1 }), null);
    assert.equal(typeof at({ x: "0", y: "0", scale: 1.7e308 }), "string");
});

test("locked names of links are texts", () => {
    assert.deepEqual(readLocked('["seed","r","seed"]'), ["seed", "r"]);
    for (const text of [undefined, "", "{}", "5", '"seed"', '["seed",5]', "[[]]"]) assert.deepEqual(readLocked(text), []);
});

test("options that the program does not have are named", () => {
    const help = { draw: { options: [{ name: "size" }] }, play: { options: [{ name: "tempo" }] } };
    const pattern = { name: "a.lsys", text: "" };
    assert.deepEqual(unknownOptions({ pattern, draw: [["size", "A3"]], play: [["tempo", "90"]] }, help), []);
    assert.deepEqual(unknownOptions({ pattern, draw: [["tempo", "90"]], play: [["run", "x"]] }, help), ["tempo", "run"]);
    assert.deepEqual(unknownOptions({ pattern }, help), []);
});

test("long texts are shown from their beginning", () => {
    assert.deepEqual(excerpt("abc", 3), { text: "abc", rest: 0 });
    assert.deepEqual(excerpt("abcd", 3), { text: "abc…", rest: 1 });
    assert.deepEqual(excerpt("ab🌱d", 3), { text: "ab…", rest: 3 });
});

const work = (text, more = {}) => ({
    pattern: { name: "a.lsys", text, variant: "", settings: [] },
    draw: [],
    play: [],
    place: null,
    panel: "map",
    ...more,
});
const saved = () => JSON.parse(stored.get("sikku-studio"));
const settled = () => new Promise((done) => setTimeout(done, 450));

test("undo keeps the place that is looked at", () => {
    const version = (number) => `axiom: F\nangle factor: 4\nF --> F+F${"-F".repeat(number)}\n`;
    const store = new History(work(version(1)));
    const here = { x: "5", y: "6", scale: 2 };
    store.change({ pattern: work(version(2)).pattern });
    store.change({ place: here });
    store.undo();
    assert.equal(store.work.pattern.text, version(1));
    assert.deepEqual(store.work.place, here);
    store.change({ place: { ...here, x: "7" } });
    store.redo();
    assert.equal(store.work.place.x, "7");
    const other = { name: "b.lsys", text: "3", variant: "", settings: [] };
    store.change({ pattern: other, place: null });
    store.undo();
    assert.equal(store.work.place.x, "7", "another pattern has its own place");
    store.redo();
    assert.equal(store.work.place, null);
});

test("a step that only moved the view is undone by moving it back", () => {
    const store = new History(work("1", { place: { x: "1", y: "1", scale: 1 } }));
    store.change({ draw: [], pattern: work("1").pattern, place: { x: "2", y: "2", scale: 1 } });
    store.undo();
    assert.equal(store.work.place.x, "1");
});

test("thumbnails give way to steps, and work that cannot be kept is reported once", async () => {
    let warnings = 0;
    const store = new History(work("0"));
    store.onUnsaved(() => ++warnings);
    quota = 60_000;
    for (let step = 1; step < 10; ++step) {
        store.change({ pattern: work(String(step)).pattern });
        store.picture(store.work, `data:${"x".repeat(8000)}`);
    }
    await settled();
    assert.equal(saved().steps.length, 10);
    assert.equal(saved().at, 9);
    assert.ok(saved().steps.every((step) => !step.picture));
    assert.equal(warnings, 0);
    store.change({ pattern: work("y".repeat(40_000)).pattern });
    store.change({ pattern: work("z".repeat(40_000)).pattern });
    await settled();
    assert.equal(saved().steps.length, 1);
    assert.equal(saved().steps[0].work.pattern.text[0], "z");
    for (const letter of "ab") {
        store.change({ pattern: work(letter.repeat(100_000)).pattern });
        await settled();
        assert.equal(warnings, 1);
    }
    store.change({ pattern: work("small").pattern });
    await settled();
    store.change({ pattern: work("c".repeat(100_000)).pattern });
    await settled();
    assert.equal(warnings, 2);
});

test("the newest thumbnails are kept when there is room for some", async () => {
    const store = new History(work("0"));
    for (let step = 1; step < 4; ++step) {
        store.change({ pattern: work(String(step)).pattern });
        store.picture(store.work, "x".repeat(1_500_000));
    }
    await settled();
    assert.deepEqual(saved().steps.map((step) => Boolean(step.picture)), [false, false, true, true]);
});

test("a page starts without its work even if no copy of it fits", () => {
    stored.set("sikku-studio", "x".repeat(1000));
    putAside();
    assert.equal(stored.get("sikku-studio-aside").length, 1000);
    stored.set("sikku-studio", "x".repeat(1000));
    const { setItem } = storage;
    storage.setItem = () => {
        throw new DOMException("full", "QuotaExceededError");
    };
    putAside();
    storage.setItem = setItem;
    assert.equal(stored.has("sikku-studio"), false);
});

test("scale files of any size are kept as they are", () => {
    const bytes = Uint8Array.from({ length: 1_000_003 }, (_, at) => at * 7);
    assert.deepEqual(bytesOf(lettersOf(bytes)), bytes);
    keepScale("large.scl", bytes);
});

test("page sizes come from the help of the option", () => {
    const help = "page size: A0 to A3, letter, tabloid, or WIDTHxHEIGHT such as 300x300mm (A4)";
    assert.deepEqual(namedValues(help), ["A0", "A1", "A2", "A3", "letter", "tabloid"]);
    const more = "page size: A9 to A10, SRA3 to SRA4, Arch-D to Arch-E, or WIDTHxHEIGHT (A4)";
    assert.deepEqual(namedValues(more), ["A9", "A10", "SRA3", "SRA4", "Arch-D", "Arch-E"]);
    assert.deepEqual(namedValues("no list"), []);
});

test("recipes are split into words as a shell does", () => {
    assert.deepEqual(shellWords("sikku 0.2.0, -n 3 --set 'stroke=0.5mm red'"), ["sikku", "0.2.0,", "-n", "3", "--set", "stroke=0.5mm red"]);
    assert.deepEqual(shellWords("--title-line='x -n 5 y' --set a=b"), ["--title-line=x -n 5 y", "--set", "a=b"]);
    assert.deepEqual(shellWords("--heading 'it'\\''s' --dots=''"), ["--heading", "it's", "--dots="]);
    assert.deepEqual(shellWords("--gcode-start $'G0\\nM3 \\'a\\' \\x09\\\\'"), ["--gcode-start", "G0\nM3 'a' \t\\"]);
});

test("help texts name the fields, and long ones are divided", () => {
    const names = new Set(["step", "dot-spacing"]);
    assert.equal(plainHelp("at the length that 'step' sets; excludes --dot-spacing", names),
        "at the length that “Step” sets; excludes “Dot spacing”");
    assert.equal(plainHelp("such as 'Noto Serif' or 'turn'", names), "such as 'Noto Serif' or 'turn'");
    assert.deepEqual(dividedHelp("margin on all four sides (10mm)"), ["margin on all four sides (10mm)", ""]);
    const long = "draw a frame around the drawing: kaavi, padi, lotus, rope, diamonds, waves, marigolds, lamps, or a file";
    assert.deepEqual(dividedHelp(long), ["draw a frame around the drawing", long.slice(33)]);
    assert.equal(dividedHelp("a ".repeat(80))[0].length, 89);
});
