// The results of the text version: an analysis as one sentence and as tables.

/** Modes that are listed at first. */
const FIRST = 20;

/** An element with these attributes, where they are not undefined, and what is in it. */
export function element(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
        if (value !== undefined) made.setAttribute(key, value);
    }
    made.append(...children);
    return made;
}

/** All digits of a number, with an exponent where it is small or large. */
export function exact(number) {
    const size = Math.abs(number);
    return size !== 0 && (size < 1e-3 || size >= 1e6) ? number.toExponential().replace("e+", "e") : String(number);
}

/** So many digits of a number. */
const rounded = (number, digits = 5) => (number === null ? "not known" : exact(Number(number.toPrecision(digits))));

const KINDS = { flutter: "Flutter", divergence: "Divergence" };

/** The answer as one sentence. */
export function sentence(report) {
    const { critical, speed, wave_limit: wave } = report;
    if (report.feasible === false || (report.status === "failed" && !critical)) return report.reason;
    const parts = [];
    if (!critical) {
        parts.push(`No critical speed up to ${rounded(report.searched_up_to)} m/s`);
    } else {
        const frequency = critical.kind === "flutter" ? ` of ${rounded(critical.frequency_hz, 3)} Hz` : "";
        const kind = `${KINDS[critical.kind]}${frequency} in cable ${critical.cable}`;
        parts.push(`${kind} begins at the critical speed, ${rounded(critical.speed, 3)} m/s`);
    }
    const stable = report.stable === null ? "" : `the robot is ${report.stable ? "stable" : "unstable"}`;
    const margin = critical?.speed > 0 ? Math.round(100 * Math.abs(speed / critical.speed - 1)) : undefined;
    const side = margin === undefined ? "" : `, ${margin} % ${speed > critical.speed ? "above" : "below"} it`;
    if (stable) parts.push(`at ${rounded(speed)} m/s ${stable}${side}`);
    if (wave) parts.push(`the wave limit is ${rounded(wave.speed, 3)} m/s`);
    return `${parts.join("; ")}.`;
}

/** A table that can be scrolled on its own where it is too wide. */
function table(caption, head, rows) {
    const headers = head.map((text) => element("th", { scope: "col" }, text));
    const body = rows.map(([first, ...others]) => element("tr", {},
        element("th", { scope: "row" }, String(first)), ...others.map((text) => element("td", {}, text))));
    return element("div", { class: "scroll", role: "region", tabindex: "0", "aria-label": caption },
        element("table", {}, element("caption", {}, caption),
            element("thead", {}, element("tr", {}, ...headers)), element("tbody", {}, ...body)));
}

function criticalTable(report, elements) {
    const { critical, wave_limit: wave, slack_acceleration: slack } = report;
    const yes = (value) => (value === null ? "not known" : value ? "yes" : "no");
    const rows = critical ? [
        ["Critical speed as computed", `${critical.speed} m/s`],
        ["Frequency", `${rounded(critical.frequency_hz)} Hz`],
        ["Stability is lost by", critical.kind],
        ["Responsible cable", critical.cable],
    ] : [["Critical speed", `none up to ${rounded(report.searched_up_to)} m/s`]];
    if (wave) {
        rows.push(["Wave limit", `${rounded(wave.speed)} m/s, cable ${wave.cable}, ${wave.reeled_in ? "reeled in" : "paid out"}`]);
    }
    for (const [limit, how] of [[slack?.accelerating, "speeding up"], [slack?.braking, "braking"]]) {
        if (limit) rows.push([`Slack acceleration, ${how}`, `${rounded(limit.value)} m/s² by statics, cable ${limit.cable}`]);
    }
    if (slack) {
        rows.push(["Slack in flight", "earlier: at up to 30 % less peak speed, which is half the acceleration"],
            ["Deviation per m/s²", `${rounded(1e3 * slack.deviation_per_acceleration)} mm`]);
    }
    rows.push(["Stable at rest", yes(report.stable_at_rest)],
        [`Stable at ${rounded(report.speed)} m/s`, yes(report.stable)],
        ["Largest growth rate at this speed", report.max_growth_rate === null ? "not known" : `${rounded(report.max_growth_rate)} 1/s`]);
    return table(`Critical point, with ${elements} elements per cable`, ["Quantity", "Value"], rows);
}

function cablesTable({ cables, speed }) {
    const rows = cables.map((cable, i) => {
        const rate = cable.length_rate;
        const words = `${rate < 0 ? "reeled in" : "paid out"} at ${rounded(Math.abs(rate * speed), 3)} m/s`;
        return [i + 1, rounded(cable.tension_at_platform), rounded(cable.tension_at_winch), rounded(cable.unstretched_length),
            rounded(rate), rate * speed === 0 ? "held" : words];
    });
    return table("Tensions, lengths and winches", ["Cable", "Tension at the platform in N", "Tension at the winch in N",
        "Unstretched length in m", "Length rate in m/m", "Winch"], rows);
}

function modesTable({ eigenvalues, speed }, all) {
    // Of a pair of conjugates the upper one stands for both.
    const upper = eigenvalues.filter(([, im]) => im >= 0).sort((a, b) => a[1] - b[1] || b[0] - a[0]);
    const modes = [];
    for (const [re, im] of upper) {
        const last = modes.at(-1);
        if (last?.re === re && last.im === im) last.count++;
        else modes.push({ re, im, count: 1 });
    }
    const rows = modes.slice(0, all ? undefined : FIRST).map(({ re, im, count }, i) => {
        const size = Math.hypot(re, im);
        return [i + 1, rounded(im / (2 * Math.PI)), rounded(re), size > 0 ? rounded(-re / size, 3) : "0",
            re < 0 ? "dies out" : re > 0 ? "grows" : "stays", count];
    });
    const made = table(`Modes at ${rounded(speed)} m/s, the slowest first`,
        ["Mode", "Frequency in Hz", "Growth rate in 1/s", "Damping ratio", "A disturbance", "Equal modes"], rows);
    if (rows.length === modes.length) return [made];
    const more = element("button", { type: "button" }, `Show all ${modes.length} modes`);
    more.addEventListener("click", () => {
        const [whole] = modesTable({ eigenvalues, speed }, true);
        made.replaceWith(whole);
        more.parentElement.remove();
        whole.focus();
    });
    return [made, element("p", {}, more)];
}

/** All that follows from the numbers, as tables. */
export function tables(report, elements) {
    if (report.cables.length === 0) return [element("p", {}, "There is nothing to list without an equilibrium.")];
    return [...(report.reason ? [element("p", {}, report.reason)] : []), criticalTable(report, elements), cablesTable(report),
        ...(report.eigenvalues.length ? modesTable(report) : [])];
}
