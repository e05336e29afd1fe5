// The controls of the laboratory and the table of what is measured. What is set is told to `changed(state)`.
import { lambdaAt, largestLambda, largestNoise, linkOf, mostSteps, placeOf, presetsOf, sameState, schemeNames, shownSteps } from "./lab_state.js";
import { button, element } from "./view.js";

let count = 0;   // of labels
const subjects = { q4: "Reconstruction", q5: "Explicit smoothing", q6: "Implicit smoothing", q7: "Denoising" };

const rows = {
    k: { words: "modes k", unit: (data) => `of ${data.modes}`, slider: (data) => ({ min: 1, max: data.modes, step: 1 }), number: { step: 1 } },
    lambda: { words: "step λ", unit: () => "λ_crit", slider: () => ({ min: 0, max: 1, step: 0.001 }), to: placeOf, from: (place) => Number(lambdaAt(place).toPrecision(3)), number: { step: "any", min: 0, max: largestLambda } },
    t: { words: "steps t", unit: () => "", slider: () => ({ min: 0, max: shownSteps, step: 1 }), number: { step: 1, min: 0, max: mostSteps } },
    sigma: { words: "noise σ", unit: () => "% of the box", slider: () => ({ min: 0, max: 2, step: 0.05 }), number: { step: "any", min: 0, max: largestNoise } },
    seed: { words: "seed", unit: () => "of the noise", number: { step: 1, min: 0 } },
};

/// A slider, a number field and a unit, named alike.
class Row {
    constructor(name, data, changed) {
        const { words, unit, slider, number, to = (x) => x, from = (x) => x } = rows[name], id = `lab-${name}-${++count}`;
        this.to = to;
        this.box = element("div", "lab-row");
        const label = Object.assign(element("label", "", words), { htmlFor: id });
        this.number = Object.assign(element("input", ""), { type: "number", id, ...number, ...(name === "k" && slider(data)) });
        this.number.name = name;
        this.number.addEventListener("change", () => changed({ [name]: this.number.value === "" ? NaN : Number(this.number.value) }));
        this.box.append(label);
        if (slider) {
            this.slider = Object.assign(element("input", ""), { type: "range", ...slider(data) });
            this.slider.name = `${name}-slider`;
            this.slider.setAttribute("aria-label", `${words}, slider`);
            this.slider.addEventListener("input", () => changed({ [name]: from(Number(this.slider.value)) }));
            this.box.append(this.slider);
        }
        this.box.append(this.number, element("span", "lab-unit", unit(data)));
        this.words = [`${words} %`, unit(data)].filter(Boolean).join(", ");
    }
    show(exact) {
        const value = Number(exact.toPrecision(10));
        if (document.activeElement !== this.number || Number(this.number.value) !== value) this.number.value = String(value);
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
        for (const [value, words] of Object.entries(schemeNames)) this.scheme.append(Object.assign(element("option", "", words), { value }));
        this.scheme.addEventListener("change", () => act.changed({ scheme: this.scheme.value }));
        const first = element("div", "lab-row");
        first.append(label, this.scheme);
        this.rows = Object.fromEntries(Object.keys(rows).map((name) => [name, new Row(name, data, act.changed)]));
        this.play = button("Play", act.play);
        const lines = element("label", "lab-lines", " drift along the surface");
        this.lines = Object.assign(element("input", ""), { type: "checkbox", name: "lines" });
        this.lines.addEventListener("change", () => act.changed({ lines: this.lines.checked }));
        lines.prepend(this.lines);
        this.controls.append(first, ...Object.values(this.rows).map((row) => row.box), this.play, lines);
        this.isTruncated = data.modes < data.vertices;
        this.makePresets(question, data, act.preset);
        this.table = element("table", "lab-numbers");
        this.told = element("output", "lab-told");
        this.told.setAttribute("aria-live", "polite");
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
        const projects = state.scheme === "projection";
        this.rows.k.box.hidden = !projects;
        for (const name of ["lambda", "t"]) this.rows[name].box.hidden = projects;
        this.rows.sigma.box.hidden = this.isTruncated;
        this.rows.seed.box.hidden = state.sigma === 0;
        this.play.hidden = projects;
        this.play.textContent = isPlaying ? "Pause" : matchMedia("(prefers-reduced-motion: reduce)").matches ? "One step" : "Play over t";
        this.lines.checked = state.lines;
        for (const [name, row] of Object.entries(this.rows)) row.show(state[name]);
    }

    /// @param measured  [[words, unit, here, the program's; NaN: none], …]
    showNumbers(measured) {
        const cell = (tag, words) => element(tag, "", words);
        const head = element("tr", "");
        head.append(cell("td", ""), ...["this page", "the program"].map((words) => Object.assign(cell("th", words), { scope: "col" })));
        const body = measured.map(([words, unit, here, program]) => {
            const row = element("tr", ""), name = Object.assign(cell("th", words), { scope: "row" });
            if (unit) name.append(" ", element("span", "unit", unit));
            row.append(name, cell("td", digits(here)), cell("td", Number.isNaN(program) ? "–" : digits(program)));
            return row;
        });
        this.table.replaceChildren(head, ...body);
    }
}

/// Six digits, so that an agreement can be seen.
export function digits(x) {
    if (typeof x === "string") return x;
    if (!Number.isFinite(x)) return "–";
    if (x !== 0 && (Math.abs(x) >= 1e6 || Math.abs(x) < 1e-4)) return x.toExponential(4).replace(/\.?0+e/, "e").replaceAll("-", "−").replace("e+", "e");
    return x.toPrecision(6).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "").replaceAll("-", "−");
}
