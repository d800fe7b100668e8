// What the npm package's types allow and refuse; npm.test.mjs compiles it where the package is installed.
import { analyze, criticalSpeed, init, map } from "tautline";
import type { Analysis, Direction, MapRow, Scenario } from "tautline";

const scenario: Scenario = {
    cable: { youngs_modulus: 125e6, area: 5e-5, mass_per_length: 0.4 },
    platform: { mass: 2 },
    cables: [
        { anchor: [-10, 5], tension: "equilibrium" },
        { anchor: [10, 5], tension: "equilibrium" },
        { anchor: [0, -5], tension: { constant: 67 } },
        { anchor: [5, -5], tension: { horizontal: [50, 5, 0], vertical: [45, 0, 0] } },
    ],
    elements_per_cable: 10,
    damping: { alpha: 0.5, beta: 0.005 },
    motion: { position: [0, 0], direction: [1, 0], speed: 5 },
};

await init();
await init(new URL("tautline_bg.wasm", import.meta.url));
await init(fetch("tautline_bg.wasm"));

// Feasible or not, found or not: the one tells the other fields' types.
const analysis: Analysis = analyze(scenario, { maxSpeed: 60 });
if (analysis.feasible) {
    const growth: number | null = analysis.max_growth_rate;
    const [re, im]: [number, number] = analysis.eigenvalues[0] ?? [0, 0];
    const limit: number | undefined = analysis.wave_limit?.speed;
    const slack: number | undefined = analysis.slack_acceleration?.accelerating?.value;
    console.log(slack, limit, growth, re, im, analysis.critical?.frequency_hz, analysis.cables[0]?.nodes);
} else {
    const reason: string = analysis.reason;
    const none: null = analysis.critical;
    console.log(reason, none);
}
const found = criticalSpeed(JSON.stringify(scenario));
if (found.speed !== null) {
    const frequency: number = found.frequency_hz;
    const kind: "flutter" | "divergence" = found.kind;
    console.log(frequency, kind, found.cable.toFixed());
} else {
    const reason: string | null = found.reason;
    console.log(reason, found.searched_up_to);
}
const directions: Direction[] = ["motion", "worst", "+x", "-x", "+y", "-y", [1, 2]];
const { signal } = new AbortController();
const rows: MapRow[] = await map(scenario, { nx: 5, ny: 3, direction: "worst", onProgress: (done, total) => done / total, signal });
const speeds: number[] = rows.flatMap((row) => (row.critical_speed === null ? [] : [row.critical_speed]));
const failed: MapRow[] = rows.filter((row) => row.status === "failed");
console.log(directions, speeds, failed.length);

// @ts-expect-error: an unknown field
analyze({ ...scenario, colour: "red" } satisfies Scenario);
// @ts-expect-error: a missing field
analyze({ platform: { mass: 2 } });
// @ts-expect-error: a tension is one law, not two
const tension: Scenario["cables"][0]["tension"] = { horizontal: [1, 2, 3] };
// @ts-expect-error: no such word
const direction: Direction = "left";
// @ts-expect-error: the grid is required
await map(scenario, {});
// @ts-expect-error: it may be null
criticalSpeed(scenario).speed.toFixed();
// @ts-expect-error: no such option
analyze(scenario, { max_speed: 3 });
console.log(tension, direction);
