// The mathematics of the laboratory, without a page: x = Σ f(μᵢ) cᵢ φᵢ, with the filter f of a scheme. Also read by the tests (node).
import { sameState } from "./lab_state.js";

/// Reads the header and the numbers that src/run/lab/lab_mesh.cpp writes.
export function decoded(buffer) {
    const length = new DataView(buffer).getUint32(0, true);
    const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    const { vertices: n, triangles: m, modes: count } = header;
    let at = 4 + length;
    const doubles = (size) => { const part = new Float64Array(buffer, at, size); at += 8 * size; return part; };
    const data = {
        ...header, mu: doubles(count), area: doubles(n), positions: doubles(3 * n), coefficients: doubles(3 * count), scale: doubles(count),
        corners: new Uint32Array(buffer, at, 3 * m),
    };
    at += 12 * m;
    const high = new Int8Array(buffer, at, n * count), low = new Uint8Array(buffer, at + n * count, n * count);
    data.numbers = new Int16Array(n * count);   // mode by mode
    for (let i = 0; i < n * count; ++i) data.numbers[i] = 256 * high[i] + low[i];
    data.isBorder = borderOf(data);
    data.critical = 2 / data.largestEigenvalue;
    data.isConstant = (mu) => mu <= 1e-9 * data.largestEigenvalue;   // 0 but for rounding: one mode a component
    data.hasAllModes = count >= data.area.filter((a) => a > 0).length;
    if (!data.hasAllModes) addNeighbours(data);
    data.totalArea = data.area.reduce((sum, a) => sum + a, 0);
    data.rounding = data.hasAllModes ? 1e-12 : data.quantisationShift;   // box diagonals: what is smaller may be that alone
    return data;
}

/// Restores numbers that are stored as differences from the mean of earlier neighbours.
function addNeighbours({ numbers, corners, vertices: n }) {
    const before = Array.from({ length: n }, () => new Set()), start = new Int32Array(n + 1);
    for (let i = 0; i < corners.length; ++i) {
        const [a, b] = [corners[i], corners[i % 3 === 2 ? i - 2 : i + 1]];
        before[Math.max(a, b)].add(Math.min(a, b));
    }
    before.forEach(({ size }, v) => { start[v + 1] = start[v] + size; });
    const others = Int32Array.from(before.flatMap((set) => [...set]));
    for (let mode = 0; mode < numbers.length; mode += n) {
        for (let v = 0; v < n; ++v) {
            const written = numbers[mode + v], end = start[v + 1];
            let sum = 0;
            for (let i = start[v]; i < end; ++i) sum += numbers[mode + others[i]];
            numbers[mode + v] = (written >>> 1 & 0x7fff ^ -(written & 1)) + Math.floor(sum / (end - start[v] || 1));   // wraps around in 16 bits
        }
    }
}

/// Returns for each vertex whether it is on the boundary.
function borderOf({ corners, vertices }) {
    const open = new Set(), isBorder = new Uint8Array(vertices);
    for (let i = 0; i < corners.length; ++i) {
        const [a, b] = [corners[i], corners[i % 3 === 2 ? i - 2 : i + 1]], edge = Math.min(a, b) * 2 ** 26 + Math.max(a, b);
        if (!open.delete(edge)) open.add(edge);
    }
    for (const edge of open) isBorder[Math.floor(edge / 2 ** 26)] = isBorder[edge % 2 ** 26] = 1;
    return isBorder;
}

const largest = 1e150;   // so that squares are numbers: what grows beyond is not measured
const nothing = 1e-10;   // a mode of which less is left is not added up

/// Whether every mode is within what can be measured.
export const isMeasurable = (f) => f.every((x) => Math.abs(x) < largest);

/// Taubin's second step, negative: 1/λ + 1/m = ½ · 0.1 μ_max as in src/geometry/smoothing. NaN where λ is too large for it.
export function taubinBack(data, lambda) {
    if (lambda === 0) return -0;   // no step at all
    const inverse = 0.05 * data.largestEigenvalue - 1 / lambda;
    return inverse < 0 ? 1 / inverse : NaN;
}

/// Returns the factor of one step for the mode of eigenvalue μ; λ in model units.
export function factorOfStep(data, scheme, lambda) {
    if (scheme === "implicit") return (mu) => 1 / (1 + lambda * mu);
    if (scheme === "heat") return (mu) => Math.exp(-lambda * mu);
    if (scheme === "explicit") return (mu) => 1 - lambda * mu;
    const back = taubinBack(data, lambda);
    return (mu) => (1 - lambda * mu) * (1 - back * mu);
}

/// f(μᵢ) of a state: {scheme, k, lambda (in λ_crit), t}.
export function filter(data, { scheme, k, lambda, t }) {
    if (scheme === "projection") return Float64Array.from(data.mu, (_, i) => (i < k ? 1 : 0));
    const factor = factorOfStep(data, scheme, lambda * data.critical);
    return Float64Array.from(data.mu, (mu) => Math.max(-largest, Math.min(largest, factor(mu) ** t)));
}

/// |f(μ)| of a state, between the modes too; of the denoising as if the noisy mesh had the modes of the clean one.
export function filterCurve(data, { scheme, k, lambda, edges, t }) {
    if (scheme === "projection") return (mu) => (mu <= data.mu[k - 1] ? 1 : 0);
    const factor = scheme === "denoising" ? factorOfStep(data, "implicit", edges * data.meanEdge ** 2) : factorOfStep(data, scheme, lambda * data.critical);
    return (mu) => Math.min(largest, Math.abs(factor(mu)) ** t);
}

/// Returns the factor of one step for the finest mode; NaN for the projection, which has no steps, and for denoising, which has no modes here.
export const finestFactor = (data, { scheme, lambda }) =>
    (["projection", "denoising"].includes(scheme) ? NaN : factorOfStep(data, scheme, lambda * data.critical)(data.largestEigenvalue));

/// c + Φᵀ M (shift), 3 numbers a mode.
export function withShift(data, shift) {
    const { vertices: n, modes: count, area, numbers, scale } = data, c = data.coefficients.slice();
    for (let j = 0; j < count; ++j) {
        let x = 0, y = 0, z = 0;
        for (let v = 0, at = j * n; v < n; ++v, ++at) {
            const weight = numbers[at] * area[v];
            x += weight * shift[3 * v], y += weight * shift[3 * v + 1], z += weight * shift[3 * v + 2];
        }
        c[3 * j] += scale[j] * x, c[3 * j + 1] += scale[j] * y, c[3 * j + 2] += scale[j] * z;
    }
    return c;
}

export const filtered = (f, c) => c.map((number, i) => f[Math.floor(i / 3)] * number);

/// Σ fⱼ cⱼ φⱼ into `x`, 3 numbers a vertex.
export function sumOfModes(data, f, c, x) {
    const { vertices: n, modes: count, numbers, scale } = data;
    x.fill(0);
    for (let j = 0; j < count; ++j) {
        if (Math.abs(f[j]) < nothing) continue;
        const weight = f[j] * scale[j];
        const a = weight * c[3 * j], b = weight * c[3 * j + 1], d = weight * c[3 * j + 2];
        for (let v = 0, at = j * n, i = 0; v < n; ++v, ++at, i += 3) {
            const number = numbers[at];
            x[i] += number * a, x[i + 1] += number * b, x[i + 2] += number * d;
        }
    }
    return x;
}

const squared = (c, j) => c[3 * j] ** 2 + c[3 * j + 1] ** 2 + c[3 * j + 2] ** 2;
/// Returns the squared norm of the filtered coefficients without the constant modes [length⁴].
const sizeOf = (data, f, c) => f.reduce((sum, factor, j) => (data.isConstant(data.mu[j]) ? sum : sum + factor ** 2 * squared(c, j)), 0);

/// Writes the filtered `start`, whose coefficients are c, into `x`: Σ fⱼ cⱼ φⱼ, or start − Σ (1 − fⱼ) cⱼ φⱼ if that has fewer terms, so that small
/// changes have little rounding. Vertices without area are in no mode and stay.
export function applied(data, f, c, start, x) {
    const rest = f.map((factor) => 1 - factor), isLess = data.hasAllModes && sizeOf(data, rest, c) < sizeOf(data, f, c);
    sumOfModes(data, isLess ? rest : f, c, x);
    for (let i = 0; i < x.length; ++i) {
        if (isLess) x[i] = start[i] - x[i];
        else if (!(data.area[Math.floor(i / 3)] > 0)) x[i] = start[i];
    }
    return x;
}

/// ½ Σ μ |c|², the Dirichlet energy; constant modes have none [length²].
export function energy(data, c) {
    let sum = 0;
    for (let j = 0; j < data.modes; ++j) if (!data.isConstant(data.mu[j])) sum += data.mu[j] * squared(c, j);
    return sum / 2;
}

/// Returns √(mean |x − clean|²) over the vertices, or weighted by area as in question 4 [length].
export function rms(data, x, byArea = false) {
    let sum = 0;
    for (let i = 0; i < x.length; ++i) sum += (byArea ? data.area[Math.floor(i / 3)] : 1) * (x[i] - data.positions[i]) ** 2;
    return Math.sqrt(sum / (byArea ? data.totalArea : data.vertices));
}

/// Σ x₀ · (x₁ × x₂) / 6 [length³].
export function volume(data, x) {
    const { corners } = data;
    let sum = 0;
    for (let i = 0; i < corners.length; i += 3) {
        const [a, b, c] = [3 * corners[i], 3 * corners[i + 1], 3 * corners[i + 2]];
        sum += x[a] * (x[b + 1] * x[c + 2] - x[b + 2] * x[c + 1]) + x[a + 1] * (x[b + 2] * x[c] - x[b] * x[c + 2])
             + x[a + 2] * (x[b] * x[c + 1] - x[b + 1] * x[c]);
    }
    return sum / 6;
}

/// The least of 1, 1.5, 2, … times a power of ten that is not below x > 0.
export function roundedUp(x) {
    const power = 10 ** Math.floor(Math.log10(x));
    return [1, 1.5, 2, 3, 4, 5, 6, 8, 10].map((digit) => Number((digit * power).toPrecision(2))).find((end) => end >= x);
}

export function indexOfLeast(values) {
    return values.reduce((best, value, i) => (value < values[best] ? i : best), 0);
}

/// Area-weighted unit normals of the clean mesh, 3 numbers a vertex.
export function normals({ positions: x, corners, vertices }) {
    const sums = new Float64Array(3 * vertices), side = (from, to) => [0, 1, 2].map((k) => x[3 * to + k] - x[3 * from + k]);
    for (let i = 0; i < corners.length; i += 3) {
        const [u, v] = [side(corners[i], corners[i + 1]), side(corners[i], corners[i + 2])];
        const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        for (let c = i; c < i + 3; ++c) for (let k = 0; k < 3; ++k) sums[3 * corners[c] + k] += n[k];
    }
    for (let i = 0; i < sums.length; i += 3) {
        const length = Math.hypot(sums[i], sums[i + 1], sums[i + 2]) || 1;
        for (let k = i; k < i + 3; ++k) sums[k] /= length;
    }
    return sums;
}

/// Returns the readings of the program at exactly this state; undefined if there are none.
export const readingAt = (data, state) => data.readings.find((reading) => sameState(state, { ...state, seed: NaN, k: NaN, lambda: NaN, edges: NaN, t: NaN, ...reading.state }));
