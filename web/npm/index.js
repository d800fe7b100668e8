// The package's functions, described in index.d.ts: objects in, objects out. The module behind speaks JSON text.
import start, * as core from "./tautline.js";

/** So long (in ms) something is computed at a stretch before others have their turn. */
const STRETCH = 15;

let started = false;

export async function init(source) {
    await start({ module_or_path: source });
    started = true;
}

export function analyze(scenario, options = {}) {
    return JSON.parse(ready().analyze(text("scenario", scenario), text("options", options)));
}

export function criticalSpeed(scenario, options = {}) {
    return JSON.parse(ready().criticalSpeed(text("scenario", scenario), text("options", options)));
}

export async function map(scenario, { onProgress, signal, ...options } = {}) {
    const { MapStudy } = ready();
    const study = new MapStudy(text("scenario", scenario), text("options", options));
    try {
        signal?.throwIfAborted();
        const rows = [];
        let since = performance.now();
        while (rows.length < study.length) {
            rows.push(JSON.parse(study.row(rows.length)));
            if (rows.length < study.length && performance.now() - since < STRETCH) continue;
            onProgress?.(rows.length, study.length);
            await pause();
            signal?.throwIfAborted();
            since = performance.now();
        }
        return rows;
    } finally {
        study.free();
    }
}

export async function fly(scenario, { signal, ...options } = {}) {
    return inSteps(ready().Computation.fly(text("scenario", scenario), text("options", options)), signal);
}

export async function limits(scenario, { signal, ...options } = {}) {
    return inSteps(ready().Computation.limits(text("scenario", scenario), text("options", options)), signal);
}

/** The result of a computation, with pauses. */
async function inSteps(computation, signal) {
    try {
        signal?.throwIfAborted();
        let since = performance.now();
        for (;;) {
            const result = computation.advance();
            if (result !== undefined) return JSON.parse(result);
            if (performance.now() - since < STRETCH) continue;
            await pause();
            signal?.throwIfAborted();
            since = performance.now();
        }
    } finally {
        computation.free();
    }
}

function ready() {
    if (!started) throw new Error("tautline is not loaded yet: `await init()` comes first");
    return core;
}

/** The JSON text of a scenario or options. */
function text(name, value) {
    if (typeof value === "string") return value;
    // JSON would make null of numbers that are not finite; as words they are refused by their names.
    const finite = (_, v) => (typeof v === "number" && !Number.isFinite(v) ? String(v) : v);
    const json = JSON.stringify(value, finite);
    if (json === undefined) throw new Error(`${name}: ${String(value)} is not allowed; allowed: an object or JSON text`);
    return json;
}

/** Lets others have their turn. Timers would wait, in hidden pages for a second. */
function pause() {
    return new Promise((resume) => {
        const { port1, port2 } = new MessageChannel();
        port1.onmessage = () => {
            port1.close();
            resume();
        };
        port2.postMessage(null);
    });
}
