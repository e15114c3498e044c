#include "art/gallery/page.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <map>

namespace sikku {
namespace {

/// A string of JSON within a script of HTML.
std::string script_string(std::string_view text) {
    std::string clean;
    clean.reserve(text.size());
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8_length(text.substr(i));
        clean += length == 0 ? std::string_view("\xEF\xBF\xBD") : text.substr(i, length);
        i += length == 0 ? 1 : length;
    }
    std::string result;
    for (const char byte : json_string(clean)) {
        if (byte == '<') {  // </script> and <!-- mean something to HTML
            result += "\\u003c";
        } else {
            result += byte;
        }
    }
    return result;
}

/// A member of the page's record of an entry; those that are empty are left out.
void put(std::string& out, std::string_view key, std::string_view value) {
    if (!value.empty()) fmt::format_to(std::back_inserter(out), ",\"{}\":{}", key, script_string(value));
}

std::string record(const GalleryEntry& entry, std::size_t pattern) {
    std::string out = "{\"name\":" + script_string(entry.name);
    put(out, "title", entry.title);
    put(out, "source", entry.source);
    put(out, "description", entry.description);
    put(out, "kind", entry.kind);
    put(out, "n", entry.n);
    put(out, "angle", entry.angle);
    put(out, "growth", entry.growth);
    put(out, "settings", entry.settings);
    put(out, "print", entry.print);
    if (entry.thumbnail != entry.print) put(out, "thumbnail", entry.thumbnail);
    out += fmt::format(",\"pattern\":{}", pattern);
    if (entry.width > 0 && entry.height > 0) out += fmt::format(",\"size\":[{},{}]", entry.width, entry.height);
    if (!entry.extras.empty()) {
        out += ",\"extras\":[";
        for (const auto& [label, path] : entry.extras) {
            out += fmt::format("[{},{}],", script_string(label), script_string(path));
        }
        out.back() = ']';
    }
    return out + '}';
}

// ---- the page

/// Rice-flour white on red earth. The band under the title is a kolam's simplest: two lines around a row of dots.
constexpr std::string_view page_style = R"css(
:root{color-scheme:light dark;--ground:#f8f4ec;--panel:#fffdf8;--text:#2b1c16;--faint:#6c584d;--line:#e0d4c5;
--accent:#8c3b2a;--on-accent:#fffaf0;--mat:#ece3d5;--dots:#d9ccba;--earth:#8c3b2a;--shade:#2b1c1633}
@media(prefers-color-scheme:dark){:root{--ground:#1b120f;--panel:#261a15;--text:#f6ecdf;--faint:#b9a497;
--line:#44312a;--accent:#e9a789;--on-accent:#2b140c;--mat:#140d0a;--dots:#2c1e18;--earth:#5f281b;--shade:#0008}}
*{box-sizing:border-box}
[hidden]{display:none!important}
html,body{margin:0;background:var(--ground);color:var(--text)}
body{font:16px/1.45 system-ui,"Segoe UI",Roboto,"DejaVu Sans",sans-serif}
body:has(dialog[open]){overflow:hidden}
h1,h2{font-family:ui-serif,Georgia,"Noto Serif","DejaVu Serif",serif;font-weight:500;line-height:1.2;
overflow-wrap:anywhere;margin:0}
header,.bar,main,footer{padding-inline:max(clamp(12px,2.5vw,32px),50vw - 850px)}
header{background:var(--earth);color:#fffaf0;padding-block:clamp(1.3rem,4vw,2.6rem) .9rem}
h1{font-size:clamp(1.6rem,3.6vw,2.6rem)}
header::after{content:"";display:block;height:16px;margin-top:clamp(.9rem,2.5vw,1.5rem);opacity:.8;
background:0 0/32px 16px round url("data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 32 16'\
 fill='none' stroke='%23fffaf0' stroke-width='1.5'%3E%3Cpath d='M0 8C8-1 24-1 32 8M0 8C8 17 24 17\
 32 8'/%3E%3Ccircle cx='16' cy='8' r='1' fill='%23fffaf0'/%3E%3C/svg%3E")}
.bar{display:flex;flex-wrap:wrap;gap:.6rem 1rem;align-items:center;padding-block:.7rem;background:var(--ground);
border-bottom:1px solid var(--line)}
@media(min-width:760px) and (min-height:600px){.bar{position:sticky;top:0;z-index:1}}
.bar label{display:flex;align-items:center;gap:.45rem;color:var(--faint);font-size:.9rem;min-width:0}
.bar .search{flex:1 1 14rem}
input[type=search],select{font:inherit;color:var(--text);background:var(--panel);border:1px solid var(--line);
border-radius:8px;padding:.4rem .6rem;min-width:0;max-width:100%;height:2.5rem;text-overflow:ellipsis}
input[type=search]{width:100%}
fieldset{display:flex;flex-wrap:wrap;gap:.4rem;border:0;margin:0;padding:0;min-width:0}
.unseen,fieldset input{position:absolute;width:1px;height:1px;opacity:0;overflow:hidden;clip-path:inset(50%)}
.chip{position:relative;cursor:pointer}
.chip span,.pill{display:inline-block;border:1px solid var(--line);border-radius:999px;background:var(--panel);
color:var(--text);padding:.38rem .8rem;max-width:100%;overflow-wrap:anywhere}
.chip small{color:var(--faint);font-size:.82em;margin-left:.35em}
.chip :checked+span{background:var(--accent);border-color:var(--accent);color:var(--on-accent)}
.chip :checked+span small{color:inherit}
@media(forced-colors:active){.chip :checked+span{border:3px solid Highlight}}
.chip :disabled+span{opacity:.5;cursor:default}
button,.pill{font:inherit;font-size:.9rem;text-decoration:none;cursor:pointer}
:focus-visible,.chip :focus-visible+span{outline:3px solid var(--accent);outline-offset:2px}
main{padding-block:1rem 2rem;min-height:50vh}
#count{color:var(--faint);font-size:.9rem;margin:0 0 1rem}
#prints{list-style:none;margin:0;padding:0;display:grid;gap:1.6rem clamp(.9rem,2vw,1.6rem);
grid-template-columns:repeat(auto-fill,minmax(min(46%,12rem),1fr))}
#prints li{content-visibility:auto;contain-intrinsic-size:auto 18rem;min-width:0;padding:6px;margin:-6px}
.card{display:block;color:inherit;text-decoration:none;border-radius:4px}
.mat{display:grid;place-items:end start;aspect-ratio:var(--shape,1);margin-bottom:.55rem;color:var(--faint)}
.mat img,#stage img{background:linear-gradient(#fff,#fff) center/calc(100% - 2px) calc(100% - 2px) no-repeat}
.mat img{display:block;width:100%;max-height:100%;object-fit:contain;object-position:0 100%;
box-shadow:0 0 0 1px var(--line),0 2px 5px var(--shade)}
.card b{display:block;font-weight:500;line-height:1.3;overflow-wrap:anywhere}
.card small{display:block;color:var(--faint);font-size:.85rem;overflow-wrap:anywhere}
.card:hover b{color:var(--accent);text-decoration:underline}
#nothing{text-align:center;padding:3rem 0;color:var(--faint)}
footer,.keys{color:var(--faint);font-size:.85rem}
footer{padding-block:1rem 2rem}
@media(hover:none){footer,.keys{display:none}}
kbd{border:1px solid var(--line);border-radius:4px;padding:0 .35em;font:inherit;font-size:.92em}
dialog{border:0;padding:0;margin:0;width:100%;height:100%;max-width:none;max-height:none;background:var(--ground);
color:var(--text);overflow:hidden auto;overscroll-behavior:contain}
dialog[open]{display:grid;grid-template:auto minmax(0,1fr)/minmax(0,1fr) minmax(20rem,26rem)}
.tools{grid-column:1/-1;display:flex;align-items:center;gap:.3rem;padding:.4rem .6rem;background:var(--ground);
border-bottom:1px solid var(--line);position:sticky;top:0;z-index:1}
.tools output{color:var(--faint);font-size:.85rem;font-variant-numeric:tabular-nums;white-space:nowrap}
.tools .gap{flex:1}
.tools button{display:grid;place-items:center;width:2.6rem;height:2.6rem;border:0;border-radius:8px;
background:none;color:inherit}
.tools #zoom-fit{width:3.6rem;font-variant-numeric:tabular-nums}
.tools button:hover,.pill:hover{background:var(--mat)}
.tools svg{width:1.3rem;height:1.3rem;fill:none;stroke:currentColor;stroke-width:2;stroke-linecap:round;
stroke-linejoin:round}
#stage{position:relative;overflow:hidden;touch-action:pan-y;min-height:0;
background:var(--mat) radial-gradient(circle,var(--dots) 1.5px,#0000 2px) 0 0/28px 28px}
#stage.near{touch-action:none;cursor:grab}
#stage.near:active{cursor:grabbing}
#stage:focus-visible{outline-width:2px;outline-offset:-2px}
#stage img{position:absolute;max-width:none;box-shadow:0 2px 14px var(--shade);
user-select:none;-webkit-user-drag:none}
#stage p{position:absolute;inset:auto 0 1rem;width:fit-content;max-width:calc(100% - 2rem);margin:auto;
padding:.3rem .8rem;border-radius:8px;background:var(--panel);color:var(--faint);font-size:.9rem;text-align:center;
overflow-wrap:anywhere}
.about{padding:1.2rem clamp(12px,2vw,24px);border-left:1px solid var(--line);overflow:auto;min-width:0}
.about p{margin:.6rem 0;overflow-wrap:anywhere}
dl{display:grid;grid-template-columns:auto minmax(0,1fr);gap:.25rem 1rem;margin:1rem 0;font-size:.92rem}
dt{color:var(--faint)}
dd{margin:0;overflow-wrap:anywhere}
.links{display:flex;flex-wrap:wrap;gap:.5rem;margin:1rem 0}
.links .pill:first-child{background:var(--accent);border-color:var(--accent);color:var(--on-accent)}
.row{display:flex;align-items:center;justify-content:space-between;gap:1rem;margin-top:1.6rem}
.row h3{font-size:1rem;font-weight:500;margin:0}
pre{background:var(--panel);border:1px solid var(--line);border-radius:8px;padding:.8rem;margin:.6rem 0;
white-space:pre-wrap;overflow-wrap:anywhere;font:13px/1.5 ui-monospace,"DejaVu Sans Mono",monospace;tab-size:4}
@media(max-width:760px){.bar{gap:.6rem .5rem}
.bar label:not(.search,.chip){flex:1 1 28%;display:grid;gap:.15rem}.bar .search,fieldset{flex:1 1 100%}
fieldset{flex-wrap:nowrap;overflow-x:auto;scrollbar-width:none;margin:-5px;padding:5px}
.chip{flex:none}
dialog[open]{grid-template:auto 62svh auto/minmax(0,1fr)}.tools{gap:0}
.about{border-left:0;border-top:1px solid var(--line);overflow:visible}}
)css";

constexpr std::string_view page_body = R"html(
<div class="bar" role="search">
<label class="search"><span class="unseen">Search</span><input type="search" id="search" placeholder="Search"
 autocomplete="off" spellcheck="false"/></label>
<fieldset id="kind"><legend class="unseen">Kind</legend></fieldset>
<label>Growth <select id="growth"></select></label>
<label>Angle <select id="angle"></select></label>
<label>Order <select id="order"><option value="given">as made</option><option value="title">title</option>
<option value="kind">kind</option><option value="n">n</option><option value="angle">angle</option></select></label>
</div>
<main>
<p id="count" role="status"></p>
<ul id="prints"></ul>
<div id="nothing" hidden="hidden"><p>No print is like that.</p>
<button type="button" class="pill" id="clear">Show all</button></div>
<noscript><p>To show its prints, this page needs JavaScript.</p></noscript>
</main>
<footer><kbd>/</kbd> searches, the arrow keys go from print to print, <kbd>Enter</kbd> looks at one.</footer>
<dialog id="viewer" aria-labelledby="title">
<div class="tools" role="group" aria-label="Viewing">
<button type="button" id="previous" aria-label="Previous print" title="Previous (K)"><svg viewBox="0 0 24 24"
 aria-hidden="true"><path d="M15 5l-7 7 7 7"/></svg></button>
<output id="place"></output>
<button type="button" id="next" aria-label="Next print" title="Next (J)"><svg viewBox="0 0 24 24"
 aria-hidden="true"><path d="M9 5l7 7-7 7"/></svg></button>
<span class="gap"></span>
<button type="button" id="zoom-out" aria-label="Smaller" title="Smaller (-)"><svg viewBox="0 0 24 24"
 aria-hidden="true"><path d="M5 12h14"/></svg></button>
<button type="button" id="zoom-fit" title="All of it (0)"></button>
<button type="button" id="zoom-in" aria-label="Larger" title="Larger (+)"><svg viewBox="0 0 24 24"
 aria-hidden="true"><path d="M5 12h14M12 5v14"/></svg></button>
<button type="button" id="close" aria-label="Close" title="Close (Esc)"><svg viewBox="0 0 24 24"
 aria-hidden="true"><path d="M6 6l12 12M18 6L6 18"/></svg></button>
</div>
<div id="stage" tabindex="0" role="group" aria-label="The print" aria-describedby="keys" autofocus="autofocus"></div>
<section class="about" aria-labelledby="title">
<h2 id="title"></h2>
<p id="description"></p>
<dl id="facts"></dl>
<nav class="links" id="links" aria-label="Files"></nav>
<div id="text"><div class="row"><h3>The pattern</h3>
<span class="unseen" id="copied" role="status"></span>
<button type="button" class="pill" id="copy">Copy</button></div>
<pre id="pattern"></pre></div>
<p class="keys" id="keys"><kbd>+</kbd> <kbd>-</kbd> enlarge and reduce, <kbd>0</kbd> shows all, the arrow keys move what
is enlarged, else <kbd>←</kbd> <kbd>→</kbd> and always <kbd>K</kbd> <kbd>J</kbd> go on to other prints, <kbd>Esc</kbd>
goes back.</p>
</section>
</dialog>
)html";

constexpr std::string_view page_script = R"js(
"use strict";
const data = JSON.parse(document.getElementById("gallery").textContent);
const element = id => document.getElementById(id);
const make = (name, properties, ...children) => {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
};
const capital = text => text.slice(0, 1).toUpperCase() + text.slice(1);
const plain = text => text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();
/* A path as an address that is below this page, whatever characters it has. */
const address = path => "./" + path.split("/").map(encodeURIComponent).join("/");
const extension = path => (/\.(\w+)$/.exec(path) || ["", ""])[1].toLowerCase();
const showable = path => /^(svg|png|jpe?g|gif|webp|avif)$/.test(extension(path));
const degrees = text => /^[\d.]+$/.test(text) ? text + "°" : text;

const entries = data.entries.map((record, index) => {
  const entry = {title: record.name, source: "", description: "", kind: "", n: "", angle: "", growth: "",
                 settings: "", print: "", extras: [], ...record, index};
  entry.thumbnail ??= entry.print;
  entry.pattern = data.patterns[entry.pattern];
  entry.words = plain([entry.title, entry.name, entry.kind, entry.source, entry.description, entry.growth,
                       entry.settings].join("\n"));
  entry.brief = [entry.n && "n = " + entry.n, degrees(entry.angle), entry.settings].filter(Boolean).join(" · ");
  return entry;
});
const byName = new Map(entries.map(entry => [entry.name, entry]));
const galleryTitle = document.title;

/* The prints. Each has as much room as the median of their shapes asks for. */
const shapes = entries.map(entry => entry.size ? entry.size[0] / entry.size[1] : 1).sort((a, b) => a - b);
const shape = Math.min(2, Math.max(0.5, shapes[shapes.length >> 1] || 1));
const list = element("prints");
list.style.setProperty("--shape", shape);
function listItem(entry) {
  if (entry.item) return entry.item;
  const mat = make("span", {className: "mat"});
  if (showable(entry.thumbnail)) {
    const image = make("img", {alt: "", loading: "lazy", decoding: "async"});
    if (entry.size) {
      const [width, height] = entry.size;
      image.style.aspectRatio = width + "/" + height;
      image.style.width = Math.min(100, 100 * width / height / shape) + "%";
    } else {
      image.style.height = "100%";
    }
    image.src = address(entry.thumbnail);
    mat.append(image);
  } else {
    mat.append(extension(entry.print).toUpperCase());
  }
  entry.card = make("a", {className: "card", href: "#" + encodeURIComponent(entry.name)}, mat,
                    make("b", {textContent: entry.title}), make("small", {textContent: entry.brief}));
  entry.card.addEventListener("click", event => {
    if (event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    visit(entry);
  });
  return entry.item = make("li", {}, entry.card);
}

/* Of thousands only those are made that are near enough to be seen soon. */
let visible = [], listed = 0;
const atOnce = 120;
function reach(count) {
  const items = document.createDocumentFragment();
  for (; listed < Math.min(count, visible.length); ++listed) items.append(listItem(visible[listed]));
  list.append(items);
  end.disconnect();
  if (listed < visible.length) end.observe(list.lastElementChild);
}
const end = new IntersectionObserver(seen => {
  if (seen.some(each => each.isIntersecting)) reach(listed + atOnce);
}, {rootMargin: "2000px"});
function focusOn(entry) {
  const at = visible.indexOf(entry);
  if (at < 0) return;
  reach(at + 1);
  entry.card.focus();
}

/* Search, filters and order. */
const collator = new Intl.Collator("en", {numeric: true});
const number = text => text === "" || isNaN(parseFloat(text)) ? Infinity : parseFloat(text);
const byNumber = (a, b) => a === b ? 0 : (number(a) - number(b) || collator.compare(a, b));
const orders = {
  given: () => 0,
  title: (a, b) => collator.compare(a.title, b.title),
  kind: (a, b) => collator.compare(a.kind, b.kind),
  n: (a, b) => byNumber(a.n, b.n),
  angle: (a, b) => byNumber(a.angle, b.angle)
};
const search = element("search"), order = element("order");

/* A filter shows one value of a key, or all (null), and how many prints each would leave. */
function filter(key, label, compare) {
  const place = element(key), radios = place.tagName === "FIELDSET";
  const choices = new Map();
  const values = [...new Set(entries.map(entry => entry[key]))].sort(compare);
  for (const value of [null, ...values]) {
    const text = value === null ? "All" : label(value);
    if (radios) {
      const input = make("input", {type: "radio", name: key, checked: value === null});
      const count = make("small");
      place.append(make("label", {className: "chip"}, input, make("span", {textContent: text}, " ", count)));
      choices.set(value, {input, show: n => { count.textContent = n; }});
    } else {
      const input = make("option");
      place.append(input);
      choices.set(value, {input, show: n => { input.textContent = `${text} (${n})`; }});
    }
  }
  (radios ? place : place.parentNode).hidden = values.length < 2;
  place.addEventListener("change", update);
  const state = radios ? "checked" : "selected";
  return {
    key,
    chosen: () => [...choices].find(([, choice]) => choice.input[state])?.[0] ?? null,
    clear: () => { choices.get(null).input[state] = true; },
    show(counts) {
      let all = 0;
      for (const count of counts.values()) all += count;
      for (const [value, {input, show}] of choices) {
        const count = value === null ? all : counts.get(value) || 0;
        show(count);
        input.disabled = count === 0 && value !== null && !input[state];
      }
    }
  };
}
const filters = [
  filter("kind", kind => capital(kind) || "Other", () => 0),
  filter("growth", growth => growth || "unknown", (a, b) => (a === "") - (b === "") || collator.compare(a, b)),
  filter("angle", angle => degrees(angle) || "none", byNumber)
];

function update() {
  const words = plain(search.value).split(/\s+/).filter(Boolean);
  const chosen = filters.map(each => each.chosen());
  const counts = filters.map(() => new Map());
  const count = (i, entry) => {
    const value = entry[filters[i].key];
    counts[i].set(value, (counts[i].get(value) || 0) + 1);
  };
  visible = [];
  for (const entry of entries) {
    if (!words.every(word => entry.words.includes(word))) continue;
    const against = [];
    chosen.forEach((value, i) => { if (value !== null && value !== entry[filters[i].key]) against.push(i); });
    /* A filter counts what all the others let through. */
    if (against.length === 0) { visible.push(entry); filters.forEach((each, i) => count(i, entry)); }
    else if (against.length === 1) count(against[0], entry);
  }
  filters.forEach((each, i) => each.show(counts[i]));
  const compare = orders[order.value];
  visible.sort((a, b) => compare(a, b) || a.index - b.index);
  list.replaceChildren();
  listed = 0;
  reach(atOnce);
  const prints = entries.length + (entries.length === 1 ? " print" : " prints");
  element("count").textContent = visible.length === entries.length ? prints : visible.length + " of " + prints;
  element("nothing").hidden = visible.length > 0 || entries.length === 0;
}
let due = 0;
search.addEventListener("input", () => { cancelAnimationFrame(due); due = requestAnimationFrame(update); });
order.addEventListener("change", update);
element("clear").addEventListener("click", () => {
  search.value = "";
  filters.forEach(each => each.clear());
  update();
  search.focus();
});

/* The address tells which print is open, so that links, reload and the back button do what they should. */
let current = null;
const bare = () => location.href.split("#")[0];
function visit(entry) {
  /* One step back leaves the viewer, however many prints were looked at. */
  const push = !current && !history.state?.viewed;
  const url = "#" + encodeURIComponent(entry.name);
  if (push) history.pushState({viewed: true}, "", url);
  else history.replaceState(history.state, "", url);
  follow();
}
function follow() {
  let name = location.hash.slice(1);
  try { name = decodeURIComponent(name); } catch { /* then it is as it is */ }
  const entry = byName.get(name);
  if (entry) view(entry);
  else leave();
}
addEventListener("hashchange", follow);

/* The viewer. */
const viewer = element("viewer"), stage = element("stage");
let image = null, ratio = 1, zoom = {scale: 1, x: 0, y: 0};
const mostZoom = 64;

function fact(term, text) {
  if (text) element("facts").append(make("dt", {textContent: term}), make("dd", {textContent: text}));
}
function link(label, path) {
  if (path) element("links").append(make("a", {className: "pill", href: address(path), target: "_blank",
                                               rel: "noopener", textContent: label}));
}
function note(text) { stage.append(make("p", {textContent: text})); }

function view(entry) {
  current = entry;
  document.title = entry.title + " · " + galleryTitle;
  element("title").textContent = entry.title;
  element("description").textContent = entry.description;
  element("description").hidden = !entry.description;
  const at = visible.indexOf(entry);
  element("place").textContent = at < 0 ? "" : `${at + 1} / ${visible.length}`;
  element("facts").replaceChildren();
  fact("Kind", capital(entry.kind));
  fact("n", entry.n);
  fact("Angle", degrees(entry.angle));
  fact("Growth", entry.growth);
  fact("Settings", entry.settings);
  fact("Source", entry.source);
  element("links").replaceChildren();
  link("Print (" + (extension(entry.print).toUpperCase() || "file") + ")", entry.print);
  for (const [label, path] of entry.extras) link(label, path);
  element("text").hidden = !entry.pattern;
  element("pattern").textContent = entry.pattern;
  element("copied").textContent = "";

  const shown = showable(entry.print) ? entry.print : entry.thumbnail;
  ratio = entry.size ? entry.size[0] / entry.size[1] : 1;
  stage.replaceChildren();
  image = null;
  if (showable(shown)) {
    image = make("img", {alt: entry.title, draggable: false});
    const opened = image;
    /* The thumbnail stands in until the print is there. */
    if (showable(entry.thumbnail)) image.style.backgroundImage = `url("${address(entry.thumbnail)}")`;
    image.addEventListener("load", () => {
      opened.style.backgroundImage = "";
      if (opened !== image || !opened.naturalWidth) return;
      if (!entry.size) ratio = opened.naturalWidth / opened.naturalHeight;
      place();
    });
    image.addEventListener("error", () => { if (opened === image) note(`${shown} cannot be shown.`); });
    image.src = address(shown);
    stage.append(image);
    if (shown !== entry.print) note(`The thumbnail; the print is ${extension(entry.print).toUpperCase()}.`);
  } else {
    note("There is no picture that a browser can show.");
  }
  if (!viewer.open) viewer.showModal();
  viewer.scrollTop = 0;
  viewer.querySelector(".about").scrollTop = 0;
  fit();
}
function step(by) {
  if (!current || visible.length === 0) return;
  const at = visible.indexOf(current);
  const to = at >= 0 ? at + by : by > 0 ? 0 : -1;
  visit(visible[(to + visible.length) % visible.length]);
}
function leave() {
  const last = current;
  if (!last) return;
  current = null;
  viewer.close();
  document.title = galleryTitle;
  stage.replaceChildren();
  pointers.clear();
  if (location.hash) history.replaceState(history.state, "", bare());
  focusOn(last);
}
/* By Escape. */
viewer.addEventListener("close", () => { if (!viewer.open) leave(); });

/* The picture's middle is at (x, y) from the middle of the stage, `scale` times as large as it fits. */
function room() {
  const width = stage.clientWidth, height = stage.clientHeight, air = Math.min(width, height) * 0.03;
  const across = Math.max(1, Math.min(width - 2 * air, (height - 2 * air) * ratio));
  return {width, height, across, down: across / ratio};
}
function place() {
  const {width, height, across, down} = room();
  const within = (value, most) => Math.min(Math.max(value, -most), Math.max(0, most));
  zoom.x = within(zoom.x, Math.max(0, (across * zoom.scale - width) / 2));
  zoom.y = within(zoom.y, Math.max(0, (down * zoom.scale - height) / 2));
  if (image) {
    Object.assign(image.style, {
      width: across + "px", height: down + "px", left: (width - across) / 2 + "px", top: (height - down) / 2 + "px",
      transform: `translate(${zoom.x}px, ${zoom.y}px) scale(${zoom.scale})`
    });
  }
  stage.classList.toggle("near", zoom.scale > 1);
  const times = zoom.scale.toFixed(zoom.scale < 9.95 && zoom.scale > 1 ? 1 : 0) + "×";
  element("zoom-fit").textContent = times;
  element("zoom-fit").setAttribute("aria-label", times + ", show all of it");
}
function fit() { zoom = {scale: 1, x: 0, y: 0}; place(); }
/* What was at (x, y) from the middle of the stage is now at `to`: where it was, unless told otherwise. */
function enlarge(times, x = 0, y = 0, to = {x, y}, from = zoom) {
  const scale = Math.min(mostZoom, Math.max(1, from.scale * times)), by = scale / from.scale;
  zoom = {scale, x: to.x - (x - from.x) * by, y: to.y - (y - from.y) * by};
  place();
}
function move(x, y) { zoom.x += x; zoom.y += y; place(); }
function fromMiddle(event) {
  const box = stage.getBoundingClientRect();
  return {x: event.clientX - box.left - box.width / 2, y: event.clientY - box.top - box.height / 2};
}

stage.addEventListener("wheel", event => {
  event.preventDefault();
  const {x, y} = fromMiddle(event);
  const lines = event.deltaMode === 1 ? 24 : 1;
  enlarge(Math.exp(-Math.max(-120, Math.min(120, event.deltaY * lines)) * (event.ctrlKey ? 0.012 : 0.003)), x, y);
  hold();
}, {passive: false});
stage.addEventListener("dblclick", event => {
  const {x, y} = fromMiddle(event);
  if (zoom.scale > 1) fit(); else enlarge(4, x, y);
});
/* One pointer moves, two pinch; a finger that sweeps over a whole print goes to the next. */
const pointers = new Map();
let grip = null, swept = null;
const middle = () => {
  const all = [...pointers.values()], [a, b = a] = all;
  return {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot(a.x - b.x, a.y - b.y)};
};
/* Everything moves as from where it was taken hold of, so that it stays under the fingers. */
const hold = () => { grip = pointers.size > 0 ? {...middle(), zoom: {...zoom}} : null; };
stage.addEventListener("pointerdown", event => {
  if (event.button !== 0 || pointers.size === 2) return;
  stage.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, fromMiddle(event));
  hold();
  swept = event.pointerType === "touch" && pointers.size === 1 && zoom.scale === 1 ? fromMiddle(event) : null;
});
stage.addEventListener("pointermove", event => {
  if (!pointers.has(event.pointerId)) return;
  pointers.set(event.pointerId, fromMiddle(event));
  const to = middle();
  enlarge(grip.apart > 0 ? to.apart / grip.apart : 1, grip.x, grip.y, to, grip.zoom);
});
for (const type of ["pointerup", "pointercancel"]) {
  stage.addEventListener(type, event => {
    if (!pointers.delete(event.pointerId)) return;
    hold();
    if (!swept || type === "pointercancel") return;
    const {x, y} = fromMiddle(event), across = x - swept.x, along = y - swept.y;
    swept = null;
    if (zoom.scale === 1 && Math.abs(across) > Math.max(60, 2 * Math.abs(along))) step(across < 0 ? 1 : -1);
  });
}
new ResizeObserver(place).observe(stage);

const buttons = {
  previous: () => step(-1), next: () => step(1), close: leave,
  "zoom-in": () => enlarge(1.5), "zoom-out": () => enlarge(1 / 1.5), "zoom-fit": fit
};
for (const [id, act] of Object.entries(buttons)) element(id).addEventListener("click", act);

element("copy").addEventListener("click", async () => {
  let done = false;
  try {
    await navigator.clipboard.writeText(current.pattern);
    done = true;
  } catch {
    /* The old way, for pages that come from somewhere less trusted. */
    getSelection().selectAllChildren(element("pattern"));
    done = document.execCommand("copy");
  }
  element("copied").textContent = done ? "Copied" : "Not copied";
  element("copy").textContent = done ? "Copied" : "Not copied";
  setTimeout(() => { element("copy").textContent = "Copy"; element("copied").textContent = ""; }, 1500);
});

/* Keys. */
const paces = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
viewer.addEventListener("keydown", event => {
  if (event.altKey || event.ctrlKey || event.metaKey) return;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key, pace = paces[key];
  if (pace) {
    const near = zoom.scale > 1;
    /* What is beside the print may be longer than the window. */
    if (pace[0] === 0 && (!near || event.target.closest(".about"))) return;
    if (near) move(-pace[0] * stage.clientWidth / 8, -pace[1] * stage.clientHeight / 8);
    else step(pace[0]);
  } else if (key === "+" || key === "=") enlarge(1.5);
  else if (key === "-" || key === "_") enlarge(1 / 1.5);
  else if (key === "0") fit();
  else if (key === "j") step(1);
  else if (key === "k") step(-1);
  else return;
  event.preventDefault();
});
list.addEventListener("keydown", event => {
  if (event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
  const at = visible.findIndex(entry => entry.card === event.target);
  const columns = getComputedStyle(list).gridTemplateColumns.split(" ").length;
  const to = {ArrowLeft: at - 1, ArrowRight: at + 1, ArrowUp: at - columns, ArrowDown: at + columns,
              Home: 0, End: visible.length - 1}[event.key];
  if (to === undefined || !visible[to]) return;
  event.preventDefault();
  focusOn(visible[to]);
});
document.addEventListener("keydown", event => {
  if (event.key !== "/" || viewer.open || event.target.closest("input, select")) return;
  event.preventDefault();
  search.focus();
  search.select();
});

update();
follow();
)js";

}  // namespace

void write_gallery_page(std::string_view title, std::span<const GalleryEntry> entries, Output& out) {
    const std::string heading = xml_escaped(title.empty() ? "Gallery" : title);
    std::string head = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
        "style-src 'unsafe-inline'; img-src 'self' file: data:; base-uri 'none'; form-action 'none'\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
        "<meta name=\"generator\" content=\"Sikku\"/>\n<link rel=\"icon\" href=\"data:,\"/>\n"
        "<title>{}</title>\n<style>",
        heading);
    head += page_style;
    head += fmt::format("</style>\n</head>\n<body>\n<header>\n<h1>{}</h1>\n</header>", heading);
    head += page_body;
    head += "<script type=\"application/json\" id=\"gallery\">{\"patterns\":[";
    out.write(head);

    std::map<std::string_view, std::size_t> numbers;
    std::vector<std::size_t> patterns;
    for (const GalleryEntry& entry : entries) {
        const auto [known, is_new] = numbers.emplace(entry.pattern, numbers.size());
        patterns.push_back(known->second);
        if (is_new) out.write((numbers.size() == 1 ? "\n" : ",\n") + script_string(entry.pattern));
    }
    out.write("],\n\"entries\":[");
    for (std::size_t i = 0; i < entries.size(); ++i) {
        out.write((i == 0 ? "\n" : ",\n") + record(entries[i], patterns[i]));
    }
    out.write("]}</script>\n<script>");
    out.write(page_script);
    out.write("</script>\n</body>\n</html>\n");
}

}  // namespace sikku
