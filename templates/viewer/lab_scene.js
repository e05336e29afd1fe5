// The mesh before and after the filter as the laboratory draws them: surfaces, their edges, and the lines of the drift.
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments } from "three";

import { normals } from "./lab_math.js";
import { longer, longest } from "./lab_words.js";
import { Model } from "./model.js";
import { clay, paletteOf } from "./shader.js";

const lightOnValues = 0.25;   // of 1, more than in the report's pictures, which have occlusion to show form
const room = 1.25;     // radii of the mesh: what flies farther is drawn at the rim
const above = 0.015;   // radii above the surface, where the lines of the drift lie

// A vertex is a crease where the mean normal around it, weighted by area, is shorter than this: as in the report's pictures, but of a few
// hundred vertices one in two would be one there.
const creaseBegin = 0.8, creaseEnd = 0.734;

/// Normals of the vertices, and how far each takes that of the triangle instead, 0 to 1.
function shapeOf({ attributes: { position, normal, sharpness }, index }) {
    const x = position.array, n = normal.array.fill(0), corners = index.array, areas = new Float32Array(position.count);
    for (let i = 0; i < corners.length; i += 3) {
        const a = 3 * corners[i], b = 3 * corners[i + 1], c = 3 * corners[i + 2];
        const ux = x[b] - x[a], uy = x[b + 1] - x[a + 1], uz = x[b + 2] - x[a + 2], vx = x[c] - x[a], vy = x[c + 1] - x[a + 1], vz = x[c + 2] - x[a + 2];
        const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx, area = Math.hypot(nx, ny, nz);
        for (let k = i; k < i + 3; ++k) {
            const v = corners[k];
            n[3 * v] += nx, n[3 * v + 1] += ny, n[3 * v + 2] += nz, areas[v] += area;
        }
    }
    for (let v = 0, at = 0; v < position.count; ++v, at += 3) {
        const length = Math.hypot(n[at], n[at + 1], n[at + 2]) || 1;
        sharpness.array[v] = Math.min(1, Math.max(0, (creaseBegin - length / (areas[v] || 1)) / (creaseBegin - creaseEnd)));
        n[at] /= length, n[at + 1] /= length, n[at + 2] /= length;
    }
}

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
        const frame = { centre: [0, 0, 0], radius: 1, from: data.from, up: data.up, zoom: data.zoom }, places = () => Float32Array.from(data.positions, (x) => x / this.radius);
        this.models = ["before", "after"].map((label) => Model.ofSurface(places(), data.corners, label, { colors: data.colors.pale }, frame));
        for (const { mesh } of this.models) {
            Object.assign(mesh.material, { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
            Object.assign(mesh.material.uniforms.plain, { value: clay });
            mesh.material.uniforms.light_on_values.value = lightOnValues;
            mesh.material.uniforms.palette.value.dispose();
        }
        const ends = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(6 * data.vertices), 3));
        this.drift = new LineSegments(ends, new LineBasicMaterial({ color: 0xc2410c }));
        this.models[1].mesh.add(this.drift);
        this.drift.frustumCulled = false;
    }

    makeWires() {
        const edges = new BufferAttribute(edgesOf(this.data.corners), 1);
        return this.models.map(({ mesh }) => {
            const wire = new BufferGeometry().setAttribute("position", mesh.geometry.attributes.position).setIndex(edges);
            const lines = new LineSegments(wire, new LineBasicMaterial({ color: 0x1c1d21, transparent: true, opacity: 0.3 }));
            lines.frustumCulled = false;
            mesh.add(lines);
            return lines;
        });
    }

    /// Moves one of the two. @param shown  {places, map}: of its vertices in a colour map; null: clay
    /// @return how many vertices lie at the rim
    move(model, x, shown) {
        const { places, clamped } = this.drawable(x), { geometry, material: { uniforms } } = model.mesh;
        geometry.attributes.position.array.set(places);
        if (shown) geometry.attributes.place.array.set(shown.places);
        shapeOf(geometry);
        for (const name of ["position", "place", "normal", "sharpness"]) geometry.attributes[name].needsUpdate = true;
        uniforms.isPlain.value = shown === null;
        if (shown) uniforms.palette.value = this.palettes[shown.map], uniforms.paletteSize.value = this.data.colors[shown.map].length;
        return clamped;
    }

    /// Returns positions in radii of the mesh; points beyond the room lie at its rim, and `clamped` counts them.
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
        if (edges) this.wires ??= this.makeWires();
        this.wires?.forEach((wire) => { wire.visible = edges; });
        this.drift.visible = lines;
        if (lines) this.moveDrift();
    }

    /// Draws a line from each vertex towards its clean place, along the surface.
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
