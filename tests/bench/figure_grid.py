#!/usr/bin/env python3
"""Times one figure of twelve pictures against twelve figures of one picture, as PDF: medians of alternating runs, and their ratio.

    figure_grid.py [MESH …] [--meshfolio PROGRAM] [--runs 5]

Each of three meshes is drawn with four fields. Resolution and size of a picture are the same in both."""

import argparse
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FIELDS = ["h-cotan", "gauss", "area", "y"]
PICTURE = 40   # mm


def seconds(commands):
    began = time.perf_counter()
    for command in commands:
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - began


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", default=[str(ROOT / "data" / name) for name in ("creature.obj", "torus.obj", "fandisk_noisy.obj")])
    parser.add_argument("--meshfolio", default=str(ROOT / "build" / "release" / "meshfolio"))
    parser.add_argument("--runs", type=int, default=5)
    options = parser.parse_args()
    render = [options.meshfolio, "render"]
    with tempfile.TemporaryDirectory() as folder:
        grid = [[*render, *options.meshes, "--field", ",".join(FIELDS), "--width-mm", str(PICTURE * len(options.meshes)), "-o", f"{folder}/grid.pdf"]]
        singles = [[*render, mesh, "--field", field, "--width-mm", str(PICTURE), "-o", f"{folder}/{i}.pdf"]
                   for i, (mesh, field) in enumerate((mesh, field) for mesh in options.meshes for field in FIELDS)]
        times = [(seconds(grid), seconds(singles)) for _ in range(options.runs)]
    one, many = (statistics.median(column) for column in zip(*times))
    print(f"one figure {one:.3f} s, {len(singles)} figures {many:.3f} s, ratio {one / many:.2f}")


if __name__ == "__main__":
    main()
