// Designs that are kept beside the present one, and the names of changed robots.
import assert from "node:assert/strict";

import { browserTest, choose, find, gone, press, started, type, valueOf, waitForAnalysis } from "./harness.mjs";

const scenario = (page) => page.evaluate(() => window.tautline.scenario());
const mass = async (page) => (await scenario(page)).platform.mass;

browserTest("kept designs are compared, change places, and survive a reload", async ({ open }) => {
    const page = await open("", { viewport: { width: 1280, height: 800 } });
    await started(page);
    await press(page, "Keep", "button");
    await type(page, "Platform mass m", "3");
    await page.waitForFunction(() => window.tautline.scenario().platform.mass === 3);
    assert.equal((await scenario(page)).name, "Paper robot, changed");
    assert.equal(await valueOf(page, "Robot", "combobox"), "Paper robot, changed");
    await waitForAnalysis(page);
    await press(page, "Designs", "button");
    await find(page, "Name of design A", "textbox");
    await type(page, "Name of design A", "As in the paper", { role: "textbox" });
    await press(page, "Work on A", "button");
    await page.waitForFunction(() => window.tautline.scenario().platform.mass === 2);
    assert.equal((await scenario(page)).name, "As in the paper");
    // What is kept is written down a moment later.
    await page.waitForTimeout(3000);
    await page.reload();
    await started(page);
    assert.equal(await mass(page), 2);
    await press(page, "Designs", "button");
    assert.equal(await valueOf(page, "Name of design A", "textbox"), "Paper robot, changed");
    await press(page, "Work on A", "button");
    await page.waitForFunction(() => window.tautline.scenario().platform.mass === 3);
    await press(page, "Remove A", "button");
    await gone(page, "Remove A", "button");
}, { timeout: 120_000 });

browserTest("designs are reached on a phone", async ({ open }) => {
    const page = await open("", { viewport: { width: 360, height: 740 } });
    await started(page);
    await choose(page, "More", "Keep this design");
    await choose(page, "More", "Designs");
    for (const button of ["Work on A", "Remove A"]) {
        const { rect: [x, , width] } = await find(page, button, "button");
        assert.ok(x >= 0 && x + width <= 360, `${button}: ${x} ${width}`);
    }
});
