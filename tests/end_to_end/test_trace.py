"""Runs of `smooth` that are traced, cut into frames and repeated: they agree with single runs, with `compare` and with the theory."""

import csv
import io
import json
import math
import os
import unittest
from pathlib import Path
from xml.etree import ElementTree

from in_folder import InFolder


class Trace(InFolder):
    def setUp(self):
        super().setUp()
        self.succeed("noise", self.sample("bumpy_cube"), "-o", "noisy.ply", "--sigma", 0.005, "--unit", "bbox")

    def table(self, *options, mesh="noisy.ply"):
        rows = csv.DictReader(io.StringIO(self.succeed("smooth", mesh, "--csv", "-", *options)))
        return [{name: float(cell) if cell else math.nan for name, cell in row.items()} for row in rows]

    def bytes(self, name):
        return Path(self.path(name)).read_bytes()

    def test_the_last_row_is_what_compare_measures(self):
        for options in (["--lambda", 0.5, "--unit", "tau"], ["--scheme", "implicit", "--lambda", 2, "--unit", "tau", "--rebuild"],
                        ["--scheme", "taubin", "--lambda", 0.4, "--unit", "tau"], ["--lambda", 3, "--unit", "tau", "--adaptive", "--rebuild"]):
            rows = self.table("--trace", "bumpy_cube.obj", "-o", "out.ply", "--iterations", 7, *options)
            close = json.loads(self.succeed("compare", "bumpy_cube.obj", "out.ply", "--json"))
            self.assertEqual([row["iteration"] for row in rows], list(range(8)))
            self.assertAlmostEqual(rows[-1]["error"], 100 * close["rms"] / close["box_diagonal"], delta=1e-9)
            end, start = json.loads(self.succeed("inspect", "out.ply", "--json")), json.loads(self.succeed("inspect", "noisy.ply", "--json"))
            for row, measured in ((rows[0], start), (rows[-1], end)):
                self.assertAlmostEqual(row["area"] / measured["area"], 1, delta=1e-9)
                self.assertAlmostEqual(row["volume"] / measured["volume"], 1, delta=1e-9)
            self.assertAlmostEqual(rows[0]["energy"] / start["area"], 1, delta=1e-9, msg="the cotangent energy of the input is its area")

    def test_the_energy_falls_in_stable_steps(self):
        for options in (["--lambda", 0.9, "--unit", "tau"], ["--lambda", 0.5, "--unit", "tau", "--operator", "uniform"],
                        ["--scheme", "implicit", "--lambda", 50, "--unit", "tau"]):
            rows = self.table("--iterations", 12, *options)
            self.assertNotIn("error", rows[0])
            for before, after in zip(rows, rows[1:]):
                self.assertLessEqual(after["energy"], before["energy"] * (1 + 1e-12), options)
        step = json.loads(self.succeed("inspect", "noisy.ply", "--json"))["lambda_crit"]
        rows = self.table("--iterations", 5, "--lambda", 0.25, "--unit", "tau")
        for t, row in enumerate(rows):
            self.assertAlmostEqual(row["time"], t * 0.25 * step, delta=1e-12 * step)

    def test_a_clean_mesh_has_no_error_at_first(self):
        rows = self.table("--trace", "bumpy_cube.obj", "--lambda", 0.5, "--unit", "tau", "--iterations", 3, mesh="bumpy_cube.obj")
        self.assertEqual(rows[0]["error"], 0)
        self.assertTrue(all(before["error"] < after["error"] for before, after in zip(rows, rows[1:])))

    def test_frames_are_runs_of_their_own(self):
        options = ["--scheme", "implicit", "--lambda", 3, "--unit", "tau"]
        written = self.succeed("smooth", "noisy.ply", "-o", "fair.ply", *options, "--iterations", 9, "--frames", "0,4,9").split()
        self.assertEqual(written, ["fair_0.ply", "fair_4.ply", "fair_9.ply", "fair.ply"])
        for n in (0, 4, 9):
            self.succeed("smooth", "noisy.ply", "-o", "one.ply", *options, "--iterations", n)
            self.assertEqual(self.bytes(f"fair_{n}.ply"), self.bytes("one.ply"), n)
        self.assertEqual(self.bytes("fair_9.ply"), self.bytes("fair.ply"))

    def test_several_steps_are_several_runs(self):
        rows = self.table("--lambda", "0.25,0.5", "--unit", "tau", "--iterations", 3, "-o", "fair.ply", "--plot", "fair.svg", "--frames", "2")
        self.assertEqual([row["lambda"] for row in rows], [0.25] * 4 + [0.5] * 4)
        for step in (0.25, 0.5):
            one = self.table("--lambda", step, "--unit", "tau", "--iterations", 3, "-o", "one.ply")
            self.assertEqual(self.bytes(f"fair_{step}.ply"), self.bytes("one.ply"))
            self.assertEqual([{**row, "lambda": step} for row in one], [row for row in rows if row["lambda"] == step])
        self.assertEqual({name for name in os.listdir(self.folder) if name.startswith("fair")},
                         {f"fair_{step}{frame}.ply" for step in (0.25, 0.5) for frame in ("", "_2")} | {"fair.svg"})
        self.assertFalse(os.path.exists(self.path("fair.ply")))

    def test_a_plot_stands_alone(self):
        for curve in ("error", "energy", "area", "volume"):
            self.succeed("smooth", "noisy.ply", "--trace", "bumpy_cube.obj", "--lambda", "0.25,0.5", "--unit", "tau", "--iterations", 4,
                         "--plot", "curve.svg", "--curve", curve)
            text = self.bytes("curve.svg").decode()
            ElementTree.fromstring(text)
            for part in ("@font-face", "font/woff2", "iteration", curve, "0.25", "0.5"):
                self.assertTrue(part in text, part)
            self.assertFalse("var(" in text, "readers of SVG outside of browsers know no variables")
            self.assertFalse("http" in text.replace("http://www.w3.org/2000/svg", ""))

    def test_the_summary_is_that_of_the_table(self):
        options = ["--lambda", "0.25,0.5", "--unit", "tau", "--iterations", 6, "--trace", "bumpy_cube.obj"]
        rows, summary = self.table(*options), list(csv.DictReader(io.StringIO(self.succeed("smooth", "noisy.ply", "--summary", "-", *options))))
        for told, run in zip(summary, (rows[:7], rows[7:])):
            self.assertEqual((told["end"], told["iterations"], told["share"]), ("whole", "6", told["lambda"]))
            for name in ("energy", "area", "volume"):
                self.assertAlmostEqual(float(told[name]), run[-1][name] / run[0][name], delta=1e-12)
            least = min(run, key=lambda row: row["error"])
            self.assertEqual([float(told[name]) for name in ("error_before", "error_least", "least_at", "error_after")],
                             [run[0]["error"], least["error"], least["iteration"], run[-1]["error"]])
        self.assertEqual(len(summary), 2)

    def test_units_of_another_mesh(self):
        clean = json.loads(self.succeed("inspect", "bumpy_cube.obj", "--json"))
        for unit, size in (("tau", clean["lambda_crit"]), ("h2", clean["mean_edge"] ** 2)):
            rows = self.table("--lambda", 0.5, "--unit", unit, "--unit-of", "bumpy_cube.obj")
            self.assertAlmostEqual(rows[1]["time"] / (0.5 * size), 1, delta=1e-9)

    def test_a_run_keeps_what_it_reached(self):
        options = ["--lambda", 3, "--unit", "tau", "--iterations", 200, "--trace", "bumpy_cube.obj"]
        self.assertIn("blew up", self.refuse(1, "smooth", "noisy.ply", "-o", "first.ply", "--csv", "first.csv", *options))
        code, _, err = self.run_here("smooth", "noisy.ply", "-o", "out.ply", "--csv", "out.csv", "--frames", "1,199", "--keep-reached", *options)
        self.assertEqual(code, 0, err)
        self.assertIn("warning: noisy.ply: blew up in iteration", err)
        self.assertIn("warning: 1 of the --frames were not reached", err)
        self.assertEqual((self.bytes("out.ply"), self.bytes("out.csv")), (self.bytes("first.ply"), self.bytes("first.csv")))
        rows = list(csv.DictReader(io.StringIO(self.bytes("out.csv").decode())))
        close = json.loads(self.succeed("compare", "bumpy_cube.obj", "out.ply", "--json"))
        self.assertAlmostEqual(float(rows[-1]["error"]) / (100 * close["rms"] / close["box_diagonal"]), 1, delta=1e-9)

    def test_wrong_usage(self):
        for words, told in ((["--lambda", 1], "-o is required"), (["--csv", "-", "-o", "-"], "standard output"), (["--lambda", "1,1", "-o", "x.ply"], "twice"),
                            (["--lambda", "1,x", "-o", "x.ply"], "'x'"), (["--lambda", "1,2", "-o", "-"], "standard output"),
                            (["--frames", "1", "--csv", "-"], "--frames needs -o"), (["--frames", "2", "-o", "x.ply"], "from 0 to 1"),
                            (["--trace", "bumpy_cube.obj", "-o", "x.ply"], "--trace needs"), (["--plot", "x.pdf"], ".svg"),
                            (["--csv", "x.csv", "--curve", "error"], "needs --trace"), (["--plot", "x.svg", "--curve", "eror"], "'error'")):
            self.assertIn(told, self.refuse(2, "smooth", "none.ply", *words), words)
        self.assertIn("cube8.obj", self.refuse(3, "smooth", "noisy.ply", "--csv", "-", "--trace", self.sample("cube8")))
        before = self.bytes("bumpy_cube.obj")
        self.refuse(2, "smooth", "noisy.ply", "-o", "bumpy_cube.obj", "--trace", "bumpy_cube.obj", "--csv", "x.csv")
        self.assertEqual(self.bytes("bumpy_cube.obj"), before)
        self.assertIn("volume", self.refuse(2, "smooth", self.sample("saddle"), "--plot", "x.svg", "--curve", "volume"))


if __name__ == "__main__":
    unittest.main()
