// Tests, in headless Chromium, that the page shows only its work: after a change of pattern, with drawings that
// take too long, in names and commands, and in narrow windows.
//     node tests/another.mjs [PAGE] [--only WORD]
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { parseArgs } from "node:util";
import { addressOf, close, launch, openWork, patternText, run } from "./browser.mjs";

const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: { only: { type: "string", default: "" } },
});
const address = addressOf(positionals[0]);
const browser = await launch();

// Delays the answers of the workers by `slow[request]` milliseconds. With `is_hurried`, requests end after 8 seconds
// instead of 20.
function delayAnswers() {
    globalThis.slow = {};
    const Plain = globalThis.Worker;
    globalThis.Worker = class extends Plain {
        kinds = new Map();
        postMessage(message, ...rest) {
            if (message.id) this.kinds.set(message.id, JSON.parse(message.json).do);
            super.postMessage(message, ...rest);
        }
        set onmessage(listener) {
            super.onmessage = (event) => {
                const wait = globalThis.slow[this.kinds.get(event.data.id)] ?? 0;
                if (wait > 0) setTimeout(() => listener(event), wait);
                else listener(event);
            };
        }
    };
    const later = globalThis.setTimeout;
    globalThis.setTimeout = (act, time, ...rest) => later(act, time === 20_000 && globalThis.is_hurried ? 8000 : time, ...rest);
}

const open = (name, options = {}) => openWork(browser, address, name, { prepare: delayAnswers, ...options });
const slow = (page, times) => page.evaluate((each) => Object.assign(globalThis.slow, each), times);
const title = (page, text) => page.locator("#work-title", { hasText: text }).waitFor();
const isStale = (page, panel) => page.evaluate((name) => document.querySelector(name).matches(".stale"), `.${panel}`);
const current = (page) => page.waitForFunction(() => document.querySelector(".map[aria-busy=false]:not(.stale)"));

// Replaces the text, as pasting does, and returns the state of the page at that moment.
async function paste(page, text, look = () => null) {
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+a");
    await page.evaluate(`{
        globalThis.seen = undefined;
        const watcher = new MutationObserver(() => {
            watcher.disconnect();
            globalThis.seen = (${look})();
        });
        watcher.observe(document.querySelector("#work-title"), { childList: true, characterData: true, subtree: true });
    }`);
    await page.keyboard.insertText(text);
    await page.waitForFunction(() => globalThis.seen !== undefined);
    return page.evaluate(() => globalThis.seen);
}

const tests = {
    async "the picture of another pattern is dimmed at once, and replaced"() {
        const page = await open("tilings/penrose-rhombs");
        await current(page);
        const rhombs = await page.locator(".map-canvas").getAttribute("data-shows");
        await slow(page, { pixels: 1500 });
        const at = await paste(page, patternText("dragon"), () => ({
            isStale: document.querySelector(".map").matches(".stale"),
            note: document.querySelector(".map-problem").hidden,
            message: document.querySelector("#message").textContent,
            facts: document.querySelector("#facts").textContent,
        }));
        assert.deepEqual(at, { isStale: true, note: true, message: "", facts: "" });
        await page.locator(".map-problem:visible", { hasText: "Drawing…" }).waitFor();
        assert.ok(await isStale(page, "map"));
        assert.equal(await page.locator(".map-canvas").getAttribute("data-shows"), rhombs);
        await current(page);
        await page.locator(".map-problem").waitFor({ state: "hidden" });
        assert.notEqual(await page.locator(".map-canvas").getAttribute("data-shows"), rhombs);
        await close(page);
    },

    async "an edit keeps the picture, which is dimmed only if the next one is late"() {
        const page = await open("kolams/snake-kolam");
        await current(page);
        await slow(page, { pixels: 900 });
        await page.locator(".cm-content").click();
        await page.keyboard.press("Control+End");
        await page.keyboard.insertText("// edited\n");
        assert.ok(!(await isStale(page, "map")));
        await page.locator(".map-problem:visible", { hasText: "Drawing…" }).waitFor();
        assert.ok(await isStale(page, "map"));
        await current(page);
        await close(page);
    },

    async "messages of the previous pattern are removed"() {
        const page = await open("curves/hilbert");
        await current(page);
        await paste(page, "title: Nothing\naxiom: X\nX --> XX\nderivation length: 2\n");
        await page.locator(".map-word:visible", { hasText: "XXXX" }).waitFor();
        const before = await page.locator(".map-problem").textContent();
        await slow(page, { pixels: 1000 });
        const note = await paste(page, patternText("bush-3d"), () => document.querySelector(".map-problem").textContent);
        assert.notEqual(note, before);
        await page.locator(".map-problem:visible", { hasText: "Drawing…" }).waitFor();
        await current(page);
        await page.locator(".map-problem").waitFor({ state: "hidden" });
        await page.locator(".map-word").waitFor({ state: "hidden" });
        await close(page);
    },

    async "with errors in another text, the picture is marked as that of the previous pattern"() {
        const page = await open("curves/hilbert");
        await current(page);
        await paste(page, "title: Broken\naxiom: F\nnonsense here\n");
        await page.locator(".map-problem:visible", { hasText: "picture of the previous pattern" }).waitFor();
        assert.ok(await isStale(page, "map"));
        await page.keyboard.press("Control+z");
        await current(page);
        await close(page);
    },

    async "values set for a pattern are not those of another"() {
        const page = await open("curves/hilbert", { settings: [["derivation length", "7"]] });
        await current(page);
        await paste(page, patternText("penrose-rhombs"));
        await title(page, "Penrose");
        await page.locator("#facts", { hasText: "No errors" }).waitFor();
        assert.ok(await page.getByRole("button", { name: "Reset all" }).isHidden());
        await close(page);
    },

    async "a model of another pattern disappears at once"() {
        const page = await open("plants/bush-3d", { settings: [["derivation length", "4"]], panel: "space" });
        await page.locator(".space-facts", { hasText: "triangles" }).waitFor();
        await slow(page, { make: 1500 });
        const facts = await paste(page, patternText("honda-trees"), () => {
            const label = document.querySelector(".space-canvas").getAttribute("aria-label");
            return [document.querySelector(".space-facts").textContent, label];
        });
        assert.deepEqual(facts, ["", "Model"]);
        await page.locator(".space-note:visible", { hasText: "Making the model…" }).waitFor();
        await page.locator(".space-facts", { hasText: "triangles" }).waitFor();
        await page.locator(".space-note").waitFor({ state: "hidden" });
        await paste(page, patternText("gourd"));
        const note = page.locator(".space-note:visible", { hasText: /^Line \d+: / });
        await note.waitFor();
        assert.doesNotMatch(await note.textContent(), /\.lsys:|\^/);
        assert.equal(await page.locator(".space-facts").textContent(), "");
        await close(page);
    },

    async "a melody of another pattern disappears at once"() {
        const page = await open("melodies/hilbert-todi", { panel: "play" });
        await page.locator(".play-place", { hasText: "Bar 1" }).waitFor();
        await slow(page, { notes: 1000 });
        const place = await paste(
            page,
            "title: Silence\naxiom: +X\nX --> +X\nderivation length: 2\n",
            () => document.querySelector(".play-place").textContent,
        );
        assert.equal(place, "");
        await page.locator(".play-waiting:visible", { hasText: "Making the melody…" }).waitFor();
        await page.locator(".play-problem:visible", { hasText: "no notes" }).waitFor();
        assert.equal(await page.locator(".play-place").textContent(), "");
        assert.ok(await page.locator(".play-waiting").isHidden());
        await paste(page, patternText("gourd"));
        await page.locator(".play-problem:visible", { hasText: /^Line \d+: a map has no turtle/ }).waitFor();
        await close(page);
    },

    async "variants of another pattern cannot be chosen"() {
        const page = await open("kolams/snake-kolam", { panel: "variations" });
        await page.waitForFunction(() => document.querySelectorAll(".variant:not([disabled])").length === 24);
        const isInert = await paste(
            page,
            patternText("hilbert"),
            () => document.querySelector(".variations-sheet").inert,
        );
        assert.equal(isInert, true);
        await page.waitForFunction(() => !document.querySelector(".variations-sheet").inert);
        await close(page);
    },

    async "a drawing that takes too long is refused with the reason and the largest n that can be drawn"() {
        const page = await open("curves/hilbert");
        await current(page);
        const hurry = (isHurried) => page.evaluate((value) => (globalThis.is_hurried = value), isHurried);
        for (const [name, text, size] of [
            // Refused by the estimate of its visible parts, before anything is drawn.
            ["Squares", "axiom: F\nderivation length: 25\nF --> FFF+F[F]F\n", /parts of the drawing are visible/],
            // Refused by the budget of nodes on fast machines, stopped on slow ones, perhaps before its size is known.
            [
                "Growing",
                "axiom: A(1)\nderivation length: 30\nA(x) : x>0 --> F(x)A(x+1)A(x+2)\n",
                /n = 30|Stopped after/,
            ],
        ]) {
            await hurry(true);
            await paste(page, `title: ${name}\n${text}`);
            const note = page.locator(".map-problem:visible", { hasText: size });
            await note.waitFor();
            assert.ok((await isStale(page, "map")) || (await page.locator(".map-canvas").isVisible()));
            const set = note.getByRole("button", { name: /^Set n = \d+$/ });
            await set.waitFor();
            await hurry(false);
            await set.click();
            await page.locator(".map-problem", { hasText: size }).waitFor({ state: "hidden" });
            await current(page);
            await page.locator(".map-problem").waitFor({ state: "hidden" });
        }
        await close(page);
    },

    async "files and commands have the name of the title"() {
        const page = await open("kolams/snake-kolam");
        const command = async () => {
            await page.getByRole("button", { name: "Export" }).click();
            const dialog = page.getByRole("dialog", { name: "Export" });
            await dialog.getByText("SVG", { exact: true }).click();
            await dialog.getByRole("button", { name: /^Save .*\.svg/ }).waitFor();
            await dialog.locator(".command", { hasText: "sikku draw" }).waitFor();
            const shown = await dialog.locator(".command").textContent();
            const saved = await dialog.getByRole("button", { name: /^Save .*\.svg/ }).textContent();
            const needsFile = await dialog.locator(".command-needs").isVisible();
            let file = null;
            if (needsFile) {
                const save = dialog.getByRole("button", { name: "Save the pattern" });
                const [download] = await Promise.all([page.waitForEvent("download"), save.click()]);
                file = [download.suggestedFilename(), readFileSync(await download.path(), "utf8")];
            }
            await page.keyboard.press("Escape");
            await dialog.waitFor({ state: "detached" });
            return { shown, saved: saved.split(" ")[1], file };
        };
        assert.deepEqual(await command(), {
            shown: "sikku draw snake-kolam -o snake-kolam.svg",
            saved: "snake-kolam.svg",
            file: null,
        });
        await paste(page, "title: Two squares\naxiom: F+F+F+F\nderivation length: 1\nF --> F\n");
        const short = await command();
        assert.match(short.shown, /^sikku draw '#sikku1\.[\w.-]+' -o two-squares\.svg$/);
        assert.equal(short.saved, "two-squares.svg");
        let state = 1;
        // Few lines, because Chromium inserts thousands slowly.
        const numbers = Array.from({ length: 4000 }, () => (state = Math.imul(state, 48271) >>> 1));
        const noise = Array.from({ length: 40 }, (_, line) => `// ${numbers.slice(100 * line, 100 * line + 100).join(" ")}`).join("\n");
        const long = `title: Two squares\naxiom: F+F+F+F\nderivation length: 1\nF --> F\n${noise}\n`;
        await paste(page, `title: x\naxiom: F\n`);
        await paste(page, long);
        assert.deepEqual(await command(), {
            shown: "sikku draw two-squares.lsys -o two-squares.svg",
            saved: "two-squares.svg",
            file: ["two-squares.lsys", long],
        });
        await close(page);
    },

    async "export offers the formats of the work, not of the previous pattern"() {
        const page = await open("plants/bush-3d", { settings: [["derivation length", "3"]] });
        await current(page);
        await slow(page, { open: 1500 });
        await paste(page, patternText("koch-island"));
        await page.getByRole("button", { name: "Export" }).click();
        const dialog = page.getByRole("dialog", { name: "Export" });
        assert.ok(await dialog.locator(".formats[inert]").isVisible());
        assert.equal(await dialog.getByText("STL", { exact: true }).count(), 0);
        await dialog.locator(".formats:not([inert])").waitFor();
        await dialog.getByText("STL", { exact: true }).waitFor();
        await dialog.getByText("STL", { exact: true }).click();
        await dialog.getByRole("button", { name: /^Save .*\.stl/ }).waitFor();
        await page.keyboard.press("Escape");
        await close(page);
    },

    async "two values of one name are distinguished, and a map has no angle"() {
        const page = await open("plants/lilac", { draws: false });
        const labels = () => page.locator(".value-rows .slider > label").allTextContents();
        await page.waitForFunction(() => document.querySelectorAll(".value-rows .slider").length > 2);
        const lilac = await labels();
        assert.equal(new Set(lilac).size, lilac.length, lilac.join());
        await paste(page, patternText("gourd"));
        await page.locator(".cost", { hasText: /\d cells · [\d,]+ edges/ }).waitFor();
        assert.ok(!(await labels()).includes("angle"));
        await close(page);
    },
};

// Controls that are cut off by the window, with the panel's name.
const cutOff = (page, part) =>
    page.evaluate((selector) => {
        const isIn = (at, box) => at.left >= box.left - 0.5 && at.right <= box.right + 0.5;
        const window_box = { left: 0, right: innerWidth };
        const found = [];
        for (const each of document.querySelectorAll(`${selector} :is(button, input, select, output, summary)`)) {
            const at = each.getBoundingClientRect();
            if (at.width === 0 || !each.checkVisibility() || each.closest(".unseen, .tabs, .cm-editor")) continue;
            if (!isIn(at, window_box)) found.push(`${each.getAttribute("aria-label") ?? each.textContent} ${at.right}`);
        }
        return found;
    }, part);

for (const [width, height] of [
    [320, 640],
    [390, 844],
    [720, 450],
    [800, 600],
    [960, 700],
    [1024, 768],
    [1100, 800],
    [1120, 800],
    [1440, 900],
]) {
    tests[`nothing is cut off at ${width} × ${height}`] = async () => {
        const page = await open("kolams/snake-kolam", { viewport: { width, height } });
        const found = [];
        for (const tab of await page.getByRole("tab").all()) {
            await tab.click();
            await page.waitForTimeout(200);
            const name = await tab.textContent();
            const panel = await tab.getAttribute("aria-controls");
            for (const part of ["#tools", `#${panel}`, "#values"]) {
                for (const each of await cutOff(page, part)) found.push(`${name}: ${each}`);
            }
            const wide = await page.evaluate(
                (id) => [document.documentElement, document.getElementById(id)].map((each) => each.scrollWidth - each.clientWidth),
                panel,
            );
            if (Math.max(...wide) > 0) found.push(`${name}: ${wide} pixels too wide`);
        }
        assert.deepEqual(found, []);
        await page.getByRole("tab", { name: "Picture" }).click();
        const box = await page.locator(".map-canvas").boundingBox();
        assert.ok(box.height >= 240, `the picture is ${box.height} pixels high`);
        await close(page);
    };
}

const failures = await run(tests, values.only);
await browser.close();
process.exitCode = failures === 0 ? 0 : 1;
