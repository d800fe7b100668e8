// Starts the app, and says on the page what is wrong when it cannot start or has stopped.
// A file of its own, not inline, so that the page can forbid inline scripts.
(() => {
    "use strict";
    const canvas = document.getElementById("tautline-canvas");
    const loading = document.getElementById("tautline-loading");
    const failure = document.getElementById("tautline-error");
    let started = false;

    // In a frame of another page the user may be typing elsewhere. So the page is inert until the app has started;
    // otherwise the app would take the focus then. Afterwards a click gives it the focus, as usual.
    const framed = window.parent !== window;
    document.body.inert = framed;

    // There the wheel is for the page around it: without Ctrl, which zooms, the app does not hear of it.
    if (framed) {
        const forPage = (event) => { if (!event.ctrlKey && !event.metaKey) event.stopImmediatePropagation(); };
        addEventListener("wheel", forPage, { capture: true, passive: true });
    }

    // In the app F6 goes from region to region; the browser would go to its own bars.
    addEventListener("keydown", (event) => {
        const inApp = event.target === canvas || event.target === canvas.nextElementSibling;
        if (event.key === "F6" && inApp && !event.ctrlKey && !event.altKey) event.preventDefault();
    }, { capture: true });

    const copy = document.getElementById("tautline-copy");
    document.getElementById("tautline-copy-close").addEventListener("click", () => copy.close());

    // detail: what was thrown, for a report; people who cannot use it need not open it.
    function fail(title, advice, detail) {
        loading.hidden = true;
        document.body.inert = false;
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
        return (name, text) => add(failure, name, text);
    }

    // The scenario on show. A program that has stopped still answers, unless it stopped while it was changing the scenario.
    // Then the storage has the one that was kept for the next start, if the browser keeps anything.
    function lastScenario() {
        try {
            return JSON.stringify(window.tautline.scenario(), null, 2);
        } catch { /* it does not answer */ }
        for (const storage of ["sessionStorage", "localStorage"]) {
            try {
                const scenario = window[storage].getItem("tautline-scenario");
                if (scenario) return scenario;
            } catch { /* storage is blocked */ }
        }
        return null;
    }

    // A reload keeps the state of the page's entry in the history, even if the browser keeps nothing else.
    function restart(scenario) {
        history.replaceState({ scenario }, "");
        location.reload();
    }

    function stopped(error) {
        if (!failure.hidden) return; // one fault leads to others; the first one tells most
        const scenario = lastScenario();
        const add = fail("Tautline has stopped",
            "An error in the program stopped it." + (scenario ? " Your robot is not lost." : " Please reload the page."), error);
        if (!scenario) return;
        const again = add("button", "Restart with this robot");
        again.addEventListener("click", () => restart(scenario));
        const file = add("a", "Save the robot as a file");
        file.href = URL.createObjectURL(new Blob([scenario], { type: "application/json" }));
        file.download = "tautline.json";
        if (document.hasFocus()) again.focus(); // not out of a frame whose page is used elsewhere
    }

    const reload = "Please reload the page. If that does not help, try a current version of Chrome, Edge, Firefox or Safari.";

    function thrown(error) {
        if (!started) {
            fail("Tautline could not start", reload, error);
        } else if (error instanceof WebAssembly.RuntimeError) {
            // Once it runs, other errors (an extension's, say) need not stop it; this one always does.
            stopped(error);
        }
    }
    // Events without an error object are harmless notices, such as the one of ResizeObserver.
    addEventListener("error", (event) => { if (event.error) thrown(event.error); });
    addEventListener("unhandledrejection", (event) => thrown(event.reason));

    // The ends of the app are no stops of Tab, but it goes on from them: from where Tab never stops it would begin anew.
    for (const end of document.querySelectorAll(".end")) {
        end.addEventListener("focus", () => { end.tabIndex = 0; });
        end.addEventListener("blur", () => { end.tabIndex = -1; });
    }

    // The app gives the canvas its size right before it draws for the first time.
    const observer = new MutationObserver(() => {
        started = true;
        observer.disconnect();
        // The drawing library's own field for what is typed comes right behind the canvas. Tab is not to find it.
        if (canvas.nextElementSibling instanceof HTMLInputElement) canvas.nextElementSibling.tabIndex = -1;
        document.body.inert = false;
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

    // The app draws into this context, since a canvas has only one. The app's shapes have smooth edges of their own. So the
    // browser need not smooth them or blend them with the page; without a graphics card a frame then takes two thirds of
    // the time.
    const drawing = () => canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false, stencil: false });

    // Browsers take the graphics card away when it fails, or when too many pages want it. All that was drawn with it is
    // gone. A fresh start is the sure way to have it again.
    canvas.addEventListener("webglcontextlost", (event) => {
        event.preventDefault(); // or it would not be given back
        if (!failure.hidden) return;
        const scenario = lastScenario();
        const add = fail("The picture is gone",
            "The browser has taken the graphics away from this page. It goes on as soon as they are back; nothing is lost.");
        add("button", "Reload now").addEventListener("click", () => restart(scenario));
        canvas.addEventListener("webglcontextrestored", () => restart(scenario), { once: true });
    });

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
        fail("This browser cannot run Tautline", "It has no WebAssembly, which the text version needs as well. " + reload);
    } else if (!drawing()) {
        const add = fail("This browser cannot show Tautline",
            "It offers no WebGL 2. Often it is only switched off: look for “hardware acceleration” in the browser's settings, then reload the page. The text version needs none.");
        add("a", "Open the text version").href = `text.html${location.hash}`;
    } else {
        start();
    }
})();
