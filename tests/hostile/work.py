#!/usr/bin/env python3
"""Families of small meshes that cost much work. Every command ends a mesh below 100 kB within 20 s and 2 GB, or refuses it by a limit that
RELIABILITY.md lists.

    MESHFOLIO=build/release/meshfolio tests/hostile/work.py [--whole] [-v] [FAMILY…]

By default each family is small, and a command has 4 s of processor time. --whole: families as large as 100 kB permit, 20 s of wall-clock time."""

import gzip
import json
import math
import os
import struct
import subprocess
import sys
import time
import unittest
from pathlib import Path

from judge import PROGRAM, limits  # noqa: F401: judge puts the path of folders there
from folders import temporary_folder

WHOLE = "--whole" in sys.argv
LARGEST_FILE = 100_000
SECONDS = 20 if WHOLE else 4
CODES = {0, 1, 3}  # 1: a check failed, or a section cannot be answered; 3: refused by a limit


def obj(points, faces):
    lines = ["v %.9g %.9g %.9g" % tuple(p) for p in points] + ["f " + " ".join(str(v + 1) for v in f) for f in faces]
    return ("\n".join(lines) + "\n").encode()


def ring(n, height=0.0, radius=1.0):
    return [(radius * math.cos(2 * math.pi * i / n), radius * math.sin(2 * math.pi * i / n), height) for i in range(n)]


def cone(n):
    return obj([(0, 0, 0.3)] + ring(n), [(0, i + 1, (i + 1) % n + 1) for i in range(n)])


def bipyramid(n):
    return obj([(0, 0, 1), (0, 0, -1)] + ring(n), [f for i in range(n) for f in ((0, i + 2, (i + 1) % n + 2), (1, (i + 1) % n + 2, i + 2))])


def capped_cylinder(n):
    sides = [f for i in range(n) for f in ((i, (i + 1) % n, n + i), ((i + 1) % n, n + (i + 1) % n, n + i))]
    caps = [f for i in range(n) for f in ((2 * n, (i + 1) % n, i), (2 * n + 1, n + i, n + (i + 1) % n))]
    return obj(ring(n) + ring(n, 2) + [(0, 0, 0), (0, 0, 2)], sides + caps)


def strip(n):
    return obj([(i, j, 0) for i in range(n + 1) for j in (0, 1)], [f for i in range(n) for f in ((2 * i, 2 * i + 2, 2 * i + 3), (2 * i, 2 * i + 3, 2 * i + 1))])


def equal_triangles(n):
    return gzip.compress(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n" * n, 4, mtime=0)


def nearly_equal_triangles(n):
    """Returns large triangles on nearly equal planes, each visible somewhere."""
    points, faces = [], []
    for i in range(n):
        turn = 2 * math.pi * i / n
        points += [(0, 0, 0.01 * i / n), (1, 0.01 * math.sin(turn), 0.01 * math.cos(7 * turn)), (0.01 * math.cos(turn), 1, 0.01 * math.sin(5 * turn))]
        faces.append((3 * i, 3 * i + 1, 3 * i + 2))
    return obj(points, faces)


def on_one_edge(n):
    return obj([(0, 0, 0), (0, 0, 1)] + ring(n), [(0, 1, i + 2) for i in range(n)])


def shells(n):
    """Returns nested tetrahedra."""
    corners = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    faces = [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]
    return obj([[(1 + i) * x for x in p] for i in range(n) for p in corners], [[4 * i + v for v in f] for i in range(n) for f in faces])


def comb(n):
    """Returns equal cubes side by side, so one spectrum repeats."""
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return obj([(2 * i + x, y, z) for i in range(n) for x, y, z in corners], [[8 * i + v for v in q] for i in range(n) for q in quads])


def needles(n):
    return obj([(i, j * 1e-12 * (i % 7), 0) for i in range(n + 1) for j in (0, 1)],
               [f for i in range(n) for f in ((2 * i, 2 * i + 2, 2 * i + 3), (2 * i, 2 * i + 3, 2 * i + 1))])


def one_point(n):
    """Returns triangles with coincident corners except for one."""
    return obj([(0, 0, 0)] * (2 * n) + [(1, 0, 0), (0, 1, 0)], [(2 * i, 2 * i + 1, 2 * n + i % 2) for i in range(n)])


def polygon(n):
    """Returns a non-convex star polygon with n corners."""
    return obj([(r * math.cos(math.pi * i / n), r * math.sin(math.pi * i / n), 0) for i in range(2 * n) for r in [1 if i % 2 else 0.1]], [range(2 * n)])


def sizes(n):
    """Returns triangles of every accepted size."""
    return obj([(s * x, s * y, s) for i in range(n) for s in [10.0 ** (i % 199 - 99)] for x, y in ((0, 0), (1, 0), (0, 1))],
               [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(n)])


def instances(n):
    """Returns a GLB in which n nodes place a tetrahedron on a sphere, so that all parts have the same distance from the centre."""
    corners = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    faces = [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]
    data = b"".join(struct.pack("<3f", *p) for p in corners) + b"".join(struct.pack("<3H", *f) for f in faces)
    nodes = []
    for i in range(n):
        z, turn = 1 - (2 * i + 1) / n, 2.399963 * i
        nodes.append({"mesh": 0, "translation": [10 * math.sqrt(1 - z * z) * math.cos(turn), 10 * math.sqrt(1 - z * z) * math.sin(turn), 10 * z]})
    for node in nodes:
        node["translation"] = [round(x, 3) for x in node["translation"]]
    text = json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(n))}], "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1] * 3, "max": [1] * 3},
                      {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
        "buffers": [{"byteLength": len(data)}]}, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    return (b"glTF" + struct.pack("<2I", 2, 12 + 8 + len(text) + 8 + len(data)) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(data), b"BIN\0") + data)


def empty_arrays(n):
    arrays = '<DataArray type="Float64" NumberOfComponents="1000" format="ascii"></DataArray>\n' * n
    return ('<VTKFile type="PolyData" version="1.0"><PolyData><Piece NumberOfPoints="3" NumberOfPolys="1"><Points><DataArray type="Float64" '
            'NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points><PointData>' + arrays + '</PointData><Polys><DataArray '
            'type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray><DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>'
            '</Polys></Piece></PolyData></VTKFile>').encode()


def groups(n):
    return b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" + b"".join(b"g g%d\nusemtl m%d\nf 1 2 %d\n" % (i, i, 3 + i % 2) for i in range(n))


def properties(n):
    """Returns a PLY with n values per vertex."""
    header = ["ply", "format ascii 1.0", "element vertex 3"] + [f"property double {x}" for x in "xyz"] + [f"property float p{i}" for i in range(n)]
    header += ["element face 1", "property list uchar int vertex_indices", "end_header"]
    rows = [p + " 0" * n for p in ("0 0 0", "1 0 0", "0 1 0")]
    return ("\n".join(header + rows + ["3 0 1 2"]) + "\n").encode()


# family: its function, the ending, its size by default and in 100 kB
FAMILIES = {
    "cone": (cone, "obj", 60, 1900), "bipyramid": (bipyramid, "obj", 60, 1300), "capped_cylinder": (capped_cylinder, "obj", 40, 700),
    "strip": (strip, "obj", 60, 1800), "equal_triangles": (equal_triangles, "obj.gz", 400, 700_000),
    "nearly_equal_triangles": (nearly_equal_triangles, "obj", 60, 800), "on_one_edge": (on_one_edge, "obj", 60, 2200), "shells": (shells, "obj", 12, 800),
    "comb": (comb, "obj", 12, 260), "needles": (needles, "obj", 40, 1500), "one_point": (one_point, "obj", 40, 2500), "polygon": (polygon, "obj", 100, 1400),
    "sizes": (sizes, "obj", 60, 900), "instances": (instances, "glb", 30, 1600), "empty_arrays": (empty_arrays, "vtp", 20, 1100),
    "groups": (groups, "obj", 100, 3500), "properties": (properties, "ply", 100, 3500),
}


def commands(mesh):
    yield ["inspect", mesh, "--json"]
    yield ["curvature", mesh, "--jets", "--csv", "c.csv"]
    yield ["spectrum", mesh, "-k", "5"]
    yield ["spectrum", mesh, "-k", "5", "--operator", "uniform"]
    if WHOLE:
        yield ["spectrum", mesh, "-k", "50"]
    yield ["smooth", mesh, "-o", "explicit.ply", "--iterations", "3"]
    yield ["smooth", mesh, "-o", "implicit.ply", "--scheme", "implicit", "--rebuild", "--iterations", "3"]
    yield ["noise", mesh, "-o", "noisy.ply", "--sigma", "0.01", "--unit", "bbox"]
    yield ["compare", mesh, mesh, "--json"]
    yield ["compare", mesh, "noisy.ply", "--surfaces", "--json"]
    yield ["render", mesh, "--out", "views"] + ([] if WHOLE else ["--size", "64"])
    yield ["lab", mesh, "-o", "lab.html"]
    yield ["report", mesh, "--quick", "--pdf", "off", "--out", "out"] + ([] if WHOLE else ["--only", "q1", "--size", "32"])
    if WHOLE:
        yield ["batch", mesh, "--out", "batch"]


class Work(unittest.TestCase):
    def run_all(self, family):
        make, ending, few, many = FAMILIES[family]
        folder = temporary_folder(self)
        content = make(many if WHOLE else few)
        self.assertLessEqual(len(content), LARGEST_FILE)
        (folder / f"m.{ending}").write_bytes(content)
        for words in commands(f"m.{ending}"):
            if "noisy.ply" in words and words[0] == "compare" and not (folder / "noisy.ply").exists():
                continue  # the mesh is refused
            with self.subTest(" ".join(words)):
                self.judge(folder, words)

    def judge(self, folder: Path, words):
        variables = {"PATH": os.environ["PATH"], "MESHFOLIO_PDF": "off", "XDG_CACHE_HOME": str(folder / "cache")}
        began = time.monotonic()
        process = subprocess.run([PROGRAM, *words], cwd=folder, env=variables, capture_output=True, stdin=subprocess.DEVNULL, timeout=100,
                                 preexec_fn=limits(False, seconds=2 * SECONDS if WHOLE else SECONDS))
        seconds = time.monotonic() - began
        told = f"{words} ended with {process.returncode} after {seconds:.1f} s: {process.stderr.decode()[-600:]}"
        self.assertIn(process.returncode, CODES, told)
        self.assertNotIn("out of memory", told)
        if WHOLE:
            self.assertLess(seconds, SECONDS, told)
            print(f"{seconds:6.1f} s, exit {process.returncode}: {' '.join(words)}", flush=True)


def add_tests():
    for family in FAMILIES:
        setattr(Work, f"test_{family}", lambda self, family=family: self.run_all(family))


add_tests()

if __name__ == "__main__":
    chosen = [f"Work.test_{word}" for word in sys.argv[1:] if not word.startswith("-")]
    sys.argv = sys.argv[:1] + [word for word in sys.argv[1:] if word.startswith("-") and word != "--whole"] + chosen
    unittest.main()
