// The canvas on which one model, or two with one camera, are turned: by pointer, wheel, pinch and keys. Nothing moves by itself.
import { OrthographicCamera, SRGBColorSpace, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const margin = 1.04;                          // what is seen, in radii of the model
const narrow = 520;                           // pixels; below, two models stand above each other
const filled = 0.85;                          // of a pane's width or height, by a model that is fitted
const mostRead = 5000;                        // vertices that say how far a model reaches
const keyTurn = Math.PI / 24, keyZoom = 1.2;

/// "λ_crit" and "μ_max" with their indices set low; names of meshes keep their underscores.
export const typeset = (words) => words.split(/(?<=[λμ])_(\w+)/).map((part, i) => (i % 2 ? Object.assign(document.createElement("sub"), { textContent: part }) : part));

export function element(tag, className, text = "") {
    const made = Object.assign(document.createElement(tag), { className });
    made.append(...typeset(text));
    return made;
}

export const number = (x) => String(Number(x.toPrecision(4))).replaceAll("-", "−");

/// A colour bar: the colours, the ends of their range, and 0 where it is between them. @param isCut  values beyond the range have the colour of its upper end
export function legendOf({ quantity, unit, range: [low, high], isCut, colors, defined, undefined_color }) {
    const filled = (className, background) => {
        const area = element("i", className);
        area.style.background = background;
        return area;
    };
    const scale = element("span", ""), legend = element("div", "model-legend");
    const ramp = filled("ramp", `linear-gradient(to right, ${colors.join(", ")})`);
    if (low < 0 && high > 0) ramp.append(Object.assign(element("span", "zero", "0"), { style: `left: ${100 * low / (low - high)}%` }));
    scale.append(number(low), ramp, (isCut ? "≥ " : "") + number(high));
    legend.append(element("span", "", quantity + (unit ? ` [${unit}]` : "")), scale);
    if (defined) {
        const gap = element("span", "");
        gap.append(filled("swatch", undefined_color), "undefined");
        legend.append(gap);
    }
    return legend;
}

export function button(text, act) {
    const made = element("button", "model-button", text);
    made.type = "button";
    made.addEventListener("click", act);
    return made;
}

/// Returns the axis to turn models about: that of the model nearest to the top of the picture, or the top itself if the camera is rolled.
function axisOf(from, up) {
    const right = (k) => up[(k + 1) % 3] * from[(k + 2) % 3] - up[(k + 2) % 3] * from[(k + 1) % 3];
    const shares = up.map((u, k) => (Math.abs(right(k)) < 1e-9 ? Math.abs(u) : 0)), most = Math.max(...shares);
    return most < 1e-9 ? up : up.map((u, k) => (k === shares.indexOf(most) ? Math.sign(u) : 0));
}

export class View {
    /// Its `stage` is to be put into the page, then `open` called.
    /// @param told  callbacks: drawn() after each requested frame, keyed() after a movement by key, closed(byReader)
    /// @param fits  the models fill their panes, whatever becomes of them; else their frame does
    constructor(models, name, told, fits = false) {
        this.fits = fits;
        this.models = models;
        this.share = 1;
        this.told = { drawn() {}, keyed() {}, closed() {}, ...told };
        this.stage = element("div", "model-stage");
        this.canvas = element("canvas", "");
        this.canvas.tabIndex = 0;
        this.canvas.setAttribute("role", "application");
        this.canvas.setAttribute("aria-label", name);
        this.stage.append(this.canvas);
        this.nameModels();
    }

    /// @throws without WebGL
    open() {
        this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true });
        this.renderer.outputColorSpace = SRGBColorSpace;
        this.renderer.setClearColor(0x000000, 0);   // the page's ground shows through
        this.renderer.autoClear = false;
        this.frameModels();
        this.camera = new OrthographicCamera(-1, 1, 1, -1, 0.1, 20);
        this.placeCamera();
        this.controls = new OrbitControls(this.camera, this.canvas);
        this.controls.minZoom = Math.min(0.5, this.camera.zoom);
        this.controls.maxZoom = Math.max(40, this.camera.zoom);
        this.controls.saveState();
        this.controls.addEventListener("change", () => this.ask());
        this.listen();
        this.resized = new ResizeObserver(() => this.resize());
        this.resized.observe(this.stage);
        this.resize();
    }

    nameModels() {
        for (const label of this.stage.querySelectorAll(".model-label")) label.remove();
        if (this.models.length > 1) for (const { label } of this.models) this.stage.append(element("span", "model-label", label));
    }

    frameModels() {
        for (const model of this.models) model.frameOn(this.models[0].frame);
    }

    /// Others in their place, seen from where they were. The caller disposes of those that are not shown.
    show(models) {
        this.models = models;
        this.nameModels();
        this.frameModels();
        this.resize();
    }

    /// The direction of the picture.
    placeCamera() {
        const { from, up = [0, 1, 0], zoom = 1 } = this.models[0].frame;
        this.camera.position.set(...from).multiplyScalar(10);
        this.camera.up.set(...axisOf(from, up));
        this.camera.zoom = zoom;
        this.camera.lookAt(0, 0, 0);
    }

    listen() {
        // The wheel turns the page unless the reader is in the model.
        const onlyInside = (event) => { if (document.activeElement !== this.canvas) event.stopImmediatePropagation(); };
        this.stage.addEventListener("wheel", onlyInside, { capture: true });
        this.canvas.addEventListener("keydown", (event) => this.key(event));
        this.canvas.addEventListener("webglcontextlost", () => { if (!this.isClosed) this.told.closed(false); });
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
            "+": () => zoom(keyZoom), "=": () => zoom(keyZoom), "-": () => zoom(1 / keyZoom), 0: () => this.reset(), Escape: () => this.told.closed(true),
        };
        if (event.ctrlKey || event.metaKey || event.altKey || !acts[event.key]) return;
        event.preventDefault();
        event.stopPropagation();
        acts[event.key]();
        if (this.isClosed) return;
        this.draw();
        this.told.keyed();
    }

    reset() {
        this.controls.reset();
        this.ask();
    }

    /// Returns the cells of the models, in CSS pixels from the upper left.
    cells() {
        const { clientWidth: width, clientHeight: height } = this.stage, count = this.models.length;
        return this.models.map((model, i) => this.inRows
            ? { model, x: 0, y: i * height / count, width, height: height / count }
            : { model, x: i * width / count, y: 0, width: width / count, height });
    }

    /// Pixels for less work, 1: all.
    resolve(share) {
        if (this.share !== share) this.share = share, this.resize();
    }

    /// Arranges models side by side or one above the other; fitted ones so that they are larger.
    arrange(width, height) {
        const count = this.models.length, [side, up] = this.fits ? this.reach(this.controls.position0) : [1, 1];
        const scale = (across, down) => Math.min(width / across / side, height / down / up);
        this.inRows = this.fits ? scale(1, count) > scale(count, 1) : width < narrow;
    }

    resize() {
        const { clientWidth: width, clientHeight: height } = this.stage;
        if (width === 0 || height === 0) return;
        this.arrange(width, height);
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2) * this.share);
        this.renderer.setSize(width, height, false);
        const labels = this.stage.querySelectorAll(".model-label");
        this.cells().forEach(({ x, y }, i) => labels[i] && Object.assign(labels[i].style, { left: `${x}px`, top: `${y}px` }));
        this.draw();
    }

    /// Returns the extent of the models to the sides and up, seen from a place around the origin.
    reach(place) {
        const towards = place.clone().normalize(), side = this.camera.up.clone().cross(towards).normalize(), up = towards.clone().cross(side), reach = [0, 0];
        for (const { mesh } of this.models.filter((model) => model.mesh.visible)) {
            const { position } = mesh.geometry.attributes, step = Math.ceil(position.count / mostRead), { elements: m } = mesh.matrixWorld;
            const rows = [side, up].map(({ x, y, z }) => [0, 4, 8, 12].map((at) => x * m[at] + y * m[at + 1] + z * m[at + 2]));
            for (let v = 0; v < position.count; v += step) {
                const [x, y, z] = [position.getX(v), position.getY(v), position.getZ(v)];
                for (let k = 0; k < 2; ++k) reach[k] = Math.max(reach[k], Math.abs(rows[k][0] * x + rows[k][1] * y + rows[k][2] * z + rows[k][3]));
            }
        }
        return reach;
    }

    /// Shows as much as makes the models fill their panes in the picture's own direction, and more where they reach farther now: none is cut.
    fit() {
        const { camera, controls } = this, [cell] = this.cells(), aspect = cell.width / cell.height;
        const places = [controls.position0, camera.position.clone().sub(controls.target)];
        const needed = places.map((place) => { const [side, up] = this.fits ? this.reach(place) : [1, 1]; return Math.max(up, side / aspect); });
        const up = (Math.max(...needed) || 1) * (this.fits ? 1 / filled : margin);
        if (up === camera.top && up * aspect === camera.right) return;
        Object.assign(camera, { left: -up * aspect, right: up * aspect, top: up, bottom: -up });
        camera.updateProjectionMatrix();
    }

    /// Once a frame, however often it is asked for.
    ask() {
        this.asked ??= requestAnimationFrame(() => {
            this.asked = null;
            if (this.isClosed) return;
            this.draw();
            this.told.drawn();
        });
    }

    draw() {
        const { renderer, stage } = this;
        this.fit();
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

    close() {
        this.isClosed = true;
        this.resized?.disconnect();
        this.controls?.dispose();
        for (const model of this.models) model.dispose();
        this.renderer?.dispose();
        this.renderer?.forceContextLoss();
    }
}
