// Tests the page in a browser, finding elements by their labels:
//     node tests/page.mjs sikku-studio.html [--screenshots FOLDER] [--only WORD] [--browser FILE] [--measure]
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { parseArgs } from "node:util";
import { addressOf, launch } from "./browser.mjs";

const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: {
        screenshots: { type: "string" },
        only: { type: "string", default: "" },
        measure: { type: "boolean", default: false },
        browser: { type: "string" },
    },
});
const address = addressOf(positionals[0]);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
if (values.screenshots) mkdirSync(values.screenshots, { recursive: true });

const browser = await launch(values.browser);

const ctrl = "Control";
const arrangements = readdirSync(new URL("../../patterns/arrangements", import.meta.url)).length;
const bundled = readdirSync(new URL("../../patterns", import.meta.url), { recursive: true }).filter((name) =>
    name.endsWith(".lsys"),
).length;
const wide = { width: 1280, height: 800 };
const narrow = { width: 390, height: 844 };

// Opens the studio and collects its errors.
async function openStudio({ viewport = wide, colorScheme = "light", fragment = "", context, at = address } = {}) {
    const own =
        context ??
        (await browser.newContext({ viewport, colorScheme, acceptDownloads: true, reducedMotion: "reduce" }));
    const page = await own.newPage();
    page.problems = [];
    page.on("pageerror", (error) => page.problems.push(error.message));
    page.on("console", (message) => {
        if (message.type() === "error") page.problems.push(message.text());
    });
    page.on("request", (request) => {
        if (!/^(file|blob|data):/.test(request.url())) page.problems.push(`request of ${request.url()}`);
    });
    await page.goto(at + fragment);
    await page.getByRole("tab", { name: "Gallery" }).waitFor();
    if (!fragment) await page.locator("#facts", { hasText: "No errors" }).waitFor();
    return page;
}

const text = (page) => page.locator(".cm-content");
const slider = (page, name) => page.getByRole("slider", { name, exact: true });
const cost = (page) => page.locator(".cost").textContent();
const message = (page) => page.locator("#message").textContent();

async function setText(page, content) {
    await text(page).click();
    await page.keyboard.press(`${ctrl}+a`);
    await page.evaluate((data) => navigator.clipboard?.writeText?.(data).catch(() => {}), content);
    await page.keyboard.insertText(content);
}

async function textOf(page) {
    return page.evaluate(
        () =>
            (JSON.parse(localStorage.getItem("sikku-studio") ?? "null") &&
                document.querySelector(".cm-content").cmTile?.view?.state.doc.toString()) ||
            [...document.querySelectorAll(".cm-line")].map((line) => line.textContent).join("\n"),
    );
}

// A hash of the map's picture.
async function picture(page) {
    return page.evaluate(() => {
        const canvas = document.querySelector(".map-canvas");
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        let sum = 0;
        for (let index = 0; index < data.length; index += 16)
            sum = (sum * 31 + data[index] + data[index + 1] * 3) % 1000000007;
        return sum;
    });
}

async function pictureAfter(page, before) {
    for (let wait = 0; wait < 60; ++wait) {
        const now = await picture(page);
        if (now !== before) return now;
        await page.waitForTimeout(50);
    }
    throw new Error("the picture did not change");
}

// The picture once drawing has finished.
async function steadyPicture(page) {
    let last = await picture(page);
    for (let same = 0; same < 4;) {
        await page.waitForTimeout(80);
        const now = await picture(page);
        same = now === last ? same + 1 : 0;
        last = now;
    }
    return last;
}

async function checkAccess(page, what) {
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => globalThis.axe.run({ resultTypes: ["violations"] }));
    const lines = violations.map(
        ({ id, nodes }) =>
            `${what}: ${id}, ${nodes.length} times: ${nodes[0].html.slice(0, 200)} ` +
            `(${nodes[0].any[0]?.message ?? nodes[0].failureSummary})`,
    );
    assert.equal(lines.join("\n"), "");
}

async function screenshot(page, name) {
    if (values.screenshots) await page.screenshot({ path: join(values.screenshots, `${name}.png`) });
}

const tests = [];
const test = (name, run) => tests.push({ name, run });
const shared = { page: null }; // for tests that do not need a new page

test("the page opens and draws", async () => {
    const page = await openStudio();
    shared.page = page;
    await pictureAfter(page, 0);
    assert.match(await cost(page), /3,239 symbols/);
    await steadyPicture(page);
    await screenshot(page, "first");
});

test("typing redraws the picture", async ({ page }) => {
    await text(page).click();
    const before = await steadyPicture(page);
    await page.keyboard.press(`${ctrl}+Home`);
    const start = await page.evaluate(() => performance.now());
    await setText(
        page,
        "title: Typed\nderivation length: 3\nangle factor: 4\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\n",
    );
    await pictureAfter(page, before);
    const time = await page.evaluate((from) => performance.now() - from, start);
    assert.ok(time < 1500, `${time} ms`);
    await page.locator("#work-title", { hasText: "Typed" }).waitFor();
});

test("errors are shown in place, and the picture stays", async ({ page }) => {
    await page.waitForTimeout(1000); // makes a separate step of the history
    const before = await steadyPicture(page);
    await text(page).click();
    await page.keyboard.press(`${ctrl}+End`);
    await page.keyboard.type("angel factor: 3");
    await page.locator(".line-message", { hasText: "did you mean 'angle factor'" }).first().waitFor();
    assert.match(await message(page), /Line 7: unknown key 'angel factor'/);
    assert.equal(await picture(page), before);
    assert.ok((await page.locator(".cm-lintRange-error").count()) > 0);
    await screenshot(page, "error");
    await page.getByRole("button", { name: "Go to it" }).click();
    await page.keyboard.press(`${ctrl}+z`);
    await page.locator("#facts", { hasText: "No errors" }).waitFor();
});

test("keys are completed and explained", async ({ page }) => {
    await text(page).click();
    await page.keyboard.press(`${ctrl}+End`);
    await page.keyboard.type("tro");
    await page.locator(".cm-tooltip-autocomplete", { hasText: "tropism" }).waitFor();
    await page.locator(".cm-completionInfo", { hasText: "If absent" }).waitFor();
    await page.keyboard.press("Escape");
    await page.keyboard.press(`${ctrl}+z`);
    await page.locator("#message", { hasText: "No errors." }).waitFor();
    await page.keyboard.press(`${ctrl}+Home`);
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("F1");
    await page.locator(".help-card", { hasText: "Number of derivation steps" }).waitFor();
    assert.match(await message(page), /Number of derivation steps/);
    await page.keyboard.press("Escape");
    await page.locator(".cm-line", { hasText: "axiom" }).locator("span", { hasText: "axiom" }).first().hover();
    await page.locator(".help-card", { hasText: "Initial word" }).waitFor();
    await page.mouse.move(900, 400);
});

test("names lead to their definitions and are renamed everywhere", async () => {
    const page = await openStudio();
    await setText(
        page,
        "title: Names\nderivation length: 3\ndefine k = 2\naxiom: X(k)\nX(i) --> F+X(i+k)\nvariant v: k = 3\n",
    );
    await page.locator("#work-title", { hasText: "Names" }).waitFor();
    await page.locator("#facts", { hasText: "No errors" }).waitFor();
    const value = page.getByRole("textbox", { name: "k, value" });
    await value.fill("5");
    await value.press("Enter");
    await text(page).click();
    await page.keyboard.press(`${ctrl}+Home`);
    for (let line = 1; line < 4; ++line) await page.keyboard.press("ArrowDown");
    await page.keyboard.press("End");
    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("F12");
    await page.locator(".cm-activeLine", { hasText: "define k = 2" }).waitFor();
    await page.keyboard.press("F2");
    const name = page.getByRole("textbox", { name: "New name of k" });
    await name.fill("X(");
    await name.press("Enter");
    await page.locator("#message", { hasText: "X(" }).waitFor();
    await page.keyboard.press("F2");
    await name.fill("size");
    await name.press("Enter");
    await page.locator(".cm-line", { hasText: "define size = 2" }).waitFor();
    const renamed = await textOf(page);
    for (const line of ["axiom: X(size)", "X(i) --> F+X(i+size)", "variant v: size = 3"]) assert.ok(renamed.includes(line), renamed);
    await page.locator("#facts", { hasText: "No errors" }).waitFor();
    assert.equal(await page.getByRole("textbox", { name: "size, value" }).inputValue(), "5");
    await text(page).click();
    await page.keyboard.press(`${ctrl}+z`);
    await page.locator(".cm-line", { hasText: "define k = 2" }).waitFor();
    assert.deepEqual(page.problems, []);
    await page.context().close();
});

test("sliders change values, and a double click resets them", async ({ page }) => {
    const n = slider(page, "n");
    assert.match(await cost(page), /63 segments/);
    await n.focus();
    await page.keyboard.press("ArrowRight");
    await page.locator(".cost", { hasText: "255 segments" }).waitFor();
    await page.getByRole("textbox", { name: "n, value" }).fill("5");
    await page.keyboard.press("Enter");
    await page.locator(".cost", { hasText: "1,023 segments" }).waitFor();
    const before = await steadyPicture(page);
    await slider(page, "angle").focus();
    await page.keyboard.press("ArrowRight");
    await pictureAfter(page, before);
    await slider(page, "angle").dblclick();
    await page.getByRole("button", { name: "Write into the text" }).click();
    await page.locator(".cm-line", { hasText: "derivation length: 5" }).waitFor();
    assert.equal(await n.inputValue(), "5");
});

test("a large n is shown without deriving it", async ({ page }) => {
    await page.getByRole("textbox", { name: "n, value" }).fill("40");
    await page.keyboard.press("Enter");
    await page.locator(".cost", { hasText: "derives only what the view shows" }).waitFor();
    await steadyPicture(page);
    await screenshot(page, "large-n");
    await page.getByRole("button", { name: "Reset n" }).click();
    await page.locator(".cost", { hasText: "1,023 segments" }).waitFor();
});

test("everything can be undone, and a reload loses nothing", async ({ page }) => {
    await page.getByRole("button", { name: /^Undo/ }).click();
    await page.locator(".cost", { hasText: "derives only" }).waitFor();
    await page.getByRole("button", { name: /^Redo/ }).click();
    await page.locator(".cost", { hasText: "1,023 segments" }).waitFor();
    await page.waitForTimeout(900);
    await page.getByRole("button", { name: "History" }).click();
    const steps = page.locator(".steps li");
    await steps.nth(3).waitFor();
    await page.locator(".steps [aria-current] img").waitFor();
    await screenshot(page, "history");
    await steps.last().getByRole("button").click();
    await page.locator(".cost", { hasText: "3,239 symbols" }).waitFor();
    await page.keyboard.press("Escape");
    const before = await textOf(page);
    await page.waitForTimeout(600);
    await page.reload();
    await page.locator(".cost", { hasText: "3,239 symbols" }).waitFor();
    assert.equal(await textOf(page), before);
    await page.getByRole("button", { name: /^Redo/ }).click();
    await page.locator("#work-title", { hasText: "Typed" }).waitFor();
    await page.getByRole("button", { name: /^Undo/ }).click();
});

test("the seed is stepped, randomised and locked", async ({ page }) => {
    await page.getByRole("tab", { name: "Gallery" }).click();
    await page.getByRole("searchbox", { name: "Search patterns" }).fill("by chance");
    await page.locator(".card:visible", { hasText: "plants" }).first().click();
    const seed = page.getByRole("textbox", { name: "seed", exact: true });
    await seed.waitFor();
    const first = Number(await seed.inputValue());
    await page.getByRole("button", { name: "Next seed" }).click();
    assert.equal(Number(await seed.inputValue()), first + 1);
    await page.getByRole("button", { name: "Previous seed" }).click();
    assert.equal(Number(await seed.inputValue()), first);
    await page.getByRole("button", { name: "Random seed" }).click();
    assert.notEqual(Number(await seed.inputValue()), first);
    await page.getByRole("button", { name: "Lock the seed" }).click();
    assert.ok(await page.getByRole("button", { name: "Random seed" }).isDisabled());
    await page.getByRole("button", { name: "Lock the seed" }).click();
    await page.waitForTimeout(300);
    await screenshot(page, "plant");
});

test("the gallery finds and opens patterns", async ({ page }) => {
    await page.getByRole("tab", { name: "Gallery" }).click();
    const search = page.getByRole("searchbox", { name: "Search patterns" });
    await search.fill("");
    await page.locator(".card .picture.drawn").nth(5).waitFor();
    await screenshot(page, "gallery");
    await search.fill("hilbert todi");
    await page.locator(".gallery-count", { hasText: `1 of ${bundled + arrangements}` }).waitFor();
    await search.fill("snake");
    await page.getByRole("button", { name: "kolams", exact: true }).click();
    await page.locator(".card:visible").first().click();
    await page.locator("#work-title", { hasText: "Snake kolam" }).waitFor();
    assert.equal(await page.getByRole("tab", { name: "Picture" }).getAttribute("aria-selected"), "true");
});

const dropFile = (page, name, content) =>
    page.evaluate(
        ([file, data]) => {
            const transfer = new DataTransfer();
            transfer.items.add(new File([data], file));
            for (const type of ["dragover", "drop"]) {
                document.body.dispatchEvent(
                    new DragEvent(type, { dataTransfer: transfer, bubbles: true, cancelable: true }),
                );
            }
        },
        [name, content],
    );

test("files can be dropped", async ({ page }) => {
    const drop = (name, content) => dropFile(page, name, content);
    await drop("dropped.lsys", "title: Dropped\nderivation length: 1\naxiom: F\nF --> F+F\n");
    await page.locator("#work-title", { hasText: "Dropped" }).waitFor();
    await drop("two.l", "One {\n Angle 4\n Axiom F\n F=F+F\n}\nOther {\n Angle 6\n Axiom F\n F=F-F\n}\n");
    await page.getByRole("dialog", { name: "2 patterns in two.l" }).getByRole("button", { name: "Other" }).click();
    await page.locator(".cm-content", { hasText: "F-F" }).waitFor();
    await drop("nothing.pdf", "no print of ours");
    await page.locator("#message[data-kind=error]", { hasText: "nothing.pdf" }).waitFor();
    await page.getByRole("button", { name: /^Undo/ }).click();
    await page.getByRole("button", { name: /^Undo/ }).click();
    await page.locator("#work-title", { hasText: "Snake kolam" }).waitFor();
});

test("a scale that is dropped is played", async ({ page }) => {
    const settings = () =>
        page.evaluate(() => {
            dispatchEvent(new Event("pagehide")); // saves at once
            const { steps, at } = JSON.parse(localStorage.getItem("sikku-studio"));
            return Object.fromEntries(steps[at].work.pattern.settings);
        });
    const hilbert = "derivation length: 3\nangle factor: 4\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\n";
    await dropFile(page, "hilbert.lsys", `title: Melody\n${hilbert}`);
    await page.locator("#work-title", { hasText: "Melody" }).waitFor();
    await dropFile(page, "bad.scl", "nonsense");
    await page.locator("#message[data-kind=error]", { hasText: "bad.scl" }).waitFor();
    assert.equal((await settings()).scale, undefined);
    await dropFile(page, "five.scl", "! five.scl\n!\nfive equal steps\n 5\n!\n240.\n480.\n720.\n960.\n2/1\n");
    await page.locator("#message", { hasText: "The melody now uses the scale five.scl" }).waitFor();
    assert.equal((await settings()).scale, "five.scl");
    await page.locator("#facts", { hasText: "No errors" }).waitFor();
    await page.locator("#panel-play:visible", { hasText: "five equal steps from" }).waitFor();
    await page.reload();
    await page.locator("#facts", { hasText: "No errors" }).waitFor();
    await page.locator("#panel-play:visible", { hasText: "five equal steps from" }).waitFor();
    await page.getByRole("button", { name: /^Undo/ }).click();
    assert.equal((await settings()).scale, undefined);
    await page.getByRole("button", { name: /^Undo/ }).click();
    await page.getByRole("tab", { name: "Picture" }).click();
    await page.locator("#work-title", { hasText: "Snake kolam" }).waitFor();
});

test("export writes the file and tells the command", async ({ page }) => {
    await page.getByRole("button", { name: "Export" }).click();
    const dialog = page.getByRole("dialog", { name: "Export" });
    // Names of formats are words, and options that a kolam cannot use are not offered.
    for (const name of ["Printed score", "Compressed MusicXML", "glTF", "WAV"]) await dialog.getByText(name, { exact: true }).waitFor();
    await dialog.locator("[data-option=swatch]").waitFor({ state: "hidden" });
    for (const name of ["fill-page", "light", "view"]) assert.ok(await dialog.locator(`[data-option=${name}]`).isHidden(), name);
    assert.ok(!/--[a-z]/.test(await dialog.locator(".export-options").textContent()), "help texts do not name the command line");
    await dialog.getByRole("combobox", { name: "Size", exact: true }).selectOption("Other…");
    await dialog.getByRole("combobox", { name: "Other size" }).fill("50x70cm");
    await dialog.getByRole("combobox", { name: "Other size" }).press("Enter");
    await dialog.locator(".command", { hasText: "--size 50x70cm" }).waitFor();
    await dialog.getByRole("combobox", { name: "Size", exact: true }).selectOption("A3");
    await dialog.getByRole("checkbox", { name: "Landscape" }).check();
    await dialog.locator(".command", { hasText: "--size A3 --landscape" }).waitFor();
    await dialog.locator("summary", { hasText: "Kolams and growth" }).click();
    await dialog.getByRole("checkbox", { name: "Dots", exact: true }).check();
    await dialog.locator(".command", { hasText: "--landscape --dots" }).waitFor();
    const save = dialog.getByRole("button", { name: /^Save .*\.svg/ });
    await save.waitFor();
    const [download] = await Promise.all([page.waitForEvent("download"), save.click()]);
    const svg = readFileSync(await download.path(), "utf8");
    assert.match(svg, /<svg[^>]*width="420mm"/);
    await screenshot(page, "export");
    await dialog.getByText("G-code", { exact: true }).click();
    await dialog.locator(".remarks", { hasText: "drawn" }).waitFor();
    await dialog.getByRole("button", { name: /^Save .*\.gcode/ }).waitFor();
    // A choice made while another is being written, and a format that only the program writes.
    await dialog.getByText("SVG", { exact: true }).click();
    await dialog.getByText("GIF", { exact: true }).click();
    await dialog.locator(".remarks", { hasText: "The page makes a simpler one" }).waitFor();
    await page.waitForTimeout(800);
    assert.ok(await dialog.getByRole("button", { name: "Save", exact: true }).isDisabled());
    await dialog.locator(".command", { hasText: ".gif" }).waitFor();
    await page.evaluate(() => Object.defineProperty(navigator, "clipboard", { value: undefined, configurable: true }));
    await dialog.getByRole("button", { name: "Copy" }).click();
    await page.locator("#message", { hasText: "The command is copied." }).waitFor();
    await page.evaluate(() => delete navigator.clipboard);
    await dialog.getByText("G-code", { exact: true }).click();
    await dialog.getByRole("button", { name: /^Save .*\.gcode/ }).waitFor();
    await checkAccess(page, "export");
    await page.keyboard.press("Escape");
    await dialog.waitFor({ state: "detached" });
});

test("export shows a relief, which can be turned", async ({ page }) => {
    await page.getByRole("button", { name: "Export" }).click();
    const dialog = page.getByRole("dialog", { name: "Export" });
    await dialog.getByText("STL", { exact: true }).click();
    const relief = dialog.getByRole("img", { name: /^The relief/ });
    await relief.waitFor();
    const before = await relief.screenshot();
    await relief.press("ArrowRight");
    assert.notDeepEqual(await relief.screenshot(), before);
    const save = dialog.getByRole("button", { name: /^Save .*\.stl/ });
    await save.waitFor();
    const [download] = await Promise.all([page.waitForEvent("download"), save.click()]);
    const stl = readFileSync(await download.path());
    assert.equal(stl.length, 84 + 50 * stl.readUInt32LE(80));
    await dialog.getByText("SVG", { exact: true }).click();
    await relief.waitFor({ state: "hidden" });
    await dialog.getByRole("img", { name: "The page" }).waitFor();
    await page.keyboard.press("Escape");
    await dialog.waitFor({ state: "detached" });
});

test("a print that is dropped gives its pattern and values back", async ({ page }) => {
    const before = await textOf(page);
    await page.getByRole("textbox", { name: "n, value" }).fill("3");
    await page.keyboard.press("Enter");
    await page.getByRole("button", { name: "Export" }).click();
    await page.getByText("SVG", { exact: true }).click();
    const save = page.getByRole("button", { name: /^Save .*\.svg/ });
    const [download] = await Promise.all([page.waitForEvent("download"), save.click()]);
    const svg = readFileSync(await download.path(), "utf8");
    await page.keyboard.press("Escape");
    await page.getByRole("button", { name: "Open", exact: true }).click();
    await page.getByRole("menuitem", { name: "New pattern" }).click();
    await page.locator("#work-title", { hasText: "A curve of mine" }).waitFor();
    await dropFile(page, "print.svg", svg);
    await page.locator("#work-title", { hasText: "Snake kolam" }).waitFor();
    assert.equal((await textOf(page)).trim(), before.trim());
    assert.equal(await slider(page, "n").inputValue(), "3");
    await page.getByRole("button", { name: "Reset n" }).click();
});

test("a link contains everything and runs nothing before it is opened", async ({ page }) => {
    await slider(page, "n").focus();
    await page.keyboard.press("ArrowLeft");
    await page.getByRole("button", { name: "Share" }).click();
    const field = page.getByRole("textbox", { name: "Link" });
    await page.locator(".code-facts", { hasText: "characters" }).waitFor();
    const link = await field.inputValue();
    await screenshot(page, "share");
    await checkAccess(page, "share");
    await page.keyboard.press("Escape");
    const other = await openStudio({ fragment: link.slice(link.indexOf("#")) });
    const dialog = other.getByRole("dialog", { name: "This link contains a pattern" });
    await dialog.waitFor();
    assert.match(await dialog.locator("pre").textContent(), /Snake kolam/);
    await screenshot(other, "link");
    await checkAccess(other, "link");
    assert.equal(
        (await other.evaluate(() => JSON.parse(localStorage.getItem("sikku-studio") ?? '{"steps":[]}').steps.length)) <=
            1,
        true,
    );
    await dialog.getByRole("button", { name: "Open" }).click();
    await other.locator(".cost", { hasText: await cost(page) }).waitFor();
    assert.equal(await textOf(other), await textOf(page));
    assert.equal(await other.evaluate(() => location.hash), "");
    assert.deepEqual(other.problems, []);
    await other.context().close();
});

// Links as anyone may write them.
async function linkOf(shared) {
    linkOf.bridge ??= await (await import("../load_bridge.mjs")).loadBridge();
    return `#${JSON.parse(linkOf.bridge(JSON.stringify({ do: "link", shared })).json).link}`;
}

test("links are shown one at a time, in part if they are long, and checked", async () => {
    const pattern = (text) => ({ name: "sent.lsys", text });
    const long = `title: Long\naxiom: F\n${"\n".repeat(3_000_000)}`;
    const page = await openStudio({ fragment: await linkOf({ pattern: pattern(long) }) });
    const dialog = page.getByRole("dialog", { name: "This link contains a pattern" });
    await dialog.waitFor();
    assert.ok((await dialog.locator("pre").textContent()).length < 20_100);
    await dialog.getByText("2.98 million more characters are not shown").waitFor();
    const page_values = { locked: '["seed"]', place: '{"x":"1","y":"2","scale":1e999}', panel: "map" };
    const next = await linkOf({
        pattern: pattern("title: Next\nderivation length: 2\naxiom: F\nF(0.5) --> F+F\nF(0.5) --> F-F\n"),
        draw: [["size", "A3"]],
        page: page_values,
    });
    await page.evaluate((hash) => (location.hash = hash), next);
    await dialog.locator("strong", { hasText: "Next" }).waitFor();
    assert.equal(await dialog.count(), 1);
    assert.equal(await page.evaluate(() => location.hash), next);
    await dialog.locator(".link-values", { hasText: "size: A3" }).waitFor();
    await dialog.getByRole("button", { name: "Open" }).click();
    await page.locator("#work-title", { hasText: "Next" }).waitFor();
    await page.waitForTimeout(600);
    const work = await page.evaluate(() => {
        const { steps, at } = JSON.parse(localStorage.getItem("sikku-studio"));
        return steps[at].work;
    });
    assert.deepEqual([work.locked, work.place, work.draw], [["seed"], null, [["size", "A3"]]]);
    const wrong = await linkOf({ pattern: pattern("axiom: F\n"), draw: [["nonsense", "1"]] });
    await page.evaluate((hash) => (location.hash = hash), wrong);
    await page.locator("#message[data-kind=error]", { hasText: "does not know: nonsense" }).waitFor();
    assert.equal(await dialog.count(), 0);
    assert.equal(await page.evaluate(() => location.hash), "");
    assert.deepEqual(page.problems, []);
    await page.context().close();
});

test("the page works by keyboard", async ({ page }) => {
    await page.reload();
    await page.locator("#facts", { hasText: "No errors" }).waitFor();
    await page.getByRole("tab", { name: "Gallery" }).waitFor(); // the shortcuts come with the tabs
    await page.keyboard.press("Tab");
    await page.keyboard.press("Enter");
    const focus = () => page.evaluate(() => document.activeElement.className || document.activeElement.id);
    assert.match(await focus(), /cm-content/);
    await page.keyboard.press("Alt+2");
    assert.equal(await page.getByRole("tab", { name: "Gallery" }).getAttribute("aria-selected"), "true");
    await page.keyboard.press("Home");
    assert.equal(await page.getByRole("tab", { name: "Picture" }).getAttribute("aria-selected"), "true");
    await page.keyboard.press("?");
    const keys = page.getByRole("dialog", { name: "Keyboard" });
    await keys.waitFor();
    await checkAccess(page, "keyboard");
    await page.keyboard.press("Escape");
    await page.getByRole("button", { name: "More" }).press("Enter");
    await page.keyboard.press("ArrowUp");
    await page.keyboard.press("Enter");
    await page.getByRole("dialog", { name: "About the studio" }).waitFor();
    await checkAccess(page, "about");
    await page.keyboard.press("Escape");
    await page.getByRole("separator").focus();
    const width = await page.locator(".side").evaluate((side) => side.clientWidth);
    await page.keyboard.press("ArrowRight");
    assert.ok((await page.locator(".side").evaluate((side) => side.clientWidth)) > width);
});

for (const colorScheme of ["light", "dark"]) {
    for (const [size, viewport] of [
        ["wide", wide],
        ["narrow", narrow],
    ]) {
        test(`all views are accessible, ${colorScheme}, ${size}`, async () => {
            const page = await openStudio({ viewport, colorScheme });
            const found = [];
            for (const tab of await page.getByRole("tab").all()) {
                await tab.click();
                await page.waitForTimeout(350);
                const name = await tab.textContent();
                await checkAccess(page, name).catch((error) => found.push(error.actual));
                const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
                if (overflow > 0) found.push(`${name}: ${overflow} pixels too wide`);
                await screenshot(page, `${colorScheme}-${size}-${name.toLowerCase().replaceAll(" ", "-")}`);
            }
            assert.equal([...found, ...page.problems].join("\n"), "");
            await page.context().close();
        });
    }
}

test("patterns that the program wrote into the page are open and in the gallery", async () => {
    const own = JSON.stringify([
        {
            name: "own.lsys",
            text: "title: My </script> own\naxiom: F\nF --> F+F\n",
            settings: [["derivation length", "3"]],
        },
    ]);
    const folder = mkdtempSync(join(tmpdir(), "sikku-studio-"));
    const file = join(folder, "own.html");
    const page_text = readFileSync(fileURLToPath(address), "utf8");
    const slot = 'id="sikku-patterns">';
    assert.ok(page_text.includes(`${slot}[]<`));
    writeFileSync(
        file,
        page_text.replace(`${slot}[]`, () => slot + own.replaceAll("<", "\\u003c")),
    );
    const page = await openStudio({ at: pathToFileURL(file).href });
    await page.locator("#work-title", { hasText: "My </script> own" }).waitFor();
    await page.getByRole("tab", { name: "Gallery" }).click();
    await page.locator(".cost", { hasText: "8 segments" }).waitFor();
    await page.getByRole("button", { name: "yours", exact: true }).click();
    await page.locator(".gallery-count", { hasText: `1 of ${bundled + arrangements + 1}` }).waitFor();
    await page.context().close();
    rmSync(folder, { recursive: true });
});

// Response times in milliseconds, which depend on the machine.
async function measure() {
    const context = await browser.newContext({ viewport: wide });
    await context.addInitScript(() => {
        globalThis.draws = [];
        for (const name of ["drawImage", "putImageData"]) {
            const draw = CanvasRenderingContext2D.prototype[name];
            CanvasRenderingContext2D.prototype[name] = function (...given) {
                if (this.canvas.classList.contains("map-canvas")) globalThis.draws.push(performance.now());
                return draw.apply(this, given);
            };
        }
        const forget = () => {
            globalThis.pressed = performance.now();
            globalThis.changes.length = 0;
        };
        addEventListener("keydown", forget, true);
        // The canvas names the work that it shows.
        globalThis.changes = [];
        const note = () => globalThis.changes.push(performance.now());
        const attributes = { attributes: true, attributeFilter: ["data-shows"], subtree: true };
        new MutationObserver(note).observe(document, attributes);
    });
    const page = await openStudio({ context });
    await page.waitForFunction(() => globalThis.draws.length > 0);
    console.log(`first picture after ${Math.round(await page.evaluate(() => globalThis.draws[0]))} ms`);
    for (const n of [7, 10]) {
        await setText(
            page,
            `derivation length: ${n}\nangle factor: 4\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nstroke: 0.3 step #8c3b24`,
        );
        await page.waitForTimeout(1500);
        const times = [];
        for (const key of ["Backspace", "5", "Backspace", "6", "Backspace", "4"]) {
            await page.keyboard.press(key);
            await page.waitForTimeout(600);
            times.push(await page.evaluate(() => Math.round(globalThis.changes[0] - globalThis.pressed)));
        }
        const frames = await page.evaluate(async () => {
            const width = document.querySelector(".value-rows .slider:last-child input[type=range]");
            globalThis.draws.length = 0;
            const from = performance.now();
            for (let frame = 0; performance.now() - from < 2000; ++frame) {
                await new Promise(requestAnimationFrame);
                width.valueAsNumber = 0.1 + 0.3 * Math.abs(Math.sin(frame / 20));
                width.dispatchEvent(new Event("input"));
            }
            return new Set(globalThis.draws.map(Math.round)).size / 2;
        });
        console.log(
            `n = ${n}, ${await cost(page)}: keystroke to picture ${times.join(", ")} ms; dragging ${frames} pictures a second`,
        );
    }
    await page.getByRole("tab", { name: "Gallery" }).click();
    const gallery = await page.evaluate(async () => {
        const from = performance.now();
        const panel = document.querySelector("#panel-gallery");
        const drawn = () => document.querySelectorAll(".gallery .picture:is(.drawn, .words)").length;
        for (let at = 0; drawn() < 220 && performance.now() - from < 20000; at += 600) {
            panel.scrollTop = at % panel.scrollHeight;
            await new Promise(requestAnimationFrame);
        }
        return [drawn(), Math.round(performance.now() - from)];
    });
    console.log(`gallery: ${gallery[0]} thumbnails in ${gallery[1]} ms`);
    await context.close();
}

let failures = 0;
const begin = Date.now();
for (const { name, run } of tests) {
    if (!name.includes(values.only) && name !== tests[0].name) continue;
    const start = Date.now();
    try {
        if (shared.page) shared.page.setDefaultTimeout(10_000);
        await run(shared);
        if (shared.page) assert.deepEqual(shared.page.problems.splice(0), []);
        console.log(`ok    ${name} (${((Date.now() - start) / 1000).toFixed(1)} s)`);
    } catch (error) {
        ++failures;
        console.log(`FAIL  ${name}: ${String(error.message ?? error).slice(0, 900)}`);
        if (shared.page) await screenshot(shared.page, `failed-${name.slice(0, 24).replaceAll(" ", "-")}`);
        await shared.page?.keyboard.press("Escape");
    }
}
if (values.measure) await measure();
await browser.close();
console.log(`${failures === 0 ? "all passed" : `${failures} failed`} in ${((Date.now() - begin) / 1000).toFixed(0)} s`);
process.exitCode = failures === 0 ? 0 : 1;
