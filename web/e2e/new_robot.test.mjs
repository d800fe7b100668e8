// A robot of one's own: winches are clicked into an area, and the robot that they make is opened.
import assert from "node:assert/strict";
import { browserTest, find, gone, press, started, waitForAnalysis } from "./harness.mjs";

/** Blank around the area for the names of its lines, in points. */
const EDGE = 16;
/** How wide the area is when the window opens, in m. */
const WIDTH = 20;
const WINCHES = [[-8, 4], [8, 4], [-8, -4], [7, -4]];

browserTest("a new robot starts from four clicks, and one step of undo brings the old one back", async ({ open }) => {
    const page = await open();
    await started(page);
    const before = await page.evaluate(() => window.tautline.scenario());
    await press(page, "Robot", "combobox");
    await press(page, "New robot …");
    const { enabled } = await find(page, "Make the robot", "button");
    assert.equal(enabled, false, "there are no winches yet");
    const { rect: [x, y, width, height] } = await find(page, "Area for winches");
    const scale = (width - 2 * EDGE) / WIDTH;
    for (const [east, up] of WINCHES) {
        await page.mouse.click(x + width / 2 + scale * east, y + height / 2 - scale * up);
        await page.waitForTimeout(200);
    }
    assert.deepEqual((await find(page, "Area for winches")).rect, [x, y, width, height], "it moves under the hand");
    await press(page, "Make the robot", "button");
    await gone(page, "Area for winches");
    const made = await page.evaluate(() => window.tautline.scenario());
    assert.deepEqual(made.cables.map(({ anchor }) => anchor), WINCHES);
    assert.equal(made.name, "My robot");
    await waitForAnalysis(page, ({ current, feasible }) => current && feasible);
    await press(page, "Undo", "button", { within: "Bar" });
    await page.waitForFunction((name) => window.tautline.scenario().name === name, before.name);
    assert.deepEqual(await page.evaluate(() => window.tautline.scenario()), before);
}, { timeout: 120_000 });
