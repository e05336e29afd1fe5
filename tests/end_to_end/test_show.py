"""`show` gives what a report has: tables, columns and cells with all digits, paths of figures."""

import csv
import json
import shutil
import tempfile
import unittest
from pathlib import Path

from program import run
from quick_report import quick_report


class Show(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        _, cls.out, _ = quick_report(folder.name)
        cls.sections = json.loads((cls.out / "results.json").read_text())["questions"]

    def show(self, *words, report=None):
        process = run("show", report or self.out, *words)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        return process.stdout

    def refuse(self, code, *words, report=None):
        process = run("show", report or self.out, *words)
        self.assertEqual((process.returncode, process.stdout, process.stderr.count("\n")), (code, "", 1), process.stderr)
        return process.stderr

    def test_a_table_is_its_file(self):
        files = sorted((self.out / "tables").glob("*.csv"))
        for file in files[::5]:
            self.assertEqual(self.show(file.stem), file.read_text(), file.stem)
        self.assertEqual(self.show(files[0].stem, report=self.out / "results.json"), files[0].read_text())

    def test_a_cell_is_that_of_the_results(self):
        tables = [table for section in self.sections for table in section["tables"] if table["id"] in ("q1_errors", "q7_results", "q6_prices")]
        self.assertEqual(len(tables), 3)
        for table in tables:
            row, columns = table["rows"][-1], [column["name"] for column in table["columns"]]
            numbers = [c for c, cell in enumerate(row) if isinstance(cell, float)]
            head = next(csv.reader(self.show(table["id"]).splitlines()))
            keys = [f"{head[c]}={row[c]}" for c in range(len(row)) if isinstance(row[c], str) and row[c]]
            keys += [f"{head[c]}={row[c]!r}" for c in numbers]   # all of them together select one row
            for c in numbers[:3]:
                self.assertEqual(float(self.show(table["id"], head[c], *keys)), row[c], (table["id"], columns[c]))
                column = self.show(table["id"], head[c]).splitlines()
                self.assertEqual(column[1:], [line.split("\n")[0] for line in self.column(table["id"], c)])

    def column(self, table, c):
        return [row[c] for row in list(csv.reader(self.show(table).splitlines()))[1:]]

    def test_a_column_without_its_signs_and_a_plot(self):
        whole = self.show("q1_errors", "uniform H", "surface=sphere", "triangulation=regular")
        self.assertEqual(self.show("q1_errors", "uniform-h", "SURFACE=sphere", "triangulation=regular"), whole)
        self.assertEqual(len(self.show("q1_errors", "surface=sphere").splitlines()), 3, "head and two rows")
        self.assertEqual(self.show("q7_error", "series").splitlines()[0], "series")

    def test_a_figure_is_a_path(self):
        figure = next(figure for section in self.sections for figure in section["figures"] if figure.get("sheet"))
        for report in (self.out, self.out / "results.json"):
            path = Path(self.show(figure["id"], report=report).strip())
            self.assertEqual(path, self.out / figure["sheet"])
            self.assertTrue(path.is_file())
        shutil.copy(self.out / "results.json", self.folder / "results.json")
        self.assertIn("is not there; restore it", self.refuse(3, figure["id"], report=self.folder))
        self.assertIn("is a figure", self.refuse(2, figure["id"], "rms"))

    def test_wrong_names_are_told_the_right_ones(self):
        self.assertIn("did you mean 'q1_errors'?", self.refuse(2, "q1_erors"))
        self.assertIn("did you mean 'uniform H [%]'?", self.refuse(2, "q1_errors", "unifrom H [%]"))
        self.assertIn("it has surface, triangulation", self.refuse(2, "q1_errors", "none=sphere"))
        self.assertIn("did you mean 'sphere'?", self.refuse(2, "q1_errors", "uniform H", "surface=spere"))
        self.assertIn("differ in triangulation", self.refuse(2, "q1_errors", "uniform H", "surface=sphere"))
        self.assertIn("second column", self.refuse(2, "q1_errors", "uniform H", "order of H"))
        self.assertIn("none", self.refuse(3, "q1_errors", report=self.folder / "none"))
        damaged = self.folder / "damaged"
        damaged.mkdir()
        (damaged / "results.json").write_text("{}")
        self.assertIn("results.json", self.refuse(3, "q1_errors", report=damaged))


if __name__ == "__main__":
    unittest.main()
