// GLB by another program: what three.js writes is read with the positions that three.js itself computes for it, and what we write is read
// by three.js and passes the official validator.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, describe, test } from "node:test";
import validator from "gltf-validator";
import * as THREE from "three";
import { GLTFExporter } from "three/examples/jsm/exporters/GLTFExporter.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";

globalThis.self ??= globalThis;
globalThis.FileReader ??= class {   // the exporter's only need of a browser
    readAsArrayBuffer(blob) { blob.arrayBuffer().then((buffer) => { this.result = buffer; this.onloadend(); }); }
};

const folder = mkdtempSync(path.join(tmpdir(), "exporter-"));
after(() => rmSync(folder, { recursive: true }));

const meshfolio = (...words) => execFileSync(process.env.MESHFOLIO, words, { cwd: folder, encoding: "utf8" });

/// The scene as a file of that name.
async function exported(name, ...objects) {
    const scene = new THREE.Scene().add(...objects);
    scene.updateMatrixWorld(true);
    writeFileSync(path.join(folder, name), Buffer.from(await new GLTFExporter().parseAsync(scene, { binary: true })));
}

/// The vertices that meshfolio finds in a file, each [x, y, z, …], and of PLY with its colour.
function read(name, ending = "obj") {
    meshfolio("noise", name, "--sigma", "0", "-o", `${name}.${ending}`);
    const lines = readFileSync(path.join(folder, `${name}.${ending}`), "latin1").split("\n");
    return lines.filter((line) => line.startsWith("v ")).map((line) => line.split(" ").slice(1).map(Number));
}

/// Returns the vertices of a mesh as three.js places them, with morph targets and bones.
function placed(mesh) {
    const count = mesh.geometry.attributes.position.count;
    return Array.from({ length: count }, (_, i) => mesh.getVertexPosition(i, new THREE.Vector3()).applyMatrix4(mesh.matrixWorld).toArray());
}

const key = (point) => point.map((x) => (Math.round(x * 1e4) || 0)).join(" ");

/// Returns the same points, each once for each of `bodies` lists.
function assertSame(found, bodies) {
    const expected = bodies.flatMap((points) => [...new Set(points.map(key))]).sort();
    assert.deepEqual(found.map(key).sort(), expected);
}

const matter = () => new THREE.MeshStandardMaterial();
const box = () => new THREE.BoxGeometry(1, 2, 3);   // four vertices a side: seams
const turned = new THREE.Matrix4().compose(new THREE.Vector3(1, 2, 3), new THREE.Quaternion(0.5, 0.5, 0.1, 0.7).normalize(), new THREE.Vector3(2, 1, 0.5));

describe("what three.js writes", () => {
    test("a skin of two bones whose mesh is scaled", async () => {
        const geometry = box(), count = geometry.attributes.position.count;
        const weights = Float32Array.from({ length: 4 * count }, (_, i) => (i % 4 === 0 ? 0.75 : i % 4 === 1 ? 0.25 : 0));
        geometry.setAttribute("skinIndex", new THREE.BufferAttribute(Uint16Array.from({ length: 4 * count }, (_, i) => (i % 4 === 1 ? 1 : 0)), 4));
        geometry.setAttribute("skinWeight", new THREE.BufferAttribute(weights, 4));
        const mesh = new THREE.SkinnedMesh(geometry, matter()), root = new THREE.Bone(), tip = new THREE.Bone();
        root.add(tip);
        tip.position.set(0, 1, 0);
        mesh.scale.set(3, 3, 3);
        mesh.add(root);
        mesh.updateMatrixWorld(true);
        mesh.bind(new THREE.Skeleton([root, tip]));
        root.rotation.set(0.3, 0.2, 0.1);
        tip.position.set(0.5, 2, 0.25);
        await exported("skin.glb", mesh);
        assertSame(read("skin.glb"), [placed(mesh)]);
    });

    test("instances", async () => {
        const mesh = new THREE.InstancedMesh(box(), matter(), 3), place = new THREE.Matrix4();
        const places = [0, 10, 20].map((x, i) => place.clone().makeTranslation(x, 0, 0).multiply(i === 1 ? turned : place));
        places.forEach((matrix, i) => mesh.setMatrixAt(i, matrix));
        mesh.position.set(0, 0, 7);
        await exported("instances.glb", mesh);
        const one = new THREE.Mesh(mesh.geometry);
        assertSame(read("instances.glb"), places.map((matrix) => {
            one.matrixWorld.multiplyMatrices(mesh.matrixWorld, matrix);
            return placed(one);
        }));
    });

    test("morph targets with weights", async () => {
        const geometry = box(), base = geometry.attributes.position;
        geometry.morphAttributes.position = [0, 1].map((axis) => {
            const moved = base.clone();
            for (let i = 0; i < base.count; ++i) moved.setComponent(i, axis, 3 * base.getComponent(i, axis));
            return moved;
        });
        const mesh = new THREE.Mesh(geometry, matter());
        mesh.updateMorphTargets();
        mesh.morphTargetInfluences[0] = 0.5;
        mesh.morphTargetInfluences[1] = 0.125;
        mesh.applyMatrix4(turned);
        await exported("morph.glb", mesh);
        assertSame(read("morph.glb"), [placed(mesh)]);
    });

    test("16-bit positions (KHR_mesh_quantization)", async () => {
        const geometry = box(), source = geometry.attributes.position.array;
        geometry.setAttribute("position", new THREE.BufferAttribute(Int16Array.from(source, (x) => 1000 * x), 3));
        const mesh = new THREE.Mesh(geometry, matter());
        mesh.applyMatrix4(new THREE.Matrix4().makeScale(0.001, 0.001, 0.001).premultiply(turned));
        await exported("quantized.glb", mesh);
        assertSame(read("quantized.glb"), [placed(mesh)]);
    });

    test("two boxes that touch are two bodies, and colours are those of sRGB", async () => {
        const color = new THREE.Color(0x8040ff), geometry = box();
        geometry.setAttribute("color", new THREE.BufferAttribute(Float32Array.from({ length: 72 }, (_, i) => color.toArray()[i % 3]), 3));
        const left = new THREE.Mesh(geometry, matter()), right = new THREE.Mesh(geometry, matter());
        right.position.x = 1;
        await exported("touching.glb", left, right);
        assertSame(read("touching.glb"), [placed(left), placed(right)]);
        meshfolio("noise", "touching.glb", "--sigma", "0", "-o", "touching.ply");
        const bytes = readFileSync(path.join(folder, "touching.ply")), head = bytes.subarray(0, bytes.indexOf("end_header\n") + 11);
        assert.match(head.toString(), /element vertex 16\n[^]*property uchar red\n/);
        for (let v = 0; v < 16; ++v) assert.deepEqual([...bytes.subarray(head.length + 27 * v + 24, head.length + 27 * v + 27)], [0x80, 0x40, 0xff]);
    });
});

describe("what we write", () => {
    const square = (x, y) => `v ${x} ${y} 5\nv ${x + 1} ${y} 5\nv ${x} ${y + 1} 5.25\n`;
    const files = {
        near: square(0, 0) + "f 1 2 3\n",
        far: square(399999.7742688879, 5700001.550650809) + "f 1 2 3\n",
        touching: square(0.1, 0) + square(1.1, 0) + "f 1 2 3\nf 4 5 6\n",
        coloured: square(0, 0).replace(/\n/g, " 0.5 0.25 1\n") + "f 1 2 3\n",
    };
    for (const [name, text] of Object.entries(files)) {
        test(name, async () => {
            writeFileSync(path.join(folder, `${name}.obj`), text);
            meshfolio("noise", `${name}.obj`, "--sigma", "0", "-o", `${name}.out.glb`);
            const bytes = new Uint8Array(readFileSync(path.join(folder, `${name}.out.glb`)));
            const { issues } = await validator.validateBytes(bytes);
            assert.equal(issues.numErrors + issues.numWarnings, 0, JSON.stringify(issues.messages));
            const { scene } = await new GLTFLoader().parseAsync(bytes.buffer, "");
            scene.updateMatrixWorld(true);
            const found = [];
            scene.traverse((object) => { if (object.isMesh) for (const i of object.geometry.index.array) found.push(placed(object)[i]); });
            const expected = text.match(/^v .*/gm).map((line) => line.split(" ").slice(1, 4).map(Number));
            assert.equal(found.length, expected.length);
            found.forEach((point, i) => point.forEach((x, k) => assert.ok(Math.abs(x - expected[i][k]) < 3e-7, `${x} ${expected[i][k]}`)));
            const color = scene.getObjectByProperty("isMesh", true).geometry.attributes.color;
            if (name === "coloured") assert.equal(new THREE.Color(color.getX(0), color.getY(0), color.getZ(0)).getHexString(), "8040ff");
        });
    }
});
