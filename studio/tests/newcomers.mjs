// Tests what newcomers meet, in headless Chromium or Firefox: the guide, corrections, the angle, the steps of a
// derivation, plants, arrangements, films and sound, links that only show; and browsers that lack something.
//     node tests/newcomers.mjs [PAGE] [--firefox] [--only WORD]
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { parseArgs } from "node:util";
import { firefox } from "playwright-core";
import { anyBridge } from "./any_bridge.mjs";
import { addressOf, close, launch, patternText, run } from "./browser.mjs";

const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: { only: { type: "string", default: "" }, firefox: { type: "boolean", default: false } },
});
const address = addressOf(positionals[0]);
const browser = values.firefox
    ? await firefox.launch({
          channel: "moz-firefox",
          executablePath: process.env.FIREFOX ?? "/usr/bin/firefox-esr",
          firefoxUserPrefs: { "media.autoplay.default": 0, "media.autoplay.blocking_policy": 0 },
      })
    : await launch();
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const ask = await anyBridge();

// A page as a visitor sees it who comes for the first time.
async function visit({ viewport = { width: 1280, height: 800 }, fragment = "", prepare, ready = true } = {}) {
    const context = await browser.newContext({ viewport, reducedMotion: "reduce", acceptDownloads: true });
    const page = await context.newPage();
    page.setDefaultTimeout(Number(process.env.TIMEOUT ?? 60_000));
    page.problems = [];
    page.on("pageerror", (error) => page.problems.push(error.message));
    if (values.firefox) await page.addInitScript(keepDownloads);
    if (prepare) await page.addInitScript(prepare);
    await page.goto(address + fragment);
    if (ready) await page.getByRole("tab", { name: "Gallery" }).waitFor();
    if (ready && !fragment) await page.locator("#facts", { hasText: "No errors" }).waitFor();
    return page;
}

const guide = (page) => page.locator("#guide");
const guideButton = (page, name) => guide(page).getByRole("button", { name, exact: true });
const slider = (page, name) => page.getByRole("slider", { name, exact: true });
const textOf = (page) =>
    page.evaluate(() => [...document.querySelectorAll(".cm-line")].map((line) => line.textContent).join("\n"));
const isShown = (page, name) => page.getByRole("tab", { name, selected: true }).waitFor();

async function setText(page, content) {
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+a");
    await page.keyboard.insertText(content);
}

async function drop(page, name, content) {
    await page.evaluate(
        ([file, data]) => {
            const transfer = new DataTransfer();
            transfer.items.add(new File([data], file));
            document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
        },
        [name, content],
    );
}

async function checkAccess(page, what) {
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => globalThis.axe.run({ resultTypes: ["violations"] }));
    assert.deepEqual(violations.map(({ id, nodes }) => `${what}: ${id}: ${nodes[0].html.slice(0, 160)}`), []);
}

// Playwright does not see downloads of Firefox: keeps what a link would save.
function keepDownloads() {
    globalThis.saved = [];
    const blobs = new Map();
    const addressed = URL.createObjectURL;
    URL.createObjectURL = (blob) => {
        const address = addressed(blob);
        blobs.set(address, blob);
        return address;
    };
    const click = HTMLAnchorElement.prototype.click;
    HTMLAnchorElement.prototype.click = function () {
        if (!this.hasAttribute("download")) return click.call(this);
        const reader = new FileReader();
        reader.onload = () => globalThis.saved.push({ name: this.download, data: reader.result.split(",")[1] ?? "" });
        reader.readAsDataURL(blobs.get(this.href));
    };
}

async function download(page, act) {
    if (values.firefox) {
        await page.evaluate(() => { globalThis.saved.length = 0; });
        await act();
        await page.waitForFunction(() => globalThis.saved.length > 0, null, { timeout: 180_000 });
        const { name, data } = await page.evaluate(() => globalThis.saved.shift());
        return { name, bytes: Buffer.from(data, "base64") };
    }
    const [file] = await Promise.all([page.waitForEvent("download", { timeout: 180_000 }), act()]);
    return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
}

const linkOf = (shared) => ask({ do: "link", shared }).link;
const pattern = (text) => ({ name: "a.lsys", text, variant: "", settings: [] });

const tests = {
    async "a visitor is greeted, and makes a first kolam, poster or melody with two clicks"() {
        const page = await visit();
        await guide(page).getByRole("heading", { name: "Draw, print and play with a few letters" }).waitFor();
        await checkAccess(page, "welcome");
        await guideButton(page, "A kolam for the door").click();
        await isShown(page, "Kolam bench");
        const before = await textOf(page);
        await guideButton(page, "Surprise me").click();
        await page.waitForFunction((text) => document.querySelector(".cm-content").textContent !== text, before);
        await page.locator(".cm-content", { hasText: "// grid:" }).waitFor();
        // The aim ends where it does not apply.
        await page.getByRole("tab", { name: "Picture" }).click();
        assert.ok(await guide(page).isVisible());
        await page.getByRole("tab", { name: "Gallery" }).click();
        await guide(page).waitFor({ state: "hidden" });
        await close(page);

        const poster = await visit();
        await guideButton(poster, "A poster").click();
        await isShown(poster, "Gallery");
        const first = poster.locator(".gallery-first .card");
        assert.equal(await first.count(), 12);
        await first.filter({ hasText: "Penrose" }).click();
        await poster.locator("#work-title", { hasText: "Penrose" }).waitFor();
        await isShown(poster, "Picture");
        const box = await guide(poster).boundingBox();
        assert.ok(box.height < 200, "the guide stays, with the next steps");
        await close(poster);

        const melody = await visit();
        await guideButton(melody, "A melody").click();
        await isShown(melody, "Play");
        await melody.locator(".play-place", { hasText: "Bar 1" }).waitFor();
        await guideButton(melody, "More melodies").click();
        await isShown(melody, "Gallery");
        assert.match(await melody.locator(".gallery-count").textContent(), /^15 of/);
        await close(melody);

        const other = await visit();
        await other.getByRole("tab", { name: "Gallery" }).click();
        await guide(other).waitFor({ state: "hidden" });
        await close(other);
    },

    async "the guide has five steps, which are done or shown"() {
        const page = await visit();
        await guideButton(page, "Show me in five steps").click();
        await guide(page).getByText("1 of 5").waitFor();
        await slider(page, "n").focus();
        await page.keyboard.press("ArrowLeft");
        await guide(page).getByText("Done.").waitFor();
        await checkAccess(page, "guide");
        await guideButton(page, "Next").click();
        await guide(page).getByText("2 of 5").waitFor();
        await slider(page, "angle").focus();
        await page.keyboard.press("ArrowLeft");
        await page.keyboard.press("ArrowLeft");
        await guide(page).getByText("Done.").waitFor();
        await guideButton(page, "Next").click();
        await guide(page).getByText("3 of 5").waitFor();
        await guideButton(page, "Do it for me").click();
        await guide(page).getByText("Done.").waitFor();
        await guideButton(page, "Next").click();
        await guideButton(page, "Do it for me").click();
        await isShown(page, "Play");
        await guideButton(page, "Next").click();
        await guide(page).getByText("5 of 5").waitFor();
        await guideButton(page, "A poster").waitFor();
        await page.getByRole("button", { name: "Close the guide" }).click();
        await guide(page).waitFor({ state: "hidden" });
        await page.reload();
        await page.locator("#facts", { hasText: "No errors" }).waitFor();
        assert.ok(await guide(page).isHidden());
        // It comes back from the menu, with its own pattern.
        await setText(page, "axiom: F\n");
        await page.getByRole("button", { name: "More", exact: true }).click();
        await page.getByRole("menuitem", { name: "Guided start" }).click();
        await page.locator("#work-title", { hasText: "Snake kolam" }).waitFor();
        await guide(page).getByText("1 of 5").waitFor();
        await close(page);
    },

    async "an L-system and n are explained where they stand"() {
        const page = await visit();
        assert.ok(await page.locator(".explanation").isHidden(), "the greeting says the same");
        await page.getByRole("button", { name: "Close the guide" }).click();
        await page.locator(".explanation", { hasText: "This is an L-system" }).waitFor();
        await page.locator(".meaning-of-n", { hasText: "replaces all letters n times" }).waitFor();
        await page.getByRole("button", { name: "Hide this explanation" }).click();
        await page.reload();
        await page.locator("#facts", { hasText: "No errors" }).waitFor();
        assert.ok(await page.locator(".explanation").isHidden());
        await close(page);
    },

    async "other notations are corrected with a click, one by one or all"() {
        const page = await visit();
        await setText(page, "title: Arrows\naxiom = F\nF → F+F\nangel factor: 4\n");
        await page.locator(".line-message .correction").nth(2).waitFor();
        await page.locator(".line-message", { hasText: "'→' is not the arrow" }).getByRole("button").click();
        await page.locator(".cm-content", { hasText: "F --> F+F" }).waitFor();
        await page.locator(".error-strip").getByRole("button", { name: "Correct all 2" }).click();
        await page.locator("#facts", { hasText: "No errors" }).waitFor();
        assert.equal((await textOf(page)).trim(), "title: Arrows\naxiom: F\nF --> F+F\nangle factor: 4");
        await page.keyboard.press("Control+z");
        await page.locator(".cm-content", { hasText: "axiom = F" }).waitFor();
        await close(page);
    },

    async "the angle turns continuously and returns to its fraction"() {
        const page = await visit();
        const field = page.getByRole("textbox", { name: "angle, value" });
        assert.equal(await field.inputValue(), "360/4");
        await slider(page, "angle").focus();
        const seen = new Set();
        for (let press = 0; press < 6; ++press) {
            await page.keyboard.press("ArrowLeft");
            seen.add(await field.inputValue());
        }
        assert.ok(seen.has("89°") && seen.has("85°"), [...seen].join());
        await field.fill("72");
        await field.press("Enter");
        assert.equal(await field.inputValue(), "360/5");
        await field.fill("84.5");
        await field.press("Enter");
        await page.getByRole("button", { name: "Write into the text" }).click();
        await page.locator(".cm-content", { hasText: "angle increment: 84.5" }).waitFor();
        assert.ok(!(await textOf(page)).includes("angle factor"));
        await page.locator("#facts", { hasText: "No errors" }).waitFor();
        await close(page);
    },

    async "the derivation is shown step by step"() {
        const page = await visit();
        await page.getByRole("tab", { name: "Steps" }).click();
        const rows = page.locator(".steps-list > li");
        await rows.nth(3).waitFor();
        assert.equal((await rows.nth(0).locator(".steps-word").textContent()).trim(), "f+Xf+f+Xf");
        assert.equal(await rows.nth(0).locator(".replaced").count(), 2);
        const second = rows.nth(1);
        assert.equal(await second.locator(".made.first").count(), 2);
        assert.equal((await second.locator(".made").allTextContents()).join(""), "Xf-f-f+Xf+f+Xf-f-f+X".repeat(2));
        await second.locator(".made").first().hover();
        // The X that the letter comes from, what that becomes, and what the letter itself becomes.
        assert.equal(await page.locator(".steps-word .pointed").count(), 1 + 20 + 20);
        await checkAccess(page, "steps");
        await rows.nth(2).getByRole("button", { name: "Set n = 2" }).click();
        await page.waitForFunction(() => document.querySelectorAll(".steps-list > li").length === 3);
        assert.equal(await slider(page, "n").inputValue(), "2");
        await setText(page, patternText("gourd"));
        await page.locator(".steps-intro", { hasText: "the map at the beginning" }).waitFor();
        await close(page);
    },

    async "Space offers a plant to who has none"() {
        const page = await visit();
        await page.getByRole("tab", { name: "Space" }).click();
        const note = page.locator("#panel-space :is(.note, .empty):visible", { hasText: /draws a spline|no WebGL2/ });
        await note.waitFor();
        if ((await note.textContent()).includes("no WebGL2")) return close(page);
        await page.getByRole("button", { name: "Open a plant" }).click();
        await page.locator("#work-title", { hasText: "Bush in space" }).waitFor();
        await page.locator(".space-facts", { hasText: "triangles" }).waitFor();
        await close(page);
    },

    async "arrangements open from the gallery and as files, play, and are exported"() {
        const page = await visit();
        await page.getByRole("tab", { name: "Gallery" }).click();
        await page.getByRole("button", { name: "arrangements", exact: true }).click();
        await page.locator(".card:visible", { hasText: "Canon on Dekking" }).click();
        await isShown(page, "Play");
        await page.locator(".play-arranged", { hasText: "Canon on Dekking's curve" }).waitFor();
        await page.locator(".play-facts", { hasText: /\d+ notes in \d+ bars/ }).waitFor();
        assert.ok((await page.getByRole("button", { name: /^Mute/ }).count()) >= 2, "two voices");
        const midi = await download(page, () => page.getByRole("button", { name: "Save as MIDI" }).click());
        assert.equal(midi.name, "canon.mid");
        assert.equal(midi.bytes.subarray(0, 4).toString(), "MThd");
        await page.getByRole("button", { name: "Play", exact: true }).click();
        await page.getByRole("button", { name: "Pause", exact: true }).waitFor();
        await page.waitForFunction(() => !/beat 1$/.test(document.querySelector(".play-place").textContent));
        await checkAccess(page, "arrangement");
        await page.getByRole("button", { name: "Play the pattern instead" }).click();
        await page.locator(".play-arranged").waitFor({ state: "hidden" });
        await page.locator(".play-place", { hasText: "Bar 1" }).waitFor();
        await page.getByRole("button", { name: /^Undo/ }).click();
        await page.locator(".play-arranged", { hasText: "Canon" }).waitFor();
        const own = 'title = "Two voices"\n[[track]]\npattern = "hilbert"\n[[track]]\npattern = "hilbert"\ntransposition = 12\n';
        await drop(page, "two.toml", own);
        await page.locator(".play-arranged", { hasText: "Two voices" }).waitFor();
        await page.locator(".play-facts", { hasText: "notes" }).waitFor();
        await drop(page, "wrong.toml", '[[track]]\npattern = "mine"\n');
        await page.locator(".play-problem:visible", { hasText: "neither bundled nor in the file" }).waitFor();
        await drop(page, "other.toml", "a = 1\n");
        await page.locator("#message", { hasText: "no arrangement" }).waitFor();
        await close(page);
    },

    async "Back and Forward of the browser return to patterns, without losing changes"() {
        const page = await visit();
        const title = (text) => page.locator("#work-title", { hasText: text }).waitFor();
        for (const name of ["Dragon", "Penrose"]) {
            await page.getByRole("tab", { name: "Gallery" }).click();
            await page.locator(".gallery-first .card", { hasText: name }).click();
            await title(name);
        }
        await setText(page, patternText("penrose-rhombs").replace(/^title: .*/m, "title: My Penrose"));
        await title("My Penrose");
        await page.goBack();
        await title("Dragon");
        await page.goBack();
        await title("Snake kolam");
        await page.goForward();
        await title("Dragon");
        await page.goForward();
        await title("My Penrose");
        await page.goBack();
        await title("Dragon");
        await page.getByRole("button", { name: /^Undo/ }).click();
        await title("My Penrose");
        await close(page);
    },

    async "words that draw nothing are shown"() {
        const page = await visit();
        await setText(page, "title: Algae\nderivation length: 5\naxiom: A\nA --> AB\nB --> A\n");
        await page.locator(".map-word", { hasText: "ABAABABAABAAB" }).waitFor();
        await page.locator(".map-word h3", { hasText: "The word after 5 steps" }).waitFor();
        await slider(page, "n").focus();
        await page.keyboard.press("ArrowLeft");
        await page.locator(".map-word h3", { hasText: "The word after 4 steps" }).waitFor();
        await checkAccess(page, "word");
        await page.getByRole("button", { name: "All steps" }).click();
        await isShown(page, "Steps");
        await page.locator(".steps-list > li").nth(2).waitFor();
        await close(page);
    },

    async "a map tells its size, and varies without angles and filters"() {
        const page = await visit();
        await setText(page, "map: clockwise\nderivation length: 2\naxiom: A~B~AB\nA --> B[-A][+~A]B\nB --> ~A\n");
        await page.locator(".cost", { hasText: "4 cells" }).waitFor();
        assert.equal(await slider(page, "angle").count(), 0);
        await page.getByRole("tab", { name: "Variations" }).click();
        await page.locator(".variant:not(.waits)").first().waitFor();
        assert.ok(await page.getByRole("group", { name: "Show only" }).isHidden());
        await page.getByRole("group", { name: "Keep unchanged" }).waitFor();
        assert.equal(await page.getByRole("group", { name: "Keep unchanged" }).getByText("angle").count(), 0);
        await close(page);
    },

    async "a search that finds nothing says why, without empty frames"() {
        const page = await visit();
        await page.getByRole("tab", { name: "Variations" }).click();
        await page.locator(".variant:not(.waits)").first().waitFor();
        for (const name of ["Closed", "Single line", "Self-avoiding", "Kolam"]) {
            await page.getByRole("button", { name, exact: true }).click();
        }
        const note = page.locator(".variations-nothing");
        await note.waitFor();
        assert.match(await note.textContent(), /No variant passes the filters\. Of [\d,]+ variants: .*have open lines/);
        assert.equal(await page.locator(".variant").count(), 0);
        await checkAccess(page, "no variants");
        await note.getByRole("button", { name: "Without “Self-avoiding”" }).click();
        assert.equal(await page.getByRole("button", { name: "Self-avoiding", exact: true }).getAttribute("aria-pressed"), "false");
        await close(page);
    },

    async "Play draws the curve that Picture shows"() {
        const page = await visit();
        await page.getByRole("tab", { name: "Play" }).click();
        await page.locator(".play-place", { hasText: "Bar 1" }).waitFor();
        // At the corner of a control polygon there is no line, because the curve is round.
        await page.waitForTimeout(800);
        const colours = await page.evaluate(() => {
            const canvas = document.querySelector(".play-curve-canvas");
            const { width, height } = canvas;
            const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
            let left = width, top = height, right = 0, bottom = 0;
            for (let y = 0; y < height; ++y) for (let x = 0; x < width; ++x) {
                if (data[4 * (y * width + x) + 3] < 60) continue;
                left = Math.min(left, x); right = Math.max(right, x); top = Math.min(top, y); bottom = Math.max(bottom, y);
            }
            return { across: (right - left) / width, down: (bottom - top) / height };
        });
        assert.ok(colours.across > 0 && colours.down > 0.3);
        await page.screenshot({ path: process.env.SHOT ?? "/tmp/play.png" });
        await close(page);
    },

    async "links to bundled patterns open at once, and others show their text first"() {
        const { text } = ask({ do: "patterns" }).patterns.find(({ name }) => name === "lilac");
        const bundled = linkOf({ pattern: { name: "lilac.lsys", text } });
        const page = await visit({ fragment: `#${bundled}` });
        await page.locator("#work-title", { hasText: "Lilac" }).waitFor();
        assert.equal(await page.getByRole("dialog").count(), 0);
        await page.waitForFunction(() => location.hash === "");
        await page.evaluate((link) => { location.hash = link; }, linkOf({ pattern: { name: "a.lsys", text: `${text}\n` } }));
        await page.getByRole("dialog", { name: "This link contains a pattern" }).waitFor();
        await close(page);
    },

    async "a link contains the arrangement"() {
        const page = await visit();
        await page.getByRole("tab", { name: "Gallery" }).click();
        await page.getByRole("searchbox", { name: "Search patterns" }).fill("canon dekking");
        await page.locator(".card:visible", { hasText: "Canon on" }).click();
        await page.locator(".play-place", { hasText: "Bar 1" }).waitFor();
        await page.getByRole("button", { name: "Share" }).click();
        await page.getByText("Commands read only the pattern of the link").waitFor();
        const link = await page.getByRole("textbox", { name: "Link" });
        await page.waitForFunction(() => document.querySelector("textarea[aria-label=Link]").value.includes("#sikku1."));
        const fragment = (await link.inputValue()).replace(/^.*#/, "#");
        const { shared } = ask({ do: "read_link", link: fragment });
        assert.equal(JSON.parse(shared.page.arrangement).name, "canon.toml");
        await close(page);

        const edited = structuredClone(shared);
        edited.page.arrangement = shared.page.arrangement.replace("Canon on Dekking's curve", "Canon of mine");
        const other = await visit({ fragment: `#${linkOf(edited)}` });
        const dialog = other.getByRole("dialog", { name: "This link contains an arrangement" });
        await dialog.getByText("[[track]]").first().waitFor();
        await dialog.getByRole("button", { name: "Open", exact: true }).click();
        await other.locator(".play-arranged", { hasText: "Canon of mine" }).waitFor();
        await other.getByRole("button", { name: /^Undo/ }).click();
        await other.locator(".play-arranged").waitFor({ state: "hidden" });
        await other.getByRole("button", { name: /^Redo/ }).click();
        await other.locator(".play-arranged:visible").waitFor();
        await close(other);

        const viewed = await visit({ fragment: `${fragment}&view=only`, ready: false });
        await viewed.locator(".play-place", { hasText: "Bar 1" }).waitFor();
        await viewed.getByText("Arrangement:").waitFor();
        await close(viewed);
    },

    async "a film of the line is saved as GIF, growth too"() {
        const page = await visit();
        await page.getByRole("button", { name: "Export" }).click();
        await page.getByRole("button", { name: "Film, GIF or WAV…" }).click();
        const dialog = page.getByRole("dialog", { name: "Film and sound" });
        await dialog.getByLabel("Length, in seconds").fill("2");
        await dialog.getByLabel("Longer side").selectOption("320");
        await checkAccess(page, "film");
        for (const kind of ["The line is drawn", "Growth, from n = 0"]) {
            await dialog.getByLabel(kind).click();
            const { name, bytes } = await download(page, () => dialog.getByRole("button", { name: "Save as GIF" }).click());
            assert.equal(name, "snake-kolam.gif");
            // The browser reads it: two pictures of the film differ, and the last one is mostly the ground.
            const facts = await page.evaluate(async (data) => {
                const image = new Image();
                image.src = `data:image/gif;base64,${data}`;
                await image.decode();
                return [image.naturalWidth, image.naturalHeight];
            }, bytes.toString("base64"));
            assert.deepEqual(facts[1], 320);
            assert.ok(Math.abs(facts[0] - 226) <= 1, facts.join());
            const frames = bytes.toString("latin1").split("\x21\xf9\x04").length - 1;
            assert.ok(kind.startsWith("Growth") ? frames >= 3 && frames <= 5 : frames > 30 && frames <= 41, `${frames} pictures`);
            await dialog.locator(".film-status", { hasText: "Saved" }).waitFor();
        }
        await page.keyboard.press("Escape");
        await close(page);
    },

    async "a film is recorded as WebM, and plays in the browser"() {
        const page = await visit();
        await page.getByRole("button", { name: "Export" }).click();
        await page.getByRole("button", { name: "Film, GIF or WAV…" }).click();
        const dialog = page.getByRole("dialog", { name: "Film and sound" });
        await dialog.getByLabel("Length, in seconds").fill("2");
        const { name, bytes } = await download(page, () => dialog.getByRole("button", { name: "Save as WebM" }).click());
        assert.equal(name, "snake-kolam.webm");
        assert.equal(bytes.subarray(0, 4).toString("hex"), "1a45dfa3");
        const facts = await page.evaluate(async (data) => {
            const video = document.createElement("video");
            video.muted = true;
            const blob = new Blob([Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0))], { type: "video/webm" });
            video.src = URL.createObjectURL(blob);
            await new Promise((done, fail) => {
                video.onloadeddata = done;
                video.onerror = () => fail(new Error(video.error.message));
            });
            await video.play();
            await new Promise((done) => { video.onended = done; });
            return [video.videoWidth, video.videoHeight, video.currentTime];
        }, bytes.toString("base64"));
        assert.equal(facts[1], 480);
        assert.ok(facts[2] > 1.5 && facts[2] < 8, `${facts[2]} seconds`);
        await close(page);
    },

    async "a melody is saved as WAV"() {
        const page = await visit();
        await setText(page, "title: Short\nderivation length: 2\nangle factor: 4\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\n");
        await page.getByRole("tab", { name: "Play" }).click();
        await page.locator(".play-facts", { hasText: "notes" }).waitFor();
        await page.getByRole("button", { name: "Save as WAV or film…" }).click();
        const dialog = page.getByRole("dialog", { name: "Film and sound" });
        const { name, bytes } = await download(page, () => dialog.getByRole("button", { name: "Save as WAV" }).click());
        assert.match(name, /\.wav$/);
        assert.equal(bytes.readUInt32LE(24), 44100);
        assert.equal(bytes.readUInt32LE(40), bytes.length - 44);
        let most = 0;
        let sum = 0;
        const count = (bytes.length - 44) / 2;
        for (let i = 0; i < count; ++i) {
            const sample = bytes.readInt16LE(44 + 2 * i) / 32768;
            most = Math.max(most, Math.abs(sample));
            sum += sample * sample;
        }
        assert.ok(most > 0.05 && most <= 1, `peak ${most}`);
        assert.ok(Math.sqrt(sum / count) > 0.005, "it is not silent");
        // An independent reader agrees about the length.
        const read = spawnSync("python3", ["-c", "import sys,wave,io;w=wave.open(io.BytesIO(sys.stdin.buffer.read()));print(w.getnframes(),w.getnchannels())"], { input: bytes });
        if (read.status === 0) assert.equal(read.stdout.toString().trim(), `${count / 2} 2`);
        await close(page);
    },

    async "a link that only shows has neither text nor tools, and keeps nothing"() {
        const text = "title: Shown alone\nderivation length: 3\nangle factor: 4\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nground: #123456\n";
        const fragment = `#${linkOf({ pattern: pattern(text), page: { panel: "map" } })}&view=only`;
        const page = await visit({ fragment, ready: false });
        await page.waitForSelector(".map-canvas[data-shows]");
        await page.getByRole("link", { name: "Shown alone · Sikku" }).waitFor();
        for (const hidden of [".bar", ".side", ".tabs", ".status", "#guide"]) assert.ok(await page.locator(hidden).isHidden(), hidden);
        const box = await page.locator(".map-canvas").boundingBox();
        assert.deepEqual([box.x, box.y, box.width, box.height], [0, 0, 1280, 800]);
        assert.equal(await page.title(), "Shown alone");
        await page.waitForTimeout(600);
        assert.equal(await page.evaluate(() => localStorage.getItem("sikku-studio")), null);
        const href = await page.getByRole("link", { name: "Shown alone · Sikku" }).getAttribute("href");
        assert.ok(href.endsWith(fragment.replace("&view=only", "")));
        await checkAccess(page, "view only");
        await close(page);
        const playing = await visit({
            fragment: `#${linkOf({ pattern: pattern(patternText("hilbert-todi")), page: { panel: "play" } })}&view=only`,
            ready: false,
        });
        await playing.locator(".play-place", { hasText: "Bar 1" }).waitFor();
        assert.ok(await playing.getByRole("button", { name: "Play", exact: true }).isVisible());
        const [link, position] = await Promise.all([".view-link", ".play-position"].map((each) => playing.locator(each).boundingBox()));
        assert.ok(position.y + position.height <= link.y, "the link lies below the position");
        await close(playing);
        const wrong = await visit({ fragment: "#sikku1.nonsense&view=only", ready: false });
        await wrong.locator(".broken", { hasText: "the link cannot be read" }).waitFor();
        await close(wrong);
    },

    async "a link of 10 MB is refused with a sentence, or shown in part"() {
        const page = await visit();
        // Firefox refuses addresses of more than 1 MiB itself.
        const hash = `#sikku1.${"A".repeat(values.firefox ? 1_000_000 : 10_000_000)}`;
        await page.evaluate((long) => { location.hash = long; }, hash);
        await page.locator("#message[data-kind=error]", { hasText: "The link cannot be read" }).waitFor();
        assert.ok((await page.locator("#message").textContent()).length < 500);
        // A link can hold a long text: it is shown from its beginning.
        const long = linkOf({ pattern: pattern(`title: Long\naxiom: F\n${"// filler\n".repeat(1_000_000)}`) });
        await page.evaluate((link) => { location.hash = link; }, long);
        const dialog = page.getByRole("dialog", { name: "This link contains a pattern" });
        await dialog.getByText("more characters are not shown").waitFor();
        await dialog.getByRole("button", { name: "Discard" }).click();
        await slider(page, "n").focus();
        await page.keyboard.press("ArrowLeft");
        await page.locator(".cost", { hasText: "807 symbols" }).waitFor();
        await close(page);
    },

    async "a browser without local storage starts the studio"() {
        const page = await visit({
            prepare: () => Object.defineProperty(globalThis, "localStorage", {
                get() { throw new DOMException("The operation is insecure.", "SecurityError"); },
            }),
        });
        await guideButton(page, "Show me in five steps").waitFor();
        await slider(page, "n").focus();
        await page.keyboard.press("ArrowLeft");
        await page.locator(".cost", { hasText: "807 symbols" }).waitFor();
        await page.locator("#message", { hasText: "no room to keep this work" }).waitFor();
        await page.getByRole("button", { name: "Close the guide" }).click();
        await close(page);
    },

    async "a first visit shows the picture before the libraries have started"() {
        const stall = () => { WebAssembly.compile = (bytes) => new Promise((go) => { globalThis.go = () => go(new WebAssembly.Module(bytes)); }); };
        for (const viewport of [{ width: 1280, height: 800 }, { width: 390, height: 844 }]) {
            const page = await visit({ prepare: stall, viewport, ready: false });
            const draft = page.locator("#panel-map #draft svg");
            await draft.waitFor();
            assert.equal(await page.locator(".map-canvas[data-shows]").count(), 0);
            const edges = (box) => [box.x, box.y, box.x + box.width, box.y + box.height].map(Math.round);
            const before = edges(await draft.locator("rect").first().boundingBox());
            assert.ok(await draft.locator("path").first().isVisible());
            await page.locator("#guide button.primary").waitFor({ state: "hidden" });
            await page.waitForFunction(() => globalThis.go);
            await page.evaluate(() => globalThis.go());
            await page.locator(".map-canvas[data-shows]").waitFor();
            await page.locator("#draft").waitFor({ state: "detached" });
            await page.getByRole("button", { name: "Close the guide" }).click(); // it makes the map smaller
            const after = await page.evaluate(async () => {
                const canvas = document.querySelector(".map-canvas");
                for (let frame = 0; frame < 30; ++frame) await new Promise(requestAnimationFrame);
                const { left, top } = canvas.getBoundingClientRect();
                const { data, width, height } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
                const edges = [width, height, 0, 0];
                for (let at = 0; at < width * height; ++at) {
                    if (data[4 * at] !== 0x8c || data[4 * at + 1] !== 0x3b || data[4 * at + 2] !== 0x2a) continue;
                    const [x, y] = [at % width, Math.floor(at / width)];
                    edges.splice(0, 4, Math.min(edges[0], x), Math.min(edges[1], y), Math.max(edges[2], x + 1), Math.max(edges[3], y + 1));
                }
                return [edges[0] + left, edges[1] + top, edges[2] + left, edges[3] + top].map(Math.round);
            });
            const most = viewport.width < 480 ? 8 : 3; // the status bar of a narrow page gets a second line
            for (const [at, edge] of after.entries()) assert.ok(Math.abs(edge - before[at]) <= most, `${before} became ${after}`);
            await page.context().close();
        }
    },

    async "a link or saved work shows no draft"() {
        const stall = () => { WebAssembly.compile = () => new Promise(() => {}); };
        const keep = () => localStorage.setItem("sikku-studio", JSON.stringify({ steps: [], at: 0 }));
        for (const options of [{ fragment: "#p1" }, { prepare: `(${keep})(); (${stall})();` }]) {
            const page = await visit({ prepare: stall, ready: false, ...options });
            await page.locator(".brand").waitFor();
            await page.waitForFunction(() => document.readyState === "complete");
            assert.equal(await page.locator("#draft").count(), 0);
            await page.context().close();
        }
    },

    async "a browser without WebAssembly gets a sentence, not an empty page"() {
        for (const prepare of [
            () => { delete globalThis.WebAssembly; },
            () => { WebAssembly.compile = () => Promise.reject(new WebAssembly.CompileError("Wasm code generation disallowed by embedder")); },
        ]) {
            const page = await visit({ prepare, ready: false });
            await page.locator(".broken:visible", { hasText: "The studio needs WebAssembly" }).waitFor();
            assert.equal(await page.getByRole("button", { name: "Start without the saved work" }).count(), 0);
            await page.context().close();
        }
    },

    async "a browser without scripts gets a sentence"() {
        if (values.firefox) return;
        const context = await browser.newContext({ javaScriptEnabled: false });
        const page = await context.newPage();
        await page.goto(address);
        const sentence = page.locator("noscript .broken");
        assert.match(await sentence.textContent(), /^The studio needs JavaScript and WebAssembly/);
        assert.ok(await sentence.isVisible());
        assert.ok(await page.locator(".panels").isHidden());
        await context.close();
    },
};

for (const [width, height] of [[320, 640], [390, 844], [560, 800], [720, 450], [960, 600], [1024, 768], [1100, 700]]) {
    tests[`the guide leaves room for the picture at ${width} × ${height}`] = async () => {
        const page = await visit({ viewport: { width, height } });
        for (const step of [null, ...Array(5).keys()]) {
            if (step === 0) await guideButton(page, "Show me in five steps").click();
            else if (step !== null) await guideButton(page, "Next").click();
            const cut = await page.evaluate(() => [...document.querySelectorAll("#guide button, #guide p")]
                .filter((each) => each.checkVisibility())
                .filter((each) => each.getBoundingClientRect().right > innerWidth + 0.5)
                .map((each) => each.textContent));
            assert.deepEqual(cut, []);
            if (step === null || step > 2) continue;
            const box = await page.locator(".map-canvas").boundingBox();
            assert.ok(box.height >= 120, `the picture is ${box.height} pixels high in step ${step}`);
        }
        await close(page);
    };
}

const failures = await run(tests, values.only);
await browser.close();
process.exitCode = failures === 0 ? 0 : 1;
