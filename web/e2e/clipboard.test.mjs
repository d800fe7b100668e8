// Sharing where the browser does not let the page write to the clipboard, and pages in a frame.
import assert from "node:assert/strict";
import { browserTest, choose, clickCanvas, framed, screenshot, started } from "./harness.mjs";

/** Copies a link to the robot. */
const share = (page) => choose(page, "Share", "Copy link");
/** An app in a frame below a field that has the focus. */
const FRAME = { before: "<input autofocus>", width: 1240, height: 740 };
/** In the window that says why. */
const copying = (page) => page.locator("#tautline-copy");
const notice = (page) => page.locator("#tautline-notice").textContent();

/** The link is shown and selected, it is said why, and nobody says that it is on the clipboard. Gives the link. */
async function offered(page, why) {
    await copying(page).waitFor({ state: "visible" });
    assert.match(await copying(page).locator("p").textContent(), why);
    const [link, selected] = await page.locator("#tautline-copy-text").evaluate((field) => [
        field.value, field === document.activeElement && field.value.slice(field.selectionStart, field.selectionEnd),
    ]);
    assert.match(link, /^http.*#s=1/);
    assert.equal(selected, link);
    assert.doesNotMatch(await notice(page), /clipboard/);
    return link;
}

/** What the user says to a request of the page. */
async function decide(page, name, setting) {
    const session = await page.context().newCDPSession(page);
    const { targetInfo: { browserContextId } } = await session.send("Target.getTargetInfo");
    await session.send("Browser.setPermission", { permission: { name }, setting, origin: new URL(page.url()).origin, browserContextId });
}

browserTest("over plain http, where browsers have no clipboard, the link is shown to be copied by hand", async ({ open, origin }) => {
    const page = await open(origin.replace("127.0.0.1", "tautline.test"));
    await started(page);
    assert.equal(await page.evaluate(() => [isSecureContext, typeof navigator.clipboard].join()), "false,undefined");
    await share(page);
    const link = await offered(page, /https/);
    await screenshot(page, "copy by hand");
    const other = await open("", { hash: new URL(link).hash });
    await started(other);
    assert.deepEqual(await other.evaluate(() => window.tautline.scenario()), await page.evaluate(() => window.tautline.scenario()));
    // It goes by key and by its button, and the app is there again.
    for (const leave of [() => page.keyboard.press("Escape"), () => page.locator("#tautline-copy-close").click()]) {
        await leave();
        await copying(page).waitFor({ state: "hidden" });
        await share(page);
        await offered(page, /https/);
    }
}, { timeout: 120_000 });

browserTest("where the user has forbidden the clipboard, that is told, and the window follows the theme", async ({ open }) => {
    const page = await open("", { colorScheme: "dark" });
    await started(page);
    await decide(page, "clipboard-write", "denied");
    await share(page);
    await offered(page, /does not allow it here \(Write permission denied\)/);
    await screenshot(page, "copy by hand dark");
    // Allowed after all, it is told once it is true.
    await page.keyboard.press("Escape");
    await decide(page, "clipboard-write", "granted");
    await share(page);
    await page.waitForFunction(() => document.getElementById("tautline-notice").textContent.includes("The link is on the clipboard"));
    assert.equal(await copying(page).isVisible(), false);
}, { timeout: 120_000 });

browserTest("in a frame of another origin the link can be copied by hand", async ({ open, origin }) => {
    const { page, frame, close } = await framed(open, origin, FRAME);
    try {
        await decide(page, "clipboard-read", "granted");
        await share(frame);
        const link = await offered(frame, /policy|allow/i);
        await page.keyboard.press("Control+c");
        await page.locator("input").click();
        assert.equal(await page.evaluate(() => navigator.clipboard.readText()), link);
        // A page that allows it gets the link at once.
        const allowed = await framed(open, origin, { ...FRAME, attributes: 'allow="clipboard-write"' });
        await share(allowed.frame);
        await allowed.frame.waitForFunction(() => document.getElementById("tautline-notice").textContent.includes("The link is on the clipboard"));
        await allowed.close();
    } finally {
        await close();
    }
}, { timeout: 180_000, allow: [/permissions policy/i] });

browserTest("in a frame the page leaves the focus where it is until it is clicked", async ({ open, origin }) => {
    for (const address of [origin, origin.replace("127.0.0.1", "localhost")]) {
        const { page, frame, close } = await framed(open, address, FRAME);
        try {
            assert.equal(await page.evaluate(() => document.activeElement.tagName), "INPUT", address);
            await page.keyboard.type("typed elsewhere");
            assert.equal(await page.locator("input").inputValue(), "typed elsewhere");
            await frame.evaluate(() => window.tautline.load({ ...window.tautline.scenario(), gravity: 1.62 }));
            await frame.waitForFunction(() => window.tautline.scenario().gravity === 1.62);
            // The background of the canvas, well beside the platform.
            await clickCanvas(frame);
            await page.keyboard.press("Control+z");
            await frame.waitForFunction(() => window.tautline.scenario().gravity === 9.81);
        } finally {
            await close();
        }
    }
}, { timeout: 180_000 });
