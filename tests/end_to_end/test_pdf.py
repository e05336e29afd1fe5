"""Tests report.pdf and appendix.pdf with other programs: poppler and qpdf."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

from program import PROGRAM, run, temporary_folder

MOST_PAGES = 60
MOST_BYTES = 15 * 1000 * 1000


VOLUMES = ("report.pdf", "appendix.pdf")
TITLES = {"report.pdf": "Curvature and Laplacian smoothing of triangle meshes",
          "appendix.pdf": "Appendix to “Curvature and Laplacian smoothing of triangle meshes”"}


def output_of(*words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=True, timeout=120).stdout


def engine():
    """Returns the version of the engine that meshfolio finds; None if there is none."""
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


def report(out, *arguments, only="q1,q2,q5,certificates", cwd=None, **environment):
    return run("report", "--quick", "--size", 96, "--only", only, "--pdf", "require", "--out", out, *arguments, cwd=cwd, **environment)


class Printed(unittest.TestCase):
    """One small report, printed once for all tests."""

    @classmethod
    def setUpClass(cls):
        why = reason_to_skip()
        if why:
            print("SKIPPED test_pdf: " + why, file=sys.stderr)
            raise unittest.SkipTest(why)
        cls.folder = temporary_folder(cls)
        cls.home = cls.folder / "home"
        cls.home.mkdir()
        process = report(cls.folder / "out", HOME=str(cls.home))
        assert process.returncode == 0, process.stderr
        cls.pdfs = {name: cls.folder / "out" / name for name in VOLUMES}
        cls.pdf = cls.pdfs["report.pdf"]
        cls.results = json.loads((cls.folder / "out" / "results.json").read_text())

    def structure(self, path):
        return json.loads(output_of("qpdf", "--json=2", "--json-key=outlines", "--json-key=attachments", path))

    def test_is_sound_and_small(self):
        for _, path in self.pdfs.items():
            output_of("qpdf", "--check", path)
            self.assertLessEqual(path.stat().st_size, MOST_BYTES)
            pages = int(re.search(r"Pages: +(\d+)", output_of("pdfinfo", path))[1])
            self.assertTrue(1 <= pages <= MOST_PAGES, pages)

    def test_has_title_author_and_language(self):
        for name, path in self.pdfs.items():
            said = output_of("pdfinfo", path)
            self.assertRegex(said, r"Tagged: +yes")
            self.assertRegex(said, r"Title: +" + ("" if name == "report.pdf" else "Appendix to ") + "Curvature and Laplacian smoothing")
            self.assertRegex(said, r"Creator: +meshfolio ")
            self.assertRegex(said, r"Page size: +59[45].* \(A4\)")

    def test_every_font_is_one_of_ours_embedded_and_none_is_of_type_3(self):
        for name, path in self.pdfs.items():
            fonts = output_of("pdffonts", path).splitlines()[2:]
            self.assertTrue(fonts)
            for font in fonts:
                self.assertRegex(font, r"^[A-Z]{6}\+Report(Serif|Sans|Math|Mono)-\w+ +CID TrueType ", "a font of this machine, or of type 3")
                self.assertRegex(font, r" yes +(yes|no) +(yes|no) +\d+ +\d+$", font)
            if name == "report.pdf":
                self.assertIn("ReportMath", "".join(fonts))   # of the formulas

    def test_nothing_of_this_machine_is_inside(self):
        for _, path in self.pdfs.items():
            plain = self.folder / "plain.pdf"
            output_of("qpdf", "--qdf", "--object-streams=disable", path, plain)
            inside = plain.read_bytes()
            for word in (b"file://", str(self.folder).encode(), b"/tmp/", b"meshfolio-print"):
                self.assertNotIn(word, inside)

    def test_the_engine_leaves_nothing_at_home(self):
        self.assertEqual(list(self.home.iterdir()), [])

    def test_the_results_are_attached_once_without_timings(self):
        self.assertEqual([list(self.structure(path)["attachments"]) for path in self.pdfs.values()], [["results.json"], []])
        attached = subprocess.run(["qpdf", "--show-attachment=results.json", self.pdf], capture_output=True, check=True).stdout
        expected = json.loads(json.dumps(self.results))
        del expected["timings"]
        for section in expected["questions"] + expected["supporting"]:
            del section["timings"]
        self.assertEqual(json.loads(attached), expected)
        self.assertNotIn(b'"timings"', attached)

    def test_the_outline_has_the_sections(self):
        questions = [section["title"] for section in self.results["questions"] if section["status"] != "skipped"]
        asked = {section["title"]: section for section in self.results["questions"] if "appendix_from" in section}
        further = [f"{title}: further tables and figures" for title, section in asked.items() if section["appendix_from"] < len(section["blocks"])]
        sections = {"report.pdf": questions, "appendix.pdf": further + [section["title"] for section in self.results["supporting"] if section["status"] != "skipped"]}
        for name, path in self.pdfs.items():
            top = self.structure(path)["outlines"]
            self.assertEqual([entry["title"] for entry in top], [TITLES[name]])
            titles = [entry["title"] for entry in top[0]["kids"]]
            numbered = [title.split(" ", 1)[1] for title in titles if re.match(r"[0-9A-Z] ", title)]
            self.assertEqual(numbered, sections[name])
            pages = [entry["destpageposfrom1"] for entry in top[0]["kids"]]
            self.assertEqual(pages, sorted(pages))

    def pages_of(self, path):
        return output_of("pdftotext", "-layout", path, "-").split("\f")[:-1]

    def contents_of(self, folder):
        """Returns the text of the first page of the report and of the contents of the appendix."""
        contents = next(page for page in self.pages_of(folder / "appendix.pdf") if re.search(r"^ *Contents", page, re.M))
        return self.pages_of(folder / "report.pdf")[0], contents

    def test_the_contents_name_the_pages_that_the_outline_leads_to(self):
        out = self.folder / "whole"
        process = run("report", "--size", 96, "--only", "q2,certificates", "--pdf", "require", "--out", out)
        self.assertEqual(process.returncode, 0, process.stderr)
        table, contents = self.contents_of(out)
        for name, text, line in (("report.pdf", table, r"(?ms)^ *{number} +{first_word}\b.*? {page}$"),
                                 ("appendix.pdf", contents, r"(?ms)\b{number} +{first_word}\b.*? {page}\b")):
            entries = self.structure(out / name)["outlines"][0]["kids"]
            for entry in entries:
                if numbered := re.match(r"(?P<number>[0-9A-Z]) (?P<first_word>\w+)", entry["title"]):
                    self.assertRegex(text, line.format(page=entry["destpageposfrom1"], **numbered.groupdict()))
        provenance = self.structure(out / "appendix.pdf")["outlines"][0]["kids"][-1]
        self.assertEqual(provenance["title"], "Provenance")
        self.assertRegex(contents, rf"Provenance +{provenance['destpageposfrom1']}\b")

    def test_a_first_look_has_no_page_numbers_in_its_contents(self):
        table, contents = self.contents_of(self.folder / "out")
        self.assertRegex(contents, r"(?m)Provenance *$")
        self.assertNotRegex(table, r"(?m) Page$")
        self.assertNotIn("@page", table + contents)

    def test_pages_are_numbered(self):
        for _, path in self.pdfs.items():
            pages = self.pages_of(path)
            for number, page in enumerate(pages[1:], 2):
                self.assertRegex(page, rf"\b{number} ?/ ?{len(pages)}\b")

    def test_no_figure_is_cut(self):
        """Every picture is on one page, with its caption."""
        for name, path in self.pdfs.items():
            placed = {}
            for line in output_of("pdfimages", "-list", path).splitlines()[2:]:
                words = line.split()
                placed.setdefault(words[10], []).append(int(words[0]))
                self.assertEqual(words[8], "jpeg")   # passed through, not coded again
            self.assertTrue(placed or name == "appendix.pdf")
            text = self.pages_of(path)
            for number, pages in placed.items():
                if name == "report.pdf" and pages[0] == 1:   # the title picture and its figure are one picture
                    pages = pages[1:] or pages
                self.assertEqual(len(set(pages)), 1, (number, pages))
                if name == "appendix.pdf" or pages[0] > 2:   # the title picture has no caption
                    self.assertRegex(text[pages[0] - 1], r"Figure [0-9A-Z]+\.\d+\.")

    def test_every_link_leads_somewhere(self):
        """Links stay within their volume: references to the other volume are text."""
        for _, path in self.pdfs.items():
            objects = json.loads(output_of("qpdf", "--json=2", "--json-key=qpdf", path))["qpdf"][1]
            values = [found["value"] for found in objects.values() if isinstance(found.get("value"), dict)]
            catalog = next(value for value in values if value.get("/Type") == "/Catalog")
            places = set(objects["obj:" + catalog["/Dests"]]["value"])
            links = [value for value in values if value.get("/Subtype") == "/Link"]
            self.assertTrue(links)
            for link in links:
                if "/A" in link:
                    self.assertRegex(link["/A"]["/URI"], r"^u:https://doi\.org/")
                else:
                    self.assertIn(link["/Dest"], places)

    def test_words_of_figures_are_seven_points_high_at_least(self):
        """Checks names of views and notes of legends: the box around a word is at least as high as its font size."""
        heights = [(float(match["bottom"]) - float(match["top"]), match["word"]) for match in re.finditer(
            r'<word xMin="[^"]*" yMin="(?P<top>[^"]*)" xMax="[^"]*" yMax="(?P<bottom>[^"]*)">(?P<word>[+−][xyz]|above|below|undefined)</word>',
            output_of("pdftotext", "-bbox-layout", self.pdf, "-"))]
        self.assertGreaterEqual({word for _, word in heights}, {"+x", "−z"})
        of_the_em = 1.21   # of the sans, from descender to ascender
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
        self.assertEqual(report(one, only="q2,q5").returncode, 0)
        process = report(other, "--no-timings", "--threads", 1, only="q2,q5", cwd=self.folder, TMPDIR=str(self.folder / "tmp"), TZ="Asia/Tokyo")
        self.assertEqual(process.returncode, 0, process.stderr)
        for name in VOLUMES:
            self.assertEqual((one / name).read_bytes(), (other / name).read_bytes(), name)
        self.assertEqual(list((self.folder / "tmp").iterdir()), [])

    def test_an_answer_from_the_cache_is_not_printed_again(self):
        real = next(filter(None, map(shutil.which, ("chromium-headless-shell", "chromium", "google-chrome"))), None)
        if real is None:
            self.skipTest("no browser on PATH")
        calls, browser = self.folder / "calls", self.folder / "browser"
        browser.write_text(f'#!/bin/sh\n[ "$1" = --version ] || echo >> {calls}\nexec {real} "$@"\n')
        browser.chmod(0o755)
        for _ in range(2):
            process = report(self.folder / "out", "--pdf-browser", browser, only="q2,q5", XDG_CACHE_HOME=str(self.folder / "cache"))
            self.assertEqual(process.returncode, 0, process.stderr)
            self.assertEqual(len(calls.read_text().splitlines()), len(VOLUMES))

    def test_the_date_is_that_of_source_date_epoch(self):
        self.assertEqual(run("report", "--quick", "--size", 64, "--only", "q2", "--pdf", "require", "--out", self.folder / "out", SOURCE_DATE_EPOCH="1700000000").returncode, 0)
        for name in VOLUMES:
            self.assertIn("D:20231114221320Z", output_of("pdfinfo", "-rawdates", self.folder / "out" / name))


class Engines(unittest.TestCase):
    """Runs without an engine, or with one that does not work."""

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
        self.assertEqual(list((self.folder / "out").glob("*.pdf")), [])

    def test_off_looks_for_no_engine(self):
        process = self.report("--pdf", "off", "--pdf-browser", self.browser("exit 1"))
        self.assertEqual(process.returncode, 0)
        self.assertNotIn("warning", process.stderr)
        self.assertEqual(list((self.folder / "out").glob("*.pdf")), [])

    def test_an_engine_that_prints_nothing_is_an_error(self):
        for script in ("exit 0", "echo crashed >&2; kill -SEGV $$", "echo no PDF > page.pdf", "echo not today >&2; exit 3"):
            with self.subTest(script=script):
                process = self.report("--pdf", "auto", "--pdf-browser", self.browser(script))
                self.assertEqual(process.returncode, 0, process.stderr)
                self.assertEqual(process.stderr.count("no report.pdf"), 1, process.stderr)
                self.assertEqual(list((self.folder / "out").glob("*.pdf")), [])
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
        self.assertIn("Questions attempted", output_of("pdftotext", pdf, "-"))
        self.assertIn("Contents", output_of("pdftotext", self.folder / "out" / "appendix.pdf", "-"))


class Design(unittest.TestCase):

    def test_the_page_itself_may_be_set_as_for_paper(self):
        folder = temporary_folder(self)
        (folder / "plain.toml").write_text('[report]\ntemplate = "print"\n')
        process = run("report", "--quick", "--size", 64, "--only", "q2", "--pdf", "off", "--config", folder / "plain.toml", "--out", folder / "out")
        self.assertEqual(process.returncode, 0, process.stderr)
        page = (folder / "out" / "index.html").read_text()
        self.assertEqual(page.count("<script"), 1, "what fills its pages, nothing else")
        self.assertNotIn("@page:", page)
        self.assertRegex(page, r"script-src (&apos;|&#39;)sha256-\S+; base-uri")


if __name__ == "__main__":
    unittest.main()
