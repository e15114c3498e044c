// Stores the site for offline use: the files of the first pages when it is installed, other files when they are opened,
// and all files on request. The network has precedence, so that no page is older than the site.
"use strict";

const version = "{{version}}";
const first = {{first}};
const all = {{all}};
const cache = `sikku-${version}`;

self.addEventListener("install", event => {
    event.waitUntil(caches.open(cache).then(store => store.addAll(first)).then(() => self.skipWaiting()));
});

self.addEventListener("activate", event => {
    event.waitUntil((async () => {
        for (const name of await caches.keys()) {
            if (name.startsWith("sikku-") && name !== cache) await caches.delete(name);
        }
        await self.clients.claim();
    })());
});

// The address under which a file is stored: without a query; a folder is its index.
function stored(url) {
    const address = new URL(url);
    address.search = address.hash = "";
    if (address.pathname.endsWith("/")) address.pathname += "index.html";
    return address.href;
}

self.addEventListener("fetch", event => {
    const {request} = event;
    if (request.method !== "GET" || !request.url.startsWith(self.registration.scope)) return;
    event.respondWith((async () => {
        const store = await caches.open(cache);
        try {
            const answer = await fetch(request);
            if (answer.status === 200 && answer.type === "basic") {
                event.waitUntil(store.put(stored(request.url), answer.clone()).catch(() => {}));
            }
            return answer;
        } catch (error) {
            const kept = await store.match(stored(request.url));
            if (kept) return kept;
            if (request.mode !== "navigate") throw error;
            return await store.match(new URL("offline.html", self.registration.scope).href) ?? Response.error();
        }
    })());
});

self.addEventListener("message", event => {
    if (!event.data?.keep) return;
    event.waitUntil((async () => {
        const store = await caches.open(cache);
        const tell = contents => event.source?.postMessage(contents);
        let kept = 0, failed = 0;
        const rest = [...all];
        const load = async () => {
            for (let file = rest.shift(); file !== undefined; file = rest.shift()) {
                const address = new URL(file, self.registration.scope).href;
                try {
                    if (!await store.match(address)) await store.add(address);
                    if (++kept % 50 === 0) tell({kept, all: all.length});
                } catch {
                    ++failed;
                }
            }
        };
        await Promise.all([load(), load(), load(), load()]);
        tell({kept, all: all.length, failed});
    })());
});
