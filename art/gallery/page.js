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
