// Starts the app, and says on the page what is wrong when it cannot start or has stopped.
// A file of its own, not inline, so that the page can forbid inline scripts.
(() => {
    "use strict";
    const canvas = document.getElementById("tautline-canvas");
    const loading = document.getElementById("tautline-loading");
    const failure = document.getElementById("tautline-error");
    let started = false;

    // detail: what was thrown, for a report; people who cannot use it need not open it.
    function fail(title, advice, detail) {
        loading.hidden = true;
        const add = (parent, name, text) => {
            const element = document.createElement(name);
            element.textContent = text;
            parent.append(element);
            return element;
        };
        failure.replaceChildren();
        add(failure, "h1", title);
        add(failure, "p", advice);
        if (detail !== undefined) {
            const details = add(failure, "details", "");
            add(details, "summary", "Details");
            add(details, "pre", detail instanceof Error ? detail.stack || detail.message : String(detail));
        }
        failure.hidden = false;
    }

    const reload = "Please reload the page. If that does not help, try a current version of Chrome, Edge, Firefox or Safari.";

    function thrown(error) {
        if (!started) {
            fail("Tautline could not start", reload, error);
        } else if (error instanceof WebAssembly.RuntimeError) {
            // Once it runs, other errors (an extension's, say) need not stop it; this one always does.
            fail("Tautline has stopped", "An error in the program stopped it. Please reload the page.", error);
        }
    }
    // Events without an error object are harmless notices, such as the one of ResizeObserver.
    addEventListener("error", (event) => { if (event.error) thrown(event.error); });
    addEventListener("unhandledrejection", (event) => thrown(event.reason));

    // The app gives the canvas its size right before it draws for the first time.
    const observer = new MutationObserver(() => {
        started = true;
        observer.disconnect();
        loading.hidden = true;
        failure.hidden = true; // whatever it was, it did not keep the app from starting
        keepForOffline(); // not before, or its downloads would compete with the app's
    });
    observer.observe(canvas, { attributes: true, attributeFilter: ["width", "height"] });

    async function keepForOffline() {
        try {
            await navigator.serviceWorker.register("sw.js");
        } catch { /* plain http, a private window, storage that is blocked: the app works, with a network */ }
    }

    // The app draws into this context, since a canvas has only one. Shapes come with smooth edges of their own: without
    // a browser's smoothing and blending with the page a frame takes two thirds of the time where there is no graphics card.
    const drawing = () => canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false, stencil: false });

    async function start() {
        const app = document.getElementById("tautline-app").dataset;
        let bindings;
        try {
            bindings = await import(new URL(app.js, document.baseURI).href);
            window.wasmBindings = bindings;
            await bindings.default({ module_or_path: new URL(app.wasm, document.baseURI) });
        } catch (error) {
            if (error instanceof WebAssembly.RuntimeError) return thrown(error);
            fail("Tautline could not be loaded", "Please check the connection and reload the page.", error);
        }
    }

    if (typeof WebAssembly !== "object") {
        fail("This browser cannot run Tautline", "It has no WebAssembly. " + reload);
    } else if (!drawing()) {
        fail("This browser cannot show Tautline",
            "It offers no WebGL 2. Often it is only switched off: look for “hardware acceleration” in the browser's settings, then reload the page.");
    } else {
        start();
    }
})();
