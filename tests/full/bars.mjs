// Opens the page of an arrangement in changing meters in a browser: its loops begin and end at bar lines.
// usage: bars.mjs PLAYWRIGHT_FOLDER BROWSER PAGE
import assert from "node:assert/strict";
import {createRequire} from "node:module";
import {pathToFileURL} from "node:url";

const [modules, executablePath, file] = process.argv.slice(2);
const {chromium} = createRequire(modules + "/")("playwright-core");
const browser = await chromium.launch({executablePath, args: ["--no-sandbox", "--disable-gpu"]});
const page = await browser.newPage();
const complaints = [];
page.on("pageerror", error => complaints.push(String(error)));
await page.goto(pathToFileURL(file).href);
const {bars, end} = await page.evaluate(() => JSON.parse(document.getElementById("score").textContent));
assert.ok(bars.length > 2);
// All bar lines, one after the other.
const lines = [];
for (let tick = 0, length = 0; tick < end; tick += length) {
  for (const [onset, bar] of bars) if (onset === tick) length = bar;
  lines.push(tick);
}
lines.push(end);
const loop = page.getByRole("button", {name: "Loop"});
let count = 0;
for (let from = 1; from < lines.length; from += 3) {
  const to = Math.min(from + 1, lines.length - 1);
  await page.locator("#loop-from").fill(String(from));
  await page.locator("#loop-to").fill(String(to));
  await loop.click();
  assert.deepEqual(await page.evaluate(() => window.sikku.state().loop), [lines[from - 1], lines[to]], `bars ${from} to ${to}`);
  await loop.click();
  ++count;
}
assert.deepEqual(complaints, []);
await browser.close();
console.log(`bars: ${count} loops in ${bars.length} meters`);
