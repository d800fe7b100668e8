// Hands in a browser: drags whose end comes in one frame with the release.
import assert from "node:assert/strict";
import { browserTest, waitForAnalysis, waitForStart } from "./harness.mjs";

const motion = (page) => page.evaluate(() => window.tautline.scenario().motion);

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
