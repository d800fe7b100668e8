// The npm package of the core, as others get it: packed, installed in an empty folder, in Node.js and in a plain page.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFileSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { SITES, browserTest, commandLine, runCommandLine, screenshot } from "./harness.mjs";

const PACKAGE = SITES.package.folder;
const here = (name) => fileURLToPath(new URL(name, import.meta.url));
const npm = (folder, ...args) => execFileSync("npm", args, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });

const paper = JSON.parse(runCommandLine(["example", "paper"]).stdout);
const reference = (name) => JSON.parse(readFileSync(here(`../../tests/reference/${name}.json`), "utf8")).scenario;

// Installed as from a registry, without one.
let folder;
let tautline;
before(async () => {
    assert.ok(existsSync(PACKAGE), `${PACKAGE} is missing: run ${SITES.package.build} first`);
    folder = mkdtempSync(path.join(tmpdir(), "tautline-npm-"));
    const [{ filename }] = JSON.parse(npm(PACKAGE, "pack", "--json", "--pack-destination", folder));
    writeFileSync(path.join(folder, "package.json"), JSON.stringify({ private: true, type: "module" }));
    npm(folder, "install", "--offline", "--no-audit", "--no-fund", `./${filename}`);
    tautline = await import(pathToFileURL(path.join(folder, "node_modules", "tautline", "node.js")));
});
after(() => folder && rmSync(folder, { recursive: true }));

test("the functions say so until the module is loaded", async () => {
    assert.throws(() => tautline.analyze(paper), /not loaded yet: `await init\(\)`/);
    await assert.rejects(tautline.map(paper, { nx: 2, ny: 2 }), /not loaded yet/);
    await assert.rejects(tautline.init(new Uint8Array([1, 2, 3])), WebAssembly.CompileError);
    // A failed attempt leaves nothing behind, and several calls load it once.
    await Promise.all([tautline.init(), tautline.init()]);
    assert.equal(tautline.criticalSpeed(paper).cable, 4);
});

test("the package has the files that it should, and the crate's version", () => {
    const [{ files, name, version }] = JSON.parse(npm(PACKAGE, "pack", "--dry-run", "--json"));
    assert.deepEqual(files.map((file) => file.path).sort(), [
        "LICENSE-APACHE", "LICENSE-MIT", "README.md", "example.html", "index.d.ts", "index.js", "node.js", "package.json",
        "tautline.js", "tautline_bg.wasm",
    ]);
    assert.equal(`${name} ${version}`, runCommandLine(["--version"]).stdout.trim());
});

test("a program that imports it by name runs", () => {
    const program = `
        import { init, criticalSpeed } from "tautline";
        await init();
        console.log(criticalSpeed(process.argv[1]).speed.toFixed(3));`;
    const args = ["--input-type=module", "--eval", program, JSON.stringify(paper)];
    assert.equal(execFileSync(process.execPath, args, { cwd: folder, encoding: "utf8" }), "11.299\n");
});

/** Equal but for the last bits of numbers: sine and cosine differ from one machine to the next. */
function assertSame(actual, expected, where = "") {
    if (typeof expected === "number" && typeof actual === "number") {
        const difference = Math.abs(actual - expected);
        assert.ok(difference <= 1e-12 * Math.max(1, Math.abs(expected)), `${where}: ${actual}, not ${expected}`);
    } else if (typeof expected === "object" && expected !== null) {
        assert.deepEqual(Object.keys(actual), Object.keys(expected), where);
        for (const key of Object.keys(expected)) assertSame(actual[key], expected[key], `${where}.${key}`);
    } else {
        assert.equal(actual, expected, where);
    }
}

// Secant, both kinds of tangent, five cables, no critical speed, no equilibrium.
const SCENARIOS = {
    paper,
    "five cables, tangent": reference("extra_01_five_cables_oblique_tangent"),
    "never unstable": reference("extra_13_never_unstable"),
    infeasible: reference("infeasible_00_upper_left_would_push"),
};

for (const [name, scenario] of Object.entries(SCENARIOS)) {
    test(`it says what the command line says (${name})`, async () => {
        await tautline.init();
        const analysis = tautline.analyze(scenario);
        assertSame(analysis, commandLine(scenario));
        assert.deepEqual(tautline.analyze(JSON.stringify(scenario)), analysis, "an object is as good as its text");
        const found = tautline.criticalSpeed(scenario);
        const { speed, frequency_hz, kind, cable, feasible, reason, searched_up_to, status, wave_limit } = found;
        const none = { speed: null, frequency_hz: null, kind: null, cable: null };
        assert.deepEqual({ speed, frequency_hz, kind, cable }, analysis.critical ?? none);
        assert.deepEqual([feasible, reason, searched_up_to], [analysis.feasible, analysis.reason, analysis.searched_up_to]);
        assert.deepEqual([status, wave_limit], [analysis.status, analysis.wave_limit]);
    });
}

test("the critical speed of the paper's robot is that of docs/theory.md", async () => {
    await tautline.init();
    const { speed, frequency_hz, kind, cable, searched_up_to } = tautline.criticalSpeed(paper);
    assert.ok(Math.abs(speed - 11.299) < 1e-3 && Math.abs(frequency_hz - 0.27155) < 1e-5, `${speed} ${frequency_hz}`);
    assert.deepEqual([kind, cable, searched_up_to], ["flutter", 4, 40]);
    const { wave_limit, ...none } = tautline.criticalSpeed(paper, { maxSpeed: 3 });
    assert.deepEqual(none, {
        feasible: true, reason: null, speed: null, frequency_hz: null, kind: null, cable: null, searched_up_to: 3,
        status: "none",
    });
    assert.ok(Math.abs(wave_limit.speed - 11.874) < 5e-4 && wave_limit.reeled_in, JSON.stringify(wave_limit));
    assert.equal(tautline.analyze(paper, { maxSpeed: 3 }).searched_up_to, 3);
});

for (const [direction, words] of [["motion", []], ["worst", ["--direction", "worst"]], [[-3, 4], ["--direction", "-3,4"]]]) {
    test(`a map is that of the command line (${direction})`, async () => {
        await tautline.init();
        const args = ["map", "-", "--nx", "5", "--ny", "3", "--csv", "--max-speed", "10", ...words];
        const [header, ...lines] = runCommandLine(args, JSON.stringify(paper)).stdout.trim().split("\n");
        const value = (text) => (text === "" ? null : /^(true|false|flutter|divergence|found|none|infeasible|failed)$/.test(text) ? text : Number(text));
        const table = lines.map((line) => {
            const row = Object.fromEntries(line.split(",").map((text, i) => [header.split(",")[i], value(text)]));
            return { ...row, feasible: row.feasible === null ? null : row.feasible === "true" };
        });
        const progress = [];
        const onProgress = (done, total) => progress.push([done, total]);
        const rows = await tautline.map(paper, { nx: 5, ny: 3, direction, maxSpeed: 10, onProgress });
        assertSame(rows, table);
        assert.deepEqual(progress.at(-1), [15, 15]);
        assert.ok(progress.every(([done], i) => i === 0 || done > progress[i - 1][0]), String(progress));
    });
}

test("a long map lets others have their turn, and can be stopped", async () => {
    await tautline.init();
    const stop = new AbortController();
    setTimeout(() => stop.abort(), 50);
    const begun = performance.now();
    await assert.rejects(tautline.map(paper, { nx: 2000, ny: 2000, signal: stop.signal }), { name: "AbortError" });
    assert.ok(performance.now() - begun < 5000);
});

const platform = { mass: -2 };
const BAD = {
    "a value": { ...paper, platform },
    "two values": { ...paper, platform, gravity: "much" },
    "not a number": { ...paper, gravity: NaN },
    "a missing field": { ...paper, damping: { alpha: 1 } },
    "an unknown field": { ...paper, colour: "red" },
    "a zero direction": { ...paper, motion: { ...paper.motion, direction: [0, 0] } },
    "no JSON": '{ "gravity": ',
};

for (const [name, scenario] of Object.entries(BAD)) {
    test(`bad input is told as on the command line (${name})`, async () => {
        await tautline.init();
        // Where JSON has null for what is not a number, the file has the word itself.
        const text = typeof scenario === "string" ? scenario : JSON.stringify(scenario).replace('"gravity":null', '"gravity":NaN');
        const { status, stderr } = runCommandLine(["analyze", "-", "--json"], text);
        assert.equal(status, 2);
        const message = stderr.trim().replaceAll(/^standard input: /gm, "");
        const error = (thrown) => thrown instanceof Error && thrown.message === message;
        assert.throws(() => tautline.analyze(scenario), error);
        assert.throws(() => tautline.criticalSpeed(scenario), error);
        await assert.rejects(tautline.map(scenario, { nx: 2, ny: 2 }), error);
    });
}

test("bad options and values without JSON are told by name", async () => {
    await tautline.init();
    assert.throws(() => tautline.analyze(undefined), { message: "scenario: undefined is not allowed; allowed: an object or JSON text" });
    assert.throws(() => tautline.analyze(paper, { maxSpeed: Infinity }), { message: /^maxSpeed: "Infinity" is not allowed/ });
    assert.throws(() => tautline.criticalSpeed(paper, { max_speed: 1 }), { message: /^max_speed: an unknown field/ });
    await assert.rejects(tautline.map(paper), { message: /^nx: missing; .*\nny: missing; allowed: a whole number from 1 to 2000$/ });
    await assert.rejects(tautline.map(paper, { nx: 2, ny: 2, direction: "left" }), { message: /^direction: "left" .*"worst"/ });
});

test("the types fit: what they say of programs, and what the functions give", async () => {
    await tautline.init();
    const literal = (type, value) => `export const _${count++}: ${type} = ${JSON.stringify(value)};\n`;
    let count = 0;
    // Of a literal the compiler checks that nothing is missing and nothing is left over.
    let program = 'import type { Analysis, CriticalSpeed, MapRow, Scenario } from "tautline";\n';
    for (const scenario of Object.values(SCENARIOS)) {
        program += literal("Scenario", scenario) + literal("Analysis", tautline.analyze(scenario));
        program += literal("CriticalSpeed", tautline.criticalSpeed(scenario));
    }
    program += literal("MapRow[]", await tautline.map(paper, { nx: 5, ny: 3, maxSpeed: 10 }));
    writeFileSync(path.join(folder, "results.ts"), program);
    copyFileSync(here("npm.types.ts"), path.join(folder, "use.ts"));
    const options = "--noEmit --strict --exactOptionalPropertyTypes --noUncheckedIndexedAccess --target es2022".split(" ");
    const compile = (module, resolution, ...files) => {
        const args = [here("node_modules/typescript/bin/tsc"), ...options, "--module", module, "--moduleResolution", resolution];
        try {
            execFileSync(process.execPath, [...args, ...files], { cwd: folder, encoding: "utf8" });
        } catch (error) {
            assert.fail(error.stdout);
        }
    };
    compile("nodenext", "nodenext", "use.ts", "results.ts");
    compile("esnext", "bundler", "use.ts");
});

for (const colorScheme of ["light", "dark"]) {
    browserTest(`the example works in a plain page (${colorScheme})`, async ({ open, origin }) => {
        const addresses = [];
        const page = await open("example.html", {
            colorScheme,
            before: (page) => page.on("request", (request) => addresses.push(request.url())),
        });
        const status = page.getByRole("status");
        await status.filter({ hasText: "Critical speed 11.299 m/s: flutter at 0.27155 Hz, cable 4." }).waitFor();
        const picture = page.getByRole("img", { name: /^Map of the workspace: \d+ of 861 poses are feasible/ });
        await picture.waitFor();
        // The middle of the map is coloured, its corner is not.
        const alpha = (x, y) => picture.evaluate((canvas, [x, y]) => canvas.getContext("2d").getImageData(x, y, 1, 1).data[3], [x, y]);
        assert.deepEqual([await alpha(410, 210), await alpha(1, 1)], [255, 0]);
        await screenshot(page, `npm example ${colorScheme}`, { fullPage: true });

        const box = page.getByRole("textbox", { name: "Robot, pose and motion" });
        const compute = page.getByRole("button", { name: "Compute" });
        const text = await box.inputValue();
        assert.deepEqual(JSON.parse(text), paper);
        await box.fill(text.replace('"mass": 2.0', '"mass": -2.0'));
        await compute.click();
        await page.getByRole("alert").filter({ hasText: "platform.mass: -2.0 is not allowed; allowed: a finite number greater than 0" }).waitFor();
        assert.equal(await status.innerText(), "");
        await box.fill(text.replace('"position": [0, 0]', '"position": [2, 0]'));
        await compute.click();
        await status.filter({ hasText: "Critical speed 10.854 m/s" }).waitFor();
        assert.equal(await page.getByRole("alert").innerText(), "");
        await picture.waitFor();
        assert.deepEqual(addresses.filter((address) => !address.startsWith(origin) && !address.startsWith("data:")), []);
    }, { site: SITES.package });
}
