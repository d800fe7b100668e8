// Links that carry how things are looked at, and the app in the frame of another page.
import assert from "node:assert/strict";
import {
    browserTest, centre, choose, colours, find, framed, frameOf, gone, host, isThere, layout, openPlot, PLATFORM, press,
    runCommandLine, screenshot, started, valueOf,
} from "./harness.mjs";

const scenario = (page) => page.evaluate(() => window.tautline.scenario());
const notice = (page) => page.locator("#tautline-notice").textContent();

/** The part of a link about a robot, as the command line makes it. */
function robotPart(robot) {
    const { status, stdout, stderr } = runCommandLine(["link", "-"], JSON.stringify(robot));
    assert.equal(status, 0, stderr);
    return stdout.trim();
}

/** A robot that is not the one on show at first, from an app that has just been opened. */
async function another(open) {
    const page = await open();
    await started(page);
    const robot = { ...(await scenario(page)), name: "Moon robot", gravity: 1.62 };
    await page.close();
    return robot;
}

browserTest("a link carries plot, map, panels and theme after the robot", async ({ open }) => {
    const robot = await another(open);
    const page = await open("", { hash: `${robotPart(robot)}&plot=modes&map=frequency&panels=rd&tour=0&theme=dark`, tour: true });
    await started(page);
    assert.deepEqual(await scenario(page), robot);
    await valueOf(page, "Modes", "tab", (value) => value === true, { within: "Plots" });
    await valueOf(page, "Map", "button", (value) => value === true);
    await valueOf(page, "Map quantity", undefined, (value) => /frequency/i.test(value));
    assert.equal(await isThere(page, "Controls", "region"), false, "the controls are folded");
    assert.ok(await isThere(page, "Dock", "region"), "the dock is open");
    assert.doesNotMatch(await notice(page), /Grab|drag/i, "no tour");
    const { main } = await colours(page, await screenshot(page, "link with view"));
    assert.ok(parseInt(main.slice(1, 3), 16) < 0x40, `it is dark: ${main}`);
    assert.equal(await page.evaluate(() => location.hash), "");
}, { timeout: 120_000 });

browserTest("what is unknown in a link is ignored", async ({ open }) => {
    const robot = await another(open);
    const page = await open("", { hash: `${robotPart(robot)}&plot=cake&map=&panels=q&text=9&theme=pink&future=1&&` });
    await started(page);
    assert.deepEqual(await scenario(page), robot);
    assert.equal(await notice(page), "");
    await valueOf(page, "Eigenvalues", "tab", (value) => value === true, { within: "Plots" });
    assert.ok(await isThere(page, "Controls", "region"));
}, { timeout: 120_000 });

browserTest("a link that is gone to in an open page changes robot and view", async ({ open }) => {
    const robot = await another(open);
    const page = await open();
    await started(page);
    await page.evaluate((hash) => { location.hash = hash; }, `${robotPart(robot)}&plot=modes&panels=r`);
    await page.waitForFunction(() => window.tautline.scenario().name === "Moon robot");
    await valueOf(page, "Modes", "tab", (value) => value === true, { within: "Plots" });
    await gone(page, "Controls", "region");
}, { timeout: 120_000 });

browserTest("a link with present=1 opens as a presentation, which Esc ends", async ({ open }) => {
    const robot = await another(open);
    const page = await open("", { hash: `${robotPart(robot)}&present=1` });
    await started(page);
    await page.waitForTimeout(500);
    await screenshot(page, "present");
    for (const name of ["Canvas", "Answer"]) assert.ok(await isThere(page, name, "region"), name);
    assert.equal(await isThere(page, "Controls", "region"), false);
    await page.keyboard.press("Escape");
    await find(page, "Controls", "region");
}, { timeout: 120_000 });

browserTest("Share puts a link with the view on the clipboard", async ({ open }) => {
    const permissions = ["clipboard-read", "clipboard-write"];
    const page = await open("", { permissions });
    await started(page);
    await openPlot(page, "Modes");
    await press(page, "Map", "button");
    await choose(page, "Share", "Copy link");
    await page.waitForFunction(() => /clipboard/.test(document.getElementById("tautline-notice").textContent));
    const link = await page.evaluate(() => navigator.clipboard.readText());
    assert.match(link, /#s=1[\w-]+&plot=modes&map=speed$/);
    const other = await open("", { hash: new URL(link).hash });
    await started(other);
    assert.deepEqual(await scenario(other), await scenario(page));
    await valueOf(other, "Modes", "tab", (value) => value === true, { within: "Plots" });
    await valueOf(other, "Map", "button", (value) => value === true);
}, { timeout: 120_000 });

browserTest("the embed code shows the robot in another page, without panels and tour", async ({ open }) => {
    const page = await open("", { permissions: ["clipboard-read", "clipboard-write"] });
    await started(page);
    await choose(page, "Share", "Copy embed code");
    await page.waitForFunction(() => /clipboard/.test(document.getElementById("tautline-notice").textContent));
    const code = await page.evaluate(() => navigator.clipboard.readText());
    const [, source] = /^<iframe src="([^"]+)" width="600" height="400" title="[^"]+" loading="lazy" allow="clipboard-write"><\/iframe>$/.exec(code) ?? [];
    assert.ok(source, code);
    assert.match(source, /#s=1[\w-]+(&amp;\w+=\w+)*&amp;panels=0&amp;tour=0$/);
    const { address, close } = await host(code);
    try {
        const lecture = await open(address, { tour: true });
        const frame = await frameOf(lecture, source.replaceAll("&amp;", "&"));
        assert.deepEqual(await scenario(frame), await scenario(page));
        await frame.waitForTimeout(500);
        await screenshot(lecture, "embedded");
        for (const name of ["Controls", "Plots"]) assert.equal(await isThere(frame, name, "region"), false, name);
        assert.equal(await notice(frame), "", "no tour");
        await find(frame, ...PLATFORM);
    } finally {
        await close();
    }
}, { timeout: 120_000 });

browserTest("in a frame the wheel scrolls the lecture page, and with Ctrl it zooms the robot", async ({ open, origin }) => {
    const long = '<p style="height: 2000px">A long lecture.</p>';
    const { page, frame, close } = await framed(open, origin, { before: "<h1>Lecture</h1>", after: long });
    try {
        const scrolled = () => page.evaluate(() => scrollY);
        const tip = async () => centre(await find(frame, "Velocity", "button", { within: "Canvas" }))[0] - centre(await find(frame, ...PLATFORM))[0];
        const element = await page.locator("iframe").boundingBox();
        // Over the platform, which stays under the pointer.
        const [left, top] = centre(await find(frame, ...PLATFORM));
        const [x, y] = [element.x + left, element.y + top];
        const before = await tip();
        await page.mouse.move(x, y);
        await page.mouse.wheel(0, 120);
        await page.waitForFunction(() => scrollY > 60);
        assert.ok(Math.abs(await tip() - before) < 1, "the robot stays as it is");
        await page.evaluate(() => scrollTo(0, 0));
        await page.waitForTimeout(300);
        await page.mouse.move(x + 1, y);
        await page.keyboard.down("Control");
        await page.mouse.wheel(0, -60);
        await page.keyboard.up("Control");
        await page.waitForTimeout(800);
        assert.equal(await scrolled(), 0);
        assert.ok(Math.abs(await tip() - before) > 5, `the robot is larger: the arrow had ${before} and has ${await tip()} pixels`);
    } finally {
        await close();
    }
}, { timeout: 120_000 });

browserTest("a frame with a link leaves the visitor's own robot alone", async ({ open, origin }) => {
    const robot = await another(open);
    const own = await open();
    await started(own);
    await own.evaluate(() => window.tautline.load({ ...window.tautline.scenario(), name: "My own" }));
    await own.waitForTimeout(3000);
    const context = own.context();
    const { address, close } = await host(`<iframe src="${origin}${robotPart(robot)}&panels=0" width="600" height="400"></iframe>`, "127.0.0.1");
    try {
        const lecture = await context.newPage();
        await lecture.goto(address);
        const frame = await frameOf(lecture, origin);
        assert.equal((await scenario(frame)).name, "Moon robot");
        await frame.evaluate(() => window.tautline.load({ ...window.tautline.scenario(), gravity: 3 }));
        await lecture.waitForTimeout(3000);
        const fresh = await context.newPage();
        await fresh.goto(origin);
        await started(fresh);
        assert.equal((await scenario(fresh)).name, "My own");
        assert.ok((await layout(fresh)).some(({ label, role }) => label === "Controls" && role === "region"), "nor does it fold panels");
    } finally {
        await close();
    }
}, { timeout: 120_000 });
