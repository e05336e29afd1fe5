"""The documents of data/documents, made by Pandoc in all formats, and the files of `templates --pandoc`."""

import html.parser
import re
import shutil
import subprocess
import unittest
import zipfile

from document import FILTER, PROGRAM, SOURCE, Made, temporary_folder

EXAMPLES = {"scan": (2, 3), "curvature": (3, 4), "taubin": (4, 6)}   # figures and tables; those of several commands count as one


class Page(html.parser.HTMLParser):
    """Collects ids, links to them, files, and classes of a page."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.files, self.alts, self.classes = set(), set(), [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.ids.add(given.get("id"))
        self.classes |= set((given.get("class") or "").split())
        if (given.get("href") or "").startswith("#"):
            self.links.add(given["href"][1:])
        if tag == "img":
            self.files.append(given["src"])
            self.alts.append(given["alt"])


class Examples(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls)
        for name in EXAMPLES:
            shutil.copy(SOURCE / "data" / "documents" / f"{name}.md", cls.folder)
        cls.pages = {name: Made(cls.folder, f"{name}.md", "--standalone", "--mathml", "-o", f"{name}.html") for name in EXAMPLES}

    def made(self, name, *options):
        made = Made(self.folder, f"{name}.md", "--standalone", *options)
        self.assertEqual(made.code, 0, made.message)
        return made

    def test_pages(self):
        for name, (figures, tables) in EXAMPLES.items():
            self.assertEqual(self.pages[name].code, 0, self.pages[name].message)
            page = Page((self.folder / f"{name}.html").read_text())
            ids = [[i for i in page.ids if (i or "").startswith(kind)] for kind in ("fig-", "tbl-")]
            self.assertEqual([len(found) for found in ids], [figures, tables], name)
            self.assertLessEqual(page.links, page.ids)
            self.assertNotIn("meshfolio-error", page.classes)
            for file, alt in zip(page.files, page.alts):
                self.assertGreater((self.folder / file).stat().st_size, 1000, file)
                self.assertGreater(len(alt), 10, file)

    def test_a_second_time_is_quick(self):
        for name in EXAMPLES:
            before = (self.folder / f"{name}.html").read_bytes()
            again = self.made(name, "--mathml", "-o", f"{name}.html")
            print(f"{name}: {self.pages[name].seconds:.2f} s, again {again.seconds:.2f} s")
            self.assertEqual((self.folder / f"{name}.html").read_bytes(), before)
            self.assertEqual(re.sub(r"(?m)^\[WARNING\].*\n", "", again.message), "")

    def test_word_documents_have_pictures_and_tables(self):
        for name, (figures, tables) in EXAMPLES.items():
            self.made(name, "-o", f"{name}.docx")
            with zipfile.ZipFile(self.folder / f"{name}.docx") as file:
                text = file.read("word/document.xml").decode()
                pictures = [entry for entry in file.namelist() if re.match(r"word/media/.*\.(png|svg)$", entry)]
            self.assertGreaterEqual(len(pictures), figures)
            self.assertGreaterEqual(text.count("<w:tbl>"), tables)
            self.assertGreaterEqual(len(re.findall(r'descr="[^"]{10}', text)), figures)

    def test_plain_text_and_markdown(self):
        for name, (figures, tables) in EXAMPLES.items():
            for form in ("plain", "gfm"):
                text = self.made(name, "-t", form).text
                self.assertNotIn("meshfolio}", text)
                for number in range(1, figures + 1):
                    self.assertIn(f"Figure {number}: ", text)
                for number in range(1, tables + 1):
                    self.assertIn(f"Table {number}: ", text)

    @unittest.skipUnless(shutil.which("weasyprint") and shutil.which("pdftotext"), "weasyprint or pdftotext is not installed")
    def test_paper_by_weasyprint(self):
        for name, (figures, _) in EXAMPLES.items():
            self.made(name, "--pdf-engine=weasyprint", "-o", f"{name}.pdf")
            text = subprocess.run(["pdftotext", "-layout", self.folder / f"{name}.pdf", "-"], capture_output=True, text=True, check=True).stdout
            self.assertIn("Figure 1: ", text)
            images = subprocess.run(["pdfimages", "-list", self.folder / f"{name}.pdf"], capture_output=True, text=True, check=True).stdout
            self.assertGreaterEqual(len(images.splitlines()) - 2, figures - 1, name)   # plots are vectors

    @unittest.skipUnless(shutil.which("pdflatex") and shutil.which("pdffonts"), "pdflatex or pdffonts is not installed")
    def test_paper_by_latex_has_vectors(self):
        for name in EXAMPLES if shutil.which("rsvg-convert") else ("scan", "curvature"):
            self.made(name, "-o", f"{name}.latex.pdf")
            fonts = subprocess.run(["pdffonts", self.folder / f"{name}.latex.pdf"], capture_output=True, text=True, check=True).stdout
            self.assertIn("Inter", fonts, "the words of figures")
            text = subprocess.run(["pdftotext", self.folder / f"{name}.latex.pdf", "-"], capture_output=True, text=True, check=True).stdout
            self.assertNotIn("??", text)
            self.assertIn("Figure 1: ", text)


class Exported(unittest.TestCase):

    def export(self, *words):
        return subprocess.run([PROGRAM, "templates", "--pandoc", *words], cwd=self.folder, capture_output=True, text=True)

    def test_filter_and_extension(self):
        self.folder = temporary_folder(self)
        done = self.export("here")
        names = ["_extensions/meshfolio/_extension.yml", "_extensions/meshfolio/meshfolio.lua", "meshfolio.lua"]
        self.assertEqual((done.returncode, done.stdout.split()), (0, [f"here/{name}" for name in names]), done.stderr)
        self.assertEqual(sorted(str(path.relative_to(self.folder / "here")) for path in self.folder.rglob("*") if path.is_file()), names)
        for name in names[1:]:
            self.assertEqual((self.folder / "here" / name).read_bytes(), FILTER.read_bytes())
        self.assertEqual(self.export("here").returncode, 4)
        self.assertEqual(self.export("here", "--force").returncode, 0)
        self.assertEqual(self.export().returncode, 2)
        self.assertEqual(self.export("here", "--tags").returncode, 2)

    def test_the_extension_names_its_filter(self):
        """Quarto is not here. Its manual wants these keys, and a filter beside the file."""
        extension = SOURCE / "templates" / "pandoc" / "_extensions" / "meshfolio" / "_extension.yml"
        done = subprocess.run(["pandoc", "-f", "markdown", "-t", "json"], input=f"---\n{extension.read_text()}---\n", capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        for line in ("title: meshfolio", "author: ", 'quarto-required: ">=1.4', "contributes:\n  filters:\n    - path: meshfolio.lua\n"):
            self.assertIn(line, extension.read_text())

    def test_the_filter_can_be_read(self):
        lines = FILTER.read_text().splitlines()
        self.assertLessEqual(len(lines), 250)
        self.assertLessEqual(max(map(len, lines)), 150)


if __name__ == "__main__":
    unittest.main()
