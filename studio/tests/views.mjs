// Tests of the map, of space and of variations in the built page, in headless Chromium, and with --measure their times:
//     node tests/views.mjs [PAGE] [--measure]
import assert from "node:assert/strict";
import { parseArgs } from "node:util";
import { addressOf, close, launch, openWork, run } from "./browser.mjs";

const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: { measure: { type: "boolean", default: false } },
});
const address = addressOf(positionals[0]);
const browser = await launch();
const open = (name, options) => openWork(browser, address, name, options);

const map = (page) => page.locator(".map-canvas");
const described = (page, text) =>
    page.waitForFunction(
        ([selector, part]) => document.querySelector(selector)?.getAttribute("aria-label").includes(part),
        [".map-canvas", text],
    );
const kept = (page) =>
    page.evaluate(() => {
        const { steps, at } = JSON.parse(localStorage.getItem("sikku-studio"));
        return steps[at].work;
    });
const variants = (page) => page.locator(".variant:not([disabled])");
const found = (page, count) =>
    page.waitForFunction((wanted) => document.querySelectorAll(".variant:not([disabled])").length === wanted, count);

const tests = {
    async "a drawing of 10^36 segments is zoomed from the page to its steps and back"() {
        const page = await open("curves/hilbert", { settings: [["derivation length", "60"]] });
        await described(page, "whole page");
        const box = await map(page).boundingBox();
        await page.mouse.move(box.x + box.width / 2 + 37, box.y + box.height / 2 + 11);
        for (let turn = 0; turn < 112; ++turn) await page.mouse.wheel(0, -120);
        await described(page, "a part");
        await page.waitForFunction(() => /\.\d{3}/.test(document.querySelector(".map-coordinates").textContent));
        const exact = await page.locator(".map-coordinates").textContent();
        assert.match(exact.replaceAll("\u202f", ""), /x \u2212\d{18}\.\d{3,}y \d{18}\.\d{3,}/);
        await page.waitForTimeout(800);
        const { place } = await kept(page);
        assert.match(place.x, /^-\d{18}\.\d+$/);
        assert.ok(place.scale < 0.02);
        await page.reload();
        await described(page, "a part");
        await map(page).focus();
        await page.keyboard.press("0");
        await described(page, "whole page");
        await page.waitForTimeout(800);
        assert.equal((await kept(page)).place, null);
        await close(page);
    },

    async "coordinates of any length can be typed"() {
        const page = await open("curves/hilbert", { settings: [["derivation length", "60"]] });
        await map(page).focus();
        await page.keyboard.press("f");
        await described(page, "a part");
        await page.locator(".map-coordinates").click();
        await page.getByLabel("Centre x, in steps").fill("not a number");
        await page.getByRole("button", { name: "Go there" }).click();
        await page.getByRole("alert").filter({ hasText: "decimal number" }).waitFor();
        await page.getByLabel("Centre x, in steps").fill("-1152921504606846900.25");
        await page.getByLabel("Centre y, in steps").fill("384307168202282325.5");
        await page.getByLabel("Steps per pixel").fill("0.05");
        await page.getByRole("button", { name: "Go there" }).click();
        await described(page, "x -1152921504606846900.25, y 384307168202282325.5");
        await page.keyboard.press("Escape");
        assert.ok(await page.locator(".map-form").isHidden());
        await close(page);
    },

    async "the map works by keyboard, and reports when the drawing is outside the view"() {
        const page = await open("kolams/snake-kolam");
        await described(page, "closed");
        await map(page).focus();
        await page.keyboard.press("+");
        await described(page, "a part");
        const before = await map(page).getAttribute("aria-label");
        await page.keyboard.press("Shift+ArrowRight");
        await page.waitForFunction(
            (text) => document.querySelector(".map-canvas").getAttribute("aria-label") !== text,
            before,
        );
        for (let press = 0; press < 4; ++press) await page.keyboard.press("Shift+ArrowRight");
        await page.locator(".map-problem", { hasText: "outside this view" }).waitFor();
        await page.keyboard.press("f");
        await page.locator(".map-problem").waitFor({ state: "hidden" });
        await close(page);
    },

    async "a plant is turned and grown, and its view is used for prints"() {
        const page = await open("plants/bush-3d", { settings: [["derivation length", "5"]], panel: "space" });
        const triangles = page.locator(".space-facts", { hasText: "triangles" });
        await triangles.waitFor();
        const full = await triangles.textContent();
        await page.locator("#space-n").focus();
        await page.keyboard.press("ArrowLeft");
        await page.locator(".space-n", { hasText: "n = 4" }).waitFor();
        await page.waitForFunction((text) => document.querySelector(".space-facts").textContent !== text, full);
        await page.locator(".space-canvas").focus();
        for (let press = 0; press < 4; ++press) await page.keyboard.press("ArrowRight");
        await page.getByLabel("Perspective").check();
        await page.getByRole("button", { name: "Use this view for prints" }).click();
        await page.locator("#message", { hasText: "view 40,14,perspective" }).waitFor();
        await page.waitForTimeout(700);
        assert.deepEqual((await kept(page)).draw, [["view", "40,14,perspective"]]);
        await page.getByRole("button", { name: "Use this n" }).click();
        await page.waitForTimeout(700);
        assert.deepEqual((await kept(page)).pattern.settings, [["derivation length", "4"]]);
        await close(page);
    },

    async "drawings without a model are reported"() {
        const page = await open("kolams/snake-kolam", { panel: "space" });
        await page.locator(".space-note", { hasText: "straight lines" }).waitFor();
        await close(page);
    },

    async "24 mutations are shown, the same each time, and one is chosen"() {
        const page = await open("kolams/snake-kolam", { panel: "variations" });
        await found(page, 24);
        const labels = () => variants(page).evaluateAll((cells) => cells.map((cell) => cell.title));
        const first = await labels();
        assert.equal(new Set(first).size, 24);
        await page.getByRole("button", { name: "Next 24" }).click();
        await page.waitForFunction((title) => document.querySelector(".variant")?.title !== title, first[0]);
        await found(page, 24);
        await page.getByRole("button", { name: "Mutations", exact: true }).click();
        await page.waitForFunction((title) => document.querySelector(".variant").title === title, first[0]);
        await page.waitForFunction(() => document.querySelector(".variations-status").textContent === "");
        assert.deepEqual(await labels(), first);
        await variants(page).nth(3).click();
        await page.locator("#message", { hasText: "Using" }).waitFor();
        await page.waitForTimeout(700);
        const { text } = (await kept(page)).pattern;
        assert.ok(text.includes(first[3].split(" → ")[1]) || first[3].startsWith("angle"));
        await page.keyboard.press("ArrowRight");
        await page.keyboard.press("Enter");
        await page.waitForFunction(() => document.activeElement.getAttribute("aria-pressed") === "true");
        await page.getByRole("button", { name: "Vary the chosen one" }).click();
        await page.waitForFunction((title) => document.querySelector(".variant").title !== title, first[0]);
        await found(page, 24);
        await close(page);
    },

    async "filters leave out variants that do not pass"() {
        const page = await open("kolams/snake-kolam", { panel: "variations" });
        await found(page, 24);
        const all = await variants(page).evaluateAll((cells) => cells.map((cell) => cell.title));
        await page.getByRole("button", { name: "Closed" }).click();
        await page.waitForFunction((titles) => {
            const now = [...document.querySelectorAll(".variant:not([disabled])")].map((cell) => cell.title);
            return now.length === 24 && now.join() !== titles;
        }, all.join());
        await close(page);
    },

    async "two values are varied against each other, and seeds"() {
        const page = await open("plants/honda-trees", { panel: "variations" });
        await page.getByRole("button", { name: "Two values" }).click();
        await found(page, 24);
        await page.getByLabel("Across: value").selectOption("alpha1");
        await page.waitForFunction(() =>
            document.querySelector(".variant:not([disabled])")?.title.startsWith("alpha1"),
        );
        await found(page, 24);
        await close(page);
        const random = await open("plants/stochastic-branches", { panel: "variations" });
        await random.getByRole("button", { name: "Seeds" }).click();
        await found(random, 24);
        await random
            .getByRole("button", { name: /Use seed/ })
            .nth(5)
            .click();
        await random.waitForTimeout(700);
        assert.equal((await kept(random)).pattern.settings[0][0], "seed");
        await close(random);
    },
};

// Frame rates and times, which depend on the machine.
async function measure() {
    const page = await open("curves/hilbert", {
        settings: [["derivation length", "60"]],
        reducedMotion: "no-preference",
    });
    await page.waitForTimeout(1000);
    const frames = async (what, act) => {
        await page.evaluate(() => {
            window.frames_taken = [];
            let last = performance.now();
            const tick = (now) => {
                window.frames_taken.push(now - last);
                last = now;
                window.ticking = requestAnimationFrame(tick);
            };
            window.ticking = requestAnimationFrame(tick);
        });
        await act();
        const taken = (
            await page.evaluate(() => {
                cancelAnimationFrame(window.ticking);
                return window.frames_taken.slice(1);
            })
        ).sort((one, other) => one - other);
        const mean = taken.reduce((sum, each) => sum + each, 0) / taken.length;
        const slow = taken[Math.floor(taken.length * 0.95)];
        console.log(`${what}: ${(1000 / mean).toFixed(0)} frames a second, 95 % within ${slow.toFixed(0)} ms`);
    };
    const box = await map(page).boundingBox();
    await page.mouse.move(box.x + box.width / 2 + 37, box.y + box.height / 2 + 11);
    await frames("zoom in 10^18-fold by the wheel", async () => {
        for (let turn = 0; turn < 112; ++turn) {
            await page.mouse.wheel(0, -120);
            await page.waitForTimeout(40);
        }
    });
    await page.waitForTimeout(1500);
    await map(page).focus();
    await frames("flight out 10^18-fold", async () => {
        await page.keyboard.press("0");
        await page.waitForTimeout(2600);
    });
    await page.context().close();
    for (const path of ["kolams/snake-kolam", "plants/plant-a", "plants/honda-trees"]) {
        const sheet = await open(path, { panel: "variations" });
        const times = [];
        for (let round = 0; round < 4; ++round) {
            if (round > 0) await sheet.getByRole("button", { name: "Next 24" }).click();
            await sheet.waitForTimeout(2500);
            times.push(await sheet.locator(".variations").getAttribute("data-milliseconds"));
        }
        console.log(`24 variants of ${path}: ${times.join(", ")} ms`);
        await sheet.context().close();
    }
}

const failures = await run(tests);
if (values.measure) await measure();
await browser.close();
process.exitCode = failures === 0 ? 0 : 1;
