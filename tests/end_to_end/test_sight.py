"""The direction of the pictures of a report: flags, settings, cache, models, batch."""

import json
import unittest

from folders import tree
from glb_file import Glb
from program import run, sample, temporary_folder

WORDS = ["--only", "q1", "--alone", "--size", 64, "--no-timings"]


def settings(out):
    return json.loads((out / "results.json").read_text())["provenance"]["settings"]


def pictures(out):
    return {name: data for name, data in tree(out).items() if name.startswith(("images/", "models/"))}


class Sights(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls)
        cls.mesh = sample(cls.folder, "creature")
        cls.number = 0
        cls.usual = cls.report()[0]

    @classmethod
    def report(cls, *options, expected=0, **environment):
        cls.number += 1
        out = cls.folder / f"out{cls.number}"
        process = run("report", cls.mesh, "--quick", *WORDS, "--out", out, *options, **environment)
        assert process.returncode == expected, process.stderr
        return out, process

    def frames(self, out):
        frames = [Glb(path.read_bytes()).extras["frame"] for path in sorted((out / "models").iterdir())]
        self.assertTrue(frames)
        return frames

    def test_a_camera_changes_the_pictures_and_nothing_that_is_computed(self):
        out, _ = self.report("--camera=90,0")
        self.assertEqual(tree(out), tree(self.report("--camera=90,0")[0]))
        before, after = pictures(self.usual), pictures(out)
        self.assertEqual(set(before), set(after))
        changed = {name for name in before if before[name] != after[name]}
        self.assertTrue({name for name in before if name.startswith("models/")} <= changed)
        self.assertTrue({name for name in before if name.endswith("_sheet.png")} <= changed)
        self.assertEqual({**settings(self.usual), "camera": "90, 0, 0"}, settings(out))
        self.assertEqual(pictures(self.report("--camera=-270,0")[0]), after, "a whole turn is none")

    def test_models_begin_at_the_camera(self):
        for options, from_, up in ((["--camera=90,0"], [1, 0, 0], [0, 1, 0]), (["--camera=0,0", "--up=z"], [0, -1, 0], [0, 0, 1]),
                                   (["--camera=0,0,90"], [0, 0, 1], [-1, 0, 0]), (["--camera=0,90"], [0, 1, 0], [0, 0, -1])):
            for frame in self.frames(self.report(*options)[0]):
                self.assertEqual((frame["from"], frame["up"], frame.get("zoom")), (from_, up, None), options)
        for before, frame in zip(self.frames(self.usual), self.frames(self.report("--zoom=2.5")[0])):
            self.assertEqual({**before, "zoom": 2.5}, frame)

    def test_the_settings_file_says_the_same(self):
        file = self.folder / "my.toml"
        file.write_text('[render]\ncamera = [20, -10, 5]\nup = "z"\nzoom = 2\n')
        self.assertEqual(tree(self.report("--config", file)[0]), tree(self.report("--camera=20,-10,5", "--up=z", "--zoom=2")[0]))

    def test_it_is_a_part_of_the_key(self):
        cache, seen = {"XDG_CACHE_HOME": self.folder / "cache"}, []
        for options in ([], ["--camera=90,0"], ["--up=x"], ["--zoom=2"], ["--camera=90,0"]):
            out, process = self.report(*options, **cache)
            self.assertEqual("q1: from the cache" in process.stderr, options in seen, options)
            seen.append(options)
        self.assertEqual(tree(out), tree(self.report("--no-cache", *options)[0]))

    def test_only_and_from(self):
        """`--only` keeps no section with other pictures; `--from` draws nothing."""
        out = self.folder / "renewed"
        words = ["report", self.mesh, "--quick", "--size", 64, "--no-timings", "--out", out, "--only"]
        for section in ("q2", "certificates"):
            process = run(*words, section, "--camera=1,2")
            self.assertEqual(process.returncode, 0, process.stderr)
        states = {s["id"]: s["status"] for part in ("questions", "supporting") for s in json.loads((out / "results.json").read_text())[part]}
        self.assertEqual((states["q2"], states["certificates"]), ("ok", "ok"))
        process = run(*words, "certificates", "--camera=3,4")
        self.assertIn("its other sections were made with camera 1, 2, 0, and not 3, 4, 0", process.stderr)
        for option in ("--camera=1,2", "--up=z", "--zoom=2"):
            process = run("report", "--from", self.usual / "results.json", "--out", self.folder / "again", option)
            self.assertEqual(process.returncode, 2)
            self.assertIn(f"{option.split('=')[0]} cannot be given with --from", process.stderr)

    def test_batch_passes_it_on_and_makes_reports_with_another_anew(self):
        out = self.folder / "batch"
        for options, camera, is_new in ((["--camera=-35,20"], "-35, 20, 0", True), (["--camera=-35,20"], "-35, 20, 0", False), ([], None, True)):
            process = run("batch", self.mesh, "--out", out, "--jobs", 1, "--no-timings", "--only", "q1", "--size", 64, *options)
            self.assertEqual(process.returncode, 0, process.stderr)
            self.assertEqual(settings(out / "creature").get("camera"), camera)
            self.assertEqual("1 of 1: " in process.stderr, is_new, process.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
