// The live laboratory: one mesh with its modes, a filter on them, and at once the surface, the spectrum and the numbers.
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments } from "three";

import { Experiment } from "./lab_experiment.js";
import * as lab from "./lab_math.js";
import { Panel } from "./lab_panel.js";
import { ErrorPlot, SpectrumPlot } from "./lab_plot.js";
import { held, linkOf, readLink, shownSteps, startOf } from "./lab_state.js";
import { limits, longer, notesOf, passed, told } from "./lab_words.js";
import { Model } from "./model.js";
import { button, element, legendOf, typeset, View } from "./view.js";

const room = 1.25;            // what is seen around the mesh, in its radii: what flies farther is drawn at the rim
const above = 0.015;          // lines of the drift lie that far above the surface, in its radii
const stepsPerSecond = 15;
const slowFrame = 40, seldom = 250, forCurve = 15;   // milliseconds

/// The edges of the triangles, each once.
function edgesOf(corners) {
    const edges = new Set();
    for (let i = 0; i < corners.length; ++i) {
        const [a, b] = [corners[i], corners[i % 3 === 2 ? i - 2 : i + 1]];
        edges.add(a < b ? a * 2 ** 26 + b : b * 2 ** 26 + a);
    }
    return Uint32Array.from([...edges].flatMap((edge) => [Math.floor(edge / 2 ** 26), edge % 2 ** 26]));
}

class Lab {
    constructor(block, data, question, onStop) {
        Object.assign(this, { data, question, onStop, why: "" });
        this.experiment = new Experiment(data);
        this.radius = 0;
        for (let i = 0; i < data.positions.length; i += 3) this.radius = Math.max(this.radius, Math.hypot(...data.positions.subarray(i, i + 3)));
        this.normals = lab.normals(data);
        this.panel = new Panel(question, data, { changed: (part) => this.change({ ...this.state, ...part }, "t" in part || "scheme" in part), preset: (state) => this.change(state, true), play: () => this.playOrPause() });
        this.spectrum = new SpectrumPlot(data);
        this.errors = new ErrorPlot();
        this.makeModels();
        this.build(block);
        this.openView();
        this.state = held(startOf(data, question), data.modes);
        const linked = () => { const link = readLink(location.hash); return link?.question === question ? { ...startOf(data, question), ...link.change } : null; };
        this.follow = () => { if (linked() && location.hash !== this.link) this.change(linked(), true); };
        addEventListener("hashchange", this.follow);
        this.onPrint = () => { if (this.isDrawn) this.view.draw(), this.frame.src = this.view.canvas.toDataURL(); };
        addEventListener("beforeprint", this.onPrint);
        this.set(linked() ?? this.state);
        this.panel.firstSlider().focus({ preventScroll: true });
        this.root.scrollIntoView({ block: "nearest" });
    }

    makeModels() {
        const frame = { centre: [0, 0, 0], radius: room }, places = () => Float32Array.from(this.data.positions, (x) => x / this.radius);
        this.models = ["before", "after"].map((label) => Model.ofSurface(places(), this.data.corners, label, { colors: this.data.colors }, frame));
        const edges = new BufferAttribute(edgesOf(this.data.corners), 1);
        for (const { mesh } of this.models) {
            Object.assign(mesh.material, { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
            const wire = new BufferGeometry().setAttribute("position", mesh.geometry.attributes.position).setIndex(edges);
            mesh.add(new LineSegments(wire, new LineBasicMaterial({ color: 0x1c1d21, transparent: true, opacity: 0.35 })));
        }
        const ends = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(6 * this.data.vertices), 3));
        this.lines = new LineSegments(ends, new LineBasicMaterial({ color: 0xc2410c }));
        this.models[1].mesh.add(this.lines);
        this.models.forEach(({ mesh }) => mesh.traverse((object) => { object.frustumCulled = false; }));
    }

    build(block) {
        const { data, panel } = this;
        this.root = element("div", "model-panel lab-panel");
        this.root.setAttribute("role", "group");
        this.root.setAttribute("aria-label", "Laboratory");
        this.root.addEventListener("keydown", (event) => { if (event.key === "Escape") this.stop(true); });
        this.view = new View(this.models, "Mesh before and after the filter. Arrow keys turn, plus and minus zoom, 0 resets, Escape closes.", { closed: (byReader) => (byReader ? this.stop(true) : this.loseView()) });
        this.frame = Object.assign(element("img", "lab-frame"), { alt: "The mesh before and after the filter" });
        const bar = element("div", "model-bar"), columns = element("div", "lab-columns"), settings = element("div", ""), plots = element("div", "");
        const notes = notesOf(data, this.question), note = (part) => element("p", `lab-note lab-${part}`, notes[part]);
        const details = element("details", "lab-note");
        details.append(element("summary", "", "How this is computed"), ...notes.details.map((words) => element("p", "", words)));
        this.legend = element("div", "model-legend");
        this.reset = button("Reset view", () => this.view.reset());
        bar.append(panel.told, this.reset, button("Close", () => this.stop(true)));
        settings.append(panel.controls, note("units"), panel.table, panel.exactBox, note("program"));
        this.errorNote = note("errors");
        plots.append(this.spectrum.picture, note("modes"), this.errors.picture, this.errorNote);
        columns.append(settings, plots);
        this.root.append(panel.presets, this.view.stage, this.frame, this.legend, note("mesh"), bar, columns, details);
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

    // ---- what is set --------------------------------------------------------------------------------------------------

    /// By the reader; what sets the steps ends the play over them.
    change(state, endsPlay) {
        this.why = "";
        if (endsPlay && this.isPlaying) this.pause();
        this.set(state);
    }

    set(state) {
        const { data, experiment } = this;
        this.state = held(state, data.modes, this.state);
        if (!data.hasAllModes) Object.assign(this.state, { sigma: 0, scheme: this.state.scheme === "denoising" ? "implicit" : this.state.scheme });   // noise lies in the modes that are cut off
        if (experiment.set(this.state)) this.models[0].moveTo(this.drawable(experiment.start).places, experiment.colours(experiment.start).places);
        this.update();
    }

    /// The error over t, where there is something to come back from.
    showErrors(milliseconds) {
        const { state, experiment } = this, shown = state.sigma > 0 && state.scheme !== "projection" && !experiment.hasNoStep;
        for (const part of [this.errors.picture, this.errorNote]) part.toggleAttribute("hidden", !shown);
        this.best = shown ? experiment.extendCurve(milliseconds) : null;
        if (shown) this.errors.show(experiment.curve, this.best, state.t);
    }

    // ---- what is seen -------------------------------------------------------------------------------------------------

    /// Once a frame, however often it is set.
    update() {
        this.panel.show(this.state, this.isPlaying);
        this.root.setAttribute("aria-busy", "true");   // until it is told
        this.asked ??= requestAnimationFrame((now) => {
            this.asked = null;
            if (this.isStopped) return;
            this.keepPace(now);
            this.compute(now);
        });
        clearTimeout(this.later);
        if (!this.isPlaying) this.later = setTimeout(() => this.settle(), 400);
    }

    compute(now, milliseconds = forCurve) {
        const { experiment } = this, { hasNoStep } = experiment;
        this.models[1].mesh.visible = !hasNoStep;
        if (!hasNoStep) {
            experiment.compute();
            const { places, clamped } = this.drawable(experiment.x);
            const colours = experiment.colours(experiment.x);
            this.clamped = clamped;
            this.models[1].moveTo(places, colours.places);
            this.showLegend(colours);
            this.moveLines(places);
        }
        if (this.isDrawn) this.view.draw();
        const says = this.isPlaying && !(now - this.saidAt < seldom);
        if (says || !this.isSlow || now - this.toldAt > seldom) this.showCurve(now, milliseconds);
        if (says) this.saidAt = now;
        if (says && !this.isGone()) this.tell();
        if (this.isPlaying && this.isGone()) this.pause(` Blown up: no vertex is left in the view, and the play has stopped at t = ${this.state.t}.`);
    }

    showLegend({ top, isCut }) {
        const quantity = this.state.sigma > 0 ? "distance to the clean surface" : "moved by the filter", shown = `${quantity} ${top} ${isCut}`;
        if (shown === this.legendShown) return;
        this.legendShown = shown;
        this.legend.replaceChildren(...legendOf({ quantity, unit: "% of the box", range: [0, top], isCut, colors: this.data.colors }).childNodes);
    }

    /// Says what is set and seen, and first what has happened since it last came to rest.
    tell() {
        const now = limits(this), event = passed(this.limits ?? {}, now);
        if (!this.isPlaying) this.limits = now;
        this.panel.told.replaceChildren(...(event ? [element("strong", "", event), " "] : []), ...typeset(told(this) + this.why));
    }

    /// Where frames follow one another slowly, as without a graphics card, they have fewer pixels, and curve and numbers follow now and
    /// then, until it rests.
    keepPace(now) {
        const took = now - this.shownAt;
        this.shownAt = now;
        this.slowFrames = took > slowFrame && (this.isPlaying || took < 10 * slowFrame) ? (this.slowFrames ?? 0) + 1 : 0;
        this.isSlow ||= this.slowFrames > 2;
        if (this.isDrawn && this.isSlow) this.view.resolve(0.5);
    }

    showCurve(now, milliseconds) {
        const { data, state, experiment } = this;
        this.toldAt = now;
        this.showErrors(milliseconds);
        if (experiment.hasNoStep) {
            this.spectrum.show(experiment.coefficients, null, null);
            return this.panel.showNumbers([["Taubin has no second step for this λ", "", "take λ below 10 λ_crit", NaN]]);
        }
        this.spectrum.show(experiment.coefficients, experiment.after, lab.filterCurve(data, state));
        this.showNumbers();
    }

    /// In radii of the mesh; what is farther out than the room lies at its rim.
    drawable(x) {
        const places = new Float32Array(x.length);
        let clamped = 0;
        for (let i = 0; i < x.length; i += 3) {
            const far = Math.hypot(x[i], x[i + 1], x[i + 2]) / this.radius, shrunk = far > room || !Number.isFinite(far);
            clamped += shrunk;
            for (let k = i; k < i + 3; ++k) places[k] = shrunk ? (x[k] / this.radius) * (room / far) || 0 : x[k] / this.radius;
        }
        return { places, clamped };
    }

    /// From each vertex to where it belongs, as far as that is along the surface.
    moveLines(places) {
        this.lines.visible = this.state.lines;
        if (!this.state.lines) return;
        const { array } = this.lines.geometry.attributes.position, { positions } = this.data, n = this.normals;
        for (let i = 0; i < places.length; i += 3) {
            const d = [0, 1, 2].map((k) => positions[i + k] / this.radius - places[i + k]);
            const across = d[0] * n[i] + d[1] * n[i + 1] + d[2] * n[i + 2];
            for (let k = 0; k < 3; ++k) {
                array[2 * i + k] = places[i + k] + above * n[i + k];
                array[2 * i + 3 + k] = array[2 * i + k] + longer * (d[k] - across * n[i + k]);
            }
        }
        this.lines.geometry.attributes.position.needsUpdate = true;
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
        this.panel.showNumbers(numbers);
    }

    /// When nothing more is set: what it is, in words, and in the address.
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

    playOrPause() {
        if (this.isPlaying) return this.pause();
        const oneStep = matchMedia("(prefers-reduced-motion: reduce)").matches;
        if (oneStep) return this.change({ ...this.state, t: this.state.t + 1 });
        if (this.state.t >= shownSteps || this.isGone()) this.set({ ...this.state, t: 0 });
        this.isPlaying = true;
        this.why = "";
        this.panel.tellsAloud(false);
        this.playing = setInterval(() => {
            if (this.state.t >= shownSteps) return this.pause();
            this.set({ ...this.state, t: this.state.t + 1 });
        }, 1000 / stepsPerSecond);
        this.update();
    }
    /// @param why  said with what is then told
    pause(why = "") {
        clearInterval(this.playing);
        this.isPlaying = false;
        this.why = why;
        this.panel.tellsAloud(true);
        this.update();
    }
    /// Has every vertex left the view?
    isGone() { return this.clamped === this.data.vertices && !this.experiment.hasNoStep; }

    /// @param byReader  closed on purpose, not for another
    stop(byReader) {
        if (this.isStopped) return;
        this.isStopped = true;
        clearInterval(this.playing);
        clearTimeout(this.later);
        removeEventListener("hashchange", this.follow);
        removeEventListener("beforeprint", this.onPrint);
        this.models.forEach(({ mesh }) => mesh.children.forEach(({ geometry, material }) => { geometry.dispose(); material.dispose(); }));
        this.view.close();
        this.root.remove();
        if (byReader && readLink(location.hash)) history.replaceState(null, "", location.pathname + location.search);
        this.onStop(byReader);
    }
}

export function openLab(block, bytes, question, onStop) {
    return new Lab(block, lab.decoded(bytes), question, onStop);
}
