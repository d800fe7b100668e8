// Random drags and changes for as long as SOAK_MINUTES says (one minute in the usual run), at full speed:
//
//   cd web/e2e && SOAK_MINUTES=10 SOAK_SEED=7 node --test soak.test.mjs
//
// No error, no growing memory, and at the end the answers of a page that has just been opened.
import assert from "node:assert/strict";
import { browserTest, MAP, waitForAnalysis, waitForStart } from "./harness.mjs";

const MINUTES = Number(process.env.SOAK_MINUTES ?? 1);
const SEED = Number(process.env.SOAK_SEED ?? Math.floor(Math.random() * 2 ** 31));
/** The largest number of elements per cable. */
const LARGEST = 16;
/** The plots' tabs in a window of 1280 × 800. */
const TABS = [[991, 285], [1085, 285], [1164, 285], [998, 309], [1090, 309], [1171, 309], [1238, 309], [975, 332]];
/** Memory counts from here on: everything has been open once. */
const WARM_UP = Math.min(60_000, (MINUTES * 60_000) / 2);

/** Park and Miller's generator, so that a seed tells the whole run. */
function generator(seed) {
    let state = (seed % 2147483646) + 1;
    return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

/** Run before the page's own scripts and in its workers: keeps hold of the program's memory. */
function remember() {
    for (const name of ["instantiate", "instantiateStreaming"]) {
        const original = WebAssembly[name];
        WebAssembly[name] = async (...rest) => {
            const result = await original(...rest);
            self.memories = [...(self.memories ?? []), (result.instance ?? result).exports.memory];
            return result;
        };
    }
}

/** Bytes of the page's and of its workers' programs. */
async function memory(page) {
    const bytes = () => (self.memories ?? []).map((memory) => memory.buffer.byteLength);
    const all = await Promise.all([page, ...page.workers()].map((where) => where.evaluate(bytes)));
    assert.ok(all.length > 1 && all.every((sizes) => sizes.length === 1), JSON.stringify(all));
    return all.flat();
}

const scenario = (page) => page.evaluate(() => window.tautline.scenario());

browserTest(`random use for ${MINUTES} min leaves no trace (seed ${SEED})`, async ({ open }) => {
    const random = generator(SEED);
    const between = (from, to) => from + (to - from) * random();
    const one = (list) => list[Math.floor(random() * list.length)];
    const page = await open("", {
        before: async (page) => {
            await page.addInitScript(remember);
            await page.context().route(/worker_loader\.js$/, async (route) => {
                const response = await route.fetch();
                await route.fulfill({ response, body: `(${remember})();\n${await response.text()}` });
            });
        },
    });
    await waitForStart(page);
    await waitForAnalysis(page, (analysis) => analysis.current, { timeout: 30_000 });
    const original = await scenario(page);
    await page.mouse.click(...MAP);

    // Anything on the canvas may be grabbed, and any button, tab and value on the right and left pressed or dragged; but
    // for the number of elements, at the foot of the controls: memory is what the largest robot has needed.
    const somewhere = () => one([
        () => [between(380, 940), between(280, 560)],
        () => [between(145, 330), between(120, 430)],
        () => [between(950, 1270), between(195, 340)],
        () => [between(990, 1270), between(400, 760)],
    ])();
    const actions = [
        async () => {
            await page.mouse.move(...somewhere());
            await page.mouse.down();
            const steps = Math.floor(between(1, 30));
            for (let i = 0; i < steps; i++) await page.mouse.move(between(380, 940), between(280, 560));
            await page.mouse.up();
        },
        async () => page.mouse.click(...somewhere()),
        async () => {
            await page.mouse.move(...somewhere());
            await page.mouse.wheel(0, between(-300, 300));
        },
        async () => page.keyboard.press(one(["Control+z", "Control+Shift+z", "m", "Space", "Escape", "Tab"])),
        async () => {
            const changed = structuredClone(original);
            changed.motion.position = [between(-6, 6), between(-3, 3)];
            changed.motion.speed = between(0, 15);
            changed.cable.youngs_modulus *= 10 ** between(-1, 1);
            changed.cable.mass_per_length *= 10 ** between(-0.5, 0.5);
            changed.elements_per_cable = Math.floor(between(2, LARGEST + 1));
            await page.evaluate((json) => window.tautline.load(json), JSON.stringify(changed));
        },
    ];
    // What needs most: every plot of the finest mesh.
    const largest = { ...original, elements_per_cable: LARGEST, linearisation: "tangent" };
    await page.evaluate((json) => window.tautline.load(json), JSON.stringify(largest));
    for (const tab of TABS) {
        await page.mouse.click(...tab);
        await page.waitForTimeout(1000);
    }
    const begun = Date.now();
    let [done, warm] = [0, undefined];
    const course = [];
    while (Date.now() - begun < MINUTES * 60_000) {
        await one(actions)();
        done++;
        if (!warm && Date.now() - begun > WARM_UP) warm = await memory(page);
        if (Date.now() - begun > 60_000 * course.length) course.push(await memory(page));
        if (await page.locator("#tautline-error").isVisible()) throw new Error(await page.locator("#tautline-error").innerText());
    }

    // Calm again: the robot that was there at first, then the memory.
    await page.mouse.up();
    await page.keyboard.press("Escape");
    await page.evaluate((json) => window.tautline.load(json), JSON.stringify(original));
    const last = await waitForAnalysis(page, (analysis) => analysis.current, { timeout: 60_000 });
    const end = await memory(page);
    const megabytes = (sizes) => sizes.map((size) => (size / 2 ** 20).toFixed(1)).join(" ");
    console.log(`${done} actions; memory in MB (page, worker, pool) every minute and at the end: ` +
        [...course, end].map(megabytes).join(", "));
    const fresh = await open();
    await waitForStart(fresh);
    const { revision: _, ...expected } = await waitForAnalysis(fresh, (analysis) => analysis.current, { timeout: 30_000 });
    const { revision: __, ...got } = last;
    assert.deepEqual(got, expected);
    const sum = (sizes) => sizes.reduce((a, b) => a + b, 0);
    // A program's memory never shrinks. What is rare may come late: the dense solver's matrices, which few robots need,
    // take 4 MB, and page and pool grow by steps below 1 MB each. A leak of 1 kB with each answer would come to 20 MB
    // within ten minutes.
    assert.ok(sum(end) <= sum(warm) + 6 * 2 ** 20, `${warm} grew to ${end}`);
}, { timeout: (MINUTES + 3) * 60_000 });
