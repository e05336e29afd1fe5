// Applies a state of the laboratory to its mesh: positions, coefficients, numbers, and the error over t. Independent of the page.
import { Colours } from "./lab_colours.js";
import { CleanSurface, DenoisingRun } from "./lab_denoising.js";
import * as lab from "./lab_math.js";
import { normalNumbers } from "./lab_noise.js";
import { shownSteps } from "./lab_state.js";

const fewestSeen = 20;   // steps of the error, so that a best one soon after the start has a curve around it

export class Experiment {
    constructor(data) {
        this.data = data;
        this.x = new Float64Array(3 * data.vertices), this.scratch = new Float64Array(3 * data.vertices);
        this.first = { energy: lab.energy(data, data.coefficients), volume: lab.volume(data, data.positions) };
        this.colours = new Colours(this);
    }

    // Made when first asked for: they take a while.
    get clean() { return this.surface ??= new CleanSurface(this.data); }
    get run() { return this.denoising ??= new DenoisingRun(this.data); }

    /// @return whether the mesh before the filter is another
    set(state) {
        const { data } = this, noise = state.sigma > 0 ? `${state.sigma} ${state.seed}` : "none", isNew = noise !== this.noise;
        Object.assign(this, { state, noise, hasNoStep: state.scheme === "taubin" && Number.isNaN(lab.taubinBack(data, state.lambda * data.critical)) });
        if (isNew) this.makeNoise(state);
        const path = [state.scheme, state.lambda, state.edges, noise].join();
        if (path !== this.path) this.curve = [];
        this.path = path;
        return isNew;
    }

    makeNoise({ sigma, seed }) {
        const { data } = this;
        if (sigma > 0 && this.drawnSeed !== seed) this.drawn = normalNumbers(seed, 3 * data.vertices), this.drawnSeed = seed;
        const shift = sigma > 0 ? this.drawn.map((z) => z * sigma / 100 * data.diagonal) : null;
        this.start = shift ? data.positions.map((x, i) => x + shift[i]) : data.positions;
        this.coefficients = shift ? lab.withShift(data, shift) : data.coefficients;
        this.startEnergy = lab.energy(data, this.coefficients);
        this.noisy = shift ? this.errors(this.start) : null;
    }

    /// Into `x`. @return the filter of the modes; none where each step is solved for
    positionsAt(t, x) {
        const { data, state } = this;
        if (state.scheme !== "denoising") {
            const f = lab.filter(data, { ...state, t });
            lab.applied(data, f, this.coefficients, this.start, x);
            return f;
        }
        this.run.from(this.start, state.edges);
        x.set(this.run.at(t));
        return null;
    }

    compute() {
        this.filter = this.positionsAt(this.state.t, this.x);
        this.isMeasurable = this.filter === null || lab.isMeasurable(this.filter);
        this.made = null;
    }

    /// Its coefficients.
    get after() {
        const { data, filter, x } = this;
        return this.made ??= filter ? lab.filtered(filter, this.coefficients) : lab.withShift(data, x.map((value, i) => value - data.positions[i]));
    }

    /// Against the clean mesh, as question 7 has them [length, length, rad].
    errors(x) {
        return { surface: this.clean.distance(x), places: lab.rms(this.data, x), normals: this.clean.angle(x) };
    }

    /// Returns the displacement of each vertex [% of the box].
    apart(x) {
        const { positions: p, diagonal, vertices } = this.data, apart = new Float64Array(vertices);
        for (let v = 0, i = 0; v < vertices; ++v, i += 3) apart[v] = 100 * Math.hypot(x[i] - p[i], x[i + 1] - p[i + 1], x[i + 2] - p[i + 2]) / diagonal;
        return apart;
    }

    /// Returns the numbers of the result of compute().
    numbers() {
        const { data, state, x, noisy } = this, factor = lab.finestFactor(data, state);
        if (!this.isMeasurable) return { energy: NaN, volume: NaN, rms: NaN, gains: [NaN, NaN, NaN], along: NaN, factor };
        const numbers = { energy: lab.energy(data, this.after), volume: lab.volume(data, x), rms: lab.rms(data, x, state.scheme === "projection"), factor };
        if (!noisy) return numbers;
        const now = this.errors(x), has = { surface: noisy.surface > 1e-9 * noisy.places, places: true, normals: noisy.normals > 1e-6 };
        return { ...numbers, gains: Object.keys(has).map((measure) => (has[measure] ? noisy[measure] / now[measure] : NaN)), along: 1 - (now.surface / now.places) ** 2 };
    }

    /// Distance to the clean surface at t = 0, 1, … in percent of the box, until its least lies well behind, or the time is over.
    /// @return the t of the least; null: not known yet
    extendCurve(milliseconds) {
        const { curve, data, state, scratch } = this, end = performance.now() + milliseconds;
        for (let best = lab.indexOfLeast(curve); curve.length <= Math.min(shownSteps, Math.max(fewestSeen, 4 * best, state.t));) {
            if (performance.now() > end) return null;
            this.positionsAt(curve.length, scratch);
            curve.push(100 * this.clean.distance(scratch) / data.diagonal);
            if (curve.at(-1) < curve[best]) best = curve.length - 1;
        }
        return lab.indexOfLeast(curve);
    }
}
