// Searches the index of the site, which assets/index.js sets as `sikkuIndex`:
// {pages: [[address, title, of, excerpt]], words: "word word …", places: "places of the first word|…"}, where places are
// differences between numbers of pages in base 36, and a capital W after one means that the word is in the title.
"use strict";

const field = document.getElementById("query"), list = document.getElementById("results");
const state = document.getElementById("search-state");
const {pages, words: joined, places: packed} = window.sikkuIndex;
const words = joined.split(" "), places = packed.split("|");

const fold = text => text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();

/* Pages with words that begin with a text, and how well they fit. */
function pagesWith(text) {
    const found = new Map();
    let low = 0, high = words.length;
    while (low < high) {
        const middle = (low + high) >> 1;
        if (words[middle] < text) low = middle + 1; else high = middle;
    }
    for (let at = low; at < words.length && words[at].startsWith(text); ++at) {
        const whole = words[at] === text ? 2 : 1;
        let page = 0;
        for (const [, difference, title] of places[at].matchAll(/([0-9a-z]+)(W?)/g)) {
            page += parseInt(difference, 36);
            found.set(page, Math.max(found.get(page) ?? 0, whole * (title ? 6 : 1)));
        }
    }
    return found;
}

function search() {
    const query = field.value.slice(0, 200);
    const asked = fold(query).match(/[\p{L}\p{N}]+/gu) ?? [];
    list.replaceChildren();
    state.textContent = "";
    if (asked.length === 0) return;
    const sets = [...new Set(asked)].map(pagesWith);
    let found = [...sets[0]].filter(([page]) => sets.every(set => set.has(page)));
    found = found.map(([page]) => [page, sets.reduce((sum, set) => sum + set.get(page), 0)]);
    const whole = asked.join(" ");
    for (const entry of found) {
        if ((fold(pages[entry[0]][1]).match(/[\p{L}\p{N}]+/gu) ?? []).join(" ") === whole) entry[1] += 20;
    }
    found.sort((a, b) => b[1] - a[1] || a[0] - b[0]);
    const most = 60;
    state.textContent = found.length === 0 ? "Nothing found. Try fewer or shorter words."
        : found.length > most ? `${found.length} found; the first ${most} are shown` : `${found.length} found`;
    for (const [page] of found.slice(0, most)) {
        const [address, title, of, excerpt] = pages[page];
        const entry = document.createElement("li"), link = document.createElement("a");
        link.href = address;
        const name = document.createElement("bdi");
        name.textContent = title;
        link.append(name);
        entry.append(link);
        if (of) entry.append(` in ${of}`);
        const text = document.createElement("p");
        text.dir = "auto";
        text.textContent = excerpt;
        entry.append(text);
        list.append(entry);
    }
}

let timer = 0;
field.addEventListener("input", () => {
    clearTimeout(timer);
    timer = setTimeout(() => {
        search();
        const address = new URL(location.href);
        address.searchParams.set("q", field.value);
        history.replaceState(null, "", address);
    }, 120);
});
field.form.addEventListener("submit", event => {
    event.preventDefault();
    search();
});
field.value = new URLSearchParams(location.search).get("q") ?? "";
search();
