#!/usr/bin/env python3
"""Counts spectra that are proved complete: runs `spectrum` on meshes and their midpoint subdivisions; prints a Markdown table and the share.

    certificates.py MESH... [--samples] [--k 30 60 150] [--most 350000] [--program MESHFOLIO]

MESH: OBJ or OFF of triangles. --samples adds the bundled shapes. --most: most triangles of a subdivided mesh.
Prints for each: the verdict, sigma, the numbers counted and found, the rounding of the count, and the gap, which must exceed it.
"""
import argparse
import re
import subprocess
import tempfile
from pathlib import Path

PROGRAM = Path(__file__).resolve().parent.parent.parent / "build" / "release" / "meshfolio"
TOLD = re.compile(r"none missing below (\S+): (proved|REFUTED|empty|cannot be proved here) \((\S+) counted by inertia, (\d+) found.*"
                  r"rounding (\S+), gap (\S+)\)")


def read(path):
    """Returns positions as text and triangles as corners from 0. Cuts polygons into fans."""
    words = [line.split() for line in path.read_text().splitlines() if line.strip() and not line.startswith("#")]
    if path.suffix == ".off":
        n, m = (int(count) for count in words[1][:2])
        points = [[float(x) for x in row[:3]] for row in words[2:2 + n]]
        faces = [[int(i) for i in row[1:1 + int(row[0])]] for row in words[2 + n:2 + n + m]]
    else:
        points = [[float(x) for x in row[1:4]] for row in words if row[0] == "v"]
        faces = [[int(corner.split("/")[0]) - 1 for corner in row[1:]] for row in words if row[0] == "f"]
    return points, [(f[0], f[i], f[i + 1]) for f in faces for i in range(1, len(f) - 1)]


def subdivided(points, triangles):
    points, middle = list(points), {}

    def between(a, b):
        key = (min(a, b), max(a, b))
        if key not in middle:
            middle[key] = len(points)
            points.append([0.5 * (points[a][c] + points[b][c]) for c in range(3)])
        return middle[key]

    smaller = []
    for a, b, c in triangles:
        ab, bc, ca = between(a, b), between(b, c), between(c, a)
        smaller += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return points, smaller


def certificate(program, file, k):
    run = subprocess.run([program, "spectrum", file, "-k", str(k), "--csv", "/dev/null"], capture_output=True, text=True)
    told = TOLD.search(run.stderr)
    word = told.group(2) if told else "no certificate"
    return word, list(told.groups()) if told else [run.stderr.strip().splitlines()[-1]], "FAILED" in run.stderr


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", type=Path)
    parser.add_argument("--samples", action="store_true")
    parser.add_argument("--k", nargs="+", type=int, default=[30, 60, 150])
    parser.add_argument("--most", type=int, default=350_000)
    parser.add_argument("--program", default=str(PROGRAM))
    arguments = parser.parse_args()
    proved = asked = 0
    print("| mesh | triangles | k | none missing | σ | counted | found | δ | gap |\n|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        meshes = list(arguments.meshes)
        if arguments.samples:
            listed = subprocess.run([arguments.program, "sample", "--list"], capture_output=True, text=True, check=True).stdout
            for name in (line.split()[0] for line in listed.splitlines() if line.strip()):
                meshes.append(Path(folder) / f"{name}.obj")
                subprocess.run([arguments.program, "sample", name, "-o", meshes[-1]], check=True, capture_output=True)
        for mesh in meshes:
            points, triangles = read(mesh)
            while len(triangles) <= arguments.most:
                file = Path(folder) / "divided.obj"
                file.write_text("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points) +
                                "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles))
                for k in arguments.k:
                    if k > len(points):
                        continue
                    word, row, failed = certificate(arguments.program, file, k)
                    asked += 1
                    proved += word == "proved"
                    cells = [row[0], row[2], row[3], row[4], row[5]] if len(row) > 1 else row
                    print("|", " | ".join([mesh.stem, str(len(triangles)), str(k), word + (", FAILED" if failed else ""), *cells]), "|", flush=True)
                points, triangles = subdivided(points, triangles)
    print(f"\nproved: {proved} of {asked}, {100 * proved / max(1, asked):.1f} %")


if __name__ == "__main__":
    main()
