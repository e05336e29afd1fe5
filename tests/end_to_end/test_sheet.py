"""A report of the user's own: own meshes, another course's sheet (data/reports/fairing.toml), its submission and its marks."""

import json
import re
import shutil
import unittest
import zipfile

from folders import tree
from program import SOURCE, run, sample, temporary_folder

SMALL = ["--quick", "--size", 64, "--no-timings"]
PAGES = ("index.html", "appendix.html", "report.md", "appendix.md", "summary.md", "results.json")


def body(out, name="index.html"):
    """Returns the text of a page without tags, scripts and styles."""
    page = re.sub(r"<(script|style|svg)\b.*?</\1>", "", (out / name).read_text(), flags=re.DOTALL)
    return re.sub(r"\s+", " ", re.sub(r"<[^>]*>", "", page))


def chapters(out):
    return re.findall(r'<section class="question" id="([\w-]+)"', (out / "index.html").read_text())


class Sheet(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls)
        cls.cache = cls.folder / "cache"
        cls.out = cls.folder / "sheet"
        process = cls.ran("report", "--config", "fairing", *SMALL, "--out", cls.out)
        assert process.returncode == 0, process.stderr

    @classmethod
    def ran(cls, *words, **environment):
        return run(*words, XDG_CACHE_HOME=cls.cache, **environment)

    def ended(self, code, *words, **environment):
        process = self.ran(*words, **environment)
        self.assertEqual(process.returncode, code, process.stderr)
        return process

    def copy(self):
        out = temporary_folder(self) / "out"
        shutil.copytree(self.out, out)
        return out

    # ---- another course's sheet

    def test_it_has_its_questions_in_its_order_and_pages_between_them(self):
        self.assertEqual(chapters(self.out), ["page-1", "q4", "q3", "page-2", "q6", "page-3"])
        text = body(self.out)
        heads = ["Before you begin", "1The vibrations of a surface 10 points", "2What the operator measures 8 points",
                 "A word on stability", "3One large step 12 points", "What to hand in"]
        content = text[text.rindex("Questions attempted"):]
        found = [content.find(head, content.index("Before you begin")) for head in heads]
        self.assertEqual(found, sorted(found), list(zip(heads, found)))
        self.assertNotIn(-1, found)
        self.assertIn("3 of 3 questions answered", text)
        self.assertIn("Figure 1.1", text)
        self.assertIn("Question 2", text)   # of the introduction
        self.assertNotRegex(text, r"Question [4-9]|Not asked|not asked")

    def test_nothing_is_of_this_course(self):
        for name in PAGES:
            text = (self.out / name).read_text()
            self.assertIn("From vibrations to fair surfaces", text, name)
            self.assertNotRegex(text, "(?i)acquisition|coursework|your mesh", name)
        self.assertIn("Discrete Geometry, exercise sheet 4", body(self.out))

    def test_results_have_its_words_and_checks(self):
        results = json.loads((self.out / "results.json").read_text())
        asked = [question for question in results["questions"] if question["status"] != "skipped"]
        self.assertEqual([(q["id"], q["number"], q["points"]) for q in asked], [("q4", "1", 10), ("q3", "2", 8), ("q6", "3", 12)])
        self.assertEqual([page["before"] for page in results["pages"]], ["q4", "q6", ""])
        for question in asked:
            self.assertTrue(question["checks"])
            self.assertTrue(all(check["status"] != "failed" for check in question["checks"]))
        self.assertEqual({mesh["stand_in"] for question in asked for mesh in question["inputs"]}, {False})

    def test_renewed_merged_and_rendered_it_is_the_same(self):
        words = ["report", "--config", "fairing", *SMALL]
        out = self.copy()
        self.ended(0, *words, "--only", "q3", "--no-cache", "--out", out)
        self.assertEqual(tree(out), tree(self.out))
        parts = [temporary_folder(self) / name for name in ("q6", "q34")]
        for part, some in zip(parts, ("q6", "q4,q3")):
            self.ended(0, *words, "--part", part, "--only", some)
        self.ended(0, "merge", *parts, "--out", out)
        self.assertEqual(tree(out), tree(self.out))
        self.ended(0, "report", "--from", self.out / "results.json", "--out", out)
        self.assertEqual(tree(out), tree(self.out))
        plain = temporary_folder(self) / "plain"   # other words on finished results
        self.ended(0, *words, "--out", plain, "--title", "Mine", "--course", "None of yours")
        self.ended(0, "report", "--from", plain / "results.json", "--config", "fairing", "--out", out)
        self.assertEqual(tree(out), tree(self.out))

    def test_words_that_are_gone_from_the_settings_are_gone_from_a_renewed_report(self):
        out, folder = self.copy(), temporary_folder(self)
        sheet = (SOURCE / "data" / "reports" / "fairing.toml").read_text()
        (folder / "my.toml").write_text(re.sub(r"(?m)^(title = \"What the|number|points|sections).*$", "", sheet).replace("[[item]]", "[[page]]\ntitle = 'New'\ntext = '*New*'\n[[item]]", 1))
        self.ended(0, "report", "--config", folder / "my.toml", *SMALL, "--only", "q6", "--out", out)
        self.assertEqual(chapters(out), ["q3", "page-1", "q4", "page-2", "q6", "page-3", "page-4"])
        self.assertNotIn("What the operator measures", body(out))

    def test_it_is_submitted_with_a_name_in_one_command(self):
        out = self.copy()
        self.ended(1, "submit", "--out", out, "--author", "Ada", "--without-pdf")   # four questions are missing
        self.assertEqual(tree(out), tree(self.out))
        self.ended(0, "submit", "--out", out, "--author", "Ada <b>", "--config", "fairing", "--without-pdf", "--without-tests")
        self.assertIn("Ada &lt;b&gt;", (out / "index.html").read_text())
        with zipfile.ZipFile(out / "submission.zip") as packed:
            names = packed.namelist()
            how_to = packed.read("INSTRUCTIONS.md").decode()
        self.assertIn("Discrete Geometry, exercise sheet 4", how_to)
        self.assertNotIn("run-tests", how_to)
        self.assertIn("| Q1 |", how_to)
        self.assertEqual([name for name in names if name.startswith("source/tests/")], ["source/tests/setup.sh"])
        self.assertIn("source/src/main.cpp", names)

    def test_its_rubric_is_in_the_same_file(self):
        folder = temporary_folder(self)
        student = folder / "ada"
        student.mkdir()
        self.ended(0, "spectrum", sample(folder, "creature"), "-k", 20, "--csv", student / "modes.csv")
        self.ended(0, "smooth", sample(folder, "bumpy_cube"), "-o", student / "fair.ply", "--scheme", "implicit", "--lambda", 100, "--unit", "tau")
        self.ended(0, "mark", student, "--rubric", "fairing", "--out", folder / "marks")
        self.assertRegex((folder / "marks" / "class.csv").read_text(), "ada,.*22")
        self.assertIn("From vibrations to fair surfaces", body(folder / "marks", "class.html"))
        (folder / "my.toml").write_text("[[item]]\nid = 'a'\nwhat = 'number'\nvalue = 1\npoints = 1\n[reprot]\ntitle = 'T'\n")
        process = self.ended(2, "mark", student, "--rubric", folder / "my.toml", "--out", folder / "marks")
        self.assertIn("my.toml:6: unknown table 'reprot'; did you mean 'report'?", process.stderr)

    def test_hostile_titles_stay_text(self):
        folder, title = temporary_folder(self), '</title><script>alert(1)</script> [x](javascript:1) | **a** {{title}} $x$ `c`'
        (folder / "my.toml").write_text(f"[report]\ntitle = '{title}'\ncourse = '{title}'\nsections = 'q2'\n[[question]]\nid = 'q2'\ntitle = '{title}'\n"
                                        f"[[page]]\ntitle = '{title}'\ntext = '<img src=x onerror=alert(1)> [x](javascript:1)'\n")
        self.ended(0, "report", "--config", folder / "my.toml", *SMALL, "--out", folder / "out")
        for name in ("index.html", "appendix.html"):
            page = (folder / "out" / name).read_text()
            self.assertNotIn("<script>alert", page)
            self.assertNotIn("<img src=x", page)
        self.assertIn(title, body(folder / "out").replace("&lt;", "<").replace("&gt;", ">"))
        markdown = (folder / "out" / "report.md").read_text()
        self.assertNotRegex(markdown, r"<script|<img src=x|(?<!\\)\]\(javascript")

    # ---- own meshes

    def test_own_meshes_are_named_and_no_course_is(self):
        folder = temporary_folder(self)
        for name, mesh in (("spot", "cube8"), ("bunny", "torus")):
            shutil.move(sample(folder, mesh), folder / f"{name}.obj")
        words = ["report", folder / "spot.obj", folder / "bunny.obj", *SMALL, "--only", "q1,q3"]
        out = folder / "out"
        self.ended(0, *words, "--out", out)
        text = body(out)
        self.assertIn("Curvature and Laplacian smoothing of spot and bunny", text)
        self.assertRegex(text, "On 2 meshes ?: spot,? bunny")
        self.assertEqual(chapters(out), ["q1", "q3"])
        self.assertFalse((out / "src.txt").exists())
        for name in PAGES:
            self.assertNotRegex((out / name).read_text(), "(?i)acquisition|coursework|your mesh|src\\.txt|Not asked for in", name)
        roles = {mesh["role"] for q in json.loads((out / "results.json").read_text())["questions"] for mesh in q["inputs"]}
        self.assertEqual(roles, {"spot", "bunny"})
        self.ended(0, *words, "--out", out, "--title", "Two <i>friends</i>", "--course", "A & B")
        self.assertIn("A &amp; B", (out / "index.html").read_text())
        self.assertIn("Two &lt;i&gt;friends", (out / "index.html").read_text())

    def test_a_submission_of_own_meshes_has_the_source(self):
        folder = temporary_folder(self)
        out = folder / "out"
        self.ended(0, "report", sample(folder, "cube8"), *SMALL, "--only", "q2", "--out", out)
        (folder / "my.toml").write_text("[report]\nsections = 'q2'\n")
        self.assertFalse((out / "src.txt").exists())
        self.ended(0, "submit", "--out", out, "--author", "Ada", "--config", folder / "my.toml", "--without-pdf")
        self.assertIn("L", re.search(r"<td>(L\d+)</td>", (out / "index.html").read_text())[1])
        with zipfile.ZipFile(out / "submission.zip") as packed:
            self.assertIn("src.txt", packed.namelist())
            self.assertIn("meshes that are not part of the source", packed.read("INSTRUCTIONS.md").decode())

    def test_without_source_nothing_cites_it(self):
        out = temporary_folder(self) / "out"
        self.ended(0, "report", *SMALL, "--only", "q2", "--no-source", "--out", out)
        self.assertFalse((out / "src.txt").exists())
        for name in ("index.html", "report.md"):
            self.assertNotIn("src.txt", (out / name).read_text())
        self.assertIn("coursework 2", body(out))

    def test_batch_knows_the_words_of_finished_reports(self):
        folder = temporary_folder(self)
        words = ["batch", sample(folder, "cube8"), "--size", 64, "--no-timings", "--only", "q2,q3", "--out", folder / "all"]
        self.ended(0, *words)
        self.assertIn("smoothing of cube8", body(folder / "all" / "cube8"))
        self.assertFalse((folder / "all" / "cube8" / "src.txt").exists())
        self.assertIn("1 done before", self.ended(0, *words).stderr)
        self.assertNotIn("done before", self.ended(0, *words, "--title", "New").stderr)
        self.assertIn("New", body(folder / "all" / "cube8"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
