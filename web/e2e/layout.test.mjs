// Where everything is, at every size: nothing is cut off, nothing overlaps, the robot has its share of the window, and
// fingers hit what they are meant to.
import assert from "node:assert/strict";
import { browserTest, centre, framed, inside, layout, matching, press, screenshot, started } from "./harness.mjs";

const SIZES = [[320, 640], [360, 740], [768, 1024], [1024, 768], [1280, 720], [1280, 800], [1920, 1080], [3840, 2160]];

/** What must be on the screen of a window, from this width on. */
const EXPECTED = [
    { from: 0, to: 759, things: ["Undo", "Map", "More", "Move", "Robot", "Plots", "Explain"] },
    { from: 760, to: 9999, things: ["Robot", "Undo", "Redo", "Map", "Keep", "Designs", "Share", "More"] },
    { from: 1024, to: 9999, things: ["Controls", "Dock", "Present"] },
];
const REGIONS = [
    { from: 0, to: 759, names: ["Bar", "Canvas", "Answer", "Sheet"] },
    { from: 760, to: 1199, names: ["Bar", "Canvas", "Answer", "Transport"] },
    { from: 1200, to: 9999, names: ["Bar", "Controls", "Canvas", "Answer", "Dock", "Transport", "Plots"] },
];
/** Regions whose content scrolls: there things may be cut off above and below, never at the sides. */
const SCROLLING = new Set(["Controls", "Plots", "Dock", "Sheet"]);

/** Things that hold or carry others, or show what is painted under others. */
const HOLDERS = new Set([
    "region", "dialog", "img", "figure", "row", "table", "group", "list", "tablist", "tabpanel", "radiogroup", "tooltip",
    "separator", "generic", "toolbar", "menu", "menubar", "scrollbar",
]);
/** What can be grabbed on the canvas and in plots: it goes where the robot and its modes go. */
const HANDLES = [/^Platform$/, /^Velocity$/, /^Winch \d+/, /^Cable \d+/, /^Mode /, /^Critical/];
/** Pairs that may overlap, and why. Each is [name, name, reason]; the names may be regular expressions. */
const ALLOWED = [
    [/^(Motion|Rope|Platform|Damping|Model|Cables)$/, /./, "a group's title is pressed over its whole row, with what is summed up in it"],
    [/^Cable \d+$/, /./, "a row of the table is pressed as a whole, and its numbers one by one"],
];

const named = (text, name) => (name instanceof RegExp ? name.test(text) : name === text);
const box = ({ label, role, rect }) => `${role} "${label}" [${rect.map((edge) => Math.round(edge)).join(", ")}]`;
const area = ({ rect: [, , width, height] }) => width * height;
const region = (items, name) => items.find(({ role, label }) => role === "region" && label === name);

/** How far two things lie over each other, across and down; negative where they do not. */
function overlap({ rect: [x, y, width, height] }, { rect: [left, top, wide, high] }) {
    return [Math.min(x + width, left + wide) - Math.max(x, left), Math.min(y + height, top + high) - Math.max(y, top)];
}

function assertNothingOverlaps(items, where) {
    const solid = items.filter(({ role }) => !HOLDERS.has(role));
    const isHandle = (it) => it.role !== "text" && HANDLES.some((handle) => handle.test(it.label));
    const allowed = (a, b) => ALLOWED.some(([one, other]) =>
        (named(a.label, one) && named(b.label, other)) || (named(b.label, one) && named(a.label, other)));
    const faults = [];
    for (const [i, a] of solid.entries()) {
        for (const b of solid.slice(i + 1)) {
            const [across, down] = overlap(a, b);
            if (across < 1.5 || down < 1.5 || isHandle(a) || isHandle(b) || allowed(a, b)) continue;
            faults.push(`${box(a)} and ${box(b)} by ${across.toFixed(0)} × ${down.toFixed(0)}`);
        }
    }
    assert.equal(faults.length, 0, `${where}: ${faults.length} pairs overlap:\n  ${faults.slice(0, 30).join("\n  ")}`);
}

function assertNothingIsCutOff(items, [width, height], where) {
    const scrolling = items.filter(({ role, label }) => (role === "region" && SCROLLING.has(label)) || role === "dialog");
    const faults = [];
    for (const it of items) {
        const [x, y, w, h] = it.rect;
        if (x < -0.5 || y < -0.5 || x + w > width + 0.5 || y + h > height + 0.5) faults.push(`${box(it)} is beyond the window`);
        if (!it.whole) continue;
        const scrolls = scrolling.some((place) => place !== it && inside(centre(it), place));
        const sideways = Math.abs(it.whole[2] - w) > 1;
        if (sideways || !scrolls) {
            const how = sideways ? "at its side" : "where nothing scrolls";
            faults.push(`${box(it)} is cut off ${how}; all of it is [${it.whole.map(Math.round).join(", ")}]`);
        }
    }
    assert.equal(faults.length, 0, `${where}: ${faults.length} things are cut off:\n  ${faults.slice(0, 30).join("\n  ")}`);
}

function assertAllIsThere(items, width, where) {
    for (const { from, to, things } of EXPECTED.filter(({ from, to }) => width >= from && width <= to)) {
        const missing = things.filter((thing) => matching(items, thing).length === 0);
        assert.deepEqual(missing, [], `${where}: not on the screen, from ${from} to ${to} pixels`);
    }
    for (const { names } of REGIONS.filter(({ from, to }) => width >= from && width <= to)) {
        const missing = names.filter((name) => !region(items, name));
        assert.deepEqual(missing, [], `${where}: no such regions`);
    }
    const unnamed = items.filter(({ label }) => label.trim() === "");
    assert.deepEqual(unnamed, [], `${where}: things without a name`);
}

/** The parts of the window that the canvas has, and with what belongs to it. */
function shares(items, [width, height]) {
    const part = (...names) => names.map((name) => region(items, name)).filter(Boolean)
        .reduce((sum, it) => sum + area(it), 0) / (width * height);
    return { canvas: part("Canvas"), withStudy: part("Canvas", "Dock"), all: part("Canvas", "Dock", "Transport") };
}

function assertShare(items, size, where) {
    const { canvas, withStudy, all } = shares(items, size);
    const percent = (part) => `${(100 * part).toFixed(1)} %`;
    console.log(`${where}: canvas ${percent(canvas)}, with the line study ${percent(withStudy)}, with the transport ${percent(all)}`);
    if (size[0] >= 760) {
        assert.ok(all >= 0.5, `${where}: canvas, line study and transport have ${percent(all)}, not 50 %`);
    } else {
        assert.ok(withStudy >= 0.45, `${where}: canvas and line study have ${percent(withStudy)}, not 45 %`);
    }
    if (size.join() === "1280,800") assert.ok(canvas >= 0.36, `${where}: the bare canvas has ${percent(canvas)}, not 36 %`);
}

/** Gives the window another size and waits until the screen is laid out for it. */
async function resize(page, [width, height]) {
    await page.setViewportSize({ width, height });
    await page.waitForFunction((width) => window.tautline.layout()
        .some(({ role, label, rect }) => role === "region" && label === "Bar" && Math.abs(rect[0] + rect[2] - width) < 1), width);
    await page.waitForTimeout(500);
}

async function assertLayoutAt(page, size) {
    const where = size.join(" × ");
    const [width] = size;
    const items = await layout(page);
    await screenshot(page, `layout ${where}`);
    assertAllIsThere(items, width, where);
    assertNothingIsCutOff(items, size, where);
    assertNothingOverlaps(items, where);
    assertShare(items, size, where);
    if (width >= 760) return;
    for (const tab of ["Robot", "Plots", "Explain"]) {
        await press(page, tab, "tab");
        await page.waitForTimeout(400);
        const items = await layout(page);
        await screenshot(page, `layout ${where} ${tab}`);
        assertNothingIsCutOff(items, size, `${where}, ${tab}`);
        assertNothingOverlaps(items, `${where}, ${tab}`);
    }
}

// One page for all sizes, as starts take most of the time. Each size is looked at, whatever is wrong at others.
browserTest("at every size all is there, whole, side by side, and the robot comes first", async ({ open }) => {
    const [[width, height]] = SIZES;
    const page = await open("", { viewport: { width, height } });
    await started(page, { timeout: 120_000 });
    const faults = [];
    for (const size of SIZES) {
        try {
            await resize(page, size);
            await assertLayoutAt(page, size);
        } catch (error) {
            faults.push(`${size.join(" × ")}: ${error.message}`);
        }
        // As a window begins: the next size must not be seen with the last tab.
        if (size[0] < 760) await press(page, "Move", "tab");
    }
    assert.equal(faults.length, 0, faults.join("\n"));
}, { timeout: 300_000 });

browserTest("in a frame of 600 × 400 all is there, whole and side by side", async ({ open, origin }) => {
    const { page, frame, close } = await framed(open, origin);
    try {
        await page.waitForTimeout(500);
        const items = await layout(frame);
        await screenshot(page, "layout frame");
        assertNothingIsCutOff(items, [600, 400], "frame");
        assertNothingOverlaps(items, "frame");
        for (const name of ["Canvas", "Answer"]) assert.ok(region(items, name), `frame: no region ${name}`);
        for (const name of ["Controls", "Plots"]) assert.ok(!region(items, name), `frame: there is a region ${name}`);
    } finally {
        await close();
    }
}, { timeout: 120_000 });

browserTest("fingers hit everything on a phone; held across it has the robot on the left and nothing is cut off", async ({ open }) => {
    const page = await open("", { viewport: { width: 360, height: 740 }, hasTouch: true });
    await started(page);
    for (const tab of ["Move", "Robot"]) {
        await press(page, tab, "tab");
        await page.waitForTimeout(400);
        const items = await layout(page);
        const pressed = items.filter(({ role, whole }) => /^(button|tab|spinbutton|combobox|checkbox|radio)$/.test(role) && !whole);
        const places = ["Bar", "Sheet"].map((name) => region(items, name)).filter(Boolean);
        const small = pressed.filter((it) => places.some((place) => inside(centre(it), place)))
            .filter(({ rect: [, , width, height] }) => height < 43.5 || width < 39.5);
        assert.deepEqual(small.map(box), [], `${tab}: smaller than 44`);
    }
    await press(page, "Move", "tab");
    await resize(page, [740, 360]);
    const items = await layout(page);
    await screenshot(page, "layout 740 × 360");
    assertNothingIsCutOff(items, [740, 360], "740 × 360");
    assertNothingOverlaps(items, "740 × 360");
    const [canvas, sheet] = ["Canvas", "Sheet"].map((name) => region(items, name));
    assert.ok(canvas && sheet, "the canvas and the sheet");
    assert.ok(canvas.rect[0] + canvas.rect[2] <= sheet.rect[0] + 1, `${box(canvas)} is left of ${box(sheet)}`);
    assert.ok(canvas.rect[2] >= 0.5 * 740, box(canvas));
}, { timeout: 120_000 });

for (const text of [80, 150, 200]) {
    browserTest(`with texts of ${text} % nothing is cut off or overlaps`, async ({ open }) => {
        const page = await open("", {
            before: (page) => page.addInitScript((text_percent) => localStorage.setItem("tautline-state",
                JSON.stringify({ tour_taken: true, settings: { text_percent } })), text),
        });
        await started(page);
        await page.waitForTimeout(500);
        const items = await layout(page);
        await screenshot(page, `layout text ${text}`);
        assertNothingIsCutOff(items, [1280, 800], `text ${text} %`);
        assertNothingOverlaps(items, `text ${text} %`);
        // The list is in the page's own pixels, so what it names is where the mouse finds it.
        await press(page, "Map", "button");
        await page.waitForFunction(() => window.tautline.layout().some(({ label, value }) => label === "Map" && value === true));
    }, { timeout: 120_000 });
}

browserTest("panels fold by a click and come back as they were", async ({ open }) => {
    const page = await open();
    await started(page);
    const before = await layout(page);
    for (const name of ["Controls", "Dock", "Plots"]) {
        await press(page, name, "button", { within: "Bar" });
        await page.waitForTimeout(500);
        const folded = await layout(page);
        assert.ok(!region(folded, name), `${name} is still there`);
        assert.ok(area(region(folded, "Canvas")) > area(region(before, "Canvas")) + 1000, `the canvas has grown without ${name}`);
        await press(page, name, "button", { within: "Bar" });
        await page.waitForTimeout(500);
        const back = region(await layout(page), name);
        assert.deepEqual(back?.rect, region(before, name).rect, `${name} is where it was`);
    }
}, { timeout: 120_000 });
