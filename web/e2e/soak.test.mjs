// Random drags and changes for as long as SOAK_MINUTES says (one minute in the usual run), at full speed:
//
//   cd web/e2e && SOAK_MINUTES=10 SOAK_SEED=7 node --test soak.test.mjs
//
// No error, no growing memory, and at the end the answers of a page that has just been opened.
import assert from "node:assert/strict";
import { browserTest, centre, layout, openPlot, PLOTS, press, started, waitForAnalysis } from "./harness.mjs";

const MINUTES = Number(process.env.SOAK_MINUTES ?? 1);
const SEED = Number(process.env.SOAK_SEED ?? Math.floor(Math.random() * 2 ** 31));
/** The largest number of elements per cable. */
const LARGEST = 16;
/**
 * What is not touched: what opens the system's dialogs, and what makes a robot larger, since memory is what the largest
 * robot has needed.
 */
const LEFT_ALONE = /open|save|copy|paste|share|embed|elements|cable|robot|more|example|preset|sound/i;
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
    await started(page);
    const original = await scenario(page);
    await press(page, "Map", "button");

    /** The middle of any control, or any place on the canvas. */
    const somewhere = async () => {
        const items = await layout(page);
        if (random() < 0.4) return onCanvas(items);
        const controls = items.filter(({ role, label, enabled }) => enabled && role !== "text" && !LEFT_ALONE.test(label));
        return controls.length > 0 ? centre(one(controls)) : onCanvas(items);
    };
    const onCanvas = (items) => {
        const canvas = items.find(({ role, label }) => role === "region" && label === "Canvas");
        const [x, y, width, height] = canvas?.rect ?? [380, 280, 560, 280];
        return [between(x, x + width), between(y, y + height)];
    };
    const actions = [
        async () => {
            const items = await layout(page);
            await page.mouse.move(...await somewhere());
            await page.mouse.down();
            const steps = Math.floor(between(1, 30));
            for (let i = 0; i < steps; i++) await page.mouse.move(...onCanvas(items));
            await page.mouse.up();
        },
        async () => page.mouse.click(...await somewhere()),
        async () => {
            await page.mouse.move(...await somewhere());
            await page.mouse.wheel(0, between(-300, 300));
        },
        async () => page.keyboard.press(one(["Control+z", "Control+Shift+z", "m", "Space", "Escape", "Tab", "F6", "F", "Escape"])),
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
    for (const title of Object.values(PLOTS).flat()) {
        await openPlot(page, title);
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
    await started(fresh);
    const { revision: _, ...expected } = await waitForAnalysis(fresh, (analysis) => analysis.current, { timeout: 30_000 });
    const { revision: __, ...got } = last;
    assert.deepEqual(got, expected);
    const sum = (sizes) => sizes.reduce((a, b) => a + b, 0);
    // A program's memory never shrinks. What is rare may come late: the dense solver's matrices, which few robots need,
    // take 4 MB, and page and pool grow by steps below 1 MB each. A leak of 1 kB with each answer would come to 20 MB
    // within ten minutes.
    assert.ok(sum(end) <= sum(warm) + 6 * 2 ** 20, `${warm} grew to ${end}`);
}, { timeout: (MINUTES + 3) * 60_000 });
