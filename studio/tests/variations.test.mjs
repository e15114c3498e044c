// Mutations of productions and variants of works: balanced, different, repeatable.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { Chance } = await load("chance");
const { modulesOf, isBalanced, alphabetOf, mutated, withSuccessor, otherAngle, otherNumber } = await load("mutations");
const { parametersOf, rangeOf, valuesOf, sheetVariants, mutantOf, seedVariant, withSetting, changedPart } =
    await load("variants");

test("words are read as modules", () => {
    assert.deepEqual(modulesOf("F[+F]@O(2)F(x*(y+1), 2)Apex!"), [
        "F",
        "[",
        "+",
        "F",
        "]",
        "@O(2)",
        "F(x*(y+1), 2)",
        "A",
        "p",
        "e",
        "x",
        "!",
    ]);
    assert.deepEqual(modulesOf("Apex(1) F", ["Apex"]), ["Apex(1)", "F"]);
    assert.deepEqual(modulesOf("F(1"), ["F(1"]);
    assert.ok(isBalanced(modulesOf("F[+F]{-f}")));
    assert.ok(!isBalanced(modulesOf("F[+F{]}")));
    assert.ok(!isBalanced(modulesOf("F]")));
});

test("chance is repeatable and even", () => {
    const one = new Chance(7, 3);
    const other = new Chance(7, 3);
    assert.deepEqual(
        Array.from({ length: 5 }, () => one.share()),
        Array.from({ length: 5 }, () => other.share()),
    );
    const chance = new Chance(1);
    const counts = new Array(10).fill(0);
    for (let index = 0; index < 10000; ++index) ++counts[chance.below(10)];
    assert.ok(Math.min(...counts) > 850 && Math.max(...counts) < 1150, String(counts));
});

test("mutations are balanced, new, made of known modules, and repeatable", () => {
    for (const successor of ["F[+F]F[-F]F", "-YF+XFX+FY-", "!(w)F(s)[+(a)A(s*r)][-(b)A(s*q)]", "{-f+f}[F]", "F"]) {
        const alphabet = alphabetOf([successor]);
        const known = new Set([...alphabet, ...modulesOf(successor), "+", "-", "[", "]", "/", "\\", "&", "^"]);
        const all = new Set();
        for (let index = 0; index < 300; ++index) {
            const made = mutated(successor, alphabet, new Chance(5, index));
            assert.equal(made, mutated(successor, alphabet, new Chance(5, index)));
            if (made === null) continue;
            const modules = modulesOf(made);
            assert.notEqual(made, successor);
            assert.ok(isBalanced(modules), made);
            assert.ok(
                modules.every((module) => known.has(module)),
                made,
            );
            all.add(made);
        }
        assert.ok(all.size > (successor === "F" ? 2 : 5), `${successor}: ${all.size}`);
    }
    assert.equal(mutated("F[", ["F"], new Chance(1)), null);
});

test("a successor is replaced in its line only", () => {
    const text = "axiom: F\nF --> F+F : 0.5\nF --> F-F : 0.5\n";
    assert.equal(
        withSuccessor(text, { line: 3, successor: "F-F" }, "FF"),
        "axiom: F\nF --> F+F : 0.5\nF --> FF : 0.5\n",
    );
    assert.equal(withSuccessor("F<F>F --> F", { line: 1, successor: "F" }, "G"), "F<F>F --> G");
    assert.equal(withSuccessor("F --> F \\\n  +F", { line: 1, successor: "F" }, "G"), null);
    assert.equal(withSuccessor("F --> /* a */ F", { line: 1, successor: "F" }, "G"), null);
    assert.equal(withSuccessor("F --> F", { line: 9, successor: "F" }, "G"), null);
});

test("other angles and numbers stay near", () => {
    for (let index = 0; index < 200; ++index) {
        const chance = new Chance(2, index);
        const factor = otherAngle("angle factor", 6, chance);
        assert.ok(Number.isInteger(factor) && factor >= 3 && factor <= 12 && factor !== 6);
        assert.ok(Math.abs(otherAngle("angle increment", 25.7, chance) - 25.7) < 6);
        assert.match(otherNumber("0.75", chance), /^-?\d+(\.\d{1,2})?$/);
        assert.match(otherNumber("35", chance), /^\d+$/);
    }
});

const facts = {
    n: "4",
    seed: "3",
    is_random: true,
    cost: { most: "12" },
    defines: [{ name: "r", value: "0.5" }, { name: "word", value: "a*2" }],
    keys: [{ name: "angle factor", value: "4" }, { name: "axiom", value: "X" }],
    productions: [
        { line: 2, predecessor: "X", successor: "F+X" },
        { line: 3, predecessor: "F", successor: "FF" },
    ],
};
const pattern = { name: "a.lsys", text: "axiom: X\nX --> F+X\nF --> FF\n", variant: "", settings: [["r", "0.4"]] };

test("parameters are those that can be varied", () => {
    assert.deepEqual(
        parametersOf(facts).map(({ name }) => name),
        ["derivation length", "angle factor", "seed", "r"],
    );
    assert.deepEqual(
        parametersOf({ ...facts, keys: [{ name: "angle increment", value: "360/7" }] })[1].value,
        String(360 / 7),
    );
});

test("ranges lie about the value and within the budget", () => {
    const [n, angle, seed, r] = parametersOf(facts);
    assert.deepEqual(rangeOf(n, "5"), { from: 0, to: 5 });
    assert.deepEqual(rangeOf(r, ""), { from: 0.35, to: 0.65 });
    assert.deepEqual(valuesOf(n, 0, 5, 6), ["0", "1", "2", "3", "4", "5"]);
    assert.deepEqual(valuesOf(n, 1, 2, 6), ["1", "2"]);
    assert.deepEqual(valuesOf(r, 0.35, 0.65, 4), ["0.35", "0.45", "0.55", "0.65"]);
    assert.equal(rangeOf(angle, "").from, 3);
    assert.equal(rangeOf(seed, "").to, 8);
});

test("a sheet has a variant in each cell, and others near it", () => {
    const [n, , , r] = parametersOf(facts);
    const across = { parameter: r, values: ["0.3", "0.6"] };
    const down = { parameter: n, values: ["2", "6"] };
    const [first, ...others] = sheetVariants(pattern, across, down, 1, 0);
    assert.deepEqual(first.pattern.settings, [["r", "0.6"], ["derivation length", "2"]]);
    assert.ok(others.length > 0 && others.every(({ label }) => label !== first.label));
});

test("mutants keep what is kept, and come again", () => {
    const kept = new Set(["derivation length", "seed", "angle factor", "r", "production 1"]);
    for (let index = 0; index < 100; ++index) {
        const mutant = mutantOf(pattern, facts, kept, 9, index);
        assert.deepEqual(mutant, mutantOf(pattern, facts, kept, 9, index));
        if (!mutant) continue;
        assert.deepEqual(mutant.pattern.settings, pattern.settings);
        assert.match(mutant.pattern.text, /^axiom: X\nX --> .+\nF --> FF\n$/);
    }
    const all = new Set([...kept, "production 0"]);
    assert.equal(mutantOf(pattern, facts, all, 9, 0), null);
    assert.deepEqual(seedVariant(pattern, 3n, 2).pattern.settings, [["r", "0.4"], ["seed", "5"]]);
    assert.deepEqual(withSetting(pattern, "r", "1").settings, [["r", "1"]]);
});

test("a caption shows what has changed", () => {
    assert.deepEqual(changedPart("FFFFFF+F", "FFFFFF-F"), { before: "…FFF", changed: "-", after: "F" });
    assert.deepEqual(changedPart("F+F", "FF"), { before: "F", changed: "", after: "F" });
    assert.deepEqual(changedPart("F", "FXF"), { before: "F", changed: "XF", after: "" });
});
