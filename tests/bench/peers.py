#!/usr/bin/python3
"""Times our renderer, VTK, f3d and Embree on the same meshes in one run; prints Markdown tables of times and ratios.

    peers.py MESH [--sizes -1 0 1 2 3] [--repeat 3] [--work FOLDER] [--meshfolio PROGRAM] [--bench PROGRAM]

MESH is subdivided 1-to-4 --sizes times, or decimated to a quarter for -1 (armadillo, 86 k triangles: 22 k, 86 k, 346 k, 1.4 M, 5.5 M).
The programs run in turns on two processors; figures are medians. A peer that is not installed is left out.
"""
import argparse
import contextlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

from six_views import PYTHON, VIEWS, display, f3d_command, ply_bounds, timed

HERE = Path(__file__).resolve().parent
BUILD = HERE.parent.parent / "build" / "release"

# triangles: minimum ratios to VTK's six renders, Embree with its hierarchy, the naive bound, and the process of VTK
GOALS = {86e3: (12, 12, None, 8), 1.4e6: (12, 9, None, 10), 5.5e6: (12, 5, 1, 10)}
GOAL_F3D = 25
GOAL_OCCLUSION = 1.5  # maximum ratio of the times with and without ambient occlusion


def goals_for(triangles):
    return next((goals for count, goals in GOALS.items() if 0.9 < triangles / count < 1.1), (None,) * 4)


def usable_peers():
    """Returns the installed ones of "vtk" and "f3d"; prints the missing ones."""
    has_vtk = subprocess.run([PYTHON, "-c", "import vtkmodules.vtkRenderingOpenGL2"], stderr=subprocess.DEVNULL).returncode == 0
    found = {"vtk": has_vtk, "f3d": shutil.which("f3d")} if shutil.which("Xvfb") else {}
    for name, package in {"vtk": "python3-vtk9 and xvfb", "f3d": "f3d and xvfb"}.items():
        if not found.get(name):
            print(f"{name} skipped: needs the packages {package}\n")
    return {name for name, there in found.items() if there}


def run_ours_in_memory(options, mesh, note):
    """Runs the benchmark program: our six views, the naive bound, Embree."""
    _, _, printed = timed([options.bench, "--benchmark_filter=/0/", "--benchmark_format=json"], MESHFOLIO_BENCH_MESH=mesh)
    for benchmark in json.loads(printed)["benchmarks"]:
        name = benchmark["name"].split("/")[0]
        note(name, benchmark["real_time"] / 1e3)
        if name == "draw_six_views":
            for counter in ("per_triangle", "per_pixel", "mesh_MB", "peak_MB"):
                note(counter, benchmark[counter])


def run_once(options, peers, mesh, bounds, folder, note):
    run_ours_in_memory(options, mesh, note)
    seconds, memory, _ = timed([options.meshfolio, "render", mesh, "--field", "y", "--out", folder])
    note("our process", seconds)
    note("our memory", memory)
    if "vtk" in peers:
        seconds, memory, printed = timed([PYTHON, str(HERE / "vtk_peer.py"), mesh, folder])
        note("vtk process", seconds)
        note("vtk memory", memory)
        for stage, value in json.loads(printed).items():
            note("vtk " + stage, value)
    if "f3d" in peers:
        for name, more in {"f3d": [], "f3d ssao": ["--ssao"]}.items():
            runs = [timed(f3d_command(mesh, bounds, view, folder + "/f3d.png", *more)) for view in VIEWS]
            note(name, sum(run[0] for run in runs))
            note("f3d memory", max(run[1] for run in runs))


def measured(options, peers, mesh, triangles):
    """Returns medians by name, of one size."""
    notes = {}
    bounds = ply_bounds(mesh)
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.repeat):
            run_once(options, peers, mesh, bounds, folder, lambda name, value: notes.setdefault(name, []).append(value))
    result = {name: median(values) for name, values in notes.items()} | {"triangles": triangles}
    embree = [result[name] for name in ("embree_low", "embree_medium") if name in result]
    return result | ({"embree": min(embree)} if embree else {})


def milliseconds(row, name):
    return f"{1e3 * row[name]:.0f}" if name in row else "–"


def ratio(row, peer, ours, goal):
    """Returns the speed-up over the peer, with the goal, and a star if it is reached."""
    if peer not in row:
        return "–"
    factor = row[peer] / row[ours]
    return f"{factor:.1f}×" + ("" if goal is None else f" (≥ {goal}{' ★' if factor >= goal else ''})")


def occlusion_cost(row):
    factor = row["draw_six_views_occluded"] / row["draw_six_views"]
    return f"{milliseconds(row, 'draw_six_views_occluded')} = {factor:.2f}× (≤ {GOAL_OCCLUSION}{' ★' if factor <= GOAL_OCCLUSION else ''})"


def print_table(heading, columns, rows):
    print(f"\n{heading}\n\n| triangles | {' | '.join(columns)} |\n|{'---:|' * (len(columns) + 1)}")
    for row, cells in rows:
        print(f"| {row['triangles']} | {' | '.join(cells)} |")


def print_report(rows):
    print_table("Six views in memory, ms; how many times faster ours is (goal, ★ reached)",
                ["ours", "with occlusion (goal)", "VTK 6 renders", "Embree 2×2 best", "naive bound", "VTK : ours", "Embree : ours",
                 "bound : ours"],
                [(row, [milliseconds(row, "draw_six_views"), occlusion_cost(row)]
                  + [milliseconds(row, name) for name in ("vtk 6 renders", "embree", "naive_bound")]
                  + [ratio(row, peer, "draw_six_views", goal)
                     for peer, goal in zip(("vtk 6 renders", "embree", "naive_bound"), goals_for(row["triangles"]))])
                 for row in rows])
    print_table("Whole processes, PLY in, six PNG out (ours also the sheet), ms",
                ["ours", "VTK", "6 × f3d", "6 × f3d --ssao", "VTK : ours", "f3d : ours", "f3d --ssao : ours"],
                [(row, [milliseconds(row, name) for name in ("our process", "vtk process", "f3d", "f3d ssao")]
                  + [ratio(row, "vtk process", "our process", goals_for(row["triangles"])[3]), ratio(row, "f3d", "our process", GOAL_F3D),
                     ratio(row, "f3d ssao", "our process", GOAL_F3D)]) for row in rows])
    print_table("Ours in memory: growth and memory; peak of the whole processes",
                ["ms", "ns/triangle", "ns/pixel", "process, ns/triangle", "mesh MB", "drawing adds MB", "our process MiB", "VTK MiB", "f3d MiB"],
                [(row, [milliseconds(row, "draw_six_views"), f"{1e9 * row['per_triangle']:.1f}", f"{1e9 * row['per_pixel']:.2f}",
                        f"{1e9 * row['our process'] / row['triangles']:.0f}"]
                  + [f"{row[name]:.0f}" if name in row else "–"
                     for name in ("mesh_MB", "peak_MB", "our memory", "vtk memory", "f3d memory")]) for row in rows])
    stages = ["import", "load", "normals", "first frame", "6 renders", "read-back", "png"]
    if any("vtk total" in row for row in rows):
        print_table("VTK by stage, ms", stages, [(row, [milliseconds(row, "vtk " + stage) for stage in stages]) for row in rows])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("--sizes", type=int, nargs="+", default=[-1, 0, 1, 2, 3], metavar="N", help="how often the mesh is subdivided; -1: decimated to a quarter")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--work", help="keeps the meshes here")
    parser.add_argument("--meshfolio", default=str(BUILD / "meshfolio"))
    parser.add_argument("--bench", default=str(BUILD / "tests" / "bench" / "render_bench"))
    options = parser.parse_args()
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:2])

    peers = usable_peers()
    with tempfile.TemporaryDirectory() as temporary, display() if peers else contextlib.nullcontext():
        folder = options.work or temporary
        os.makedirs(folder, exist_ok=True)
        sizes = [str(size) for size in sorted(options.sizes)]
        _, _, counts = timed([str(Path(options.bench).with_name("make_meshes")), options.mesh, folder, *sizes])
        rows = []
        for size, count in zip(sizes, counts.split()):
            print(f"{count} triangles …", file=sys.stderr)
            rows.append(measured(options, peers, f"{folder}/{size}.ply", int(count)))
        print_report(rows)


if __name__ == "__main__":
    main()
