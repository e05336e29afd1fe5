"""`report --plan` and `--time`: the report keeps to the plan, and a second run gives the same bytes."""

import json
import resource
import subprocess
import unittest

from program import PROGRAM, run, sample, temporary_folder


class Plans(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self)
        self.mesh = sample(self.folder, "fandisk_like", "ply", 1)   # 25,842 vertices

    def plan(self, *words):
        process = run("report", "--plan", "--json", *words)
        self.assertEqual(process.returncode, 0, process.stderr)
        return json.loads(process.stdout)

    def test_a_plan_computes_nothing_and_is_reproducible(self):
        out = self.folder / "out"
        for words in ([], [self.mesh], [self.mesh, "--time", 5], [self.mesh, "--quick", "--only", "q4,stability"]):
            plan = self.plan("--out", out, *words)
            self.assertEqual(plan, self.plan("--out", out, *words, "--threads", 1))
            self.assertAlmostEqual(plan["cpu_seconds"], plan["cpu_seconds_beside_sections"] + sum(s["cpu_seconds"] for s in plan["sections"]),
                                   delta=0.02 * plan["cpu_seconds"])
            self.assertEqual(run("report", "--plan", "--out", out, *words).stdout.splitlines()[0].split()[0], "section")
        self.assertFalse(out.exists())
        self.assertEqual([s["id"] for s in plan["sections"]], ["q4", "stability"])

    def test_a_report_does_what_is_planned_reproducibly(self):
        words = [self.mesh, "--time", 4, "--only", "q5,stability,certificates", "--alone", "--no-timings", "--size", 64]
        planned = {s["id"]: s for s in self.plan(*words)["sections"]}
        trees = []
        for name in ("a", "b"):
            process = run("report", *words, "--out", self.folder / name, "--threads", 1 + len(trees))
            self.assertEqual(process.returncode, 0, process.stderr)
            self.assertIn("planned:", process.stderr)
            self.assertIn(" s left", process.stderr)
            trees.append((self.folder / name / "SHA256SUMS").read_text())
        self.assertEqual(*trees)
        results = json.loads((self.folder / "a" / "results.json").read_text())
        settings = results["provenance"]["settings"]
        self.assertEqual(settings["time"], "4")
        for section in results["questions"] + results["supporting"]:
            plan = planned.get(section["id"])
            if plan is None:
                continue
            if plan["settings"] == "left out":
                self.assertEqual(section["status"], "skipped")
                continue
            self.assertEqual(section["status"], "ok", section["id"])
            warnings = " ".join(section["warnings"])
            copied = any(m["worked_on"] < m["vertices"] for m in plan["meshes"])
            self.assertEqual("decimated copy" in warnings, copied, section["id"])
            self.assertEqual("small settings" in warnings, plan["settings"] == "small", section["id"])
            if copied or plan["settings"] == "small":
                self.assertEqual(settings[section["id"] + " effort"], plan["how"])
        self.assertTrue(any(p["settings"] != "full" or "copies" in p["how"] for p in planned.values()))

    def test_the_meshes_planned_for_are_those_that_sections_take(self):
        planned = {s["id"]: {m["file"] for m in s["meshes"]} for s in self.plan()["sections"]}
        only = "q3,q5,certificates"
        process = run("report", "--only", only, "--quick", "--size", 64, "--out", self.folder / "out")
        self.assertEqual(process.returncode, 0, process.stderr)
        results = json.loads((self.folder / "out" / "results.json").read_text())
        for section in results["questions"] + results["supporting"]:
            if section["id"] in only.split(","):
                self.assertEqual({i["file"] for i in section["inputs"]}, planned[section["id"]], section["id"])

    def test_too_little_memory_is_refused_before_anything_is_written(self):
        large = sample(self.folder, "fandisk_like", "ply", 3)   # 413,442 vertices
        out = self.folder / "out"
        limit = 900 << 20
        process = subprocess.run([PROGRAM, "report", large, "--out", out, "--pdf", "off"], capture_output=True, text=True,
                                 preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        self.assertEqual(process.returncode, 3, process.stderr)
        self.assertIn("RLIMIT_AS", process.stderr)
        self.assertIn("would fit", process.stderr)
        self.assertFalse(out.exists())

    def test_impossible_options_are_refused(self):
        for words in (["--time", "0"], ["--time", "-3"], ["--time", "soon"], ["--json"], ["--from", "results.json", "--plan"]):
            self.assertEqual(run("report", *words).returncode, 2, words)


if __name__ == "__main__":
    unittest.main()
