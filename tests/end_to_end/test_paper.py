"""What is handed in, held against its limits: one report of the bundled meshes as it is by default, in its full size."""

import html
import json
import re
import shutil
import subprocess
import sys
import unittest
from collections import Counter
from pathlib import Path

from pdf_text_sizes import shown_in, too_small
from program import run, temporary_folder
from test_pdf import output_of, reason_to_skip

MOST_PAGES = 20
LARGEST_GAP = 0.2             # at the foot of a page, of the height of the text
MOST_PIXELS = 45_000          # of the page, at a width of 1400
LEAST_SIZE = 7                # [pt] of words
LEAST_SCRIPT = 4.5            # [pt] of indices and exponents, those of indices included,
LONGEST_SCRIPT = 8            # which have at most so many letters in a row
MEGABYTE = 1_000_000
SIX = {"+x", "-x", "+y", "-y", "+z", "-z"}
ALIKE_FROM_EVERY_SIDE = ("sphere", "plane")   # questions 1 and 3 show them once
SHOWS_RESULT_MESHES = ("q1", "q3", "q4", "q5", "q6", "q7")


def figures_of(section):
    """Those of a question that stand in the report."""
    blocks = section["blocks"][: section.get("appendix_from")]
    shown = {block["id"] for block in blocks if block["kind"] == "figure"}
    return [figure for figure in section["figures"] if figure["id"] in shown]


def six_sided(section):
    """[(figure, panel)] in the report whose panel has all six directions, or of a flat mesh the one that shows something."""
    panels = [(figure, panel) for figure in figures_of(section) for panel in figure["panels"]]
    return [(figure, panel) for figure, panel in panels
            if SIX <= {picture.get("view") for picture in panel["pictures"]} or "its other views are edge-on" in panel["label"]]


def bare(words):
    """Letters and digits alone, whatever lines, hyphens and indices are set like."""
    return re.sub(r"[\W_]", "", words)


class Paper(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.why = reason_to_skip()
        if cls.why:
            print("SKIPPED what is about report.pdf: " + cls.why, file=sys.stderr)
        cls.folder = temporary_folder(cls)
        cls.out = cls.folder / "out"
        process = run("report", "--pdf", "off" if cls.why else "require", "--out", cls.out)
        assert process.returncode == 0, process.stderr
        cls.results = json.loads((cls.out / "results.json").read_text())
        cls.questions = {question["id"]: question for question in cls.results["questions"]}

    def pdf(self):
        if self.why:
            self.skipTest(self.why)
        return self.out / "report.pdf"

    def words(self):
        return output_of("pdftotext", self.pdf(), "-")

    # ---- length and letters ---------------------------------------------------------------------------------------------

    def test_it_has_at_most_twenty_pages(self):
        pages = int(re.search(r"Pages: +(\d+)", output_of("pdfinfo", self.pdf()))[1])
        self.assertLessEqual(pages, MOST_PAGES)

    def test_no_page_but_the_last_ends_early(self):
        subprocess.run(["pdftoppm", "-gray", "-r", "25.4", self.pdf(), self.folder / "page"], check=True)   # a millimetre a pixel
        top, foot = 14, 281   # of the text; the page's number stands below
        pages = sorted(self.folder.glob("page-*.pgm"))
        for page in pages[:-1]:
            _, size, _, pixels = page.read_bytes().split(b"\n", 3)
            width, _ = map(int, size.split())
            printed = [y for y in range(top, foot) if min(pixels[y * width:(y + 1) * width]) < 200]
            self.assertLess(foot - printed[-1], LARGEST_GAP * (foot - top), page.name)

    def test_every_word_is_large_enough_to_be_read(self):
        shown = shown_in(self.pdf())
        letters = len(re.sub(r"\s", "", self.words()))
        self.assertGreater(sum(one.glyphs for one in shown), 0.9 * letters, "the sizes are those of the whole text")
        small = too_small(shown, LEAST_SIZE, LEAST_SCRIPT, LONGEST_SCRIPT)
        counted = Counter()
        for page, size, glyphs in small:
            counted[f"page {page}, {size} pt"] += glyphs
        self.assertEqual(dict(counted), {}, "letters by place and size")

    # ---- words ----------------------------------------------------------------------------------------------------------

    def test_nothing_leads_to_the_page(self):
        self.assertNotIn("index.html", self.words())

    def test_no_other_report_is_named(self):
        found = re.findall(r".{0,40}(?:\bS[0-3]\b|\b[Rr]eport S\b|\b[Ss]ection S\b).{0,40}", self.words())
        self.assertEqual(found, [])

    def test_each_question_is_answered_in_the_opening_table_and_first_in_its_section(self):
        words = bare(self.words())
        for name, question in self.questions.items():
            longest = max((part for part in question["answer"] if isinstance(part, str)), key=len)   # the others are formulas
            self.assertEqual(words.count(bare(longest)), 2, name)

    # ---- pictures -------------------------------------------------------------------------------------------------------

    def test_every_mesh_is_shown_from_six_directions(self):
        """The assignment asks for it: in each question at least one panel, and one for each of its meshes."""
        for name in SHOWS_RESULT_MESHES:
            shown = [f"{figure['id']} {panel['label']}" for figure, panel in six_sided(self.questions[name])]
            self.assertTrue(shown, name)
            for mesh in self.questions[name]["inputs"]:
                if name in ("q1", "q3") and Path(mesh["file"]).stem in ALIKE_FROM_EVERY_SIDE:
                    continue
                self.assertTrue(any(Path(mesh["file"]).stem in one for one in shown), (name, mesh["file"], shown))

    def test_these_pictures_are_on_paper(self):
        objects = json.loads(output_of("qpdf", "--json=2", "--json-key=qpdf", self.pdf()))["qpdf"][1].values()
        values = [found["value"] for found in objects if isinstance(found.get("value"), dict)]
        said = {re.sub(r"^u:Figure [\dA-K.]+: ", "", value["/Alt"]) for value in values if value.get("/S") == "/Figure" and "/Alt" in value}
        placed = Counter(tuple(map(int, line.split()[3:5])) for line in output_of("pdfimages", "-list", self.pdf()).splitlines()[2:])
        expected = Counter()
        for name in SHOWS_RESULT_MESHES:
            for _, panel in six_sided(self.questions[name]):
                for picture in panel["pictures"]:
                    expected[picture["width"], picture["height"]] += 1
                    if "view" in picture:
                        self.assertIn(f"{panel['label']}, seen from {picture['view'].replace('-', '−')}", said, name)
        self.assertEqual(expected - placed, Counter(), "sizes of pictures that are not there")

    # ---- weight and height ----------------------------------------------------------------------------------------------

    def test_the_folder_and_the_summary_are_small(self):
        sizes = {path: path.stat().st_size for path in self.out.rglob("*") if path.is_file()}
        self.assertLessEqual(sizes[self.out / "summary.md"], 20_000)
        heaviest = Counter()
        for path, size in sizes.items():
            heaviest[path.relative_to(self.out).parts[0]] += size
        self.assertLessEqual(sum(sizes.values()) / MEGABYTE, 60, heaviest.most_common(6))

    def test_what_is_handed_in_is_small(self):
        out = self.folder / "submitted"
        shutil.copytree(self.out, out)
        process = run("submit", "--out", out, "--author", "Ada Lovelace", *(["--without-pdf"] if self.why else []))
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertLessEqual((out / "submission.zip").stat().st_size / MEGABYTE, 30)

    def test_the_page_is_no_scroll(self):
        """A copy of the page, without the policy that lets no other script run, says how tall it is."""
        if self.why:
            self.skipTest(self.why)
        browser = json.loads(run("doctor", "--json").stdout)["pdf_engine"]["program"]
        page = (self.out / "index.html").read_text()
        page = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page)
        said = "<script>addEventListener('load', () => { document.title = `tall ${document.documentElement.scrollHeight}` })</script></body>"
        copy = self.folder / "tall.html"
        copy.write_text(page.replace("</body>", said))
        words = [browser, "--headless", "--no-sandbox", f"--user-data-dir={self.folder / 'browser'}", "--hide-scrollbars", "--window-size=1400,1000",
                 "--virtual-time-budget=20000", "--dump-dom", copy.as_uri()]  # fmt: skip
        shown = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=200, check=True).stdout
        self.assertLessEqual(int(re.search(r"<title>tall (\d+)", html.unescape(shown))[1]), MOST_PIXELS)


if __name__ == "__main__":
    unittest.main(verbosity=2)
