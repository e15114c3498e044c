// Serves a site and uses it in Chromium and, if it is installed, Firefox.
// usage: site.mjs MODULES_FOLDER CHROMIUM SITE HOSTILE_SITE [SCREENSHOTS]
import assert from "node:assert/strict";
import {existsSync, mkdirSync, readFileSync, readdirSync, statSync} from "node:fs";
import {createServer} from "node:http";
import {createRequire} from "node:module";
import {extname, join, resolve} from "node:path";

const [modules, executablePath, site, hostile, screenshots] = process.argv.slice(2);
const require = createRequire(modules + "/");
const {chromium, firefox} = require("playwright-core");
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
if (screenshots) mkdirSync(screenshots, {recursive: true});

const types = {
  ".html": "text/html; charset=utf-8", ".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml",
  ".png": "image/png", ".mid": "audio/midi", ".pdf": "application/pdf", ".webmanifest": "application/manifest+json",
  ".txt": "text/plain; charset=utf-8", ".lsys": "text/plain; charset=utf-8", ".toml": "text/plain; charset=utf-8",
};
// Serves a folder on a separate port, below /some/folder/, as shared servers do.
const base = "/some/folder/";
function serve(folder) {
  const asked = [];
  const server = createServer((request, response) => {
    let path = decodeURIComponent(new URL(request.url, "http://x").pathname);
    asked.push(path);
    if (path.endsWith("/")) path += "index.html";
    const file = join(folder, path.slice(base.length));
    if (!path.startsWith(base) || !existsSync(file) || !statSync(file).isFile()) {
      response.writeHead(404).end("not here");
      return;
    }
    response.writeHead(200, {"content-type": types[extname(file)] ?? "application/octet-stream"}).end(readFileSync(file));
  });
  return new Promise(done => server.listen(0, "127.0.0.1", () => {
    done({server, asked, origin: `http://localhost:${server.address().port}`, home: `http://localhost:${server.address().port}${base}`});
  }));
}

const {server, asked, origin, home} = await serve(resolve(site));
const files = readdirSync(site, {recursive: true, withFileTypes: true})
  .filter(each => each.isFile()).map(each => join(each.parentPath ?? each.path, each.name).slice(site.length + 1));
const htmls = files.filter(file => file.endsWith(".html") && !file.startsWith("studio/"));
assert.ok(htmls.length > 300, `${htmls.length} pages`);

const browser = await chromium.launch({
  executablePath, args: ["--no-sandbox", "--disable-gpu", "--autoplay-policy=no-user-gesture-required"]
});
const complaints = [];
function watch(page) {
  page.on("console", message => {
    if (message.type() !== "error" && message.type() !== "warning") return;
    // Firefox fetches the icon last, possibly after this test has left the page.
    if (message.text().includes("icon.svg’. A ServiceWorker intercepted the request")) return;
    if (message.text().endsWith("Service Worker registration blocked by Playwright")) return;
    complaints.push(`${page.url()}: ${message.text()}`);
  });
  page.on("pageerror", error => complaints.push(`${page.url()}: ${error}`));
  page.on("request", request => {
    const url = request.url();
    if (!url.startsWith(origin + "/") && !url.startsWith("data:") && !url.startsWith("blob:")) complaints.push(`asks for ${url}`);
  });
  page.on("response", response => { if (response.status() >= 400) complaints.push(`${response.status()} ${response.url()}`); });
  return page;
}
const nothingWrong = () => assert.deepEqual(complaints.slice(0, 20), []);
const blocked = {serviceWorkers: "block"};

// Every link of every page, as a browser resolves it, leads to a file and, if it names one, to an anchor.
{
  const page = watch(await browser.newPage(blocked));
  const anchors = new Map(), links = [];
  for (const html of htmls) {
    const text = readFileSync(join(site, html), "utf8");
    const found = await page.evaluate(([text, address]) => {
      const document = new DOMParser().parseFromString(text, "text/html");
      const base = document.createElement("base");
      base.href = address;
      document.head.prepend(base);
      const of = (selector, name) => [...document.querySelectorAll(selector)].map(each => each[name] || new URL(each.dataset.midi, address).href);
      return {
        ids: [...document.querySelectorAll("[id]")].map(each => each.id),
        links: [...of("a[href]", "href"), ...of("link[href]", "href"), ...of("img[src]", "src"), ...of("script[src]", "src"), ...of("[data-midi]", "none")],
        inline: document.querySelectorAll("script:not([src]), style, [style], [onclick], [onload], [onerror]").length,
      };
    }, [text, home + html]);
    assert.equal(found.inline, 0, `${html} has inline scripts or styles`);
    anchors.set(html, new Set(found.ids));
    links.push(...found.links.map(link => [html, link]));
  }
  const known = new Set(files);
  let outside = 0;
  for (const [html, link] of links) {
    if (!link.startsWith(home)) {
      assert.ok(link.startsWith("https://") || link.startsWith("mailto:"), `${html}: ${link} leaves the folder of the site`);
      ++outside;
      continue;
    }
    const [path, anchor] = link.slice(home.length).split("#");
    assert.ok(known.has(path), `${html}: ${path} is missing`);
    if (anchor && anchors.has(path)) assert.ok(anchors.get(path).has(decodeURIComponent(anchor)), `${html}: ${path} has no ${anchor}`);
  }
  console.log(`site: ${links.length} links of ${htmls.length} pages, ${outside} of them to other sites`);
  await page.close();
}

// Each page opens without errors and loads less than 300 kB before scrolling; the studio is an exception.
{
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, ...blocked});
  let most = 0, heaviest = "";
  for (const html of htmls) {
    const page = watch(await context.newPage());
    let bytes = 0;
    page.on("response", response => {
      const file = join(site, decodeURIComponent(new URL(response.url()).pathname).slice(base.length));
      if (existsSync(file)) bytes += statSync(file).size;
    });
    await page.goto(home + html, {waitUntil: "load"});
    if (bytes > most) [most, heaviest] = [bytes, html];
    assert.ok(bytes < 300_000, `${html} loads ${bytes} bytes`);
    await page.close();
  }
  console.log(`site: every page opens; the heaviest loads ${Math.round(most / 1000)} kB (${heaviest})`);
  await context.close();
}
nothingWrong();
const total = files.reduce((sum, file) => sum + statSync(join(site, file)).size, 0);
assert.ok(total < 60e6, `the site has ${total} bytes`);

// Accessibility and width of a page of each kind on phones, tablets and desktops, in light and dark.
const shown = {
  front: "index.html", manual: "manual/index.html", language: "manual/language.html", commands: "manual/commands.html",
  matrix: "manual/matrix.html", readme: "manual/readme.html", kolam: "pattern/kooja-kolam.html", melody: "pattern/hilbert-kalyani.html",
  plant: "pattern/capsella-by-table.html", variants: "pattern/honda-trees.html", arrangement: "pattern/blues.html", map: "pattern/cell-layer.html", tiling: "pattern/penrose-rhombs.html",
  library: "pattern/kolam-11-6-idukku-566dzmfw.html", patterns: "patterns/index.html", gallery: "patterns/tilings.html",
  arrangements: "patterns/arrangements.html", first: "first-steps.html", teachers: "teachers.html", search: "search.html?q=hilbert",
  offline: "offline.html",
};
for (const colorScheme of ["light", "dark"]) {
  for (const width of [320, 768, 1280]) {
    const context = await browser.newContext({viewport: {width, height: 800}, colorScheme, reducedMotion: "reduce", bypassCSP: true, ...blocked});
    for (const [name, path] of Object.entries(shown)) {
      const page = watch(await context.newPage());
      await page.goto(home + path);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(wide <= width, `${path} is ${wide} pixels wide at ${width}`);
      if (width !== 768) {
        await page.evaluate(axe);
        const {violations} = await page.evaluate(() => axe.run());
        assert.deepEqual(violations.map(each => [each.id, each.nodes.slice(0, 3).map(node => node.html.slice(0, 200))]), [], `${path}, ${colorScheme}, ${width}`);
      }
      if (screenshots) {
        await page.evaluate(async () => {
          for (const image of document.images) image.loading = "eager";
          await Promise.all([...document.images].map(image => image.decode().catch(() => {})));
        });
        await page.screenshot({path: join(screenshots, `${name}-${width}-${colorScheme}.png`), fullPage: true});
      }
      await page.close();
    }
    await context.close();
  }
}
console.log(`site: ${Object.keys(shown).length} pages without findings of axe, none wider than 320, 768 and 1280 pixels`);

// Everything below is done in both browsers.
async function use(browser, name) {
  // Playwright cannot make Firefox reduce motion or block service workers.
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, ...(name === "Chromium" ? {reducedMotion: "reduce", ...blocked} : {})});
  const page = watch(await context.newPage());

  // The first element that the Tab key reaches skips the navigation.
  await page.goto(home + "index.html");
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Skip to the content");
  await page.keyboard.press("Enter");
  assert.equal(await page.evaluate(() => location.hash), "#content");

  // The studio opens in the page by one click and draws.
  assert.equal(await page.locator("iframe").count(), 0);
  await page.getByRole("link", {name: "Try it now"}).click();
  const studio = page.frameLocator("iframe[title='The studio']");
  await studio.locator("#facts").getByText("No errors").waitFor({timeout: 120_000});
  if (name === "Chromium") await studio.locator(".map-canvas[data-shows]").first().waitFor({timeout: 60_000});

  // First contact: two clicks lead from the front page to a picture that can be changed.
  const seconds = [];
  for (const [aim, title] of [["a kolam for the door", "Single line, quarter turns, 7x7"], ["a poster", "Penrose rhombs"], ["a melody", "Hilbert sings Kalyani"]]) {
    await page.goto(home + "index.html");
    const began = Date.now();
    await page.getByRole("link", {name: aim}).click();
    await studio.getByRole("dialog").getByRole("button", {name: "Open", exact: true}).click({timeout: 120_000});
    await studio.locator("#work-title").getByText(title).waitFor({timeout: 120_000});
    await studio.locator("#facts").getByText("No errors").waitFor();
    seconds.push(((Date.now() - began) / 1000).toFixed(1));
  }
  console.log(`site in ${name}: a kolam, a poster and a melody in the studio after two clicks and ${seconds.join(", ")} s`);

  // The search from any page finds keys, options and patterns; prefixes, several words, accents, nothing.
  await page.goto(home + "patterns/kolams.html");
  await page.locator("#find").fill("hilbert curve");
  await page.locator("#find").press("Enter");
  await page.waitForURL(/search\.html\?q=hilbert/);
  const results = page.locator("#results a");
  await results.first().waitFor();
  assert.equal(await results.first().getAttribute("href"), "pattern/hilbert.html");
  const first = async query => {
    await page.locator("#query").fill(query);
    await page.locator("#query").press("Enter");
    return (await results.count()) === 0 ? null : results.first().getAttribute("href");
  };
  assert.match(await first("penr rho"), /pattern\/penrose-rhombs\.html/);
  assert.match(await first("sierpinski gasket"), /pattern\/sierpinski-gasket\.html/);
  assert.match(await first("sikku workbook"), /manual\/commands\.html#sikku-workbook/);
  assert.match(await first("glossary"), /manual\/glossary\.html/);
  assert.match(await first("anklets-of-krishna"), /pattern\/anklets-of-krishna\.html/);
  assert.equal(await first("zzzyzx"), null);
  assert.equal(await page.locator("#search-state").textContent(), "Nothing found. Try fewer or shorter words.");
  assert.equal(await first("<img src=x onerror=alert(1)>"), null);
  await results.first().waitFor({state: "detached"});
  assert.match(await first("hat tiling"), /pattern\/hat\.html/);
  await results.first().click();
  await page.waitForURL(/pattern\/hat\.html/);

  // A gallery is filtered.
  await page.goto(home + "patterns/tilings.html");
  const entries = page.locator("#patterns > li:visible");
  const all = await entries.count();
  await page.locator("#filter").fill("penrose");
  assert.equal(await page.locator("#count").textContent(), `${await entries.count()} of ${all}`);
  assert.ok(await entries.count() >= 3 && await entries.count() < all);

  // Open in the studio: the link contains the pattern, which is bundled and opens at once.
  await page.goto(home + "pattern/hilbert.html");
  await page.getByRole("link", {name: "Open in the studio"}).click();
  await page.locator("#work-title").getByText("Hilbert curve").waitFor({timeout: 120_000});
  await page.locator("#facts").getByText("No errors").waitFor();

  // An arrangement opens in Play.
  await page.goto(home + "pattern/blues.html");
  await page.getByRole("link", {name: "Open in the studio"}).click();
  await page.locator(".play-arranged:visible").waitFor({timeout: 120_000});

  // The player plays the notes that the MIDI file has, in time; pauses, goes to a place, ends.
  await page.goto(home + "pattern/hilbert-kalyani.html");
  const play = page.getByRole("button", {name: "Play"});
  await play.focus();
  await page.keyboard.press("Enter");
  await page.getByRole("button", {name: "Pause"}).waitFor();
  const silence = "The browser cannot play sound; is there an audio device?";
  await page.waitForFunction(text => sikkuPlayer.now() > 2 || sikkuPlayer.clock.textContent === text, silence, {timeout: 60_000});
  // The player reads the melody that the program reports.
  const report = Number((await page.locator("dt:text-is('Notes') + dd").textContent()).replace(/,/g, ""));
  assert.equal(await page.evaluate(() => sikkuPlayer.score.notes.length), report, "the notes of the file are those of the report");
  if (name !== "Chromium" && await page.evaluate(() => !sikkuPlayer.playing)) {
    // Without an audio device, the audio clock of Firefox does not run.
    await page.evaluate(() => sikkuPlayer.seek(0.5));
    assert.ok(await page.evaluate(() => Math.abs(sikkuPlayer.now() / sikkuPlayer.score.length - 0.5) < 0.001));
    await context.close();
    console.log(`site in ${name}: studio, search, filter, links`);
    console.log(`skipped: the player in ${name} (no device for sound)`);
    return;
  }
  const state = () => page.evaluate(() => {
    const {score, scheduled, next, playing} = sikkuPlayer, now = sikkuPlayer.now();
    return {now, scheduled, next, playing, length: score.length, notes: score.notes.length,
            due: score.notes.filter(note => note.start <= now).length, soon: score.notes.filter(note => note.start < now + 0.5).length};
  });
  const seen = await state();
  assert.ok(seen.scheduled >= seen.due && seen.scheduled <= seen.soon, JSON.stringify(seen));
  assert.ok(seen.due > 0 && seen.notes > 150, JSON.stringify(seen));
  await page.getByRole("button", {name: "Pause"}).click();
  const paused = (await state()).now;
  await page.waitForTimeout(300);
  assert.equal((await state()).now, paused, "pause does not stop it");
  await page.locator("#place").evaluate(slider => { slider.value = 500; slider.dispatchEvent(new Event("input")); });
  await page.waitForFunction(() => Math.abs(sikkuPlayer.now() / sikkuPlayer.score.length - 0.5) < 0.001);
  await page.evaluate(() => sikkuPlayer.seek(1));
  await page.evaluate(() => { sikkuPlayer.place = sikkuPlayer.score.length - 0.3; });
  await page.getByRole("button", {name: "Play"}).click();
  await page.waitForFunction(() => !sikkuPlayer.playing && sikkuPlayer.now() === sikkuPlayer.score.length, null, {timeout: 20_000});
  await context.close();
  console.log(`site in ${name}: studio, search, filter, links, player`);
}
await use(browser, "Chromium");
nothingWrong();

// Offline use: the first pages are stored at once, all others after a click; no requests go to other servers.
{
  const context = await browser.newContext({viewport: {width: 1280, height: 800}});
  const page = watch(await context.newPage());
  await page.goto(home + "index.html");
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.waitForFunction(() => navigator.serviceWorker.controller);
  const manifest = JSON.parse(readFileSync(join(site, "manifest.webmanifest"), "utf8"));
  for (const {src, sizes} of manifest.icons) {
    const data = readFileSync(join(site, src));
    assert.equal(`${data.readUInt32BE(16)}x${data.readUInt32BE(20)}`, sizes);
  }
  await context.setOffline(true);
  await page.goto(home + "manual/tutorial.html");
  assert.equal(await page.locator("h1").textContent(), "Tutorial");
  const expected = complaints.length;
  await page.goto(home + "pattern/lilac.html").catch(() => {});
  assert.equal(await page.locator("h1").textContent(), "Not available offline");
  complaints.length = expected;
  await context.setOffline(false);
  await page.goto(home + "index.html");
  await page.locator("#keep").click();
  await page.locator("#keep-state").getByText("The site is available offline").waitFor({timeout: 300_000});
  await context.setOffline(true);
  await page.goto(home + "pattern/lilac.html");
  await page.waitForFunction(() => document.querySelector(".plate img").naturalWidth > 0);
  await page.goto(home + "studio/");
  await page.locator("#facts").getByText("No errors").waitFor({timeout: 120_000});
  await context.close();
  console.log("site: installed, kept, used without a network");
}

// A pattern whose texts contain code: they are shown as texts, and the code does not run.
{
  const {server: second, home} = await serve(resolve(hostile));
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, ...blocked});
  const page = await context.newPage();
  const errors = [];
  page.on("pageerror", error => errors.push(String(error)));
  page.on("console", message => { if (message.type() === "error") errors.push(message.text()); });
  for (const path of ["pattern/hostile.html", "patterns/kolams.html", "patterns/index.html", "search.html?q=desrever"]) {
    await page.goto(home + path);
    if (path.startsWith("search")) await page.locator("#results a").first().waitFor();
    const facts = await page.evaluate(() => ({
      title: document.title, headings: document.querySelectorAll("h1").length,
      foreign: document.querySelectorAll("bdi *, code :not(.word), dd b, script:not([src]), style, [onerror], [onmouseover], img[src='x']").length,
      controls: /[\u202a-\u202e\u2066-\u2069\u200e\u200f]/.test(document.documentElement.outerHTML),
      shows: document.body.textContent.includes("<script>document.title='broken'</script>"),
    }));
    assert.notEqual(facts.title, "broken", path);
    assert.deepEqual([facts.headings, facts.foreign, facts.controls, facts.shows], [1, 0, false, true], path);
  }
  assert.deepEqual(errors, []);
  await context.close();
  second.close();
  console.log("site: a hostile pattern stays text");
}
await browser.close();

if (existsSync("/usr/bin/firefox-esr") || process.env.FIREFOX) {
  // This channel is Firefox as Mozilla and Debian build it, through WebDriver BiDi.
  const fox = await firefox.launch({channel: "moz-firefox", executablePath: process.env.FIREFOX ?? "/usr/bin/firefox-esr"});
  try {
    await use(fox, "Firefox");
  } finally {
    await fox.close();
  }
} else {
  console.log("skipped: the site in Firefox (not installed)");
}

nothingWrong();
assert.ok(!asked.some(path => !path.startsWith(base) && path !== "/favicon.ico"), "a page requests files outside the site");
server.close();
