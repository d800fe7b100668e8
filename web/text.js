// The text version: a form for the numbers of a robot, and what follows from them as a sentence and tables.
//
// The page's worker computes; src/scenario/messages.rs has its requests and answers. The scenario is the one of a file.
// Where a field holds no number, the scenario has the field's text there, and the worker says what is allowed.

import { element, exact, sentence, tables } from "./text_results.js";

const ANY = "Any number.";
const POSITIVE = "More than 0.";
const NOT_NEGATIVE = "0 or more.";
/** What is at a path in the scenario, or in a cable of it: name, unit, and what is allowed or the choices' names. */
const FIELDS = {
    "name": ["Name", "", "Any text, or none."],
    "gravity": ["Gravity g", "m/s²", NOT_NEGATIVE],
    "platform.mass": ["Platform mass m", "kg", POSITIVE],
    "cable.youngs_modulus": ["Young's modulus E", "Pa", `${POSITIVE} Steel rope is about 1e11, rubber 5e6.`],
    "cable.area": ["Cross-section A", "m²", `${POSITIVE} 1e-4 is one square centimetre.`],
    "cable.mass_per_length": ["Mass per length μ", "kg/m", POSITIVE],
    "cable.strain": ["Strain", "", { green: "Green", engineering: "Engineering" }],
    "anchor": ["Winch point"],
    "anchor[0]": ["Winch point x", "m", ANY],
    "anchor[1]": ["Winch point y", "m", `${ANY} Up is positive.`],
    "tension": ["Tension", "", {
        equilibrium: "At equilibrium", constant: "Constant", horizontal: "By a law",
    }],
    "tension.constant": ["Constant tension", "N", POSITIVE],
    "tension.horizontal[0]": ["Horizontal part h₀", "N", ANY],
    "tension.horizontal[1]": ["Horizontal slope along x, hₓ", "N/m", ANY],
    "tension.horizontal[2]": ["Horizontal slope along y, h_y", "N/m", ANY],
    "tension.vertical[0]": ["Vertical part v₀", "N", ANY],
    "tension.vertical[1]": ["Vertical slope along x, vₓ", "N/m", ANY],
    "tension.vertical[2]": ["Vertical slope along y, v_y", "N/m", ANY],
    "motion.position": ["Position"],
    "motion.direction": ["Direction"],
    "motion.position[0]": ["Position x", "m", ANY],
    "motion.position[1]": ["Position y", "m", `${ANY} Up is positive.`],
    "motion.direction[0]": ["Direction x", "", `${ANY} 1 and 0 is to the right; x and y may not both be 0.`],
    "motion.direction[1]": ["Direction y", "", ANY],
    "motion.speed": ["Speed v", "m/s", NOT_NEGATIVE],
    "elements_per_cable": ["Elements per cable n", "", "A whole number from 2 to 200."],
    "damping.alpha": ["Mass damping α", "1/s", NOT_NEGATIVE],
    "damping.beta": ["Stiffness damping β", "s", NOT_NEGATIVE],
    "linearisation": ["Linearisation", "", { secant: "Secant", tangent: "Tangent" }],
    "max_speed": ["Search the critical speed up to", "m/s", "More than 0, at most 10000."],
};
/** The groups of fields with the scenario's parts in them; the cables stand before the last one. */
const GROUPS = [
    ["Name, platform and gravity", ["name", "platform", "gravity"]],
    ["Motion", ["motion"]],
    ["Rope", ["cable"]],
    ["Model", ["elements_per_cable", "damping", "linearisation", "max_speed"]],
];
/** What is typed is taken once there has been nothing new for so long, in ms. */
const REST = 500;

/** The largest file that is read, in bytes, as in the app. */
const LARGEST = 1_000_000;
/** What stands before a robot in an address. */
const MARK = "#s=";

const $ = (id) => document.getElementById(id);

// The worker

let worker;
const asked = new Map();
const ready = new Promise((resolve, reject) => {
    if (typeof WebAssembly !== "object") throw new Error("This browser has no WebAssembly, which the computation needs.");
    worker = new Worker(new URL("worker_loader.js", import.meta.url));
    worker.onmessage = ({ data }) => {
        if (data === "ready") return resolve();
        const answer = JSON.parse(data);
        asked.get(answer.id)?.(answer);
        asked.delete(answer.id);
    };
    worker.onerror = ({ message }) => {
        const error = new Error(`The computation does not run. Please reload the page. ${message ?? ""}`);
        reject(error);
        fail(error);
    };
});

/** The worker's answer: `{ ok }`, `{ faults }` or `{ error }`. */
async function ask(request) {
    await ready;
    return new Promise((resolve) => {
        const id = ask.count = (ask.count ?? 0) + 1;
        asked.set(id, resolve);
        worker.postMessage(JSON.stringify({ id, ...request }));
    });
}

// The scenario and its numbers

let scenario;
let maxSpeed = 40;

const keys = (path) => path.match(/[^.[\]]+/g);
const get = (path) => (path === "max_speed" ? maxSpeed : keys(path).reduce((part, key) => part?.[key], scenario));
function set(path, value) {
    if (path === "max_speed") {
        maxSpeed = value;
        return;
    }
    const [last, ...before] = keys(path).reverse();
    const part = before.reverse().reduce((part, key) => part[key], scenario);
    if (path === "name" && value === "") delete part[last];
    else part[last] = value;
}

/** May be one and a bit, or more than a thousand. */
const AMBIGUOUS = /^[+-]?[1-9]\d{0,2}(,\d{3})+$/;

/** A number as it is typed, or the text where it is none. */
function read(text) {
    const plain = text.replaceAll(/\s/g, "").replace("−", "-");
    const number = plain.replace(",", ".");
    const isOne = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(number) && !AMBIGUOUS.test(plain);
    return isOne && Number.isFinite(Number(number)) ? Number(number) : text;
}

/** What is known of the field at a path: [name, unit, allowed]. */
const known = (path) => FIELDS[path.replace(/^cables\[\d+\]\./, "")] ?? [path, "", ANY];

/** Its name among all fields. */
function title(path) {
    const cable = /^cables\[(\d+)\]/.exec(path);
    return cable ? `cable ${Number(cable[1]) + 1}${path === cable[0] ? "" : `, ${known(path)[0]}`}` : known(path)[0];
}

/** The paths of all that can be changed under one. */
function leaves(path) {
    const value = get(path);
    if (/\.tension$/.test(path)) return [path, ...(typeof value === "object" ? children(path, value) : [])];
    return typeof value === "object" && value !== null ? children(path, value) : [path];
}
const children = (path, value) => Object.keys(value)
    .flatMap((key) => leaves(Array.isArray(value) ? `${path}[${key}]` : `${path}.${key}`));

// The form

const id = (path) => `at-${path.replaceAll(/[^a-z0-9]+/gi, "-")}`;
/** Where what is wrong with a field is told. */
const errorAt = (path) => element("p", { id: `${id(path)}-error`, class: "error" });

function field(path) {
    const [name, unit, allowed] = known(path);
    const described = `${id(path)}-hint ${id(path)}-error`;
    const common = { id: id(path), "data-path": path, "aria-describedby": described };
    let control;
    if (typeof allowed === "object") {
        const options = Object.entries(allowed).map(([value, label]) => element("option", { value }, label));
        control = element("select", common, ...options);
        const value = get(path);
        const chosen = typeof value === "object" ? Object.keys(value)[0] : value;
        if (!(chosen in allowed)) control.append(element("option", { value: chosen }, chosen));
        control.value = chosen;
    } else {
        const decimal = path === "name" ? undefined : "decimal";
        control = element("input", { ...common, type: "text", inputmode: decimal, autocomplete: "off", spellcheck: "false" });
        const value = get(path) ?? "";
        control.value = typeof value === "number" ? exact(value) : value;
    }
    return element("div", { class: "field" },
        element("label", { for: id(path) }, name, unit && element("span", { class: "unit" }, ` in ${unit}`)),
        control,
        element("p", { id: `${id(path)}-hint`, class: "hint" }, typeof allowed === "string" ? allowed : ""),
        errorAt(path));
}

const grid = (paths) => element("div", { class: "grid" }, ...paths.map(field));

function showForm() {
    const groups = GROUPS.map(([name, parts]) => element("fieldset", {}, element("legend", {}, name),
        ...parts.flatMap((part) => leaves(part).length > 1 ? [errorAt(part)] : []), grid(parts.flatMap(leaves)),
        ...(name === "Motion" ? [errorAt("motion.position"), errorAt("motion.direction")] : [])));
    const cables = scenario.cables.map((_, i) => {
        const path = `cables[${i}]`;
        const remove = element("button", { type: "button", "data-remove": i }, `Remove cable ${i + 1}`);
        const name = scenario.cables[i].cable ? `Cable ${i + 1} as all others` : `Own material for cable ${i + 1}`;
        const material = element("button", { type: "button", "data-material": i }, name);
        return element("fieldset", {}, element("legend", {}, `Cable ${i + 1}`), grid(leaves(path)),
            errorAt(path), errorAt(`${path}.anchor`), element("p", {}, material, " ", remove));
    });
    const add = element("button", { type: "button", id: "add" }, "Add a cable");
    const list = element("section", { "aria-labelledby": id("cables") },
        element("h3", { id: id("cables"), tabindex: "-1" }, "Cables"),
        element("p", {}, "The tensions of exactly two cables are at equilibrium: they follow from the platform's balance. " +
            "A law gives the tension from the platform's place (x, y): the root of (h₀ + hₓ x + h_y y)² + (v₀ + vₓ x + v_y y)²."),
        errorAt("cables"), ...cables, element("p", {}, add));
    $("fields").replaceChildren(...groups.slice(0, -1), list, ...groups.slice(-1));
}

$("robot").addEventListener("submit", (event) => event.preventDefault());
$("fields").addEventListener("input", ({ target }) => {
    const { path } = target.dataset;
    if (!path) return;
    notice = "";
    if (path.endsWith(".tension")) changeLaw(path, target.value);
    else set(path, target.tagName === "SELECT" || path === "name" ? target.value : read(target.value));
    edited();
});
$("fields").addEventListener("click", ({ target }) => {
    if (target.id === "add") addCable();
    else if (target.dataset.remove) removeCable(Number(target.dataset.remove));
    else if (target.dataset.material) changeMaterial(Number(target.dataset.material));
});

/** Another law for the tension, which begins with today's tension where that is known. */
function changeLaw(path, kind) {
    const today = shown?.cables[keys(path)[1]]?.tension_at_platform;
    const tension = Number((today > 0 ? today : 50).toPrecision(3));
    set(path, { equilibrium: "equilibrium", constant: { constant: tension },
        horizontal: { horizontal: [tension, 0, 0], vertical: [0, 0, 0] } }[kind]);
    showForm();
    $(id(path)).focus();
}

/** A further cable above all others, which is a place that none of them has. */
function addCable() {
    const [x, y] = [0, 1].map((i) => scenario.cables.map(({ anchor }) => anchor[i]).filter(Number.isFinite));
    const anchor = scenario.cables[0]?.anchor.map(() => 0) ?? [0, 0];
    anchor[0] = Math.round((Math.min(0, ...x) + Math.max(0, ...x)) / 2);
    anchor[1] = Math.max(0, ...y) + 1;
    scenario.cables.push({ anchor, tension: { constant: 50 } });
    showForm();
    $(id(`cables[${scenario.cables.length - 1}].anchor[0]`)).focus();
    edited();
}

/** Gives a cable a material of its own, which is at first the common one, or takes it away. */
function changeMaterial(cable) {
    const it = scenario.cables[cable];
    if (it.cable) delete it.cable;
    else it.cable = { ...scenario.cable };
    delete scenario.schema; // the first one knows no own material, and one without a schema may have it
    showForm();
    document.querySelector(`[data-material="${cable}"]`).focus();
    edited();
}

function removeCable(cable) {
    scenario.cables.splice(cable, 1);
    showForm();
    $(id("cables")).focus();
    edited();
}

// Faults

/** Paths in the core's words as the names of the form's fields. */
const inWords = (text) => text.replace(/cables\[(\d+)\]\.anchor/g, (_, i) => `the winch point of cable ${Number(i) + 1}`)
    .replace(/[a-z_]+\.[a-z_]+/g, (path) => (path in FIELDS ? FIELDS[path][0] : path));

/** The path of the place for what is wrong at a path: its own or that of what it is in. */
function placeOf(path) {
    for (let at = path; at; at = at.replace(/(\.[^.[\]]*|\[[^\]]*\]|^[^.[\]]+)$/, "")) {
        if ($(`${id(at)}-error`)) return at;
    }
}

/** Tells the faults beside their fields, and all of them in a list that leads there. */
function showFaults(faults) {
    for (const at of $("fields").querySelectorAll(".error")) at.textContent = "";
    for (const at of $("fields").querySelectorAll("[aria-invalid]")) at.removeAttribute("aria-invalid");
    const items = faults.map(({ path, value, allowed }) => {
        const quoted = value.replace(/^"(.*)"$/, "$1");
        let found = `“${quoted}” is not allowed. Allowed: ${inWords(allowed)}.`;
        if (quoted === "") found = `Nothing is entered. Allowed: ${inWords(allowed)}.`;
        if (AMBIGUOUS.test(quoted)) found = `“${quoted}” may be ${quoted.replace(",", ".")} or ${quoted.replaceAll(",", "")}.`;
        const place = placeOf(path);
        if (place === undefined) return element("li", {}, `${path}: ${found}`);
        const error = $(`${id(place)}-error`);
        error.append(element("span", {}, `${found} `));
        const isIn = ({ dataset }) => [place, `${place}.`, `${place}[`].some((start, i) =>
            (i ? dataset.path.startsWith(start) : dataset.path === start));
        // That there are too many cables is the fault of none of their numbers.
        const wrong = place === "cables" ? [] : [...$("fields").querySelectorAll("[data-path]")].filter(isIn);
        for (const control of wrong) {
            control.setAttribute("aria-invalid", "true");
            const described = new Set([...control.getAttribute("aria-describedby").split(" "), error.id]);
            control.setAttribute("aria-describedby", [...described].join(" "));
        }
        const name = title(place);
        const href = `#${wrong[0]?.id ?? id(place)}`;
        return element("li", {}, element("a", { href }, name[0].toUpperCase() + name.slice(1)), `: ${found}`);
    });
    const heading = "The results are those of the last numbers that could be used. Please correct:";
    tell(items.length ? [element("p", {}, heading), element("ul", {}, ...items)] : []);
}

/** Why a file or a link was not opened, until something else is done. */
let notice = "";

/** Shows what is wrong; what stands there already is not told again. */
function tell(parts) {
    const all = notice ? [element("p", {}, notice), ...parts] : parts;
    const text = all.map((part) => part.textContent).join("");
    if (text !== $("faults").textContent) $("faults").replaceChildren(...all);
}

function fail(error) {
    $("state").textContent = "";
    tell([element("p", {}, error.message)]);
}

// From an edit to the results

/** The analysis on show. */
let shown;
let timer;
let isBusy = false;
let isNew = false;

function edited() {
    isNew = true;
    $("answer").classList.add("stale");
    $("state").textContent = "Computing …";
    clearTimeout(timer);
    timer = setTimeout(() => compute().catch(fail), REST);
}

/** Computes what is new, until nothing is. */
async function compute() {
    if (isBusy) return;
    isBusy = true;
    try {
        while (isNew) {
            isNew = false;
            const request = { analyze: scenario, max_speed: maxSpeed };
            const [encoded, analysed] = await Promise.all([ask({ encode: scenario }), ask(request)]);
            if (isNew) continue;
            $("state").textContent = "";
            if (encoded.ok) keep(encoded.ok);
            if (analysed.faults) {
                showFaults(analysed.faults);
            } else if (analysed.error) {
                fail(new Error(analysed.error));
            } else {
                showFaults([]);
                show(analysed.ok);
            }
        }
    } finally {
        isBusy = false;
    }
}

/** Keeps the robot in the address, so that a reload and every link have it. */
function keep(text) {
    history.replaceState(null, "", MARK + text);
    $("drawing").href = `index.html${MARK}${text}`;
    document.title = `${scenario.name || "Unnamed robot"} – Tautline, text version`;
}

/** Goes on with another robot, which the worker has checked. */
function begin(other, why = "") {
    scenario = other;
    notice = why;
    showForm();
    showFaults([]);
    edited();
}

/** The robot on show stays; `what` was not opened. */
function refuse(what, { faults, error }) {
    notice = `The ${what} was not opened. ${error ?? faults.map(({ message }) => message).join("; ")}`;
    tell([]);
}

/** Begins with the robot of a link. */
async function open(text) {
    const answer = await ask({ decode: text });
    if (answer.ok) begin(answer.ok);
    else refuse("link", answer);
}

/** Begins with a scenario as it is in a file. */
async function openFile(text) {
    try {
        const answer = await ask({ encode: JSON.parse(text) });
        if (answer.ok) await open(answer.ok);
        else refuse("file", answer);
    } catch (error) {
        refuse("file", { error: `It is not JSON (${error.message}).` });
    }
}

// Results

function show(report) {
    shown = report;
    const told = sentence(report);
    // Screen readers tell what is new here.
    if ($("answer").textContent !== told) $("answer").textContent = told;
    $("answer").classList.remove("stale");
    $("tables").replaceChildren(...tables(report, scenario.elements_per_cable));
    if (!show.isKept) keepForOffline();
    show.isKept = true;
}

/** As the app does, unless the browser is told to save data: this keeps the whole app. */
async function keepForOffline() {
    if (navigator.connection?.saveData) return;
    try {
        await navigator.serviceWorker.register("sw.js");
    } catch { /* plain http, a private window, storage that is blocked: the page works, with a network */ }
}

// Buttons, links, and the start

// The robot is in the address, so links within the page move the focus alone.
document.addEventListener("click", (event) => {
    const target = event.target.closest?.("a[href^='#']")?.getAttribute("href").slice(1);
    if (!target) return;
    event.preventDefault();
    $(target).focus();
});

$("save").addEventListener("click", () => {
    const file = new Blob([JSON.stringify(scenario, null, 2)], { type: "application/json" });
    const address = URL.createObjectURL(file);
    element("a", { href: address, download: "tautline.json" }).click();
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
});

$("copy").addEventListener("click", async () => {
    try {
        await navigator.clipboard.writeText(location.href);
        $("copied").textContent = "Copied.";
    } catch {
        $("copied").textContent = `The browser does not let the page write there. The link is: ${location.href}`;
    }
});

$("file").addEventListener("change", async ({ target }) => {
    const [file] = target.files;
    if (file?.size > LARGEST) refuse("file", { error: "It is larger than 1 MB." });
    else if (file) await file.text().then(openFile).catch(fail);
    target.value = ""; // the same file may be chosen again
});

let examples = [];
const describe = () => { $("example-text").textContent = examples[$("examples").selectedIndex]?.description ?? ""; };
$("examples").addEventListener("change", describe);
$("load").addEventListener("click", async () => begin((await ask({ example: $("examples").value })).ok));

addEventListener("hashchange", () => {
    if (location.hash.startsWith(MARK)) open(location.hash.slice(MARK.length)).catch(fail);
});

/** The robot that the app has kept, as text, if there is one. */
function keptByApp() {
    for (const storage of ["sessionStorage", "localStorage"]) {
        try {
            const text = window[storage].getItem("tautline-scenario");
            if (text) return text;
        } catch { /* storage is blocked */ }
    }
}

async function start() {
    examples = (await ask({ examples: true })).ok;
    $("examples").append(...examples.map(({ name, title }) => element("option", { value: name }, title)));
    describe();
    if (location.hash.startsWith(MARK)) await open(location.hash.slice(MARK.length));
    else if (keptByApp()) await openFile(keptByApp());
    if (!scenario) begin((await ask({ example: examples[0].name })).ok, notice);
}

start().catch(fail);
