// Looks at an animated print of 8 seconds in a browser, at the beginning, halfway and at the end.
// usage: kolam.mjs PLAYWRIGHT_FOLDER BROWSER PRINT.svg [SCREENSHOT]
import assert from "node:assert/strict";
import {createRequire} from "node:module";
import {pathToFileURL} from "node:url";

const [modules, executablePath, file, screenshot] = process.argv.slice(2);
const {chromium} = createRequire(modules + "/")("playwright-core");
const browser = await chromium.launch({executablePath, args: ["--no-sandbox", "--disable-gpu"]});
const page = await browser.newPage({viewport: {width: 400, height: 400}});
const requests = [];
page.on("request", request => requests.push(request.url()));
await page.goto(pathToFileURL(file).href);

const animations = await page.evaluate(() => document.getAnimations().map(animation => {
  const timing = animation.effect.getComputedTiming();
  return [timing.delay, timing.duration];
}));
assert.equal(animations.length, 1);
assert.ok(Math.abs(animations[0][0] + animations[0][1] - 8000) < 10, `it takes ${animations[0]} ms`);

/* Bytes of a picture grow with what is drawn; how much of the path is drawn is asked of its style. */
const at = async milliseconds => {
  await page.evaluate(time => {
    for (const animation of document.getAnimations()) { animation.pause(); animation.currentTime = time; }
  }, milliseconds);
  const offset = await page.evaluate(() =>
    parseFloat(getComputedStyle(document.querySelector("path[pathLength]")).strokeDashoffset));
  return {offset, picture: await page.screenshot(screenshot && milliseconds === 4000 ? {path: screenshot} : {})};
};
const beginning = await at(0);
const half = await at(4000);
assert.ok(Math.abs(beginning.offset - 1) < 0.01 && Math.abs(half.offset - 0.5) < 0.01);
assert.ok(beginning.picture.length < half.picture.length);
await page.evaluate(() => document.getAnimations().forEach(animation => animation.finish()));
const end = await page.screenshot();
assert.ok(!end.equals(half.picture) && end.length > half.picture.length);

// To those who ask for less motion the whole is shown at once.
await page.emulateMedia({reducedMotion: "reduce"});
await page.reload();
assert.equal(await page.evaluate(() => document.getAnimations().length), 0);
assert.ok(end.equals(await page.screenshot()));
assert.equal(requests.length, 2, "nothing is fetched but the print");
await browser.close();
console.log("chromium: the kolam is drawn in 8 s");
