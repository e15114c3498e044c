// Code that all pages share: copying commands, filtering galleries, opening the studio in the page, working offline.
"use strict";

const root = new URL("../", document.currentScript.src);

for (const button of document.querySelectorAll("[data-copy]")) {
    button.hidden = !navigator.clipboard;
    button.addEventListener("click", async () => {
        await navigator.clipboard.writeText(document.getElementById(button.dataset.copy).textContent);
        const name = button.textContent;
        button.textContent = "Copied";
        setTimeout(() => { button.textContent = name; }, 1500);
    });
}

const filter = document.getElementById("filter");
if (filter) {
    filter.closest(".filter").hidden = false;
    const entries = [...document.querySelectorAll("#patterns > li")];
    const count = document.getElementById("count");
    const show = () => {
        const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
        let shown = 0;
        for (const entry of entries) {
            const text = `${entry.textContent} ${entry.dataset.words}`.toLowerCase();
            entry.hidden = !words.every(word => text.includes(word));
            shown += !entry.hidden;
        }
        count.textContent = `${shown} of ${entries.length}`;
    };
    filter.addEventListener("input", show);
    show();
}

// The studio is large, so it is loaded only on a click; on small screens it opens in a separate page.
for (const link of document.querySelectorAll("a[data-studio]")) {
    link.addEventListener("click", event => {
        if (event.ctrlKey || event.metaKey || event.shiftKey || innerWidth < 760) return;
        event.preventDefault();
        const place = document.getElementById("studio-place");
        if (!place.querySelector("iframe")) {
            const frame = document.createElement("iframe");
            frame.src = link.href;
            frame.title = "The studio";
            frame.allow = "autoplay; fullscreen; clipboard-write; midi";
            place.replaceChildren(frame);
        }
        const shown = place.querySelector("iframe");
        if (link.hash && shown.src !== link.href) shown.src = link.href;
        const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
        place.scrollIntoView({block: "center", behavior: calm ? "auto" : "smooth"});
        place.querySelector("iframe").focus({preventScroll: true});
    });
}

if ("serviceWorker" in navigator && isSecureContext && location.protocol.startsWith("http")) {
    navigator.serviceWorker.register(new URL("worker.js", root), {scope: root.href}).then(() => {
        const keep = document.getElementById("keep"), state = document.getElementById("keep-state");
        document.getElementById("offline").hidden = false;
        navigator.serviceWorker.addEventListener("message", ({data}) => {
            if (data.kept === undefined) return;
            state.textContent = data.failed
                ? `${data.failed} files could not be loaded.`
                : data.kept < data.all ? `${data.kept} of ${data.all} files` : "The site is available offline.";
            keep.disabled = data.kept < data.all && !data.failed;
        });
        keep.addEventListener("click", async () => {
            keep.disabled = true;
            (await navigator.serviceWorker.ready).active.postMessage({keep: true});
        });
    }, () => {});
}
