// Hands in a browser: fingers that scroll, turn and tap, and drags whose end comes in one frame with the release.
import assert from "node:assert/strict";
import { browserTest, waitForAnalysis, waitForStart } from "./harness.mjs";

const PHONE = { width: 360, height: 740 };
/** Where the speed's value and the direction's slider are on a phone; the tests of sideways swipes fail where they are not. */
const SPEED = [276, 591];
const DIRECTION = [184, 615];

const motion = (page) => page.evaluate(() => window.tautline.scenario().motion);

/** The part of the picture below the canvas, to see whether it scrolls. */
const panel = (page) => page.screenshot({ clip: { x: 0, y: 480, width: 360, height: 260 } });

/** A finger's way, as the browser makes events of it. */
async function swipe(page, [x, y], [right, down]) {
    const client = await page.context().newCDPSession(page);
    const touch = (type, touchPoints) => client.send("Input.dispatchTouchEvent", { type, touchPoints });
    await touch("touchStart", [{ x, y }]);
    for (let i = 1; i <= 8; i++) {
        await touch("touchMove", [{ x: x + (right * i) / 8, y: y + (down * i) / 8 }]);
        await page.waitForTimeout(30);
    }
    await page.waitForTimeout(200);
    await touch("touchEnd", []);
    await page.waitForTimeout(600);
}

async function phone(open) {
    const page = await open("", { viewport: PHONE, hasTouch: true, isMobile: true });
    await waitForStart(page);
    await waitForAnalysis(page);
    // Nothing moves, so that pictures can be compared.
    await page.evaluate(() => window.tautline.load(window.tautline.scenario()));
    await waitForAnalysis(page);
    return page;
}

browserTest("a finger that moves up from a value or a slider scrolls and changes nothing", async ({ open }) => {
    for (const at of [SPEED, DIRECTION]) {
        const page = await phone(open);
        const [before, seen] = [await motion(page), await panel(page)];
        await swipe(page, at, [3, -90]);
        assert.deepEqual(await motion(page), before);
        assert.ok(!seen.equals(await panel(page)), "the page scrolls");
        await swipe(page, [at[0], at[1] - 90], [-3, 120]);
        assert.deepEqual(await motion(page), before);
    }
});

browserTest("a finger that moves sideways turns a value or a slider, and a tap opens a value", async ({ open }) => {
    const page = await phone(open);
    await swipe(page, SPEED, [40, 6]);
    const faster = await motion(page);
    assert.ok(faster.speed > 5.5, `${faster.speed} m/s`);
    await swipe(page, DIRECTION, [12, 3]);
    const [x, y] = (await motion(page)).direction;
    assert.ok(y > 0.5, `direction (${x}, ${y})`);
    await swipe(page, SPEED, [0, 0]);
    await page.keyboard.type("7");
    await page.keyboard.press("Enter");
    await waitForAnalysis(page);
    assert.equal((await motion(page)).speed, 7);
});

browserTest("the end of a drag counts that comes in one frame with the release", async ({ open }) => {
    const page = await open();
    await waitForStart(page);
    await waitForAnalysis(page);
    // The platform is in the middle of the canvas, from 380 to 940; its robot is 20 m wide with 44 points beside it.
    const [from, by, scale] = [[660, 412.5], 120, (940 - 380 - 88) / 20];
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move(from[0] + 20, from[1]);
    await page.waitForTimeout(300);
    // Both in one task: no frame can come between.
    await page.evaluate(([x, y]) => {
        const canvas = document.getElementById("tautline-canvas");
        const at = { clientX: x, clientY: y, bubbles: true, cancelable: true, button: 0, pointerType: "mouse" };
        canvas.dispatchEvent(new MouseEvent("mousemove", { ...at, buttons: 1 }));
        canvas.dispatchEvent(new PointerEvent("pointerup", at));
    }, [from[0] + by, from[1]]);
    await page.waitForTimeout(500);
    await waitForAnalysis(page);
    const { position } = await motion(page);
    assert.ok(Math.abs(position[0] - by / scale) <= 0.5 / scale, `x = ${position[0]} in place of ${by / scale}`);
});
