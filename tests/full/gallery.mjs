// Opens the page of a gallery in a browser and uses it. The gallery has 4 to 100 prints, of two kinds or more.
// usage: gallery.mjs PLAYWRIGHT_FOLDER BROWSER GALLERY_FOLDER [SCREENSHOT]
import assert from "node:assert/strict";
import {createRequire} from "node:module";
import {readFileSync, rmSync, writeFileSync} from "node:fs";
import {resolve} from "node:path";
import {pathToFileURL} from "node:url";

const [modules, executablePath, folder, screenshot] = process.argv.slice(2);
const {chromium} = createRequire(modules + "/")("playwright-core");
const browser = await chromium.launch({executablePath, args: ["--no-sandbox", "--disable-gpu"]});
const home = pathToFileURL(resolve(folder)).href + "/", url = home + "index.html";
const complaints = [];
const requests = [];
function watch(page) {
  page.on("console", message => complaints.push(message.text()));
  page.on("pageerror", error => complaints.push(String(error)));
  page.on("request", request => requests.push(request.url()));
  page.on("requestfailed", request => complaints.push("failed: " + request.url()));
  return page;
}
const desktop = await browser.newContext({
  viewport: {width: 1400, height: 900}, permissions: ["clipboard-read", "clipboard-write"]
});
const page = watch(await desktop.newPage());
await page.goto(url);
const shoot = name => screenshot && page.screenshot({path: screenshot.replace(".png", name + ".png")});

const {entries, patterns} = await page.evaluate(() => JSON.parse(document.getElementById("gallery").textContent));
assert.ok(entries.length > 3 && entries.length <= 100, `${entries.length} prints are not what this can try`);
const titleOf = entry => entry.title ?? entry.name;
const placeOf = entry => `${entries.indexOf(entry) + 1} / ${entries.length}`;
const link = entry => "#" + encodeURIComponent(entry.name);
const key = name => page.keyboard.press(name);
const frame = (target = page) => target.evaluate(() => new Promise(done => {
  requestAnimationFrame(() => requestAnimationFrame(done));
}));
const shown = () => page.locator("#prints a").evaluateAll(cards => cards.map(card => card.getAttribute("href")));
const open = target => target.evaluate(() => document.getElementById("viewer").open);
const closed = target => target.waitForFunction(
  () => !document.getElementById("viewer").open && location.hash === "");
const focused = () => page.evaluate(() => document.activeElement.getAttribute("href") ?? document.activeElement.id);
const hash = () => page.evaluate(() => location.hash);
/* How large the picture in the viewer is, and where its middle is. */
const picture = target => target.locator("#stage img").evaluate(image => {
  const box = image.getBoundingClientRect();
  return {width: box.width, height: box.height, x: box.x + box.width / 2, y: box.y + box.height / 2};
});
const near = (actual, expected, what, tolerance = 1) =>
  assert.ok(Math.abs(actual - expected) <= tolerance, `${what}: ${actual}, not about ${expected}`);

// All are there, with a picture each as soon as they are in sight.
assert.deepEqual(await shown(), entries.map(link));
assert.match(await page.locator("#count").textContent(), new RegExp(`^${entries.length} print`));
await page.waitForFunction(() => document.querySelector("#prints img").naturalWidth > 0);
await shoot("");

// Search: all words, in any order, accents or none; and back.
const words = titleOf(entries[0]).split(/\W+/).filter(Boolean);
await key("/");
assert.equal(await focused(), "search");
await page.keyboard.type(words.reverse().join(" ").toUpperCase());
await frame();
const found = await shown();
assert.ok(found.includes(link(entries[0])), "the search does not find the first print");
assert.ok(found.length < entries.length, "the search finds everything");
assert.equal(await page.locator("#count").textContent(), `${found.length} of ${entries.length} prints`);
await page.locator("#search").fill("no print has this");
await frame();
assert.deepEqual(await shown(), []);
await page.getByRole("button", {name: "Show all"}).click();
assert.deepEqual(await shown(), entries.map(link));
const accented = entries.find(entry => /\u0301/.test(titleOf(entry).normalize("NFD")));
if (accented) {
  await page.locator("#search").fill(titleOf(accented).normalize("NFD").replace(/\p{M}/gu, ""));
  await frame();
  assert.ok((await shown()).includes(link(accented)), "the search minds accents");
  await page.locator("#search").fill("");
  await frame();
}

// Filters: the kind by keys, the others as they are offered; their counts are what one then sees.
const kinds = [...new Set(entries.map(entry => entry.kind ?? ""))];
assert.ok(kinds.length > 1, "prints of one kind alone");
await page.locator("#kind input").first().focus();
for (const kind of kinds) {
  await key("ArrowRight");
  const expected = entries.filter(entry => (entry.kind ?? "") === kind);
  assert.deepEqual(await shown(), expected.map(link), `the filter for ${kind}`);
  assert.equal(await page.locator("#kind label:has(:checked) small").textContent(), String(expected.length));
}
await page.locator("#kind input").first().check({force: true});
for (const name of ["growth", "angle"]) {
  const select = page.locator("#" + name);
  const values = new Set(entries.map(entry => entry[name] ?? ""));
  assert.equal(await select.isVisible(), values.size > 1, `whether to filter by ${name}`);
  if (values.size < 2) continue;
  const texts = await select.locator("option").allTextContents();
  assert.equal(texts.length, values.size + 1);
  let sum = 0;
  for (let index = 1; index < texts.length; ++index) {
    await select.selectOption({index});
    const count = (await shown()).length;
    assert.ok(texts[index].endsWith(`(${count})`), `${name}: ${texts[index]} shows ${count}`);
    sum += count;
  }
  assert.equal(sum, entries.length);
  await select.selectOption({index: 0});
}

// Order.
await page.locator("#order").selectOption("title");
const titles = await page.locator("#prints b").allTextContents();
const collator = new Intl.Collator("en", {numeric: true});
for (let i = 1; i < titles.length; ++i) assert.ok(collator.compare(titles[i - 1], titles[i]) <= 0, titles[i]);
await page.locator("#order").selectOption("n");
const lengths = (await shown()).map(href => Number(entries.find(entry => link(entry) === href).n ?? Infinity));
for (let i = 1; i < lengths.length; ++i) assert.ok(lengths[i - 1] <= lengths[i], "n falls");
await page.locator("#order").selectOption("given");
assert.deepEqual(await shown(), entries.map(link));

// By keys alone: from print to print, into one, on to others, and back to where one was.
await page.locator("#order").focus();
await key("Tab");
assert.equal(await focused(), link(entries[0]));
const ring = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
assert.notEqual(ring, "none", "the focus cannot be seen");
await key("ArrowRight");
assert.equal(await focused(), link(entries[1]));
await key("End");
assert.equal(await focused(), link(entries.at(-1)));
await key("Home");
await key("Enter");
assert.equal(await open(page), true);
assert.equal(await hash(), link(entries[0]));
assert.equal(await page.locator("#title").textContent(), titleOf(entries[0]));
await key("j");
assert.equal(await hash(), link(entries[1]));
await key("ArrowRight");
assert.equal(await hash(), link(entries[2]));
await key("ArrowLeft");
await key("k");
await key("k");
assert.equal(await hash(), link(entries.at(-1)), "before the first comes the last");
await key("j");
await key("j");
assert.equal(await page.locator("#place").textContent(), `2 / ${entries.length}`);
assert.ok((await page.title()).startsWith(titleOf(entries[1])));
// The focus stays in the viewer, wherever Tab goes.
for (let i = 0; i < 20; ++i) {
  await key("Tab");
  assert.ok(await page.evaluate(() => document.activeElement === document.body ||
                                document.activeElement.closest("dialog") !== null), "the focus leaves the viewer");
}
await key("Escape");
await closed(page);
assert.equal(await focused(), link(entries[1]));

// The back button leaves the viewer, the forward button comes again.
await page.locator("#prints a").first().click();
await page.getByRole("button", {name: "Next print"}).click();
assert.equal(await hash(), link(entries[1]));
await page.goBack();
await closed(page);
await page.goForward();
await page.waitForFunction(() => document.getElementById("viewer").open);
assert.equal(await hash(), link(entries[1]));
await page.getByRole("button", {name: "Close"}).click();
await closed(page);

// A link to one print, whatever its name; every print opens and has its files.
const strange = entries.find(entry => /\W/.test(entry.name.replaceAll("-", ""))) ?? entries[3];
const second = watch(await desktop.newPage());
await second.goto(url + link(strange));
assert.equal(await second.locator("#title").textContent(), titleOf(strange));
assert.equal(await open(second), true);
await second.keyboard.press("Escape");
await closed(second);
assert.equal(await second.evaluate(() => location.href), url);
await second.goto(url + "#nobody");
assert.equal(await open(second), false);
await second.close();
const inside = address => address.startsWith(home) && !address.includes("..");
for (const entry of entries) {
  await page.evaluate(target => { location.hash = target; }, link(entry));
  await page.waitForFunction(text => document.getElementById("place").textContent === text, placeOf(entry));
  assert.equal(await page.locator("#title").textContent(), titleOf(entry));
  await page.waitForFunction(() => document.querySelector("#stage img").naturalWidth > 0);
  assert.equal(await page.locator("#pattern").textContent(), patterns[entry.pattern]);
  const links = await page.locator("#links a").evaluateAll(list => list.map(each => [each.textContent, each.href]));
  assert.deepEqual(links.slice(1).map(each => each[0]), (entry.extras ?? []).map(each => each[0]));
  const paths = [entry.print, ...(entry.extras ?? []).map(each => each[1])];
  assert.deepEqual(links.map(each => decodeURIComponent(each[1].slice(home.length))), paths);
  for (const [, address] of links) assert.ok(inside(address), `${address} is elsewhere`);
}
await key("Escape");
await closed(page);

// Zoom: keys, buttons, wheel, a double click; and what is enlarged is moved, but not out of sight.
await page.locator("#prints a").first().click();
const stage = await page.locator("#stage").boundingBox();
const centre = {x: stage.x + stage.width / 2, y: stage.y + stage.height / 2};
const whole = await picture(page);
assert.ok(whole.width <= stage.width && whole.height <= stage.height);
assert.ok(whole.width > 0.9 * stage.width || whole.height > 0.9 * stage.height, "the print is small");
if (entries[0].size) near(whole.width / whole.height, entries[0].size[0] / entries[0].size[1], "shape", 0.02);
near(whole.x, centre.x, "middle");
near(whole.y, centre.y, "middle");
await key("-");
near((await picture(page)).width, whole.width, "smaller than all of it");
await key("+");
near((await picture(page)).width, 1.5 * whole.width, "one step");
await page.getByRole("button", {name: "Larger"}).click();
near((await picture(page)).width, 2.25 * whole.width, "two steps");
await page.getByRole("button", {name: "Smaller"}).click();
near((await picture(page)).width, 1.5 * whole.width, "one step back");
for (let i = 0; i < 3; ++i) await key("+");
let before = await picture(page);
await key("ArrowRight");
near((await picture(page)).x, before.x - stage.width / 8, "the right arrow");
await key("ArrowDown");
near((await picture(page)).y, before.y - stage.height / 8, "the down arrow");
assert.equal(await hash(), link(entries[0]), "an arrow leaves an enlarged print");
await shoot("-zoom");
await page.mouse.move(centre.x, centre.y);
await page.mouse.down();
before = await picture(page);
await page.mouse.move(centre.x + 60, centre.y + 40, {steps: 4});
await page.mouse.up();
near((await picture(page)).x, before.x + 60, "dragged");
near((await picture(page)).y, before.y + 40, "dragged");
for (let i = 0; i < 40; ++i) await key("ArrowLeft");
before = await picture(page);
near(before.x - before.width / 2, stage.x, "the left edge");
await key("0");
near((await picture(page)).width, whole.width, "0 shows all");
near((await picture(page)).x, centre.x, "0 shows all");
// The wheel keeps the point under it where it is, once the print is larger than the stage.
for (let i = 0; i < 4; ++i) await key("+");
const point = {x: centre.x + 0.2 * whole.width, y: centre.y - 0.3 * whole.height};
await page.mouse.move(point.x, point.y);
before = await picture(page);
for (let i = 0; i < 4; ++i) await page.mouse.wheel(0, -120);
await page.waitForFunction(least => document.querySelector("#stage img").getBoundingClientRect().width > least,
                           4 * before.width);
const after = await picture(page);
near((point.x - after.x) / after.width, (point.x - before.x) / before.width, "the point under the wheel", 0.005);
near((point.y - after.y) / after.height, (point.y - before.y) / before.height, "the point under the wheel", 0.005);
await page.mouse.dblclick(centre.x, centre.y);
near((await picture(page)).width, whole.width, "a double click goes back");
await page.mouse.dblclick(centre.x, centre.y);
near((await picture(page)).width, 4 * whole.width, "a double click enlarges");
await page.locator("#zoom-fit").click();
await shoot("-viewer");

// Thousands of prints: few of them are in the document at first, and all can be reached.
const many = 5000, manyFile = resolve(folder, "many.html");
const copies = Array.from({length: many}, (_, i) => ({...entries[i % entries.length], name: `copy ${i}`}));
writeFileSync(manyFile, readFileSync(resolve(folder, "index.html"), "utf8").replace(
  /(id="gallery">).*?(<\/script>)/s,
  (_, head, tail) => head + JSON.stringify({patterns, entries: copies}).replaceAll("<", "\\u003c") + tail));
const crowd = watch(await desktop.newPage());
await crowd.goto(home + "many.html");
const items = () => crowd.locator("#prints li").count();
assert.ok(await items() < many / 10);
for (let last = await items(), times = 0; times < 2; ++times) {
  await crowd.evaluate(() => scrollTo(0, document.documentElement.scrollHeight));
  await crowd.waitForFunction(count => document.querySelectorAll("#prints li").length > count, last);
  last = await items();
}
await crowd.locator("#search").fill(`copy ${many - 1}`);
await crowd.waitForFunction(count => document.getElementById("count").textContent === `1 of ${count} prints`, many);
await crowd.locator("#search").fill("");
await frame(crowd);
await crowd.locator("#prints a").first().click();
await crowd.keyboard.press("k");
assert.equal(await crowd.locator("#place").textContent(), `${many} / ${many}`);
await crowd.keyboard.press("Escape");
await closed(crowd);
assert.equal(await crowd.evaluate(() => decodeURIComponent(document.activeElement.hash)), `#copy ${many - 1}`);
await crowd.close();
rmSync(manyFile);

// Copy.
await page.getByRole("button", {name: "Copy"}).click();
await page.waitForFunction(() => document.getElementById("copied").textContent === "Copied");
assert.equal(await page.evaluate(() => navigator.clipboard.readText()), patterns[entries[0].pattern]);
await page.emulateMedia({colorScheme: "dark"});
await shoot("-dark");
await desktop.close();

// A phone: nothing is wider than it, fingers pinch and sweep.
const small = await browser.newContext({
  viewport: {width: 360, height: 760}, hasTouch: true, isMobile: true, deviceScaleFactor: 2
});
const phone = watch(await small.newPage());
const narrow = async what => {
  const wide = await phone.evaluate(() => Math.max(document.documentElement.scrollWidth,
                                                   document.getElementById("viewer").scrollWidth));
  assert.ok(wide <= 360, `${what} is ${wide} pixels wide`);
};
await phone.goto(url);
await narrow("the gallery");
if (screenshot) await phone.screenshot({path: screenshot.replace(".png", "-phone.png")});
await phone.locator("#prints a").first().tap();
await phone.waitForFunction(() => document.querySelector("#stage img")?.naturalWidth > 0);
await narrow("the viewer");
if (screenshot) await phone.screenshot({path: screenshot.replace(".png", "-phone-viewer.png")});
const fingers = await small.newCDPSession(phone);
const touch = (type, ...points) => fingers.send("Input.dispatchTouchEvent", {
  type, touchPoints: points.map(([x, y], id) => ({x, y, id}))
});
const unpinched = await picture(phone);
const {x, y} = unpinched;
await touch("touchStart", [x - 30, y], [x + 30, y]);
for (const apart of [40, 50, 60, 75, 90]) await touch("touchMove", [x - apart, y], [x + apart, y]);
await touch("touchEnd");
await frame(phone);
near((await picture(phone)).width / unpinched.width, 3, "pinched", 0.15);
near((await picture(phone)).x, x, "pinched", 3);
await phone.locator("#zoom-fit").tap();
await touch("touchStart", [x + 80, y]);
for (const to of [60, 20, -30, -80]) await touch("touchMove", [x + to, y + 4]);
await touch("touchEnd");
await phone.waitForFunction(target => location.hash === target, link(entries[1]));
for (const entry of entries) {
  await phone.evaluate(target => { location.hash = target; }, link(entry));
  await phone.waitForFunction(text => document.getElementById("place").textContent === text, placeOf(entry));
  await narrow(entry.name);
}
await phone.locator("#close").tap();

assert.deepEqual(complaints, []);
assert.deepEqual(requests.filter(request => !inside(request) && !request.startsWith("data:")), []);
await browser.close();
console.log(`gallery: ${entries.length} prints, searched, filtered, enlarged, copied and swept through`);
