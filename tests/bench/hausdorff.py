#!/usr/bin/python3
"""Compares the Hausdorff distance of `meshfolio compare`, an older meshfolio and CGAL on the same meshes in one run; prints a Markdown table.

    hausdorff.py [--levels 0 1 2] [--repeat 3] [--meshfolio PROGRAM] [--old PROGRAM] [--peer PROGRAM]

The creature, subdivided --levels times, is compared with a noisy, a smoothed and a coarser copy. Times are medians of whole processes with
reading, CGAL's without reading. CGAL's error bound is 1e-3 of the distance that ours found. Missing programs are left out.
"""
import argparse
import json
import os
import subprocess
import tempfile
import time
from pathlib import Path
from statistics import median

BUILD = Path(__file__).resolve().parent.parent.parent / "build" / "release"


def run(*words):
    start = time.monotonic()
    done = subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True)
    return time.monotonic() - start, done.stdout


def pairs(program, folder, level):
    """Returns [(name, a, b)] of a level."""
    creature, coarse, noisy, smooth = (f"{folder}/{name}{level}.ply" for name in ("creature", "coarse", "noisy", "smooth"))
    run(program, "sample", "creature", "--subdivide", level, "-o", creature)
    run(program, "sample", "creature", "--subdivide", max(level - 1, 0), "-o", coarse)
    run(program, "noise", creature, "--sigma", "0.001", "--unit", "bbox", "-o", noisy)
    run(program, "smooth", creature, "--scheme", "implicit", "--lambda", "1", "--unit", "h2", "-o", smooth)
    return [("noise", creature, noisy), ("smoothing", creature, smooth)] + ([("coarser", creature, coarse)] if level > 0 else [])


def measured(options, a, b):
    """Returns a dict of medians, and the distances found."""
    seconds, found = {}, {}

    def note(name, words):
        spent, printed = run(*words)
        if name == "CGAL":
            low, high, spent = map(float, printed.split())
            found[name] = (low, high)
        else:
            facts = json.loads(printed)
            found[name] = (facts["hausdorff"], facts.get("hausdorff_bound", facts["hausdorff"]))
        seconds.setdefault(name, []).append(spent)

    for _ in range(options.repeat):
        note("ours", [options.meshfolio, "compare", a, b, "--json", "--surfaces"])
        note("by vertices", [options.meshfolio, "compare", a, b, "--json"])
        if options.old:
            note("old", [options.old, "compare", a, b, "--json", "--surfaces"])
        if options.peer.exists():
            note("CGAL", [options.peer, a, b, 1e-3 * found["ours"][0]])
    return {name: median(values) for name, values in seconds.items()}, found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--levels", type=int, nargs="+", default=[0, 1, 2])
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--meshfolio", default=str(BUILD / "meshfolio"))
    parser.add_argument("--old")
    parser.add_argument("--peer", type=Path, default=BUILD / "tests" / "bench" / "hausdorff_peer")
    options = parser.parse_args()
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:2])
    names = ["ours", "by vertices", "old", "CGAL"]
    print("| level | pair | " + " | ".join(f"{name}, s" for name in names) + " | old : ours | CGAL : ours | found |\n|" + "---|" * (len(names) + 5))
    with tempfile.TemporaryDirectory() as folder:
        for level in options.levels:
            for what, a, b in pairs(options.meshfolio, folder, level):
                seconds, found = measured(options, a, b)
                cells = [f"{seconds[name]:.2f}" if name in seconds else "–" for name in names]
                cells += [f"{seconds[name] / seconds['ours']:.2f}" if name in seconds else "–" for name in ("old", "CGAL")]
                ranges = "; ".join(f"{name} {low:.6g}…{high:.6g}" for name, (low, high) in found.items())
                print(f"| {level} | {what} | {' | '.join(cells)} | {ranges} |", flush=True)


if __name__ == "__main__":
    main()
