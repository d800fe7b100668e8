// What the browser tests share: a server for the page (and the npm package), a browser, and a test that fails on any
// error on the page.
//
//   browserTest("what it shows", async ({ open }) => {
//       const page = await open("", { viewport: { width: 360, height: 640 }, colorScheme: "dark" });
//       await started(page);
//       await press(page, "Map", "button");
//       await type(page, "Speed v", "7");
//       …
//   });
//
// Things are found by the names and roles that window.tautline.layout() gives, never by pixel places.
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

/** The groups of plots with the titles in them; a plot's tab is there once its group is chosen. */
export const PLOTS = {
    "Flight": ["Deviation", "Tensions", "Gain", "Speed on the path"],
    "This pose": ["Eigenvalues", "Modes", "Growth"],
    "Workspace": ["Along the line", "Directions"],
    "Model": ["Speed diagram", "What to change", "What if", "Mesh error"],
};

/** The group of controls that a field is in, where it is not one that is open at first. */
const SECTIONS = {
    "Young's modulus E": "Rope",
    "Cross-section A": "Rope",
    "Platform mass m": "Mass and gravity",
    "Gravity g": "Mass and gravity",
};

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
 * its pages showed is in target/pictures/. `skip` is the reason why it is not run.
 */
export function browserTest(name, body, { allow = [], timeout = 60_000, site = SITES.page, skip = false } = {}) {
    test(name, { timeout, skip }, async () => {
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

/** Waits until the app runs and its first answer is there. */
export async function started(page, { timeout = 60_000 } = {}) {
    await waitForStart(page);
    return waitForAnalysis(page, (analysis) => analysis.current, { timeout });
}

/** What is on the screen: { label, role, rect: [x, y, width, height], value?, enabled?, whole? } of each named thing. */
export const layout = (page) => page.evaluate(() => window.tautline.layout());

/** Roles of things that hold others or only stand there. Who asks for a name alone does not mean these. */
const QUIET = new Set(["text", "region", "dialog", "img", "figure", "row", "table", "group", "tablist", "tooltip"]);

export const centre = ({ rect: [x, y, width, height] }) => [x + width / 2, y + height / 2];
export const inside = ([x, y], { rect: [left, top, width, height] }) =>
    x >= left && x <= left + width && y >= top && y <= top + height;

const fits = (text, wanted) => (wanted instanceof RegExp ? wanted.test(text) : text === wanted);

/** Those of `items` with this label and role (texts or regular expressions), in the region of this name. */
export function matching(items, label, role, within) {
    const regions = within === undefined ? [] : items.filter((it) => it.role === "region" && fits(it.label, within));
    const found = items.filter((it) => fits(it.label, label) && (role === undefined || fits(it.role, role))
        && (within === undefined || regions.some((region) => inside(centre(it), region))));
    const loud = found.filter((it) => !QUIET.has(it.role));
    return role === undefined && loud.length > 0 ? loud : found;
}

/** All that is there, by roles, for messages. */
function inventory(items) {
    const byRole = new Map();
    for (const { role, label } of items.filter(({ role }) => role !== "text")) {
        byRole.set(role, [...(byRole.get(role) ?? []), label]);
    }
    return [...byRole].map(([role, labels]) => `    ${role}: ${labels.join(" | ")}`).join("\n");
}

const called = (label, role, within) => `${role ?? "thing"} called ${label instanceof RegExp ? label : `"${label}"`}` +
    (within === undefined ? "" : ` in "${within}"`);

/** Waits until one thing with this label and role is on the screen and rests there; returns it. */
export async function find(page, label, role, { within, timeout = 15_000 } = {}) {
    const deadline = Date.now() + timeout;
    let before;
    for (let looks = 0; ; looks++) {
        const items = await layout(page);
        const found = matching(items, label, role, within);
        if (found.length === 1) {
            // What slides in is pressed where it ends. What always moves is taken as it is.
            if (looks > 20 || before?.every((edge, i) => Math.abs(edge - found[0].rect[i]) < 1)) return found[0];
            before = found[0].rect;
        }
        if (Date.now() > deadline) {
            const many = found.map((it) => `${it.role} at ${it.rect}`).join("; ");
            throw new Error(`${found.length === 0 ? "no" : `${found.length} times a`} ${called(label, role, within)} ` +
                `on the screen after ${timeout} ms${many && ` (${many})`}. There are:\n${inventory(items)}`);
        }
        await sleep(50);
    }
}

/** Whether it is on the screen now. */
export async function isThere(page, label, role, { within } = {}) {
    return matching(await layout(page), label, role, within).length > 0;
}

/** Waits until nothing with this label and role is on the screen. */
export async function gone(page, label, role, { within, timeout = 15_000 } = {}) {
    for (const deadline = Date.now() + timeout; await isThere(page, label, role, { within }); await sleep(50)) {
        if (Date.now() > deadline) throw new Error(`there is still a ${called(label, role, within)} after ${timeout} ms`);
    }
}

/** Waits until what it is set to is accepted; returns that. */
export async function valueOf(page, label, role, accept = () => true, { within, timeout = 15_000 } = {}) {
    for (const deadline = Date.now() + timeout; ; await sleep(50)) {
        const { value } = await find(page, label, role, { within, timeout });
        if (accept(value)) return value;
        if (Date.now() > deadline) throw new Error(`the ${called(label, role, within)} has the value ${JSON.stringify(value)}`);
    }
}

/** The mouse and keyboard of a page; of a frame in a page those of the page, with where the frame's corner is. */
async function hand(page) {
    if (page.mouse) return { mouse: page.mouse, keyboard: page.keyboard, corner: [0, 0] };
    const element = await page.frameElement();
    const { x, y } = await element.boundingBox();
    const [left, top] = await element.evaluate((frame) => [frame.clientLeft, frame.clientTop]);
    return { mouse: page.page().mouse, keyboard: page.page().keyboard, corner: [x + left, y + top] };
}

const twoFrames = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/** Where the middle of it is for the mouse, which has been moved there. */
export async function pointAt(page, label, role, options) {
    const item = await find(page, label, role, options);
    assert.notEqual(item.enabled, false, `the ${called(label, role)} cannot be used now`);
    const { mouse, keyboard, corner } = await hand(page);
    const at = centre(item).map((edge, i) => edge + corner[i]);
    await mouse.move(...at);
    return { item, mouse, keyboard, at };
}

/** Clicks on it. */
export async function press(page, label, role, options) {
    const { mouse, at } = await pointAt(page, label, role, options);
    await mouse.click(...at);
    await twoFrames(page);
}

/** Clicks on an entry of a menu, which a button of this name opens. */
export async function choose(page, menu, entry) {
    await press(page, menu, "button");
    await press(page, entry);
}

/** Drags it by so many pixels, does `beforeRelease` where the pointer is then, and lets go. */
export async function dragTo(page, label, dx, dy, { role, within, steps = 10, pause = 20, beforeRelease = () => {} } = {}) {
    const { mouse, at: [x, y] } = await pointAt(page, label, role, { within });
    await mouse.down();
    for (let i = 1; i <= steps; i++) {
        await mouse.move(x + (dx * i) / steps, y + (dy * i) / steps);
        await sleep(pause);
    }
    await beforeRelease([x + dx, y + dy]);
    await mouse.up();
    await twoFrames(page);
}

/** The handle of the platform, for `find` and all that follow; a group of controls has the same name. */
export const PLATFORM = ["Platform", "button", { within: "Canvas" }];

/** Drags the platform. */
export const dragPlatform = (page, dx, dy, options = {}) =>
    dragTo(page, "Platform", dx, dy, { role: "button", within: "Canvas", ...options });

/** Clicks on the canvas where there is nothing, so that keys are for the app. */
export async function clickCanvas(page) {
    const { mouse, at: [x, y] } = await pointAt(page, ...PLATFORM);
    await mouse.click(x + 30, y + 50);
}

/** Puts the text in the place of what stands in the field. `enter` is the key that ends it. */
export async function type(page, label, text, { role = /^(spinbutton|textbox)$/, within, enter = "Enter" } = {}) {
    await reveal(page, label, role, { within });
    const { mouse, keyboard, at } = await pointAt(page, label, role, { within });
    await mouse.click(...at);
    await keyboard.press("ControlOrMeta+A");
    await keyboard.type(text);
    if (enter) await keyboard.press(enter);
}

/** Opens the group of controls that it is in and scrolls until it is there. */
export async function reveal(page, label, role, { within = /^(Controls|Sheet)$/ } = {}) {
    if (await isThere(page, label, role)) return;
    const section = SECTIONS[label];
    if (section && await isThere(page, section, "button", { within })) await press(page, section, "button", { within });
    for (let turns = 0; turns < 20 && !await isThere(page, label, role); turns++) {
        const { mouse } = await pointAt(page, within, "region");
        await mouse.wheel(0, 150);
        await sleep(150);
    }
}

/** Shows a plot in the column on the right, or where else a window of this size has its plots. */
export async function openPlot(page, title, { within = /^(Plots|Dock|Sheet)$/ } = {}) {
    const items = await layout(page);
    const place = ["Plots", "Sheet", "Dock"].find((name) => fits(name, within) && matching(items, name, "region").length > 0);
    const [group] = Object.entries(PLOTS).find(([, titles]) => titles.includes(title)) ?? [];
    if (!await isThere(page, title, "tab", { within: place })) {
        // The groups are a switch, or a list where it is narrow.
        if (await isThere(page, "Plot group", "combobox", { within: place })) {
            await press(page, "Plot group", "combobox", { within: place });
            await press(page, group, "button");
        } else {
            await press(page, group, undefined, { within: place });
        }
    }
    await press(page, title, "tab", { within: place });
    return place;
}

/** Pixels per metre of the canvas, measured by the platform in two places; the robot is then where it was. */
export async function pixelsPerMetre(page) {
    const scenario = await page.evaluate(() => window.tautline.scenario());
    const across = async (x) => {
        const motion = { ...scenario.motion, position: [x, scenario.motion.position[1]] };
        await page.evaluate((json) => window.tautline.load(json), JSON.stringify({ ...scenario, motion }));
        await waitForAnalysis(page, (analysis) => analysis.current, { timeout: 30_000 });
        return centre(await find(page, ...PLATFORM))[0];
    };
    const [left, right] = [await across(0), await across(2)];
    await across(scenario.motion.position[0]);
    return (right - left) / 2;
}

/** A page on a server of its own, with this in its body. */
export async function host(body, name = "localhost") {
    const html = `<!doctype html><meta charset="utf-8"><title>Host</title><body>${body}`;
    const server = createServer((request, response) => response.writeHead(200, { "content-type": "text/html" }).end(html));
    await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
    const close = () => new Promise((resolve) => {
        server.close(resolve);
        server.closeAllConnections();
    });
    return { address: `http://${name}:${server.address().port}/`, close };
}

/**
 * Opens such a page with the app in a frame of this size, between what stands `before` and `after` it. Gives the page, the
 * frame once the app runs in it, and what closes the server.
 */
export async function framed(open, source, { attributes = "", width = 600, height = 400, before = "", after = "", name, options } = {}) {
    const frame = `<iframe src="${source}" ${attributes} style="display: block; width: ${width}px; height: ${height}px"></iframe>`;
    const { address, close } = await host(`${before}${frame}${after}`, name);
    const page = await open(address, options);
    return { page, frame: await frameOf(page, source), close };
}

/** The frame of a page with this address, once the app runs in it. */
export async function frameOf(page, source) {
    const start = source.split("#")[0];
    const deadline = Date.now() + 15_000;
    for (;;) {
        const frame = page.frames().find((frame) => frame !== page.mainFrame() && frame.url().startsWith(start));
        if (frame) {
            await started(frame);
            return frame;
        }
        if (Date.now() > deadline) throw new Error(`no frame with ${start}: ${page.frames().map((frame) => frame.url())}`);
        await sleep(50);
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
