// The page starts, and says so plainly where it cannot.
import assert from "node:assert/strict";
import { browserTest, colours, screenshot, waitForAnalysis, waitForStart } from "./harness.mjs";

for (const colorScheme of ["light", "dark"]) {
    browserTest(`the app draws on the canvas (${colorScheme})`, async ({ open }) => {
        const page = await open("", { colorScheme });
        await waitForStart(page);
        // The first pictures may be a background only, while the fonts are being made.
        let count = 0;
        for (let i = 0; i < 20 && count <= 10; i++) {
            ({ count } = await colours(page, await screenshot(page, `start ${colorScheme}`)));
        }
        assert.ok(count > 10, `a blank picture: ${count} colours`);
        assert.equal(await page.locator("#tautline-loading").isVisible(), false);
        assert.equal(await page.locator("#tautline-error").isVisible(), false);
    });
}

browserTest("how long a start takes is recorded", async ({ open }) => {
    const begun = Date.now();
    const page = await open();
    await waitForStart(page);
    const picture = Date.now() - begun;
    const { critical } = await waitForAnalysis(page, (analysis) => analysis.current, { timeout: 30_000 });
    console.log(`start: first picture after ${picture} ms, first answer after ${Date.now() - begun} ms`);
    assert.ok(critical.speed > 11, JSON.stringify(critical));
});

browserTest("the canvas fills a narrow window without scroll bars", async ({ open }) => {
    const page = await open("", { viewport: { width: 360, height: 640 } });
    await waitForStart(page);
    assert.deepEqual(await page.locator("#tautline-canvas").boundingBox(), { x: 0, y: 0, width: 360, height: 640 });
    const overflow = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.scrollHeight]);
    assert.deepEqual(overflow, [360, 640]);
});

browserTest("the worker says something once it is ready", async ({ open }) => {
    const page = await open();
    const message = await page.evaluate(() => new Promise((resolve, reject) => {
        const worker = new Worker(document.getElementById("tautline-app").dataset.worker);
        worker.onmessage = (event) => resolve(event.data);
        worker.onerror = (event) => reject(new Error(event.message));
    }));
    assert.ok(message);
});

async function failure(page) {
    const alert = page.locator("#tautline-error");
    await alert.waitFor({ state: "visible" });
    assert.equal(await page.locator("#tautline-loading").isVisible(), false);
    return alert.innerText();
}

browserTest("a browser without WebGL 2 gets an explanation", async ({ open }) => {
    const page = await open("", {
        before: (page) => page.addInitScript(() => {
            const getContext = HTMLCanvasElement.prototype.getContext;
            HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
                return kind === "webgl2" ? null : getContext.call(this, kind, ...rest);
            };
        }),
    });
    assert.match(await failure(page), /WebGL 2/);
    await screenshot(page, "no webgl");
});

browserTest("a browser without WebAssembly gets an explanation", async ({ open }) => {
    const page = await open("", { before: (page) => page.addInitScript(() => { delete window.WebAssembly; }) });
    assert.match(await failure(page), /WebAssembly/);
});

browserTest("a download that fails gets an explanation", async ({ open }) => {
    const page = await open("", { before: (page) => page.route(/tautline.*\.wasm$/, (route) => route.abort()) });
    assert.match(await failure(page), /could not be loaded/);
}, { allow: [/^failed: .*\.wasm/, /ERR_FAILED/] });

browserTest("a program that stops says so, and nothing else does", async ({ open }) => {
    const page = await open();
    await waitForStart(page);
    await page.evaluate(() => dispatchEvent(new ErrorEvent("error", { error: new Error("an extension's own trouble") })));
    assert.equal(await page.locator("#tautline-error").isVisible(), false);
    await page.evaluate(() => dispatchEvent(new ErrorEvent("error", { error: new WebAssembly.RuntimeError("unreachable") })));
    assert.match(await failure(page), /has stopped/);
});
