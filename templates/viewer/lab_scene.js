// The mesh before and after the filter as the laboratory draws them: surfaces, their edges, and the lines of the drift.
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments } from "three";

import { normals } from "./lab_math.js";
import { longer, longest } from "./lab_words.js";
import { Model } from "./model.js";
import { clay, paletteOf } from "./shader.js";

const lightOnValues = 0.25;   // of 1, more than in the report's pictures, which have occlusion to show form
const room = 1.25;     // radii of the mesh: what flies farther is drawn at the rim
const above = 0.015;   // radii above the surface, where the lines of the drift lie

/// The edges of the triangles, each once.
function edgesOf(corners) {
    const edges = new Set();
    for (let i = 0; i < corners.length; ++i) {
        const [a, b] = [corners[i], corners[i % 3 === 2 ? i - 2 : i + 1]];
        edges.add(a < b ? a * 2 ** 26 + b : b * 2 ** 26 + a);
    }
    return Uint32Array.from([...edges].flatMap((edge) => [Math.floor(edge / 2 ** 26), edge % 2 ** 26]));
}

export class Scene {
    constructor(data) {
        this.data = data;
        this.radius = 0;
        for (let i = 0; i < data.positions.length; i += 3) this.radius = Math.max(this.radius, Math.hypot(...data.positions.subarray(i, i + 3)));
        this.normals = normals(data);
        this.palettes = Object.fromEntries(Object.entries(data.colors).map(([name, colors]) => [name, paletteOf(colors)]));
        const frame = { centre: [0, 0, 0], radius: 1 }, places = () => Float32Array.from(data.positions, (x) => x / this.radius);
        this.models = ["before", "after"].map((label) => Model.ofSurface(places(), data.corners, label, { colors: data.colors.pale }, frame));
        const edges = new BufferAttribute(edgesOf(data.corners), 1);
        this.wires = this.models.map(({ mesh }) => {
            Object.assign(mesh.material, { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
            mesh.material.uniforms.plain.value = clay;
            mesh.material.uniforms.light_on_values.value = lightOnValues;
            mesh.material.uniforms.palette.value.dispose();
            const wire = new BufferGeometry().setAttribute("position", mesh.geometry.attributes.position).setIndex(edges);
            const lines = new LineSegments(wire, new LineBasicMaterial({ color: 0x1c1d21, transparent: true, opacity: 0.3 }));
            mesh.add(lines);
            return lines;
        });
        const ends = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(6 * data.vertices), 3));
        this.drift = new LineSegments(ends, new LineBasicMaterial({ color: 0xc2410c }));
        this.models[1].mesh.add(this.drift);
        this.models.forEach(({ mesh }) => mesh.traverse((object) => { object.frustumCulled = false; }));
    }

    /// Moves one of the two. @param shown  {places, map}: of its vertices in a colour map; null: clay
    /// @return how many vertices lie at the rim
    move(model, x, shown) {
        const { places, clamped } = this.drawable(x), { uniforms } = model.mesh.material;
        model.moveTo(places, shown?.places ?? []);
        uniforms.isPlain.value = shown === null;
        if (shown) uniforms.palette.value = this.palettes[shown.map], uniforms.paletteSize.value = this.data.colors[shown.map].length;
        return clamped;
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

    show({ edges, lines }) {
        for (const wire of this.wires) wire.visible = edges;
        this.drift.visible = lines;
        if (lines) this.moveDrift();
    }

    /// From each vertex to where it belongs, as far as that is along the surface.
    moveDrift() {
        const { array } = this.drift.geometry.attributes.position, { positions } = this.data, n = this.normals, places = this.models[1].mesh.geometry.attributes.position.array;
        for (let i = 0; i < places.length; i += 3) {
            const d = [0, 1, 2].map((k) => positions[i + k] / this.radius - places[i + k]);
            const across = d[0] * n[i] + d[1] * n[i + 1] + d[2] * n[i + 2], along = d.map((far, k) => longer * (far - across * n[i + k]));
            const cut = Math.min(1, longest / Math.hypot(...along));
            for (let k = 0; k < 3; ++k) {
                array[2 * i + k] = places[i + k] + above * n[i + k];
                array[2 * i + 3 + k] = array[2 * i + k] + cut * along[k] || array[2 * i + k];
            }
        }
        this.drift.geometry.attributes.position.needsUpdate = true;
    }

    dispose() {
        this.models.forEach(({ mesh }) => mesh.children.forEach(({ geometry, material }) => { geometry.dispose(); material.dispose(); }));
        Object.values(this.palettes).forEach((palette) => palette.dispose());
    }
}
