// The script for `new Worker`. In place of Trunk's own, which hands the worker's version on to nobody:
// these files keep their names from build to build, so the page may ask for `worker_loader.js?v=BUILD`,
// and a cached worker of an older build never meets a newer page.
"use strict";
importScripts("./worker.js" + location.search);
// Thrown outside the promise, so that the page hears of it.
wasm_bindgen({ module_or_path: "./worker_bg.wasm" + location.search })
    .catch((error) => setTimeout(() => { throw error; }));
