// Opens a page of `sikku play` in a browser and plays it.
// usage: page.mjs PLAYWRIGHT_FOLDER BROWSER PAGE [SCREENSHOT]
import assert from "node:assert/strict";
import {createRequire} from "node:module";
import {pathToFileURL} from "node:url";

const [modules, executablePath, file, screenshot] = process.argv.slice(2);
const {chromium} = createRequire(modules + "/")("playwright-core");
const browser = await chromium.launch({executablePath, args: ["--no-sandbox", "--disable-gpu"]});
const page = await browser.newPage({viewport: {width: 1400, height: 900}});
const complaints = [];
const requests = [];
page.on("console", message => {
  // That is about this test, which looks at pixels.
  if (!message.text().includes("getImageData")) complaints.push(message.text());
});
page.on("pageerror", error => complaints.push(String(error)));
page.on("request", request => requests.push(request.url()));
const url = pathToFileURL(file).href;
await page.goto(url);

const state = () => page.evaluate(() => window.sikku.state());
const wait = milliseconds => page.waitForTimeout(milliseconds);
const close = (actual, expected, part, what) =>
  assert.ok(Math.abs(actual - expected) <= part * expected, `${what}: ${actual}, not about ${expected}`);
/* Pixels of a canvas that are not empty. */
const inked = id => page.evaluate(name => {
  const canvas = document.getElementById(name);
  const bytes = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  let count = 0;
  for (let i = 3; i < bytes.length; i += 4) count += bytes[i] > 0;
  return count;
}, id);
/* Those of the curve in a colour; the ghost is grey. */
const coloured = () => page.evaluate(() => {
  const canvas = document.getElementById("curve");
  const bytes = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  let count = 0;
  for (let i = 0; i < bytes.length; i += 4) {
    const low = Math.min(bytes[i], bytes[i + 1], bytes[i + 2]), high = Math.max(bytes[i], bytes[i + 1], bytes[i + 2]);
    count += bytes[i + 3] > 128 && high - low > 60;
  }
  return count;
});

const notes = await page.evaluate(() => window.sikku.notes);
assert.ok(notes.length > 10);
for (let i = 1; i < notes.length; ++i) assert.ok(notes[i][0] >= notes[i - 1][0], "notes are not in order");
let now = await state();
assert.equal(now.playing, false);
assert.equal(now.tick, 0);
assert.equal(now.sounded, 0);
const tempo = now.tempo;
assert.ok(await inked("curve") > 1000, "no curve is drawn");
assert.ok(await inked("roll") > 1000, "no roll is drawn");
assert.equal(await coloured(), 0);

// Play: ticks pass as fast as the tempo says, and notes sound in order.
const button = page.getByRole("button", {name: "Play"});
await button.click();
await page.getByRole("button", {name: "Pause"}).waitFor();
await wait(500);
// By the clock of the sound, which a busy machine may hold up.
const watched = async seconds => {
  const before = await state();
  await page.waitForFunction(until => window.sikku.state().time >= until, before.time + seconds);
  const after = await state();
  return {before, after, speed: (after.tick - before.tick) / (after.time - before.time)};
};
let seen = await watched(2);
assert.equal(seen.after.playing, true);
assert.ok(seen.after.sounded > seen.before.sounded && seen.before.sounded > 0, "no notes sound");
assert.deepEqual(seen.after.recent, [...Array(seen.after.sounded).keys()], "notes sound in another order");
for (const i of seen.after.recent) assert.ok(notes[i][0] <= seen.after.tick + 1);
assert.ok(notes[seen.after.sounded] === undefined || notes[seen.after.sounded][0] > seen.after.tick - 30,
          "a note is late");
close(seen.speed, tempo * 480 / 60, 0.001, "ticks a second");
assert.ok(await coloured() > 100, "the curve does not grow");
if (screenshot) await page.screenshot({path: screenshot});

// Pause: all stands still.
await page.getByRole("button", {name: "Pause"}).click();
await page.getByRole("button", {name: "Play"}).waitFor();
now = await state();
assert.equal(now.playing, false);
await wait(400);
assert.equal((await state()).tick, now.tick, "pause does not stop it");
assert.equal((await state()).sounded, now.sounded, "notes sound after the pause");

// Half the tempo; and the space bar plays, whatever slider has the focus, but on the button only once.
await page.locator("#tempo").evaluate((slider, value) => {
  slider.value = value;
  slider.dispatchEvent(new Event("input", {bubbles: true}));
}, tempo / 2);
await page.locator("#tempo").focus();
await page.keyboard.press(" ");
await page.waitForFunction(() => window.sikku.state().playing);
await wait(300);
seen = await watched(2);
assert.equal(seen.after.playing, true);
close(seen.speed, tempo * 480 / 60 / 2, 0.001, "ticks a second at half the tempo");
assert.deepEqual(seen.after.recent, [...Array(seen.after.sounded).keys()], "a pause loses or repeats notes");
await page.locator("#play").focus();
await page.keyboard.press(" ");
await wait(100);
assert.equal((await state()).playing, false, "space on the button");

// A click in the roll goes there; the curve is coloured up to there, and less of it when it goes back.
const box = await page.locator("#roll").boundingBox();
await page.mouse.click(box.x + box.width * 0.6, box.y + box.height / 2);
const there = (await state()).tick;
assert.ok(there > 960, "a click in the roll goes nowhere");
await wait(100);
const much = await coloured();
const end = await page.evaluate(() => JSON.parse(document.getElementById("score").textContent).end);
await page.locator("#place").evaluate((slider, value) => {
  slider.value = value;
  slider.dispatchEvent(new Event("input", {bubbles: true}));
}, 500 * there / end);
await wait(100);
close((await state()).tick, there / 2, 0.001, "the position slider");
assert.ok(await coloured() < much, "the curve does not shrink");
await page.locator("h1").click();
await page.keyboard.press("Home");
assert.equal((await state()).tick, 0);

// At the end it stops, and begins anew.
await page.evaluate(() => { window.sikku.seek(1e12); });
await page.evaluate(last => window.sikku.seek(last - 60), end);
await page.keyboard.press(" ");
await page.waitForFunction(() => !window.sikku.state().playing);
assert.equal((await state()).tick, end);
await page.keyboard.press(" ");
await page.waitForFunction(() => window.sikku.state().playing);
now = await state();
assert.ok(now.tick < 960, "it does not begin anew");
await page.evaluate(() => window.sikku.pause());

// The whole curve in colour; and as those see it who like it dark, or have a small screen.
await page.evaluate(() => window.sikku.seek(1e12));
await page.emulateMedia({colorScheme: "dark"});
await wait(200);
assert.ok(await coloured() > 1000);
if (screenshot) await page.screenshot({path: screenshot.replace(".png", "-dark.png")});
await page.setViewportSize({width: 390, height: 844});
await wait(200);
const wide = await page.evaluate(() => document.documentElement.scrollWidth);
assert.ok(wide <= 390, `on a small screen it is ${wide} pixels wide`);
if (screenshot) await page.screenshot({path: screenshot.replace(".png", "-small.png"), fullPage: true});

assert.deepEqual(complaints, []);
assert.deepEqual(requests.filter(request => request !== url && !request.startsWith("data:")), []);
await browser.close();
console.log(`page: ${notes.length} notes, played, paused, slowed and sought in`);
