"""Models that readers can turn: `render --glb`, and the models of a report in its page and beside it, read by independent readers."""

import base64
import csv
import hashlib
import html.parser
import re
import struct
import unittest
import zlib

from glb_file import Glb
from program import run, sample, temporary_folder


def curvature(path, column):
    with open(path, newline="") as file:
        return [float(row[column]) if row[column] else None for row in csv.DictReader(file)]


def as_float32(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def linear(channel):
    c = channel / 255
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4


class RenderGlb(unittest.TestCase):
    def glb(self, name, *options):
        folder = temporary_folder(self)
        mesh = sample(folder, name)
        file = folder / "model.glb"
        process = run("render", mesh, "--size", 32, "--out", folder / "views", "--glb", file, *options)
        self.assertEqual(process.returncode, 0, process.stderr)
        run("curvature", mesh, "--csv", folder / "table.csv")
        return Glb(file.read_bytes()), folder

    def test_vertices_values_and_normals_are_those_of_the_mesh(self):
        glb, folder = self.glb("lily", "--field", "h-cotan", "--range", "-10,10")
        rows = list(csv.DictReader(open(folder / "table.csv", newline="")))
        values = curvature(folder / "table.csv", "h_cotan")
        self.assertIn(None, values, "the lily has a boundary")
        step = glb.json["nodes"][0]["scale"][0]
        for row, at in zip(rows, glb.positions(), strict=True):
            for axis, x in zip("xyz", at):
                self.assertAlmostEqual(float(row[axis]), x, delta=0.51 * step)
        for v, (value, (stored,), (defined,)) in enumerate(
            zip(values, glb.attributes["_VALUE"], glb.attributes["_DEFINED"], strict=True)
        ):
            self.assertEqual(defined, 0 if value is None else 1, v)
            expected = 0 if value is None else as_float32(value)
            self.assertAlmostEqual(stored, expected, delta=1e-6 * abs(expected), msg=v)
        for n in glb.attributes["NORMAL"]:
            self.assertAlmostEqual(sum(c * c for c in n) ** 0.5, 1, delta=0.0068)

    def test_triangles_run_as_in_the_file_and_normals_point_with_them(self):
        glb, folder = self.glb("sphere", "--field", "z")
        faces = [[int(word) - 1 for word in line.split()[1:]] for line in open(folder / "sphere.obj") if line.startswith("f ")]
        self.assertEqual(glb.indices, [v for face in faces for v in face])
        for at, n in zip(glb.positions(), glb.attributes["NORMAL"]):
            self.assertGreater(sum(a * b for a, b in zip(at, n)), 0, "outwards on a sphere around the origin")

    def test_colours_at_and_beyond_the_ends_are_those_of_the_map(self):
        glb, _ = self.glb("sphere", "--field", "z", "--range", "-0.5,0.5")
        ends = [[linear(int(color[k : k + 2], 16)) for k in (1, 3, 5)] for color in ("#440154", "#fde725")]
        seen = set()
        for (value,), color in zip(glb.attributes["_VALUE"], glb.attributes["COLOR_0"]):
            if abs(value) >= 0.5:
                seen.add(value > 0)
                for c, expected in zip(color, ends[value > 0]):
                    self.assertAlmostEqual(c, expected, delta=1e-4)
        self.assertEqual(seen, {False, True})
        self.assertEqual(glb.extras["value"]["range"], [-0.5, 0.5])

    def test_undefined_vertices_have_the_colour_for_it(self):
        glb, _ = self.glb("lily", "--field", "h-cotan")
        color = glb.extras["value"]["undefined_color"]
        expected = [linear(int(color[k : k + 2], 16)) for k in (1, 3, 5)]
        for (defined,), seen in zip(glb.attributes["_DEFINED"], glb.attributes["COLOR_0"]):
            if not defined:
                self.assertLess(max(abs(a - b) for a, b in zip(seen, expected)), 1e-4)

    def test_a_plain_surface_has_no_values_and_bytes_are_the_same_again(self):
        folder = temporary_folder(self)
        mesh = sample(folder, "torus")
        for name in ("a.glb", "b.glb"):
            run("render", mesh, "--size", 32, "--out", folder, "--glb", folder / name)
        self.assertEqual((folder / "a.glb").read_bytes(), (folder / "b.glb").read_bytes())
        self.assertEqual(set(Glb((folder / "a.glb").read_bytes()).attributes), {"POSITION", "NORMAL"})


def points_of(obj):
    return [[float(word) for word in line.split()[1:4]] for line in obj.splitlines() if line.startswith("v ")]


def shifted(obj, shift):
    points = iter(points_of(obj))
    lines = (line if not line.startswith("v ") else "v " + " ".join(repr(x + d) for x, d in zip(next(points), shift)) for line in obj.splitlines())
    return "\n".join(lines) + "\n"


class MeshesAsGlb(unittest.TestCase):
    """GLB files of commands, read by an independent reader."""

    def written(self, text, name="mesh.obj"):
        folder = temporary_folder(self)
        (folder / name).write_text(text)
        process = run("noise", folder / name, "--sigma", 0, "-o", folder / "out.glb")
        self.assertEqual(process.returncode, 0, process.stderr)
        return Glb((folder / "out.glb").read_bytes()), folder, process.stderr

    def test_far_from_the_origin_the_shape_is_kept(self):
        near = sample(temporary_folder(self), "torus").read_text()
        for offset in (1e5, 1e7):
            text = shifted(near, (offset, -offset, 0.1 * offset))
            glb, folder, said = self.written(text)
            self.assertEqual(said, "")
            for expected, found in zip(points_of(text), glb.positions(), strict=True):
                for a, b in zip(expected, found):
                    self.assertAlmostEqual(a, b, delta=1e-7 + 2e-16 * offset)
            for name in ("mesh.obj", "out.glb"):
                run("curvature", folder / name, "--csv", folder / f"{name}.csv")
            for a, b in zip(*(curvature(folder / f"{name}.csv", "h_cotan") for name in ("mesh.obj", "out.glb")), strict=True):
                self.assertAlmostEqual(a, b, delta=2e-5)

    def test_touching_bodies_are_separate_nodes_and_reported_for_stl(self):
        square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
        text = square + shifted(square, (1, 0, 0)) + "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n"
        glb, folder, said = self.written(text)
        self.assertEqual(said, "")
        points = points_of(text)
        self.assertEqual(glb.bodies(), [[points[i] for i in body] for body in ([0, 1, 2, 0, 2, 3], [4, 5, 6, 4, 6, 7])])
        self.assertIn("comps=2", run("inspect", folder / "out.glb").stdout)
        told = run("noise", folder / "mesh.obj", "--sigma", 0, "-o", folder / "out.stl").stderr
        self.assertIn("2 of 8 vertices lie where others do", told)
        self.assertIn("comps=1", run("inspect", folder / "out.stl").stdout)

    def test_colours_are_linear_light(self):
        ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
        ply += "property uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        glb, folder, said = self.written(ply + "0 0 0 128 64 255\n1 0 0 0 1 2\n0 1 0 3 254 12\n3 0 1 2\n", "grey.ply")
        self.assertEqual(said, "")
        channels = [[128, 64, 255], [0, 1, 2], [3, 254, 12]]
        for row, stored in zip(channels, glb.attributes["COLOR_0"], strict=True):
            for channel, x in zip(row, stored):
                self.assertAlmostEqual(x, linear(channel), delta=1e-5)
        run("noise", folder / "out.glb", "--sigma", 0, "-o", folder / "back.ply")
        body = (folder / "back.ply").read_bytes().split(b"end_header\n", 1)[1]
        self.assertEqual([list(body[27 * v + 24 : 27 * v + 27]) for v in range(3)], channels)


class Scripts(html.parser.HTMLParser):
    """Collects the scripts of a page as [(attributes, content)], and its policy."""

    def __init__(self, text):
        super().__init__()
        self.scripts, self.policy = [], ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag == "script":
            self.scripts.append([dict(attributes), ""])
        elif tag == "meta" and ("http-equiv", "Content-Security-Policy") in attributes:
            self.policy = dict(attributes)["content"]

    def handle_data(self, data):
        if self.scripts and self.cdata_elem == "script":
            self.scripts[-1][1] += data

    def of_type(self, kind):
        return [(attributes, content) for attributes, content in self.scripts if attributes.get("type") == kind]


def unpacked(text):
    return zlib.decompress(base64.b64decode(text, validate=True))


class ReportModels(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = temporary_folder(cls)
        process = run("report", "--quick", "--only", "q1,q2", "--size", 64, "--out", folder / "out", "--no-timings")
        assert process.returncode == 0, process.stderr
        cls.out = folder / "out"
        cls.page = (cls.out / "index.html").read_text()
        cls.appendix = (cls.out / "appendix.html").read_text()
        cls.parsed = Scripts(cls.page)
        cls.viewer = cls.parsed.of_type("application/zlib")

    def test_models_lie_beside_the_page_and_are_linked(self):
        files = sorted(path.name for path in (self.out / "models").iterdir())
        self.assertTrue(files)
        self.assertEqual(files, sorted(set(re.findall(r'href="models/([^"]+\.glb)"', self.page + self.appendix))))
        units = {"h": "% of h̄", "k": "1/length²", "tangential": "%"}
        for file in files:
            glb = Glb((self.out / "models" / file).read_bytes())
            self.assertIn("_VALUE", glb.attributes)
            self.assertEqual(glb.extras["value"]["unit"], units[file.removesuffix(".glb").rsplit("_", 1)[-1]], file)

    def test_the_page_holds_the_same_models_or_no_viewer_at_all(self):
        """Normals and colours are not compared: the viewer computes them."""

        def content(glb):
            return glb.json, {name: rows for name, rows in glb.attributes.items() if name not in ("NORMAL", "COLOR_0")}, glb.indices_of(glb.mesh)

        for page in (self.page, self.appendix):
            inside = [unpacked(text) for _, text in Scripts(page).of_type("model/gltf-binary")]
            linked = set(re.findall(r'href="models/([^"]+\.glb)"', page))
            beside = [content(Glb((self.out / "models" / name).read_bytes())) for name in linked]
            self.assertCountEqual([content(Glb(model)) for model in inside], beside if "viewer-program" in page else [])
            self.assertLessEqual(sum(map(len, inside)), 2e6)
        self.assertEqual("viewer-program" in self.page, "model/gltf-binary" in self.page, "no viewer without a model")
        self.assertEqual("viewer-program" in self.appendix, "model/gltf-binary" in self.appendix, "no viewer without a model")

    def test_the_policy_lists_exactly_the_scripts_that_may_run(self):
        may_run = [content.encode() for attributes, content in self.parsed.scripts if "type" not in attributes]
        may_run += [unpacked(content) for _, content in self.viewer]
        hashes = {f"'sha256-{base64.b64encode(hashlib.sha256(script).digest()).decode()}'" for script in may_run}
        listed = re.search(r"script-src ([^;]*);", self.parsed.policy)[1].split()
        self.assertEqual(set(listed), hashes)
        for script in may_run:
            self.assertNotRegex(script.decode(), r"\beval\(|new Function\(")

    def test_a_page_without_models_has_no_viewer(self):
        out = temporary_folder(self) / "out"
        run("report", "--quick", "--only", "q2", "--size", 64, "--out", out)
        for name in ("index.html", "appendix.html"):
            page = (out / name).read_text()
            for trace in ("viewer-program", "meshfolioViewer", "model/gltf-binary", "model-stage"):
                self.assertNotIn(trace, page, name)


if __name__ == "__main__":
    unittest.main(verbosity=2)
