// Turns one model, or two with one camera (before and after), and reads their values. Everything happens on the reader's act.
import { Raycaster, Vector2 } from "three";

import { openLab, prepareLab } from "./lab.js";
import { Model } from "./model.js";
import { button, element, legendOf, number, View } from "./view.js";

class Viewer {
    constructor(block, models, onStop) {
        this.models = models;
        this.onStop = onStop;
        this.view = new View(models, "Model in three dimensions. Arrow keys turn, plus and minus zoom, 0 resets, Escape closes.", {
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
        const hint = element("p", "model-hint", "Drag or arrow keys: turn. Wheel, pinch, + and −: zoom. Right drag: move. 0: reset. Esc: close.");
        this.panel.append(this.view.stage, bar);
        if (this.models[0].value) this.panel.append(legendOf(this.models[0].value));
        this.panel.append(hint);
        block.append(this.panel);
    }

    listen() {
        const { canvas } = this.view;
        canvas.addEventListener("pointermove", (event) => { this.pointer = event.buttons === 0 ? event : null; this.view.ask(); });
        canvas.addEventListener("pointerleave", () => { this.pointer = null; this.tell(""); });
    }

    tellAtPointer() {
        const { offsetX, offsetY } = this.pointer;
        const inside = ({ x, y, width, height }) => offsetX >= x && offsetX < x + width && offsetY >= y && offsetY < y + height;
        const cell = this.view.cells().find(inside);
        if (!cell) return;
        const at = new Vector2(2 * (offsetX - cell.x) / cell.width - 1, 1 - 2 * (offsetY - cell.y) / cell.height);
        this.tell(this.reading(cell, at));
    }

    /// What is at a point of a cell, in words. The same triangles in the other model are read with it.
    reading({ model }, at) {
        this.raycaster.setFromCamera(at, this.view.camera);
        const [hit] = this.raycaster.intersectObject(model.mesh, false);
        if (!hit) return "";
        const corners = [hit.face.a, hit.face.b, hit.face.c], weights = hit.barycoord.toArray();
        const vertex = `vertex ${corners[weights.indexOf(Math.max(...weights))]}`;
        if (!model.value) return vertex;
        const alike = (other) => other.values && other.mesh.geometry.index.count === model.mesh.geometry.index.count;
        const words = (each) => { const value = each.valueAt(corners, weights); return value === null ? "undefined" : number(value); };
        const { quantity, unit } = model.value;
        const ending = `${unit ? ` ${unit}` : ""} · nearest ${vertex}`;
        if (this.models.length === 1) return `${quantity} = ${words(model)}${ending}`;
        return `${quantity}: ${this.models.filter(alike).map((each) => `${each.label} ${words(each)}`).join(", ")}${ending}`;
    }

    tell(words, prefix = "") {
        this.told.textContent = words && prefix + words;
    }

    /// @param byReader  closed on purpose, not lost
    stop(byReader) {
        if (this.view.isClosed) return;
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

/// Fills `block` with models to turn: [{label, bytes}], bytes of a GLB. `onStop(byReader)` is told when it has closed.
/// @throws where the browser has no WebGL
async function start(block, models, onStop) {
    const loaded = await Promise.all(models.map(({ bytes, label }) => Model.load(bytes, label)));
    await inPlaceOfTheOther(block, () => new Viewer(block, loaded, onStop));
}

/// Fills `block` with the laboratory of a question, on the mesh whose bytes these are (src/run/lab/lab_mesh.h).
async function startLab(block, bytes, question, onStop) {
    const prepared = await prepareLab(bytes);
    await inPlaceOfTheOther(block, () => openLab(block, prepared, question, onStop));
}

globalThis.meshfolioViewer = { start, startLab };
