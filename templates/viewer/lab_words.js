// The sentences of the laboratory, about its mesh, settings and results. Independent of the page.
import { finestFactor } from "./lab_math.js";
import { schemeNames, shownSteps } from "./lab_state.js";

export const longer = 10, longest = 0.25;   // lines of the drift are exaggerated that many times, and cut at so many radii of the mesh

/// @param rounding  smaller numbers may be rounding alone
export function digits(x, rounding = 0, count = 6) {
    if (typeof x === "string") return x;
    if (!Number.isFinite(x)) return "–";
    const size = Math.abs(x);
    if (size < rounding) return `< ${digits(Number(rounding.toPrecision(1)))}`;
    const isPlain = x === 0 || (size >= 1e-4 && size < 1e6);
    return (isPlain ? String(Number(x.toPrecision(count))) : x.toExponential(Math.min(count, 5) - 1).replace(/\.?0+e/, "e")).replaceAll("-", "−").replace("e+", "e");
}

const capital = (words) => words[0].toUpperCase() + words.slice(1);
const short = (x, count = 3) => digits(x, 0, count);
const small = (x) => x.toExponential(1).replace("-", "−");

/// Returns the sentence above the experiment.
export function watchOf({ scheme, sigma }) {
    return {
        projection: "A mesh is a sum of waves. Drag k: fewer waves, smoother shape.",
        explicit: "Each step pulls every vertex towards its neighbours. Drag λ past 1 λ_crit: the steps blow up.",
        implicit: "Implicit steps never blow up. Drag λ as far as you like: the mesh only shrinks.",
        taubin: "One step shrinks, the next one swells. Play t: bumps go, most of the volume stays.",
        heat: "Heat flow: endlessly many tiny steps. Play λ: short waves die first, then the shape.",
        denoising: "Noise and sharp edges are both short waves. Play t: the distance falls, then rises again.",
    }[scheme] + (sigma > 0 && scheme !== "denoising" ? " The noise goes first, then the shape." : "");
}

/// A line for each part of the panel, and the rest.
export function notesOf({ name, vertices, modes, hasAllModes, isDecimated, sourceVertices, quantisationShift, critical, meanEdge }, question) {
    const hasNoise = hasAllModes && ["q7", "lab"].includes(question);
    const from = isDecimated ? `, decimated from ${sourceVertices} vertices by quadrics` : "";
    return {
        mesh: `${name}${from}: ${vertices} vertices, ${hasAllModes ? `all ${modes} modes` : `the lowest ${modes} modes`}.`,
        modes: "Each dot is a wave: long ones left, short ones right; the higher, the more of it the mesh has.",
        errors: "The curve falls while noise goes; it rises where smoothing takes the shape, or blows up.",
        details: [
            hasAllModes ? "" : "What finer modes hold is cut off before any filter: this is a truncation, and a step beyond λ_crit cannot be seen to blow up.",
            hasAllModes ? `λ_crit = 2/μ_max = ${short(critical)} length², the limit of explicit steps. Mean edge h̄ = ${short(meanEdge)} length.` : "",
            `Filters use the cotangent operator of the mesh${hasNoise ? " before the noise. The report denoises with the “noisy mesh's operator”; the spectrum shows its result in the modes of the clean mesh" : ""}.`,
            hasNoise ? "Gain: how many times smaller the error is than that of the noisy mesh. Three errors: distance to the clean surface, rms to the vertices' own places, and angle to the clean normals." : "",
            "In the spectrum 1 is the largest coefficient before, and a filter that changes nothing. The shortest wave is the mode of μ_max; a negative factor flips it.",
            "Mean curvature is coloured 0 at the border, where it is not defined.",
            `The modes are stored in 16 bits or fewer: no vertex of their sum is off by more than ${small(quantisationShift)} of the box diagonal.`,
            "The address of the page keeps what is set.",
        ].filter(Boolean),
    };
}

const shareOf = (x, of) => `${short(100 * x / of)} %`;

/// At most four numbers that are seen at a glance: [number, words].
export function tilesOf({ state, data, experiment }, numbers) {
    if (experiment.hasNoStep) return [];
    const { first, startEnergy } = experiment, tiles = [], [gain] = numbers.gains ?? [];
    if (state.sigma > 0) tiles.push(gain < 1 ? [`${short(1 / gain)} ×`, "farther from the clean surface than the noisy mesh"] : [`${short(gain)} ×`, "nearer to the clean surface than the noisy mesh"]);
    tiles.push([`${short(100 * numbers.rms / data.diagonal)} %`, state.sigma > 0 ? "of the box: rms to the clean vertices" : "of the box: how far vertices moved (rms)"]);
    if (data.isClosed) tiles.push([shareOf(numbers.volume, first.volume), "of the volume is left"]);
    tiles.push([shareOf(numbers.energy, startEnergy), "of the roughness is left (Dirichlet energy)"]);
    if (tiles.length < 4 && !Number.isNaN(numbers.factor)) tiles.push([`× ${short(numbers.factor, 2)}`, "for the shortest wave, each step"]);
    return tiles;
}

/// Returns the number of digits in which page and program agree; null if the program has computed nothing here.
export function sharedDigits(measured) {
    const both = measured.filter(([, , , program]) => Number.isFinite(program));
    const apart = both.map(([, , here, program, rounding = 0]) => (here === program || Math.max(Math.abs(here), Math.abs(program)) < rounding ? 0 : Math.abs(here / program - 1)));
    return both.length > 0 ? Math.max(0, Math.min(6, Math.floor(-Math.log10(2 * Math.max(...apart, 1e-12))))) : null;
}

/// Returns the title of the folded table, which says in how many digits page and program agree.
export function agreement(measured) {
    const shared = sharedDigits(measured);
    if (shared === null) return "All numbers; the program's own stand beside them at the settings to try";
    return shared >= 4 ? `✓ agrees with the program to ${shared} digits` : `✗ agrees with the program to ${shared} digits only`;
}

/// The limits that sliders pass: on which side of each it is, from 0 on, and what each side means. A side is named by the scheme, too.
export function limits({ state, data, experiment, numbers, clamped, best }) {
    if (experiment.hasNoStep) return {};
    const { scheme, lambda, t, k } = state, all = {}, say = (name, side, ...words) => { all[`${scheme} ${name}`] = { side: Number(side), words }; };
    const kept = numbers.volume / experiment.first.volume, carried = data.mu.filter((mu) => mu <= (Math.PI / data.meanEdge) ** 2).length;   // wavelength 2π/√μ
    if (data.isClosed && clamped === 0 && Number.isFinite(kept)) say("volume", kept < 0.5, "More than half of the volume is there again.", "More than half of the volume is now gone.");
    if (scheme === "projection") say("edges", k > carried, `Up to k = ${carried} every wave is longer than two mean edges.`,
        `Past k = ${carried}: the waves added now are shorter than two mean edges, too short for the mesh to show well.`);
    if (scheme === "explicit") say("flip", lambda > 0.5, "Below half of λ_crit: no wave flips any more.", "Past half of λ_crit: the shortest waves now flip at every step, hills to dips.");
    if (scheme === "explicit") say("limit", lambda > 1, "Below λ_crit again: every wave shrinks.", "Past λ_crit: the shortest waves now grow at every step.");
    if (scheme === "implicit") say("limit", lambda > 1, "Below λ_crit: explicit steps would be stable here, too.", "Past λ_crit: explicit steps would blow up here; implicit ones still shrink every wave.");
    if (scheme === "taubin") say("limit", Math.abs(finestFactor(data, state)) > 1 + 1e-12, "Below the limit of Taubin's steps: the shortest waves shrink again.", "Past the limit of Taubin's steps: the shortest waves now grow.");
    if (best !== null && best < shownSteps) say("least", 1 + Math.sign(t - best), "Before the least error: more steps still lead nearer to the clean surface.",
        "This is the least error: with fewer steps or more the surface is farther from the clean one.", "Past the least error: more steps now lead away from the clean surface.");
    return all;
}

/// Returns a sentence on the last limit that lies between the states before and now; "" if there is none.
export function passed(before, now) {
    const name = Object.keys(now).findLast((each) => before[each] && before[each].side !== now[each].side);
    return name ? now[name].words[now[name].side] : "";
}

/// @param clamped  vertices drawn at the rim; best: the t of the least error, null: there is none
export function told({ state, data, experiment, numbers, clamped, best }) {
    if (experiment.hasNoStep) return "Taubin's second step does not exist for so large a λ: nothing is filtered.";
    const { scheme, k, t, sigma, lines } = state, size = 100 * numbers.rms / data.diagonal;
    const step = scheme === "denoising" ? `${digits(state.edges)} h̄²` : `${digits(state.lambda)} λ_crit`;
    const set = scheme !== "projection" ? `${capital(schemeNames[scheme])}, λ = ${step}, t = ${t}` : k === 1 ? `The smoothest of ${data.modes} modes` : `The ${k} smoothest of ${data.modes} modes`;
    const rms = Number.isNaN(size) ? "rms beyond all measure" : size === 0 ? "nothing has moved" : `rms ${digits(size, 100 * data.rounding, 3)} % of the box`;
    const constant = data.mu.filter(data.isConstant).length;   // modes, one a part of the mesh
    const parts = scheme !== "projection" || k > constant ? "" : constant === 1 ? " It is constant: nothing is left but a point."
        : ` The first ${constant} modes are constant on each part of the mesh: of so few, nothing is left but a point a part.`;
    const finest = Math.abs(finestFactor(data, state));
    const growth = finest > 1 + 1e-12 ? ` Beyond the limit: each step multiplies the shortest wave by ${digits(finest)}.` : "";
    const rim = clamped > 0 ? ` Flown out of the view, and drawn at its rim: ${clamped} of ${data.vertices} vertices.` : "";
    const least = best === null ? "" : best === shownSteps ? ` Up to t = ${shownSteps} it comes ever nearer to the clean surface.` : ` Nearest to the clean surface at t = ${best}.`;
    const drift = lines ? ` Lines show how far vertices lie from their place along the surface, exaggerated ${longer}× and cut where they would be longer than a quarter of the mesh${sigma > 0 ? driftWords(experiment) : ""}.` : "";
    return `${set}: ${rms}.${parts}${growth}${rim}${least}${sigma > 0 ? operatorWords(state, numbers) : ""}${drift}`;
}

/// Returns a sentence on the reason why noise goes or stays, which the noisy mesh alone does not show.
function operatorWords({ scheme, t }, { along, gains: [gain] }) {
    if (scheme === "projection" || t === 0) return "";
    if (scheme !== "denoising") return " These steps know the clean mesh's operator, which nobody has who denoises.";
    return gain > 1 && along > 0.5 ? ` Of rms², ${short(100 * along, 2)} % lies along the surface: there the noisy mesh's operator takes little away, and coefficients stay above the filter's curve.` : "";
}

/// Returns the remaining shares of the squared error of the noise along the surface and across it.
function driftWords(experiment) {
    const { noisy, x } = experiment, now = experiment.errors(x);
    const along = ({ surface, places }) => places ** 2 - surface ** 2, across = ({ surface }) => surface ** 2;
    const share = (part) => short(part(now) / part(noisy));
    return `; the squared error along the surface is ${share(along)} times that of the noisy mesh, across it ${share(across)} times`;
}
