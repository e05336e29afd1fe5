// A model of the report (src/output/draw/write_glb.h) read by three.js's own loader, or a surface that moves, with what the shader and the
// reading of values need.
import { BufferAttribute, BufferGeometry, Group, Mesh, MeshBasicMaterial, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

import { materialFor } from "./shader.js";

// A vertex is a crease if the mean normal of its triangles, weighted by area, is shorter than this, as in render/scene.cpp.
const creaseBegin = 0.914, creaseEnd = 0.848;

/// Returns for each vertex the weight of the triangle's normal against its own, 0 to 1.
function sharpnessOf(geometry) {
    const { position } = geometry.attributes, corners = geometry.index.array;
    const sums = new Float64Array(4 * position.count);   // normals times areas, and areas
    const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
    for (let i = 0; i < corners.length; i += 3) {
        a.fromBufferAttribute(position, corners[i]);
        b.fromBufferAttribute(position, corners[i + 1]).sub(a);
        c.fromBufferAttribute(position, corners[i + 2]).sub(a);
        const area = b.cross(c).length();
        for (let k = 0; k < 3; ++k) {
            const at = 4 * corners[i + k];
            sums[at] += b.x, sums[at + 1] += b.y, sums[at + 2] += b.z, sums[at + 3] += area;
        }
    }
    return Float32Array.from({ length: position.count }, (_, v) => {
        const [x, y, z, area] = sums.subarray(4 * v, 4 * v + 4);
        const length = area > 0 ? Math.hypot(x, y, z) / area : 0;
        return Math.min(1, Math.max(0, (creaseBegin - length) / (creaseBegin - creaseEnd)));
    });
}

/// Places in the colour map, 0 at the low end and 1 at the high one; computed here because the shader's numbers are short.
function placesOf(values, { range: [low, high], logarithmic }) {
    if (logarithmic) return Float32Array.from(values, (value) => Math.log(Math.max(value, low) / low) / Math.log(high / low));
    return Float32Array.from(values, (value) => (value / 2 - low / 2) / (high / 2 - low / 2));
}

export class Model {
    /// @param bytes  ArrayBuffer of a GLB
    static async load(bytes, label) {
        const { scene } = await new GLTFLoader().parseAsync(bytes, "");
        return new Model(scene, label);
    }

    /// A surface that moves and changes its colours. @param positions  Float32Array, x y z of each vertex; value: {colors}, the colour map
    static ofSurface(positions, corners, label, value, frame) {
        const geometry = new BufferGeometry();
        geometry.setAttribute("position", new BufferAttribute(positions, 3));
        geometry.setIndex(new BufferAttribute(corners, 1));
        geometry.setAttribute("place", new BufferAttribute(new Float32Array(positions.length / 3), 1));
        const mesh = new Mesh(geometry, new MeshBasicMaterial());
        Object.assign(mesh.userData, { frame, value });
        mesh.frustumCulled = false;   // its bounds move, too
        return new Model(new Group().add(mesh), label);
    }

    constructor(scene, label) {
        this.label = label;
        scene.traverse((object) => { if (object.isMesh) this.mesh = object; });
        const { geometry, userData } = this.mesh;
        geometry.deleteAttribute("normal");   // zeros in the page's copy of a model
        geometry.computeVertexNormals();
        this.value = userData.value ?? null;
        this.frame = userData.frame;
        this.values = geometry.attributes._value?.array ?? null;
        const mask = geometry.attributes._defined;
        this.isDefined = (v) => !mask || mask.getX(v) === 1;
        geometry.setAttribute("sharpness", new BufferAttribute(sharpnessOf(geometry), 1));
        if (this.values) geometry.setAttribute("place", new BufferAttribute(placesOf(this.values, this.value), 1));
        const plain = this.mesh.material.color;
        this.mesh.material.dispose();
        this.mesh.material = materialFor(this.value, mask !== undefined, plain);
        this.root = new Group().add(scene);
    }

    /// Moves a ball of the model's space onto the unit ball around the origin.
    frameOn({ centre, radius }) {
        this.root.scale.setScalar(1 / radius);
        this.root.position.fromArray(centre).multiplyScalar(-1 / radius);
        this.root.updateMatrixWorld(true);
    }

    hasTrianglesOf(other) {
        return this.mesh.geometry.index.count === other.mesh.geometry.index.count;
    }

    /// The value at a point of a triangle: null where undefined, as decided by the nearest corner.
    valueAt(corners, weights) {
        if (!this.isDefined(corners[weights.indexOf(Math.max(...weights))])) return null;
        let total = 0, weight = 0;
        corners.forEach((v, k) => {
            if (this.isDefined(v)) total += weights[k] * this.values[v], weight += weights[k];
        });
        return total / weight;
    }

    dispose() {
        this.mesh.geometry.dispose();
        this.mesh.material.uniforms.palette?.value?.dispose();
        this.mesh.material.dispose();
    }
}
