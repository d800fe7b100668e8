// Studies in a browser: the map comes coarse to fine, can be cancelled, survives a lost worker and never holds the page
// up. Times are recorded, never asserted: the machine decides them.
import assert from "node:assert/strict";
import {
    browserTest, commandLine, openPlot, PLATFORM, pointAt, press, screenshot, started as start, waitForAnalysis,
} from "./harness.mjs";

const PHONE = { width: 360, height: 740 };
/** The plots that come of studies, and what these are about. */
const TOPICS = { "Along the line": "line", "Directions": "directions", "Speed diagram": "campbell", "Mesh error": "mesh" };

const switchMapOn = (page) => press(page, "Map", "button");
const studies = (page) => page.evaluate(() => window.tautline.studies());
const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const frames = async (page) => median(await page.evaluate(() => window.tautline.timings().frames_ms));

async function waitForStudies(page, predicate, { timeout = 120_000 } = {}) {
    const begun = Date.now();
    for (;;) {
        const now = await studies(page);
        if (predicate(now)) return now;
        if (Date.now() - begun > timeout) {
            const { map_values: _, ...short } = now;
            throw new Error(`no such state within ${timeout} ms; the last one: ${JSON.stringify(short)}`);
        }
        await page.waitForTimeout(10);
    }
}

/**
 * Run in the page: `window.progress` becomes [ms after the next press of the pointer, values of the map on show],
 * whenever their number changes, until all are.
 */
function watchMap() {
    window.progress = new Promise((done) => {
        addEventListener("pointerdown", () => {
            const pressed = performance.now();
            const progress = [];
            const look = () => {
                const { map } = window.tautline.studies();
                if (map.done !== progress.at(-1)?.[1]) progress.push([performance.now() - pressed, map.done]);
                if (map.finished) return done(progress);
                requestAnimationFrame(look);
            };
            look();
        }, { capture: true, once: true });
    });
}

/** Compares some of the map's rows with the command line. */
function compare(rows, scenario) {
    const some = rows.filter((row, i) => i % 97 === 0 || (row[0] === 6 && row[1] === 0));
    assert.ok(some.length > 8, `${some.length} rows`);
    for (const [x, y, feasible, speed, frequency, kind, cable, waveLimit, status] of some) {
        const expected = commandLine({ ...scenario, motion: { ...scenario.motion, position: [x, y] } });
        const where = `at (${x}, ${y})`;
        assert.equal(feasible, expected.feasible, where);
        assert.equal(speed === null, expected.critical === null, where);
        assert.equal(status, expected.status, where);
        const wave = expected.wave_limit?.speed ?? null;
        assert.ok(wave === waveLimit || Math.abs(waveLimit - wave) <= 1e-6 * wave, `${where}: ${waveLimit}`);
        if (speed === null) continue;
        assert.ok(Math.abs(speed - expected.critical.speed) <= 1e-6 * expected.critical.speed, `${where}: ${speed}`);
        assert.ok(Math.abs(frequency - expected.critical.frequency_hz) <= 1e-6 * (1 + frequency), `${where}: ${frequency}`);
        assert.deepEqual([kind, cable], [expected.critical.kind, expected.critical.cable], where);
    }
}

browserTest("the map comes coarse to fine and equals the command line", async ({ open }) => {
    const page = await open();
    await start(page);
    await page.evaluate(watchMap);
    await switchMapOn(page);
    const progress = await page.evaluate(() => window.progress);
    // Every fourth point of every fourth row.
    const [coarse] = progress.find(([, done]) => done >= 11 * 6);
    const [whole] = progress.at(-1);
    const { map } = await studies(page);
    const frame = await frames(page);
    assert.equal(map.total, 41 * 21);
    assert.ok(progress.length > 3, JSON.stringify(progress));
    console.log(`map 41 x 21: quarter resolution after ${coarse.toFixed(0)} ms, all after ${whole.toFixed(0)} ms, median frame ${frame.toFixed(1)} ms`);
    const { map_values: values } = await waitForStudies(page, (now) => now.map_values?.rows.length === map.total);
    assert.equal(values.current, true);
    compare(values.rows, await page.evaluate(() => window.tautline.scenario()));
    const { at: [x, y] } = await pointAt(page, ...PLATFORM);
    await page.mouse.move(x + 90, y - 40);
    await page.waitForTimeout(300);
    await screenshot(page, "map light");

    // A click moves the platform, and the map has no reason to begin anew.
    await page.mouse.click(x + 90, y - 40);
    await page.waitForFunction(() => window.tautline.scenario().motion.position[0] > 1);
    await waitForAnalysis(page, (analysis) => analysis.current, { timeout: 30_000 });
    assert.equal((await studies(page)).map.revision, map.revision);
}, { timeout: 180_000 });

browserTest("a map is cancelled, resumed, and begins anew with another robot", async ({ open }) => {
    const page = await open();
    await start(page);
    await switchMapOn(page);
    await waitForStudies(page, ({ map }) => map.done > 20);
    await press(page, "Cancel", "button", { within: "Canvas" });
    await page.waitForTimeout(500);
    const stopped = (await studies(page)).map;
    await page.waitForTimeout(500);
    assert.deepEqual((await studies(page)).map, stopped, "it goes on");
    assert.ok(stopped.done < stopped.total && !stopped.finished, JSON.stringify(stopped));
    await screenshot(page, "map cancelled");
    await press(page, "Resume", "button", { within: "Canvas" });
    await waitForStudies(page, ({ map }) => map.finished && map.revision > stopped.revision);

    const scenario = await page.evaluate(() => window.tautline.scenario());
    const stiffer = { ...scenario, cable: { ...scenario.cable, youngs_modulus: 200e6 } };
    const before = (await studies(page)).map.revision;
    await page.evaluate((json) => window.tautline.load(json), JSON.stringify(stiffer));
    const { map } = await waitForStudies(page, ({ map }) => map.finished && map.revision > before);
    const { map_values: values } = await waitForStudies(
        page, (now) => now.map_values.current && now.map_values.rows.length === map.total);
    await page.waitForTimeout(300);
    compare(values.rows, stiffer);
}, { timeout: 240_000 });

browserTest("a map survives the loss of a worker", async ({ open }) => {
    const page = await open();
    await start(page);
    await switchMapOn(page);
    await waitForStudies(page, ({ map }) => map.done > 20);
    // The first worker is the one that follows the pointer.
    const pool = page.workers().slice(1);
    assert.ok(pool.length > 0, "no workers of the pool");
    await pool[0].evaluate(() => self.close()).catch(() => {});
    const { map } = await waitForStudies(page, ({ map }) => map.finished);
    assert.equal(map.done, map.total);
    const { map_values: values } = await waitForStudies(page, (now) => now.map_values?.rows.length === map.total);
    compare(values.rows, await page.evaluate(() => window.tautline.scenario()));
}, { timeout: 240_000 });

browserTest("while a map is computed the platform follows the pointer", async ({ open }) => {
    const page = await open();
    await start(page);
    const record = async (what) => {
        const { at: [x, y] } = await pointAt(page, ...PLATFORM);
        await page.mouse.down();
        const [trails, analyses, behind] = [[], [], []];
        for (let i = 1; i <= 40; i++) {
            const asked = Date.now();
            const before = await page.evaluate(() => window.tautline.analysis().revision);
            await page.mouse.move(x + 2 * i, y);
            // Nothing is asked for where the pointer came back to where it was.
            const answered = await page.waitForFunction((before) => window.tautline.analysis().revision > before, before,
                { polling: 5, timeout: 5000 }).then(() => true, () => false);
            if (!answered) continue;
            trails.push(Date.now() - asked);
            // From the request to the answer, without the frames before and after it, drawn by software here.
            const timings = await page.evaluate(() => window.tautline.timings());
            analyses.push(timings.analysis_ms);
            behind.push(timings.trail_ms);
        }
        const frame = await frames(page);
        await page.mouse.up();
        assert.ok(trails.length > 30, `${trails.length} answers`);
        console.log(`${what}: answers trail the edit by ${median(behind).toFixed(0)} ms (median), the analysis takes ` +
            `${median(analyses).toFixed(0)} ms, the median frame ${frame.toFixed(1)} ms; from outside, with drawing by ` +
            `software and the test's round trips, ${median(trails)} ms (${Math.max(...trails)} ms at most)`);
        await page.evaluate((json) => window.tautline.load(json), JSON.stringify(scenario));
        await waitForAnalysis(page, (analysis) => analysis.current, { timeout: 30_000 });
    };
    const scenario = await page.evaluate(() => window.tautline.scenario());
    await record("drag, no study");
    await switchMapOn(page);
    const { map: begun } = await waitForStudies(page, ({ map }) => map.done > 20);
    await record("drag, map at work");
    const { map } = await waitForStudies(page, ({ map }) => map.finished);
    assert.equal(map.revision, begun.revision, "a drag does not restart the map");
    await openPlot(page, "Along the line");
    await waitForStudies(page, ({ line }) => line.finished);
    await record("drag, line open");
    await waitForStudies(page, ({ line }) => line.finished && line.current);
}, { timeout: 240_000 });

for (const colorScheme of ["light", "dark"]) {
    browserTest(`every study has its plot, ${colorScheme}`, async ({ open }) => {
        const page = await open("", { colorScheme });
        await start(page);
        await switchMapOn(page);
        for (const [tab, topic] of Object.entries(TOPICS)) {
            await openPlot(page, tab);
            await waitForStudies(page, (now) => now[topic].finished && now.map.finished);
            await page.mouse.move(640, 20);
            await page.waitForTimeout(400);
            await screenshot(page, `${tab} ${colorScheme}`);
        }
    }, { timeout: 240_000 });

    browserTest(`maps and plots on a phone, ${colorScheme}`, async ({ open }) => {
        const page = await open("", { colorScheme, viewport: PHONE });
        await start(page);
        await switchMapOn(page);
        await waitForStudies(page, ({ map }) => map.finished);
        await page.waitForTimeout(400);
        await screenshot(page, `map phone ${colorScheme}`);
        await press(page, "Plots", "tab");
        for (const [tab, topic] of Object.entries(TOPICS)) {
            await openPlot(page, tab, { within: "Sheet" });
            await waitForStudies(page, (now) => now[topic].finished);
            await pointAt(page, "Sheet", "region");
            await page.mouse.wheel(0, 3000);
            await page.waitForTimeout(500);
            await screenshot(page, `${tab} phone ${colorScheme}`);
            await page.mouse.wheel(0, -6000);
            await page.waitForTimeout(500);
        }
    }, { timeout: 240_000 });
}
