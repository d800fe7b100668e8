// Hands in a browser: drags whose end comes in one frame with the release.
import assert from "node:assert/strict";
import { browserTest, centre, find, pixelsPerMetre, PLATFORM, pointAt, started, waitForAnalysis } from "./harness.mjs";

const motion = (page) => page.evaluate(() => window.tautline.scenario().motion);

browserTest("the end of a drag counts that comes in one frame with the release", async ({ open }) => {
    const page = await open();
    await started(page);
    const scale = await pixelsPerMetre(page);
    const by = 4 * scale;
    const { at: from } = await pointAt(page, ...PLATFORM);
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

browserTest("a finger scrolls up and down, turns sideways and edits by a tap, from the first touch on", async ({ open }) => {
    const page = await open("", { viewport: { width: 360, height: 740 }, hasTouch: true });
    await started(page);
    const hand = await page.context().newCDPSession(page);
    const touch = (type, touchPoints) => hand.send("Input.dispatchTouchEvent", { type, touchPoints });
    const swipe = async ([x, y], [right, down]) => {
        await touch("touchStart", [{ x, y }]);
        for (let part = 0.1; right || down ? part < 1.05 : false; part += 0.1) {
            await touch("touchMove", [{ x: x + right * part, y: y + down * part }]);
            await page.waitForTimeout(30);
        }
        // It rests, so that nothing coasts on.
        await page.waitForTimeout(250);
        await touch("touchEnd", []);
        await page.waitForTimeout(250);
    };
    const scenario = () => page.evaluate(() => window.tautline.scenario());
    const at = async (label, role) => centre(await find(page, label, role));

    // The first touch of all, on words, scrolls.
    const [, high] = await at("Position x", "slider");
    await swipe(await at("Direction θ", "text"), [0, -40]);
    const [, higher] = await at("Position x", "slider");
    assert.ok(high - higher > 20, `a swipe up by 40 has moved the row from ${high} to ${higher}`);
    await swipe(await at("Position x", "slider"), [0, 40]);

    await swipe(await at("Speed v", "spinbutton"), [0, 0]);
    await page.keyboard.press("ControlOrMeta+A");
    await page.keyboard.type("7");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => window.tautline.scenario().motion.speed === 7);

    const before = await scenario();
    for (const role of ["slider", "spinbutton"]) {
        await swipe(await at("Direction θ", role), [0, 30]);
        assert.deepEqual(await scenario(), before, `a swipe down on the direction's ${role}`);
        await swipe(await at("Direction θ", role), [0, -30]);
        assert.deepEqual(await scenario(), before, `a swipe up on the direction's ${role}`);
    }
    await swipe(await at("Speed v", "slider"), [60, 2]);
    await page.waitForFunction(() => window.tautline.scenario().motion.speed > 7);
});
