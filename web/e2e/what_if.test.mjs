// "What if": the critical speed against any number of the robot, against two, and the value that gives a wanted one.
import assert from "node:assert/strict";
import {
    browserTest, commandLine, find, gone, layout, openPlot, pointAt, press, screenshot, started, type, waitForAnalysis,
} from "./harness.mjs";

const PLOT = /^What if: /;
const scenario = (page) => page.evaluate(() => window.tautline.scenario());
const studies = (page) => page.evaluate(() => window.tautline.studies());

/** Opens the plot and waits until its study is finished. */
async function open(page) {
    await openPlot(page, "What if");
    await finished(page);
}

async function finished(page) {
    await page.waitForFunction(() => {
        const { what_if: study } = window.tautline.studies();
        return study.finished && study.current;
    }, undefined, { timeout: 60_000 });
}

/** Chooses an entry of one of the two lists of numbers. */
async function vary(page, list, entry) {
    await press(page, list, "combobox");
    await press(page, entry, "button");
}

async function settled(page, predicate, argument) {
    await page.waitForFunction(predicate, argument, { timeout: 30_000 });
    await waitForAnalysis(page, (analysis) => analysis.current, { timeout: 30_000 });
}

for (const colorScheme of ["light", "dark"]) {
    browserTest(`the critical speed against a number, ${colorScheme}`, async ({ open: start }) => {
        const page = await start("", { colorScheme });
        await started(page);
        await open(page);
        await vary(page, "Number to vary", "Platform mass m");
        await finished(page);
        const { label } = await find(page, PLOT, "img");
        assert.match(label, /Platform mass m from 1 kg to 4 kg/);
        assert.match(label, /Critical from [\d.]+ m\/s at/);
        await page.mouse.move(640, 20);
        await screenshot(page, `what if ${colorScheme}`);

        // A click sets the value, and undo takes it back in one step.
        const before = await scenario(page);
        const { mouse, at: [x, y] } = await pointAt(page, PLOT, "img");
        await mouse.click(x + 40, y - 20);
        await settled(page, (mass) => window.tautline.scenario().platform.mass !== mass, before.platform.mass);
        const { revision } = (await studies(page)).what_if;
        await page.keyboard.press("Control+z");
        await settled(page, (mass) => window.tautline.scenario().platform.mass === mass, before.platform.mass);
        assert.deepEqual(await scenario(page), before);
        // The study does not depend on the number that it varies.
        assert.equal((await studies(page)).what_if.revision, revision, "it began anew");

        // The ends can be typed; Fit takes them back.
        await type(page, "to", "10");
        await finished(page);
        await find(page, /^What if: Platform mass m from 1 kg to 10 kg/, "img");
        await press(page, "Fit What if", "button");
        await finished(page);
        await find(page, /^What if: Platform mass m from 1 kg to 4 kg/, "img");
    }, { timeout: 180_000 });
}

browserTest("a wanted critical speed is reached in one step, or it is said how far it gets", async ({ open: start }) => {
    const page = await start();
    await started(page);
    await open(page);
    await vary(page, "Number to vary", "Cable mass μ");
    await finished(page);
    const before = await scenario(page);
    const { critical: { speed } } = await page.evaluate(() => window.tautline.analysis());
    const wanted = Number((0.95 * speed).toFixed(2));
    await type(page, "Critical speed", String(wanted));
    await press(page, "Take it", "button");
    await settled(page, (mass) => window.tautline.scenario().cable.mass_per_length !== mass, before.cable.mass_per_length);
    const now = await scenario(page);
    const { critical } = commandLine(now);
    assert.ok(Math.abs(critical.speed - wanted) <= 1e-6 * wanted, `${critical.speed} for ${wanted}`);
    await gone(page, "Take it", "button");
    await page.keyboard.press("Control+z");
    await settled(page, (mass) => window.tautline.scenario().cable.mass_per_length === mass, before.cable.mass_per_length);
    assert.deepEqual(await scenario(page), before);

    await type(page, "Critical speed", "39");
    await find(page, /^No value between .* reaches 39\.\d+ m\/s; the nearest is [\d.]+ m\/s at /, undefined, { timeout: 60_000 });
    await screenshot(page, "what if out of reach");
    // What cannot be wanted is refused.
    await type(page, "Critical speed", "-3");
    await find(page, /The wanted critical speed must be more than 0 m\/s/);
}, { timeout: 180_000 });

browserTest("two numbers make a map, and a click sets both in one step", async ({ open: start }) => {
    const page = await start();
    await started(page);
    await open(page);
    await vary(page, "Number to vary", "Platform mass m");
    await vary(page, "Second number to vary", "Gravity g");
    await finished(page);
    const { label } = await find(page, PLOT, "img");
    assert.match(label, /the critical speed over Platform mass m from .* and Gravity g from /);
    assert.equal((await studies(page)).what_if.total, 31 * 21);
    await page.mouse.move(640, 20);
    await screenshot(page, "what if map");
    const before = await scenario(page);
    const { mouse, at: [x, y] } = await pointAt(page, PLOT, "img");
    await mouse.click(x + 30, y - 25);
    await settled(page, (mass) => window.tautline.scenario().platform.mass !== mass, before.platform.mass);
    const after = await scenario(page);
    assert.notEqual(after.gravity, before.gravity);
    await page.keyboard.press("Control+z");
    await settled(page, (mass) => window.tautline.scenario().platform.mass === mass, before.platform.mass);
    assert.deepEqual(await scenario(page), before);
}, { timeout: 180_000 });

browserTest("from what to change to what if, also on a phone", async ({ open: start }) => {
    const page = await start("", { viewport: { width: 360, height: 740 } });
    await started(page);
    await press(page, "Plots", "tab");
    await openPlot(page, "What to change", { within: "Sheet" });
    await press(page, "What if μ, cable mass", "button");
    await finished(page);
    await find(page, "Number to vary", "combobox");
    for (const { label, rect: [x, , width] } of (await layout(page)).filter(({ role }) => role === "combobox")) {
        assert.ok(x >= -1 && x + width <= 361, `${label} sticks out: ${x} to ${x + width}`);
    }
    await screenshot(page, "what if phone");
}, { timeout: 180_000 });
