// What the browser tests share: a server for the page (and the npm package), a browser, and a test that fails on any
// error on the page.
//
//   browserTest("what it shows", async ({ open }) => {
//       const page = await open("", { viewport: { width: 360, height: 640 }, colorScheme: "dark" });
//       …
//   });
//
// CHROMIUM names the browser's program, if it is not one of those below on PATH.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { accessSync, constants, existsSync, mkdirSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import path from "node:path";
import { after, test } from "node:test";
import { setTimeout as sleep } from "node:timers/promises";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const ROOT = fileURLToPath(new URL("../../", import.meta.url));
export const DIST = path.join(ROOT, "dist");
const PICTURES = path.join(ROOT, "target", "pictures");

/** What the tests look at. */
export const SITES = {
    page: { folder: DIST, build: "web/serve.sh --build-only" },
    package: { folder: path.join(ROOT, "target", "npm", "tautline"), build: "web/npm/build.sh" },
};

// Published pages rarely live at the root; this shows that every address is relative.
const BASE = "/some/where/";

const TYPES = {
    ".css": "text/css",
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript",
    ".json": "application/json",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".wasm": "application/wasm",
    ".webmanifest": "application/manifest+json",
};

/** The map's switch in a window of 1280 × 800; the tests of maps fail where it is not there. */
export const MAP = [912, 41];

const FLAGS = [
    "--no-sandbox",
    // The page needs no network but ours.
    "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
    // A name for this machine that is not trusted as its own address is: what comes from there came "over the network".
    "--host-resolver-rules=MAP tautline.test 127.0.0.1",
    // WebGL 2 without a graphics card.
    "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
];

function findChromium() {
    if (process.env.CHROMIUM) return process.env.CHROMIUM;
    for (const name of ["chromium", "chromium-browser", "google-chrome"]) {
        for (const folder of (process.env.PATH ?? "").split(path.delimiter)) {
            const program = path.join(folder, name);
            try {
                accessSync(program, constants.X_OK);
                return program;
            } catch { /* not here */ }
        }
    }
    throw new Error("no Chromium on PATH: install it (on Debian: apt-get install chromium) or name it in CHROMIUM");
}

/**
 * Publishes a folder. Of what it returns `folder` and `refuse(request)`, which makes the server fail (or, by a promise
 * that it does not keep, say nothing), may be changed; after `stop()` nobody listens at the address, until `start()`.
 */
export async function publish(folder) {
    const site = { folder, refuse: () => false, start, stop };
    const server = createServer(async (request, response) => {
        if (await site.refuse(request)) return response.writeHead(500).end();
        const { pathname } = new URL(request.url, "http://localhost");
        let name = pathname.startsWith(BASE) ? pathname.slice(BASE.length) : "..";
        if (name === "") name = "index.html";
        const file = path.join(site.folder, decodeURIComponent(name));
        const type = TYPES[path.extname(file)];
        // A type that is missing in TYPES is missing for good: the page must not depend on a guess.
        if (!type || !file.startsWith(site.folder + path.sep)) return response.writeHead(404).end("not here");
        try {
            const content = await readFile(file);
            response.writeHead(200, { "content-type": type, "cache-control": "no-cache" }).end(content);
        } catch {
            response.writeHead(404).end("not here");
        }
    });
    let port = 0; // any, and from then on the same
    async function start() {
        await new Promise((resolve, reject) => server.once("error", reject).listen(port, "127.0.0.1", resolve));
        ({ port } = server.address());
        site.address = `http://127.0.0.1:${port}${BASE}`;
    }
    async function stop() {
        const closed = new Promise((resolve) => server.close(resolve));
        server.closeAllConnections();
        await closed;
    }
    await start();
    return site;
}

// One browser for a test file, and one server for each site, from its first test on.
let browsing;
const published = new Map();
async function share({ folder }) {
    browsing ??= chromium.launch({ executablePath: findChromium(), args: FLAGS });
    if (!published.has(folder)) published.set(folder, publish(folder));
    return { browser: await browsing, address: (await published.get(folder)).address };
}
after(async () => {
    await (await browsing?.catch(() => undefined))?.close();
    for (const site of published.values()) await (await site).stop();
});

/**
 * A test with pages of its own. It fails on every console error, uncaught error, failed request and request to another
 * server of its pages, except those whose text matches one of `allow` (regular expressions). When it fails, what
 * its pages showed is in target/pictures/.
 */
export function browserTest(name, body, { allow = [], timeout = 60_000, site = SITES.page } = {}) {
    test(name, { timeout }, async () => {
        if (!existsSync(site.folder)) throw new Error(`${site.folder} is missing: run ${site.build} first`);
        const { browser, address } = await share(site);
        const pages = [];
        const contexts = [];
        const errors = [];
        const note = (text) => {
            if (!allow.some((pattern) => pattern.test(text))) errors.push(text);
        };

        /**
         * Opens the page (or, by a relative `url`, another file of the site) and waits until it has loaded.
         * `before(page)` runs ahead of the page's own scripts, `tour` is what a first visitor gets; further options go to
         * Playwright's newContext. The service worker is blocked, so that tests can intercept every request.
         */
        async function open(url = "", { viewport = { width: 1280, height: 800 }, colorScheme = "light", hash = "", tour = false, before, ...options } = {}) {
            const context = await browser.newContext({ viewport, colorScheme, serviceWorkers: "block", ...options });
            contexts.push(context);
            context.on("page", (page) => {
                pages.push(page);
                page.on("console", (message) => {
                    if (message.type() === "error") note(`console: ${message.text()} (${message.location().url})`);
                });
                page.on("pageerror", (error) => note(`uncaught: ${error?.stack ?? error}`));
                page.on("request", (request) => {
                    // Where to go is for the tests to say.
                    if (request.isNavigationRequest()) return;
                    const { protocol, origin } = new URL(request.url());
                    const own = new URL(request.frame().url()).origin;
                    if (protocol.startsWith("http") && origin !== own) note(`to another server: ${request.url()}`);
                });
                page.on("requestfailed", (request) => note(`failed: ${request.url()} ${request.failure()?.errorText}`));
            });
            const page = await context.newPage();
            // Only those who ask for it are shown around.
            if (!tour) {
                await page.addInitScript(() => {
                    try {
                        if (!localStorage.getItem("tautline-state")) localStorage.setItem("tautline-state", '{"tour_taken":true}');
                    } catch { /* a frame that is still empty has none */ }
                });
            }
            await before?.(page);
            const destination = new URL(url, address);
            if (hash) destination.hash = hash;
            await page.goto(destination.href);
            return page;
        }

        try {
            await body({ open, browser, origin: address });
            assert.deepEqual(errors, [], "the page reported errors");
        } catch (error) {
            for (const [i, page] of pages.entries()) {
                await screenshot(page, `failed ${name} ${i + 1}`).catch(() => {});
            }
            if (errors.length && error.code !== "ERR_ASSERTION") error.message += `\nThe page reported:\n${errors.join("\n")}`;
            throw error;
        } finally {
            for (const context of contexts) await context.close();
        }
    });
}

/** Waits until the app runs and has sized its canvas; fails with the page's own message if it says that it cannot. */
export async function waitForStart(page, { timeout = 30_000 } = {}) {
    await page.waitForFunction(() => {
        const failure = document.getElementById("tautline-error");
        if (!failure.hidden) throw new Error(`the page says: ${failure.textContent}`);
        return document.getElementById("tautline-loading").hidden;
    }, undefined, { timeout });
    // The mark is set just before the first picture; give the browser two frames to show it.
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

/** Polls `window.tautline.analysis()` until `predicate` (run here, not in the page) accepts it; returns the analysis. */
export async function waitForAnalysis(page, predicate = (analysis) => analysis.current, { timeout = 15_000 } = {}) {
    const deadline = Date.now() + timeout;
    let analysis;
    for (;;) {
        analysis = await page.evaluate(() => window.tautline?.analysis());
        if (analysis && predicate(analysis)) return analysis;
        if (Date.now() > deadline) {
            throw new Error(`no such analysis within ${timeout} ms; the last one: ${JSON.stringify(analysis)?.slice(0, 500)}`);
        }
        await sleep(20);
    }
}

/** Takes a picture of what the window shows, keeps it as target/pictures/NAME.png and returns the PNG's bytes. */
export async function screenshot(page, name, options = {}) {
    mkdirSync(PICTURES, { recursive: true });
    const file = path.join(PICTURES, `${name.toLowerCase().replaceAll(/[^a-z0-9]+/g, "-")}.png`);
    return page.screenshot({ path: file, ...options });
}

/**
 * The colours in a PNG's bytes: how many there are, the most frequent one ("#rrggbb") and its share of
 * the picture. The browser decodes it, on a page of its own, so that the page under test stays as it is.
 */
export async function colours(page, png) {
    const blank = await page.context().newPage();
    try {
        return await blank.evaluate(async (base64) => {
            const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
            const picture = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
            const context = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
            context.drawImage(picture, 0, 0);
            const pixels = new Uint32Array(context.getImageData(0, 0, picture.width, picture.height).data.buffer);
            const counts = new Map();
            for (const pixel of pixels) counts.set(pixel, (counts.get(pixel) ?? 0) + 1);
            const [main, most] = [...counts].reduce((a, b) => (b[1] > a[1] ? b : a));
            const hex = [main, main >> 8, main >> 16].map((v) => (v & 255).toString(16).padStart(2, "0")).join("");
            return { count: counts.size, main: `#${hex}`, share: most / pixels.length };
        }, png.toString("base64"));
    } finally {
        await blank.close();
    }
}

/** What the command line prints for these arguments, with this on its standard input. */
export function runCommandLine(args, input = "") {
    const folder = process.env.CARGO_TARGET_DIR ?? `${ROOT}target`;
    const program = ["debug", "release"].map((profile) => `${folder}/${profile}/tautline`).find(existsSync);
    assert.ok(program, "no native program to compare with: run cargo build first");
    const { status, stdout, stderr, error } = spawnSync(program, args, { input, encoding: "utf8", maxBuffer: 1e8 });
    assert.notEqual(status, null, String(error));
    return { status, stdout, stderr };
}

/** What the command line says to a scenario. */
export function commandLine(scenario) {
    const { status, stdout, stderr } = runCommandLine(["analyze", "-", "--json"], JSON.stringify(scenario));
    assert.equal(status, 0, stderr);
    return JSON.parse(stdout);
}
