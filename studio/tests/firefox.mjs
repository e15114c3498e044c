// Tests the page in Firefox: it opens from a file, draws, reports errors, and all panels open without errors.
//     node tests/firefox.mjs sikku-studio.html
import assert from "node:assert/strict";
import { firefox } from "playwright-core";
import { addressOf } from "./browser.mjs";

// This channel is Firefox as Mozilla and Debian build it, through WebDriver BiDi.
const browser = await firefox.launch({
    channel: "moz-firefox", executablePath: process.env.FIREFOX ?? "/usr/bin/firefox-esr",
});
try {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
    const problems = [];
    page.on("pageerror", (error) => problems.push(error.message));
    page.on("console", (message) => { if (message.type() === "error") problems.push(message.text()); });
    await page.goto(addressOf(process.argv[2]));
    const facts = (text) => page.waitForFunction(
        (wanted) => document.querySelector("#facts")?.textContent.includes(wanted), text, { timeout: 30_000 });
    await facts("No errors");

    // The colours on the screen.
    const colours = async () => page.evaluate(async (screenshot) => {
        const image = new Image();
        image.src = `data:image/png;base64,${screenshot}`;
        await image.decode();
        const canvas = new OffscreenCanvas(image.width, image.height);
        const context = canvas.getContext("2d");
        context.drawImage(image, 0, 0);
        const pixels = context.getImageData(0, 0, canvas.width, canvas.height).data;
        const seen = new Set();
        for (let i = 0; i < pixels.length; i += 4) seen.add((pixels[i] << 16) | (pixels[i + 1] << 8) | pixels[i + 2]);
        return [...seen];
    }, (await page.screenshot()).toString("base64"));
    const has = async (colour) => {
        for (let attempt = 0; attempt < 20; ++attempt) {
            if ((await colours()).includes(colour)) return true;
            await new Promise((wait) => setTimeout(wait, 100));
        }
        return false;
    };
    assert.ok(await has(0x8c3b2a), "the picture has the kolam's ground");

    await page.click(".cm-content");
    await page.keyboard.press("Control+End");
    await page.keyboard.type("angel: 4");
    await facts("1 error");
    assert.ok(await has(0x8c3b2a), "the last valid picture stays");
    for (let i = 0; i < 8; ++i) await page.keyboard.press("Backspace");
    await facts("No errors");
    await page.keyboard.press("Control+a");
    await page.keyboard.type("axiom: F+F+F\nground: #123456");
    await facts("No errors");
    assert.ok(await has(0x123456), "the picture is redrawn from the text");

    for (const tab of await page.getByRole("tab").all()) {
        await tab.click();
        await new Promise((wait) => setTimeout(wait, 500));
    }
    assert.deepEqual(problems, []);
    console.log(`Firefox ${browser.version()}: opens, draws, reports errors, opens every panel`);
} finally {
    await browser.close();
}
