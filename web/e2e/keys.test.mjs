// Without eyes or mouse: keys go everywhere and out again, what has the focus is told, and results are told once.
import assert from "node:assert/strict";
import { browserTest, clickCanvas, dragPlatform, find, framed, layout, press, started, valueOf, waitForAnalysis } from "./harness.mjs";

const told = (page) => page.locator("#tautline-focus").textContent();
const active = (page) => page.evaluate(() => document.activeElement?.id || document.activeElement?.tagName);

/** Presses a key and returns what is told of the focus once that rests; the same as before where nothing new is told. */
async function pressAndHear(page, key, keyboard = page.keyboard) {
    const before = await told(page);
    await keyboard.press(key);
    await page.waitForFunction((before) => document.getElementById("tautline-focus").textContent !== before, before,
        { timeout: 3000 }).catch(() => {});
    return told(page);
}

browserTest("F6 goes from region to region and Shift+F6 back", async ({ open }) => {
    const page = await open();
    await started(page);
    await press(page, "Pause", "button"); // nothing else moves
    await clickCanvas(page);
    const regions = (await layout(page)).filter(({ role }) => role === "region").map(({ label }) => label);
    const heard = [];
    for (let i = 0; i <= regions.length; i++) heard.push(await pressAndHear(page, "F6"));
    const names = heard.map((text) => text.split(":")[0]);
    for (const region of ["Bar", "Controls", "Canvas", "Transport", "Plots"]) {
        assert.ok(names.includes(region), `F6 did not come to ${region}, but said:\n  ${heard.join("\n  ")}`);
    }
    assert.equal(await active(page), "tautline-canvas", "the browser keeps F6 from the page");
    const back = await pressAndHear(page, "Shift+F6");
    assert.equal(back.split(":")[0], names.at(-2), `back from ${names.at(-1)}; all the way was ${names.join(", ")}`);
}, { timeout: 120_000 });

browserTest("the focused control is told with its value, and again once the value rests", async ({ open }) => {
    const page = await open();
    await started(page);
    const heard = [];
    for (let i = 0; i < 80 && !/Speed v, slider/.test(heard.at(-1)); i++) heard.push(await pressAndHear(page, "Tab"));
    assert.match(heard.at(-1), /Speed v, slider, 5 m\/s$/, `Tab never came there:\n  ${heard.join("\n  ")}`);
    await page.evaluate(() => {
        window.sentences = [];
        const region = document.getElementById("tautline-focus");
        new MutationObserver(() => window.sentences.push(region.textContent)).observe(region, { childList: true, characterData: true, subtree: true });
    });
    for (let i = 0; i < 10; i++) {
        await page.keyboard.press("ArrowRight");
        await page.waitForTimeout(50);
    }
    await page.waitForFunction(() => window.sentences.length > 0);
    await page.waitForTimeout(600);
    const { speed } = (await page.evaluate(() => window.tautline.scenario())).motion;
    const sentences = await page.evaluate(() => window.sentences);
    assert.ok(speed > 5, `the arrow keys did not move the slider: ${speed}`);
    assert.ok(sentences.length <= 2, `told ${sentences.length} times: ${sentences.join("; ")}`);
    assert.match(sentences.at(-1), /^Speed v, slider, [\d.]+ m\/s$/);
}, { timeout: 120_000 });

browserTest("Tab goes through the app and then out of it, forwards and backwards", async ({ open }) => {
    const page = await open();
    await started(page);
    let presses = 0;
    while (await active(page) !== "tautline-end" && presses++ < 300) {
        await page.keyboard.press("Tab");
        await page.waitForTimeout(60);
    }
    assert.equal(await active(page), "tautline-end", `after ${presses} times Tab`);
    assert.ok(presses > 20, `only ${presses} controls`);
    assert.ok(await page.locator("#tautline-end").evaluate((end) => end.getBoundingClientRect().height > 10), "it is seen");
    // Where the next Tab goes is seen in a frame, below: here there is nothing around the page. From the end it goes back to
    // the last control, from the first one out at the start.
    await page.keyboard.press("Shift+Tab");
    assert.equal(await active(page), "tautline-canvas");
    const last = await pressAndHear(page, "Shift+Tab");
    assert.notEqual(last, "");
    assert.equal(await active(page), "tautline-canvas");
    await page.keyboard.press("Escape");
    for (let i = 0; i < 2; i++) {
        await page.keyboard.press("Tab");
        await page.waitForTimeout(100);
    }
    for (let i = 0; i < 3 && await active(page) === "tautline-canvas"; i++) {
        await page.keyboard.press("Shift+Tab");
        await page.waitForTimeout(150);
    }
    assert.equal(await active(page), "tautline-start");
}, { timeout: 120_000 });

browserTest("Tab leaves a frame for the page around it", async ({ open, origin }) => {
    const { page, frame, close } = await framed(open, origin, { before: "<input id=before>", after: "<input id=after>" });
    try {
        await page.locator("#before").focus();
        const outside = () => page.evaluate(() => document.activeElement.id || document.activeElement.tagName);
        let presses = 0;
        do {
            await page.keyboard.press("Tab");
            await page.waitForTimeout(60);
        } while (await outside() === "IFRAME" && presses++ < 200);
        assert.equal(await outside(), "after", `after ${presses} times Tab; within the frame ${await active(frame)} has the focus`);
        assert.ok(presses > 3, `only ${presses} stops in the frame`);
    } finally {
        await close();
    }
}, { timeout: 120_000 });

browserTest("a drag's results are told once, when they rest", async ({ open }) => {
    const page = await open();
    await started(page);
    await page.waitForFunction(() => document.getElementById("tautline-summary").textContent !== "");
    await page.evaluate(() => {
        window.announced = [];
        const summary = document.getElementById("tautline-summary");
        new MutationObserver(() => window.announced.push(summary.textContent)).observe(summary, { childList: true, characterData: true, subtree: true });
    });
    const during = async () => {
        assert.deepEqual(await page.evaluate(() => window.announced), [], "told while it was dragged");
    };
    await dragPlatform(page, 90, 10, { steps: 60, pause: 25, beforeRelease: during });
    const { critical } = await waitForAnalysis(page, (analysis) => analysis.current, { timeout: 30_000 });
    await page.waitForFunction(() => window.announced.length > 0);
    await page.waitForTimeout(1500);
    const announced = await page.evaluate(() => window.announced);
    assert.equal(announced.length, 1, `told ${announced.length} times: ${announced.join("; ")}`);
    assert.match(announced[0], new RegExp(`Critical speed ${Math.floor(critical.speed)}`));
}, { timeout: 120_000 });

browserTest("what the open plots say is there as text", async ({ open }) => {
    const page = await open();
    await started(page);
    await page.waitForFunction(() => window.tautline.studies().line.finished, undefined, { timeout: 60_000, polling: 200 });
    const details = () => page.locator("#tautline-details li").allTextContents();
    await page.waitForTimeout(1500);
    const lines = await details();
    assert.ok(lines.some((line) => /falls|rises|line|frequency/i.test(line) && !/^(Paper robot|Platform at|Cable)/.test(line)),
        `no word of the study along the line:\n  ${lines.join("\n  ")}`);
}, { timeout: 120_000 });

for (const [single_keys, does] of [[true, "do something"], [false, "do nothing where they are switched off"]]) {
    browserTest(`keys without Ctrl ${does}`, async ({ open }) => {
        const page = await open("", {
            before: (page) => page.addInitScript((single_keys) => localStorage.setItem("tautline-state",
                JSON.stringify({ tour_taken: true, settings: { single_keys } })), single_keys),
        });
        await started(page);
        await clickCanvas(page);
        assert.equal((await find(page, "Map", "button")).value, false);
        await page.keyboard.press("m");
        await page.waitForTimeout(500);
        await valueOf(page, "Map", "button", (value) => value === single_keys, { timeout: 3000 });
        // With Ctrl they always do.
        await page.evaluate(() => window.tautline.load({ ...window.tautline.scenario(), gravity: 1.62 }));
        // What was loaded is on show before it is undone.
        await waitForAnalysis(page, (analysis) => analysis.current, { timeout: 30_000 });
        await page.keyboard.press("Control+z");
        await page.waitForFunction(() => window.tautline.scenario().gravity !== 1.62);
    });
}
