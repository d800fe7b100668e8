// The service worker: keeps the newest build in the browser, so that the app starts without a network.
// web/offline.sh puts two constants before this text: BUILD, the name of the folder with the build's files, and FILES,
// the checksums of all files by address ("./" is the page).
//
// The page comes from the network where there is one, so an update shows at the next load and nobody stays on an old
// build. Every other file has its build in its address, so it can come from any cache or the network and is the same.
// What could go wrong, and why it does not:
// - A new page with an old worker (or the reverse): their addresses differ. Should a server answer anything else under
//   such an address (an error page, half an upload), its checksum is wrong and the install fails.
// - An install that fails half-way (connection lost, server between two builds, storage full): the page is kept last, so
//   a cache without one is never started from; the build before stays what is used offline. The browser tries again at
//   the next load.
// - An old page is open when a new build has been installed, and starts another worker: its cache is there. Old caches
//   are deleted when the new service worker becomes active, and the browser waits with that (there is no skipWaiting)
//   until no page is open that the old one serves. Till then the old one serves pages of both builds, by address.
// - A first visit: the page registers this when the app runs. The files come out of the browser's own cache, if the
//   server lets the browser keep or revalidate them. `claim` lets this first page start workers offline as well.
// - The site moves, or sw.js breaks: the browser goes on with the old one, which shows the page that the server has.
// - The browser keeps nothing (private windows, storage full or blocked, plain http): registration or install fails, or
//   `find` finds nothing, and everything comes from the network.
// A page that was loaded past the service worker (Shift and reload) behaves as if there were none. Once its build is gone
// from the server, files that it has not loaded yet are missing. It says so, and never gets those of another build.

/** A page from the network that takes longer than this, in ms, comes from the cache. */
const PATIENCE = 3000;
const PAGE = "./";
const TEXT = "./text.html";
// Caches are shared by all that is published under the same origin.
const OURS = `tautline ${registration.scope} `;
const CACHE = OURS + BUILD;

addEventListener("install", (event) => event.waitUntil(install()));
addEventListener("activate", (event) => event.waitUntil(activate()));
addEventListener("fetch", (event) => {
    const { method, mode, url } = event.request;
    if (method !== "GET" || !url.startsWith(registration.scope)) return;
    if (mode !== "navigate") return event.respondWith(file(event.request));
    const name = url.slice(registration.scope.length).split(/[?#]/)[0];
    if (name === "" || name === "index.html") event.respondWith(page(event.request, PAGE));
    if (name === "text.html") event.respondWith(page(event.request, TEXT));
});

async function install() {
    await caches.delete(CACHE); // a part from an earlier attempt, or from before a newer build was taken back
    const cache = await caches.open(CACHE);
    const request = (address) => new Request(address, {
        // Files in the build's folder never change.
        cache: address.startsWith(`./${BUILD}/`) ? "default" : "no-cache",
        integrity: FILES[address],
        redirect: "error", // a browser refuses pages kept from a redirection
    });
    await cache.addAll(Object.keys(FILES).filter((address) => address !== PAGE && address !== TEXT).map(request));
    // Some servers redirect names that end in .html. There the text version needs a network, and the app does not.
    await cache.add(request(TEXT)).catch(() => undefined);
    await cache.add(request(PAGE));
}

async function activate() {
    const newestFirst = await builds();
    // Newer ones may be about to be installed.
    await Promise.all(newestFirst.slice(newestFirst.indexOf(CACHE) + 1).map((name) => caches.delete(name)));
    await clients.claim();
}

/** The names of the builds' caches, newest first; browsers list them as they were made. */
async function builds() {
    return (await caches.keys()).filter((name) => name.startsWith(OURS)).reverse();
}

/** What is kept under an address, in the newest build that has it. */
async function find(address) {
    try {
        for (const cacheName of await builds()) {
            const kept = await caches.match(address, { cacheName, ignoreVary: true });
            if (kept) return kept;
        }
    } catch { /* the storage is blocked or broken */ }
}

/** The newest of the page or of the text version, which is kept under this address. */
async function page(request, address) {
    const kept = await find(address);
    if (!kept) return fetch(request);
    // Not the request itself: a navigation takes no options. Redirections are followed by the browser.
    const online = fetch(request.url, { cache: "no-cache", redirect: "manual" }).catch(() => undefined);
    const late = new Promise((resolve) => setTimeout(resolve, PATIENCE));
    const response = await Promise.race([online, late]);
    // A page that is gone (404) is gone; a server in trouble (5xx) is as none.
    return response?.status < 500 ? response : kept;
}

async function file(request) {
    return await find(request.url) ?? fetch(request);
}
