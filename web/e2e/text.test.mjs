// The text version: a form and tables, by keyboard, without WebGL, without a network, and what axe-core says of it.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import axe from "axe-core";
import {
    browserTest, commandLine, DIST, find, press, publish, screenshot, started, waitForAnalysis, waitForStart,
} from "./harness.mjs";

// A page that is left while its workers load.
const ALLOW = [/ERR_ABORTED/];
const PATIENT = { timeout: 180_000, allow: ALLOW };

/** Waits until the results are those of the form, and gives the sentence. */
async function answered(page, sentence = /./) {
    await page.waitForFunction(([source]) => document.getElementById("state").textContent === ""
        && !document.getElementById("answer").classList.contains("stale")
        && new RegExp(source).test(document.getElementById("answer").textContent), [sentence.source], { timeout: 60_000 });
    return page.locator("#answer").innerText();
}

async function openText(open, options = {}) {
    const page = await open("text.html", options);
    await answered(page);
    return page;
}

/** The number in a row of the table of the critical point. */
async function criticalSpeed(page) {
    const row = page.getByRole("row", { name: /^Critical speed as computed/ });
    return Number.parseFloat(await row.getByRole("cell").innerText());
}

/** What the form holds, as the drawing's link has it. */
const hashOf = async (page) => new URL(await page.getByRole("link", { name: "Open this robot in the drawing" }).evaluate((link) => link.href)).hash;

/** What the app says to the robot on the text version. */
async function inTheApp(open, hash) {
    const app = await open("", { hash });
    const analysis = await started(app);
    return { analysis, scenario: await app.evaluate(() => window.tautline.scenario()) };
}

async function hasNoFindings(page, what) {
    await page.evaluate(axe.source);
    const violations = await page.evaluate(async () => (await window.axe.run(document, {
        runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"],
    })).violations.map(({ id, help, nodes }) => `${id}: ${help}: ${nodes.map(({ html }) => html).join(" ")}`));
    assert.deepEqual(violations, [], what);
}

const field = (page, name) => page.getByLabel(name, { exact: true });
const cable = (page, number) => page.getByRole("group", { name: `Cable ${number}`, exact: true });

for (const colorScheme of ["light", "dark"]) {
    browserTest(`axe-core finds nothing (${colorScheme})`, async ({ open }) => {
        const page = await openText(open, { colorScheme });
        await hasNoFindings(page, "with results");
        await screenshot(page, `text ${colorScheme}`, { fullPage: true });

        await page.getByRole("button", { name: /^Show all \d+ modes$/ }).click();
        await field(page, "Platform mass m in kg").fill("-2");
        await cable(page, 2).getByLabel("Winch point x in m").fill("-10");
        await page.getByRole("link", { name: "Platform mass m" }).waitFor();
        await hasNoFindings(page, "with errors");
        await screenshot(page, `text errors ${colorScheme}`, { fullPage: true });

        await field(page, "Platform mass m in kg").fill("2");
        await cable(page, 2).getByLabel("Winch point x in m").fill("10");
        await field(page, "Position x in m").fill("9.9");
        assert.match(await answered(page, /equilibrium/), /cable 1 would have to push/);
        await hasNoFindings(page, "without an equilibrium");
    }, PATIENT);
}

browserTest("by keyboard alone a number is changed and the new critical speed read", async ({ open }) => {
    const page = await openText(open);
    const before = await answered(page);
    assert.match(before, /^Flutter of 0\.272 Hz in cable 4 begins at the critical speed, 11\.3 m\/s; at 5 m\/s the robot is stable, 56 % below it; /);
    // Independent figures: docs/theory.md, reference numbers.
    assert.ok(Math.abs(await criticalSpeed(page) - 11.299) < 1e-3);
    const label = () => page.evaluate(() => document.activeElement.labels?.[0]?.textContent ?? "");
    let presses = 0;
    while (await label() !== "Young's modulus E in Pa" && presses++ < 40) await page.keyboard.press("Tab");
    assert.equal(await label(), "Young's modulus E in Pa", `after ${presses} times Tab`);
    await page.keyboard.press("ControlOrMeta+A");
    await page.keyboard.type("2,5e8");
    await page.waitForFunction((old) => document.getElementById("answer").textContent !== old, before, { timeout: 60_000 });
    await answered(page);

    const { analysis, scenario } = await inTheApp(open, await hashOf(page));
    assert.equal(scenario.cable.youngs_modulus, 2.5e8);
    assert.ok(Math.abs(await criticalSpeed(page) - analysis.critical.speed) <= 1e-9, `${await criticalSpeed(page)}`);
    assert.ok(Math.abs(analysis.critical.speed - commandLine(scenario).critical.speed) <= 1e-6);
}, PATIENT);

browserTest("the robot goes from the app to the text version and back", async ({ open }) => {
    const page = await open();
    await started(page);
    const first = await page.evaluate(() => window.tautline.scenario());
    const robot = { ...first, name: "Ängste & Co", platform: { mass: 1 / 3 }, motion: { ...first.motion, position: [1.25, -0.5] } };
    await page.evaluate((json) => window.tautline.load(json), JSON.stringify(robot));
    await waitForAnalysis(page);
    await press(page, "More", "button");
    await find(page, "Text version");
    // The page is left, so the press does not see its end.
    await Promise.all([page.waitForURL(/text\.html#s=/), press(page, "Text version").catch(() => {})]);
    await answered(page);
    assert.equal(await field(page, "Name").inputValue(), "Ängste & Co");
    assert.equal(await field(page, "Platform mass m in kg").inputValue(), String(1 / 3));

    await field(page, "Speed v in m/s").fill("3.5");
    await answered(page, /at 3\.5 m\/s/);
    await page.reload();
    await answered(page, /at 3\.5 m\/s/);
    await page.getByRole("link", { name: "Open this robot in the drawing" }).click();
    await started(page);
    assert.deepEqual(await page.evaluate(() => window.tautline.scenario()), { ...robot, motion: { ...robot.motion, speed: 3.5 } });
}, PATIENT);

browserTest("the first link of the app opens the robot on show", async ({ open }) => {
    const page = await open();
    await started(page);
    const first = await page.evaluate(() => window.tautline.scenario());
    await page.evaluate((json) => window.tautline.load(json), JSON.stringify({ ...first, name: "Kept" }));
    await waitForAnalysis(page);
    await page.waitForFunction(() => sessionStorage.getItem("tautline-scenario")?.includes("Kept"));
    await page.getByRole("link", { name: /^Text version/ }).focus();
    await page.keyboard.press("Enter");
    await page.waitForURL(/text\.html/);
    await answered(page);
    assert.equal(await field(page, "Name").inputValue(), "Kept");
}, PATIENT);

browserTest("a browser without WebGL is led to the text version, with the robot of the link", async ({ open }) => {
    const source = await openText(open);
    await field(source, "Gravity g in m/s²").fill("1.62");
    await answered(source, /./);
    await source.waitForFunction(() => document.getElementById("answer").textContent.includes("begins"));
    const page = await open("", {
        hash: await hashOf(source),
        before: (page) => page.addInitScript(() => { HTMLCanvasElement.prototype.getContext = () => null; }),
    });
    await page.locator("#tautline-error").getByRole("link", { name: "Open the text version" }).click();
    await page.waitForURL(/text\.html#s=/);
    await answered(page);
    assert.equal(await field(page, "Gravity g in m/s²").inputValue(), "1.62");
}, PATIENT);

browserTest("a value that is not allowed is told with what is, beside its field and in a list that leads there", async ({ open }) => {
    const page = await openText(open);
    const before = await criticalSpeed(page);
    const mass = field(page, "Platform mass m in kg");
    await mass.fill("-2");
    const alert = page.getByRole("alert");
    await alert.getByRole("link", { name: "Platform mass m" }).waitFor();
    assert.match(await alert.innerText(), /“-2” is not allowed\. Allowed: a finite number greater than 0\./);
    assert.equal(await mass.getAttribute("aria-invalid"), "true");
    const described = await mass.evaluate((input) => input.getAttribute("aria-describedby").split(" ")
        .map((id) => document.getElementById(id).textContent).join(" "));
    assert.match(described, /More than 0\..*“-2” is not allowed/);
    await alert.getByRole("link", { name: "Platform mass m" }).click();
    assert.ok(await mass.evaluate((input) => document.activeElement === input));
    assert.equal(await criticalSpeed(page), before, "the last results stay");

    // Neither 1.234 nor 1234 without being asked for; words; nothing at all; a winch on another one.
    for (const [text, told] of [["1,234", /may be 1\.234 or 1234/], ["two", /“two” is not allowed/], ["", /Nothing is entered/]]) {
        await mass.fill(text);
        await page.waitForFunction((source) => new RegExp(source).test(document.getElementById("faults").textContent), told.source);
    }
    await mass.fill("2,5");
    await alert.getByText(/correct/).waitFor({ state: "detached" });
    assert.equal(await mass.getAttribute("aria-invalid"), null);
    await cable(page, 2).getByLabel("Winch point x in m").fill("-10");
    await alert.getByText(/differs from the winch point of cable 1/).waitFor();
    await cable(page, 2).getByLabel("Winch point x in m").fill("10");
    await alert.getByText(/correct/).waitFor({ state: "detached" });
    await cable(page, 1).getByLabel("Tension", { exact: true }).selectOption({ label: "Constant" });
    await alert.getByText(/exactly two/).waitFor();
    const { analysis, scenario } = await inTheApp(open, await hashOf(page));
    assert.equal(scenario.platform.mass, 2.5);
    assert.ok(Math.abs(analysis.critical.speed - await criticalSpeed(page)) <= 1e-9);
}, PATIENT);

browserTest("a cable gets a material of its own and loses it", async ({ open }) => {
    const page = await openText(open);
    const before = await criticalSpeed(page);
    await page.getByRole("button", { name: "Own material for cable 4" }).click();
    await cable(page, 4).getByLabel("Mass per length μ in kg/m").fill("0.5");
    await answered(page);
    const after = await criticalSpeed(page);
    assert.ok(Math.abs(after - before) > 0.01, `${before} and ${after}`);
    const { analysis, scenario } = await inTheApp(open, await hashOf(page));
    assert.equal(scenario.cables[3].cable.mass_per_length, 0.5);
    assert.ok(Math.abs(analysis.critical.speed - after) <= 1e-9);
    await page.getByRole("button", { name: "Cable 4 as all others" }).click();
    await answered(page);
    assert.equal(await criticalSpeed(page), before);
}, PATIENT);

browserTest("cables come and go, and their tensions change their kind", async ({ open }) => {
    const page = await openText(open);
    await page.getByRole("button", { name: "Add a cable" }).click();
    assert.ok(await cable(page, 5).getByLabel("Winch point x in m").evaluate((input) => document.activeElement === input));
    await cable(page, 5).getByLabel("Winch point y in m").fill("-7");
    await cable(page, 3).getByLabel("Tension", { exact: true }).selectOption({ label: "Constant" });
    await cable(page, 3).getByLabel("Constant tension in N").fill("67.3");
    await answered(page);
    await page.getByRole("region", { name: "Tensions, lengths and winches" }).getByRole("rowheader", { name: "5", exact: true }).waitFor();
    const { scenario } = await inTheApp(open, await hashOf(page));
    assert.deepEqual(scenario.cables[2].tension, { constant: 67.3 });
    assert.deepEqual(scenario.cables[4], { anchor: [0, -7], tension: { constant: 50 } });

    await page.getByRole("button", { name: "Remove cable 5" }).click();
    await page.getByRole("button", { name: "Remove cable 4" }).click();
    await answered(page);
    await page.getByRole("button", { name: "Remove cable 3" }).click();
    await page.getByRole("alert").getByText(/3 to \d+ cables/).waitFor();
}, PATIENT);

browserTest("robots are chosen, opened and saved", async ({ open }) => {
    const page = await openText(open);
    await page.getByLabel("Built-in robot").selectOption("lab");
    await page.getByRole("button", { name: "Start from this robot" }).click();
    await page.waitForFunction(() => document.title.startsWith("Desktop robot"));
    const download = page.waitForEvent("download");
    await page.getByRole("button", { name: "Save as file" }).click();
    const saved = await readFile(await (await download).path());
    assert.equal(JSON.parse(saved).name, "Desktop robot, thin cords");

    const file = (name, text) => ({ name, mimeType: "application/json", buffer: Buffer.from(text) });
    const chooser = page.getByLabel("Open a scenario file");
    await chooser.setInputFiles(file("bad.json", JSON.stringify({ ...JSON.parse(saved), platform: { mass: 0 } })));
    await page.getByRole("alert").getByText(/The file was not opened\. platform\.mass: 0 is not allowed/).waitFor();
    await chooser.setInputFiles(file("worse.json", "{"));
    await page.getByRole("alert").getByText(/It is not JSON/).waitFor();
    await chooser.setInputFiles(file("good.json", JSON.stringify({ ...JSON.parse(saved), name: "Mine" })));
    await page.waitForFunction(() => document.title.startsWith("Mine"));
    assert.equal(await page.getByRole("alert").innerText(), "");
}, PATIENT);

browserTest("a damaged link is told, and the paper's robot is there", async ({ open }) => {
    const page = await openText(open, { hash: "#s=1damaged" });
    assert.match(await page.getByRole("alert").innerText(), /This link is damaged/);
    assert.equal(await field(page, "Name").inputValue(), "Paper robot");
}, PATIENT);

for (const width of [320, 360, 768, 1280]) {
    browserTest(`nothing is cut off at ${width} pixels`, async ({ open }) => {
        const page = await openText(open, { viewport: { width, height: 640 } });
        const widest = await page.evaluate(() => document.documentElement.scrollWidth);
        assert.ok(widest <= width, `${widest} pixels wide`);
        // Tables too wide for the window scroll by themselves; all else is within it.
        const outside = await page.evaluate(() => [...document.querySelectorAll("input, select, button, p, a, h1, h2, h3")]
            .filter((it) => !it.closest(".scroll") && it.getBoundingClientRect().right > innerWidth + 1).map((it) => it.outerHTML));
        assert.deepEqual(outside, []);
        await screenshot(page, `text ${width}`, { fullPage: true });
    }, PATIENT);
}

browserTest("after one visit the text version works without a network, and so does the app", async ({ open }) => {
    const site = await publish(DIST);
    const page = await open(`${site.address}text.html`, { serviceWorkers: "allow" });
    await answered(page);
    await page.waitForFunction(() => navigator.serviceWorker.controller?.state === "activated", undefined, { timeout: 60_000 });
    await site.stop();
    await page.context().setOffline(true);
    await page.reload();
    assert.match(await answered(page), /11\.3 m\/s/);
    await field(page, "Young's modulus E in Pa").fill("2.5e8");
    await page.waitForFunction(() => !document.getElementById("answer").textContent.includes("11.3"), undefined, { timeout: 60_000 });
    await page.goto(site.address);
    await waitForStart(page, { timeout: 60_000 });
}, { ...PATIENT, allow: [...ALLOW, /ERR_INTERNET_DISCONNECTED/, /ERR_CONNECTION_REFUSED/] });
