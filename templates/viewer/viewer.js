// Turns one model, or two with one camera (before and after). Everything happens on the reader's act; nothing moves by itself.
import { OrthographicCamera, Raycaster, SRGBColorSpace, Vector2, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { Model } from "./model.js";

const heroAzimuth = 35, heroElevation = 22;   // degrees, as render/camera.cpp: the picture's own direction
const margin = 1.04;                          // what is seen, in radii of the model
const narrow = 520;                           // pixels; below, two models stand above each other
const keyTurn = Math.PI / 24, keyZoom = 1.2;

const element = (tag, className, text = "") => Object.assign(document.createElement(tag), { className, textContent: text });
const number = (x) => String(Number(x.toPrecision(4))).replaceAll("-", "−");

function button(text, act) {
    const made = element("button", "model-button", text);
    made.type = "button";
    made.addEventListener("click", act);
    return made;
}

/// The colours and the ends of their range.
function legendOf({ quantity, unit, range: [low, high], colors, defined, undefined_color }) {
    const filled = (className, background) => {
        const area = element("i", className);
        area.style.background = background;
        return area;
    };
    const scale = element("span", ""), legend = element("div", "model-legend");
    scale.append(number(low), filled("ramp", `linear-gradient(to right, ${colors.join(", ")})`), number(high));
    legend.append(element("span", "", quantity + (unit ? ` [${unit}]` : "")), scale);
    if (defined) {
        const gap = element("span", "");
        gap.append(filled("swatch", undefined_color), "undefined");
        legend.append(gap);
    }
    return legend;
}

class Viewer {
    constructor(block, models, onStop) {
        this.models = models;
        this.onStop = onStop;
        this.build(block);
        this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true });   // throws without WebGL
        this.renderer.outputColorSpace = SRGBColorSpace;
        this.renderer.setClearColor(0x000000, 0);   // the page's ground shows through
        this.renderer.autoClear = false;
        for (const model of models) model.frameOn(models[0].frame);
        this.camera = new OrthographicCamera(-1, 1, 1, -1, 0.1, 20);
        this.placeCamera();
        this.controls = new OrbitControls(this.camera, this.canvas);
        this.controls.minZoom = 0.5;
        this.controls.maxZoom = 40;
        this.controls.saveState();
        this.controls.addEventListener("change", () => this.ask());
        this.raycaster = new Raycaster();
        this.listen();
        this.resized = new ResizeObserver(() => this.resize());
        this.resized.observe(this.stage);
        this.resize();
        this.canvas.focus({ preventScroll: true });
    }

    build(block) {
        this.panel = element("div", "model-panel");
        this.stage = element("div", "model-stage");
        this.canvas = element("canvas", "");
        this.canvas.tabIndex = 0;
        this.canvas.setAttribute("role", "application");
        this.canvas.setAttribute("aria-label", "Model in three dimensions. Arrow keys turn, plus and minus zoom, 0 resets, Escape closes.");
        this.stage.append(this.canvas);
        if (this.models.length > 1) for (const { label } of this.models) this.stage.append(element("span", "model-label", label));
        this.told = element("output", "model-value");
        this.told.setAttribute("aria-live", "polite");
        const bar = element("div", "model-bar");
        bar.append(this.told, button("Reset", () => this.reset()), button("Close", () => this.stop(true)));
        const hint = element("p", "model-hint", "Drag or arrow keys: turn. Wheel, pinch, + and −: zoom. Right drag: move. 0: reset. Esc: close.");
        this.panel.append(this.stage, bar);
        if (this.models[0].value) this.panel.append(legendOf(this.models[0].value));
        this.panel.append(hint);
        block.append(this.panel);
    }

    /// The direction of the picture.
    placeCamera() {
        const a = heroAzimuth * Math.PI / 180, e = heroElevation * Math.PI / 180;
        this.camera.position.set(Math.cos(e) * Math.sin(a), Math.sin(e), Math.cos(e) * Math.cos(a)).multiplyScalar(10);
        this.camera.lookAt(0, 0, 0);
    }

    listen() {
        // The wheel turns the page unless the reader is in the model.
        const onlyInside = (event) => { if (document.activeElement !== this.canvas) event.stopImmediatePropagation(); };
        this.stage.addEventListener("wheel", onlyInside, { capture: true });
        this.canvas.addEventListener("keydown", (event) => this.key(event));
        this.canvas.addEventListener("pointermove", (event) => { this.pointer = event.buttons === 0 ? event : null; this.ask(); });
        this.canvas.addEventListener("pointerleave", () => { this.pointer = null; this.tell(""); });
        this.canvas.addEventListener("webglcontextlost", () => this.stop(false));
    }

    key(event) {
        const { controls, camera } = this;
        const zoom = (factor) => {
            camera.zoom = Math.min(controls.maxZoom, Math.max(controls.minZoom, camera.zoom * factor));
            camera.updateProjectionMatrix();
            this.ask();
        };
        const acts = {
            ArrowLeft: () => controls.rotateLeft(-keyTurn), ArrowRight: () => controls.rotateLeft(keyTurn),
            ArrowUp: () => controls.rotateUp(-keyTurn), ArrowDown: () => controls.rotateUp(keyTurn),
            "+": () => zoom(keyZoom), "=": () => zoom(keyZoom), "-": () => zoom(1 / keyZoom), 0: () => this.reset(), Escape: () => this.stop(true),
        };
        if (event.ctrlKey || event.metaKey || event.altKey || !acts[event.key]) return;
        event.preventDefault();
        event.stopPropagation();
        acts[event.key]();
        if (this.stopped) return;
        this.draw();
        this.tell(this.reading(this.cells()[0], new Vector2(0, 0)), "in the middle: ");
    }

    reset() {
        this.controls.reset();
        this.ask();
    }

    /// Where the models are drawn, in CSS pixels from the upper left.
    cells() {
        const { clientWidth: width, clientHeight: height } = this.stage, count = this.models.length;
        const inRows = width < narrow;
        return this.models.map((model, i) => inRows
            ? { model, x: 0, y: i * height / count, width, height: height / count }
            : { model, x: i * width / count, y: 0, width: width / count, height });
    }

    resize() {
        const { clientWidth: width, clientHeight: height } = this.stage;
        if (width === 0 || height === 0) return;
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.renderer.setSize(width, height, false);
        const [cell] = this.cells(), aspect = cell.width / cell.height;
        const up = margin * Math.max(1, 1 / aspect);
        Object.assign(this.camera, { left: -up * aspect, right: up * aspect, top: up, bottom: -up });
        this.camera.updateProjectionMatrix();
        const labels = this.stage.querySelectorAll(".model-label");
        this.cells().forEach(({ x, y }, i) => labels[i] && Object.assign(labels[i].style, { left: `${x}px`, top: `${y}px` }));
        this.draw();
    }

    /// Once a frame, however often it is asked for.
    ask() {
        this.asked ??= requestAnimationFrame(() => {
            this.asked = null;
            if (this.stopped) return;
            this.draw();
            if (this.pointer) this.tellAtPointer();
        });
    }

    draw() {
        const { renderer, stage } = this;
        renderer.setScissorTest(false);
        renderer.clear();
        renderer.setScissorTest(true);
        for (const { model, x, y, width, height } of this.cells()) {
            const fromBelow = stage.clientHeight - y - height;
            renderer.setViewport(x, fromBelow, width, height);
            renderer.setScissor(x, fromBelow, width, height);
            renderer.render(model.root, this.camera);
        }
    }

    tellAtPointer() {
        const { offsetX, offsetY } = this.pointer;
        const inside = ({ x, y, width, height }) => offsetX >= x && offsetX < x + width && offsetY >= y && offsetY < y + height;
        const cell = this.cells().find(inside);
        if (!cell) return;
        const at = new Vector2(2 * (offsetX - cell.x) / cell.width - 1, 1 - 2 * (offsetY - cell.y) / cell.height);
        this.tell(this.reading(cell, at));
    }

    /// What is at a point of a cell, in words. The same triangles in the other model are read with it.
    reading({ model }, at) {
        this.raycaster.setFromCamera(at, this.camera);
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
        if (this.stopped) return;
        this.stopped = true;
        this.resized.disconnect();
        this.controls.dispose();
        for (const model of this.models) model.dispose();
        this.renderer.dispose();
        this.renderer.forceContextLoss();
        this.panel.remove();
        this.onStop(byReader);
    }
}

let live = null;   // one context at a time

/// Fills `block` with models to turn: [{label, bytes}], bytes of a GLB. `onStop(byReader)` is told when it has closed.
/// @throws where the browser has no WebGL
async function start(block, models, onStop) {
    const loaded = await Promise.all(models.map(({ bytes, label }) => Model.load(bytes, label)));
    live?.stop(false);
    live = null;
    try {
        live = new Viewer(block, loaded, onStop);
    } catch (error) {
        block.querySelector(".model-panel")?.remove();
        throw error;
    }
}

globalThis.meshfolioViewer = { start };
