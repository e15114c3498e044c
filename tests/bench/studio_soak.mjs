// Uses the studio for some minutes as an impatient person would, and prints the memory of its process each minute.
//     node tests/bench/studio_soak.mjs [MINUTES (60)] [PAGE]
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const { chromium } = createRequire(join(root, "studio/package.json"))("playwright-core");
const minutes = Number(process.argv[2] ?? 60);
const address = pathToFileURL(resolve(process.argv[3] ?? join(root, "build/studio/sikku-studio.html"))).href;

const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
        "--autoplay-policy=no-user-gesture-required"],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
const problems = [];
page.on("pageerror", (error) => problems.push(error.message));
await page.goto(address);
await page.getByRole("tab", { name: "Gallery" }).waitFor();

const patterns = [];
for (const kind of ["kolams", "curves", "tilings", "plants", "melodies"]) {
    for (const name of readdirSync(join(root, "patterns", kind))) {
        if (name.endsWith(".lsys")) patterns.push(readFileSync(join(root, "patterns", kind, name), "utf8"));
    }
}

// Memory of the process that shows the page and runs its workers, with its share of what several processes share.
function megabytes() {
    const processes = execFileSync("ps", ["-eo", "pid,args"]).toString().split("\n");
    const sizes = processes.filter((line) => line.includes("--type=renderer")).map((line) => {
        const rollup = readFileSync(`/proc/${parseInt(line, 10)}/smaps_rollup`, "utf8");
        return Number(/^Pss:\s+(\d+)/m.exec(rollup)[1]) / 1024;
    });
    return Math.round(Math.max(...sizes));
}

const tab = (name) => page.getByRole("tab", { name, exact: true }).click();
const write = async (text) => {
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+a");
    await page.keyboard.insertText(text);
    await page.waitForTimeout(300);
};
const acts = [
    async (round) => write(patterns[(round * 7) % patterns.length]),
    async () => {
        await tab("Picture");
        await page.mouse.move(900, 400);
        for (let turn = 0; turn < 25; ++turn) await page.mouse.wheel(0, turn < 15 ? -200 : 200);
        await page.waitForTimeout(500);
    },
    async () => {
        const slider = page.locator("input[type=range]").first();
        await slider.focus();
        for (const key of ["ArrowRight", "ArrowLeft", "ArrowLeft", "ArrowRight"]) await page.keyboard.press(key);
        await page.waitForTimeout(300);
    },
    async () => {
        await tab("Variations");
        await page.waitForTimeout(1500);
    },
    async () => {
        await tab("Space");
        await page.waitForTimeout(700);
    },
    async () => {
        await tab("Play");
        await page.waitForTimeout(300);
        const play = page.locator(".play-main");
        if (await play.isEnabled()) {
            await play.click();
            await page.waitForTimeout(1500);
            await play.click();
        }
    },
    async () => {
        await tab("Gallery");
        await page.mouse.move(900, 500);
        await page.mouse.wheel(0, 1500);
        await page.waitForTimeout(500);
    },
    async () => {
        await tab("Picture");
        await page.keyboard.press("Control+z");
        await page.keyboard.press("Control+z");
        await page.waitForTimeout(300);
    },
];
const begin = Date.now();
let said = 0;
let most = 0;
for (let round = 0; Date.now() - begin < minutes * 60_000; ++round) {
    for (const act of acts) {
        try {
            await act(round);
        } catch (error) {
            problems.push(String(error.message).split("\n")[0]);
        }
    }
    most = Math.max(most, megabytes());
    if ((Date.now() - begin) / 60_000 >= said) {
        console.log(`minute ${said}: ${megabytes()} MB, ${round + 1} rounds`);
        ++said;
    }
}
console.log(`at most ${most} MB after a round; problems: ${problems.length === 0 ? "none" : problems.slice(0, 5).join("; ")}`);
await browser.close();
process.exitCode = problems.length === 0 ? 0 : 1;
