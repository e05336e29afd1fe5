// The controls of the laboratory and the table of what is measured. What is set is told to `changed(state)`.
import { indexOfLeast } from "./lab_math.js";
import { amountsOf, edgesAt, lambdaAt, largestEdges, largestLambda, largestNoise, linkOf, mostSteps, placeOf, placeOfEdges, presetsOf, sameState, schemeNames, shownSteps,
    stopsOf } from "./lab_state.js";
import { digits } from "./lab_words.js";
import { button, element } from "./view.js";

let count = 0;   // of labels
const subjects = { q4: "Reconstruction", q5: "Explicit smoothing", q6: "Implicit smoothing", q7: "Denoising" };

/// A slider whose places are the stops, so that few steps have as much room as many.
const along = (stops) => ({ slider: { min: 0, max: stops.length - 1, step: 1 }, from: (place) => stops[place], to: (value) => indexOfLeast(stops.map((stop) => Math.abs(stop - value))) });

const rowsOf = ({ modes }) => ({
    k: { words: "modes k", unit: `of ${modes}`, ...along(stopsOf(1, modes)), number: { step: 1, min: 1, max: modes } },
    lambda: { words: "step λ", unit: "λ_crit", slider: { min: 0, max: 1, step: 0.001 }, to: placeOf, from: (place) => Number(lambdaAt(place).toPrecision(3)), number: { step: "any", min: 0, max: largestLambda } },
    edges: { words: "step λ", unit: "h̄²", slider: { min: 0, max: 1, step: 0.001 }, to: placeOfEdges, from: (place) => Number(edgesAt(place).toPrecision(3)), number: { step: "any", min: 0, max: largestEdges } },
    t: { words: "steps t", unit: "", ...along(stopsOf(0, shownSteps)), number: { step: 1, min: 0, max: mostSteps } },
    sigma: { words: "noise σ", unit: "% of the box", slider: { min: 0, max: 2, step: 0.05 }, number: { step: "any", min: 0, max: largestNoise } },
    seed: { words: "seed", unit: "of the noise", number: { step: 1, min: 0 } },
});

/// A slider, a number field and a unit, named alike.
class Row {
    constructor(name, { words, unit, slider, number, to = (x) => x, from = (x) => x }, changed) {
        const id = `lab-${name}-${++count}`;
        this.to = to;
        this.box = element("div", "lab-row");
        const label = Object.assign(element("label", "", words), { htmlFor: id, id: `${id}-label` }), units = Object.assign(element("span", "lab-unit", unit), { id: `${id}-unit` });
        this.number = Object.assign(element("input", ""), { type: "number", id, name, ...number });
        this.number.addEventListener("change", () => changed({ [name]: this.number.value === "" ? NaN : Number(this.number.value) }));
        this.number.setAttribute("aria-labelledby", `${label.id} ${units.id}`);
        this.box.append(label);
        if (slider) {
            this.slider = Object.assign(element("input", ""), { type: "range", name: `${name}-slider`, ...slider });
            this.slider.setAttribute("aria-label", `${[words, unit].filter(Boolean).join(", ").replace("_", " ")}, slider`);
            this.slider.addEventListener("input", () => changed({ [name]: from(Number(this.slider.value)) }));
            this.box.append(this.slider);
        }
        this.box.append(this.number, units);
        this.words = [`${words} %`, unit].filter(Boolean).join(", ").replace("_", " ");
    }
    show(exact) {
        const value = Number(exact.toPrecision(10));
        if (document.activeElement !== this.number || this.number.value === "" || Number(this.number.value) !== value) this.number.value = String(value);
        if (!this.slider) return;
        if (this.to(value) !== Number(this.slider.value)) this.slider.value = String(this.to(value));
        this.slider.setAttribute("aria-valuetext", this.words.replace("%", value));
    }
}

export class Panel {
    /// @param act  changed(part of the state), preset(state), play()
    constructor(question, data, act) {
        this.controls = element("div", "lab-controls");
        const label = Object.assign(element("label", "", "filter"), { htmlFor: `lab-scheme-${++count}` });
        this.scheme = Object.assign(element("select", ""), { id: label.htmlFor, name: "scheme" });
        for (const [value, words] of Object.entries(schemeNames).filter(([value]) => data.hasAllModes || value !== "denoising")) this.scheme.append(Object.assign(element("option", "", words), { value }));
        this.scheme.addEventListener("change", () => act.changed({ scheme: this.scheme.value }));
        const first = element("div", "lab-row");
        first.append(label, this.scheme);
        this.rows = Object.fromEntries(Object.entries(rowsOf(data)).map(([name, row]) => [name, new Row(name, row, act.changed)]));
        this.play = button("Play", act.play);
        const lines = element("label", "lab-lines", " drift along the surface");
        this.lines = Object.assign(element("input", ""), { type: "checkbox", name: "lines" });
        this.lines.addEventListener("change", () => act.changed({ lines: this.lines.checked }));
        lines.prepend(this.lines);
        this.controls.append(first, ...Object.values(this.rows).map((row) => row.box), this.play, lines);
        this.hasNoise = data.hasAllModes;
        this.makePresets(question, data, act.preset);
        this.table = element("table", "lab-numbers");
        this.exactBox = element("label", "lab-lines", " six digits");
        this.exact = Object.assign(element("input", ""), { type: "checkbox", name: "exact" });
        this.exact.addEventListener("change", () => this.showNumbers(this.measured));
        this.exactBox.prepend(this.exact);
        this.told = element("output", "lab-told");
        this.tellsAloud(true);
    }

    /// While it plays, what is told changes too often to be read out.
    tellsAloud(does) {
        this.told.setAttribute("aria-live", does ? "polite" : "off");
    }

    makePresets(question, data, choose) {
        this.presets = element("nav", "lab-presets");
        this.presets.setAttribute("aria-label", "Settings to try");
        this.links = [];
        const rows = new Map();   // by question
        for (const { question: of, words, state } of presetsOf(data, question)) {
            if (!rows.has(of)) rows.set(of, element("p", "", question === "lab" ? `${subjects[of]}: ` : "Try: "));
            const link = Object.assign(element("a", "", words), { href: linkOf(question, state) });
            link.addEventListener("click", (event) => {
                if (event.ctrlKey || event.metaKey || event.shiftKey) return;   // into another window
                event.preventDefault();
                choose(state);
            });
            rows.get(of).append(link, " ");
            this.links.push({ link, state });
        }
        this.presets.append(...rows.values());
    }

    show(state, isPlaying) {
        for (const { link, state: offered } of this.links) {
            if (sameState(state, offered)) link.setAttribute("aria-current", "true");
            else link.removeAttribute("aria-current");
        }
        this.scheme.value = state.scheme;
        const projects = state.scheme === "projection", amounts = amountsOf(state.scheme);
        for (const name of ["k", "lambda", "edges", "t"]) this.rows[name].box.hidden = !amounts.includes(name);
        this.rows.sigma.box.hidden = !this.hasNoise;
        this.rows.seed.box.hidden = state.sigma === 0;
        this.play.hidden = projects;
        this.play.textContent = isPlaying ? "Pause" : matchMedia("(prefers-reduced-motion: reduce)").matches ? "One step" : "Play over t";
        this.lines.checked = state.lines;
        for (const [name, row] of Object.entries(this.rows)) row.show(state[name]);
    }

    firstSlider() {
        return Object.values(this.rows).find(({ box }) => !box.hidden).slider;
    }

    /// @param measured  [[words, unit, here, the program's; NaN: none, what is rounding], …]
    showNumbers(measured) {
        this.measured = measured;
        const cell = (tag, words) => element(tag, "", words), count = this.exact.checked ? 6 : 3;
        const head = element("tr", "");
        head.append(cell("td", ""), ...["this page", "the program"].map((words) => Object.assign(cell("th", words), { scope: "col" })));
        const body = measured.map(([words, unit, here, program, rounding]) => {
            const row = element("tr", ""), name = Object.assign(cell("th", words), { scope: "row" });
            if (unit) name.append(" ", element("span", "unit", unit));
            row.append(name, cell("td", digits(here, rounding, count)), cell("td", digits(program, rounding, count)));
            return row;
        });
        this.table.replaceChildren(head, ...body);
    }
}
