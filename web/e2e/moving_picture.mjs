// Makes the moving picture of the README from the built page: node moving_picture.mjs [FILE]
//
// A page that flies shows a flight along a path; an older one lets the robot go. The page moves by the clock: where taking
// the pictures lasts longer than 5 s, the robot moves faster in the result than on the screen. The script says how long it took.
import { writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import assert from "node:assert/strict";
import { gif } from "./gif.mjs";
import { browserTest, choose, isThere, press, started } from "./harness.mjs";

const FILE = process.argv[2] ?? fileURLToPath(new URL("../../docs/pictures/flight.gif", import.meta.url));
const [WIDTH, HEIGHT] = [760, 475];
const [SECONDS, RATE] = [5, 12];
const LARGEST = 1e6;

/** The PNGs' pixels, RGBA, in the picture's size; the browser reads them. */
async function pixels(page, pngs) {
    const blank = await page.context().newPage();
    const frames = [];
    for (const png of pngs) {
        const base64 = await blank.evaluate(async ([base64, width, height]) => {
            const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
            const picture = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
            const context = new OffscreenCanvas(width, height).getContext("2d");
            context.imageSmoothingQuality = "high";
            context.drawImage(picture, 0, 0, width, height);
            const { data } = context.getImageData(0, 0, width, height);
            let text = "";
            for (let i = 0; i < data.length; i += 0x8000) text += String.fromCharCode(...data.subarray(i, i + 0x8000));
            return btoa(text);
        }, [png.toString("base64"), WIDTH, HEIGHT]);
        frames.push(Buffer.from(base64, "base64"));
    }
    return frames;
}

/** Makes the robot move: along a path where the page can fly, else from a disturbance. */
async function start(page) {
    const robot = await page.evaluate(() => window.tautline.scenario());
    const y = robot.motion.position[1];
    const flying = { ...robot, schema: "tautline/scenario/2", motion: { ...robot.motion, position: [-6, y] }, path: { points: [[6, y]], speed: 5, hold: 1 } };
    const loaded = await page.evaluate((json) => {
        try { window.tautline.load(json); } catch { return false; }
        return window.tautline.scenario().path !== undefined;
    }, JSON.stringify(flying)).catch(() => false);
    await started(page);
    if (loaded && await isThere(page, "Fly", "button")) return press(page, "Fly", "button");
    if (loaded) return choose(page, "What moves", "Fly");
    if (await isThere(page, "Play", "button")) return press(page, "Play", "button");
}

browserTest("the moving picture", async ({ open }) => {
    const page = await open("", { viewport: { width: WIDTH, height: HEIGHT } });
    await started(page);
    await start(page);
    await page.waitForTimeout(1000);
    const pngs = [];
    const begin = Date.now();
    while (pngs.length < SECONDS * RATE) {
        await page.waitForTimeout(Math.max(0, begin + (1000 * pngs.length) / RATE - Date.now()));
        pngs.push(await page.screenshot());
    }
    const taken = (Date.now() - begin) / 1000;
    const bytes = gif(await pixels(page, pngs), WIDTH, HEIGHT, Math.round(100 / RATE));
    assert.ok(bytes.length < LARGEST, `${bytes.length} bytes are more than ${LARGEST}`);
    writeFileSync(FILE, bytes);
    console.log(`${FILE}: ${pngs.length} pictures, ${bytes.length} bytes, taken in ${taken.toFixed(1)} s`);
}, { timeout: 240_000 });
