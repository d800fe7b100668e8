// What goes wrong outside the program (workers, graphics, storage) or in it: the page says so and nothing is lost.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { browserTest, PLATFORM, pointAt, press, screenshot, started, waitForAnalysis, waitForStart } from "./harness.mjs";

const scenario = (page) => page.evaluate(() => window.tautline.scenario());
const notice = (page) => page.locator("#tautline-notice").textContent();
const alert = (page) => page.locator("#tautline-error");

/** Loads the scenario on show with another gravity, and returns it. */
async function change(page, gravity) {
    const changed = { ...(await scenario(page)), gravity };
    await page.evaluate((json) => window.tautline.load(json), JSON.stringify(changed));
    return changed;
}

async function answers(page, gravity) {
    const { revision } = await waitForAnalysis(page, () => true);
    await change(page, gravity);
    const analysis = await waitForAnalysis(page, (a) => a.current && a.revision > revision, { timeout: 60_000 });
    assert.ok(analysis.critical.speed > 1, JSON.stringify(analysis.critical));
    return analysis;
}

browserTest("a computation that was killed is started again", async ({ open }) => {
    const page = await open();
    await started(page);
    const { critical: before } = await answers(page, 9.8);
    await page.workers()[0].evaluate(() => self.close()).catch(() => {});
    await answers(page, 9.7);
    assert.match(await notice(page), /lost .* started again/);
    const { critical } = await answers(page, 9.8);
    assert.deepEqual(critical, before, "as before the loss");
}, { timeout: 120_000 });

browserTest("a computation that does not answer is started again", async ({ open }) => {
    const page = await open();
    await started(page);
    page.workers()[0].evaluate(() => { for (;;); }).catch(() => {});
    await answers(page, 9.7);
    assert.match(await notice(page), /does not answer.* started again/);
}, { timeout: 120_000 });

browserTest("a computation that cannot start is told, and tried again when the robot changes", async ({ open }) => {
    let refused = true;
    const page = await open("", {
        before: (page) => page.context().route(/worker_bg\.wasm$/, (route) => refused ? route.abort() : route.continue()),
    });
    await waitForStart(page);
    await page.waitForFunction(() => /does not run/.test(document.getElementById("tautline-summary").textContent));
    await screenshot(page, "no worker");
    refused = false;
    await change(page, 9.7);
    await waitForAnalysis(page, (analysis) => analysis.current, { timeout: 60_000 });
}, { timeout: 120_000, allow: [/worker_bg\.wasm/, /Failed to fetch/, /ERR_FAILED/, /worker\.js/, /worker_loader\.js/] });

browserTest("graphics that were taken away come back with the robot, also where nothing may be stored", async ({ open }) => {
    for (const blocked of [false, true]) {
        const page = await open("", {
            before: (page) => page.addInitScript((blocked) => {
                if (blocked) Object.defineProperty(window, "localStorage", { get() { throw new DOMException("blocked", "SecurityError"); } });
            }, blocked),
        });
        await started(page);
        const changed = await change(page, 9.5);
        await waitForAnalysis(page, (analysis) => analysis.current);
        await page.evaluate(() => {
            window.loses = document.getElementById("tautline-canvas").getContext("webgl2").getExtension("WEBGL_lose_context");
            window.loses.loseContext();
        });
        await alert(page).waitFor({ state: "visible" });
        assert.match(await alert(page).innerText(), /picture is gone/);
        await screenshot(page, "graphics gone");
        const reloaded = page.waitForEvent("load");
        await page.evaluate(() => window.loses.restoreContext());
        await reloaded;
        await started(page);
        assert.equal(await alert(page).isVisible(), false);
        assert.deepEqual(await scenario(page), changed);
    }
}, { timeout: 120_000 });

browserTest("a storage that takes nothing is told, and the app works", async ({ open }) => {
    const page = await open("", {
        before: (page) => page.addInitScript(() => {
            Storage.prototype.setItem = () => { throw new DOMException("full", "QuotaExceededError"); };
        }),
    });
    await started(page);
    await page.waitForFunction(() => /not kept/.test(document.getElementById("tautline-notice").textContent));
    await screenshot(page, "nothing kept");
    await answers(page, 9.7);
}, { timeout: 120_000 });

for (const colorScheme of ["light", "dark"]) {
    browserTest(`a program that stopped hands the robot over, ${colorScheme}`, async ({ open }) => {
        const page = await open("", { colorScheme });
        await started(page);
        const changed = await change(page, 9.5);
        await waitForAnalysis(page, (analysis) => analysis.current);
        // The drawing library panics where the graphics card has no room left.
        await page.evaluate(() => { WebGL2RenderingContext.prototype.createTexture = () => null; });
        await press(page, "More", "button");
        // Nothing answers after that.
        const { mouse, at } = await pointAt(page, "Theory");
        await mouse.click(...at);
        await alert(page).waitFor({ state: "visible" });
        assert.match(await alert(page).innerText(), /has stopped[^]*not lost/);
        await screenshot(page, `stopped ${colorScheme}`);
        const [saved] = await Promise.all([page.waitForEvent("download"), page.getByText("Save the robot as a file").click()]);
        assert.deepEqual(JSON.parse(await readFile(await saved.path(), "utf8")), changed);
        const reloaded = page.waitForEvent("load");
        await page.getByText("Restart with this robot").click();
        await reloaded;
        await started(page);
        assert.deepEqual(await scenario(page), changed);
        // It comes back once, not at every load.
        assert.equal(await page.evaluate(() => history.state), null);
    }, { timeout: 120_000, allow: [/panicked/, /unreachable/, /RuntimeError/] });
}

browserTest("the robot is safe in the middle of a drag", async ({ open }) => {
    const page = await open();
    await started(page);
    const { at: [x, y] } = await pointAt(page, ...PLATFORM);
    await page.mouse.down();
    for (let i = 1; i <= 10; i++) await page.mouse.move(x + 6 * i, y - 3 * i);
    await page.waitForFunction(() => window.tautline.scenario().motion.position[0] > 2);
    await page.waitForTimeout(500);
    const dragged = await scenario(page);
    // The tab ends without a word.
    const session = await page.context().newCDPSession(page);
    const crashed = page.waitForEvent("crash");
    session.send("Page.crash").catch(() => {});
    await crashed;
    const again = await page.context().newPage();
    await again.goto(page.url());
    await started(again);
    assert.deepEqual(await scenario(again), dragged);
}, { timeout: 120_000 });

browserTest("nothing from a file or a link becomes part of the page, and nothing leaves it", async ({ open, origin }) => {
    const page = await open("", { permissions: ["clipboard-read", "clipboard-write"] });
    await started(page);
    // The lines for screen readers come and go with what is known; whatever else they had in them would count.
    const elements = () => page.evaluate(() => document.querySelectorAll("body *:not(#tautline-details > li)").length);
    const name = `<img src=x onerror="window.taken=1"><script>window.taken=1</script>`;
    const evil = { ...(await scenario(page)), name };
    const before = await elements();
    await page.evaluate((json) => window.tautline.load(json), JSON.stringify(evil));
    await waitForAnalysis(page, (analysis) => analysis.current);
    await page.evaluate(() => { location.hash = `#s=<img src=x onerror="window.taken=1">`; });
    await page.waitForFunction(() => document.getElementById("tautline-notice").textContent !== "");
    await page.waitForTimeout(300);
    assert.equal((await scenario(page)).name, name);
    assert.deepEqual([await elements(), await page.evaluate(() => window.taken)], [before, undefined]);
    assert.equal(await page.locator("img, body script").count(), 0);

    // What the page's policy forbids.
    const policy = await page.evaluate(async () => {
        const violations = [];
        // From here on the browser takes this for the page's own code, which the policy is for.
        await new Promise((done) => setTimeout(done));
        addEventListener("securitypolicyviolation", (event) => violations.push(event.effectiveDirective));
        const added = document.createElement("script");
        added.textContent = "window.taken = 2";
        document.body.append(added);
        const styled = document.createElement("style");
        document.head.append(styled);
        styled.textContent = "body { color: red }";
        await fetch("http://127.0.0.1:9/").catch(() => {});
        let evaluated = true;
        try { new Function("return 1")(); } catch { evaluated = false; }
        await new Promise((done) => setTimeout(done, 100));
        return { violations, evaluated, taken: window.taken };
    });
    assert.deepEqual([policy.evaluated, policy.taken], [false, undefined]);
    for (const directive of ["script-src-elem", "style-src-elem", "connect-src", "script-src"]) {
        assert.ok(policy.violations.includes(directive), `${directive}: ${policy.violations}`);
    }
    assert.ok(page.url().startsWith(origin));
}, { timeout: 120_000, allow: [/Content Security Policy/, /violates the following/, /127\.0\.0\.1:9\//] });

browserTest("a program that is no program gets an explanation", async ({ open }) => {
    const page = await open("", {
        before: (page) => page.route(/tautline.*\.wasm$/, (route) => route.fulfill({ body: "no program", contentType: "application/wasm" })),
    });
    await alert(page).waitFor({ state: "visible" });
    assert.match(await alert(page).innerText(), /could not be loaded/);
}, { allow: [/./] });

browserTest("a map goes on when the worker of the pointer is lost", async ({ open }) => {
    const page = await open();
    await started(page);
    await page.workers()[0].evaluate(() => self.close()).catch(() => {});
    await press(page, "Map", "button");
    await page.waitForFunction(() => window.tautline.studies().map.finished, undefined, { timeout: 60_000, polling: 200 });
}, { timeout: 120_000 });
