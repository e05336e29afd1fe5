"""Limits of the report to hand in, checked on a default report of the bundled meshes."""

import html
import json
import re
import shutil
import subprocess
import sys
import unicodedata
import unittest
from collections import Counter
from pathlib import Path

from pdf_lines import POINTS, lines_of, running_text
from pdf_text_sizes import shown_in, too_small
from program import run, temporary_folder
from test_pdf import output_of, reason_to_skip

MOST_PAGES = 22
LARGEST_GAP = 0.2             # at the foot of a page, of the height of the text
LONGEST_LINE = 80             # most letters of a line, in 95 % of the lines of running text,
LONGEST_OF_ALL = 90
COLUMNS = ((18, 102), (108, 192))   # of the report, [mm]
LOOSE = 0.6                   # mean space of a line, relative to the size of its letters
MOST_PIXELS = 45_000          # height of the page, at a width of 1400
LEAST_SIZE = 7                # [pt] of words
LEAST_SCRIPT = 4.5            # [pt] of indices and exponents, those of indices included,
LONGEST_SCRIPT = 8            # with at most this number of letters in a row
MEGABYTE = 1_000_000
SIX = {"+x", "-x", "+y", "-y", "+z", "-z"}
ALIKE_FROM_EVERY_SIDE = ("sphere", "plane")   # questions 1 and 3 show them once
SHOWS_RESULT_MESHES = ("q1", "q3", "q4", "q5", "q6", "q7")


def figures_of(section):
    """Returns the figures of a question that are in the report, not in the appendix."""
    blocks = section["blocks"][: section.get("appendix_from")]
    shown = {block["id"] for block in blocks if block["kind"] == "figure"}
    return [figure for figure in section["figures"] if figure["id"] in shown]


def six_sided(section):
    """Returns [(figure, panel)] of the panels in the report with all six directions, or, for a flat mesh, with one."""
    panels = [(figure, panel) for figure in figures_of(section) for panel in figure["panels"]]
    return [(figure, panel) for figure, panel in panels
            if SIX <= {picture.get("view") for picture in panel["pictures"]} or "its other views are edge-on" in panel["label"]]


def bare(words):
    """Returns letters and digits alone, independent of line breaks, hyphens, indices and mathematical letters."""
    return re.sub(r"[\W_]", "", unicodedata.normalize("NFKC", words))


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

    def test_it_has_few_pages(self):
        pages = int(re.search(r"Pages: +(\d+)", output_of("pdfinfo", self.pdf()))[1])
        self.assertLessEqual(pages, MOST_PAGES)

    def test_no_page_but_the_last_ends_early(self):
        subprocess.run(["pdftoppm", "-gray", "-r", "25.4", self.pdf(), self.folder / "page"], check=True)   # a millimetre a pixel
        top, foot = 19, 276   # of the text; the page's number stands above
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

    # ---- lines ----------------------------------------------------------------------------------------------------------

    def running_text(self, name="report.pdf"):
        self.pdf()
        return running_text(lines_of(self.out / name))

    def test_lines_are_short_enough_to_find_the_next_one(self):
        for name in ("report.pdf", "appendix.pdf"):
            lengths = sorted(len(line.text) for line in self.running_text(name))
            self.assertGreater(len(lengths), 300, name)
            self.assertLessEqual(lengths[int(0.95 * len(lengths))], LONGEST_LINE, name)
            self.assertLessEqual(lengths[-1], LONGEST_OF_ALL, name)

    def test_text_stays_in_its_column_and_on_its_page(self):
        columns = {}
        for line in self.running_text():
            inside = [i for i, (left, right) in enumerate(COLUMNS) if left - 0.5 <= line.left and line.right <= right + 0.5]
            self.assertTrue(inside, (line.page, line.left, line.right, line.text))
            self.assertLess(line.bottom, 278, line.text)
            columns.setdefault((line.page, *inside), []).append(line)
        for place, lines in columns.items():
            lines.sort(key=lambda line: line.top)
            for above, below in zip(lines, lines[1:]):
                if min(above.right, below.right) - max(above.left, below.left) > 5:   # else it is the same line in two parts
                    self.assertGreater((below.top - above.top) * POINTS, 9, (place, above.text, below.text))

    def test_columns_are_full(self):
        """Text or a figure reaches the foot of both columns, unless a heading would stand there alone."""
        foot = {}
        for line in lines_of(self.pdf()):
            for i, (left, right) in enumerate(COLUMNS):
                if line.right > left and line.left < right:
                    foot[line.page, i] = max(foot.get((line.page, i), 0), line.bottom)
        last = max(page for page, _ in foot)
        short = {place: bottom for place, bottom in foot.items() if place[0] < last and bottom < 215}
        self.assertEqual(short, {})

    def test_few_lines_are_loosely_spaced(self):
        loose, full = [], 0
        for line in self.running_text():
            if len(line.words) < 4 or line.right - line.left < 80:
                continue
            full += 1
            spaces = [right[0] - left[1] for left, right in zip(line.words, line.words[1:])]
            if sum(spaces) / len(spaces) * POINTS > LOOSE * 9:
                loose.append(line.text)
        self.assertGreater(full, 200)
        self.assertLess(len(loose) / full, 0.05, loose)

    def test_figures_and_tables_stand_near_their_first_mention(self):
        mentioned, placed = {}, {}
        pages = output_of("pdftotext", self.pdf(), "-").split("\f")
        for number, page in enumerate(pages, 1):
            for match in re.finditer(r"((?:Figure|Table)\s[1-7]\.\d+)(\.\s+\S)?(\sof\sthe\sappendix)?", page):
                name, caption, elsewhere = match.groups()
                name = re.sub(r"\s", " ", name)
                starts_line = match.start() == 0 or page[match.start() - 1] == "\n"
                if caption and starts_line:
                    placed.setdefault(name, number)
                elif not elsewhere:
                    mentioned.setdefault(name, number)
        late = {name: placed[name] - page for name, page in mentioned.items() if name in placed}
        self.assertGreater(len(late), 25)
        self.assertLessEqual(sum(late.values()) / len(late), 1.5, late)
        self.assertLessEqual(max(late.values()), 4, late)
        self.assertGreaterEqual(min(late.values()), 0, late)

    # ---- words ----------------------------------------------------------------------------------------------------------

    def test_paper_has_no_link_to_the_page(self):
        self.assertNotIn("index.html", self.words())

    def test_no_other_report_is_named(self):
        found = re.findall(r".{0,40}(?:\bS[0-3]\b|\b[Rr]eport S\b|\b[Ss]ection S\b).{0,40}", self.words())
        self.assertEqual(found, [])

    def test_each_question_is_answered_in_the_opening_table_and_first_in_its_section(self):
        words = bare(self.words())
        for name, question in self.questions.items():
            prose = " ".join(part for part in question["answer"] if isinstance(part, str))
            longest = max(re.split(r"[^A-Za-z ]", prose), key=len).split()   # between formulas; a PDF puts their exponents at ends of lines
            counts = [words.count(bare("".join(longest[i:i + 4]))) for i in range(max(1, len(longest) - 3))]
            self.assertIn(2, counts, name)

    # ---- pictures -------------------------------------------------------------------------------------------------------

    def test_every_mesh_is_shown_from_six_directions(self):
        """The assignment requires a panel in each question, and one for each of its meshes."""
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

    def test_the_page_is_not_too_long(self):
        """Measures the height with a script in a copy of the page without its policy."""
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
