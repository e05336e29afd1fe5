#!/usr/bin/env python3
"""Measures what each section of a report costs and prints the `.cost` of its chapter.cpp.

    fit_costs.py [--program build/release/meshfolio] [--keep FILE.json] [--only q4,maps] [--check] MESH MESH MESH…

Answers each section alone, on one thread, with full and with small settings, on each mesh (of 2,000 to 30,000 vertices, three or more).
It measures processor seconds and peak memory of the process, less those of a report with one section that fails at once. It fits nonnegative
terms: a constant, one that grows with the vertices, and one with their power 3/2 (a sparse factor); errors are relative. FILE.json keeps
the measurements, which are not repeated. Only processor seconds count, so other work may run on the machine. --check fits nothing: it compares
the estimates of `report --plan` with the measured costs, to a factor of two and half a second.
"""
import argparse
import itertools
import json
import os
import subprocess
import tempfile
from pathlib import Path

LARGE = 1e5   # unit of the vertices: coefficients are CPU s and MB at this size


def measured(program, mesh, section, small, fails=False):
    """Returns (CPU s, peak MB) of one report with that section."""
    with tempfile.TemporaryDirectory() as folder:
        words = [program, "report", mesh, "--only", section, "--alone", "--threads", "1", "--no-cache", "--pdf", "off", "--out", f"{folder}/out"]
        if small:
            words.append("--quick")
        environment = {**os.environ, **({"MESHFOLIO_FAIL": section} if fails else {})}
        process = subprocess.Popen(words, env=environment, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        if os.waitstatus_to_exitcode(status) not in (0, 1):
            raise SystemExit(f"{words} ended with {status}")
        return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def check(options, sections):
    """Prints the estimates that are off and returns their number."""
    wrong = 0
    for mesh, section, small in itertools.product(options.meshes, sections, (False, True)):
        words = [options.program, "report", mesh, "--only", section, "--alone", "--plan", "--json", "--pdf", "off"] + ["--quick"] * small
        plan = json.loads(subprocess.run(words, capture_output=True, check=True).stdout)
        seconds, megabytes = measured(options.program, mesh, section, small)
        for what, told, took, slack in (("CPU s", plan["cpu_seconds"], seconds, 0.5), ("MB", plan["memory_bytes"] / 1e6, megabytes, 50)):
            good = took / 2 - slack <= told <= 2 * took + slack
            wrong += not good
            print(f"{'' if good else 'WRONG '}{section}{' --quick' if small else ''} on {Path(mesh).name}: planned {told:.3g} {what}, took {took:.3g}", flush=True)
    return wrong


def solved(A, b):
    """Solves a linear system by Gaussian elimination with pivoting."""
    rows = [[*row, value] for row, value in zip(A, b)]
    n = len(rows)
    for i in range(n):
        p = max(range(i, n), key=lambda r: abs(rows[r][i]))
        if abs(rows[p][i]) < 1e-14:
            return None
        rows[i], rows[p] = rows[p], rows[i]
        for r in range(n):
            if r != i:
                f = rows[r][i] / rows[i][i]
                rows[r] = [x - f * y for x, y in zip(rows[r], rows[i])]
    return [rows[i][n] / rows[i][i] for i in range(n)]


def fitted(samples, powers):
    """Fits Σ c_p n^p by nonnegative least squares over all subsets of the powers."""
    best = None
    for size in range(1, len(powers) + 1):
        for chosen in itertools.combinations(powers, size):
            terms = [[(n / LARGE) ** p / y for p in chosen] for n, y in samples]
            A = [[sum(t[i] * t[j] for t in terms) for j in range(size)] for i in range(size)]
            c = solved(A, [sum(t[i] for t in terms) for i in range(size)])
            if c is None or min(c) < 0:
                continue
            error = sum((sum(x * y for x, y in zip(c, t)) - 1) ** 2 for t in terms)
            if best is None or error < best[0] - 1e-9:
                best = error, [dict(zip(chosen, c)).get(p, 0) for p in powers]
    return best[1]


def vertices_of(program, mesh):
    return json.loads(subprocess.run([program, "inspect", mesh, "--json"], capture_output=True, check=True).stdout)["vertices"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default="build/release/meshfolio")
    parser.add_argument("--keep", type=Path, default=Path("fit_costs.json"))
    parser.add_argument("--only", default="")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("meshes", nargs="+")
    options = parser.parse_args()
    listed = json.loads(subprocess.run([options.program, "list", "--json"], capture_output=True, check=True).stdout)
    sections = [s for s in options.only.split(",") if s] or [entry["name"] for entry in listed["questions"] + listed["supporting"]]
    if options.check:
        return check(options, sections)
    exploring = {entry["name"] for entry in listed["supporting"]} - {"certificates"}
    kept = json.loads(options.keep.read_text()) if options.keep.exists() else {}

    def sample(mesh, section, small, fails=False):
        key = f"{Path(mesh).name} {section} {'small' if small else 'full'}{' fails' if fails else ''}"
        if key not in kept:
            kept[key] = measured(options.program, mesh, section, small, fails)
            options.keep.write_text(json.dumps(kept, indent=0))
        return kept[key]

    sizes = {mesh: vertices_of(options.program, mesh) for mesh in options.meshes}
    for section in sections:
        costs = []
        memories = []
        for small in (False, True):
            cpu, memory = [], []
            for mesh, n in sizes.items():
                if small and section in exploring and n > 10000:   # there it would work on a copy
                    continue
                seconds, megabytes = sample(mesh, section, small)
                nothing, base = sample(mesh, "q2", small, fails=True)
                cpu.append((n, max(seconds - nothing, 0.01)))
                memory.append((n, max(megabytes - base, 1)))
            costs.append(", ".join(f"{c:.3g}" for c in fitted(cpu, (0, 1, 1.5))))
            memories.append(", ".join(f"{c:.3g}" for c in fitted(memory, (0, 1))))
        print(f"{section}: .cost = {{.cpu = {{{{{costs[0]}}}, {{{costs[1]}}}}}, .memory = {{{{{memories[0]}}}, {{{memories[1]}}}}}}}", flush=True)

    return 0


if __name__ == "__main__":
    raise SystemExit(main() and 1)
