// What makes a robot one's own: ropes, cables from a spreadsheet, materials of single cables, hints.
import assert from "node:assert/strict";
import {
    browserTest, choose, clickCanvas, find, isThere, press, screenshot, started, type, valueOf, waitForAnalysis,
} from "./harness.mjs";

const scenario = (page) => page.evaluate(() => window.tautline.scenario());
const notice = (page) => page.locator("#tautline-notice").textContent();
const CONTROLS = { within: "Controls" };

/** Waits until what the page shows is accepted and computed; returns it. */
async function changed(page, predicate, argument) {
    await page.waitForFunction(predicate, argument, { timeout: 30_000 });
    await waitForAnalysis(page, (analysis) => analysis.current, { timeout: 30_000 });
    return scenario(page);
}

/** Scrolls the controls until it is there. */
async function scrollTo(page, label, role) {
    const { rect: [x, y, width, height] } = await find(page, "Controls", "region");
    await page.mouse.move(x + 0.5 * width, y + 0.5 * height);
    for (let turns = 0; turns < 30; turns++) {
        const there = await isThere(page, label, role, CONTROLS);
        if (there) {
            const { rect: [, top, , tall] } = await find(page, label, role, CONTROLS);
            if (top >= y - 1 && top + tall <= y + height + 1) return;
        }
        await page.mouse.wheel(0, turns < 20 ? 120 : -240);
        await page.waitForTimeout(150);
    }
}

async function pressThere(page, label, role) {
    await scrollTo(page, label, role);
    await press(page, label, role, CONTROLS);
}

/** Chooses an entry of a list among the controls. */
async function select(page, list, entry) {
    await pressThere(page, list, "combobox");
    await press(page, entry);
}

/** Pastes a text as Ctrl+V does. */
async function paste(page, text) {
    await page.evaluate((text) => navigator.clipboard.writeText(text), text);
    await clickCanvas(page);
    await page.keyboard.press("ControlOrMeta+v");
}

/** Takes so many steps back, one after the other: two presses within one frame are one. */
async function undo(page, steps) {
    for (let i = 0; i < steps; i++) {
        const before = JSON.stringify(await scenario(page));
        await page.keyboard.press("Control+z");
        await page.waitForFunction((before) => JSON.stringify(window.tautline.scenario()) !== before, before);
    }
}

const CLIPBOARD = { permissions: ["clipboard-read", "clipboard-write"] };
const TABLE = [
    "x\ty\ttension", "-9,5\t5\tbalances", "9,5\t5\tbalances", "-9,5\t-5\t70", "9,5\t-5\t80", "0\t-6\t60", "",
].join("\r\n");

browserTest("a rope sets E, A and μ at once and is known by them", async ({ open }) => {
    const page = await open();
    await started(page);
    await pressThere(page, "Rope", "button");
    await select(page, "Construction", "steel 6×19");
    await changed(page, () => window.tautline.scenario().cable.youngs_modulus === 74.5e9);
    await scrollTo(page, "Diameter d", "spinbutton");
    await type(page, "Diameter d", "6", CONTROLS);
    const { cable } = await changed(page, () => window.tautline.scenario().cable.area < 2e-5);
    // EN 12385-4: 0.357 · 36 mm², 0.346 · 36 kg per 100 m.
    assert.ok(Math.abs(cable.area / 12.852e-6 - 1) < 1e-9 && Math.abs(cable.mass_per_length / 0.12456 - 1) < 1e-9, JSON.stringify(cable));
    await valueOf(page, "Construction", "combobox", (value) => value === "steel 6×19", CONTROLS);
    await screenshot(page, "rope");
    await clickCanvas(page);
    await undo(page, 2);
    await changed(page, () => window.tautline.scenario().cable.youngs_modulus === 125e6);
}, { timeout: 120_000 });

browserTest("cables come from a spreadsheet and go to one", async ({ open }) => {
    const page = await open("", CLIPBOARD);
    await started(page);
    const before = await scenario(page);
    await paste(page, TABLE);
    const pasted = await changed(page, () => window.tautline.scenario().cables.length === 5);
    assert.deepEqual(pasted.cables[4], { anchor: [0, -6], tension: { constant: 60 } });
    assert.match(await notice(page), /5 cables are taken from the table/);
    await pressThere(page, "Copy the cables", "button");
    await page.waitForFunction(() => document.getElementById("tautline-notice").textContent.includes("The table of cables is on the clipboard"));
    const copied = await page.evaluate(() => navigator.clipboard.readText());
    assert.equal(copied.split("\n")[5], "5\t0\t-6\t60");
    // The same by the button, with one value changed.
    await page.evaluate((text) => navigator.clipboard.writeText(text), copied.replace("\t60", "\t65"));
    await pressThere(page, "Paste cables", "button");
    await changed(page, () => window.tautline.scenario().cables[4].tension.constant === 65);
    // What is wrong is told, and nothing changes.
    await paste(page, TABLE.replace("-6", "six"));
    await page.waitForFunction(() => /Row 6, column y: "six" must be a number in m/.test(document.getElementById("tautline-notice").textContent));
    assert.equal((await scenario(page)).cables[4].tension.constant, 65);
    await undo(page, 2);
    assert.deepEqual(await changed(page, () => window.tautline.scenario().cables.length === 4), before);
}, { timeout: 120_000 });

browserTest("where the page may not read the clipboard, the button says which keys do it", async ({ open }) => {
    const page = await open();
    await started(page);
    const session = await page.context().newCDPSession(page);
    const { targetInfo: { browserContextId } } = await session.send("Target.getTargetInfo");
    const origin = new URL(page.url()).origin;
    await session.send("Browser.setPermission", { permission: { name: "clipboard-read" }, setting: "denied", origin, browserContextId });
    await pressThere(page, "Paste cables", "button");
    await page.waitForFunction(() => /does not let the page read the clipboard\. Press .*V/.test(document.getElementById("tautline-notice").textContent));
}, { timeout: 120_000 });

browserTest("a material of one cable changes the critical speed and is in the link", async ({ open }) => {
    const page = await open("", CLIPBOARD);
    const { critical: { speed: before } } = await started(page);
    await pressThere(page, "Cable 3", "button");
    await pressThere(page, "Own material", "checkbox");
    await changed(page, () => window.tautline.scenario().cables[2].cable !== undefined);
    await scrollTo(page, "μ of cable 3", "spinbutton");
    await type(page, "μ of cable 3", "0.6", CONTROLS);
    const sent = await changed(page, () => window.tautline.scenario().cables[2].cable?.mass_per_length === 0.6);
    assert.equal(sent.schema, "tautline/scenario/2");
    const { critical: { speed: after } } = await waitForAnalysis(page, (analysis) => analysis.current);
    assert.ok(Math.abs(after - before) > 0.01 * before, `${before} ${after}`);
    await valueOf(page, "Cable 3", "button", (value) => /own material/.test(value), CONTROLS);
    await screenshot(page, "own material");
    await choose(page, "Share", "Copy link");
    await page.waitForFunction(() => document.getElementById("tautline-notice").textContent.includes("The link is on the clipboard"));
    const link = await page.evaluate(() => navigator.clipboard.readText());
    const other = await open("", { hash: new URL(link).hash });
    await started(other);
    assert.deepEqual(await scenario(other), sent);
}, { timeout: 120_000 });

browserTest("a hint stands at the end of the controls and leads to its number", async ({ open }) => {
    const page = await open();
    await started(page);
    await type(page, "Young's modulus E", "125 Pa");
    await changed(page, () => window.tautline.scenario().cable.youngs_modulus === 125);
    await scrollTo(page, "Plausible?", "button");
    assert.match((await find(page, "Plausible?", "button", CONTROLS)).value, /hint/);
    await press(page, "Plausible?", "button", CONTROLS);
    await pressThere(page, "E is 125 Pa: MPa meant?", "button");
    await find(page, "Young's modulus E", "spinbutton", CONTROLS);
    await screenshot(page, "hint");
}, { timeout: 120_000 });
