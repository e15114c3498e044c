// The kolam bench without a browser: its grids, lines and symmetries agree with those of the libraries.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { load } from "./load.mjs";
import { loadBridge } from "./load_bridge.mjs";

const { parseGrid, gridText, crossingsText, parseCrossings, followLines, countLines, joinsTwoLines } =
    await load("bench/dot_grid");
const { gapOrbits, hasSymmetry, symmetrised, singleLineNear, symmetries } = await load("bench/symmetry");
const { readKolam, withEditsOf, withDots, kolamTitle } = await load("bench/kolam_text");
const { Kolam } = await load("bench/kolam");
const { gapText, changeText, neighbour } = await load("bench/gap_names");
const { makeChance } = await load("sound/chance");
const { certificateText } = await load("bench/certificate");

const shapes = ["7x7", "1-3-5-7-5-3-1", "4x6", "1-5-3", "2-4-6-6-4-2", "15x15", "1x1", "1x9"];

function random(grid, seed, density = 0.7) {
    const chance = makeChance(seed);
    return Uint8Array.from(grid.gaps, () => (chance() < density ? 1 : 0));
}

test("lines without crossings are one for each dot, and every arc belongs to one line", () => {
    for (const shape of shapes) {
        const grid = parseGrid(shape);
        assert.equal(gridText(grid), shape);
        assert.equal(countLines(grid, new Uint8Array(grid.gaps.length)), grid.dots.length);
        const { strands, lineOfArc } = followLines(grid, random(grid, 3));
        assert.ok(lineOfArc.every((line) => line >= 0));
        assert.equal(
            strands.reduce((sum, strand) => sum + strand.length / 2, 0),
            4 * grid.dots.length,
        );
    }
});

test("changing a gap between two lines makes one of them; any other change leaves as many or one more", () => {
    const grid = parseGrid("6x5");
    for (let seed = 0; seed < 20; ++seed) {
        const states = random(grid, seed);
        const lines = followLines(grid, states);
        grid.gaps.forEach((_, gap) => {
            const after = states.slice();
            after[gap] = 1 - after[gap];
            const change = countLines(grid, after) - lines.strands.length;
            if (joinsTwoLines(grid, states, lines, gap)) assert.equal(change, -1);
            else assert.ok(change === 0 || change === 1);
        });
    }
});

test("wrong grids are refused in words", () => {
    for (const text of ["", "7", "0x4", "7x", "1-2-3", "99x99", "a-b"]) {
        if (text === "7") assert.equal(gridText(parseGrid(text)), "1x7");
        else assert.throws(() => parseGrid(text), /rows|Rows|at most/);
    }
});

test("orbits: every gap of one changes together, and the drawing keeps its symmetry", () => {
    const grid = parseGrid("7x7");
    for (const { name } of symmetries) {
        assert.ok(hasSymmetry(grid, name));
        const orbits = gapOrbits(grid, name);
        orbits.forEach((orbit, gap) => assert.ok(orbit.includes(gap)));
        const states = symmetrised(orbits, random(grid, 9));
        for (const orbit of orbits) assert.equal(new Set(orbit.map((gap) => states[gap])).size, 1);
    }
    assert.equal(
        gapOrbits(grid, "D4").reduce((most, orbit) => Math.max(most, orbit.length), 0),
        8,
    );
    assert.equal(hasSymmetry(parseGrid("4x6"), "C4"), false);
    assert.equal(hasSymmetry(parseGrid("1-3-5"), "mirror-y"), false);
});

test("another grid keeps the gaps that it shares with the old one, and the symmetry if it has it", () => {
    const kolam = new Kolam("7x7");
    kolam.setSymmetry("C4");
    kolam.setStates(kolam.after(0));
    assert.equal(kolam.crossings, 84 - kolam.orbits[0].length);
    kolam.setGrid(parseGrid("9x9"));
    assert.equal(gridText(kolam.grid), "9x9");
    assert.equal(kolam.symmetry, "C4");
    assert.equal(kolam.crossings, 144 - kolam.orbits[0].length);
    kolam.setGrid(kolam.resized(1, 0));
    assert.equal(gridText(kolam.grid), "10x9");
    assert.equal(kolam.symmetry, "none");
    assert.equal(new Kolam("1x5").resized(-1, 0), null);
    assert.equal(gridText(new Kolam("1-3-1").resized(0, 1)), "3-5-3");
    assert.equal(new Kolam("1x1").count, 1);
});

test("gaps are described in words, and the keys reach every gap", () => {
    const kolam = new Kolam("3x4");
    assert.equal(gapText(kolam, 2), "Gap between row 1 dot 3 and row 1 dot 4: crossed; 1 line");
    assert.match(changeText(kolam, 2), /^Turn back: 1 → 2 lines$/);
    const reached = new Set([0]);
    const queue = [0];
    for (const gap of queue) {
        for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
            const next = neighbour(kolam.grid, gap, dx, dy, kolam.grid.gaps[gap].x);
            if (!reached.has(next)) {
                reached.add(next);
                queue.push(next);
            }
        }
    }
    assert.equal(reached.size, kolam.grid.gaps.length);
});

test("one line with a quarter turn, near to what is drawn", () => {
    const grid = parseGrid("7x7");
    const orbits = gapOrbits(grid, "C4");
    const found = singleLineNear(grid, orbits, symmetrised(orbits, random(grid, 4)), makeChance(1));
    assert.equal(countLines(grid, found), 1);
    for (const orbit of orbits) assert.equal(new Set(orbit.map((gap) => found[gap])).size, 1);
});

test("a 15 x 15 grid is followed within a millisecond", () => {
    const grid = parseGrid("15x15");
    const states = random(grid, 1);
    let least = Infinity; // the minimum, to ignore other load on the machine
    for (let i = 0; i < 200; ++i) {
        const begin = performance.now();
        followLines(grid, states);
        least = Math.min(least, performance.now() - begin);
    }
    assert.ok(least < 1, `${least} ms`);
});

test("a pattern's text is read again, and keeps what was edited in it", () => {
    const grid = parseGrid("1-3-1");
    const states = random(grid, 2);
    const text = (ground) =>
        `title: ${kolamTitle(grid)}\ndescription: 5 dots\n// crossings: ${crossingsText(grid, states)}\n\n`
        + `axiom: FF \\\n    FF\n\nground: ${ground}\nline: spline\n`;
    const found = readKolam(text("#7d3324"));
    assert.equal(gridText(found.grid), "1-3-1");
    assert.deepEqual([...found.states], [...states]);
    assert.equal(found.hasDots, false);
    const dotted = withDots(text("navy"), true);
    assert.equal(readKolam(dotted).hasDots, true);
    assert.equal(withEditsOf(dotted, "", text("#7d3324")), text("navy"));
    assert.equal(readKolam("title: Koch\naxiom: F\n"), null);
    assert.equal(parseCrossings(grid, "11"), null);
    const edited = text("navy") + "tempo: 90\n";
    assert.equal(withEditsOf(edited, text("#7d3324"), text("#7d3324")), text("navy") + "tempo: 90\n");
    assert.equal(withEditsOf(edited, "", text("#7d3324")), text("navy") + "tempo: 90\n");
});

test("the certificate is a sentence", () => {
    const found = { kolam: true, faults: [], lines: 1, open_lines: 0, symmetry: "D4", dots: Array(49), loose_dots: 0 };
    assert.equal(certificateText(found), "One closed line around 49 dots; symmetry D4.");
    assert.equal(certificateText({ ...found, lines: 3, symmetry: "" }), "3 closed lines around 49 dots; no symmetry.");
});

const folder = join(dirname(fileURLToPath(import.meta.url)), "../../build/studio");
const isBuilt = existsSync(join(folder, "sikku-bridge.wasm")) && existsSync(join(folder, "sikku-bridge.cjs"));

test(
    "grids, gaps, orbits, strands and counts are those of the libraries",
    { skip: !isBuilt && "not built" },
    async () => {
        const bridge = await loadBridge();
        for (const shape of shapes) {
            const grid = parseGrid(shape);
            for (const { name } of symmetries) {
                if (!hasSymmetry(grid, name) || grid.gaps.length === 0) continue;
                const states = symmetrised(gapOrbits(grid, name), random(grid, shape.length));
                const answer = JSON.parse(
                    bridge(
                        JSON.stringify({
                            do: "grid",
                            grid: shape,
                            crossings: crossingsText(grid, states),
                            symmetry: name,
                        }),
                    ).json,
                );
                const { strands } = followLines(grid, states);
                assert.equal(answer.lines, strands.length, shape);
                assert.equal(answer.crossings, crossingsText(grid, states));
                assert.deepEqual(
                    answer.dots,
                    grid.dots.map(({ x, y }) => [x, y]),
                );
                assert.deepEqual(
                    answer.gaps.map(({ from, to }) => [from, to]),
                    grid.gaps.map(({ from, to }) => [from, to]),
                );
                assert.deepEqual(
                    answer.strands.map((points) => points.flat()),
                    strands,
                );
                const orbits = gapOrbits(grid, name);
                answer.gaps.forEach((gap, i) =>
                    answer.gaps.forEach((other, j) => {
                        if (j > i && (j - i) % 7 === 1)
                            assert.equal(gap.orbit === other.orbit, orbits[i] === orbits[j]);
                    }),
                );
            }
        }
    },
);
