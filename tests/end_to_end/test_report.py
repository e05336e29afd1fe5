"""A quick report has all files, well-formed and linked; a second run gives the same bytes; failures are shown."""

import csv
import html.parser
import json
import re
import unittest
import urllib.parse
import xml.etree.ElementTree

from file_readers import png_size
from folders import tree
from program import SOURCE, run, sample, temporary_folder
from quick_report import quick_report

PAGES = ("index.html", "appendix.html")
MARKDOWN = ("report.md", "appendix.md", "summary.md")
QUESTIONS = re.findall(r"^  (q\d+) ", run("list").stdout, re.MULTILINE)


class Page(html.parser.HTMLParser):
    """Collects the links, pictures and ids of an HTML page."""

    def __init__(self, text):
        super().__init__()
        self.targets, self.ids, self.pictures = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attribute = dict(attributes)
        if "id" in attribute:
            self.ids.append(attribute["id"])
        if tag == "a" and "href" in attribute:
            self.targets.append(attribute["href"])
        if tag == "img":
            self.pictures.append(attribute)


def ids_in(value):
    if isinstance(value, dict):
        if isinstance(value.get("id"), str):
            yield value["id"]
        value = list(value.values())
    if isinstance(value, list):
        for part in value:
            yield from ids_in(part)


def words_in(value):
    if isinstance(value, str):
        yield value
    for part in value.values() if isinstance(value, dict) else value if isinstance(value, list) else []:
        yield from words_in(part)


class QuickReport(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls)
        cls.process, cls.out, _ = quick_report(cls.folder)
        cls.results = json.loads((cls.out / "results.json").read_text())

    def test_ends_well_and_names_the_page_on_stdout(self):
        self.assertEqual(self.process.returncode, 0, self.process.stderr)
        self.assertEqual(self.process.stdout.strip(), str(self.out / "index.html"))

    def test_all_questions_are_complete(self):
        self.assertEqual([q["id"] for q in self.results["questions"]], QUESTIONS)
        self.assertIn("truth", [s["id"] for s in self.results["supporting"]])
        for question in self.results["questions"] + self.results["supporting"]:
            self.assertEqual(question["status"], "ok", question["id"])
            self.assertTrue(question["checks"], question["id"])
            for check in question["checks"]:
                self.assertTrue(check["passed"], check)
                self.assertEqual({type(check[k]) in (int, float) for k in ("expected", "measured", "tolerance")}, {True}, check)

    def test_each_answer_is_one_sentence_of_at_most_25_words(self):
        for chapter in self.results["questions"] + self.results["supporting"]:
            text = "".join(run if isinstance(run, str) else " formula " for run in chapter["answer"]).replace("\u202f", "")
            with self.subTest(chapter["id"], answer=text):
                self.assertLessEqual(len([word for word in text.split() if any(map(str.isalnum, word))]), 25)
                self.assertRegex(text, r"^[^.!?]+([.!?]\S[^.!?]*)*[.!?] *$")

    def test_rendered_again_from_its_results_it_is_the_same(self):
        again = self.folder / "again"
        process = run("report", "--from", self.out / "results.json", "--out", again)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual(tree(again), tree(self.out))

    def test_every_promised_file_is_there(self):
        for name in ["index.html", "appendix.html", "report.md", "appendix.md", "summary.md", "results.json", "src.txt", "SHA256SUMS"]:
            self.assertGreater((self.out / name).stat().st_size, 0, name)
        for folder in ["tables", "images", "meshes"]:
            self.assertTrue(any((self.out / folder).iterdir()), folder)
        self.assertTrue(list((self.out / "meshes").glob("q4_*_k5.ply")))

    def test_the_page_is_well_formed_and_offline(self):
        for name in PAGES:
            text = (self.out / name).read_text()
            xml.etree.ElementTree.fromstring(text.split("?>", 1)[-1] if text.startswith("<?xml") else text.replace("<!DOCTYPE html>", "", 1))
            self.assertIn("default-src 'none'", text.replace("&#39;", "'"))
            page = Page(text)
            self.assertEqual(len(page.ids), len(set(page.ids)), f"{name}: ids are unique")
            for picture in page.pictures:
                self.assertTrue(picture["src"].startswith("data:image/"), picture["src"][:60])
                self.assertTrue(picture.get("alt"), "every picture has words")
            for target in page.targets:
                self.assertFalse(re.match(r"(https?:)?//", target) and "doi.org" not in target, target)

    def test_each_block_stands_in_one_volume(self):
        """Blocks of a question before `appendix_from` are in the report; all others, and supporting sections, are in the appendix."""
        report, appendix = (Page((self.out / name).read_text()).ids for name in PAGES)
        for section in self.results["questions"] + self.results["supporting"]:
            first = len(section["blocks"]) if "appendix_from" not in section else section["appendix_from"]
            for_programs = {table["id"] for table in section["tables"] if table.get("file_only")}
            for at, block in enumerate(section["blocks"]):
                if block["kind"] not in ("table", "plot", "map", "diagram", "figure") or block["id"] in for_programs:
                    continue
                here, there = (report, appendix) if section["id"] in QUESTIONS and at < first else (appendix, report)
                self.assertIn(block["id"], here, section["id"])
                self.assertNotIn(block["id"], there, section["id"])

    def test_every_link_leads_somewhere(self):
        anchors, targets = {}, []
        for name in PAGES:
            page = Page((self.out / name).read_text())
            anchors[name] = set(page.ids)
            targets += [(name, target) for target in page.targets]
        for name in MARKDOWN:
            text = (self.out / name).read_text()
            anchors[name] = set(re.findall(r'id="([^"]+)"', text))
            links = re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'(?:src|href)="([^"]+)"', text)
            targets += [(name, target) for target in links]
        across = {(source, target.split("#")[0]) for source, target in targets if "#" in target}
        for one, other in (PAGES, PAGES[::-1], MARKDOWN[:2], MARKDOWN[1::-1]):
            self.assertIn((one, other), across, "each volume refers to the other")
        self.assertFalse({(one, other) for one, other in across if one in PAGES and other in MARKDOWN}, "to the volume of its own kind")
        for source, target in targets:
            target = urllib.parse.unquote(target.replace("\\", ""))
            if target.startswith(("http:", "https:", "data:")):
                continue
            file, _, anchor = target.partition("#")
            self.assertTrue((self.out / (file or source)).is_file(), f"{source}: {target}")
            if anchor:
                self.assertIn(anchor, anchors[file or source], f"{source}: {target}")

    def test_undefined_values_are_not_written_as_numbers(self):
        for path in [*self.out.glob("tables/*.csv"), self.out / "results.json", self.out / "summary.md"]:
            self.assertIsNone(re.search(r"(?<![a-z])-?(nan|inf|infinity)(?![a-z])", path.read_text(), re.I), path)

    def test_no_template_tag_is_left(self):
        for words in words_in(self.results):
            self.assertIsNone(re.search(r"\[\[|\{\{", words), words)

    def test_tables_are_rectangular(self):
        for path in self.out.glob("tables/*.csv"):
            with path.open(newline="") as file:
                rows = list(csv.reader(file))
            self.assertGreater(len(rows), 1, path)
            self.assertEqual({len(row) for row in rows}, {len(rows[0])}, path)

    def test_every_picture_can_be_read(self):
        pictures = list(self.out.glob("images/*.png"))
        views = [p for p in pictures if not p.name.endswith("_sheet.png")]
        for path in pictures:
            png_size(path)
        for path in views:
            self.assertEqual(png_size(path), (64, 64), path)
        sheets = {f["id"] for q in self.results["questions"] for f in q["figures"]}
        for sheet in sheets:
            self.assertTrue((self.out / "images" / f"{sheet}_sheet.png").is_file(), sheet)

    def test_sums_are_right(self):
        listed = {}
        for line in (self.out / "SHA256SUMS").read_text().splitlines():
            value, name = line.split("  ", 1)
            listed[name] = value
        found = {name: value for name, value in tree(self.out).items() if name != "SHA256SUMS" and not name.startswith(".")}
        self.assertEqual({k: v for k, v in listed.items() if not k.startswith(".")}, found)

    def test_results_fit_their_schema(self):
        self.assertEqual(run("templates", self.folder / "templates").returncode, 0)
        schema = json.loads((self.folder / "templates" / "results.schema.json").read_text())
        for key in schema["required"]:
            self.assertIn(key, self.results)

    def test_no_path_of_this_machine_leaks(self):
        for name in [*PAGES, *MARKDOWN, "results.json"]:
            self.assertNotIn(str(self.out.parent), (self.out / name).read_text(), name)


class Failures(unittest.TestCase):
    def test_one_failing_question_leaves_the_others_complete(self):
        folder = temporary_folder(self)
        mesh, out = sample(folder, "torus"), folder / "out"
        process = run("report", "--quick", "--size", 64, "--only", ",".join(QUESTIONS), "--out", out, mesh, MESHFOLIO_FAIL="q4")
        self.assertEqual(process.returncode, 1)
        status = {q["id"]: q["status"] for q in json.loads((out / "results.json").read_text())["questions"]}
        self.assertEqual(status, {q: "failed" if q == "q4" else "ok" for q in QUESTIONS})
        self.assertIn("q4", process.stderr)
        for name in ("index.html", "report.md", "summary.md", "results.json"):
            self.assertIn("made to fail by MESHFOLIO", (out / name).read_text().replace("\\", ""), name)

    def test_a_failing_supporting_section_leaves_those_that_cite_it(self):
        out = temporary_folder(self) / "out"
        process = run("report", "--quick", "--size", 64, "--out", out, "--only", "q1,truth", MESHFOLIO_FAIL="truth")
        self.assertEqual(process.returncode, 1)
        results = json.loads((out / "results.json").read_text())
        status = {s["id"]: s["status"] for s in results["questions"] + results["supporting"]}
        self.assertEqual((status["q1"], status["q2"], status["truth"]), ("ok", "skipped", "failed"))

    def test_a_mesh_that_defeats_a_question_is_shown_in_the_report(self):
        folder = temporary_folder(self)
        (folder / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3\nf 2 4 3\n")   # without any area
        process = run("report", "--quick", "--size", 64, "--only", "q2,q6", "--out", folder / "out", folder / "flat.obj")
        self.assertEqual(process.returncode, 1, process.stderr)
        results = json.loads((folder / "out" / "results.json").read_text())
        status = {q["id"]: q["status"] for q in results["questions"]}
        self.assertEqual((status["q2"], status["q6"]), ("ok", "failed"))
        self.assertIn("flat.obj", (folder / "out" / "index.html").read_text())

    def test_a_foreign_folder_is_not_replaced(self):
        folder = temporary_folder(self)
        (folder / "mine").mkdir()
        (folder / "mine" / "thesis.tex").write_text("precious")
        process = run("report", "--quick", "--only", "q2", "--size", 64, "--out", folder / "mine")
        self.assertEqual(process.returncode, 4, process.stderr)
        self.assertEqual((folder / "mine" / "thesis.tex").read_text(), "precious")
        self.assertEqual([p.name for p in folder.iterdir()], ["mine"])

    def test_a_missing_data_folder_is_an_input_error(self):
        folder = temporary_folder(self)
        process = run("report", "--quick", "--out", folder / "out", "--data", folder / "nowhere")
        self.assertEqual(process.returncode, 3)
        self.assertFalse((folder / "out").exists())

    def test_wrong_settings_write_nothing(self):
        folder = temporary_folder(self)
        (folder / "report.toml").write_text('[report]\ntitel = "x"\n[[question]]\nid = "q4"\nk = -1\n')
        process = run("report", "--config", folder / "report.toml", "--out", folder / "out")
        self.assertEqual(process.returncode, 2)
        self.assertIn("report.toml:2", process.stderr)
        self.assertIn("title", process.stderr)
        self.assertIn("report.toml:5", process.stderr)
        self.assertFalse((folder / "out").exists())


class OwnMesh(unittest.TestCase):
    def test_an_own_mesh_takes_every_role_and_gives_the_same_bytes_again_with_one_thread_elsewhere(self):
        folder = temporary_folder(self)
        mesh = sample(folder, "torus", "ply")
        words = ["report", "--quick", "--size", 64, "--no-timings", mesh]
        process = run(*words, "--threads", 2, "--out", folder / "out")
        self.assertEqual(process.returncode, 0, process.stderr)
        results = json.loads((folder / "out" / "results.json").read_text())
        for question in results["questions"]:
            for entry in question["inputs"]:
                self.assertEqual((entry["file"], entry["stand_in"]), ("torus.ply", False), question["id"])
        self.require_apart(folder / "out", results, "torus")
        process = run(*words, "--threads", 1, "--out", folder / "elsewhere" / "again", cwd=folder, LC_ALL="C", TZ="Asia/Tokyo")
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual(tree(folder / "elsewhere" / "again"), tree(folder / "out"))

    def require_apart(self, out, results, mesh):
        """An id joins question, mesh and subject. No subject may end in another subject, or two meshes could share an id: "mistake_errors" of
        cube would be "errors" of cube_mistake."""
        ids = {p.stem for p in out.rglob("*")} | set(ids_in(results))
        for question in {q["id"] for q in results["questions"] + results["supporting"]}:
            here = {i.removeprefix(question + "_") for i in ids if i.startswith(question + "_")}
            whats = {i.removeprefix(mesh + "_") for i in here if i.startswith(mesh + "_")}
            others = {i for i in here if not i.startswith(mesh + "_")}
            self.assertEqual([(x, y) for x in whats | others for y in whats if x.endswith("_" + y)], [], question)

    def test_a_mesh_given_twice_is_refused_before_any_work(self):
        folder = temporary_folder(self)
        mesh = sample(folder, "cube8", "obj")
        process = run("report", "--quick", "--out", folder / "out", mesh, mesh)
        self.assertEqual(process.returncode, 2)
        self.assertIn("is given twice", process.stderr)
        self.assertFalse((folder / "out").exists())

    def test_a_report_beside_its_meshes_is_replaced_like_any_other(self):
        folder = temporary_folder(self)
        sample(folder, "cube8", "obj")
        for _ in range(2):
            process = run("report", "--quick", "--only", "q2", "--size", 64, "--out", folder / "report", "--data", folder)
            self.assertEqual(process.returncode, 0, process.stderr)

    def test_the_assignments_own_meshes(self):
        data = SOURCE.parent / "shared" / "meshes" / "coursework"
        if not data.is_dir():
            self.skipTest("the assignment's meshes are not beside the project")
        out = temporary_folder(self) / "out"
        process = run("report", "--quick", "--size", 64, "--out", out, "--data", data)
        self.assertEqual(process.returncode, 0, process.stderr)
        inputs = {i["asked"]: i for q in json.loads((out / "results.json").read_text())["questions"] for i in q["inputs"] if i["asked"]}
        self.assertFalse(inputs["decompose/armadillo.obj"]["stand_in"])
        self.assertEqual(inputs["decompose/armadillo.obj"]["vertices"], 361)


if __name__ == "__main__":
    unittest.main(verbosity=2)
