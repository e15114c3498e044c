// Which texts are versions of one pattern, the names of patterns, and the words of errors: without a page.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { basename, join } from "node:path";
import { test } from "node:test";
import { load } from "./load.mjs";
import { root } from "../load_bridge.mjs";

const { fileName, isAnother, renamed } = await load("versions");
const { RequestFailed } = await load("context");

const folder = join(root, "patterns");
const bundled = readdirSync(folder, { recursive: true })
    .filter((name) => name.endsWith(".lsys"))
    .map((name) => ({ name: basename(name), text: readFileSync(join(folder, name), "utf8") }));
const textOf = (name) => bundled.find((each) => each.name === `${name}.lsys`).text;

const other = (one, two) => isAnother({ name: "x", text: one }, { name: "x", text: two });

test("every bundled pattern is another than the next", () => {
    for (const [at, { name, text }] of bundled.entries()) {
        const next = bundled[(at + 1) % bundled.length];
        assert.ok(isAnother({ name, text }, next), `${name} and ${next.name}`);
        assert.ok(isAnother(next, { name, text }), `${next.name} and ${name}`);
    }
});

test("a pattern that is edited stays the same", () => {
    for (const { name, text } of bundled) {
        const lines = text.split("\n");
        const edits = [
            text,
            `${text}\nstroke: 0.3mm navy\n`,
            text.replace(/^title: .*/m, "title: Mine"),
            text.replace(/^title: .*\n/m, ""),
            lines.map((line) => line.replace("-->", "-->  ")).join("\n") === text ? text : text.replace("-->", "-->  "),
            `// A comment\n${text}`,
            text.replaceAll("\n", "\n\n"),
        ];
        for (const edited of edits) assert.ok(!other(text, edited), `${name}: ${edited.slice(0, 200)}`);
    }
    assert.ok(other(textOf("hilbert"), ""), "nothing is left");
    assert.ok(other("", textOf("hilbert")));
});

test("a text has the name of its title", () => {
    assert.equal(fileName("Hilbert curve"), "hilbert-curve");
    assert.equal(fileName("  A/B: 'two' — “three”\u0000.. "), "a-b-two-three");
    assert.equal(fileName("கோலம் 7"), "கோலம்-7");
    assert.equal(fileName("!?"), "");
    assert.ok(fileName("long ".repeat(100)).length <= 60);
    const snake = { name: "snake-kolam.lsys", text: textOf("snake-kolam"), variant: "" };
    const edited = (text) => renamed({ ...snake, text }, snake).name;
    assert.equal(edited(snake.text.replace("length: 4", "length: 3")), "snake-kolam.lsys");
    assert.equal(edited(snake.text.replace(/^title: .*/m, "title: My snake")), "my-snake.lsys");
    assert.equal(edited(textOf("hilbert")), `${fileName(/^title: (.*)/m.exec(textOf("hilbert"))[1])}.lsys`);
    assert.equal(edited("axiom: F\nF --> F+F\n"), "pattern.lsys");
    const opened = { name: "mine.lsys", text: textOf("hilbert") };
    assert.equal(renamed(opened, snake), opened, "what is opened under a name keeps it");
});

test("errors of patterns are sentences with the line", () => {
    const said = (error) => new RequestFailed(error).message;
    const place = (line, message, more = {}) => ({ line, column: 3, message, warning: false, ...more });
    const message = "curve.lsys:6:1: a map has no turtle\n  map: x\n  ^";
    const failure = { kind: "pattern", message, diagnostics: [place(6, "a map has no turtle")] };
    assert.equal(said(failure), "Line 6: a map has no turtle");
    failure.diagnostics.unshift(place(2, "unused", { warning: true }));
    failure.diagnostics.push(place(9, "unknown key"));
    assert.equal(said(failure), "Line 6: a map has no turtle (and 1 more)");
    assert.equal(said({ ...failure, diagnostics: [place(0, "too large", { setting: "n 9" })] }), "n 9: too large");
    assert.equal(said({ kind: "budget", message: "more than 5 nodes" }), "more than 5 nodes");
});
