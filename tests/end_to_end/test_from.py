"""`report --from results.json` makes the same report from its own files, with other words if they are given."""

import json
import unittest

from folders import tree
from program import run, temporary_folder
from test_report import QUESTIONS


class From(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls)
        cls.out = cls.folder / "out"
        cls.process = run("report", "--quick", "--size", 64, "--only", "q2,q5", "--out", cls.out)
        assert cls.process.returncode == 0, cls.process.stderr

    def again(self, *options, source=None, expected=0):
        target = temporary_folder(self) / "again"
        process = run("report", "--from", source or self.out / "results.json", "--out", target, *options)
        self.assertEqual(process.returncode, expected, process.stderr)
        return target, process

    def copy(self):
        folder = temporary_folder(self) / "copy"
        folder.mkdir()
        for path in self.out.rglob("*"):
            if path.is_file():
                target = folder / path.relative_to(self.out)
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(path.read_bytes())
        return folder

    def test_every_file_is_the_same(self):
        target, _ = self.again()
        self.assertEqual(tree(target), tree(self.out))

    def test_it_may_replace_the_report_it_comes_from(self):
        copy = self.copy()
        process = run("report", "--from", copy / "results.json", "--out", copy)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual(tree(copy), tree(self.out))

    def test_other_words_change_the_page_and_nothing_else(self):
        config = temporary_folder(self) / "my.toml"
        config.write_text('[report]\ntitle = "Another title"\nauthor = "Someone else"\ncourse = "Another course"\n')
        target, _ = self.again("--config", config)
        for name in ("index.html", "appendix.html", "report.md", "appendix.md"):
            for words in ["Another title", "Someone else", "Another course"]:
                self.assertIn(words, (target / name).read_text(), name)
        before, after = tree(self.out), tree(target)
        changed = {name for name in before if before[name] != after.get(name)}
        self.assertEqual(changed, {"index.html", "appendix.html", "report.md", "appendix.md", "summary.md", "results.json", "SHA256SUMS"})

    def test_custom_templates(self):
        templates = temporary_folder(self)
        (templates / "report.md").write_text("{{{title}}}\n{{#sections}}{{id}} {{/sections}}\n")
        target, _ = self.again("--templates", templates)
        self.assertEqual((target / "report.md").read_text().splitlines()[-1].split(), ["q2", "q5"])   # no other was asked for
        self.assertEqual((target / "appendix.md").read_text().splitlines()[-1].split(), ["q5"])   # its further tables

    def test_a_missing_picture_is_reported_and_boxed(self):
        copy = self.copy()
        results = json.loads((copy / "results.json").read_text())
        sheet = results["questions"][4]["figures"][0]["sheet"]
        (copy / sheet).unlink()
        target, process = self.again(source=copy / "results.json")
        self.assertIn(f"{sheet} is missing", process.stderr)
        self.assertIsNone(json.loads((target / "results.json").read_text())["questions"][4]["figures"][0]["sheet"])

    def test_a_damaged_picture_is_refused(self):
        copy = self.copy()
        picture = sorted((copy / "images").glob("q5_*.png"))[0]
        picture.write_bytes(picture.read_bytes()[:-20])
        _, process = self.again(source=copy / "results.json", expected=3)
        self.assertIn("SHA256SUMS", process.stderr)

    def test_broken_results_are_refused_with_their_place(self):
        copy = self.copy()
        results = json.loads((copy / "results.json").read_text())
        results["questions"][0]["title"] = 5
        (copy / "results.json").write_text(json.dumps(results, indent=1))
        _, process = self.again(source=copy / "results.json", expected=3)
        self.assertRegex(process.stderr, r"results\.json:\d+: questions\[0\]\.title is the integer 5, not a text")

    def test_the_environment_is_read_and_checked(self):
        folder = temporary_folder(self)
        process = run("report", "--from", self.out / "results.json", MESHFOLIO_OUT=folder / "elsewhere")
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual(tree(folder / "elsewhere"), tree(self.out))
        self.again("--threads", "abc", expected=2)

    def test_a_failed_section_stays_failed(self):
        folder = temporary_folder(self)
        words = ["report", "--quick", "--size", 64, "--only", "q2", "--no-cache", "--out", folder / "failed"]
        self.assertEqual(run(*words, MESHFOLIO_FAIL="q2").returncode, 1)
        _, process = self.again(source=folder / "failed" / "results.json", expected=1)
        self.assertIn("q2 failed", process.stderr)

    def test_an_undecided_check_is_reported_and_is_no_failure(self):
        copy = self.copy()
        results = json.loads((copy / "results.json").read_text())
        check = next(q for q in results["questions"] if q["id"] == "q2")["checks"][0]
        check.update(status="undecided", passed=None, measured=None, note="rounding is larger than the margin")
        (copy / "results.json").write_text(json.dumps(results))
        target, process = self.again(source=copy / "results.json")
        self.assertIn("meshfolio: 1 check undecided, which is no failure", process.stderr)
        self.assertNotIn("check failed", process.stderr)
        total = sum(len(s["checks"]) for s in results["questions"] + results["supporting"])
        score = f"{total - 1} of {total} checks passed, 1 undecided"
        self.assertIn(score, (target / "report.md").read_text())
        self.assertIn(score, (target / "summary.md").read_text())
        self.assertIn(f"<b>{total - 1}</b> of {total} checks passed, 1 undecided", (target / "index.html").read_text())
        for name in ("appendix.html", "appendix.md", "summary.md"):
            self.assertIn("rounding is larger than the margin", (target / name).read_text(), name)
        check.update(status="failed", passed=False)
        (copy / "results.json").write_text(json.dumps(results))
        _, process = self.again(source=copy / "results.json", expected=1)
        self.assertIn("check failed", process.stderr)

    def test_results_of_another_version_are_refused(self):
        copy = self.copy()
        results = json.loads((copy / "results.json").read_text())
        results["schema_version"] -= 1
        (copy / "results.json").write_text(json.dumps(results, indent=1))
        _, process = self.again(source=copy / "results.json", expected=3)
        self.assertRegex(process.stderr, r"results\.json:2: schema_version is '0', not 1")

    def test_nothing_can_be_computed(self):
        _, process = self.again("--only", "q2", expected=2)
        self.assertIn("--only cannot be given with --from", process.stderr)
        self.again(source=self.out / "none.json", expected=3)


class Templates(unittest.TestCase):
    def test_exported_templates_give_the_same_page(self):
        folder = temporary_folder(self)
        self.assertEqual(run("templates", folder / "mine").returncode, 0)
        for name, options in [("a", []), ("b", ["--templates", folder / "mine"])]:
            words = ["report", "--quick", "--size", 64, "--only", "q2", "--no-timings", "--out", folder / name]
            self.assertEqual(run(*words, *options, XDG_CACHE_HOME=folder / "cache").returncode, 0)
        self.assertEqual(tree(folder / "a"), tree(folder / "b"))

    def test_existing_templates_are_not_replaced(self):
        folder = temporary_folder(self)
        (folder / "report.md").write_text("mine")
        process = run("templates", folder)
        self.assertEqual(process.returncode, 4)
        self.assertEqual([p.name for p in folder.iterdir()], ["report.md"])
        self.assertEqual(run("templates", folder, "--force").returncode, 0)
        self.assertNotEqual((folder / "report.md").read_text(), "mine")

    def test_tags_are_listed(self):
        process = run("templates", "--tags")
        self.assertIn("sections.blocks.caption", process.stdout)
        self.assertEqual(run("templates").returncode, 2)


if __name__ == "__main__":
    unittest.main()
