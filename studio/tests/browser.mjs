// Opens the built page in headless Chromium with a work, for tests.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { basename, dirname, join, resolve } from "node:path";
import { chromium } from "playwright-core";
import { fileURLToPath, pathToFileURL } from "node:url";

export const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
export const addressOf = (page) =>
    pathToFileURL(resolve(page ?? join(root, "build/studio/sikku-studio.html"))).href;

const arguments_of_chromium = [
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--autoplay-policy=no-user-gesture-required",
    "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
];

export const launch = (executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium") =>
    chromium.launch({ executablePath, args: arguments_of_chromium });

/// The text of a bundled pattern: `curves/hilbert`, or only `hilbert`.
export function patternText(name) {
    const folder = join(root, "patterns");
    const files = readdirSync(folder, { recursive: true });
    const file = files.find((each) => each === `${name}.lsys` || basename(each) === `${name}.lsys`);
    return readFileSync(join(folder, file), "utf8");
}

/// Opens the page with a bundled pattern as the work of an earlier visit. Collects errors in `problems`.
export async function openWork(browser, address, name, options = {}) {
    const { settings = [], place = null, panel = "map", reducedMotion = "reduce", prepare } = options;
    const { viewport = { width: 1280, height: 800 }, draws = true } = options;
    const context = await browser.newContext({ viewport, reducedMotion, acceptDownloads: true });
    const page = await context.newPage();
    page.setDefaultTimeout(Number(process.env.TIMEOUT ?? 60_000));
    page.problems = [];
    page.on("pageerror", (error) => page.problems.push(error.message));
    const work = {
        pattern: { name: `${basename(name)}.lsys`, text: patternText(name), variant: "", settings },
        draw: [],
        play: [],
        place,
        panel,
    };
    if (prepare) await page.addInitScript(prepare);
    await page.addInitScript(
        (saved) => {
            if (!localStorage.getItem("sikku-studio")) localStorage.setItem("sikku-studio", saved);
        },
        JSON.stringify({ steps: [{ work, label: "Start", time: 1 }], at: 0 }),
    );
    await page.goto(address);
    await page.getByRole("tab", { name: "Gallery" }).waitFor();
    if (panel === "map" && draws) await page.waitForSelector(".map-canvas[data-shows]");
    return page;
}

export async function close(page) {
    assert.deepEqual(page.problems, []);
    await page.context().close();
}

/// Runs named tests one after another. Returns the number of failures.
export async function run(tests, only = "") {
    let failures = 0;
    for (const [name, test] of Object.entries(tests)) {
        if (!name.includes(only)) continue;
        try {
            await test();
            console.log(`ok    ${name}`);
        } catch (error) {
            ++failures;
            console.log(`FAIL  ${name}: ${String(error.stack ?? error).slice(0, 900)}`);
        }
    }
    return failures;
}
