// The two plots of the laboratory, as SVG that takes its colours from the page: the spectrum under its filter, and the error over t.

const svg = (tag, attributes, ...children) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.append(...children);
    return made;
};
const text = (x, y, words, anchor = "start") => svg("text", { x, y, "text-anchor": anchor }, ...words.split(/_(\w+)/).map((part, i) => (i % 2 ? svg("tspan", { dy: 3, "font-size": "80%" }, part) : part)));
const line = (x1, y1, x2, y2, name) => svg("line", { x1, y1, x2, y2, class: name });
const path = (points) => points.map(([x, y], i) => `${i > 0 ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");
const dots = (points) => points.map(([x, y]) => `M${x.toFixed(1)} ${y.toFixed(1)}h0`).join("");
const lowest = 1e-6, highest = 250;   // of what is seen
const beyond = 1e9;   // the curve goes on so many times as far, unseen
const samples = 400;   // of the filter's curve
const size = (c, j) => Math.hypot(c[3 * j], c[3 * j + 1], c[3 * j + 2]);

const frame = { width: 440, height: 230, left: 50, right: 8, top: 22, bottom: 28 };
const across = (share) => frame.left + share * (frame.width - frame.left - frame.right);
const upward = (share) => frame.top + (1 - share) * (frame.height - frame.top - frame.bottom);

/// Clips children to the frame.
function inside(...children) {
    const [x, y, width, height] = [across(0), upward(1), across(1) - across(0), upward(0) - upward(1)];
    return svg("svg", { x, y, width, height, viewBox: `${x} ${y} ${width} ${height}` }, ...children);
}

/// Words below the frame: at its ends, and what lies between.
const axis = (low, words, high) => [text(across(0), frame.height - 8, low), text(across(0.5), frame.height - 8, words, "middle"), text(across(1), frame.height - 8, high, "end")];

function empty(name, ...children) {
    const picture = svg("svg", { viewBox: `0 0 ${frame.width} ${frame.height}`, role: "img", class: "lab-plot", preserveAspectRatio: "xMinYMid meet" }, ...children);
    picture.setAttribute("aria-label", name);
    return picture;
}

/// |cᵢ| before and after, and |f|, over μᵢ, on one logarithmic scale: 1 is the largest of the first, and a filter that changes nothing.
export class SpectrumPlot {
    constructor(data) {
        this.data = data;
        this.last = data.isConstant(data.mu.at(-1)) ? 0 : data.mu.at(-1);   // 0: every mode is constant
        const [before, after, curve] = ["before", "after", "filter"].map((name) => svg("path", { class: `lab-${name}` }));
        Object.assign(this, { before, after, curve });
        const grid = [-6, -4, -2, 0, 2].flatMap((p) => [line(across(0), this.y(10 ** p), across(1), this.y(10 ** p), p === 0 ? "lab-one" : "lab-grid"),
            text(frame.left - 5, this.y(10 ** p) + 4, p === 0 ? "1" : `10${[..."" + p].map((c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("")}`, "end")]);
        const mark = (name, sign) => svg("tspan", { class: `lab-${name}-word` }, sign);
        const legend = svg("text", { x: frame.left, y: 14 }, mark("before", "● "), "before   ", mark("after", "● "), "after   ", mark("filter", "— "), "what the filter keeps");
        this.picture = empty("Spectrum: size of the coefficient of each mode over its eigenvalue, before and after the filter, and the filter's curve",
            ...grid, before, after, inside(curve), legend,
            ...axis("0", "shape ← √μ → noise", data.hasAllModes ? "μ_max" : `μ_${data.modes}`));
    }
    /// Returns the place of a mode by √μ, its frequency; by Weyl's law coarse modes are then less crowded.
    x(mu) { return across(this.last > 0 ? Math.sqrt(Math.max(0, mu) / this.last) : 0); }
    y(value) { return upward(Math.log10(Math.max(lowest / beyond, Math.min(highest * beyond, value)) / lowest) / Math.log10(highest / lowest)); }

    /// @param before, after  coefficients; curve: |f| of μ; null: there are none
    show(before, after, curve) {
        const { mu } = this.data, modes = Array.from(mu.keys()).filter((j) => !this.data.isConstant(mu[j]));
        const unit = Math.max(...modes.map((j) => size(before, j))) || 1;
        const seen = (c) => dots(modes.map((j) => [j, size(c, j) / unit]).filter(([, value]) => value >= lowest).map(([j, value]) => [this.x(mu[j]), this.y(Math.min(highest, value))]));
        this.before.setAttribute("d", seen(before));
        this.after.setAttribute("d", after ? seen(after) : "");
        const places = Array.from({ length: samples + 1 }, (_, i) => this.last * (i / samples) ** 2);
        this.curve.setAttribute("d", curve && this.last > 0 ? path(places.map((value) => [this.x(value), this.y(curve(value))])) : "");
    }
}

/// Distance to the clean surface over t, its least marked, and the t that is set.
export class ErrorPlot {
    constructor() {
        this.curve = svg("path", { class: "lab-filter" });
        this.least = svg("circle", { r: 5, class: "lab-least" });
        this.now = line(0, upward(0), 0, upward(1), "lab-now");
        this.high = text(frame.left - 5, upward(1) + 4, "", "end");
        const ends = axis("0", "", "");
        [, this.steps, this.last] = ends;
        this.picture = empty("Distance to the clean surface over the steps t, with its least value", line(across(0), upward(0), across(1), upward(0), "lab-grid"),
            text(frame.left - 5, upward(0) + 4, "0", "end"), ...ends, inside(this.curve), this.now, this.least, this.high, text(frame.left, 14, "distance to the clean surface [% of box]"));
    }
    /// @param curve  of t = 0, 1, … [% of the box]; best: the t of its least; null: not known yet
    show(curve, best, t) {
        const cut = 3 * curve[0], largest = Math.max(...curve), top = Math.min(largest, cut) || 1, most = Math.max(1, curve.length - 1);
        const at = (i) => [across(i / most), upward(Math.min(curve[i] / top, 100))];   // far enough beyond
        this.curve.setAttribute("d", path(curve.map((error, i) => at(i))));
        this.least.toggleAttribute("hidden", best === null);
        if (best !== null) for (const [i, name] of ["cx", "cy"].entries()) this.least.setAttribute(name, at(best)[i]);
        for (const end of ["x1", "x2"]) this.now.setAttribute(end, across(Math.min(1, t / most)));
        this.high.textContent = top.toPrecision(2);
        this.last.textContent = most;
        this.steps.textContent = `steps t${best === null ? "" : `, least at ${best}`}${largest > cut ? "; cut off above" : ""}`;
    }
}
