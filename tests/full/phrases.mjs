// Opens the page of a melody with phrases in a browser: tests the marks at their beginnings, and the jumps to them.
// usage: phrases.mjs PLAYWRIGHT_FOLDER BROWSER PAGE [SCREENSHOT]
import assert from "node:assert/strict";
import {createRequire} from "node:module";
import {pathToFileURL} from "node:url";

const [modules, executablePath, file, screenshot] = process.argv.slice(2);
const {chromium} = createRequire(modules + "/")("playwright-core");
const browser = await chromium.launch({executablePath, args: ["--no-sandbox", "--disable-gpu"]});
const page = await browser.newPage({viewport: {width: 1400, height: 900}});
const complaints = [];
page.on("console", message => {
  if (!message.text().includes("getImageData")) complaints.push(message.text());
});
page.on("pageerror", error => complaints.push(String(error)));
await page.goto(pathToFileURL(file).href);
const tick = async () => (await page.evaluate(() => window.sikku.state())).tick;
const {phrases, notes, end} = await page.evaluate(() => JSON.parse(document.getElementById("score").textContent));
assert.ok(phrases.length > 4 && phrases.length <= 64);
// Each begins with a note, the first with the melody.
const onsets = new Set(notes.map(note => note[0]));
assert.equal(phrases[0], notes[0][0]);
for (const phrase of phrases) assert.ok(onsets.has(phrase));

// By keys and by buttons, forwards to the last and back to the beginning.
for (const phrase of phrases.slice(1)) {
  await page.keyboard.press("Shift+ArrowRight");
  assert.equal(await tick(), phrase);
}
await page.getByRole("button", {name: "Next phrase"}).click();
assert.equal(await tick(), phrases.at(-1), "there is none after the last");
for (const phrase of phrases.slice(0, -1).reverse()) {
  await page.getByRole("button", {name: "Previous phrase"}).click();
  assert.equal(await tick(), phrase);
}
await page.evaluate(to => window.sikku.seek(to), phrases[2] + 100);
await page.keyboard.press("Shift+ArrowLeft");
assert.equal(await tick(), phrases[2], "the beginning of the phrase itself");

// The slider has a tick for each.
const ticks = await page.evaluate(() => [...document.getElementById("place").list.options].map(one => Number(one.value)));
assert.deepEqual(ticks.map(value => Math.round(value / 1000 * end)), phrases);

// A click on a mark in the piano roll jumps to its first note, a click below it to the clicked place.
await page.evaluate(() => window.sikku.seek(0));
await page.waitForTimeout(200);
const marks = await page.evaluate(() => {
  // Columns with ink in the row of the marks.
  const canvas = document.getElementById("roll"), ratio = canvas.width / canvas.getBoundingClientRect().width;
  const row = canvas.getContext("2d").getImageData(0, Math.round(3 * ratio), canvas.width, 1).data;
  const columns = [];
  for (let i = 0; i < canvas.width; ++i) if (row[4 * i + 3] > 128) columns.push(i / ratio);
  const middles = [];
  for (let i = 0; i < columns.length;) {
    let last = i;
    while (last + 1 < columns.length && columns[last + 1] - columns[last] < 1.5) ++last;
    middles.push((columns[i] + columns[last]) / 2);
    i = last + 1;
  }
  return middles;
});
assert.ok(marks.length > 1, "no marks in the roll");
const box = await page.locator("#roll").boundingBox();
await page.mouse.click(box.x + marks[1] + 4, box.y + 4);
assert.equal(await tick(), phrases[1]);
await page.evaluate(() => window.sikku.seek(0));
await page.mouse.click(box.x + marks[1] + 4, box.y + 40);
assert.ok(await tick() > phrases[1]);

// During playback, 'back' jumps to the previous phrase if the current one has just begun.
await page.evaluate(to => window.sikku.seek(to), phrases[3]);
await page.evaluate(() => window.sikku.play());
await page.waitForFunction(to => window.sikku.state().tick > to, phrases[3]);
await page.keyboard.press("Shift+ArrowLeft");
await page.evaluate(() => window.sikku.pause());
const after = await tick();
assert.ok(after >= phrases[2] - 60 && after < phrases[3], `at ${after}`);
if (screenshot) await page.screenshot({path: screenshot});
assert.deepEqual(complaints, []);
await browser.close();
console.log(`phrases: ${phrases.length} marks, gone to by keys, buttons and clicks`);
