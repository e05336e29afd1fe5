"""report.pdf as a user gets it, judged by other programs: poppler and qpdf."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from program import PROGRAM, run, temporary_folder

MOST_PAGES = 60
MOST_BYTES = 15 * 1000 * 1000


def output_of(*words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=True, timeout=120).stdout


def engine():
    """The version of the engine that meshfolio finds; None: none."""
    found = json.loads(run("doctor", "--json").stdout)["pdf_engine"]
    return found["version"] if found else None


def reason_to_skip():
    missing = [name for name in ("pdfinfo", "pdffonts", "pdfimages", "pdftotext", "qpdf") if not shutil.which(name)]
    if missing:
        return "not installed: " + ", ".join(missing)
    version = engine()
    if version is None:
        return "no PDF engine"
    return "" if not version.startswith("WeasyPrint") else "only the fallback engine is here"


def report(out, *arguments, cwd=None, **environment):
    return run("report", "--quick", "--size", 96, "--only", "q1,q2,q5,preflight", "--pdf", "require", "--out", out, *arguments, cwd=cwd, **environment)


class Printed(unittest.TestCase):
    """One small report printed once, looked at from all sides."""

    @classmethod
    def setUpClass(cls):
        why = reason_to_skip()
        if why:
            print("SKIPPED test_pdf: " + why, file=sys.stderr)
            raise unittest.SkipTest(why)
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="meshfolio-test-")))
        cls.home = cls.folder / "home"
        cls.home.mkdir()
        process = report(cls.folder / "out", HOME=str(cls.home))
        assert process.returncode == 0, process.stderr
        cls.pdf = cls.folder / "out" / "report.pdf"
        cls.json = json.loads(output_of("qpdf", "--json=2", "--json-key=outlines", "--json-key=attachments", cls.pdf))
        cls.page = (cls.folder / "out" / "index.html").read_text()

    def test_is_sound_and_small(self):
        output_of("qpdf", "--check", self.pdf)
        self.assertLessEqual(self.pdf.stat().st_size, MOST_BYTES)
        pages = int(re.search(r"Pages: +(\d+)", output_of("pdfinfo", self.pdf))[1])
        self.assertTrue(1 <= pages <= MOST_PAGES, pages)

    def test_says_what_it_is(self):
        said = output_of("pdfinfo", self.pdf)
        self.assertRegex(said, r"Tagged: +yes")
        self.assertRegex(said, r"Title: +Curvature and Laplacian smoothing")
        self.assertRegex(said, r"Creator: +meshfolio ")
        self.assertRegex(said, r"Page size: +59[45].* \(A4\)")

    def test_every_font_is_embedded_and_none_is_of_type_3(self):
        fonts = output_of("pdffonts", self.pdf).splitlines()[2:]
        self.assertTrue(fonts)
        for font in fonts:
            self.assertNotIn("Type 3", font)
            self.assertRegex(font, r" yes +(yes|no) +(yes|no) +\d+ +\d+$", font)
        self.assertIn("DejaVuMathTeXGyre", "".join(fonts))   # of the formulas

    def test_nothing_of_this_machine_is_inside(self):
        plain = self.folder / "plain.pdf"
        output_of("qpdf", "--qdf", "--object-streams=disable", self.pdf, plain)
        inside = plain.read_bytes()
        for word in (b"file://", str(self.folder).encode(), b"/tmp/", b"meshfolio-print"):
            self.assertNotIn(word, inside)

    def test_the_engine_leaves_nothing_at_home(self):
        self.assertEqual(list(self.home.iterdir()), [])

    def test_the_results_are_attached_without_timings(self):
        name = self.json["attachments"]
        self.assertEqual(list(name), ["results.json"])
        attached = subprocess.run(["qpdf", "--show-attachment=results.json", self.pdf], capture_output=True, check=True).stdout
        expected = json.loads((self.folder / "out" / "results.json").read_text())
        del expected["timings"]
        for section in expected["questions"] + expected["supporting"]:
            del section["timings"]
        self.assertEqual(json.loads(attached), expected)
        self.assertNotIn(b'"timings"', attached)

    def test_the_outline_has_the_sections(self):
        top = self.json["outlines"]
        self.assertEqual(len(top), 1)
        self.assertEqual(top[0]["title"], "Curvature and Laplacian smoothing of triangle meshes")
        results = json.loads((self.folder / "out" / "results.json").read_text())
        titles = [entry["title"] for entry in top[0]["kids"]]
        for section in results["questions"] + results["supporting"]:
            self.assertTrue(any(re.fullmatch(r"\w+ " + re.escape(section["title"]), title) for title in titles), (section["title"], titles))
        pages = [entry["destpageposfrom1"] for entry in top[0]["kids"]]
        self.assertEqual(pages, sorted(pages))

    def contents_of(self, pdf):
        pages = output_of("pdftotext", "-layout", pdf, "-").split("\f")
        return next(page for page in pages if re.search(r"^ *Contents", page, re.M))

    def test_the_contents_name_the_pages_that_the_outline_leads_to(self):
        out = self.folder / "whole"
        process = run("report", "--size", 96, "--only", "q2,preflight", "--pdf", "require", "--out", out)
        self.assertEqual(process.returncode, 0, process.stderr)
        outlines = json.loads(output_of("qpdf", "--json=2", "--json-key=outlines", out / "report.pdf"))["outlines"]
        entries = {entry["title"]: entry["destpageposfrom1"] for entry in outlines[0]["kids"]}
        for title in ("References", "Provenance"):
            self.assertRegex(self.contents_of(out / "report.pdf"), rf"{title} +{entries[title]}\b")

    def test_a_first_look_has_no_page_numbers_in_its_contents(self):
        self.assertRegex(self.contents_of(self.pdf), r"(?m)(Provenance|References) *$")
        self.assertNotIn("@page", self.contents_of(self.pdf))

    def test_pages_are_numbered(self):
        pages = output_of("pdftotext", "-layout", self.pdf, "-").split("\f")[:-1]
        for number, page in enumerate(pages[1:], 2):
            self.assertRegex(page, rf"\b{number} / {len(pages)}\b")

    def test_no_figure_is_cut(self):
        """Every picture is placed once, whole: a cut one is on two pages. And its caption is on its page."""
        placed = {}
        for line in output_of("pdfimages", "-list", self.pdf).splitlines()[2:]:
            words = line.split()
            placed.setdefault(words[10], []).append(int(words[0]))
            self.assertEqual(words[8], "jpeg")   # passed through, not coded again
        self.assertTrue(placed)
        for number, pages in placed.items():
            self.assertEqual(len(pages), 1, (number, pages))
        text = output_of("pdftotext", "-layout", self.pdf, "-").split("\f")
        for pages in placed.values():
            if pages != [1] and pages != [2]:   # the title picture has no caption
                self.assertRegex(text[pages[0] - 1], r"Figure [0-9A-Z]+\.\d+\.")


    def test_words_of_figures_are_seven_points_high_at_least(self):
        """Names of views and notes of legends: they are text, and a box around a word is at least as high as its font is large."""
        heights = [(float(match["bottom"]) - float(match["top"]), match["word"]) for match in re.finditer(
            r'<word xMin="[^"]*" yMin="(?P<top>[^"]*)" xMax="[^"]*" yMax="(?P<bottom>[^"]*)">(?P<word>[+-][xyz]|above|below|undefined)</word>',
            output_of("pdftotext", "-bbox-layout", self.pdf, "-"))]
        self.assertGreaterEqual({word for _, word in heights}, {"+x", "-z"})
        of_the_em = 1.164   # DejaVu Sans, from descender to ascender
        self.assertGreaterEqual(min(heights)[0] / of_the_em, 7, min(heights))


class Again(unittest.TestCase):

    def setUp(self):
        if reason_to_skip():
            self.skipTest(reason_to_skip())
        self.folder = temporary_folder(self)

    def test_equal_bytes_from_another_folder_with_and_without_timings(self):
        (self.folder / "deep" / "er").mkdir(parents=True)
        (self.folder / "tmp").mkdir()
        one = self.folder / "one"
        other = self.folder / "deep" / "er" / "other # 100%"
        self.assertEqual(report(one).returncode, 0)
        process = report(other, "--no-timings", "--threads", 1, cwd=self.folder, TMPDIR=str(self.folder / "tmp"), TZ="Asia/Tokyo")
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual((one / "report.pdf").read_bytes(), (other / "report.pdf").read_bytes())
        self.assertEqual(list((self.folder / "tmp").iterdir()), [])

    def test_the_date_is_that_of_source_date_epoch(self):
        self.assertEqual(run("report", "--quick", "--size", 64, "--only", "q2", "--pdf", "require", "--out", self.folder / "out", SOURCE_DATE_EPOCH="1700000000").returncode, 0)
        self.assertIn("D:20231114221320Z", output_of("pdfinfo", "-rawdates", self.folder / "out" / "report.pdf"))


class Engines(unittest.TestCase):
    """What happens without one, or with one that does not do its work."""

    def setUp(self):
        self.folder = temporary_folder(self)
        self.bin = self.folder / "bin"
        self.bin.mkdir()

    def browser(self, script):
        path = self.bin / "browser"
        path.write_text("#!/bin/sh\nif [ \"$1\" = --version ]; then echo Chromium 150.0; exit 0; fi\n" + script)
        path.chmod(0o755)
        return path

    def report(self, *arguments, **environment):
        return run("report", "--quick", "--size", 64, "--only", "q2", "--out", self.folder / "out", *arguments, HOME=str(self.folder), **environment)

    def test_required_and_missing_ends_before_any_work(self):
        process = self.report("--pdf", "require", PATH=str(self.bin))
        self.assertEqual(process.returncode, 5)
        self.assertIn("no PDF engine", process.stderr)
        self.assertNotIn("q2", process.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_missing_and_not_required_is_one_warning(self):
        process = self.report("--pdf", "auto", PATH=str(self.bin))
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual(process.stderr.count("no PDF engine"), 1)
        self.assertTrue((self.folder / "out" / "index.html").exists())
        self.assertFalse((self.folder / "out" / "report.pdf").exists())

    def test_off_asks_for_none(self):
        process = self.report("--pdf", "off", "--pdf-browser", self.browser("exit 1"))
        self.assertEqual(process.returncode, 0)
        self.assertNotIn("warning", process.stderr)
        self.assertFalse((self.folder / "out" / "report.pdf").exists())

    def test_one_that_prints_nothing_is_not_believed(self):
        for script in ("exit 0", "echo crashed >&2; kill -SEGV $$", 'for a; do case $a in --print-to-pdf=*) echo no PDF > "${a#*=}";; esac; done'):
            with self.subTest(script=script):
                process = self.report("--pdf", "auto", "--pdf-browser", self.browser(script))
                self.assertEqual(process.returncode, 0, process.stderr)
                self.assertEqual(process.stderr.count("no report.pdf"), 1, process.stderr)
                self.assertFalse((self.folder / "out" / "report.pdf").exists())
                shutil.rmtree(self.folder / "out")
                process = self.report("--pdf", "require", "--pdf-browser", self.browser(script))
                self.assertEqual(process.returncode, 5, process.stderr)
                self.assertFalse((self.folder / "out").exists())

    def test_an_interrupt_ends_the_engine_too(self):
        note = self.folder / "pid"
        browser = self.browser(f"echo $$ > {note}.part; mv {note}.part {note}; exec sleep 300")
        words = [PROGRAM, "report", "--quick", "--size", "64", "--only", "q2", "--pdf", "auto", "--pdf-browser", browser, "--out", self.folder / "out"]
        (self.folder / "tmp").mkdir()
        process = subprocess.Popen([str(word) for word in words], stderr=subprocess.PIPE, env={**os.environ, "TMPDIR": str(self.folder / "tmp")})
        deadline = time.monotonic() + 240
        while not note.exists() and time.monotonic() < deadline:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        status = Path(f"/proc/{note.read_text().strip()}/cmdline")
        while status.exists() and status.read_bytes() and time.monotonic() < deadline:   # a zombie has none
            time.sleep(0.05)
        self.assertFalse(status.exists() and status.read_bytes())
        self.assertFalse((self.folder / "out").exists())
        self.assertEqual(list((self.folder / "tmp").iterdir()), [])

    def test_weasyprint_serves_when_there_is_no_browser(self):
        program = shutil.which("weasyprint")
        if not program:
            self.skipTest("weasyprint is not installed")
        process = self.report("--pdf", "require", "--pdf-browser", program)
        self.assertEqual(process.returncode, 0, process.stderr)
        pdf = self.folder / "out" / "report.pdf"
        self.assertIn("Contents", output_of("pdftotext", pdf, "-"))


class Design(unittest.TestCase):

    def test_the_page_itself_may_be_set_as_for_paper(self):
        folder = temporary_folder(self)
        (folder / "plain.toml").write_text('[report]\ntemplate = "print"\n')
        process = run("report", "--quick", "--size", 64, "--only", "q2", "--pdf", "off", "--config", folder / "plain.toml", "--out", folder / "out")
        self.assertEqual(process.returncode, 0, process.stderr)
        page = (folder / "out" / "index.html").read_text()
        self.assertNotIn("<script", page)
        self.assertNotIn("@page:", page)
        self.assertIn("script-src &apos;none&apos;" if "&apos;" in page else "script-src &#39;none&#39;", page)


if __name__ == "__main__":
    unittest.main()
