// The state of the laboratory: its limits, links and presets. Independent of the page.

export const schemeNames = { projection: "k smoothest modes", explicit: "explicit steps", implicit: "implicit steps", taubin: "Taubin's two steps", heat: "exact heat flow",
    denoising: "implicit, noisy mesh's operator" };
export const mostSteps = 10000, mostSolved = 1000, shownSteps = 200, largestLambda = 1000, largestNoise = 5, largestEdges = 100;

export const colourNames = { distance: "distance", curvature: "mean curvature", none: "none" };

/// λ is in units of λ_crit as `lambda`, in squared mean edges h̄² as `edges`.
const plain = { scheme: "projection", k: 15, lambda: 0.5, edges: 0.1, t: 10, sigma: 0, seed: 1, lines: false, colours: "distance", wire: false };
const texts = { scheme: schemeNames, colours: colourNames };   // what may stand there
const looks = ["lines", "wire"];
/// Returns the quantity of the question's own figures.
const coloursOf = (question) => (["q5", "q6"].includes(question) ? "curvature" : "distance");
/// Returns the settings that control the strength of a scheme.
export const amountsOf = (scheme) => (scheme === "projection" ? ["k"] : [scheme === "denoising" ? "edges" : "lambda", "t"]);
/// The initial state of a question and its presets [{question, words, state}], both from lab.cpp of its chapter.
export const startOf = (data, question) => ({ ...plain, colours: coloursOf(question), ...data.starts[question] });
export const presetsOf = (data, question) => data.presets.filter((preset) => question === "lab" || preset.question === question)
    .map((preset) => ({ ...preset, state: { ...plain, colours: coloursOf(preset.question), lines: preset.lines, ...preset.state } }));

const within = (value, low, high) => Math.min(high, Math.max(low, value));

/// Returns a valid state. @param other  replaces settings that cannot be read
export function held(state, modes, other = plain) {
    const number = (name, low, high) => within(Number.isFinite(state[name]) ? state[name] : other[name], low, high);
    const whole = (name, low, high) => Math.round(number(name, low, high));
    return {
        scheme: Object.hasOwn(schemeNames, state.scheme) ? state.scheme : other.scheme,
        k: whole("k", 1, modes),
        lambda: number("lambda", 0, largestLambda),
        edges: number("edges", 0, largestEdges),
        t: whole("t", 0, state.scheme === "denoising" ? mostSolved : mostSteps),
        sigma: number("sigma", 0, largestNoise),
        seed: whole("seed", 0, 1e9),
        ...Object.fromEntries(looks.map((name) => [name, Boolean(state[name])])),
        colours: Object.hasOwn(colourNames, state.colours) ? state.colours : other.colours,
    };
}

/// Returns the link to a state with the settings that matter in it: "#lab=q5,scheme=explicit,lambda=1.01,t=40".
export function linkOf(question, state) {
    const names = ["scheme", ...amountsOf(state.scheme), "sigma", ...(state.sigma > 0 ? ["seed"] : [])];
    const shown = [...looks.filter((name) => state[name]).map((name) => `${name}=1`), ...(state.colours === coloursOf(question) ? [] : [`colours=${state.colours}`])];
    return "#" + [`lab=${question}`, ...names.map((name) => `${name}=${state[name]}`), ...shown].join(",");
}

/// @return {question, change: the settings of the link}; null for another fragment
export function readLink(fragment) {
    const text = fragment.replace(/^#/, "").replace(/%2c/gi, ",").replace(/%3d/gi, "=");   // as mail and chat write it
    const parts = new Map(text.split(",").map((part) => part.split("=", 2)));
    const question = parts.get("lab");
    if (!/^\w+$/.test(question ?? "")) return null;
    const isRead = (name) => (name in texts ? Object.hasOwn(texts[name], parts.get(name)) : parts.get(name) && Number.isFinite(Number(parts.get(name))));
    const names = Object.keys(plain).filter((name) => parts.has(name) && isRead(name));
    return { question, change: Object.fromEntries(names.map((name) => [name, name in texts ? parts.get(name) : Number(parts.get(name))])) };
}

export const sameState = (a, b) => ["scheme", "sigma", "lines", ...amountsOf(a.scheme), ...(a.sigma > 0 ? ["seed"] : [])]
    .every((name) => a[name] === b[name] || Math.abs(a[name] - b[name]) <= 1e-9 * Math.abs(b[name]));

/// λ on its slider: the first 60 % are 0 to 3 λ_crit, the rest is logarithmic up to 1000.
const bend = 0.6, atBend = 3;
export const lambdaAt = (place) => (place <= bend ? place / bend * atBend : atBend * (largestLambda / atBend) ** ((place - bend) / (1 - bend)));
export const placeOf = (lambda) => (lambda <= atBend ? lambda / atBend * bend : bend + (1 - bend) * Math.log(lambda / atBend) / Math.log(largestLambda / atBend));

/// λ in squared mean edges on its slider: logarithmic from a ten thousandth on, and 0 at its end.
const leastEdges = 1e-4;
export const edgesAt = (place) => (place <= 0 ? 0 : leastEdges * (largestEdges / leastEdges) ** place);
export const placeOfEdges = (edges) => (edges <= leastEdges ? 0 : Math.log(edges / leastEdges) / Math.log(largestEdges / leastEdges));

/// Whole numbers on a slider: every one up to 50, beyond in steps of 2 %.
export function stopsOf(low, high) {
    const stops = [];
    for (let stop = low; stop < high; stop = Math.max(stop + 1, Math.round(1.02 * stop))) stops.push(stop);
    return [...stops, high];
}
