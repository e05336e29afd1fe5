// Turns the models of a figure, one or two at a time with one camera, and reads their values. Everything happens on the reader's act.
import { Raycaster, Vector2 } from "three";

import { openLab, prepareLab } from "./lab.js";
import { Model } from "./model.js";
import { button, element, legendOf, number, typeset, View } from "./view.js";

/// The numbers of labels that differ in one number alone, in order: "k = 5, …", "k = 15, …"; null unless three or more do. What stands
/// behind the number may differ, as it tells of it.
function seriesOf(labels) {
    const parts = labels.map((label) => label.match(/^(.*?\S = )(−?[\d.]+)/)), known = parts.filter(Boolean);
    return known.length >= 3 && known.every(([, name]) => name === known[0][1]) ? parts : null;
}

class Viewer {
    /// @param models   [{label, load}], load() a promise of the Model
    /// @param first    the Models to begin with: of models[0], and of models[1] where both have the same triangles
    constructor(block, models, first, onStop) {
        this.all = models;
        this.at = 0;
        this.loaded = new Map(first.map((model, i) => [i, model]));
        this.models = first;
        this.onStop = onStop;
        this.view = new View(first, "Model in three dimensions. Arrow keys turn, plus and minus zoom, 0 resets, Escape closes.", {
            drawn: () => { if (this.pointer) this.tellAtPointer(); },
            keyed: () => this.tell(this.reading(this.view.cells()[0], new Vector2(0, 0)), "in the middle: "),
            closed: (byReader) => this.stop(byReader),
        });
        this.build(block);
        this.view.open();
        this.raycaster = new Raycaster();
        this.listen();
        this.view.canvas.focus({ preventScroll: true });
    }

    build(block) {
        this.panel = element("div", "model-panel");
        this.told = element("output", "model-value");
        this.told.setAttribute("aria-live", "polite");
        const bar = element("div", "model-bar");
        bar.append(this.told, button("Reset", () => this.view.reset()), button("Close", () => this.stop(true)));
        this.tip = element("div", "model-tip");
        this.tip.hidden = true;
        this.view.stage.append(this.tip);
        const hint = element("p", "model-hint", "Drag or arrow keys: turn. Wheel, pinch, + and −: zoom. Right drag: move. 0: reset. Esc: close.");
        if (this.all.length > this.models.length) this.panel.append(this.chooser());
        this.panel.append(this.view.stage, bar);
        const own = block.closest("figure")?.querySelector(".legend-box"), [{ value }] = this.models;
        if (own) this.panel.append(own.cloneNode(true));
        else if (value) this.panel.append(legendOf(value));
        this.panel.append(hint);
        block.append(this.panel);
    }

    /// Makes a chooser of meshes: a slider for a series, else a button for each, and a switch to show two side by side.
    chooser() {
        const box = element("div", "model-chooser"), labels = this.all.map(({ label }) => label);
        box.setAttribute("role", "group");
        box.setAttribute("aria-label", "Mesh that is shown");
        if (seriesOf(labels)) {
            const slider = Object.assign(document.createElement("input"), { type: "range", min: 0, max: labels.length - 1, step: 1, value: 0 });
            const told = element("output", "", labels[0]);
            slider.setAttribute("aria-label", "Mesh of the series");
            this.mark = () => {
                slider.value = this.at;
                slider.setAttribute("aria-valuetext", labels[this.at]);
                told.replaceChildren(...typeset(labels[this.at]));
            };
            slider.addEventListener("input", () => this.choose(Number(slider.value)));
            box.append(slider, told);
        } else {
            const tabs = labels.map((label, i) => button(label, () => this.choose(i)));
            this.mark = () => tabs.forEach((tab, i) => tab.setAttribute("aria-pressed", String(i === this.at)));
            box.append(...tabs);
        }
        this.beside = button("Two at once", () => this.choose(this.at, this.models.length === 1));
        if (this.models.length > 1) box.append(this.beside);
        this.marked();
        return box;
    }

    marked() {
        this.mark();
        this.beside.setAttribute("aria-pressed", String(this.models.length > 1));
    }

    /// Shows a mesh, and the first beside it (the second beside the first) where that is wanted and both have the same triangles.
    async choose(at, withOther = this.models.length > 1) {
        const wanted = [at, ...(withOther ? [at === 0 ? 1 : 0] : [])].sort((a, b) => a - b);
        this.at = at;
        const models = await Promise.all(wanted.map(async (i) => {
            if (!this.loaded.has(i)) this.loaded.set(i, await this.all[i].load());
            return this.loaded.get(i);
        }));
        if (this.view.isClosed || this.at !== at) return;
        this.models = models.length > 1 && !models[0].hasTrianglesOf(models[1]) ? [this.loaded.get(at)] : models;
        this.view.show(this.models);
        this.tell("");
        this.marked();
    }

    listen() {
        const { canvas } = this.view;
        canvas.addEventListener("pointermove", (event) => { this.pointer = event.buttons === 0 ? event : null; this.view.ask(); });
        canvas.addEventListener("pointerdown", () => { this.tip.hidden = true; });
        canvas.addEventListener("pointerleave", () => { this.pointer = null; this.tell(""); });
    }

    tellAtPointer() {
        const { offsetX, offsetY } = this.pointer;
        const inside = ({ x, y, width, height }) => offsetX >= x && offsetX < x + width && offsetY >= y && offsetY < y + height;
        const cell = this.view.cells().find(inside);
        if (!cell) return;
        const at = new Vector2(2 * (offsetX - cell.x) / cell.width - 1, 1 - 2 * (offsetY - cell.y) / cell.height);
        this.tell(this.reading(cell, at));
        this.tip.hidden = !this.told.textContent;
        this.tip.textContent = this.told.textContent;
        const { clientWidth, clientHeight } = this.view.stage, onLeft = offsetX > clientWidth / 2, above = offsetY > clientHeight / 2;
        Object.assign(this.tip.style, { left: onLeft ? "" : `${offsetX + 14}px`, right: onLeft ? `${clientWidth - offsetX + 14}px` : "",
            top: above ? "" : `${offsetY + 14}px`, bottom: above ? `${clientHeight - offsetY + 14}px` : "" });
    }

    /// Returns words on the point of a cell, with the value of the other model if the triangles are the same.
    reading({ model }, at) {
        this.raycaster.setFromCamera(at, this.view.camera);
        const [hit] = this.raycaster.intersectObject(model.mesh, false);
        if (!hit) return "";
        const corners = [hit.face.a, hit.face.b, hit.face.c], weights = hit.barycoord.toArray();
        const vertex = `vertex ${corners[weights.indexOf(Math.max(...weights))]}`;
        if (!model.value) return vertex;
        const alike = (other) => other.values && other.hasTrianglesOf(model);
        const words = (each) => { const value = each.valueAt(corners, weights); return value === null ? "undefined" : number(value); };
        const { quantity, unit } = model.value;
        const ending = `${unit ? ` ${unit}` : ""} · nearest ${vertex}`;
        if (this.models.length === 1) return `${quantity} = ${words(model)}${ending}`;
        return `${quantity}: ${this.models.filter(alike).map((each) => `${each.label} ${words(each)}`).join(", ")}${ending}`;
    }

    tell(words, prefix = "") {
        this.told.textContent = words && prefix + words;
        this.tip.hidden = true;
    }

    /// @param byReader  closed on purpose, not lost
    stop(byReader) {
        if (this.view.isClosed) return;
        for (const model of this.loaded.values()) if (!this.models.includes(model)) model.dispose();
        this.view.close();
        this.panel.remove();
        this.onStop(byReader);
    }
}

let live = null;   // one context at a time

/// @param open  makes what takes its place
async function inPlaceOfTheOther(block, open) {
    live?.stop(false);
    live = null;
    try {
        live = open();
    } catch (error) {
        block.querySelector(".model-panel")?.remove();
        throw error;
    }
    return live;
}

/// Fills `block` with models to turn: [{label, bytes}], bytes() a promise of a GLB. Calls `onStop(byReader)` when it is closed.
/// @throws if the browser has no WebGL
async function start(block, models, onStop) {
    const all = models.map(({ bytes, label }) => ({ label, load: async () => Model.load(await bytes(), label) }));
    const first = await Promise.all(all.slice(0, 2).map(({ load }) => load()));
    if (first.length > 1 && !first[0].hasTrianglesOf(first[1])) first.pop().dispose();
    await inPlaceOfTheOther(block, () => new Viewer(block, all, first, onStop));
}

/// Fills `block` with the laboratory of a question for the mesh in these bytes (src/run/lab/lab_mesh.h).
async function startLab(block, bytes, question, onStop) {
    const prepared = await prepareLab(bytes);
    await inPlaceOfTheOther(block, () => openLab(block, prepared, question, onStop));
}

globalThis.meshfolioViewer = { start, startLab };
