// What the laboratory says: of its mesh, and of what is set and seen. No page in here.
import { factorOfStep } from "./lab_math.js";
import { schemeNames, shownSteps } from "./lab_state.js";

export const longer = 10;   // lines of the drift are that many times too long

/// Six digits, so that an agreement can be seen. @param rounding  what is smaller may be that alone
export function digits(x, rounding = 0) {
    if (typeof x === "string") return x;
    if (!Number.isFinite(x)) return "–";
    if (Math.abs(x) < rounding) return `< ${digits(Number(rounding.toPrecision(1)))}`;
    if (x !== 0 && (Math.abs(x) >= 1e6 || Math.abs(x) < 1e-4)) return x.toExponential(4).replace(/\.?0+e/, "e").replaceAll("-", "−").replace("e+", "e");
    return x.toPrecision(6).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "").replaceAll("-", "−");
}

const capital = (words) => words[0].toUpperCase() + words.slice(1);
const short = (x, count = 3) => digits(Number(x.toPrecision(count)));
const small = (x) => x.toExponential(1).replace("-", "−");

export function aboutMesh({ name, vertices, modes, hasAllModes, isDecimated, sourceVertices, quantisationShift, orthonormalityError, critical, meanEdge }, question) {
    const hasNoise = hasAllModes && ["q7", "lab"].includes(question);
    const from = isDecimated ? `, decimated from ${sourceVertices} vertices by quadrics` : "";
    const all = hasAllModes ? `all ${modes} modes` : `the lowest ${modes} modes: what finer modes hold is cut off before any filter, so this is a truncation, and a step beyond λ_crit cannot be seen to blow up`;
    const filters = `λ_crit = 2/μ_max = ${short(critical, 4)} length², h̄ = ${short(meanEdge, 4)} length, the mean edge. Filters use the cotangent operator of the mesh${hasNoise ? " before the noise, but for “noisy mesh's operator”, with which question 7 denoises; the spectrum shows its result in the modes of the clean mesh" : ""}.${hasNoise ? " Gain: what the noisy mesh has of the distance to the clean surface, of rms to the vertices' own places, and of the angle to the clean normals, over what is left." : ""}`;
    return `Mesh: ${name}${from}; ${vertices} vertices, ${all}. The modes are stored in 16 bits: no vertex of their sum is off by more than ${small(quantisationShift)} of the box diagonal, and ΦᵀMΦ differs from 1 by at most ${small(orthonormalityError)}. ` +
        `${filters} In the spectrum 1 is the largest coefficient before, and a filter that changes nothing. “The program”: what meshfolio itself computes on this mesh, stored for the settings of the report and those to try; – elsewhere.`;
}

/// @param clamped  vertices drawn at the rim; best: the t of the least error, null: there is none
export function told({ state, data, experiment, numbers, clamped, best }) {
    if (experiment.hasNoStep) return "Taubin's second step does not exist for so large a λ: nothing is filtered.";
    const { scheme, k, t, sigma, lines } = state, size = 100 * numbers.rms / data.diagonal;
    const step = scheme === "denoising" ? `${digits(state.edges)} h̄²` : `${digits(state.lambda)} λ_crit`;
    const set = scheme !== "projection" ? `${capital(schemeNames[scheme])}, λ = ${step}, t = ${t}` : k === 1 ? `The smoothest of ${data.modes} modes` : `The ${k} smoothest of ${data.modes} modes`;
    const rms = Number.isNaN(size) ? "rms beyond all measure" : size === 0 ? "nothing has moved" : `rms ${digits(Number(size.toPrecision(3)), 100 * data.rounding)} % of the box`;
    const constant = data.mu.filter(data.isConstant).length;   // modes, one a part of the mesh
    const parts = scheme !== "projection" || k > constant ? "" : constant === 1 ? " It is constant: nothing is left but a point."
        : ` The first ${constant} modes are constant on each part of the mesh: of so few, nothing is left but a point a part.`;
    const finest = ["projection", "denoising"].includes(scheme) ? 1 : Math.abs(factorOfStep(data, scheme, state.lambda * data.critical)(data.largestEigenvalue));
    const growth = finest > 1 + 1e-12 ? ` Beyond the limit: each step multiplies the finest mode by ${digits(finest)}.` : "";
    const rim = clamped > 0 ? ` Flown out of the view, and drawn at its rim: ${clamped} of ${data.vertices} vertices.` : "";
    const least = best === null ? "" : best === shownSteps ? ` Up to t = ${shownSteps} it comes ever nearer to the clean surface.` : ` Nearest to the clean surface at t = ${best}.`;
    const drift = lines ? ` Lines show how far vertices lie from their place along the surface, ${longer} times too long${sigma > 0 ? driftWords(experiment) : ""}.` : "";
    return `${set}: ${rms}.${parts}${growth}${rim}${least}${sigma > 0 ? operatorWords(state, numbers) : ""}${drift}`;
}

/// Why the noise goes, or stays, as no one sees it who has only the noisy mesh.
function operatorWords({ scheme, t }, { along, gains: [gain] }) {
    if (scheme === "projection" || t === 0) return "";
    if (scheme !== "denoising") return " These steps know the clean mesh's operator, which nobody has who denoises.";
    return gain > 1 && along > 0.5 ? ` Of rms², ${short(100 * along, 2)} % lies along the surface: there the noisy mesh's operator takes little away, and coefficients stay above the filter's curve.` : "";
}

/// How much of the noise's squared error is left along the surface, and across it.
function driftWords(experiment) {
    const { noisy, x } = experiment, now = experiment.errors(x);
    const along = ({ surface, places }) => places ** 2 - surface ** 2, across = ({ surface }) => surface ** 2;
    const share = (part) => short(part(now) / part(noisy));
    return `; the squared error along the surface is ${share(along)} times that of the noisy mesh, across it ${share(across)} times`;
}
