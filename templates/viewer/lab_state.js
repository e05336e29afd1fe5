// What is set in the laboratory, its limits, its links and its presets. No page in here.

export const schemeNames = { projection: "k smoothest modes", explicit: "explicit steps", implicit: "implicit steps", taubin: "Taubin's two steps", heat: "exact heat flow" };
export const mostSteps = 10000, shownSteps = 200, largestLambda = 1000, largestNoise = 5;

const start = { scheme: "projection", k: 15, lambda: 0.5, t: 10, sigma: 0, seed: 1, lines: false };
const ofQuestion = {
    q5: { scheme: "explicit" },
    q6: { scheme: "implicit", lambda: 2, t: 1 },
    q7: { scheme: "explicit", lambda: 0.25, t: 5, sigma: 1 },
};
export const startOf = (question) => ({ ...start, ...ofQuestion[question] });

const presets = {
    q4: [["k = 5", { scheme: "projection", k: 5 }], ["k = 15", { scheme: "projection", k: 15 }], ["k = 30", { scheme: "projection", k: 30 }]],
    q5: [["just below λ_crit", { scheme: "explicit", lambda: 0.99, t: 40 }], ["just above", { scheme: "explicit", lambda: 1.05, t: 40 }],
         ["twice λ_crit", { scheme: "explicit", lambda: 2, t: 5 }], ["Taubin: smooth, keep the volume", { scheme: "taubin", lambda: 0.5, t: 20 }]],
    q6: [["moderate", { scheme: "implicit", lambda: 2, t: 1 }], ["explicit at the same λ", { scheme: "explicit", lambda: 2, t: 6 }],
         ["implicit at 100 λ_crit", { scheme: "implicit", lambda: 100, t: 1 }], ["exact heat flow for that time", { scheme: "heat", lambda: 100, t: 1 }]],
    q7: [["noisy", { scheme: "explicit", lambda: 0.25, t: 0, sigma: 1 }], ["best t for this noise", { scheme: "explicit", lambda: 0.25, t: "best", sigma: 1 }],
         ["too long", { scheme: "explicit", lambda: 0.25, t: 200, sigma: 1 }],
         ["drift: what cannot come back", { scheme: "explicit", lambda: 0.25, t: "best", sigma: 1, lines: true }]],
};
/// [[words, state]] of a question; of a laboratory that belongs to none, all.
export const presetsOf = (question) => (presets[question] ?? Object.values(presets).flat()).map(([words, change]) => [words, { ...start, ...change }]);

const within = (value, low, high) => Math.min(high, Math.max(low, value));

/// A state that holds, whatever was asked for.
export function held(state, modes) {
    const whole = (value, low, high, other) => within(Number.isFinite(value) ? Math.round(value) : other, low, high);
    const number = (value, low, high, other) => within(Number.isFinite(value) ? value : other, low, high);
    return {
        scheme: Object.hasOwn(schemeNames, state.scheme) ? state.scheme : start.scheme,
        k: whole(state.k, 1, modes, start.k),
        lambda: number(state.lambda, 0, largestLambda, start.lambda),
        t: state.t === "best" ? "best" : whole(state.t, 0, mostSteps, start.t),
        sigma: number(state.sigma, 0, largestNoise, 0),
        seed: whole(state.seed, 0, 1e9, 1),
        lines: Boolean(state.lines),
    };
}

/// "#lab=q5,scheme=explicit,lambda=1.01,t=40": of a state only what matters in it.
export function linkOf(question, state) {
    const parts = [`lab=${question}`, `scheme=${state.scheme}`];
    const matters = state.scheme === "projection" ? ["k"] : ["lambda", "t"];
    if (state.sigma > 0) matters.push("sigma", "seed");
    else if (startOf(question).sigma > 0) matters.push("sigma");
    for (const name of matters) parts.push(`${name}=${state[name]}`);
    if (state.lines) parts.push("lines=1");
    return "#" + parts.join(",");
}

/// @return {question, state}; null for another fragment
export function readLink(fragment) {
    const parts = new Map(fragment.replace(/^#/, "").split(",").map((part) => part.split("=", 2)));   // what we write needs no decoding
    const question = parts.get("lab");
    if (!/^\w+$/.test(question ?? "")) return null;
    const state = startOf(question);
    for (const name of Object.keys(state)) {
        const word = parts.get(name);
        if (word === undefined) continue;
        if (name === "scheme") state.scheme = word;
        else state[name] = word === "best" ? word : Number(word);
    }
    return { question, state };
}

/// λ on its slider: the first 60 % are 0 to 3 λ_crit, what follows is logarithmic up to 1000.
const bend = 0.6, atBend = 3;
export const lambdaAt = (place) => (place <= bend ? place / bend * atBend : atBend * (largestLambda / atBend) ** ((place - bend) / (1 - bend)));
export const placeOf = (lambda) => (lambda <= atBend ? lambda / atBend * bend : bend + (1 - bend) * Math.log(lambda / atBend) / Math.log(largestLambda / atBend));
