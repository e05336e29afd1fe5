#!/usr/bin/python3
"""Times the k smallest eigenpairs by our solver and SciPy on the same meshes in one run; prints a Markdown table.

    spectrum.py MESH [--levels 0 1 2] [--k 5 30 150] [--repeat 3] [--without-scipy] [--limit SECONDS] [--bench PROGRAM]

MESH is subdivided 1-to-4 --levels times (armadillo, 43 k vertices: 0 1 2 are 43 k, 173 k, 692 k). Both run in turns; figures are
medians of wall-clock seconds, processor seconds in brackets. SciPy (eigsh with sigma, tol 1e-8) runs in a separate process, at most
--limit seconds. Residual: largest |C phi + mu M phi| / mu |M phi|.
"""
import argparse
import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

HERE = Path(__file__).resolve().parent
BENCH = HERE.parent.parent / "build" / "release" / "tests" / "bench" / "spectrum_bench"
PYTHON = "/usr/bin/python3"


def solve_by_scipy(folder, k):
    """Runs in the child process: solves the problem that spectrum_bench exported and prints the same JSON."""
    import numpy as np
    from scipy.sparse import csc_matrix, diags
    from scipy.sparse.linalg import eigsh

    read = lambda name, kind: np.fromfile(Path(folder) / name, kind)
    starts, masses = read("starts.i32", np.int32), read("masses.f64", float)
    n = len(masses)
    C = csc_matrix((read("values.f64", float), read("rows.i32", np.int32), starts), shape=(n, n))
    area = masses.sum()
    M = diags(masses / area).tocsc()
    wall, cpu = time.monotonic(), time.process_time()
    mu, phi = eigsh(-C, k, M, sigma=-1e-3, tol=1e-8, ncv=max(20, 2 * k))
    wall, cpu = time.monotonic() - wall, time.process_time() - cpu
    order = np.argsort(mu)
    mu, phi = mu[order], phi[:, order]
    weighted = M @ phi
    residual = np.linalg.norm(C @ phi + weighted * mu, axis=0)[1:] / (mu[1:] * np.linalg.norm(weighted, axis=0)[1:])
    error = np.abs(phi.T @ weighted - np.eye(k)).max()
    memory = 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(json.dumps({"vertices": n, "k": k, "wall": wall, "cpu": cpu, "residual": residual.max(), "orthonormality": error,
                      "last": mu[-1], "memory": memory}))


def run(command, limit):
    """Returns the output of the command as JSON; None if it takes too long; the reason as text if it fails."""
    try:
        result = subprocess.run(command, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None
    return json.loads(result.stdout) if result.returncode == 0 else result.stderr.strip().splitlines()[-1]


def row(way, results):
    if any(not isinstance(r, dict) for r in results):
        failed = next(r for r in results if not isinstance(r, dict))
        return f"| | | {way} | {'over the limit' if failed is None else failed} |" + " |" * 4
    value = lambda key: median(r.get(key, 0) for r in results)
    return (f"| {results[0]['vertices']} | {results[0]['k']} | {way} | {value('wall'):.2f} ({value('cpu'):.2f}) | "
            f"{value('residual'):.1e} | {value('orthonormality'):.1e} | {value('memory') / 1e6:.0f} | {results[0]['last']:.10g} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("--levels", type=int, nargs="+", default=[0])
    parser.add_argument("--k", type=int, nargs="+", default=[5, 30, 150])
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--without-scipy", action="store_true")
    parser.add_argument("--limit", type=float, default=900)
    parser.add_argument("--bench", default=BENCH)
    options = parser.parse_args()
    print("| vertices | k | solver | s (CPU s) | residual | orthonormality | MB | µ_k · area |")
    print("|---|---|---|---|---|---|---|---|", flush=True)
    for level in options.levels:
        with tempfile.TemporaryDirectory() as folder:
            if not options.without_scipy:
                subprocess.run([options.bench, "export", options.mesh, str(level), folder], check=True)
            for k in options.k:
                commands = {"ours": [options.bench, options.mesh, str(level), str(k)]}
                if not options.without_scipy:
                    commands["SciPy"] = [PYTHON, __file__, "--scipy", folder, str(k)]
                results = {way: [] for way in commands}
                for _ in range(options.repeat):
                    for way, command in commands.items():
                        if all(isinstance(r, dict) for r in results[way]):  # a failed solver does not run again
                            results[way].append(run(command, options.limit))
                for way in commands:
                    print(row(way, results[way]), flush=True)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--scipy"]:
        solve_by_scipy(sys.argv[2], int(sys.argv[3]))
    else:
        main()
