"""Answers come from the cache if and only if nothing they depend on has changed; the report has the same bytes."""

import json
import unittest

from folders import tree
from program import SOURCE, run, sample, temporary_folder


def is_cached(process, question):
    """Returns true if the answer came from the cache and was not computed again."""
    return f"{question}: from the cache" in process.stderr and f"{question}: answered" not in process.stderr


class Cache(unittest.TestCase):
    def setUp(self):
        self.folder = temporary_folder(self)
        self.cache = self.folder / "cache"
        self.mesh = [sample(self.folder, "cube8")]   # a small mesh; empty in tests that replace a mesh of the assignment
        self.number = 0

    def report(self, *options, only="q2,q5", size=64, expected=0, **environment):
        """Makes a small report in a new folder. Returns its process and files."""
        self.number += 1
        out = self.folder / f"out{self.number}"
        environment = {"XDG_CACHE_HOME": self.cache, **environment}
        process = run("report", "--quick", "--size", size, "--only", only, "--no-timings", "--out", out, *options, *self.mesh, **environment)
        self.assertEqual(process.returncode, expected, process.stderr)
        return process, out

    def objects(self):
        return [p for p in (self.cache / "meshfolio" / "objects").rglob("*") if p.is_file()]

    def test_a_second_run_takes_everything_and_gives_the_same_bytes(self):
        first, out1 = self.report()
        second, out2 = self.report()
        without, out3 = self.report("--no-cache")
        for question in ["q2", "q5"]:
            self.assertFalse(is_cached(first, question))
            self.assertTrue(is_cached(second, question), second.stderr)
            self.assertFalse(is_cached(without, question))
        self.assertEqual(tree(out1), tree(out2))
        self.assertEqual(tree(out1), tree(out3))

    def test_one_question_more_takes_the_others_from_the_cache(self):
        self.report(only="q2")
        both, out = self.report()
        self.assertTrue(is_cached(both, "q2"))
        self.assertFalse(is_cached(both, "q5"))
        anew, expected = self.report("--no-cache")
        self.assertEqual(tree(out), tree(expected))
        # The first page now has the picture of q5, and later the picture of q2 again.
        only, _ = self.report(only="q2")
        self.assertTrue(is_cached(only, "q2"))

    def test_every_setting_is_a_part_of_the_key(self):
        self.report(only="q5")
        self.assertTrue(is_cached(self.report(only="q5")[0], "q5"))
        config = self.folder / "my.toml"
        for text in ["seed = 7", '[[question]]\nid = "q5"\nlambda = 1e-3', '[[question]]\nid = "q5"\niterations = 2',
                     '[[question]]\nid = "q5"\noutput = "modes"', '[render]\ncolormap = "magma"']:
            config.write_text(text)
            process, out = self.report("--config", config, only="q5")
            self.assertFalse(is_cached(process, "q5"), text)
            self.assertTrue(is_cached(self.report("--config", config, only="q5")[0], "q5"), text)
            if "lambda" in text:   # the page's laboratory has its own key
                self.assertEqual(tree(out), tree(self.report("--no-cache", "--config", config, only="q5")[1]))
        self.assertFalse(is_cached(self.report(only="q5", size=65)[0], "q5"))
        self.assertTrue(is_cached(self.report(only="q5", size=65)[0], "q5"))

    def test_words_on_the_page_are_no_part_of_the_key(self):
        self.report(only="q2")
        config = self.folder / "my.toml"
        config.write_text('[report]\ntitle = "Another"\nauthor = "Someone"')
        process, out = self.report("--config", config, only="q2")
        self.assertTrue(is_cached(process, "q2"))
        self.assertIn("Another", (out / "index.html").read_text())

    def test_another_mesh_is_another_answer(self):
        self.mesh = []
        data = self.folder / "data" / "smoothing"
        data.mkdir(parents=True)
        mesh = (SOURCE / "data" / "plane_noisy.obj").read_text()
        (data / "plane_ns.obj").write_text(mesh)
        options = ["--data", self.folder / "data"]
        self.report(only="q5")
        self.assertFalse(is_cached(self.report(*options, only="q5")[0], "q5"))
        self.assertTrue(is_cached(self.report(*options, only="q5")[0], "q5"))
        (data / "plane_ns.obj").write_text(mesh + "# changed\n")
        self.assertFalse(is_cached(self.report(*options, only="q5")[0], "q5"))
        (data / "plane_ns.obj").unlink()
        self.assertTrue(is_cached(self.report(*options, only="q5")[0], "q5"), "the bundled mesh again")

    def test_failures_are_never_stored(self):
        self.mesh = []
        self.report(only="q2", MESHFOLIO_FAIL="q2", expected=1)
        self.assertFalse((self.cache / "meshfolio").exists())
        data = self.folder / "data" / "smoothing"
        data.mkdir(parents=True)
        (data / "plane_ns.obj").write_text("f 1 2 3\n")
        for _ in range(2):
            process, _ = self.report("--data", self.folder / "data", only="q5", expected=1)
            self.assertFalse(is_cached(process, "q5"))

    def test_damage_is_found_and_repaired(self):
        _, expected = self.report()
        for damage in [lambda b: b[:-1], lambda b: b"", lambda b: bytes([b[0] ^ 1]) + b[1:]]:
            for path in (self.cache / "meshfolio").rglob("*"):
                if path.is_file():
                    bytes_there = path.read_bytes()
                    path.unlink()   # the damage goes to a new file, and the report's file stays unchanged
                    path.write_bytes(damage(bytes_there) if bytes_there else b"x")
            process, out = self.report()
            self.assertFalse(is_cached(process, "q2") or is_cached(process, "q5"))
            self.assertEqual(tree(out), tree(expected))
        self.assertTrue(is_cached(self.report()[0], "q2"))

    def test_one_lost_picture_is_enough_to_answer_anew(self):
        _, expected = self.report(only="q5")
        pictures = [p for p in self.objects() if p.read_bytes().startswith(b"\x89PNG")]
        pictures[0].unlink()
        process, out = self.report(only="q5")
        self.assertFalse(is_cached(process, "q5"))
        self.assertEqual(tree(out), tree(expected))

    def test_a_report_changed_in_place_does_not_reach_the_next(self):
        _, out = self.report(only="q5")
        before = tree(out)
        for path in out.rglob("*.png"):
            with path.open("r+b") as file:
                file.write(b"spoilt")
        _, again = self.report(only="q5")
        self.assertEqual(tree(again), before)

    def test_an_unusable_folder_is_a_warning(self):
        blocked = self.folder / "file"
        blocked.write_text("")
        process, _ = self.report(only="q2", XDG_CACHE_HOME=blocked)
        self.assertIn("warning: no cache is used", process.stderr)

    def test_the_limit_is_kept_and_clearing_clears(self):
        self.report(MESHFOLIO_CACHE_LIMIT=1)
        self.assertLessEqual(sum(p.stat().st_size for p in (self.cache / "meshfolio").rglob("*") if p.is_file()), 1 << 20)
        shown = run("cache", XDG_CACHE_HOME=self.cache)
        self.assertIn(str(self.cache / "meshfolio"), shown.stdout)
        self.assertEqual(run("cache", "clear", XDG_CACHE_HOME=self.cache).returncode, 0)
        self.assertEqual(self.objects(), [])
        self.assertEqual(run("report", "--out", self.folder / "no", MESHFOLIO_CACHE_LIMIT="much").returncode, 2)

    def test_timings_name_the_cached_answers(self):
        for name in ["one", "two"]:
            process = run("report", "--quick", "--size", 64, "--only", "q2", "--out", self.folder / name, XDG_CACHE_HOME=self.cache)
            self.assertEqual(process.returncode, 0, process.stderr)
        timings = json.loads((self.folder / "two" / "results.json").read_text())["questions"][1]["timings"]
        self.assertEqual([t["what"] for t in timings], ["taken from the cache"])


if __name__ == "__main__":
    unittest.main()
