// The script for `new Worker`, beside what it loads; web/offline.sh puts all of it into the build's folder.
"use strict";
importScripts("./worker.js");
// The error is thrown outside the promise, so that the page gets an error event.
wasm_bindgen({ module_or_path: "./worker_bg.wasm" })
    .catch((error) => setTimeout(() => { throw error; }));
