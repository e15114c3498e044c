// Opens the page of an arrangement in a browser: a loop without gaps, parts muted, alone and in colours of their own.
// usage: parts.mjs PLAYWRIGHT_FOLDER BROWSER PAGE [SCREENSHOT]
import assert from "node:assert/strict";
import {createRequire} from "node:module";
import {pathToFileURL} from "node:url";

const [modules, executablePath, file, screenshot] = process.argv.slice(2);
const {chromium} = createRequire(modules + "/")("playwright-core");
const browser = await chromium.launch({executablePath, args: ["--no-sandbox", "--disable-gpu"]});
const page = await browser.newPage({viewport: {width: 1400, height: 900}});
const complaints = [];
page.on("console", message => complaints.push(message.text()));
page.on("pageerror", error => complaints.push(String(error)));
await page.goto(pathToFileURL(file).href);
const state = () => page.evaluate(() => window.sikku.state());
const until = seconds => page.waitForFunction(time => window.sikku.state().time >= time, seconds);
const data = await page.evaluate(() => JSON.parse(document.getElementById("score").textContent));
const {bars: [[, bar]], notes, parts} = data;
assert.ok(parts.length > 1);

// A loop over bars 2 and 3: time runs evenly, and only the notes of these bars sound, in order in each pass.
await page.locator("#loop-from").fill("2");
await page.locator("#loop-to").fill("3");
await page.getByRole("button", {name: "Loop"}).click();
assert.deepEqual((await state()).loop, [bar, 3 * bar]);
await page.getByRole("button", {name: "Play"}).click();
await page.waitForFunction(() => window.sikku.state().playing);
let first = await state();
assert.ok(first.tick >= bar && first.tick < 3 * bar, "it does not begin in the loop");
const perSecond = first.tempo * 480 / 60;
for (let round = 1; round <= 6; ++round) {
  await until(first.time + round * 1.3);
  const now = await state();
  const expected = bar + (first.tick - bar + (now.time - first.time) * perSecond) % (2 * bar);
  const away = Math.abs(now.tick - expected);
  assert.ok(Math.min(away, 2 * bar - away) < 2, `after ${now.time - first.time} s at ${now.tick}, not ${expected}`);
}
const inside = notes.flatMap((note, i) => note[0] >= bar && note[0] < 3 * bar ? [i] : []);
const heard = (await state()).recent;
assert.ok(heard.length > 2 * inside.length, "no second round");
heard.forEach((note, i) => assert.equal(note, inside[i % inside.length], `note ${i} of the loop`));
await page.keyboard.press("l");
assert.equal((await state()).loop, null);
await page.waitForFunction(tick => window.sikku.state().tick >= tick, 3 * bar + 60);

// A part alone, or muted: others make no sound.
const drums = parts.findIndex(([, voices]) => voices.some(voice => data.drums.includes(voice)));
const name = parts[drums][0];
await page.evaluate(() => window.sikku.pause());
await page.evaluate(tick => window.sikku.seek(tick), 4 * bar);
const struck = async () => {
  await page.evaluate(() => window.sikku.play());
  await page.waitForFunction(() => window.sikku.state().playing);
  const began = await state();
  let most = 0;
  while ((await state()).time < began.time + 1.5) most = Math.max(most, (await state()).voices);
  await page.evaluate(() => window.sikku.pause());
  await page.evaluate(tick => window.sikku.seek(tick), 4 * bar);
  return most;
};
const all = await struck();
await page.getByRole("button", {name: "Solo " + name}).click();
assert.deepEqual((await state()).alone, [drums]);
const solo = await struck();
assert.ok(solo > 0 && solo < all, `${solo} voices alone, ${all} in all`);
await page.getByRole("button", {name: "Solo " + name}).click();
for (const [other] of parts) await page.getByRole("button", {name: "Mute " + other, exact: true}).click();
assert.equal(await struck(), 0, "muted parts sound");
for (const [other] of parts) await page.getByRole("button", {name: "Mute " + other, exact: true}).click();
assert.equal(await struck() > 0, true);

// Each part has a colour of its own.
await page.getByRole("button", {name: "Colour by part"}).click();
const partOf = voice => parts.findIndex(([, voices]) => voices.includes(voice));
const colours = new Map();
for (let i = 0; i < notes.length; i += 7) {
  const colour = await page.evaluate(index => window.sikku.colour(index), i);
  const part = partOf(notes[i][3]);
  assert.equal(colours.get(part) ?? colour, colour);
  colours.set(part, colour);
}
assert.equal(new Set(colours.values()).size, colours.size);
if (screenshot) await page.screenshot({path: screenshot});
assert.deepEqual(complaints, []);
await browser.close();
console.log(`parts: ${parts.length} players, a loop of ${inside.length} notes ${Math.floor(heard.length / inside.length)} times`);
