// The two plots of the laboratory, as SVG that takes its colours from the page: the spectrum under its filter, and the error over t.

const svg = (tag, attributes, ...children) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.append(...children);
    return made;
};
const text = (x, y, words, anchor = "start") => svg("text", { x, y, "text-anchor": anchor }, words);
const line = (x1, y1, x2, y2, name) => svg("line", { x1, y1, x2, y2, class: name });
/// A line through points; null: a gap.
const path = (points) => points.map((point, i) => (point ? `${points[i - 1] ? "L" : "M"}${point[0].toFixed(1)} ${point[1].toFixed(1)}` : "")).join("");
const dots = (points) => points.map(([x, y]) => `M${x.toFixed(1)} ${y.toFixed(1)}h0`).join("");
const lowest = 1e-6, highest = 250;   // of what is drawn
const size = (c, j) => Math.hypot(c[3 * j], c[3 * j + 1], c[3 * j + 2]);

const frame = { width: 440, height: 230, left: 44, right: 8, top: 22, bottom: 28 };
const across = (share) => frame.left + share * (frame.width - frame.left - frame.right);
const upward = (share) => frame.top + (1 - share) * (frame.height - frame.top - frame.bottom);

/// Words below the frame: at its ends, and what lies between.
const axis = (low, words, high) => [text(across(0), frame.height - 8, low), text(across(0.5), frame.height - 8, words, "middle"), text(across(1), frame.height - 8, high, "end")];

function empty(name, ...children) {
    const picture = svg("svg", { viewBox: `0 0 ${frame.width} ${frame.height}`, role: "img", class: "lab-plot" }, ...children);
    picture.setAttribute("aria-label", name);
    return picture;
}

/// |cᵢ| before and after, and |f|, over μᵢ, on one logarithmic scale: 1 is the largest of the first, and a filter that changes nothing.
export class SpectrumPlot {
    constructor(data) {
        this.data = data;
        const [before, after, curve] = ["before", "after", "filter"].map((name) => svg("path", { class: `lab-${name}` }));
        Object.assign(this, { before, after, curve });
        const grid = [-6, -4, -2, 0, 2].flatMap((p) => [line(across(0), this.y(10 ** p), across(1), this.y(10 ** p), p === 0 ? "lab-one" : "lab-grid"),
            text(frame.left - 5, this.y(10 ** p) + 4, p === 0 ? "1" : `10${[..."" + p].map((c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("")}`, "end")]);
        const mark = (name, sign) => svg("tspan", { class: `lab-${name}-word` }, sign);
        const legend = svg("text", { x: frame.left, y: 14 }, mark("before", "● "), "|cᵢ| before   ", mark("after", "● "), "after   ", mark("filter", "— "), "filter |f(μ)|");
        this.picture = empty("Spectrum: size of the coefficient of each mode over its eigenvalue, before and after the filter, and the filter's curve",
            ...grid, before, after, curve, legend,
            ...axis("0", "μ on a √ scale: coarse to fine", data.hasAllModes ? "μ_max" : "last mode"));
    }
    /// As √μ, the frequency: by Weyl's law the modes then lie less crowded where they are coarse.
    x(mu) { return across(Math.sqrt(Math.max(0, mu) / this.data.mu.at(-1))); }
    y(value) { return upward(Math.log10(Math.max(lowest, Math.min(highest, value)) / lowest) / Math.log10(highest / lowest)); }

    /// @param c  coefficients before the filter
    show(f, c) {
        const { mu } = this.data, first = mu.findIndex((value) => !this.data.isConstant(value));
        const sizes = Array.from(mu, (_, j) => size(c, j)), unit = Math.max(...sizes.slice(first)) || 1;
        const seen = sizes.map((value, j) => [j, value / unit]).slice(first);
        const place = ([j, value]) => (value >= lowest ? [this.x(mu[j]), this.y(value)] : null);
        this.before.setAttribute("d", dots(seen.map(place).filter(Boolean)));
        this.after.setAttribute("d", dots(seen.map(([j, value]) => place([j, Math.abs(f[j]) * value])).filter(Boolean)));
        this.curve.setAttribute("d", path(Array.from(mu, (value, j) => [this.x(value), this.y(Math.abs(f[j]))])));
    }
}

/// rms to the clean mesh over t, its least marked, and the t that is set.
export class ErrorPlot {
    constructor() {
        this.curve = svg("path", { class: "lab-filter" });
        this.least = svg("circle", { r: 5, class: "lab-least" });
        this.now = line(0, upward(0), 0, upward(1), "lab-now");
        this.high = text(frame.left - 5, upward(1) + 4, "", "end");
        this.word = text(frame.left, 14, "");
        const ends = axis("0", "steps t", "");
        this.last = ends[2];
        this.picture = empty("Distance to the clean mesh over the steps t, with its least value", line(across(0), upward(0), across(1), upward(0), "lab-grid"),
            text(frame.left - 5, upward(0) + 4, "0", "end"), ...ends, this.curve, this.now, this.least, this.high, this.word);
    }
    /// @param curve  of t = 0, 1, … [% of the box]
    show(curve, best, t) {
        const top = Math.min(Math.max(...curve), 3 * curve[0]) || 1, most = curve.length - 1;
        const at = (i) => [across(i / most), upward(curve[i] / top)];
        this.curve.setAttribute("d", path(curve.map((error, i) => (error <= top ? at(i) : null))));
        this.least.setAttribute("cx", at(best)[0]);
        this.least.setAttribute("cy", at(best)[1]);
        for (const end of ["x1", "x2"]) this.now.setAttribute(end, across(Math.min(1, t / most)));
        this.high.textContent = top.toPrecision(2);
        this.last.textContent = most;
        this.word.textContent = `rms [% of the box], least at t = ${best}`;
    }
}
