// The package in Node.js, where `fetch` reads no files.
import { readFile } from "node:fs/promises";
import { init as start } from "./index.js";

export { analyze, criticalSpeed, fly, limits, map } from "./index.js";

export function init(source = readFile(new URL("tautline_bg.wasm", import.meta.url))) {
    return start(source);
}
