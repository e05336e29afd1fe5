"""Inputs are opened before any work, and a failed run never replaces a good report."""

import json
import shutil
import unittest
from pathlib import Path

from folders import tree
from in_folder import InFolder
from program import run, temporary_folder

QUICK = ["report", "--quick", "--size", 64, "--only", "q2", "--alone"]
BROKEN = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"


class NamedInputs(InFolder):
    def setUp(self):
        super().setUp()
        self.sample("torus")
        self.write("broken.obj", BROKEN)
        self.write("meshes/x.txt", "")
        self.write("out/.meshfolio", "This folder was made by meshfolio, which replaces it as a whole.\n")
        self.write("out/results.json", "precious")

    def files(self):
        return tree(Path(self.folder))

    def refused(self, *words):
        """Requires exit code 3, one line, and an unchanged folder."""
        before = self.files()
        code, out, err = self.run_here(*words, MESHFOLIO_PDF="auto")
        self.assertEqual((code, out, len(err.splitlines())), (3, "", 1), err)
        self.assertEqual(self.files(), before)
        return err

    def test_a_typing_error_in_any_command(self):
        commands = [[*QUICK, "MESH"], [*QUICK, "torus.obj", "MESH"], ["render", "MESH", "--out", "pictures"], ["inspect", "MESH"],
                    ["curvature", "MESH", "--csv", "a.csv"], ["spectrum", "MESH", "-k", 3, "--csv", "a.csv"], ["smooth", "MESH", "-o", "a.ply"],
                    ["noise", "MESH", "--sigma", 0.1, "-o", "a.ply"], ["compare", "torus.obj", "MESH"]]
        for words in commands:
            for mesh, remedy in (("tours.obj", "did you mean 'torus.obj'?"), ("meshes/none.obj", "check its name"), ("broken.obj", "")):
                err = self.refused(*[mesh if word == "MESH" else word for word in words])
                self.assertTrue(err.startswith("meshfolio: " + mesh), err)
                self.assertIn(remedy, err)
        self.assertIn("broken.obj:4: ", self.refused(*QUICK, "./broken.obj"))

    def test_a_missing_data_folder(self):
        for folder in ("mesh", "mesh/"):
            self.assertIn("did you mean 'meshes'?", self.refused(*QUICK, "--data", folder))
        self.assertIn("correct --data", self.refused(*QUICK, "--data", "meshes", "--data", "elsewhere"))

    def test_a_mesh_of_the_settings_falls_back_to_a_bundled_one(self):
        self.write("my.toml", '[[question]]\nid = "q1"\nmesh = "smoothing/plane_ns.obj"\n')
        shutil.rmtree(self.path("out"))
        self.succeed("report", "--quick", "--size", 64, "--only", "q1", "--config", "my.toml", "--out", "new")


class Failed(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self)
        self.out, self.failed = self.folder / "out", self.folder / "out.failed"

    def report(self, code, fail="", out=None):
        process = run(*QUICK, "--no-timings", "--out", out or self.out, MESHFOLIO_FAIL=fail)
        self.assertEqual(process.returncode, code, process.stderr)
        return process

    def status(self, out):
        return next(q for q in json.loads((out / "results.json").read_text())["questions"] if q["id"] == "q2")["status"]

    def test_a_good_report_stays_until_the_next_good_one(self):
        self.report(1, "q2")
        self.assertEqual(self.status(self.out), "failed")   # better than nothing
        self.report(0)
        good = tree(self.out)
        for _ in range(2):
            process = self.report(1, "q2")
            self.assertEqual((tree(self.out), self.status(self.failed)), (good, "failed"))
            self.assertEqual(process.stdout, f"{self.failed / 'index.html'}\n")
            self.assertIn(f"meshfolio: {self.out} keeps the report that ended well; this one is {self.failed}", process.stderr)
        self.report(0)
        self.assertEqual((tree(self.out), sorted(p.name for p in self.folder.iterdir())), (good, ["out"]))

    def test_a_good_report_stays_when_a_failed_one_is_rendered_again(self):
        self.report(0)
        self.report(1, "q2", self.folder / "bad")
        process = run("report", "--from", self.folder / "bad" / "results.json", "--out", f"{self.out}/")
        self.assertEqual((process.returncode, self.status(self.out), self.status(self.failed)), (1, "ok", "failed"), process.stderr)

    def test_a_foreign_folder_is_left_alone(self):
        self.failed.mkdir()
        (self.failed / "thesis.tex").write_text("precious")
        self.report(0)
        good = tree(self.out)
        self.report(4, "q2")
        self.assertEqual((tree(self.out), [p.name for p in self.failed.iterdir()]), (good, ["thesis.tex"]))
        self.report(0)
        self.assertTrue((self.failed / "thesis.tex").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
