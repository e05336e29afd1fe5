"""Names, titles and settings are data: these tests parse a report with hostile names in each format and compare it with a report with plain
names. Both have the same markup, links and programs; hostile names appear as text."""

import csv
import html.parser
import json
import os
import re
import shutil
import subprocess
import unittest
import urllib.parse
import xml.etree.ElementTree

from file_readers import png_size
from program import PROGRAM, run, sample, temporary_folder

TITLE = "<script>alert(1)</script>\"'&amp;| `code` ](javascript:alert(2)) {{author}} ]]> --> \u202eturned \u2066 %s \\x $x$ <b onclick=x>"
AUTHOR = "=cmd()|' /C calc'!A0"
COURSE = "![x](http://example.org/x.png) <https://example.org> www.example.org # - + * _a_ **b**"
MESHES = ["<script>alert(4)<", "\x1b[2J\x9b\n\r\t", "\"'&|`](javascript:alert(5))", "=1+1,\"\n", "\u202eabc", "--help", "{{title}}%n", b"\xff\xfe\xed\xa0\x80", "![x](y)"]
RAW = re.compile("[\0-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")

SETTINGS = """
[report]
title = %s
author = %s
course = %s
[render]
size = 16
"""


MATHEMATICS = {"math", "mi", "mn", "mo", "mrow", "mspace", "mtext", "msub", "msup", "msubsup", "var", "b", "sub", "sup"}


class Page(html.parser.HTMLParser):
    """Collects the elements with their attributes, the links and the programs of a page."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.markup, self.values, self.programs, self.words, self.title = set(), [], [], [], ""
        self.element = None
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.element = tag
        self.markup |= {(tag, name) for name, _ in attributes} | {(tag, None)}
        self.values += [(tag, name, value or "") for name, value in attributes]
        if tag == "script":
            self.programs.append("")

    def handle_endtag(self, tag):
        self.element = None

    def handle_data(self, data):
        if self.element == "script":
            self.programs[-1] += data
        elif self.element != "style":
            self.words.append(data)
        if self.element == "title" and not self.title:  # only the first: pictures have titles, too
            self.title = data

    def handle_comment(self, data):
        raise AssertionError(f"a comment: {data:.80}")


def shown(text):
    """Returns text as a page shows it: on one line, with visible escapes for characters that cannot be shown."""
    line = re.sub("[\n\r\t]", " ", text)
    return re.sub("[\0-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069]", lambda m: "".join(f"\\x{b:02x}" for b in m[0].encode()), line)


class HostileNames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls)
        plain = ["mesh%d" % i for i in range(len(MESHES))]
        cls.plain = cls.report("plain", plain, "Title", "Author", "Course")
        cls.hostile = cls.report("hostile", MESHES, TITLE, AUTHOR, COURSE)
        cls.out = cls.folder / "hostile" / "out"
        cls.results = json.loads((cls.out / "results.json").read_text(), parse_constant=cls.refuse, object_pairs_hook=cls.unique)

    @staticmethod
    def refuse(constant):
        raise AssertionError(f"{constant} is not JSON")

    @staticmethod
    def unique(pairs):
        assert len({key for key, _ in pairs}) == len(pairs), pairs
        return dict(pairs)

    @classmethod
    def report(cls, name, meshes, title, author, course):
        """Makes a report of a question and a section of the appendix, and a report of a question that fails for its mesh."""
        folder = cls.folder / name
        folder.mkdir()
        good = sample(folder, "sphere").read_bytes()
        paths = []
        for i, mesh in enumerate(meshes):
            path = os.path.join(os.fsencode(folder), os.fsencode(mesh) + b".obj")
            with open(path, "wb") as file:
                file.write(good)
            paths.append(path)
        words = [json.dumps(w) for w in (title, author, course)]
        (folder / "my.toml").write_text(SETTINGS % tuple(words))
        environment = {**os.environ, "XDG_CACHE_HOME": str(folder / "cache"), "MESHFOLIO_PDF": "auto"}
        command = [PROGRAM, "report", "--quick", "--time", "600", "--config", folder / "my.toml", "--out", folder / "out", "--only", "q1,certificates", "--", *paths]
        done = subprocess.run(command, env=environment, capture_output=True, timeout=280)
        assert done.returncode in (0, 1), done.stderr
        for path in paths:
            with open(path, "wb") as file:
                file.write(b"v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3\nf 2 4 3\n")   # without any area
        command = [PROGRAM, "report", "--quick", "--pdf", "off", "--out", folder / "bad", "--only", "q6", "--", *paths]
        bad = subprocess.run(command, env=environment, capture_output=True, timeout=280)
        assert bad.returncode == 1, bad.stderr
        done.stderr += bad.stderr
        return done

    def page(self, name, out="out", page="index.html"):
        return Page((self.folder / name / out / page).read_text())

    def test_the_pages(self):
        inside = ("#", "data:image/", "images/", "meshes/", "models/", "tables/", "src.txt", "results.json", "https://doi.org/", "report.")
        for file, title, words in (("index.html", TITLE, (TITLE, AUTHOR, COURSE)), ("appendix.html", "Appendix to " + TITLE, (TITLE, AUTHOR, COURSE))):
            page, plain = self.page("hostile", page=file), self.page("plain", page=file)
            unknown = {mark for mark in page.markup - plain.markup if mark[0] not in MATHEMATICS}   # names may have letters that look like a formula
            self.assertEqual(unknown, set(), "elements and attributes that came from data")
            self.assertEqual(page.programs, plain.programs)
            self.assertEqual(page.title.strip(), shown(title))
            text = " ".join(page.words)
            for word in words:
                self.assertIn("".join(shown(word).split()), "".join(text.split()))   # blanks: "|b|" looks like a formula
            for tag, name, value in page.values:
                self.assertFalse(name.startswith("on"), (tag, name))
                if name in ("href", "src", "action", "formaction", "data", "xlink:href"):
                    self.assertTrue(value.startswith(inside) or re.match(r"(index|appendix)\.html(#|$)", value), (tag, name, value[:80]))
            self.assertIsNone(RAW.search((self.out / file).read_text()))

    def test_a_failure_names_the_file(self):
        page = self.page("hostile", "bad")
        self.assertEqual(page.markup - self.page("plain", "bad").markup, set())
        bad = json.loads((self.folder / "hostile" / "bad" / "results.json").read_text(), parse_constant=self.refuse)
        failed = next(q for q in bad["questions"] if q["status"] == "failed")
        self.assertIn(failed["failure"], " ".join(page.words))

    def test_the_page_is_xml(self):
        for page, expected in (("index.html", TITLE), ("appendix.html", "Appendix to " + TITLE)):
            text = (self.out / page).read_text().replace("<!DOCTYPE html>", "", 1)
            title = xml.etree.ElementTree.fromstring(text).find(".//{*}title")
            self.assertEqual(title.text.strip(), shown(expected))
            if not shutil.which("xmllint"):
                continue
            problems = {}
            for name in ("plain", "hostile"):
                command = ["xmllint", "--html", "--noout", self.folder / name / "out" / page]
                found = subprocess.run(command, capture_output=True, text=True, errors="replace").stderr
                problems[name] = set(re.findall(r"HTML parser error : (.*)", found))  # the parser does not know HTML 5
            self.assertEqual(problems["hostile"] - problems["plain"], set())

    @unittest.skipUnless(shutil.which("pandoc"), "pandoc is not installed")
    def test_markdown(self):
        for file in ("report.md", "appendix.md", "summary.md"):
            raw, links = {}, {}
            for name in ("plain", "hostile"):
                done = subprocess.run(["pandoc", "-f", "gfm", "-t", "json", self.folder / name / "out" / file], capture_output=True, text=True, check=True)
                raw[name], links[name] = set(), set()
                self.walk(json.loads(done.stdout), raw[name], links[name])
            # Ids and file names contain mesh names in a safe form, so attribute values may differ. Elements and attributes may not.
            self.assertEqual(raw["hostile"] - raw["plain"], set(), file)
            for target in links["hostile"]:
                self.assertTrue(re.match(r"#|(images|meshes|tables)/|https://doi\.org/|[a-z]+\.[a-zA-Z0-9]+(#[\w-]+)?$", target), target)
            self.assertIsNone(RAW.search((self.out / file).read_text()), file)

    def walk(self, node, raw, links):
        if isinstance(node, list):
            for item in node:
                self.walk(item, raw, links)
        elif isinstance(node, dict):
            kind, content = node.get("t"), node.get("c")
            if kind in ("RawInline", "RawBlock"):
                raw.add(re.sub(r'"[^"]*"', '""', content[1]))
            if kind in ("Link", "Image"):
                links.add(urllib.parse.unquote(content[2][0]))
            for item in node.values():
                self.walk(item, raw, links)

    def judge_cell(self, word, value):
        """Requires the cell to be the text, or a harmless form of it with the same letters and digits."""
        if re.fullmatch(r"[\w.]?[ \w./…()%·°]*", value):
            self.assertEqual(word, value)
        self.assertNotRegex(word, "[\0-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")
        self.assertNotRegex(word, r"(^|[,;|])[ \"]*[=+\-@](?![\d.]+($|[,;|]))")
        letters = [re.sub(r"\\x[0-9a-f]{2}|[^A-Za-z0-9]", "", text) for text in (word, re.sub("[\0-\x08\x0b-\x1f\x7f-\x9f\u2028]", "", value))]
        self.assertEqual(*letters)

    def test_tables_are_the_same_in_both_files(self):
        tables = [t for q in self.results["questions"] + self.results["supporting"] for t in q["tables"]]
        self.assertGreater(len(tables), 2)
        for table in tables:
            with open(self.out / "tables" / f"{table['id']}.csv", newline="", encoding="utf-8") as file:
                rows = list(csv.reader(file, strict=True))
            heads = [c["name"] + (f" [{c['unit']}]" if c.get("unit") else "") for c in table["columns"]]
            self.assertEqual(rows[0], heads)
            self.assertEqual(len(rows) - 1, len(table["rows"]))
            for written, row in zip(rows[1:], table["rows"]):
                for word, value in zip(written, row):
                    if value is None:
                        self.assertEqual(word, "")
                    elif isinstance(value, str):
                        self.judge_cell(word, value)
                    else:
                        self.assertEqual(float(word), value)

    def test_results(self):
        self.assertEqual([self.results[k] for k in ("title", "author", "course")], [TITLE, AUTHOR, COURSE])
        status = {q["id"]: q["status"] for q in self.results["questions"]}
        self.assertEqual((status["q1"], status["q2"]), ("ok", "skipped"))

    def test_pictures(self):
        for path in self.out.glob("images/*.svg"):
            for element in xml.etree.ElementTree.parse(path).iter():
                self.assertNotIn(element.tag.split("}")[-1], ("script", "foreignObject", "image", "a", "animate", "set"), path)
                for name, value in element.attrib.items():
                    self.assertFalse(name.startswith("on") or name.endswith("href") and not value.startswith("#"), (path, name, value))
        for path in self.out.glob("images/*.png"):
            png_size(path)

    def test_names_of_files_are_plain(self):
        for path in self.out.rglob("*"):
            self.assertRegex(path.name, r"^\.?[A-Za-z0-9_+.-]+$")
        listed = [line.split("  ", 1)[1] for line in (self.out / "SHA256SUMS").read_text().splitlines()]
        self.assertEqual(listed, sorted(listed, key=str.encode))
        for name in listed:
            self.assertFalse(name.startswith("/") or ".." in name.split("/"), name)

    def test_undefined_values_are_not_written_as_numbers(self):
        markdown = [self.out / name for name in ("report.md", "appendix.md", "summary.md")]
        for path in [*self.out.glob("tables/*.csv"), *self.out.glob("images/*.svg"), self.out / "results.json", *markdown]:
            self.assertIsNone(re.search(r"(?<![a-z])-?(nan|inf|infinity)(?![a-z])", path.read_text(), re.I), path)

    def test_the_terminal(self):
        text = self.hostile.stderr.decode("utf-8") + self.hostile.stdout.decode("utf-8")
        self.assertIsNone(RAW.search(text.replace("\n", " ")))
        self.assertLessEqual(len(text.splitlines()), 40)
        for line in self.hostile.stderr.decode().splitlines():
            self.assertTrue(line.startswith("meshfolio: "), line)

    @unittest.skipUnless(shutil.which("qpdf") and shutil.which("pdftotext"), "qpdf or pdftotext is not installed")
    def test_paper(self):
        for path in (self.out / "report.pdf", self.out / "appendix.pdf"):
            if not path.exists():
                self.skipTest("no engine prints here")
            subprocess.run(["qpdf", "--check", path], check=True, capture_output=True)
            plain = subprocess.run(["qpdf", "--qdf", "--object-streams=disable", path, "-"], check=True, capture_output=True).stdout
            for program in (rb"/JavaScript", rb"/JS\b", rb"/Launch", rb"/OpenAction", rb"/SubmitForm", rb"/URI \((?!https://doi\.org/)[^)]*"):
                self.assertIsNone(re.search(program, plain), program)
            text = subprocess.run(["pdftotext", path, "-"], check=True, capture_output=True).stdout.decode()
            self.assertIn("alert(1)", text)
            self.assertIn("{{author}}", text)


if __name__ == "__main__":
    unittest.main()
