// The app in a browser: what is on show follows the pointer, and equals what the command line says.
import assert from "node:assert/strict";
import {
    browserTest, commandLine, dragPlatform, press, reveal, screenshot, type, valueOf, waitForAnalysis, waitForStart,
} from "./harness.mjs";

const MODULUS = "Young's modulus E";

function close(actual, expected, tolerance, what) {
    assert.ok(Math.abs(actual - expected) <= tolerance, `${what}: ${actual} in place of ${expected}`);
}

/** The analysis on show, with the scenario on show, once both belong together. */
async function onShow(page, predicate = () => true) {
    const analysis = await waitForAnalysis(page, (a) => a.current && predicate(a), { timeout: 30_000 });
    return { analysis, scenario: await page.evaluate(() => window.tautline.scenario()) };
}

browserTest("the paper's robot has its critical speed, and dragging the platform changes it", async ({ open }) => {
    const page = await open();
    await waitForStart(page);
    const first = await onShow(page);
    // Independent figures: docs/theory.md, reference numbers.
    close(first.analysis.critical.speed, 11.299, 1e-3, "critical speed at x = 0");
    assert.equal(first.analysis.eigenvalues.length, 148);
    await screenshot(page, "app light");

    await dragPlatform(page, 60, 0);
    const second = await onShow(page, (a) => a.revision > first.analysis.revision);
    const moved = second.scenario.motion.position[0];
    assert.ok(moved > 1 && moved < 6, `dragged to x = ${moved}`);
    assert.notEqual(second.analysis.critical.speed, first.analysis.critical.speed);

    // On to x = 6, with the scale that the first drag showed, the last points one by one.
    const rest = Math.round(6 * (60 / moved)) - 60;
    await dragPlatform(page, rest, 0, {
        beforeRelease: async ([x, y]) => {
            for (let i = 0; i < 10; i++) {
                await page.waitForTimeout(100);
                const left = 6 - (await page.evaluate(() => window.tautline.scenario().motion.position[0]));
                if (left === 0) break;
                await page.mouse.move((x += Math.sign(left)), y);
            }
        },
    });
    const third = await onShow(page, (a) => a.revision > second.analysis.revision);
    assert.deepEqual(third.scenario.motion.position, [6, 0]);
    close(third.analysis.critical.speed, 10.0125, 1e-4, "critical speed at x = 6");
    await screenshot(page, "app at x = 6");

    const expected = commandLine(third.scenario);
    close(third.analysis.critical.speed, expected.critical.speed, 1e-6, "page against command line");
    assert.equal(third.analysis.critical.cable, expected.critical.cable);
    // The digits that are certain, as the core rounds them, once the answer rests.
    await page.waitForFunction((exact) => {
        const text = document.getElementById("tautline-summary").textContent;
        const [, told, decimals = ""] = /^Critical speed (\d+(?:\.(\d+))?) metres per second, flutter at /.exec(text) ?? [];
        return Math.abs(Number(told) - exact) <= 0.5001 * 10 ** -decimals.length;
    }, third.analysis.critical.speed);
});

browserTest("an infeasible pose is told and recovered from", async ({ open }) => {
    const page = await open();
    await waitForStart(page);
    await onShow(page);
    await dragPlatform(page, 230, 0);
    const told = await onShow(page, (a) => !a.feasible);
    assert.match(told.analysis.reason, /cable 1 would have to push/);
    assert.equal(told.analysis.critical, null);
    assert.deepEqual(told.analysis.eigenvalues, []);
    await screenshot(page, "app infeasible");

    await dragPlatform(page, -180, 0);
    const back = await onShow(page, (a) => a.feasible);
    close(back.analysis.critical.speed, commandLine(back.scenario).critical.speed, 1e-6, "page against command line");
});

browserTest("a typed Young's modulus changes the answer", async ({ open }) => {
    const page = await open();
    await waitForStart(page);
    const before = await onShow(page);
    await type(page, MODULUS, "200");
    const after = await onShow(page, (a) => a.revision > before.analysis.revision);
    close(after.scenario.cable.youngs_modulus, 200e6, 1e-3, "E");
    assert.notEqual(after.analysis.critical.speed, before.analysis.critical.speed);
    close(after.analysis.critical.speed, commandLine(after.scenario).critical.speed, 1e-6, "page against command line");
});

browserTest("what a field refuses is told to screen readers, and Esc takes it back", async ({ open }) => {
    const page = await open();
    await waitForStart(page);
    const before = await onShow(page);
    await type(page, MODULUS, "12 kg");
    const told = page.locator("#tautline-notice");
    await told.filter({ hasText: "E is a stress; kg is a mass" }).waitFor({ state: "attached" });
    await screenshot(page, "app refused number");
    await page.keyboard.press("Escape");
    await page.waitForFunction(() => document.getElementById("tautline-notice").textContent === "");
    // What is typed after that, and taken back, leaves no trace either.
    await type(page, MODULUS, "0,2 GPa", { enter: "Escape" });
    await page.waitForTimeout(500);
    assert.deepEqual((await onShow(page)).scenario, before.scenario);
    // With a decimal comma and another unit, as it is meant.
    await type(page, MODULUS, "0,2 GPa");
    const after = await onShow(page, (a) => a.revision > before.analysis.revision);
    assert.equal(after.scenario.cable.youngs_modulus, 200e6);
});

browserTest("a value goes back to what it was when the robot was opened", async ({ open }) => {
    const page = await open();
    await waitForStart(page);
    const before = await onShow(page);
    await type(page, "Speed v", "7");
    await valueOf(page, "Speed v", "spinbutton", (value) => /^7/.test(value));
    await reveal(page, /^Reset speed/i, "button");
    await press(page, /^Reset speed/i, "button");
    await valueOf(page, "Speed v", "spinbutton", (value) => /^5/.test(value));
    assert.deepEqual((await onShow(page)).scenario, before.scenario);
});

browserTest("scripts load scenarios, and hear why one is refused", async ({ open }) => {
    const page = await open();
    await waitForStart(page);
    const { scenario } = await onShow(page);
    const changed = { ...scenario, linearisation: "tangent", motion: { ...scenario.motion, position: [2, 0] } };
    const current = await page.evaluate((json) => {
        window.tautline.load(json);
        return [window.tautline.analysis().current, window.tautline.scenario()];
    }, JSON.stringify(changed));
    assert.equal(current[0], false, "the old analysis must not pass for the new scenario's");
    assert.deepEqual(current[1].motion.position, [2, 0]);
    const { analysis } = await onShow(page);
    // Reference case 7.
    close(analysis.critical.speed, 10.67066, 1e-3, "critical speed, tangent, x = 2");

    const refused = await page.evaluate((json) => {
        try {
            window.tautline.load(json);
        } catch (error) {
            return [error instanceof Error, error.message];
        }
        return [false, "accepted"];
    }, JSON.stringify({ ...changed, platform: { mass: -2 }, gravity: "much" }));
    assert.ok(refused[0], refused[1]);
    assert.match(refused[1], /gravity/);
    assert.deepEqual((await onShow(page)).scenario.motion.position, [2, 0], "the last good state stays");
    const timings = await page.evaluate(() => window.tautline.timings());
    assert.ok(timings.frame_ms > 0 && timings.analysis_ms > 0, JSON.stringify(timings));
    console.log(`timings: frame ${timings.frame_ms.toFixed(1)} ms, analysis ${timings.analysis_ms.toFixed(0)} ms`);
});

for (const [name, options] of Object.entries({
    "dark": { colorScheme: "dark" },
    "phone": { viewport: { width: 360, height: 740 } },
    "phone dark": { viewport: { width: 360, height: 740 }, colorScheme: "dark" },
})) {
    browserTest(`the answer is there on a screen of kind: ${name}`, async ({ open }) => {
        const page = await open("", options);
        await waitForStart(page);
        const { analysis } = await onShow(page);
        close(analysis.critical.speed, 11.299, 1e-3, "critical speed");
        await page.waitForTimeout(300);
        await screenshot(page, `app ${name}`);
    });
}

for (const file of ["worker_loader.js", "worker_bg.wasm"]) {
    browserTest(`the page says so when it gets no ${file}`, async ({ open }) => {
        const page = await open("", { before: (page) => page.route(`**/${file}*`, (route) => route.abort()) });
        await waitForStart(page);
        await page.waitForFunction(
            () => document.getElementById("tautline-summary").textContent.startsWith("The analysis does not run"));
        assert.equal(await page.locator("#tautline-error").isVisible(), false, "the app goes on");
        await screenshot(page, `no ${file}`);
    }, { allow: [/worker/, /ERR_FAILED/, /Failed to fetch/] });
}
