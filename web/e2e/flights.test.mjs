// A path is added and flown; what the flight finds is told; limits give the fastest move; a link carries the path.
import assert from "node:assert/strict";
import { browserTest, choose, find, gone, layout, matching, press, reveal, started, type, valueOf } from "./harness.mjs";

const scenario = (page) => page.evaluate(() => window.tautline.scenario());

/** The paper's robot with a path straight across, from x = −6 m to 6 m; a quintic unless it is said otherwise. */
async function across(page, speed) {
    const robot = await scenario(page);
    robot.motion.position = [-6, robot.motion.position[1]];
    robot.path = { points: [[6, robot.motion.position[1]]], profile: "quintic", speed };
    robot.schema = "tautline/scenario/2";
    await page.evaluate((json) => window.tautline.load(json), JSON.stringify(robot));
    await page.waitForFunction((speed) => window.tautline.scenario().path?.speed === speed, speed);
    return robot.path;
}

/** Chooses what the transport moves, or presses the one button "Fly". */
async function fly(page) {
    await press(page, "Fly", /^(button|radio)$/);
    return find(page, "Time of the flight", "slider", { timeout: 60_000 });
}

/** A test that begins with the page started. */
const flightTest = (name, body) => browserTest(name, async ({ open, ...rest }) => {
    const page = await open();
    await started(page);
    await reveal(page, "Path", "button");
    await body({ page, open, ...rest });
}, { timeout: 180_000 });

const telling = async (page) => (await layout(page)).map(({ label }) => label).join("\n");

flightTest("a path is added, flown and scrubbed through", async ({ page }) => {
    await press(page, "Path", "button", { within: "Controls" });
    await press(page, "Add a path", "button");
    await page.waitForFunction(() => window.tautline.scenario().path?.points.length === 1);
    await find(page, "Path end", undefined, { within: "Canvas" });
    const { rect: [x, y, width, height] } = await fly(page);
    // The flight plays until somebody takes hold of its time.
    const time = () => valueOf(page, "Time of the flight", "slider").then(Number);
    await page.mouse.click(x + 0.25 * width, y + height / 2);
    const early = await time();
    await page.mouse.click(x + 0.75 * width, y + height / 2);
    const late = await time();
    assert.ok(late > 2 * early && early > 0, `${early} s, then ${late} s`);
    await page.waitForTimeout(500);
    assert.equal(await time(), late, "it rests where it was put");
    await press(page, "Play", "button");
    await page.waitForTimeout(500);
    assert.notEqual(await time(), late, "it plays on");
});

flightTest("a flight at 8 m/s tells which cable goes slack, a slow one that none does", async ({ page }) => {
    await across(page, 1);
    await fly(page);
    await page.waitForFunction(() => window.tautline.layout().some(({ label }) => /no cable goes slack/.test(label)), undefined, { timeout: 60_000 });
    await across(page, 8);
    await page.waitForFunction(() => window.tautline.layout().some(({ label }) => /doubtful from there/.test(label)), undefined, { timeout: 60_000 });
    assert.doesNotMatch(await telling(page), /no cable goes slack/);
});

flightTest("the fastest move within limits is taken over, and undone", async ({ page }) => {
    const { speed } = await across(page, 5);
    await press(page, "Path", "button", { within: "Controls" });
    await press(page, "Fastest allowed", "button");
    await press(page, "Use it", "button", { timeout: 60_000 });
    await page.waitForFunction((speed) => window.tautline.scenario().path.speed !== speed, speed);
    await page.keyboard.press("Escape");
    await gone(page, "Use it", "button");
    await press(page, "Undo", "button", { within: "Bar" });
    await page.waitForFunction((speed) => window.tautline.scenario().path.speed === speed, speed);
});

flightTest("a link carries the path, and the peak speed is typed", async ({ page, open }) => {
    await across(page, 5);
    await press(page, "Path", "button", { within: "Controls" });
    await type(page, "Peak speed v", "3.25");
    await page.waitForFunction(() => window.tautline.scenario().path.speed === 3.25);
    await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    await choose(page, "Share", "Copy link");
    await page.waitForFunction(() => document.getElementById("tautline-notice").textContent.includes("The link is on the clipboard"));
    const link = await page.evaluate(() => navigator.clipboard.readText());
    const other = await open("", { hash: new URL(link).hash });
    await started(other);
    assert.deepEqual((await scenario(other)).path, (await scenario(page)).path);
    assert.ok(matching(await layout(other), "Path end", undefined, "Canvas").length > 0, "it is drawn");
});
