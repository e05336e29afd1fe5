#!/usr/bin/python3
"""The k smallest eigenpairs by our solver, Spectra and SciPy on the same meshes in one run; prints a Markdown table.

    spectrum.py MESH [--levels 0 1 2] [--k 5 30 150] [--repeat 3] [--peers spectra scipy] [--limit SECONDS] [--bench PROGRAM]
                [--plot FILE.svg]

MESH is subdivided 1-to-4 as often as --levels say (armadillo, 43 k vertices: 0 1 2 are 43 k, 173 k, 692 k). Everything takes turns;
figures are medians of wall-clock seconds, processor seconds in brackets. A peer that takes longer than --limit is given up.
--plot (Matplotlib): growth in n and in k, with what the processor's matrix products and its memory allow, both measured by NumPy in
this run, for the arithmetic and the traffic of our orthogonalisation (4 n m^2 flops and 24 n m^2 / 16 bytes a slice of m vectors).
Residual: largest |C phi + mu M phi| / mu |M phi|. SciPy: eigsh with sigma, tol 1e-8, in a process of its own.
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
    """In the child process: solves what spectrum_bench exported and prints the same JSON."""
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
    """What the command prints, as JSON; None when it takes too long; the reason as text when it fails."""
    try:
        result = subprocess.run(command, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None
    return json.loads(result.stdout) if result.returncode == 0 else result.stderr.strip().splitlines()[-1]


def row(way, results):
    if any(not isinstance(r, dict) for r in results):
        failed = next(r for r in results if not isinstance(r, dict))
        return f"| | | {way} | {'over the limit' if failed is None else failed} |" + " |" * 8
    value = lambda key: median(r.get(key, 0) for r in results)
    split = " | ".join(f"{value(key):.2f}" for key in ("factor", "solve", "orthogonalise", "rayleigh_ritz"))
    return (f"| {results[0]['vertices']} | {results[0]['k']} | {way} | {value('wall'):.2f} ({value('cpu'):.2f}) | {split} | "
            f"{value('residual'):.1e} | {value('orthonormality'):.1e} | {value('memory') / 1e6:.0f} | {results[0]['last']:.10g} |")


def machine_rates():
    """Flops a second of matrix products and bytes a second of copying, on one thread."""
    import numpy as np

    A, long = np.random.default_rng(1).random((1500, 1500)), np.zeros(20_000_000)
    best = lambda work: min(timed(work) for _ in range(3))
    return 2 * 1500**3 / best(lambda: A @ A), 2 * long.nbytes / best(lambda: long.copy())


def timed(work):
    start = time.monotonic()
    work()
    return time.monotonic() - start


def least_seconds(n, k, flops, bytes_a_second, processors=2):
    """What orthogonalising alone takes at these rates: slices of up to 80 pairs with 80 + 4 vectors a pair."""
    slices = max(1, -(-k // 80))
    m = 80 + 4 * k / slices
    return slices * 4 * n * m**2 / (processors * flops), slices * 24 * n * m**2 / 16 / (processors * bytes_a_second)


def plot(measured, file):
    """measured: {(way, n, k): seconds}"""
    import matplotlib

    matplotlib.use("svg")
    from matplotlib import pyplot

    flops, memory = machine_rates()
    figure, (over_n, over_k) = pyplot.subplots(1, 2, figsize=(12, 5), sharey=True, layout="constrained")
    styles, colours = {"ours": "o-", "spectra": "s--", "scipy": "^:"}, pyplot.get_cmap("viridis")

    def panel(axes, along, fixed_at, label):
        values = sorted({key[fixed_at] for key in measured})
        for i, fixed in enumerate(values):
            colour = colours(0.9 * i / max(1, len(values) - 1))
            for way, style in styles.items():
                line = sorted((key[along], s) for key, s in measured.items() if key[0] == way and key[fixed_at] == fixed)
                if line:
                    axes.plot(*zip(*line), style, color=colour, label=f"{way}, {label} = {fixed}")
            ours = sorted(key[along] for key in measured if key[0] == "ours" and key[fixed_at] == fixed)
            limits = [least_seconds(*((x, fixed) if along == 1 else (fixed, x)), flops, memory) for x in ours]
            axes.plot(ours, [a for a, _ in limits], color=colour, alpha=0.4, linewidth=0.8)
            axes.plot(ours, [b for _, b in limits], color=colour, alpha=0.4, linewidth=2.5)
        axes.set(xscale="log", yscale="log", xlabel="vertices n" if along == 1 else "eigenpairs k", ylabel="seconds")
        axes.legend(fontsize=6)
        axes.grid(alpha=0.3)

    panel(over_n, 1, 2, "k")
    panel(over_k, 2, 1, "n")
    figure.suptitle(f"k smallest eigenpairs; thin and thick lines: limits of {flops / 1e9:.0f} Gflop/s and {memory / 1e9:.1f} GB/s a thread")
    figure.savefig(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("--levels", type=int, nargs="+", default=[0])
    parser.add_argument("--k", type=int, nargs="+", default=[5, 30, 150])
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--peers", nargs="*", default=["spectra", "scipy"])
    parser.add_argument("--limit", type=float, default=900)
    parser.add_argument("--bench", default=BENCH)
    parser.add_argument("--plot")
    options = parser.parse_args()
    print("| vertices | k | solver | s (CPU s) | factor | solve | orthogonalise | Rayleigh–Ritz | residual | orthonormality | MB | µ_k · area |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|", flush=True)
    measured = {}
    for level in options.levels:
        with tempfile.TemporaryDirectory() as folder:
            if "scipy" in options.peers:
                subprocess.run([options.bench, "export", options.mesh, str(level), folder], check=True)
            for k in options.k:
                bench = lambda way: [options.bench, way, options.mesh, str(level), str(k)]
                commands = {"ours": bench("ours"), "spectra": bench("spectra"),
                            "scipy": [PYTHON, __file__, "--scipy", folder, str(k)]}
                ways = ["ours", *options.peers]
                results = {way: [] for way in ways}
                for _ in range(options.repeat):
                    for way in ways:
                        if all(isinstance(r, dict) for r in results[way]):  # what failed once is not tried again
                            results[way].append(run(commands[way], options.limit))
                for way in ways:
                    print(row(way, results[way]), flush=True)
                    if all(isinstance(r, dict) for r in results[way]):
                        measured[way, results[way][0]["vertices"], k] = median(r["wall"] for r in results[way])
    if options.plot:
        plot(measured, options.plot)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--scipy"]:
        solve_by_scipy(sys.argv[2], int(sys.argv[3]))
    else:
        main()
