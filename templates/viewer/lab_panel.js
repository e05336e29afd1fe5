// The controls of the laboratory, and its numbers: a few large ones, and all in a folded table. Changes are reported to `changed(state)`.
import { indexOfLeast } from "./lab_math.js";
import { amountsOf, colourNames, edgesAt, lambdaAt, largestEdges, largestLambda, largestNoise, linkOf, mostSteps, placeOf, placeOfEdges, presetsOf, sameState, schemeNames, shownSteps,
    stopsOf } from "./lab_state.js";
import { agreement, digits } from "./lab_words.js";
import { button, element } from "./view.js";

let count = 0;   // of labels
const subjects = { q4: "Reconstruction", q5: "Explicit smoothing", q6: "Implicit smoothing", q7: "Denoising" };

/// A slider with one place for each stop.
const along = (stops) => ({ slider: { min: 0, max: stops.length - 1, step: 1 }, from: (place) => stops[place], to: (value) => indexOfLeast(stops.map((stop) => Math.abs(stop - value))) });
const played = 90;   // stops on the way along a slider that has thousands
const stillness = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

const rowsOf = ({ modes }) => ({
    k: { words: "modes k", unit: `of ${modes}`, ...along(stopsOf(1, modes)), number: { step: 1, min: 1, max: modes } },
    lambda: { words: "step λ", unit: "λ_crit", slider: { min: 0, max: 1, step: 0.001 }, to: placeOf, from: (place) => Number(lambdaAt(place).toPrecision(3)), number: { step: "any", min: 0, max: largestLambda } },
    edges: { words: "step λ", unit: "h̄²", slider: { min: 0, max: 1, step: 0.001 }, to: placeOfEdges, from: (place) => Number(edgesAt(place).toPrecision(3)), number: { step: "any", min: 0, max: largestEdges } },
    t: { words: "steps t", unit: "", ...along(stopsOf(0, shownSteps)), number: { step: 1, min: 0, max: mostSteps } },
    sigma: { words: "noise σ", unit: "% of box", slider: { min: 0, max: 2, step: 0.05 }, number: { step: "any", min: 0, max: largestNoise } },
    seed: { words: "seed", unit: "of the noise", number: { step: 1, min: 0 } },
});

/// A slider with a button that plays it, a number field and a unit, named alike.
class Row {
    constructor(name, { words, unit, slider, number, to = (x) => x, from = (x) => x }, { changed, play }) {
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
            this.short = words.split(" ").at(-1);
            this.play = button("", () => play(name));
            this.play.classList.add("lab-play");
            const { min, max, step } = slider, count = Math.min(played, Math.round((max - min) / step));
            this.stops = max - min > played ? Array.from({ length: max - min + 1 }, (_, i) => from(min + i)) : Array.from({ length: count + 1 }, (_, i) => from(Number((min + (max - min) * i / count).toFixed(3))));
            this.box.append(this.play, this.slider);
        }
        this.box.append(this.number, units);
        this.words = [`${words} %`, unit].filter(Boolean).join(", ").replace("_", " ");
    }
    show(exact, isPlaying) {
        const value = Number(exact.toPrecision(10));
        if (document.activeElement !== this.number || this.number.value === "" || Number(this.number.value) !== value) this.number.value = String(value);
        if (!this.slider) return;
        this.play.setAttribute("aria-label", `${isPlaying ? "Pause" : stillness() ? "One step of" : "Play"} ${this.short}`);
        this.play.classList.toggle("playing", isPlaying);
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
        this.rows = Object.fromEntries(Object.entries(rowsOf(data)).map(([name, row]) => [name, new Row(name, row, act)]));
        this.controls.append(first, ...Object.values(this.rows).map((row) => row.box));
        this.makeLooks(act.changed);
        this.hasNoise = data.hasAllModes;
        this.makePresets(question, data, act.preset);
        this.table = element("table", "lab-numbers");
        this.tiles = element("dl", "lab-tiles");
        this.check = element("details", "lab-check");
        this.agrees = element("summary", "");
        this.check.append(this.agrees, this.table, element("p", "lab-note", "“The program” is what meshfolio itself computes, stored for the settings of the report and those to try; – elsewhere."));
        this.told = element("output", "lab-told");
        this.tellsAloud(true);
    }

    /// Switches announcements to screen readers, which are off while it plays.
    tellsAloud(does) {
        this.told.setAttribute("aria-live", does ? "polite" : "off");
    }

    /// The controls of the drawing.
    makeLooks(changed) {
        this.looks = element("div", "lab-looks");
        const colours = element("label", "lab-lines", "colours "), box = (name, words) => {
            const label = element("label", "lab-lines", ` ${words}`), input = Object.assign(element("input", ""), { type: "checkbox", name });
            input.addEventListener("change", () => changed({ [name]: input.checked }));
            label.prepend(input);
            this.looks.append(label);
            return input;
        };
        this.colours = Object.assign(element("select", ""), { name: "colours" });
        for (const [value, words] of Object.entries(colourNames)) this.colours.append(Object.assign(element("option", "", words), { value }));
        this.colours.addEventListener("change", () => changed({ colours: this.colours.value }));
        colours.append(this.colours);
        this.looks.append(colours);
        [this.wire, this.lines] = [box("wire", "edges"), box("lines", "drift along the surface")];
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

    /// @param playing  the name of the slider that runs by itself, if one does
    show(state, playing) {
        for (const { link, state: offered } of this.links) {
            if (sameState(state, offered)) link.setAttribute("aria-current", "true");
            else link.removeAttribute("aria-current");
        }
        this.scheme.value = state.scheme;
        const amounts = amountsOf(state.scheme);
        for (const name of ["k", "lambda", "edges", "t"]) this.rows[name].box.hidden = !amounts.includes(name);
        this.rows.sigma.box.hidden = !this.hasNoise;
        this.rows.seed.box.hidden = state.sigma === 0;
        for (const name of ["lines", "wire"]) this[name].checked = state[name];
        this.lines.parentElement.hidden = !state.lines && state.sigma === 0;
        this.colours.value = state.colours;
        for (const [name, row] of Object.entries(this.rows)) row.show(state[name], name === playing);
    }

    firstSlider() {
        return Object.values(this.rows).find(({ box }) => !box.hidden).slider;
    }

    /// @param measured  [[words, unit, value here, value of the program or NaN, rounding], …] @param tiles  [[number, words], …]
    showNumbers(measured, tiles) {
        const cell = (tag, words) => element(tag, "", words);
        const head = element("tr", "");
        head.append(cell("td", ""), ...["this page", "the program"].map((words) => Object.assign(cell("th", words), { scope: "col" })));
        const body = measured.map(([words, unit, here, program, rounding]) => {
            const row = element("tr", ""), name = Object.assign(cell("th", words), { scope: "row" });
            if (unit) name.append(" ", element("span", "unit", unit));
            row.append(name, cell("td", digits(here, rounding)), cell("td", digits(program, rounding)));
            return row;
        });
        this.table.replaceChildren(head, ...body);
        this.agrees.textContent = agreement(measured);
        this.tiles.replaceChildren(...tiles.map(([number, words]) => {
            const tile = element("div", "");
            tile.append(element("dt", "", words), element("dd", "", number));
            return tile;
        }));
    }
}
