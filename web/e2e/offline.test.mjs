// The page without a network, and from one build to the next.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, mkdtempSync, readdirSync, readFileSync, renameSync, rmSync, rmdirSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, test } from "node:test";
import { setTimeout as sleep } from "node:timers/promises";
import { fileURLToPath } from "node:url";
import { browserTest, DIST, press, publish, waitForAnalysis, waitForStart } from "./harness.mjs";

const SCRIPT = fileURLToPath(new URL("../offline.sh", import.meta.url));
const PATIENT = { timeout: 300_000 };
// Nobody answers, or a page is left while its workers load: what these tests are about.
const ALLOW = [/ERR_CONNECTION_REFUSED/, /ERR_INTERNET_DISCONNECTED/, /ERR_ABORTED/];

const folders = [];
const sites = [];
after(async () => {
    for (const site of sites) await site.stop();
    for (const folder of folders) rmSync(folder, { recursive: true });
});

/** A copy of dist/ as Trunk would build it from a page with another title; its build has another name. */
function renewed() {
    const folder = mkdtempSync(path.join(tmpdir(), "tautline-"));
    folders.push(folder);
    cpSync(DIST, folder, { recursive: true });
    // What offline.sh is given: the files side by side.
    const build = readdirSync(folder).find((name) => name.startsWith("build-"));
    for (const name of readdirSync(path.join(folder, build))) renameSync(path.join(folder, build, name), path.join(folder, name));
    rmdirSync(path.join(folder, build));
    for (const name of ["index.html", "text.html"]) {
        const page = path.join(folder, name);
        const html = readFileSync(page, "utf8").replaceAll(`./${build}/`, "./");
        writeFileSync(page, html.replace("<title>Tautline</title>", "<title>Tautline renewed</title>"));
    }
    execFileSync("bash", [SCRIPT], { env: { ...process.env, TRUNK_STAGING_DIR: folder } });
    return folder;
}

test("the page's programs have no names of functions, a tenth of what it would load", async () => {
    const programs = readdirSync(DIST, { recursive: true }).filter((name) => name.endsWith(".wasm"));
    assert.equal(programs.length, 2);
    for (const name of programs) {
        const program = await WebAssembly.compile(readFileSync(path.join(DIST, name)));
        assert.equal(WebAssembly.Module.customSections(program, "name").length, 0, name);
    }
});

async function published() {
    const site = await publish(DIST);
    sites.push(site);
    return site;
}

async function until(what, predicate, timeout = 60_000) {
    for (const deadline = Date.now() + timeout; !await predicate(); await sleep(100)) {
        assert.ok(Date.now() < deadline, `not within ${timeout} ms: ${what}`);
    }
}

/** How far the service worker's versions are: the one being installed, the one that waits, the active one. */
const versions = (page) => page.evaluate(async () => {
    const { installing, waiting, active } = await navigator.serviceWorker.getRegistration() ?? {};
    return [installing, waiting, active].map((worker) => worker?.state ?? "none");
});
const firstKept = (page) => until("the first build is kept and serves the page", () => page.evaluate(
    () => navigator.serviceWorker.controller?.state === "activated"));
const updateKept = (page) => until("the new build is kept", async () => (await versions(page))[1] === "installed");

/** The app runs, gives the paper's critical speed and has the title behind the robot's name; all is of one build. */
async function works(page, title) {
    await waitForStart(page, { timeout: 60_000 });
    const { critical } = await waitForAnalysis(page, (analysis) => analysis.current, { timeout: 60_000 });
    assert.ok(Math.abs(critical.speed - 11.299) < 1e-3, `critical speed ${critical.speed}`);
    assert.equal(await page.title(), `Paper robot – ${title}`);
    await isOfOneBuild(page);
}

async function isOfOneBuild(page) {
    const { worker, loaded } = await page.evaluate(() => ({
        worker: document.getElementById("tautline-app").dataset.worker,
        loaded: performance.getEntriesByType("resource").map(({ name }) => name),
    }));
    const addresses = [...loaded, ...page.workers().map((worker) => worker.url())];
    const builds = new Set(addresses.flatMap((address) => address.match(/build-[0-9a-f]+/) ?? []));
    assert.deepEqual([...builds], [worker.split("/")[1]], addresses.join("\n"));
}

/** The page starts workers and computes a map with them. */
async function maps(page) {
    // The first worker is the one that follows the pointer; the others are the pool's, which replaces those it loses.
    const before = page.workers();
    for (const worker of before.slice(1)) await worker.evaluate(() => self.close()).catch(() => {});
    await press(page, "Map", "button");
    await until("places of the map are done", () => page.evaluate(() => window.tautline.studies().map.done > 20), 90_000);
    assert.ok(page.workers().some((worker) => !before.includes(worker)), "there are new workers");
    await isOfOneBuild(page);
}

browserTest("after one visit the app starts and maps without a network", async ({ open }) => {
    const site = await published();
    const page = await open(site.address, { serviceWorkers: "allow" });
    await works(page, "Tautline");
    await firstKept(page);

    site.refuse = () => new Promise(() => {});
    await page.reload();
    await works(page, "Tautline");

    await site.stop();
    await page.context().setOffline(true);
    await page.reload();
    await works(page, "Tautline");
    await maps(page);
    await page.goto(`${site.address}index.html?from=elsewhere#s=`);
    await works(page, "Tautline");

    // Back on the network nothing hides that the site has gone, or what else is published below it.
    await page.context().setOffline(false);
    site.refuse = () => false;
    site.folder = path.join(DIST, "icons");
    await site.start();
    assert.equal((await page.goto(`${site.address}another.html`)).status(), 404);
    assert.equal((await page.goto(site.address)).status(), 404);
}, { ...PATIENT, allow: [...ALLOW, /404/] });

browserTest("a new build shows at the next load, and pages of the old one go on", async ({ open }) => {
    const site = await published();
    const old = await open(site.address, { serviceWorkers: "allow" });
    await works(old, "Tautline");
    await firstKept(old);

    site.folder = renewed();
    const page = await old.context().newPage();
    await page.goto(site.address);
    await works(page, "Tautline renewed");
    await updateKept(page);
    // The server has the old build's workers no longer.
    await maps(old);
    await site.stop();
    await page.reload();
    await works(page, "Tautline renewed");

    // Once nobody needs it the old build is deleted.
    await old.close();
    await until("one build is left", async () => {
        await page.goto("about:blank");
        await sleep(1000); // the browser takes a moment to see that the page has gone
        await page.goto(site.address);
        return page.evaluate(async () => (await caches.keys()).length === 1);
    });
    await works(page, "Tautline renewed");
}, { ...PATIENT, allow: ALLOW });

browserTest("an update that fails half-way changes nothing", async ({ open }) => {
    const site = await published();
    const page = await open(site.address, { serviceWorkers: "allow" });
    await works(page, "Tautline");
    await firstKept(page);

    site.folder = renewed();
    let refused = 0;
    // The service worker's request, not the page's.
    site.refuse = ({ url, headers }) => url.endsWith("worker_bg.wasm") && headers.referer?.endsWith("/sw.js") && ++refused;
    await page.reload();
    await works(page, "Tautline renewed");
    await until("the install has failed", async () => refused && (await versions(page))[0] === "none");
    assert.deepEqual(await versions(page), ["none", "none", "activated"]);
    await site.stop();
    await page.reload();
    await works(page, "Tautline");

    await site.start();
    site.refuse = () => false;
    await page.reload();
    await works(page, "Tautline renewed");
    await updateKept(page);
    await site.stop();
    await page.reload();
    await works(page, "Tautline renewed");
}, { ...PATIENT, allow: ALLOW });

browserTest("a file that is not what was built is not kept", async ({ open }) => {
    const site = await published();
    const folder = renewed();
    const build = readdirSync(folder).find((name) => name.startsWith("build-"));
    writeFileSync(path.join(folder, build, "worker_loader.js"), "// half an upl");
    site.folder = folder;
    const page = await open(site.address, { serviceWorkers: "allow" });
    await waitForStart(page, { timeout: 60_000 });
    await until("the install has failed", () => page.evaluate(async () => !await navigator.serviceWorker.getRegistration()));
    assert.deepEqual(await page.evaluate(async () => {
        const counts = [];
        for (const name of await caches.keys()) counts.push((await (await caches.open(name)).keys()).length);
        return counts;
    }), [0]);
}, PATIENT);

browserTest("a browser without service workers runs the app", async ({ open }) => {
    const page = await open("", {
        before: (page) => page.addInitScript(() => Object.defineProperty(navigator, "serviceWorker", { value: undefined })),
    });
    await works(page, "Tautline");
}, PATIENT);

browserTest("the manifest tells how to install the app", async ({ open }) => {
    const page = await open();
    const manifest = await page.evaluate(async () => {
        const { href } = document.querySelector("link[rel=manifest]");
        const manifest = await (await fetch(href)).json();
        const link = document.querySelector("link[rel=apple-touch-icon]");
        const icons = [...manifest.icons, { src: link.getAttribute("href"), sizes: "180x180", type: "image/png" }];
        for (const icon of icons) {
            const response = await fetch(new URL(icon.src, href));
            icon.served = response.headers.get("content-type");
            if (icon.type !== "image/png") continue;
            const { width, height } = await createImageBitmap(await response.blob());
            icon.measured = `${width}x${height}`;
        }
        const resolve = (address) => new URL(address, href).href;
        return { ...manifest, icons, start: resolve(manifest.start_url), scope: resolve(manifest.scope) };
    });
    assert.equal(manifest.name, "Tautline");
    assert.equal(manifest.short_name, "Tautline");
    assert.equal(manifest.display, "standalone");
    assert.match(manifest.theme_color + manifest.background_color, /^(#[0-9a-f]{6}){2}$/);
    assert.deepEqual([manifest.start, manifest.scope], [page.url(), page.url()]);
    for (const icon of manifest.icons) {
        assert.equal(icon.served, icon.type, icon.src);
        if (icon.sizes !== "any") assert.equal(icon.measured, icon.sizes, icon.src);
    }
    const some = (test) => assert.ok(manifest.icons.some(test), test.toString());
    some((icon) => icon.sizes === "any");
    some((icon) => icon.sizes === "192x192");
    some((icon) => icon.sizes === "512x512" && !icon.purpose);
    some((icon) => icon.sizes === "512x512" && icon.purpose === "maskable");
    const session = await page.context().newCDPSession(page);
    const { errors } = await session.send("Page.getAppManifest");
    assert.deepEqual(errors, []);
}, PATIENT);
