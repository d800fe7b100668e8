// What is around the answer, where a browser has a say in it: addresses, files, storage, the clipboard, sound, movement.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import {
    browserTest, choose, clickCanvas, colours, dragPlatform as drag, find, gone, press, screenshot, started, type, valueOf,
    waitForAnalysis,
} from "./harness.mjs";

const scenario = (page) => page.evaluate(() => window.tautline.scenario());
const notice = (page) => page.locator("#tautline-notice").textContent();

/** Grabs the platform and lets go of it elsewhere. */
async function dragPlatform(page, by) {
    await drag(page, ...by);
    await page.waitForFunction(() => window.tautline.scenario().motion.position[0] !== 0);
    await waitForAnalysis(page, (analysis) => analysis.current, { timeout: 30_000 });
}

async function waitForScenario(page, predicate, argument) {
    await page.waitForFunction(predicate, argument, { timeout: 30_000 });
    await waitForAnalysis(page, (analysis) => analysis.current, { timeout: 30_000 });
}

browserTest("known numbers are computed and compared on the page", async ({ open }) => {
    const page = await open();
    await started(page);
    await choose(page, "More", "Validation");
    await page.waitForFunction(() => /checks pass/.test(document.getElementById("tautline-notice").textContent), undefined, { timeout: 60_000 });
    const [, passed, all] = (await notice(page)).match(/^(\d+) of (\d+) checks pass\.$/).map(Number);
    assert.ok(passed === all && all > 20, await notice(page));
    await screenshot(page, "validation");
}, { timeout: 120_000 });

browserTest("a drag is undone and redone by keys, and the robot survives a reload", async ({ open }) => {
    const page = await open();
    await started(page);
    await dragPlatform(page, [60, -30]);
    const dragged = await scenario(page);
    await page.keyboard.press("Control+z");
    await waitForScenario(page, () => window.tautline.scenario().motion.position[0] === 0);
    await page.keyboard.press("Control+Shift+z");
    await waitForScenario(page, () => window.tautline.scenario().motion.position[0] !== 0);
    assert.deepEqual(await scenario(page), dragged);
    await page.waitForTimeout(1500);
    await page.reload();
    await started(page);
    assert.deepEqual(await scenario(page), dragged);
}, { timeout: 120_000 });

browserTest("two tabs keep a robot each, and a new one begins with the last one used", async ({ open }) => {
    const first = await open();
    await started(first);
    const load = async (page, gravity) => {
        await page.evaluate((gravity) => window.tautline.load({ ...window.tautline.scenario(), gravity }), gravity);
        await waitForScenario(page, (gravity) => window.tautline.scenario().gravity === gravity, gravity);
        // Written down within 0.1 s (docs/testing.md).
        await page.waitForTimeout(500);
    };
    const another = async () => {
        const page = await first.context().newPage();
        await page.goto(first.url());
        await started(page);
        return page;
    };
    const gravity = async (page) => (await scenario(page)).gravity;
    const reload = async (page) => {
        await page.reload();
        await started(page);
        return gravity(page);
    };
    await load(first, 1);
    const second = await another();
    assert.equal(await gravity(second), 1, "a new tab begins with the last one used");
    await load(first, 2);
    assert.equal(await reload(second), 1, "also one in which nothing was changed keeps its own");
    await load(second, 3);
    assert.equal(await reload(first), 2);
    assert.equal(await reload(second), 3);
    await load(first, 4);
    assert.equal(await gravity(await another()), 4);
    // Coming back to a tab makes it the one used last, also without a change.
    await second.evaluate(() => document.activeElement.blur());
    await second.waitForTimeout(300);
    await clickCanvas(second);
    await second.waitForTimeout(500);
    assert.equal(await gravity(await another()), 3);
    // Its memory may be taken away, as private windows do; then the shared one serves.
    const blocked = await first.context().newPage();
    await blocked.addInitScript(() => {
        Object.defineProperty(window, "sessionStorage", { get() { throw new DOMException("blocked", "SecurityError"); } });
    });
    await blocked.goto(first.url());
    await started(blocked);
    await load(blocked, 5);
    assert.equal(await reload(blocked), 5);
    assert.doesNotMatch(await notice(blocked), /not kept/);
}, { timeout: 300_000 });

browserTest("a link carries the robot to another page", async ({ open }) => {
    const page = await open("", { permissions: ["clipboard-read", "clipboard-write"] });
    await started(page);
    await dragPlatform(page, [60, -30]);
    const sent = await scenario(page);
    await choose(page, "Share", "Copy link");
    await page.waitForFunction(() => document.getElementById("tautline-notice").textContent.includes("clipboard"));
    const link = await page.evaluate(() => navigator.clipboard.readText());
    assert.ok(link.includes("#s=") && link.length < 300, link);

    const other = await open("", { hash: new URL(link).hash });
    await started(other);
    assert.deepEqual(await scenario(other), sent);
    // What is done from now on is not undone by a reload.
    assert.equal(await other.evaluate(() => location.hash), "");
    await other.evaluate(() => window.tautline.load({ ...window.tautline.scenario(), gravity: 1.62 }));
    await waitForScenario(other, () => window.tautline.scenario().gravity === 1.62);
    await other.waitForTimeout(1500);
    await other.reload();
    await started(other);
    assert.equal((await scenario(other)).gravity, 1.62);
    // Going to a link without loading the page anew.
    await other.evaluate((hash) => { location.hash = hash; }, new URL(link).hash);
    await waitForScenario(other, () => window.tautline.scenario().gravity === 9.81);
    assert.deepEqual(await scenario(other), sent);

    const damaged = await open("", { hash: new URL(link).hash.slice(0, -4) });
    await started(damaged);
    assert.match(await notice(damaged), /damaged/);
    assert.deepEqual((await scenario(damaged)).motion.position, [0, 0]);
    await screenshot(damaged, "damaged link");
}, { timeout: 180_000 });

browserTest("scenario files are opened, dropped and saved", async ({ open }) => {
    const page = await open();
    await started(page);
    const other = { ...(await scenario(page)), name: "From a file", gravity: 3.71 };
    const file = { name: "mars.json", mimeType: "application/json", buffer: Buffer.from(JSON.stringify(other)) };
    await clickCanvas(page);
    const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.keyboard.press("Control+o")]);
    await chooser.setFiles(file);
    await waitForScenario(page, () => window.tautline.scenario().name === "From a file");
    assert.deepEqual(await scenario(page), other);

    const [saved] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("Control+s")]);
    assert.equal(saved.suggestedFilename(), "from-a-file.json");
    assert.deepEqual(JSON.parse(await readFile(await saved.path(), "utf8")), other);

    const drop = (name, text) => page.evaluate(([name, text]) => {
        const data = new DataTransfer();
        data.items.add(new File([typeof text === "string" ? text : new Uint8Array(text)], name));
        const target = document.getElementById("tautline-canvas");
        for (const kind of ["dragover", "drop"]) {
            target.dispatchEvent(new DragEvent(kind, { dataTransfer: data, bubbles: true, cancelable: true }));
        }
    }, [name, text]);
    await drop("moon.json", JSON.stringify({ ...other, name: "Dropped", gravity: 1.62 }));
    await waitForScenario(page, () => window.tautline.scenario().name === "Dropped");
    const wide = Buffer.from(`\ufeff${JSON.stringify({ ...other, name: "Größe" })}`, "utf16le");
    await drop("windows.json", [...wide]);
    await waitForScenario(page, () => window.tautline.scenario().name === "Größe");
    await drop("latin.json", [...Buffer.from('{ "name": "Größe" }', "latin1")]);
    await page.waitForFunction(() => document.getElementById("tautline-notice").textContent.includes("latin.json is not UTF-8: the byte 0xF6"));
    // Sizes are asked before anything is read.
    await page.evaluate(() => { Blob.prototype.arrayBuffer = () => Promise.reject(new Error("was read")); });
    await drop("film.json", " ".repeat(1_000_001));
    await page.waitForFunction(() => document.getElementById("tautline-notice").textContent.includes("film.json is larger than 1 MB"));
    await page.reload();
    await started(page);
    await drop("bad.json", JSON.stringify({ ...other, platform: { mass: -1 } }));
    await page.waitForFunction(() => document.getElementById("tautline-notice").textContent.includes("platform.mass"));
    assert.equal((await scenario(page)).name, "Größe", "the last good robot stays");
}, { timeout: 120_000 });

browserTest("numbers and pictures are saved", async ({ open }) => {
    const page = await open();
    await started(page);
    const save = async (menu, entry) => {
        await press(page, menu, "button");
        await find(page, entry);
        const [saved] = await Promise.all([page.waitForEvent("download"), press(page, entry)]);
        return [saved.suggestedFilename(), await readFile(await saved.path())];
    };
    const [name, csv] = await save("More", "Save modes as CSV");
    assert.equal(name, "paper-robot-modes.csv");
    const rows = csv.toString().trim().split("\r\n").map((row) => row.split(","));
    assert.deepEqual(rows[0].slice(0, 4), ["real", "imaginary", "multiplicity", "frequency_hz"]);
    const { eigenvalues } = await page.evaluate(() => window.tautline.analysis());
    // Every conjugate pair has one row, and says how often it comes.
    const counted = rows.slice(1).reduce((sum, row) => sum + Number(row[2]) * (Number(row[1]) > 0 ? 2 : 1), 0);
    assert.equal(counted, eigenvalues.length);
    const known = new Set(eigenvalues.map(([re, im]) => `${re} ${Math.abs(im)}`));
    assert.ok(rows.slice(1).every((row) => known.has(`${Number(row[0])} ${Number(row[1])}`)), csv.toString());

    for (const [menu, entry, expected, smallest] of [
        ["More", "Robot as PNG", "paper-robot-canvas.png", 400],
        ["More for Eigenvalues", "Picture (PNG)", "paper-robot-eigenvalues.png", 200],
    ]) {
        const [name, png] = await save(menu, entry);
        assert.equal(name, expected);
        assert.deepEqual([...png.subarray(0, 4)], [0x89, 0x50, 0x4e, 0x47]);
        const [width, height] = [png.readUInt32BE(16), png.readUInt32BE(20)];
        assert.ok(width > smallest && height > smallest, `${width} × ${height}`);
        const { count } = await colours(page, png);
        assert.ok(count > 10, `${count} colours`);
    }
}, { timeout: 120_000 });

browserTest("the robot's name is edited in its menu and stands in the tab's title", async ({ open }) => {
    const page = await open();
    await started(page);
    assert.equal(await page.title(), "Paper robot – Tautline");
    await press(page, "Robot", "combobox");
    await type(page, "Robot's name", "My robot", { role: "textbox" });
    await page.waitForFunction(() => window.tautline.scenario().name === "My robot");
    await page.waitForFunction(() => document.title === "My robot – Tautline");
    await page.keyboard.press("Escape");
    await gone(page, "Robot's name", "textbox");
    await press(page, "Undo", "button");
    await page.waitForFunction(() => window.tautline.scenario().name === "Paper robot");
});

browserTest("what runs can be stopped", async ({ open }) => {
    const page = await open();
    await started(page);
    await press(page, "Pause", "button");
    await press(page, "Play", "button");
    await press(page, /^Mode at 11\.\d/);
    await valueOf(page, /^Mode at 11\.\d/, undefined, (value) => value === true || value === undefined);
    await press(page, /^Let go at 5/);
});

browserTest("first visitors are shown around, once", async ({ open }) => {
    const page = await open("", { tour: true });
    await started(page);
    await page.waitForFunction(() => document.getElementById("tautline-notice").textContent.length > 20);
    await screenshot(page, "tour");
    await page.keyboard.press("Escape");
    await page.waitForFunction(() => document.getElementById("tautline-notice").textContent === "");
    await page.waitForTimeout(3000);
    await page.reload();
    await started(page);
    assert.equal(await notice(page), "");
}, { timeout: 120_000 });

browserTest("nothing moves by itself for those who do not want it", async ({ open }) => {
    const moves = async (reducedMotion) => {
        const page = await open("", { reducedMotion });
        await started(page);
        await page.waitForTimeout(2000);
        const before = await page.screenshot();
        await page.waitForTimeout(700);
        return !before.equals(await page.screenshot());
    };
    assert.equal(await moves("reduce"), false);
    assert.equal(await moves("no-preference"), true);
}, { timeout: 120_000 });

browserTest("the mode's frequency sounds when it is asked to", async ({ open }) => {
    const page = await open("", {
        before: (page) => page.addInitScript(() => {
            window.heard = [];
            const set = AudioParam.prototype.setTargetAtTime;
            AudioParam.prototype.setTargetAtTime = function (value, ...rest) {
                window.heard.push(value);
                return set.call(this, value, ...rest);
            };
        }),
    });
    await started(page);
    assert.deepEqual(await page.evaluate(() => window.heard), [], "silent until asked");
    await press(page, /^Mode at 11\.3 m\/s$/, "radio");
    await page.waitForTimeout(500);
    await press(page, "Sound");
    await page.waitForFunction(() => window.heard.length >= 2);
    const { critical } = await page.evaluate(() => window.tautline.analysis());
    const [frequency, volume] = await page.evaluate(() => window.heard);
    assert.ok(Math.abs(frequency / Math.cbrt(critical.frequency_hz) - 200) < 0.01, `${frequency} Hz`);
    assert.ok(volume > 0 && volume < 0.2, `volume ${volume}`);
    await press(page, "Sound");
    await page.waitForFunction(() => window.heard.at(-1) === 0);
}, { timeout: 120_000 });

browserTest("a screen reader is told the robot and its results", async ({ open }) => {
    const page = await open();
    await started(page);
    const details = () => page.locator("#tautline-details li").allTextContents();
    const summary = () => page.locator("#tautline-summary").textContent();
    /** The number in the summary, which shows the digits that are certain, is that of the analysis. */
    const told = (text, exact) => {
        const [, number, decimals = ""] = /Critical speed (\d+(?:\.(\d+))?) metres per second/.exec(text) ?? [];
        return Math.abs(Number(number) - exact) <= 0.5001 * 10 ** -decimals.length;
    };
    const first = await page.evaluate(() => window.tautline.analysis());
    await page.locator("#tautline-summary").filter({ hasText: "Critical speed 11.3 metres per second" }).waitFor({ state: "attached" });
    assert.ok(told(await summary(), first.critical.speed) && Math.abs(first.critical.speed - 11.299) < 1e-3);
    // The list has the plots' findings as well, and comes when those rest.
    const listed = (text) => page.locator("#tautline-details li").filter({ hasText: text }).first().waitFor({ state: "attached" });
    await listed("Stable at this speed");
    assert.match((await details()).join(" "), /Paper robot with 4 cables\..*Stable at this speed/);
    await press(page, "Keep", "button");
    await page.waitForTimeout(1500);
    await dragPlatform(page, [60, -30]);
    const { critical } = await page.evaluate(() => window.tautline.analysis());
    for (let waited = 0; waited < 10_000 && !told(await summary(), critical.speed); waited += 100) {
        await page.waitForTimeout(100);
    }
    assert.ok(told(await summary(), critical.speed), `${await summary()}: ${critical.speed}`);
    await listed(/Against design A: -\d/);
    assert.match((await details()).join(" "), /Against design A: -\d(\.\d+)? metres per second/);
    await screenshot(page, "design");
}, { timeout: 120_000 });
