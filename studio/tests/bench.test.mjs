// The kolam bench without a browser: its lines and symmetries agree with those of the libraries.
import assert from "node:assert/strict";
import { test } from "node:test";
import { anyBridge } from "./any_bridge.mjs";
import { load } from "./load.mjs";

const { makeGrid, statesText, parseStates, followLines, lineOrbits, countLines, crossed, crossedCells, joined, turned } =
    await load("bench/dot_grid");
const { roundedStrands } = await load("bench/rounded_lines");
const { symmetrised, isSymmetric, singleLineNear, symmetry_labels } = await load("bench/symmetry");
const { readKolam, withEditsOf, withLook, first_look, wordGrid, wordTitle } = await load("bench/kolam_text");
const { Rim, rim_names, rimIcon } = await load("bench/rims");
const { doubtsText, gapPlaces, readDoubts } = await load("bench/doubts");
const { dotFixes } = await load("bench/dot_fixes");
const { PhotographDots } = await load("bench/photograph_dots");
const { ground_names } = await load("bench/grounds");
const { Kolam } = await load("bench/kolam");
const { gapText, changeText, placeText, statesTold, neighbour } = await load("bench/gap_names");
const { placesAround } = await load("bench/board");
const { presets } = await load("bench/presets");
const { makeChance } = await load("sound/chance");
const { certificateText } = await load("bench/certificate");

const ask = await anyBridge();
const gridOf = (grid, more = {}) => makeGrid(ask({ do: "dots", grid, ...more }));

const straight = ["7x7", "1-3-5-7-5-3-1", "4x6", "1-5-3", "2-4-6-6-4-2", "15x15", "1x1", "1x9", "7 to 1 ner pulli", "15x9-9x3"];
const interlaced = ["5-3 idukku", "7-4", "15-8 idukku pulli", "2,1", "7x7 idukku", "1-2-7-6-5-6-7-2-1", "1-2-3-4"];
const free = [".o./ooo/.o.", "oooo/o..o/oooo", "oo..oo/oo..oo", "  o/ o o/o   o", "o o o/ o   o/o o o", "o/./o"];
const shapes = [...straight, ...interlaced, ...free];

/// States of gaps by chance, all three of them.
function random(grid, seed, density = 0.6) {
    const chance = makeChance(seed);
    const state = () => (chance() < density ? crossed : chance() < 0.5 ? joined : turned);
    return Uint8Array.from(grid.gaps, state);
}

function kolamOn(text) {
    const kolam = new Kolam();
    const grid = gridOf(text);
    kolam.set(grid, new Uint8Array(grid.gaps.length).fill(crossed));
    return kolam;
}

test("lines, strands and digits are those of the libraries, on every kind of grid", () => {
    for (const shape of shapes) {
        const grid = gridOf(shape);
        assert.equal(gridOf(grid.text).text, grid.text);
        for (let seed = 0; seed < 4; ++seed) {
            const states = random(grid, 10 * shape.length + seed, 0.25 * seed);
            const answer = ask({ do: "grid", grid: shape, gaps: statesText(states), strands: true });
            const { strands, lineOfArc } = followLines(grid, states);
            assert.equal(answer.lines, strands.length, shape);
            assert.equal(answer.grid, grid.text);
            assert.deepEqual(parseStates(grid, answer.gaps), states);
            const drawn = answer.strands.map((points) => points.flatMap(([x, level]) => [x, level * grid.rise]));
            const controls = roundedStrands(grid, states, { strands, lineOfArc });
            assert.deepEqual(controls.map((each) => each.length), drawn.map((each) => each.length), shape);
            const apart = drawn.flatMap((each, line) => each.map((value, i) => Math.abs(value - controls[line][i])));
            assert.ok(Math.max(...apart) < 1e-9, `${shape}: ${Math.max(...apart)}`);
            assert.deepEqual(lineOrbits(grid, states, { strands, lineOfArc }), answer.line_orbits);
            assert.ok(lineOfArc.every((line) => line >= 0));
            assert.equal(
                strands.reduce((sum, strand) => sum + strand.length / 2, 0),
                grid.sides * grid.dots.length,
            );
        }
        for (const { name, orbits } of grid.symmetries) {
            const states = symmetrised(orbits, random(grid, shape.length));
            const answer = ask({ do: "grid", grid: shape, gaps: statesText(states), strands: true });
            assert.deepEqual(lineOrbits(grid, states, followLines(grid, states)), answer.line_orbits, name);
        }
        assert.equal(countLines(grid, new Uint8Array(grid.gaps.length)), grid.dots.length);
    }
});

test("shaped rims are those of the libraries, on every kind of grid", () => {
    let shaped = 0;
    for (const shape of shapes) {
        const grid = gridOf(shape);
        for (const [seed, rim] of rim_names.entries()) {
            const states = seed === 2 ? new Uint8Array(grid.gaps.length).fill(crossed) : random(grid, 7 * shape.length + seed, 0.8);
            const answer = ask({ do: "grid", grid: shape, gaps: statesText(states), rim, strands: true });
            const made = new Rim(grid, states, rim);
            assert.equal(made.shaped, answer.shaped, `${shape} ${rim}`);
            shaped += made.shaped;
            const drawn = answer.strands.map((points) => points.flatMap(([x, level]) => [x, level * grid.rise]));
            const controls = roundedStrands(grid, states, followLines(grid, states), made);
            assert.deepEqual(controls.map((each) => each.length), drawn.map((each) => each.length), `${shape} ${rim}`);
            const apart = drawn.flatMap((each, line) => each.map((value, i) => Math.abs(value - controls[line][i])));
            assert.ok(Math.max(...apart) < 1e-8, `${shape} ${rim}: ${Math.max(...apart)}`);
        }
    }
    assert.ok(shaped > 100, String(shaped));
    assert.equal(new Set(rim_names.map(rimIcon)).size, rim_names.length);
});

test("centred dots are those of the libraries, and stay when the pattern is read again", () => {
    let found = 0;
    for (const [seed, shape] of shapes.entries()) {
        const grid = gridOf(shape);
        const states = random(grid, seed, 0.9);
        const request = { do: "grid", grid: shape, gaps: statesText(states), strands: true };
        const { text, centred } = ask({ ...request, centred: true });
        const cells = crossedCells(grid, states);
        assert.deepEqual(cells.map(({ x, level }) => [x, level]), centred, shape);
        assert.equal(readKolam(text).hasCentredDots, cells.length > 0, shape);
        assert.equal(readKolam(ask(request).text).hasCentredDots, false);
        found += cells.length;
    }
    assert.ok(found > 100, String(found));
});

test("a rim stays while gaps and dots change, and is written into the text", () => {
    const kolam = kolamOn("1-3-5-3-1");
    kolam.setRim("horn");
    assert.equal(kolam.shaped, 4);
    const text = (rim) => ask({ do: "grid", grid: "1-3-5-3-1", gaps: statesText(kolam.states), rim }).text;
    assert.match(text("horn"), /^\/\/ rim: horn$/m);
    assert.equal(readKolam(text("horn")).rim, "horn");
    assert.equal(readKolam(text("round")).rim, "round");
    assert.doesNotMatch(text("round"), /rim/);
    kolam.setStates(kolam.after(0, "next"));
    kolam.setGrid(gridOf("3-5-7-5-3"), false);
    assert.equal(kolam.rim, "horn");
    const library = "source: sikku kolam --grid '9 to 1 ner' --rim petal --seed 2\n// grid: 1\n// gaps: \n";
    assert.equal(readKolam(library).rim, "petal");
    assert.match(ask({ do: "grid", grid: "3x3", rim: "square" }).error.message, /expected round, pointed/);
});

test("words in dots: Latin and Tamil, lines, heights and refusals", () => {
    for (const word of [{ letters: "MEERA", rows: 12 }, { letters: "மீரா", rows: 10 }, { letters: "OM/SRI", rows: 7 }]) {
        const grid = gridOf(wordGrid(word));
        assert.ok(grid.gaps.length > 30 && !grid.isTriangular);
        const states = random(grid, 3);
        const { text } = ask({ do: "grid", grid: grid.text, gaps: statesText(states), title: wordTitle(word) });
        const made = withLook(text, first_look, word);
        const found = readKolam(made);
        assert.deepEqual(found.word, word);
        assert.equal(found.grid, grid.text);
        assert.deepEqual(parseStates(grid, found.gaps), states);
        assert.match(made, new RegExp(`^title: ${wordTitle(word)}$`, "m"));
        assert.ok(!ask({ do: "open", pattern: { name: "word.lsys", text: made } }).error);
    }
    assert.equal(readKolam(withLook(ask({ do: "grid", grid: "3x3" }).text, first_look)).word, null);
    assert.ok(ask({ do: "dots", grid: wordGrid({ letters: "A", rows: 4 }) }).error);
    assert.match(ask({ do: "dots", grid: wordGrid({ letters: "MEERA", rows: 60 }) }).error.message, /up to 1000 gaps/);
});

test("grounds and the hand become keys that the libraries read, and are read again", () => {
    const bare = ask({ do: "grid", grid: "3x3" }).text;
    for (const ground of ground_names) {
        const look = { ...first_look, ground, hand: 0.35 };
        const text = withLook(bare, look);
        const { hand, ...found } = readKolam(text);
        assert.deepEqual([found.ground, hand], [ground, 0.35]);
        const opened = ask({ do: "open", pattern: { name: "k.lsys", text } });
        assert.deepEqual(opened.warnings, [], ground);
        // Another choice replaces the line, whether the text before is known or not.
        for (const other of ground_names) {
            for (const made of [text, ""]) {
                const next = withEditsOf(text, made, withLook(bare, { ...first_look, ground: other }));
                assert.deepEqual([readKolam(next).ground, readKolam(next).hand], [other, 0], `${ground} ${other}`);
                assert.equal(next.match(/^ground:/gm).length, 1);
            }
        }
    }
    // A colour that the user wrote stays on plain earth, and a floor replaces it.
    const navy = bare.replace("ground: #7d3324", "ground: navy");
    assert.match(withEditsOf(navy, bare, withLook(bare, first_look)), /^ground: navy$/m);
    assert.match(withEditsOf(navy, bare, withLook(bare, { ...first_look, ground: "slate" })), /^ground: slate$/m);
});

test("doubtful gaps are those of the comment, and leave it when they are settled or change", () => {
    for (const shape of ["5x5", "7-4 idukku", "oooo/o..o/oooo"]) {
        const kolam = kolamOn(shape);
        const places = gapPlaces(kolam.grid);
        assert.equal(new Set(places).size, kolam.grid.gaps.length);
        kolam.doubts = new Set([0, 3, 5]);
        const text = doubtsText(kolam.grid, kolam.doubts);
        assert.deepEqual(readDoubts(`axiom: F\n${text}`), [places[0], places[3], places[5]]);
        kolam.setStates(kolam.after(3, "next"));
        assert.deepEqual([...kolam.doubts], [0, 5]);
        kolam.settle([5]);
        assert.deepEqual([...kolam.doubts], [0]);
        kolam.settle([0]);
        assert.equal(doubtsText(kolam.grid, kolam.doubts), "");
    }
    const grid = gridOf("15x15");
    const all = new Set(grid.gaps.keys());
    assert.equal(readDoubts(doubtsText(grid, all)).length, 200); // as many as the program lists
    assert.deepEqual(readDoubts("// doubtful gaps, as row,gap:\n// 1,2 3,4\n\nF\n"), ["1,2", "3,4"]);
    assert.deepEqual(readDoubts("axiom: F\n"), []);
});

test("doubts keep their gaps when dots are added", () => {
    const kolam = kolamOn("3x3");
    kolam.doubts = new Set([4]);
    const { x, level } = kolam.grid.gaps[4];
    kolam.setGrid(gridOf("3x3", { add: [[4, 0]] }), true);
    const [gap] = kolam.doubts;
    assert.deepEqual([kolam.doubts.size, kolam.grid.gaps[gap].x, kolam.grid.gaps[gap].level], [1, x - 1, level]);
});

test("neighbours of interlaced dots are one spacing away, as those of straight ones", () => {
    for (const shape of shapes) {
        const { dots, gaps, rise } = gridOf(shape);
        for (const { from, to } of gaps) {
            const [a, b] = [dots[from], dots[to]];
            assert.ok(Math.abs(Math.hypot(a.x - b.x, (a.level - b.level) * rise) - 2) < 1e-12, shape);
        }
    }
});

test("wrong grids are refused in the words of the library, and large ones before they are made", () => {
    const message = (grid) => ask({ do: "dots", grid }).error.message;
    for (const grid of ["", "0x4", "7x", "1-2-2", "a-b", "7 to 2 ner"]) assert.ok(message(grid).length > 20, grid);
    assert.match(message("1-2-2"), /row 3 of the grid has 2 dots and the row above it 2/);
    assert.match(message("15-8 pulls"), /unknown word 'pulls'/);
    assert.match(message("23x23"), /up to 1000 gaps/);
    assert.match(ask({ do: "grid", grid: "99x99" }).error.message, /up to 1000 gaps/);
});

test("the bench offers only grids that it takes", () => {
    const texts = presets.flatMap(([, options]) => options.map((each) => (typeof each === "string" ? each : each[1])));
    assert.ok(texts.length > 20);
    for (const text of texts) assert.ok(gridOf(text).gaps.length > 0, text);
    assert.equal(new Set(texts.map((text) => gridOf(text).text)).size, texts.length);
});

/// The pixels of a kolam with its dots, as a browser decodes them.
function photographed(grid, gaps, side = 700) {
    const { text } = ask({ do: "grid", grid, gaps });
    const pattern = { name: "photo.lsys", text: withLook(text, first_look) };
    const options = [["size", "100x100mm"]];
    const { json, bytes } = ask.whole({ do: "pixels", width: side, height: side, options, pattern });
    return { width: json.width, height: json.height, pixels: Uint8Array.from(bytes) };
}

test("the kolam of a photograph is read, with the picture as its grid is drawn", () => {
    for (const shape of ["5x5", "7-4 idukku"]) {
        const grid = gridOf(shape);
        const states = Uint8Array.from(random(grid, 5, 0.7), (state) => (state === joined ? turned : state));
        const { width, height, pixels } = photographed(grid.text, statesText(states));
        const request = { do: "read", width, height, source: "photo.png" };
        const { json: found, bytes } = ask.whole(request, pixels);
        assert.equal(found.grid, grid.text);
        assert.deepEqual(parseStates(grid, found.gaps), states);
        assert.deepEqual([found.doubtful, found.missing, found.readable], [[], [], 1]);
        assert.match(found.text, /^description: .*; read from photo\.png$/m);
        assert.equal(readKolam(found.text).grid, grid.text);
        const { picture } = found;
        assert.equal(bytes.length, 4 * picture.width * picture.height);
        const [x0, y0, x1, y1] = picture.box;
        // Where a dot is drawn, the picture shows rice flour, and earth in the corner of its field.
        const reach = Math.round(picture.width / 80); // interlaced patterns draw dots in the middles of fields
        const brightness = (x, y) => {
            const column = Math.floor(((x - x0) / (x1 - x0)) * picture.width);
            const row = Math.floor(((y1 - y) / (y1 - y0)) * picture.height);
            let most = 0;
            for (let dy = -reach; dy <= reach; ++dy) {
                for (let dx = -reach; dx <= reach; ++dx) {
                    const at = 4 * ((row + dy) * picture.width + column + dx);
                    most = Math.max(most, bytes[at] + bytes[at + 1] + bytes[at + 2]);
                }
            }
            return most;
        };
        for (const { x, level } of grid.dots) assert.ok(brightness(x, level * grid.rise) > 600, `${shape}: ${x} ${level}`);
        assert.ok(brightness(grid.dots[0].x, grid.dots[0].level * grid.rise + 3) < 300);
        if (grid.isTriangular) continue; // reading them again takes longer
        const fixed = ask({ ...request, fixes: ["1,1: join"] }, pixels);
        assert.equal(parseStates(grid, fixed.gaps)[0], joined);
        assert.match(ask({ ...request, grid: "9x9" }, pixels).error.message, /expected 81 dots/);
    }
});

test("dots added by hand are named as the program names them", () => {
    const dots = gridOf("3x3").dots;
    assert.deepEqual(dotFixes(dots, dots), []);
    assert.deepEqual(dotFixes(dots, [...dots, { x: 0, level: 4 }, { x: -4, level: 0 }, { x: 4, level: 4 }]),
        ["dot 0,2", "dot 3,0", "dot 1,5"]);
    assert.deepEqual(dotFixes(dots, dots.slice(1)), ["no dot 1,1"]);
    for (const [shape, change] of [
        ["5x5", { add: [[0, 6]] }], ["5-3 idukku", { add: [[-6, 0]] }],
    ]) {
        const grid = gridOf(shape);
        const wanted = gridOf(shape, change);
        const moved = wanted.dots.map(({ x, level }) => ({ x: x - wanted.moved.x, level: level - wanted.moved.level }));
        const { gaps } = ask({ do: "grid", grid: wanted.text, composed: true, seed: "3" });
        const { width, height, pixels } = photographed(wanted.text, gaps);
        const removed = dotFixes(wanted.dots, grid.dots.map(({ x, level }) => ({ x: x + wanted.moved.x, level: level + wanted.moved.level })));
        const smaller = ask({ do: "read", width, height, source: "x", fixes: removed }, pixels);
        assert.equal(smaller.grid, grid.text);
        const again = ask({ do: "read", width, height, source: "x", fixes: [...removed, ...dotFixes(grid.dots, moved)] }, pixels);
        assert.equal(again.grid, wanted.text);
        assert.equal(parseStates(wanted, again.gaps).length, wanted.gaps.length);
    }
});

test("a photograph lies only under its own kolam, not under others on the same grid", () => {
    const dots = new PhotographDots("read");
    assert.equal(dots.shift, null); // until the bench shows what was read
    const [older, read] = [{ text: "older" }, { text: "read" }];
    dots.show(read, false);
    assert.deepEqual(dots.shift, { x: 0, level: 0 });
    // Edited text with the same kolam keeps it, another kolam does not, and undo returns to both.
    const edited = { text: "edited" };
    dots.show(edited, true);
    assert.deepEqual(dots.shift, { x: 0, level: 0 });
    const chosen = { text: "chosen" };
    dots.leave();
    dots.keep(chosen);
    assert.equal(dots.shift, null);
    dots.follow(gridOf("3x3"), gridOf("3x3", { add: [[4, 0]] }));
    assert.equal(dots.shift, null);
    for (const pattern of [older, chosen]) {
        dots.show(pattern, false);
        assert.equal(dots.shift, null);
        dots.show(edited, false);
        assert.deepEqual(dots.shift, { x: 0, level: 0 });
    }
    const again = new PhotographDots("read");
    again.show(older, true);
    assert.equal(again.shift, null);
});

test("dots that come back to the same notation elsewhere keep their places in the photograph", () => {
    const dots = new PhotographDots("3x3");
    const first = gridOf("3x3");
    const patterns = [{ text: "3x3" }];
    dots.show(patterns[0], false);
    const edit = (grid, change) => {
        const edited = gridOf(grid.text, change);
        dots.follow(grid, edited);
        patterns.push({ text: edited.text }); // as all gaps are crossed, equal notations are equal texts
        dots.keep(patterns.at(-1));
        return edited;
    };
    let grid = first;
    const places = () => grid.dots.map(({ x, level }) => ({ x: x - dots.shift.x, level: level - dots.shift.level }));
    const right = () => Math.max(...grid.dots.map(({ x }) => x));
    const left = () => Math.min(...grid.dots.map(({ x }) => x));
    for (const level of [2, 0, -2]) grid = edit(grid, { add: [[right() + (grid === first ? 2 : 0), level]] });
    assert.equal(grid.text, "3x4");
    for (const level of [2, 0, -2]) grid = edit(grid, { remove: [[left(), level]] });
    assert.equal(grid.text, "3x3");
    assert.deepEqual(dots.shift, { x: -2, level: 0 });
    assert.deepEqual(places(), first.dots.map(({ x, level }) => ({ x: x + 2, level })));
    const fixes = dots.fixes(grid);
    assert.deepEqual(fixes, ["dot 1,4", "dot 2,4", "dot 3,4", "no dot 1,1", "no dot 2,1", "no dot 3,1"]);
    // Undo to the same notation, and redo.
    dots.show(patterns[0], true);
    assert.deepEqual(dots.shift, { x: 0, level: 0 });
    assert.deepEqual(dots.fixes(first), []);
    dots.show(patterns.at(-1), true);
    assert.deepEqual(dots.fixes(grid), fixes);
    // Further edits still count from the dots that were read.
    grid = edit(grid, { add: [[4, 0]] });
    assert.equal(dots.fixes(grid).filter((fix) => fix.startsWith("dot")).length, 4);
});

test("pictures without a kolam and wrong pixels are refused", () => {
    const read = (more, bytes) => ask({ do: "read", width: 100, height: 80, source: "x", ...more }, bytes).error;
    const blank = new Uint8Array(4 * 100 * 80).fill(200);
    assert.match(read({}, blank).message, /no kolam found/);
    for (const more of [{ width: 0 }, { height: 1e9 }, { width: 99 }, { width: 0.5 }, { fixes: [1] }]) {
        assert.equal(read(more, blank).kind, "request", JSON.stringify(more));
    }
    assert.ok(read({ part: "7" }, blank) && read({ grid: "x" }, blank) && read({ fixes: ["?"] }, blank));
    assert.ok(ask({ do: "read", width: 4, height: 4, source: "x" }, new Uint8Array(64)).error);
});

test("orbits: every gap of one changes together, and the drawing keeps its symmetry", () => {
    const names = (shape) => gridOf(shape).symmetries.map(({ name }) => name);
    for (const shape of ["7x7", "7-4 idukku", "oooo/o..o/oooo"]) {
        const grid = gridOf(shape);
        for (const { name, orbits } of grid.symmetries) {
            assert.ok(name in symmetry_labels);
            orbits.forEach((orbit, gap) => assert.ok(orbit.includes(gap)));
            const states = symmetrised(orbits, random(grid, 9));
            assert.ok(isSymmetric(orbits, states));
            const answer = ask({ do: "grid", grid: shape, symmetry: name, density: 0.5, joined: 0.5, seed: "3" });
            assert.ok(isSymmetric(orbits, parseStates(grid, answer.gaps)), name);
        }
    }
    assert.deepEqual(names("7x7"), ["D4", "C4", "mirrors", "diagonals", "C2", "mirror-x", "mirror-y", "diagonal", "none"]);
    assert.equal(names("15-8 idukku")[0], "D6");
    assert.deepEqual(names("4x6"), ["mirrors", "C2", "mirror-x", "mirror-y", "none"]);
    assert.deepEqual(names("1-2-3-4"), ["D3", "C3", "mirror-x", "none"]);
    assert.deepEqual(names("oo./ooo"), ["none"]);
    const largest = (shape) => gridOf(shape).symmetries[0].orbits.reduce((most, orbit) => Math.max(most, orbit.length), 0);
    assert.equal(largest("7x7"), 8);
    assert.equal(largest("15-8 idukku"), 12);
});

test("most gaps of an orbit decide, and crossings in a tie", () => {
    const orbit = [0, 1, 2, 3];
    const orbits = orbit.map(() => orbit);
    assert.deepEqual([...symmetrised(orbits, Uint8Array.of(2, 2, 2, 1))], [2, 2, 2, 2]);
    assert.deepEqual([...symmetrised(orbits, Uint8Array.of(0, 1, 1, 0))], [1, 1, 1, 1]);
    assert.deepEqual([...symmetrised(orbits, Uint8Array.of(0, 0, 2, 1))], [0, 0, 0, 0]);
});

test("clicks step through crossed, turned back and joined, and backwards", () => {
    const kolam = kolamOn("7-4 idukku");
    for (const [change, expected] of [["next", [turned, joined, crossed]], ["previous", [joined, turned, crossed]]]) {
        for (const state of expected) {
            kolam.setStates(kolam.after(5, change));
            assert.equal(kolam.states[5], state);
        }
    }
    kolam.setSymmetry("D6", true);
    kolam.setStates(kolam.after(0, joined));
    assert.equal(kolam.countOf(joined), kolam.orbits[0].length);
    assert.equal(kolam.count, ask({ do: "grid", grid: "7-4", gaps: statesText(kolam.states) }).lines);
});

test("another grid keeps the gaps that it shares with the old one, and the symmetry if it has it", () => {
    const kolam = kolamOn("7x7");
    kolam.setSymmetry("C4", true);
    kolam.setStates(kolam.after(0, "next"));
    assert.equal(kolam.countOf(crossed), 84 - kolam.orbits[0].length);
    kolam.setGrid(gridOf("9x9"), false);
    assert.equal(kolam.grid.text, "9x9");
    assert.equal(kolam.symmetry.name, "C4");
    assert.equal(kolam.countOf(crossed), 144 - kolam.orbits[0].length);
    kolam.setGrid(gridOf(kolam.resized(1, 0)), false);
    assert.equal(kolam.grid.text, "10x9");
    assert.equal(kolam.symmetry.name, "none");
    assert.equal(kolam.isChosen, false);
    assert.equal(kolam.countOf(crossed), 10 * 8 + 9 * 9 - 4);
    kolam.setGrid(gridOf("7-4 idukku"), false);
    assert.equal(kolam.countOf(crossed), kolam.grid.gaps.length);
    const before = kolam.after(3, joined);
    kolam.setStates(before);
    kolam.setGrid(gridOf("9-5 idukku"), false);
    assert.equal(kolam.countOf(joined), 1);
    kolam.setGrid(gridOf("7-4 idukku"), false);
    assert.deepEqual(kolam.states, before);
});

test("rows and columns can be added and removed", () => {
    const resized = (text, rows, columns) => {
        const next = kolamOn(text).resized(rows, columns);
        return next === null ? null : gridOf(next).text;
    };
    assert.equal(resized("5x7", 1, 0), "6x7");
    assert.equal(resized("5x7", 0, -1), "5x6");
    assert.equal(resized("1x5", -1, 0), null);
    assert.equal(resized("1-3-1", 0, 1), "3-5-3");
    assert.equal(resized("1-3-1", 0, -1), null);
    assert.equal(resized("1-3-1", 1, 0), "1-3-5-3-1");
    assert.equal(resized("7 to 3 ner", -1, 0), "5-7-5");
    assert.equal(resized("15-8 idukku", 0, 1), "16-9 idukku");
    assert.equal(resized("15-8 idukku", 1, 0), "15-7 idukku");
    assert.equal(resized("15-8 idukku", -1, 0), "15-9 idukku");
    assert.equal(resized("3-1 idukku", 1, 0), "4-1 idukku");
    assert.equal(resized("1-2-3", 1, 0), "1-2-3-4");
    assert.equal(resized("1-2-3", 0, 1), "2-3-4");
    assert.equal(resized("4,3", 1, 0), "4-3-2");
    assert.equal(resized("oooo/o..o/oooo", 1, 0), null);
    assert.equal(new Kolam().resized(1, 0), null);
});

test("dots are removed and added with their images, and the other gaps stay as they are", () => {
    const kolam = kolamOn("5x5");
    kolam.setStates(random(kolam.grid, 4));
    const [old, states] = [kolam.grid, kolam.states];
    const edited = gridOf("5x5", { remove: [[0, 0]] });
    assert.equal(edited.text, "ooooo/ooooo/oo.oo/ooooo/ooooo");
    assert.equal(edited.isSolid, false);
    kolam.setGrid(edited, true);
    for (const [i, gap] of kolam.grid.gaps.entries()) {
        const before = old.gaps.findIndex(({ x, level }) => x === gap.x && level === gap.level);
        assert.equal(kolam.states[i], states[before]);
    }
    assert.equal(gridOf(edited.text, { add: [[0, 0]] }).text, "5x5");
    assert.equal(gridOf("5x5", { remove: [[-4, 4]], symmetry: "C4" }).text, "3-5-5-5-3");
    assert.equal(gridOf("5x5", { remove: [[-4, 2]], symmetry: "D4" }).dots.length, 17);
    // A dot beside the grid moves its middle.
    const wider = gridOf("3x3", { add: [[4, 0]] });
    assert.deepEqual([wider.text, wider.moved], ["ooo/oooo/ooo", { x: -1, level: 0 }]);
    const interlaced = gridOf("7-4 idukku", { remove: [[0, 0]], symmetry: "D6" });
    assert.equal(interlaced.dots.length, 36);
    assert.equal(interlaced.isTriangular, true);
    assert.equal(gridOf(interlaced.text).text, interlaced.text);
    assert.match(ask({ do: "dots", grid: "1x1", remove: [[0, 0]] }).error.message, /last one stays/);
    for (const place of [[1, 0], [0, 1], [0.5, 0], [1e9, 0], ["0", 0], [0]]) {
        assert.ok(ask({ do: "dots", grid: "3x3", add: [place] }).error, String(place));
    }
});

test("places for dots surround the grid and contain it", () => {
    for (const shape of shapes) {
        const grid = gridOf(shape);
        const places = placesAround(grid);
        const known = new Set(places.map(({ x, level }) => `${x} ${level}`));
        assert.equal(known.size, places.length);
        for (const { x, level } of grid.dots) assert.ok(known.has(`${x} ${level}`), shape);
        // The library accepts every one of them.
        for (const { x, level } of places.filter((_, i) => i % 17 === 0)) {
            assert.ok(!ask({ do: "dots", grid: shape, add: [[x, level]] }).error, `${shape}: ${x} ${level}`);
        }
    }
    assert.equal(placesAround(gridOf("3x3")).length, 25);
});

test("gaps and places are described in words, and the keys reach every gap", () => {
    const kolam = kolamOn("3x4");
    assert.equal(gapText(kolam, 2), "Gap between row 1 dot 3 and row 1 dot 4: crossed; 1 line");
    assert.match(changeText(kolam, 2, "next"), /^Turn back: 1 → 2 lines$/);
    assert.match(changeText(kolam, 2, "previous"), /^Join: /);
    assert.equal(changeText(kolam, 2, crossed), "The gap is crossed");
    kolam.setStates(kolam.after(0, joined));
    assert.equal(statesTold(kolam), "16 gaps crossed, 1 joined");
    assert.equal(placeText(kolam, kolam.grid.dots[5]), "Row 2 dot 2: remove the dot");
    assert.equal(placeText(kolam, { x: 9, level: 0 }), "No dot here: add one");
    for (const shape of ["3x4", "7-4 idukku", "oooo/o..o/oooo", "oo..oo/oo..oo"]) {
        const { gaps } = gridOf(shape);
        const reached = new Set([0]);
        const queue = [0];
        for (const gap of queue) {
            for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
                const next = neighbour(gaps, gap, dx, dy, gaps[gap].x);
                if (!reached.has(next)) {
                    reached.add(next);
                    queue.push(next);
                }
            }
        }
        assert.equal(reached.size, gaps.length);
    }
});

test("one line with a rotation, near to what is drawn", () => {
    for (const [shape, name] of [["7x7", "C4"], ["7-4 idukku", "C6"], ["9-5 idukku", "C3"]]) {
        const grid = gridOf(shape);
        const { orbits } = grid.symmetries.find((each) => each.name === name);
        const found = singleLineNear(grid, orbits, symmetrised(orbits, random(grid, 4)), makeChance(1));
        assert.equal(ask({ do: "grid", grid: shape, gaps: statesText(found) }).lines, 1);
        assert.ok(isSymmetric(orbits, found));
    }
});

test("the libraries say which symmetries a single line can have", () => {
    const obstacle = (shape, name) => gridOf(shape).symmetries.find((each) => each.name === name).obstacle;
    assert.match(obstacle("7x7", "D4"), /C4 is the most/);
    assert.equal(obstacle("7x7", "C4"), undefined);
    assert.match(obstacle("6x6", "C4"), /a dot in its middle/);
    assert.match(obstacle("oo..oo/oo..oo", "none"), /2 groups/);
    const answer = ask({ do: "grid", grid: "7x7", symmetry: "D4", single_line: true });
    assert.equal(answer.obstacle, obstacle("7x7", "D4"));
});

test("composed kolams on straight dots connect all", () => {
    for (const grid of ["9x9", "1-3-5-7-5-3-1"]) {
        const answer = ask({ do: "grid", grid, density: 0.1, composed: true, seed: "2" });
        const { dots, gaps } = gridOf(grid);
        const states = parseStates(gridOf(grid), answer.gaps);
        const piece = dots.map((_, i) => i);
        const find = (i) => (piece[i] === i ? i : find(piece[i]));
        gaps.forEach(({ from, to }, i) => states[i] === crossed && (piece[find(from)] = find(to)));
        assert.equal(new Set(dots.map((_, i) => find(i))).size, 1);
    }
});

test("a 15 x 15 grid is followed within a millisecond", () => {
    for (const shape of ["15x15", "15-8 idukku"]) {
        const grid = gridOf(shape);
        const states = random(grid, 1);
        let least = Infinity; // the minimum, to ignore other load on the machine
        for (let i = 0; i < 200; ++i) {
            const begin = performance.now();
            followLines(grid, states);
            least = Math.min(least, performance.now() - begin);
        }
        assert.ok(least < 1, `${least} ms`);
    }
});

test("a pattern's text is read again, on every kind of grid", () => {
    for (const shape of shapes) {
        const grid = gridOf(shape);
        const states = random(grid, 2);
        const { text } = ask({ do: "grid", grid: grid.text, gaps: statesText(states), coloured: true });
        const found = readKolam(text);
        assert.equal(found.grid, grid.text);
        assert.deepEqual(parseStates(gridOf(found.grid), found.gaps), states);
        assert.equal(found.isColoured, countLines(grid, states) > 1);
        assert.equal(found.hasDots, false);
        assert.equal(readKolam(withLook(text, { ...first_look, hasDots: true })).hasDots, true);
        const filled = withLook(text, { ...first_look, hasDots: false, isFilled: true });
        assert.deepEqual([readKolam(filled).hasDots, readKolam(filled).isFilled], [false, true]);
    }
    const text = ask({ do: "grid", grid: "oooo/o..o/oooo" }).text;
    assert.match(text, /^title: Kolam on 10 dots\ndescription: 10 dots, \d+ of 10 gaps crossed, \d+ lines?\n/);
    assert.equal(readKolam("title: Koch\naxiom: F\n"), null);
    assert.equal(parseStates(gridOf("1-3-1"), "11"), null);
    assert.equal(parseStates(gridOf("1x3"), "13"), null);
});

test("older patterns name the grid in their title", () => {
    const text = (grid, crossings) =>
        `title: Kolam on ${grid} dots\ndescription: dots\n// crossings: ${crossings}\n\naxiom: F\n`;
    const found = readKolam(text("1-3-1", "1 0 1 1"));
    assert.equal(gridOf(found.grid).text, gridOf("1-3-1").text);
    assert.deepEqual([...parseStates(gridOf(found.grid), found.gaps)], [1, 0, 1, 1]);
    assert.deepEqual(gridOf(readKolam(text("5-3", "1")).grid).rows, [5, 3]);
    assert.equal(gridOf(readKolam(text("7x7", "1")).grid).text, "7x7");
});

test("what was edited in a pattern stays", () => {
    const bare = ask({ do: "grid", grid: "1-3-1", gaps: "1011" }).text;
    const navy = bare.replace("#7d3324", "navy");
    assert.notEqual(navy, bare);
    assert.equal(withEditsOf(withLook(navy, { ...first_look, isFilled: true }), "", bare), navy);
    const edited = navy + "tempo: 90\n";
    assert.equal(withEditsOf(edited, bare, bare), edited);
    assert.equal(withEditsOf(edited, "", bare), edited);
});

test("the command that made a kolam leaves its text with the first edit", () => {
    const bare = (rim) => ask({ do: "grid", grid: "1-3-5-3-1", rim }).text;
    for (const command of ["sikku kolam --grid 5xfill --rim horn --seed 0", "sikku kolam --grid '5-3 idukku' --rim horn"]) {
        const line = `source: ${command}`;
        const written = bare("round").replace(/^title: .*$/m, (title) => `${title}\n${line}`);
        assert.equal(readKolam(written).rim, "horn"); // as in the kolam library, without a comment
        for (const made of ["", bare("round")]) {
            const edited = withEditsOf(written, made, bare("round"));
            assert.doesNotMatch(edited, /^source:/m);
            assert.equal(readKolam(edited).rim, "round");
            assert.equal(readKolam(withEditsOf(written, made, bare("petal"))).rim, "petal");
        }
        assert.equal(readKolam(`${bare("round")}${line}\n`).rim, "round"); // kept by an earlier bench
    }
    const told = `${bare("round")}source: my grandmother\n`;
    assert.equal(withEditsOf(told, "", bare("round")), told);
});

test("the certificate is a sentence", () => {
    const found = { kolam: true, faults: [], lines: 1, open_lines: 0, symmetry: "D4", dots: Array(49), loose_dots: 0 };
    assert.equal(certificateText(found), "One closed line around 49 dots; symmetry D4.");
    assert.equal(certificateText({ ...found, lines: 3, symmetry: "" }), "3 closed lines around 49 dots; no symmetry.");
});
