// Pictures of a plot and of the robot, saved by the menus: PNG at twice the size, and SVG with title, units and numbers.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { browserTest, colours, find, press, started } from "./harness.mjs";

/** What stands on buttons: none of it belongs in a picture. */
const BUTTONS = ["Fit", "All", "Reset", "What am I seeing?", "Dismiss"];

async function save(page, menu, entry) {
    await press(page, menu, "button");
    await find(page, entry);
    const [saved] = await Promise.all([page.waitForEvent("download"), press(page, entry)]);
    return [saved.suggestedFilename(), await readFile(await saved.path())];
}

/** The size of a drawing in points, and its texts as the browser reads them. */
function drawing(page, svg) {
    return page.evaluate((text) => {
        const read = new DOMParser().parseFromString(text, "image/svg+xml");
        const root = read.documentElement;
        if (read.querySelector("parsererror") || root.localName !== "svg") throw new Error(`no SVG: ${text.slice(0, 200)}`);
        return {
            size: ["width", "height"].map((side) => Number(root.getAttribute(side))),
            title: root.querySelector("title").textContent,
            texts: [...root.querySelectorAll("text")].map((element) => element.textContent),
            image: root.querySelector("image") !== null,
        };
    }, svg);
}

browserTest("a plot and the robot are saved as pictures", async ({ open }) => {
    const page = await open("", { viewport: { width: 1280, height: 800 } });
    await started(page);
    for (const [menu, entry, name, title, parts] of [
        ["More for Eigenvalues", "Picture", "paper-robot-eigenvalues", "Eigenvalues", ["growth rate Re λ, 1/s", "frequency, Hz"]],
        ["More", "Robot", "paper-robot-canvas", "Paper robot", ["Cable tension, N"]],
    ]) {
        const entries = entry === "Picture" ? ["Picture (SVG)", "Picture (PNG)"] : ["Robot as SVG", "Robot as PNG"];
        const [svgName, svg] = await save(page, menu, entries[0]);
        assert.equal(svgName, `${name}.svg`);
        const text = svg.toString();
        assert.doesNotMatch(text, /NaN|"-?inf/);
        const drawn = await drawing(page, text);
        assert.equal(drawn.title, title);
        for (const part of [...parts, "Paper robot: E = "]) {
            assert.ok(drawn.texts.some((line) => line.includes(part)), `${part} is not in ${drawn.texts}`);
        }
        assert.ok(BUTTONS.every((button) => !drawn.texts.includes(button)), `${drawn.texts}`);
        // A download that has begun is told.
        await page.waitForFunction(
            (file) => document.getElementById("tautline-notice").textContent.includes(`The download of ${file} has begun`),
            svgName, { timeout: 15_000 },
        );

        const [pngName, png] = await save(page, menu, entries[1]);
        assert.equal(pngName, `${name}.png`);
        assert.deepEqual([...png.subarray(0, 4)], [0x89, 0x50, 0x4e, 0x47]);
        assert.deepEqual([png.readUInt32BE(16), png.readUInt32BE(20)], drawn.size.map((side) => 2 * side));
        const { count } = await colours(page, png);
        assert.ok(count > 20, `${count} colours`);
    }
}, { timeout: 120_000 });

browserTest("the robot's picture has the map, and is dark where the page is", async ({ open }) => {
    const page = await open("", { viewport: { width: 1280, height: 800 }, colorScheme: "dark" });
    await started(page);
    await press(page, "Map", "button");
    await find(page, "Go to the lowest", "button", { timeout: 60_000 });
    const [, svg] = await save(page, "More", "Robot as SVG");
    const drawn = await drawing(page, svg.toString());
    assert.ok(drawn.image, "the map is an image in it");
    assert.ok(drawn.texts.includes("Critical speed, m/s"), `${drawn.texts}`);
    const ground = svg.toString().match(/<rect[^>]*fill="#([0-9a-f]{6})"/)[1];
    assert.ok(Number.parseInt(ground.slice(0, 2), 16) < 0x40, ground);
}, { timeout: 120_000 });
