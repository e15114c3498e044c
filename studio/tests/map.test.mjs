// Coordinates, cameras, flights and tiles of the map, computed without losing digits.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { load } from "./load.mjs";

const { readExact, exactText, grouped, exactOf, numberOf, wholes } = await load("decimal");
const { pointAt, cameraWith, pixelOf, fitting, windowOf, panned } = await load("camera");
const { flight } = await load("flight");
const { tileGrid, seenTiles, tileBox, tileWindow, tileName, levelScale } = await load("tiles");
const { Recent } = await load("recent");
const { sheetOf, laidOut, cameraOfSheet } = await load("sheet");
const { pageOptions, planeOptions, modelOptions, thumbnailOptions, offered } = await load("option_scopes");
const help = {
    sizes: { a3: [297, 420], a4: [210, 297] },
    keys: [{ name: "seed", owner: "engine" }],
    draw: {
        options: [
            { name: "size", scope: "page" },
            { name: "fit", scope: "framing", sets_scale: true },
            { name: "step", scope: "scale", sets_scale: true },
            { name: "rotate", scope: "turn" },
            { name: "dots", scope: "kolam" },
            { name: "dot-spacing", scope: "kolam", sets_scale: true },
            { name: "stroke", scope: "look", group: "Style" },
            { name: "spot", scope: "press" },
            { name: "seed", scope: "other" },
            { name: "budget", scope: "cost" },
        ],
    },
};

test("decimal texts are read and written without loss", () => {
    for (const text of ["0", "1", "-1", "0.5", "-0.25", "1152921504606846975", "-123456789012345678901234567890.125"]) {
        assert.equal(exactText(readExact(text)), text);
    }
    assert.equal(exactText(readExact("3e18")), "3000000000000000000");
    assert.equal(exactText(readExact("-2.5e-3")), "-0.0025");
    assert.equal(exactText(readExact(" +007.50 ")), "7.5");
    assert.equal(exactText(readExact(".5")), "0.5");
    assert.equal(exactText(readExact("\u22121\u202f234")), "-1234");
    for (const text of ["", "-", ".", "abc", "1.2.3", "1e", "0x10", "1e99999", "9".repeat(6000)]) {
        assert.equal(readExact(text), null, text.slice(0, 20));
    }
});

test("texts are rounded to so many decimals", () => {
    assert.equal(exactText(readExact("1.2345"), 2), "1.23");
    assert.equal(exactText(readExact("-1.235"), 2), "-1.24");
    assert.equal(exactText(readExact("-0.001"), 2), "0");
    assert.equal(exactText(readExact("0.999"), 1), "1");
    assert.equal(grouped("-1234567.125"), "\u22121\u202f234\u202f567.125");
});

test("doubles become exact and come back", () => {
    for (const value of [0, 1, -1, 0.1, -1 / 3, 2 ** 60, 2 ** -40, 1e15 + 0.5, 1.5e300, -123.456e10]) {
        assert.equal(numberOf(exactOf(value)), value);
    }
    assert.equal(exactText(exactOf(0.5)), "0.5");
    assert.equal(exactText(exactOf(1e18)), "1000000000000000000");
    assert.throws(() => exactOf(NaN));
    assert.equal(wholes(readExact("-0.5"), readExact("1")), -1n);
    assert.equal(wholes(readExact("2"), readExact("1")), 2n);
});

const size = { width: 1000, height: 600 };

test("the point under the pointer stays while zooming 10^15-fold in and out", () => {
    let camera = { x: readExact("384307168202282325.333"), y: readExact("-1152921504606846900"), scale: 2 ** 50 };
    const start = camera;
    const point = pointAt(camera, size, 123, 456);
    for (let step = 0; step < 50; ++step) camera = cameraWith(point, size, 123, 456, camera.scale / 2);
    const at = pixelOf(camera, size, point.x, point.y);
    assert.ok(Math.hypot(at.left - 123, at.top - 456) < 1e-9);
    for (let step = 0; step < 50; ++step) camera = cameraWith(point, size, 123, 456, camera.scale * 2);
    assert.deepEqual(camera, start);
});

test("a pan by pixels is a pan by steps, however far out", () => {
    const camera = panned({ x: readExact("1e30"), y: 0n, scale: 0.25 }, -4, 8);
    assert.equal(exactText(camera.x), "1000000000000000000000000000001");
    assert.equal(exactText(camera.y), "2");
});

test("a drawing is fitted into the view", () => {
    const camera = fitting(["-10", "0", "10", "5"], size, 100);
    assert.equal(camera.scale, 20 / 800);
    assert.equal(exactText(camera.x), "0");
    assert.equal(exactText(camera.y), "2.5");
    assert.equal(fitting(["1", "0", "0", "1"], size, 10), null);
    assert.equal(fitting(["a", "0", "0", "1"], size, 10), null);
    assert.ok(fitting(["3", "3", "3", "3"], size, 10).scale > 0);
    assert.deepEqual(windowOf({ x: readExact("1"), y: readExact("2"), scale: 0.01 }, size), ["-4", "-1", "6", "5"]);
});

test("a flight keeps to both its ends and moves evenly", () => {
    const from = { x: readExact("0"), y: readExact("576460752303423488"), scale: 2 ** 51 };
    const to = { x: readExact("-1152921504606846000.5"), y: readExact("384307168202282325.25"), scale: 0.05 };
    const at = flight(from, to);
    assert.deepEqual(at(1), to);
    const first = at(0);
    assert.ok(Math.abs(numberOf(first.x - from.x) / from.scale) < 1e-6, "starts where it is");
    let before = at(0.99);
    for (let share = 0.991; share < 1; share += 0.001) {
        const camera = at(share);
        const seen = pixelOf(camera, size, to.x, to.y);
        assert.ok(Math.abs(seen.left) < 1e6 && Math.abs(seen.top) < 1e6);
        assert.ok(camera.scale < before.scale);
        before = camera;
    }
    const last = pixelOf(at(1 - 1e-12), size, to.x, to.y);
    assert.ok(Math.hypot(last.left - 500, last.top - 300) < 1, "arrives without a jump");
    assert.equal(exactText(flight(to, { ...to, x: readExact("0") })(0.5).x), "-576460752303423000.25");
});

test("tiles cover the view, share their edges, and are found again", () => {
    const grid = tileGrid(1.5);
    assert.equal(grid.side, 768);
    for (const scale of [1, 0.37, 2 ** -20, 3.3e14]) {
        const camera = { x: readExact("987654321987654321.75"), y: readExact("-55"), scale: scale * 1.2 };
        const tiles = seenTiles(camera, size, grid, scale);
        const boxes = tiles.map((tile) => tileBox(tile, camera, size, grid));
        assert.ok(
            Math.min(...boxes.map((box) => box.left)) <= 0 && Math.max(...boxes.map((box) => box.right)) >= size.width,
        );
        assert.ok(
            Math.min(...boxes.map((box) => box.top)) <= 0 && Math.max(...boxes.map((box) => box.bottom)) >= size.height,
        );
        const one = tiles[0];
        const next = tileWindow({ ...one, column: one.column + 1n }, grid);
        assert.equal(tileWindow(one, grid)[2], next[0]);
        assert.equal(new Set(tiles.map(tileName)).size, tiles.length);
    }
    assert.equal(levelScale(0.3), 0.25);
    assert.deepEqual(seenTiles({ x: 0n, y: 0n, scale: 1e6 }, size, grid, 1), [], "not thousands of them");
});

test("the cache keeps the pictures used last", () => {
    const closed = [];
    const cache = new Recent(100);
    for (const name of ["a", "b", "c"]) cache.add(name, { bytes: 40, close: () => closed.push(name) });
    assert.deepEqual(closed, ["a"]);
    cache.get("b");
    cache.add("d", { bytes: 40, close: () => closed.push("d") });
    assert.deepEqual(closed, ["a", "c"]);
    cache.add("large", { bytes: 1000, close: () => closed.push("large") });
    assert.equal(cache.count, 1);
    assert.equal(cache.bytes, 1000);
});

test("pages have the sizes of the program", () => {
    assert.deepEqual(sheetOf(help, []), { width: 210, height: 297, margin: 10, name: "A4, 210 × 297 mm" });
    assert.equal(sheetOf(help, [["size", "a3"], ["landscape", "true"]]).width, 420);
    assert.equal(sheetOf(help, [["size", "20cmx30cm"]]).height, 300);
    assert.equal(sheetOf(help, [["size", "300x200mm"], ["landscape", "true"]]).width, 300);
    assert.equal(sheetOf(help, [["size", "12x18in"], ["margin", "1cm"]]).margin, 10);
    assert.equal(sheetOf(help, [["size", "nonsense"]]).width, 210);
});

test("options are selected by their scopes", () => {
    const names = (options) => options.map(([name]) => name);
    const all = help.draw.options.map(({ name }) => [name, ""]);
    all.push(["r", "0.5"]); // a define of the pattern
    const selected = { page: pageOptions, plane: planeOptions, model: modelOptions, thumbnail: thumbnailOptions };
    assert.deepEqual(Object.fromEntries(Object.entries(selected).map(([kind, of]) => [kind, names(of(help, all))])), {
        page: ["size", "step", "rotate", "dots", "dot-spacing", "stroke", "budget", "r"],
        plane: ["dots", "stroke", "budget", "r"],
        model: ["stroke", "budget", "r"],
        thumbnail: ["rotate", "dots", "stroke", "r"],
    });
    assert.deepEqual(offered(help, help.draw.options).map(({ name }) => name), [
        "size", "step", "rotate", "dots", "dot-spacing", "spot",
    ]);
});

test("the plane lies as the drawing does on the page", () => {
    const facts = {
        extent: ["0", "0", "31", "31"],
        is_spatial: false,
        keys: [{ name: "stroke", value: "1 step red" }],
    };
    const sheet = sheetOf(help, [["size", "100x100mm"]]);
    const laid = laidOut(sheet, size);
    const camera = cameraOfSheet(sheet, laid, size, facts, help, []);
    const low = pixelOf(camera, size, readExact("-0.5"), readExact("31.5"));
    assert.ok(Math.abs(low.left - (laid.left + laid.width / 10)) < 1e-9);
    assert.ok(Math.abs(low.top - (laid.top + laid.height / 10)) < 1e-9);
    assert.equal(cameraOfSheet(sheet, laid, size, facts, help, [["rotate", "30"]]), null);
});

// Uses the libraries, if they have been built.
const built = join(dirname(fileURLToPath(import.meta.url)), "../../build/studio/sikku-bridge.wasm");
test(
    "tiles join without a seam",
    { skip: existsSync(built) ? false : "the libraries have not been built" },
    async () => {
        const { loadBridge } = await import("../load_bridge.mjs");
        const bridge = await loadBridge();
        const text =
            "derivation length: 60\nangle factor: 4\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\n" +
        "stroke: 0.3 step #f2e6cf\n";
        const grid = tileGrid(1);
        const side = grid.side;
        for (const scale of [0.11, 3, 2 ** 45]) {
            const tile = {
                scale,
                column: BigInt(Math.floor(-3e17 / (side * scale))),
                row: BigInt(Math.floor(5e17 / (side * scale))),
            };
            const next = { ...tile, column: tile.column + 1n };
            const [x0, y0, , y1] = tileWindow(tile, grid);
            const [, , x1] = tileWindow(next, grid);
            const pixels = (width, window) =>
                bridge(
                    JSON.stringify({
                        do: "pixels",
                        width,
                        height: side,
                        window,
                        pattern: { name: "hilbert.lsys", text },
                    }),
                ).bytes;
            const both = pixels(2 * side, [x0, y0, x1, y1]);
            for (const [index, each] of [tile, next].entries()) {
                const bytes = pixels(side, tileWindow(each, grid));
                for (let row = 0; row < side; ++row) {
                    const from = (2 * row + index) * side * 4;
                    assert.ok(
                        Buffer.compare(
                            bytes.subarray(row * side * 4, (row + 1) * side * 4),
                            both.subarray(from, from + side * 4),
                        ) === 0,
                        `scale ${scale}, row ${row}`,
                    );
                }
            }
        }
    },
);
