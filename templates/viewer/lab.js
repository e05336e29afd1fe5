// The live laboratory: one mesh with its modes, a filter on them, and at once the surface, the spectrum and the numbers.
import { Experiment } from "./lab_experiment.js";
import * as lab from "./lab_math.js";
import { Panel } from "./lab_panel.js";
import { openingOf, Play, stopsAfter } from "./lab_play.js";
import { ErrorPlot, SpectrumPlot } from "./lab_plot.js";
import { Scene } from "./lab_scene.js";
import { amountsOf, held, linkOf, readLink, shownSteps, startOf } from "./lab_state.js";
import { limits, notesOf, passed, tilesOf, told, watchOf } from "./lab_words.js";
import { button, element, number, typeset, View } from "./view.js";

const slowFrame = 40, seldom = 250, forCurve = 15;   // milliseconds
const isStill = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

/// A colour bar with numbers along it.
function barOf({ quantity, unit, numbers, colors }) {
    const bar = element("div", "lab-bar"), ramp = element("i", "ramp"), marks = element("span", "lab-marks");
    ramp.style.background = `linear-gradient(to right, ${colors.join(", ")})`;
    marks.append(...numbers.map((each) => element("span", "", number(each))));
    bar.append(element("span", "", quantity + (unit ? ` [${unit}]` : "")), ramp, marks);
    return bar;
}

class Lab {
    constructor(block, { data, experiment, scene }, question, onStop) {
        Object.assign(this, { data, experiment, scene, question, onStop, why: "", hasPage: question === "lab" });
        this.panel = new Panel(question, data, {
            changed: (part) => this.change({ ...this.state, ...part }, this.play.name in part || "scheme" in part),
            preset: (state) => this.change({ ...state, wire: this.state.wire }, true),
            play: (name) => this.playOrPause(name),
        });
        this.play = new Play((name, value) => this.set({ ...this.state, [name]: value }), () => this.pause());
        this.spectrum = new SpectrumPlot(data);
        this.errors = new ErrorPlot();
        this.build(block);
        this.openView();
        this.state = held(startOf(data, question), data.modes);
        const linked = () => { const link = readLink(location.hash); return link?.question === question ? { ...startOf(data, question), ...link.change } : null; };
        this.follow = () => { if (linked() && location.hash !== this.link) this.change(linked(), true); };
        addEventListener("hashchange", this.follow);
        this.onPrint = () => { if (this.isDrawn) this.view.draw(), this.frame.src = this.view.canvas.toDataURL(); };
        addEventListener("beforeprint", this.onPrint);
        const asked = linked();
        this.set(asked ?? this.state);
        if (!this.hasPage) this.panel.firstSlider().focus({ preventScroll: true }), this.root.scrollIntoView({ block: "nearest" });
        if (this.hasPage && !asked && this.state.scheme === "projection" && this.state.k < data.modes && !isStill()) this.run("k", openingOf(data.modes, this.state.k));
    }

    build(block) {
        const { data, panel, scene } = this;
        this.root = element("div", "model-panel lab-panel");
        this.root.setAttribute("role", "group");
        this.root.setAttribute("aria-label", "Laboratory");
        this.root.addEventListener("keydown", (event) => { if (event.key === "Escape") this.stop(true); });
        const keys = `Arrow keys turn, plus and minus zoom, 0 resets${this.hasPage ? "" : ", Escape closes"}.`;
        this.view = new View(scene.models, `Mesh before and after the filter. ${keys}`, { closed: (byReader) => (byReader ? this.stop(true) : this.loseView()) }, true);
        this.frame = Object.assign(element("img", "lab-frame"), { alt: "The mesh before and after the filter" });
        const part = (className, ...children) => { const made = element("div", className); made.append(...children); return made; };
        const notes = notesOf(data, this.question), note = (of) => element("p", `lab-note lab-${of}`, notes[of]);
        const details = element("details", "lab-note");
        details.append(element("summary", "", "How this is computed"), ...notes.details.map((words) => element("p", "", words)));
        this.watch = element("p", "lab-watch");
        this.legend = element("div", "lab-legend");
        this.reset = button("Reset view", () => this.view.reset());
        this.errorNote = note("errors");
        panel.looks.append(this.reset);
        const seen = part("lab-see", this.view.stage, this.frame, this.legend);
        const plots = part("lab-plots", part("", this.spectrum.picture, note("modes")), part("", this.errors.picture, this.errorNote));
        const tools = [panel.controls, panel.looks, panel.tiles, panel.told];
        const done = part("lab-do", ...(this.hasPage ? [...tools, panel.presets] : [panel.presets, ...tools]), panel.check, note("mesh"), details);   // of all questions there
        this.root.append(part("lab-head", this.watch, ...(this.hasPage ? [] : [button("Close", () => this.stop(true))])), part("lab-columns", seen, done, plots));
        this.block = block;
        block.append(this.root);
    }

    openView() {
        try {
            this.view.open();
            this.isDrawn = true;
        } catch {
            this.loseView();
        }
    }
    /// A link to the question's first pictures of this mesh stands in its place.
    loseView() {
        this.isDrawn = false;
        const note = element("p", "model-note lab-no-view", "This browser cannot show it in three dimensions; the numbers and curves below still follow.");
        const figures = [...this.block.closest("section")?.querySelectorAll("figure[id]") ?? []];
        const figure = figures.find((one) => [...one.querySelectorAll("img")].some(({ alt }) => alt.includes(this.data.name)));
        if (figure) note.append(" The report shows such results in ", Object.assign(element("a", "", figure.querySelector("b").textContent), { href: `#${figure.id}` }));
        this.view.stage.replaceWith(note);
        this.reset.remove();
    }

    // ---- settings -----------------------------------------------------------------------------------------------------

    /// Applies a change by the reader. @param endsPlay  stops a slider that runs by itself
    change(state, endsPlay) {
        this.why = "";
        if (endsPlay && this.play.name) this.pause();
        this.set(state);
    }

    set(state) {
        const { data, experiment } = this;
        this.state = held(state, data.modes, this.state);
        if (!data.hasAllModes) Object.assign(this.state, { sigma: 0, scheme: this.state.scheme === "denoising" ? "implicit" : this.state.scheme });   // noise lies in the modes that are cut off
        const { colours, scheme, sigma } = this.state, looks = `${colours} ${sigma > 0}`;
        if (experiment.set(this.state) || looks !== this.looks) this.scene.move(this.scene.models[0], experiment.start, experiment.colours.of(experiment.start, colours));
        this.looks = looks;
        const words = watchOf(this.state);
        if (this.said !== words) this.said = words, this.watch.replaceChildren(...typeset(words));
        if (this.play.name && !amountsOf(scheme).concat("sigma").includes(this.play.name)) this.pause();
        this.update();
    }

    /// Draws the error over t, if the mesh has noise to remove.
    showErrors(milliseconds) {
        const { state, experiment } = this, shown = state.sigma > 0 && state.scheme !== "projection" && !experiment.hasNoStep;
        this.errorNote.parentElement.toggleAttribute("hidden", !shown);
        this.best = shown ? experiment.extendCurve(milliseconds) : null;
        if (shown) this.errors.show(experiment.curve, this.best, state.t);
    }

    // ---- drawing ------------------------------------------------------------------------------------------------------

    /// Draws at most once per frame.
    update() {
        this.panel.show(this.state, this.play.name);
        this.root.setAttribute("aria-busy", "true");   // until it is told
        this.asked ??= requestAnimationFrame((now) => {
            this.asked = null;
            if (this.isStopped) return;
            this.keepPace(now);
            this.compute(now);
        });
        clearTimeout(this.later);
        if (!this.play.name) this.later = setTimeout(() => this.settle(), 400);
    }

    compute(now, milliseconds = forCurve) {
        const { experiment } = this, { hasNoStep } = experiment;
        const { models } = this.scene, { colours } = this.state;
        models[1].mesh.visible = !hasNoStep;
        if (!hasNoStep) {
            experiment.compute();
            this.clamped = this.scene.move(models[1], experiment.x, experiment.colours.of(experiment.x, colours));
        }
        this.scene.show({ edges: this.state.wire, lines: this.state.lines && !hasNoStep });
        this.showLegend(experiment.colours.barOf(colours));
        if (this.isDrawn) this.view.draw();
        const says = this.play.name && !(now - this.saidAt < seldom);
        if (says || !this.isSlow || now - this.toldAt > seldom) this.showCurve(now, milliseconds);
        if (says) this.saidAt = now;
        if (says && !this.isGone()) this.tell();
        const { name } = this.play, signs = { t: "t", lambda: "λ" };
        if (name && this.isGone()) this.pause(` Blown up: no vertex is left in the view, and the play has stopped at ${signs[name] ?? name} = ${this.state[name]}.`);
    }

    showLegend(bar) {
        const shown = bar === null ? "" : `${bar.quantity} ${bar.unit} ${bar.numbers}`;
        if (shown === this.legendShown) return;
        this.legendShown = shown;
        this.legend.replaceChildren(...(bar === null ? [] : [barOf(bar)]));
    }

    /// Announces the settings and numbers, after the events since the last rest.
    tell() {
        const now = limits(this), event = passed(this.limits ?? {}, now);
        if (!this.play.name) this.limits = now;
        this.panel.told.replaceChildren(...(event ? [element("strong", "", event), " "] : []), ...typeset(told(this) + this.why));
    }

    /// Draws fewer pixels while frames are slow, as without a graphics card; curve and numbers are then updated only now and then.
    keepPace(now) {
        const took = now - this.shownAt;
        this.shownAt = now;
        this.slowFrames = took > slowFrame && (this.play.name || took < 10 * slowFrame) ? (this.slowFrames ?? 0) + 1 : 0;
        this.isSlow ||= this.slowFrames > 2;
        if (this.isDrawn && this.isSlow) this.view.resolve(0.5);
    }

    showCurve(now, milliseconds) {
        const { data, state, experiment } = this;
        this.toldAt = now;
        this.showErrors(milliseconds);
        if (experiment.hasNoStep) {
            this.spectrum.show(experiment.coefficients, null, null);
            return this.panel.showNumbers([["Taubin has no second step for this λ", "", "take λ below 10 λ_crit", NaN]], []);
        }
        this.spectrum.show(experiment.coefficients, experiment.after, lab.filterCurve(data, state));
        this.showNumbers();
    }

    showNumbers() {
        const { data, state, experiment: { first } } = this, here = this.numbers = this.experiment.numbers();
        const none = { energy: NaN, volume: NaN, rms: NaN, factor: NaN, gains: [NaN, NaN, NaN] }, program = lab.readingAt(data, state) ?? none;
        const percent = 100 / data.diagonal, { rounding } = data;
        const numbers = [["Dirichlet energy", "length²", here.energy, program.energy, rounding * first.energy]];
        if (data.isClosed) numbers.push(["volume", "length³", here.volume, program.volume, rounding * Math.abs(first.volume)], ["volume kept", "%", 100 * here.volume / first.volume, 100 * program.volume / first.volume, 100 * rounding]);
        const byArea = state.scheme === "projection" ? ", by area" : "";
        numbers.push([`rms to the ${state.sigma > 0 ? "clean mesh" : "original"}${byArea}`, "% of the box", percent * here.rms, percent * program.rms, 100 * rounding]);
        if (state.sigma > 0) {
            ["surface", "places", "normals"].forEach((measure, i) => numbers.push([`gain: ${measure}`, "×", here.gains[i], program.gains[i] ?? NaN]));
            numbers.push(["rms² along the surface", "%", 100 * here.along, NaN]);
        }
        if (!Number.isNaN(here.factor)) numbers.push(["shortest wave, each step", "×", here.factor, program.factor, 1e-12]);
        this.panel.showNumbers(numbers, tilesOf(this, here));
    }

    /// Announces the settings once they no longer change, and puts them into the address.
    settle() {
        if (this.isStopped) return;
        this.isSlow = false;
        if (this.asked) cancelAnimationFrame(this.asked);   // a tab in the background gets no frames
        this.asked = null;
        this.compute(performance.now(), Infinity);
        if (this.isDrawn && this.clamped === 0) this.view.resolve(1);   // what has blown up covers itself many times over: it stays coarse
        this.root.removeAttribute("aria-busy");   // before: what is busy is not read out
        this.tell();
        this.link = linkOf(this.question, this.state);
        history.replaceState(null, "", this.link);
    }

    // ---- play ---------------------------------------------------------------------------------------------------------

    playOrPause(name) {
        const isOn = this.play.name === name;
        if (this.play.name) this.pause();
        if (isOn) return;
        const { stops } = this.panel.rows[name], rest = this.isGone() ? stops : stopsAfter(stops, this.state[name]);
        if (isStill()) return this.change({ ...this.state, [name]: rest[0] });
        this.run(name, rest);
    }
    run(name, stops) {
        this.why = "";
        this.panel.tellsAloud(false);
        this.play.start(name, stops);
        this.set({ ...this.state, [name]: stops[0] });
    }
    /// @param why  announced together with the settings
    pause(why = "") {
        this.play.stop();
        this.why = why;
        this.panel.tellsAloud(true);
        this.update();
    }
    /// True if every vertex has left the view.
    isGone() { return this.clamped === this.data.vertices && !this.experiment.hasNoStep; }

    /// @param byReader  closed on purpose, not for another
    stop(byReader) {
        if (this.isStopped || (byReader && this.hasPage)) return;
        this.isStopped = true;
        this.play.stop();
        clearTimeout(this.later);
        removeEventListener("hashchange", this.follow);
        removeEventListener("beforeprint", this.onPrint);
        this.scene.dispose();
        this.view.close();
        this.root.remove();
        if (byReader && readLink(location.hash)) history.replaceState(null, "", location.pathname + location.search);
        this.onStop(byReader);
    }
}

/// Yields the data of a laboratory from the bytes of its mesh, in pieces that keep the page responsive.
export async function prepareLab(bytes) {
    const rest = () => new Promise((done) => setTimeout(done));
    await rest();
    const data = lab.decoded(bytes);
    await rest();
    const experiment = new Experiment(data);
    await rest();
    const scene = new Scene(data);
    await rest();
    return { data, experiment, scene };
}

export function openLab(block, prepared, question, onStop) {
    return new Lab(block, prepared, question, onStop);
}
