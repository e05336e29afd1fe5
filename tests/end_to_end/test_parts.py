"""Sections that are renewed one by one, or made separately and merged, give the same bytes as one run."""

import json
import shutil
import unittest
import xml.etree.ElementTree

from folders import tree
from program import SOURCE, run, sample, temporary_folder
from quick_report import WORDS as QUICK
from quick_report import quick_report


def sections(out):
    results = json.loads((out / "results.json").read_text())
    return results["questions"] + results["supporting"]


def status(out):
    return {s["id"]: s["status"] for s in sections(out)}


class Parts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls)
        _, cls.whole, made = quick_report(cls.folder)
        cls.cache = cls.folder / "cache"   # has every section, for tests of their assembly
        shutil.copytree(made, cls.cache)
        ids = [s["id"] for s in sections(cls.whole)]
        cls.parts = [cls.folder / f"part{i}" for i in range(3)]
        # Question 3 has the picture of the first page, questions 5 and 7 share a mesh of the laboratory.
        for part, some in zip(cls.parts, (["q1", "q5", *ids[8:]], ["q4", "q3"], ["q7", "q6", "q2", ids[7]])):
            process = run("report", "--quick", "--size", 64, "--part", part, "--only", ",".join(some))
            assert process.returncode == 0, process.stderr

    def copy(self):
        out = temporary_folder(self) / "out"
        shutil.copytree(self.whole, out)
        return out

    def ended(self, code, *words, **environment):
        process = run(*words, **{"XDG_CACHE_HOME": self.cache, **environment})
        self.assertEqual(process.returncode, code, process.stderr)
        return process

    def merge(self, code, *words, out=None):
        out = out or temporary_folder(self) / "out"
        return out, self.ended(code, "merge", *words, "--out", out)

    # ---- report --only

    def test_a_section_is_renewed_and_the_others_stay(self):
        out = self.copy()
        process = self.ended(0, *QUICK, "--no-cache", "--only", "q2,q3", "--out", out)   # question 3 has the picture of the first page
        self.assertEqual(tree(out), tree(self.whole))
        self.assertEqual(process.stderr.count(": answered in "), 2, process.stderr)
        self.assertNotIn("only what was asked for", process.stderr)

    def test_with_alone_it_is_a_part(self):
        out = self.copy()
        self.ended(0, *QUICK, "--only", "q2", "--alone", "--out", out)
        self.assertEqual({s for s, state in status(out).items() if state != "skipped"}, {"q2"})
        self.ended(2, *QUICK, "--alone", "--out", out)

    def test_sections_that_failed_are_mended_one_by_one(self):
        out = self.copy()
        self.ended(1, *QUICK, "--only", "q2,q4", "--out", out, MESHFOLIO_FAIL="q2,q4")
        self.assertEqual(tree(out), tree(self.whole))
        failed = out.with_name("out.failed")
        self.assertEqual({s for s, state in status(failed).items() if state == "failed"}, {"q2", "q4"})
        self.ended(1, *QUICK, "--only", "q2", "--out", failed)
        self.ended(0, *QUICK, "--only", "q4", "--out", failed)
        self.assertEqual(tree(failed), tree(self.whole))

    def test_other_settings_or_inputs_keep_nothing_and_say_so(self):
        folder = temporary_folder(self)
        mesh, out = sample(folder, "cube8"), folder / "out"
        small = ["report", "--quick", "--no-timings", "--only"]
        cases = [(["--size", 72, mesh], "size 64 × 64, and not 72 × 72"), (["--size", 64], "meshes cube8.obj, and not none"),
                 (["--size", 64, "--data", folder], "meshes cube8.obj")]
        (folder / "mine" / "words").mkdir(parents=True)
        (folder / "mine" / "words" / "q2.md").write_text((SOURCE / "templates" / "words" / "q2.md").read_text().replace("## title\n", "## title\nMy ", 1))
        cases.append((["--size", 64, "--templates", folder / "mine", mesh], "words none, and not"))
        for options, words in cases:
            self.ended(0, *small, "q1,q2", "--size", 64, "--out", out, mesh)
            process = self.ended(0, *small, "q2", "--out", out, *options)
            self.assertIn(f"has only what was asked for: its other sections were made with {words}", process.stderr)
            self.assertEqual((status(out)["q1"], status(out)["q2"]), ("skipped", "ok"))
        self.ended(0, *small, "q1", "--size", 64, "--out", out, mesh)
        self.ended(0, *small, "q2", "--size", 64, "--out", out, mesh)
        self.assertEqual((status(out)["q1"], status(out)["q2"]), ("ok", "ok"))
        mesh.write_text(mesh.read_text() + "# changed\n")
        self.assertIn("another cube8.obj", self.ended(0, *small, "q2", "--size", 64, "--out", out, mesh).stderr)

    def test_a_report_that_is_scaled_down_is_renewed_and_merged(self):
        """Renewing a part, or merging parts, gives the same report. A left-out section appears once `--only` names it."""
        folder = temporary_folder(self)
        words = ["report", sample(folder, "creature"), "--quick", "--size", 64, "--time", 2]
        whole, renewed = folder / "whole", folder / "renewed"
        self.ended(0, *words, "--no-timings", "--only", "q2,q5,stability", "--out", whole)
        settings = json.loads((whole / "results.json").read_text())["provenance"]["settings"]
        self.assertIn("copies", settings["q5 effort"])
        self.assertEqual(settings["methods effort"], "left out")
        self.assertNotEqual(settings["stability effort"], "left out")
        shutil.copytree(whole, renewed)
        self.ended(0, *words, "--no-timings", "--only", "q5", "--out", renewed)
        self.assertEqual(tree(renewed), tree(whole))
        self.ended(0, *words, "--no-timings", "--only", "methods", "--out", renewed)
        self.assertEqual({s for s, state in status(renewed).items() if state == "ok"}, {"q2", "q5", "stability", "methods"})
        parts = [folder / name for name in ("q2", "q5", "stability")]
        for part in parts:
            self.ended(0, *words, "--part", part, "--only", part.name)
        merged, _ = self.merge(0, *parts)
        self.assertEqual({s for s, state in status(merged).items() if state == "ok"}, {"q2", "q5"})   # the whole report leaves out "stability", too
        self.assertEqual(sections(merged)[4], sections(whole)[4])

    def test_a_mesh_that_appears_in_a_data_folder_is_another_input(self):
        data, out = temporary_folder(self), temporary_folder(self) / "out"
        (data / "curvatures").mkdir()
        shutil.move(sample(data, "plane", "obj", 1), data / "curvatures" / "plane.obj")
        words = ["report", "--quick", "--size", 64, "--no-timings", "--out", out, "--only"]
        for first, second in (([], ["--data", data]), (["--data", data], [])):
            self.ended(0, *words, "q1", "--alone", *first)
            self.assertNotIn("another plane.obj", self.ended(0, *words, "q2", *first).stderr)
            self.assertIn("another plane.obj", self.ended(0, *words, "q2", *second).stderr)
            self.assertEqual(status(out)["q1"], "skipped")

    def test_a_damaged_report_is_not_renewed_in_part(self):
        out = self.copy()
        picture = next((out / "images").glob("q4_*.png"))
        picture.write_bytes(picture.read_bytes()[:-1])
        before = tree(out)
        process = self.ended(3, *QUICK, "--only", "q2", "--out", out)
        self.assertIn(picture.name, process.stderr)
        self.assertEqual(tree(out), before)

    # ---- report --part and merge

    def test_merged_parts_are_the_whole_report(self):
        for parts in (self.parts, self.parts[::-1], [*self.parts, *self.parts]):   # twice, because an undefined number must equal itself
            out, _ = self.merge(0, *parts)
            self.assertEqual(tree(out), tree(self.whole))

    def test_some_merged_parts_are_a_report_of_these_sections(self):
        out, _ = self.merge(0, self.parts[2], self.parts[1])
        other = temporary_folder(self) / "out"
        ids = [s for s, state in status(out).items() if state == "ok"]
        self.ended(0, *QUICK, "--only", ",".join(ids[::-1]), "--out", other)
        self.assertEqual(tree(out), tree(other))

    def test_the_paper_is_the_same(self):
        if not json.loads(run("doctor", "--json").stdout)["pdf_engine"]:
            self.skipTest("no PDF engine is here")
        whole, merged = temporary_folder(self) / "out", temporary_folder(self) / "out"
        self.ended(0, *QUICK, "--only", "q2,q3,q5", "--pdf", "require", "--out", whole)
        halves = [temporary_folder(self) / name for name in ("a", "b")]
        for half, some in zip(halves, ("q3", "q2,q5")):
            self.ended(0, "report", "--quick", "--size", 64, "--part", half, "--only", some, "--pdf", "require")
        self.ended(0, "merge", *halves, "--pdf", "require", "--out", merged)
        self.assertEqual(tree(merged), tree(whole))

    def test_parts_that_do_not_fit_are_refused_by_name(self):
        folder = temporary_folder(self)
        (folder / "my.toml").write_text("seed = 2\n")
        (folder / "own.toml").write_text('[report]\nauthor = "Ada"\n')
        mesh, other = sample(folder, "cube8"), sample(folder, "sphere")
        base, good = ["report", "--quick", "--size", 64], self.parts[1]
        cases = [(["--only", "q2", "--config", folder / "my.toml"], "seed 2, and not 1"), (["--only", "q2", mesh], "meshes cube8.obj, and not none"),
                 (["--only", "q2", "--size", 72], "size 72"), (["--only", "q2", "--camera", "1,2"], "camera 1, 2, 0, and not none"), (["--only", "q2", "--config", folder / "own.toml"], "author 'Ada', and not ''")]
        for number, (options, words) in enumerate(cases):
            part = folder / f"part{number}"
            self.ended(0, *[w for w in base if "--size" not in options or w not in ("--size", 64)], "--part", part, *options)
            out, process = self.merge(3, good, part)
            self.assertIn(words, process.stderr)
            self.assertIn(str(part), process.stderr)
            self.assertFalse(out.exists())
        one, two = folder / "one", folder / "two"
        self.ended(0, *base, "--part", one, "--only", "q1", mesh)
        shutil.copy(other, mesh)
        self.ended(0, *base, "--part", two, "--only", "q4", mesh)
        self.assertIn("another cube8.obj", self.merge(3, one, two)[1].stderr)
        self.merge(3, one, folder / "none")
        self.merge(2)
        self.ended(2, *base, "--part", one, "--out", two)

    def test_a_section_that_differs_in_two_parts_is_refused(self):
        part = temporary_folder(self) / "part"
        shutil.copytree(self.parts[1], part)
        results = (part / "results.json").read_text()
        (part / "results.json").write_text(results.replace('"title": "', '"title": "My ', 2))
        self.assertIn("title 'My ", self.merge(3, *self.parts, part)[1].stderr)
        (part / "results.json").write_text(results.replace('"measured": ', '"measured": 1', 1))
        self.assertRegex(self.merge(3, *self.parts, part)[1].stderr, "has another q[34]")

    def test_a_section_without_a_mesh_is_cached_for_every_mesh(self):
        folder = temporary_folder(self)
        words = [*QUICK, "--only", "q2,truth,q1", "--out", folder / "out", "--alone"]
        for number, mesh in enumerate((sample(folder, "cube8"), sample(folder, "sphere"))):
            stderr = self.ended(0, *words, mesh, XDG_CACHE_HOME=folder / "cache").stderr
            for section in ("q2", "truth"):
                self.assertEqual(f"{section}: from the cache" in stderr, number == 1, stderr)
            self.assertIn("q1: answered", stderr)

    # ---- checks for programs

    def test_checks_have_ids_of_their_own(self):
        ids = [check["id"] for section in sections(self.whole) for check in section["checks"]]
        self.assertEqual(len(set(ids)), len(ids))
        for section in sections(self.whole):
            for check in section["checks"]:
                self.assertRegex(check["id"], f"^{section['id']}(-[a-z0-9]+)+$")

    def junit(self, path):
        return {suite.get("name").split(":")[0]: suite for suite in xml.etree.ElementTree.parse(path).getroot().iter("testsuite")}

    def test_junit_has_every_check(self):
        out, path = self.copy(), temporary_folder(self) / "junit.xml"
        self.ended(0, *QUICK, "--only", "q2", "--out", out, "--junit", path)
        suites = self.junit(path)
        for section in sections(self.whole):
            suite = suites[section["id"]]
            self.assertEqual([case.get("name") for case in suite.iter("testcase")], [check["id"] for check in section["checks"]])
            found = {kind: sum(case.find(kind) is not None for case in suite.iter("testcase")) for kind in ("failure", "skipped", "error")}
            said = {kind: int(suite.get(name)) for kind, name in (("failure", "failures"), ("skipped", "skipped"), ("error", "errors"))}
            counted = {kind: sum(check["status"] == word for check in section["checks"]) for kind, word in (("failure", "failed"), ("skipped", "undecided"))}
            self.assertEqual((found, said), ({**counted, "error": 0},) * 2)
            self.assertEqual([child.tag for child in suite][:1] + [child.tag for child in suite][-2:], ["properties", "system-out", "system-err"])

    def test_junit_of_what_failed_and_inside_the_report(self):
        out = temporary_folder(self) / "out"
        self.ended(1, *QUICK, "--only", "q2", "--out", out, "--junit", out / "ci" / "junit.xml", MESHFOLIO_FAIL="q2")
        suites = self.junit(out / "ci" / "junit.xml")
        self.assertIn("MESHFOLIO_FAIL", suites["q2"].find("testcase/error").get("message"))
        self.assertEqual(suites["q1"].find("testcase/skipped").get("message"), "not asked for")
        self.assertIn("ci/junit.xml", (out / "SHA256SUMS").read_text())
        process = self.ended(4, *QUICK, "--only", "q2", "--out", out, "--junit", out.parent / "none" / "junit.xml")
        self.assertIn("junit.xml", process.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
