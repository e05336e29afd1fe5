// The colours of the laboratory, as in the figures of its question. Independent of the page.
import { meanCurvature } from "./lab_denoising.js";
import { roundedUp } from "./lab_math.js";

const palest = 0.1, decades = 3;   // of distances to the original [% of the box], as in question 4's figures
const cut = 0.02;                  // of the values lie beyond either end of the other ranges, as in the report's

const quantile = (values, share) => Float64Array.from(values).sort()[Math.round(share * (values.length - 1))];

export class Colours {
    constructor(experiment) {
        this.experiment = experiment;
    }

    /// @param kind  distance, curvature or none
    /// @return {places, map} of positions, the places from 0 to 1; null: clay
    of(x, kind) {
        const { data, noisy, start } = this.experiment;
        if (kind === "none" || (kind === "distance" && !noisy && x === start)) return null;   // the original is at its own place
        const values = this.valuesOf(x, kind), { low, high, logarithmic, map } = this.rangeOf(kind);
        const place = logarithmic ? (value) => Math.log10(value / low) / decades : (value) => (value - low) / (high - low);
        return { places: Float32Array.from(values, (value) => Math.min(1, Math.max(0, place(value) || 0))), map, size: data.vertices };
    }

    valuesOf(x, kind) {
        const { data, noisy, state, clean } = this.experiment;
        if (kind === "curvature") return meanCurvature(data, x).map((h) => h * data.meanEdge);
        if (noisy) return clean.distances(x).map((distance) => 100 * distance / data.diagonal / state.sigma);
        return this.experiment.apart(x);
    }

    /// Returns the range of the colours, which all results of one mesh share so that colours can be compared.
    rangeOf(kind) {
        const { data, noisy, noise, start } = this.experiment, key = `${kind} ${kind === "curvature" || noise}`;
        if (this.key === key) return this.range;
        this.key = key;
        if (kind === "curvature") {
            const values = this.valuesOf(data.positions, kind), high = roundedUp(Math.max(0.01, -quantile(values, cut), quantile(values, 1 - cut)));
            return this.range = { low: -high, high, map: "diverging" };
        }
        if (!noisy) return this.range = { low: palest, high: palest * 10 ** decades, logarithmic: true, map: "pale" };
        return this.range = { low: 0, high: roundedUp(quantile(this.valuesOf(start, kind), 1 - cut)), map: "pale" };
    }

    /// Returns the colour bar: {quantity, unit, numbers: evenly along it, colors}; null if there is none.
    barOf(kind) {
        const { data, noisy } = this.experiment;
        if (kind === "none") return null;
        const { low, high, logarithmic, map } = this.rangeOf(kind), colors = data.colors[map];
        const numbers = logarithmic ? Array.from({ length: decades + 1 }, (_, i) => Number((low * 10 ** i).toPrecision(1))) : [low, (low + high) / 2, high];
        if (kind === "curvature") return { quantity: "mean curvature × mean edge", unit: "", numbers, colors };
        return noisy ? { quantity: "distance to the clean surface", unit: "σ", numbers, colors } : { quantity: "distance to the original", unit: "% of box diagonal", numbers, colors };
    }
}
