"""Marks of a class: right answers keep all points, planted mistakes are recognised, hostile submissions are refused by name."""

import concurrent.futures
import csv
import io
import json
import time
import unittest
import zipfile
from pathlib import Path

from file_readers import obj, ply
from program import run, sample, temporary_folder

RUBRIC = """
title = "Small class"
[[item]]
id = "uniform"
what = "H_uniform"
mesh = "lily.obj"
file = "q1_*.csv"
column = ["H", "h_uniform"]
points = 10
[[item]]
id = "gauss"
what = "K"
mesh = "lily.obj"
file = "q1_*.csv"
column = "k_gauss"
free = "area"
points = 10
[[item]]
id = "cotan"
what = "H"
mesh = "lily.obj"
file = "q3_*.csv"
column = ["H", "h_cotan"]
free = "area"
points = 10
[[item]]
id = "eigenvalues"
what = "eigenvalues"
mesh = "saddle.obj"
file = "q4_*.csv"
column = "eigenvalue"
k = 10
tolerance = 1e-6
points = 10
[[item]]
id = "k15"
what = "reconstruction"
mesh = "saddle.obj"
file = "q4_*_k15.*"
k = 15
tolerance = 1e-6
points = 10
[[item]]
id = "smoothed"
what = "smoothed"
mesh = "lily.obj"
file = "q5_*.ply"
lambda = 0.5
unit = "tau"
iterations = 5
free = ["iterations", "lambda"]
tolerance = 1e-6
points = 10
[[item]]
id = "kappa"
what = "number"
value = 2.0
points = 10
"""
ITEMS = 7


def column_times(text, column, factor):
    """Returns the CSV with a column multiplied by a number, or changed by a function of row and value."""
    rows = list(csv.DictReader(io.StringIO(text)))
    change = factor if callable(factor) else lambda row, value: factor * value
    for i, row in enumerate(rows):
        if row[column]:
            row[column] = repr(change(i, float(row[column])))
    out = io.StringIO()
    writer = csv.DictWriter(out, rows[0].keys(), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return out.getvalue()


def renamed(text, column, others):
    """Returns the CSV with one column replaced by another."""
    header, rest = text.split("\n", 1)
    names = ["was_" + name if name in others else name for name in header.split(",")]
    return ",".join(others[0] if name == column else name for name in names) + "\n" + rest


def with_turned_faces(path):
    vertices, triangles = ply(path)
    lines = ["v %r %r %r" % tuple(v) for v in vertices] + ["f %d %d %d" % (a + 1, c + 1, b + 1) for a, b, c in triangles]
    return "\n".join(lines) + "\n"


class Mark(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls)
        for name in ("lily", "saddle"):
            sample(cls.folder, name)
        (cls.folder / "rubric.toml").write_text(RUBRIC)
        cls.right = cls.answers()
        cls.wrong = cls.mistakes()

    @classmethod
    def made(cls, *words):
        process = run(*words, cwd=cls.folder)
        assert process.returncode == 0, process.stderr
        return process.stdout

    @classmethod
    def curvature(cls, *options):
        return cls.made("curvature", "lily.obj", *options)

    @classmethod
    def spectrum(cls, k, *options):
        """Returns the CSV, and the mesh reconstructed from all k modes."""
        out = cls.folder / ("modes" + "_".join([str(k), *options]).replace("-", ""))
        table = cls.made("spectrum", "saddle.obj", "-k", k, "--csv", "-", "--reconstruct", k, "--out", out, *options)
        return table, out / f"saddle_k{k}.ply"

    @classmethod
    def smoothed(cls, *options, step=0.5, iterations=5):
        out = cls.folder / "smoothed.ply"
        cls.made("smooth", "lily.obj", "-o", out, "--lambda", step, "--unit", "tau", "--iterations", iterations, *options)
        return out.read_bytes()

    @classmethod
    def answers(cls):
        """Makes a submission without mistakes, by the program's own commands."""
        table, rebuilt = cls.spectrum(15)
        cls.rebuilt = rebuilt
        curvature = cls.curvature()
        return {"q1_lily.csv": curvature, "q3_lily.csv": curvature, "q4_saddle.csv": table, "q4_saddle_k15.ply": rebuilt.read_bytes(),
                "q5_lily.ply": cls.smoothed(), "answers.toml": "kappa = 2.0\n"}

    @classmethod
    def mistakes(cls):
        """Returns [(item, conventions that must be recognised, changed files of the submission)]."""
        plain, voronoi = cls.right["q1_lily.csv"], cls.curvature("--area", "voronoi")
        mixed, table = cls.curvature("--area", "mixed"), cls.right["q4_saddle.csv"]
        edge = cls.curvature("--operator", "edge-normalised")
        _, triangles = obj(cls.folder / "lily.obj")
        ring = {}
        for triangle in triangles:
            for a in triangle:
                ring.setdefault(a, set()).update(b for b in triangle if b != a)
        area = [float(row["area"] or 0) for row in csv.DictReader(io.StringIO(plain))]
        q1, q3 = lambda text: {"q1_lily.csv": text}, lambda text: {"q3_lily.csv": text}
        q4, k15 = lambda text: {"q4_saddle.csv": text}, lambda data: {"q4_saddle_k15.ply": data}
        q5 = lambda data: {"q5_lily.ply": data}
        eigenvalues = lambda *options: cls.spectrum(15, *options)[0]
        without_zero = table.split("\n")
        del without_zero[1]
        return [
            ("uniform", ["doubled"], q1(column_times(plain, "h_uniform", 2))),
            ("uniform", ["negated"], q1(column_times(plain, "h_uniform", -1))),
            ("uniform", ["valence_sum"], q1(column_times(plain, "h_uniform", lambda i, x: x * len(ring[i])))),
            ("uniform", ["scaled"], q1(renamed(plain, "h_uniform_scaled", ["h_uniform"]))),
            ("gauss", ["area_voronoi"], q1(voronoi)),
            ("gauss", ["area_mixed"], q1(mixed)),
            ("gauss", ["without_area"], q1(column_times(plain, "k_gauss", lambda i, x: x * area[i]))),
            ("gauss", ["whole_ring"], q1(column_times(plain, "k_gauss", 1 / 3))),
            ("gauss", ["negated"], q1(column_times(plain, "k_gauss", -1))),
            ("cotan", ["doubled"], q3(column_times(plain, "h_cotan", 2))),
            ("cotan", ["halved"], q3(column_times(plain, "h_cotan", 0.5))),
            ("cotan", ["negated"], q3(column_times(plain, "h_cotan", -1))),
            ("cotan", ["magnitude"], q3(column_times(plain, "h_cotan", lambda i, x: abs(x)))),
            ("cotan", ["doubled", "negated"], q3(column_times(plain, "h_cotan", -2))),
            ("cotan", ["area_voronoi"], q3(voronoi)),
            ("cotan", ["area_mixed"], q3(mixed)),
            ("cotan", ["area_voronoi", "negated"], q3(column_times(voronoi, "h_cotan", -1))),
            ("cotan", ["operator_edge-normalised"], q3(renamed(edge, "h_edge_normalised", ["h_cotan"]))),
            ("eigenvalues", ["negated"], q4(column_times(table, "eigenvalue", -1))),
            ("eigenvalues", ["doubled"], q4(column_times(table, "eigenvalue", 2))),
            ("eigenvalues", ["zero_left_out"], q4("\n".join(without_zero))),
            ("eigenvalues", ["area_voronoi"], q4(eigenvalues("--area", "voronoi"))),
            ("eigenvalues", ["half_kept"], q4(column_times(eigenvalues("--operator", "edge-normalised"), "eigenvalue", 0.5))),
            ("eigenvalues", ["operator_uniform"], q4(eigenvalues("--operator", "uniform"))),
            ("k15", ["one_less"], k15(cls.spectrum(14)[1].read_bytes())),
            ("k15", ["one_more"], k15(cls.spectrum(16)[1].read_bytes())),
            ("k15", ["area_mixed"], k15(cls.spectrum(15, "--area", "mixed")[1].read_bytes())),
            ("k15", ["reversed_faces"], {"q4_saddle_k15.ply": None, "q4_saddle_k15.obj": with_turned_faces(cls.rebuilt)}),
            ("smoothed", ["one_more"], q5(cls.smoothed(iterations=6))),
            ("smoothed", ["lambda_halved"], q5(cls.smoothed(step=0.25))),
            ("smoothed", ["lambda_doubled"], q5(cls.smoothed(step=1))),
            ("smoothed", ["operator_cotan-no-half"], q5(cls.smoothed(step=1))),   # the same steps
            ("smoothed", ["other_scheme"], q5(cls.smoothed("--scheme", "implicit"))),
            ("smoothed", ["operator_uniform"], q5(cls.smoothed("--operator", "uniform"))),   # with its own largest stable step
            ("smoothed", ["other_rebuild"], q5(cls.smoothed("--rebuild"))),
            ("kappa", ["halved"], {"answers.toml": "kappa = 1.0\n"}),
            ("kappa", ["inverse"], {"answers.toml": "[kappa]\nvalue = 0.5\n"}),
        ]

    def zipped(self, path, files):
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            for name, data in files.items():
                if data is not None:
                    archive.writestr(name, data)
        return path

    def marked(self, code, submissions, *options):
        out = temporary_folder(self) / "marks"
        process = run("mark", *submissions, "--rubric", self.folder / "rubric.toml", "--out", out, *options)
        self.assertEqual(process.returncode, code, process.stderr)
        return out, process

    def results_of(self, out, student):
        return {test["number"]: test for test in json.loads((out / student / "results.json").read_text())["tests"]}

    # ---- right answers and known mistakes

    def test_a_class_of_a_hundred(self):
        """A student with each mistake, and students without mistakes between them; folders and zips."""
        folder, plan = temporary_folder(self), []
        for i in range(100):
            mistake = self.wrong[i // 2 % len(self.wrong)] if i % 2 else None
            files = {**self.right, **(mistake[2] if mistake else {})}
            name = f"student{i:03}"
            path = self.zipped(folder / f"{name}.zip", {f"work/{file}": data for file, data in files.items()})
            if i % 3 == 0:
                with zipfile.ZipFile(path) as archive:
                    archive.extractall(folder / name)
                path = folder / name
            plan.append((name, path, mistake))
        began = time.monotonic()
        out, process = self.marked(0, [path for _, path, _ in plan])
        seconds = time.monotonic() - began
        self.assertLess(seconds, 120, "a class of a hundred")
        self.assertEqual(process.stdout.strip(), str(out / "class.csv"))
        for name, _, mistake in plan:
            tests = self.results_of(out, name)
            self.assertEqual(len(tests), ITEMS)
            for item, test in tests.items():
                if mistake is None or item != mistake[0]:
                    self.assertEqual(test["score"], 10, (name, item, mistake and mistake[:2], test["output"]))
                else:
                    self.assertIn(mistake[1], test["extra_data"]["conventions"], (mistake[:2], test["output"]))
                    self.assertEqual((test["score"], test["max_score"]), (5, 10), mistake[:2])
            page = (out / name / "index.html").read_text()
            self.assertIn("right but for a convention" if mistake else "70 <small>of 70</small>", page)
            pictured = mistake and mistake[0] not in ("eigenvalues", "kappa") and mistake[1] != ["reversed_faces"]
            self.assertEqual(page.count("src=\"data:image/jpeg;base64,/9j/"), 1 if pictured else 0, name)
        rows = list(csv.DictReader((out / "class.csv").read_text().splitlines()))
        self.assertEqual([row["student"] for row in rows], [name for name, _, _ in plan])
        table = (out / "class.html").read_text()
        self.assertEqual(table.count('<td class="mark '), 100 * ITEMS)
        self.assertEqual(table.count('<td class="mark partial"'), 50)
        self.assertTrue(all(f'href="{name}/index.html"' in table for name, _, _ in plan))
        self.assertEqual({row["score"] for row, (_, _, mistake) in zip(rows, plan) if mistake is None}, {"70"})

    def test_all_mistakes_in_all_items_are_recognised_with_rounding(self):
        noisy = column_times(self.right["q3_lily.csv"], "h_cotan", lambda i, x: x * (1 + 0.1 * (i % 7)))
        path = self.zipped(temporary_folder(self) / "noisy.zip", {**self.right, "q3_lily.csv": noisy})
        out, _ = self.marked(0, [path])
        test = self.results_of(out, "noisy")["cotan"]
        self.assertEqual((test["score"], test["extra_data"]["verdict"]), (0, "wrong"))

    def test_separators_quotes_and_line_ends_change_nothing(self):
        q1, q4 = self.right["q1_lily.csv"], self.right["q4_saddle.csv"]
        cells = [line.split(",") for line in q1.splitlines()]
        one = lambda column: [row[cells[0].index(column)] for row in cells]
        six = lambda text: "\n".join(",".join(f"{float(x):f}" if i and x else x for x in line.split(",")) for i, line in enumerate(text.splitlines()))
        parted = lambda by: "\n".join(by.join(row) for row in cells) + "\n"
        quoted = "\n".join([",".join(f'"{name}"' for name in cells[0])] + q1.splitlines()[1:])
        dresses = [q1 + "\n\n", parted(";"), parted(";").replace(".", ","), parted("\t"), parted(" , "), quoted, "# " + q1, q1.upper().replace("E-", "e-"),
                   q1.replace("\n", "\r\n"), q1.replace("\n", "\r\r\n"), "\ufeff" + q1, q1.replace(",,", ",inf,"), q1.replace(",,", ",nan,"), six(q1)]
        plans = [{"q1_lily.csv": dress} for dress in dresses]
        plans += [{"q3_lily.csv": "\n".join(one("h_cotan")[1:]) + "\n"}, {"q3_lily.csv": "# H\n" + " \n".join(x or "nan" for x in one("h_cotan")[1:])},
                  {"q4_saddle.csv": six(q4)}, {"q1_lily.csv": None, "Q1_LILY.CSV": q1, "q5_lily.ply": None, "Q5_lily.PLY": self.right["q5_lily.ply"]}]
        folder = temporary_folder(self)
        paths = [self.zipped(folder / f"dress{i:02}.zip", {**self.right, **plan}) for i, plan in enumerate(plans)]
        out, _ = self.marked(0, paths)
        for path, plan in zip(paths, plans):
            for item, test in self.results_of(out, path.stem).items():
                self.assertEqual(test["score"], 10, (path.stem, item, test["output"], {name: data and data[:80] for name, data in plan.items()}))

    def test_settings_that_the_student_names(self):
        named = "kappa = 2.0\n[cotan]\narea = \"voronoi\"\n[gauss]\narea = \"mixed\"\n[smoothed]\niterations = 7\nlambda = 0.25\n"
        files = {**self.right, "answers.toml": named, "q1_lily.csv": self.curvature("--area", "mixed"),
                 "q3_lily.csv": self.curvature("--area", "voronoi"), "q5_lily.ply": self.smoothed(step=0.25, iterations=7)}
        out, _ = self.marked(0, [self.zipped(temporary_folder(self) / "own.zip", files)])
        for item, test in self.results_of(out, "own").items():
            self.assertEqual(test["score"], 10, (item, test["output"]))

    def test_missing_and_damaged_files_affect_only_their_item(self):
        files = {**self.right, "q1_lily.csv": None, "q3_lily.csv": "H\nabc\n", "q5_lily.ply": b"ply\nformat ascii 1.0\nelement vertex 900000000\n",
                 "answers.toml": "kappa = \n"}
        out, _ = self.marked(0, [self.zipped(temporary_folder(self) / "holes.zip", files)])
        verdicts = {item: test["extra_data"]["verdict"] for item, test in self.results_of(out, "holes").items()}
        self.assertEqual(verdicts, {"uniform": "missing", "gauss": "missing", "cotan": "unusable", "eigenvalues": "right", "k15": "right",
                                    "smoothed": "unusable", "kappa": "missing"})

    # ---- hostile submissions

    def hostile(self, folder):
        """Returns [(file, words of the message about it)]."""
        def one(name, entry, data="x"):
            with zipfile.ZipFile(folder / name, "w", zipfile.ZIP_DEFLATED) as archive:
                archive.writestr(entry, data)
            return name
        link = zipfile.ZipInfo("link.csv")
        link.create_system, link.external_attr = 3, 0o120777 << 16
        linked = folder / "linked"
        linked.mkdir()
        (linked / "h.csv").symlink_to("/etc/passwd")
        with zipfile.ZipFile(folder / "many.zip", "w") as archive:
            for i in range(5001):
                archive.writestr(f"{i}.txt", "")
        (folder / "text.zip").write_text("no zip")
        whole = self.zipped(folder / "whole.zip", self.right).read_bytes()
        (folder / "cut.zip").write_bytes(whole[: len(whole) // 2])
        return [(one("up.zip", "../../up.csv"), "leads outside"), (one("root.zip", "/tmp/root.csv"), "absolute"),
                (one("back.zip", "..\\..\\b.csv"), ""), (one("bomb.zip", "bomb.csv", bytes(60 << 20)), "zip bomb"),
                (one("large.zip", "large.csv", bytes(65 << 20)), ""), (one("link.zip", link, "/etc/passwd"), "is a link"),
                ("linked", "is a link"), ("many.zip", "5000 entries"), ("text.zip", "zip"), ("cut.zip", "")]

    def test_hostile_submissions_are_refused_by_name_and_the_others_marked(self):
        folder = temporary_folder(self)
        cases = self.hostile(folder)
        good = self.zipped(folder / "good.zip", self.right)
        out, process = self.marked(1, [*(folder / name for name, _ in cases), good])
        lines = process.stderr.splitlines()
        for name, words in cases:
            told = [line for line in lines if str(folder / name) in line]
            self.assertEqual(len(told), 1, (name, process.stderr))
            self.assertIn(words, told[0])
        rows = {row["submission"]: row for row in csv.DictReader((out / "class.csv").read_text().splitlines())}
        self.assertEqual(rows["good.zip"]["score"], "70")
        self.assertEqual({rows[name]["score"] for name, _ in cases}, {"0"})
        self.assertTrue((out / "bomb" / "results.json").is_file())
        self.assertFalse(list(folder.glob("**/up.csv")) + [p for p in [Path("/tmp/root.csv")] if p.exists()])

    def test_names_do_not_collide_or_leave_the_folder(self):
        folder = temporary_folder(self)
        paths = []
        for name in ("a/ada.zip", "b/ada.zip", "c/=1+1 .zip", "d/class.csv.zip", "e/.hidden.zip"):
            (folder / name).parent.mkdir()
            paths.append(self.zipped(folder / name, self.right))
        out, _ = self.marked(0, paths)
        rows = list(csv.DictReader((out / "class.csv").read_text().splitlines()))
        self.assertEqual(len({row["student"] for row in rows}), 5)
        self.assertTrue(all((out / row["student"] / "index.html").is_file() for row in rows))
        self.assertFalse([value for row in rows for value in row.values() if value.startswith("=")])

    def test_no_submission_delays_the_class(self):
        """Submissions within the limits that once took hours."""
        folder = temporary_folder(self)
        many = lambda text, n=7 << 20: (text * (n // len(text)))[:n]
        plans = [{"q1_lily.csv": "H" + many(",")}, {"q1_lily.csv": "H\n" + many("1,")}, {"q1_lily.csv": many("0123456789,.")},
                 {"q1_lily.csv": "H\n" + many("\n")}, {"q1_lily.csv": many('"', 1 << 20)}, {"q1_lily.csv": many("#\n", 1 << 20)},
                 {"q1_" + many("x", 60_000) + ".csv": "H"}, {"q4_" + many("_k1", 60_000) + ".csv": "H"},
                 {"answers.toml": "[smoothed]\niterations = 100\nlambda = 0.123\n"}]
        began = time.monotonic()
        for i, plan in enumerate(plans):
            path = self.zipped(folder / f"long{i}.zip", {**self.right, **plan})
            process = run("mark", path, "--rubric", self.folder / "rubric.toml", "--out", folder / f"marks{i}")
            self.assertIn(process.returncode, (0, 1), process.stderr)
            self.assertLess(time.monotonic() - began, 20 * (i + 1), list(plan))

    def test_marks_and_reports_do_not_replace_each_other_and_no_student_is_lost(self):
        folder = temporary_folder(self)
        ada, bob = (self.zipped(folder / f"{name}.zip", self.right) for name in ("ada", "bob"))
        mark = lambda out, *paths: run("mark", *paths, "--rubric", self.folder / "rubric.toml", "--out", out)
        marks, report = folder / "marks", folder / "report"
        report.mkdir()
        (report / ".meshfolio").write_text("This folder was made by meshfolio, which replaces it as a whole.\n")
        for out, words, process in ((report, "a report", mark(report, ada)), (marks, "", mark(marks, ada, bob)),
                                    (marks, "the marks of a class", run("report", self.folder / "lily.obj", "--only", "q1", "--alone", "--quick", "--out", marks)),
                                    (marks, "'bob'", mark(marks, ada)), (marks, "", mark(marks, bob, ada))):
            self.assertEqual(process.returncode, 4 if words else 0, process.stderr)
            self.assertIn(words, process.stderr)
        (marks / "ada" / "notes.txt").write_text("mine")
        process = mark(marks, ada, bob)
        self.assertEqual(process.returncode, 0)
        self.assertIn("notes.txt", process.stderr)
        self.assertEqual((marks / "ada" / "notes.txt").read_text(), "mine")

    def test_concurrent_runs_lose_no_student(self):
        """Several runs mark different students into one new folder: the first succeeds, the others are refused. All may mark the same student."""
        folder = temporary_folder(self)
        for names, codes in ((("ada", "bob", "eve"), [0, 4, 4]), (("ada", "ada", "ada"), [0, 0, 0])):
            out = folder / "-".join(names)
            paths = [self.zipped(folder / f"{name}.zip", self.right) for name in names]
            mark = lambda path: run("mark", path, "--rubric", self.folder / "rubric.toml", "--out", out)
            with concurrent.futures.ThreadPoolExecutor() as threads:
                ends = list(threads.map(mark, paths))
            self.assertEqual(sorted(end.returncode for end in ends), codes, [end.stderr for end in ends])
            rows = [row["student"] for row in csv.DictReader((out / "class.csv").read_text().splitlines())]
            self.assertEqual(rows, [name for name, end in zip(names, ends) if end.returncode == 0][:1])
            for end in ends:
                self.assertTrue(end.returncode == 0 or "who is not among these submissions" in end.stderr, end.stderr)

    def test_remarks_are_limited(self):
        folder = temporary_folder(self)
        keys = "".join(f"key{i} = 1\n" for i in range(60000))
        out, _ = self.marked(0, [self.zipped(folder / "ada.zip", {**self.right, "answers.toml": keys})])
        row = next(csv.DictReader((out / "class.csv").read_text().splitlines()))
        self.assertLess(len(row["remarks"]), 5000)
        self.assertIn("… and 59980 more", row["remarks"])

    # ---- exit codes

    def test_missing_files_are_reported_before_any_work(self):
        folder = temporary_folder(self)
        good, out = self.zipped(folder / "good.zip", self.right), folder / "marks"
        (folder / "bad.toml").write_text("[[item]]\nid = 3\n")
        (folder / "lost.toml").write_text(RUBRIC.replace("lily.obj", "lilly.obj"))
        foreign = folder / "foreign"
        foreign.mkdir()
        (foreign / "thesis.txt").write_text("mine")
        rubric = self.folder / "rubric.toml"
        for code, words in ((3, [folder / "god.zip", "--rubric", rubric, "--out", out]), (3, [good, "--rubric", folder / "no.toml", "--out", out]),
                            (2, [good, "--rubric", folder / "bad.toml", "--out", out]), (3, [good, "--rubric", folder / "lost.toml", "--out", out]),
                            (2, ["--out", out]), (4, [good, "--rubric", rubric, "--out", foreign])):
            process = run("mark", *words)
            self.assertEqual(process.returncode, code, (words, process.stderr))
            self.assertFalse(out.exists())
        self.assertEqual((foreign / "thesis.txt").read_text(), "mine")

    def test_the_same_submissions_make_the_same_bytes(self):
        path = self.zipped(temporary_folder(self) / "ada.zip", {**self.right, **self.wrong[9][2]})
        (first, _), (second, _) = self.marked(0, [path]), self.marked(0, [path])
        for file in sorted(p.relative_to(first) for p in first.rglob("*") if p.is_file()):
            self.assertEqual((first / file).read_bytes(), (second / file).read_bytes(), file)


if __name__ == "__main__":
    unittest.main()
