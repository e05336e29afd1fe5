"""`meshfolio batch`: a report for each mesh, and an index. Finished reports are never made again; a failure affects its own row only."""

import csv
import json
import os
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree
from pathlib import Path

from program import PROGRAM, run, sample, temporary_folder

LIGHT = ["--only", "q5,q6,certificates", "--size", 64]   # sections that the index shows; question 6 gives its picture
LIGHTEST = ["--only", "certificates", "--size", 64]
FILES = ("index.html", "batch.json", "batch.csv", "junit.xml")


def contents(out):
    return {name: (out / name).read_bytes() for name in FILES}


def rows(out):
    return {row["name"]: row for row in json.loads((out / "batch.json").read_text())["meshes"]}


def leftovers(out):
    return [p.name for p in out.iterdir() if ".tmp-" in p.name or ".part-" in p.name or ".old-" in p.name]


def processes_about(text):
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if text.encode() in (folder / "cmdline").read_bytes() and int(folder.name) != os.getpid():
                found.append(int(folder.name))
        except OSError:
            pass
    return found


class Batches(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls)
        cls.meshes = cls.folder / "meshes"
        (cls.meshes / "more").mkdir(parents=True)
        sample(cls.meshes, "cube8")
        sample(cls.meshes, "sphere", "ply")
        sample(cls.meshes / "more", "cube8", "off")
        cls.out = cls.folder / "one"
        cls.process = run("batch", cls.meshes, "--out", cls.out, "--jobs", 1, "--no-timings", *LIGHT)

    def ended(self, code, *words, **environment):
        process = run("batch", *words, **environment)
        self.assertEqual(process.returncode, code, process.stderr)
        return process

    # ---- the index

    def test_every_mesh_has_a_report_and_a_row(self):
        self.assertIn(self.process.returncode, (0, 1), self.process.stderr)
        found = rows(self.out)
        self.assertEqual(list(found), ["cube8", "cube8-2", "sphere"])   # meshes/cube8.obj, meshes/more/cube8.off, meshes/sphere.ply
        self.assertEqual(self.process.returncode, int(any(row["checks"]["failed"] for row in found.values())))
        for name, row in found.items():
            results = json.loads((self.out / name / "results.json").read_text())
            self.assertTrue((self.out / row["report"]).is_file())
            checks = [check for section in results["questions"] + results["supporting"] for check in section["checks"]]
            self.assertEqual(sum(row["checks"].values()), len(checks))
            self.assertIn(row["worst_check"]["id"], {check["id"] for check in checks})
            self.assertEqual(row["sha256"], results["provenance"]["inputs"][0]["sha256"])
            for key in ("vertices", "edges", "triangles", "components", "boundary_loops", "euler_characteristic", "lambda_crit"):
                self.assertIsInstance(row[key], (int, float), key)
            self.assertEqual(row["euler_characteristic"], 2)
            self.assertEqual(row["vertices"] - row["edges"] + row["triangles"], 2)
            self.assertGreater(row["lambda_crit"], 0)
            self.assertEqual(row["manifold"], "yes")
            self.assertNotIn("seconds", row)
            self.assertEqual([p.name for p in (self.out / name / "images").glob("q5_*_+x.png")], [])
        self.assertIn("3 meshes, 1 at a time", self.process.stderr)
        self.assertIn(" s left", self.process.stderr)
        self.assertEqual(self.process.stdout.strip(), str(self.out / "index.html"))
        self.assertEqual(leftovers(self.out), [])

    def test_the_files_of_the_index_agree(self):
        found = rows(self.out)
        with open(self.out / "batch.csv", newline="") as file:
            table = list(csv.DictReader(file))
        self.assertEqual([row["mesh"] for row in table], list(found))
        self.assertEqual([float(row["λ_crit [length²]"]) for row in table], [row["lambda_crit"] for row in found.values()])
        suites = list(xml.etree.ElementTree.parse(self.out / "junit.xml").getroot().iter("testsuite"))
        self.assertEqual([suite.get("name").split(":")[0] for suite in suites], list(found))
        for suite, row in zip(suites, found.values()):
            self.assertEqual(int(suite.get("failures")), row["checks"]["failed"])
            self.assertEqual(len(list(suite.iter("testcase"))), int(suite.get("tests")))
        page = (self.out / "index.html").read_text()
        root = xml.etree.ElementTree.fromstring(page.replace("<!DOCTYPE html>", ""))
        space = {"h": "http://www.w3.org/1999/xhtml"}
        table = root.find(".//h:table/h:tbody", space)
        self.assertEqual(len(table), 3)
        width = len(root.find(".//h:table/h:thead/h:tr", space))
        for row in table:
            self.assertEqual(len(row), width)
        links = {link.get("href") for link in root.iterfind(".//h:a", space)}
        for link in links - {"#content"}:
            self.assertTrue((self.out / link).is_file(), link)
        for picture in root.iterfind(".//h:img", space):
            self.assertTrue(picture.get("src").startswith("data:image/jpeg;base64,"))
            self.assertTrue(picture.get("alt"))
        self.assertGreater(len(list(root.iterfind(".//h:img", space))), 0)
        self.assertIn("default-src &#39;none&#39;", page)

    def test_the_same_bytes_whatever_the_number_of_jobs(self):
        out = temporary_folder(self) / "two"
        run("batch", self.meshes, "--out", out, "--jobs", 2, "--no-timings", *LIGHT)
        self.assertEqual(contents(out), contents(self.out))
        for name in rows(out):
            self.assertEqual((out / name / "SHA256SUMS").read_bytes(), (self.out / name / "SHA256SUMS").read_bytes())

    # ---- named meshes

    def test_lists_patterns_and_one_mesh_named_twice(self):
        folder = temporary_folder(self)
        text = f"# two of them\n\n  {self.meshes}/sp*.ply \r\n{os.path.relpath(self.meshes / 'cube8.obj', folder)}\n"
        (folder / "list.txt").write_text(text)
        named = [[f"@{folder}/list.txt", self.meshes / "sphere.ply"], ["--list", folder / "list.txt"]]
        for number, words in enumerate(named):
            out = folder / f"out{number}"
            run("batch", *words, "--out", out, "--only", "q2", "--size", 64)
            self.assertEqual(list(rows(out)), ["sphere", "cube8"])

    def test_missing_meshes_are_refused_before_any_work(self):
        folder = temporary_folder(self)
        out = folder / "out"
        (folder / "list.txt").write_text("\nnone.obj\n")
        (folder / "empty").mkdir()
        self.assertIn("sphere.ply", self.ended(3, self.meshes / "spere.ply", "--out", out).stderr)
        self.assertIn("list.txt:2: ", self.ended(3, f"@{folder}/list.txt", "--out", out).stderr)
        for missing in (folder / "empty", folder / "*.obj", f"@{folder}/none.txt"):
            self.ended(3, self.meshes / "sphere.ply", missing, "--out", out)
        for wrong in (["--jobs", 0], ["--jobs", "many"], ["--only", "q9"], ["--time", "soon"]):
            self.ended(2, self.meshes, "--out", out, *wrong)
        self.ended(2, "--out", out)
        self.ended(2, self.meshes)
        self.assertFalse(out.exists())

    def test_a_foreign_folder_is_left_alone(self):
        folder = temporary_folder(self)
        (folder / "notes.txt").write_text("mine")
        self.ended(4, self.meshes, "--out", folder)
        self.ended(4, self.meshes, "--out", folder / "notes.txt")
        self.assertEqual([p.name for p in folder.iterdir()], ["notes.txt"])
        self.assertEqual(run("report", "--quick", "--only", "q2", "--out", self.out).returncode, 4)
        inside = sample(self.out / "cube8", "sphere", "ply")
        self.addCleanup(inside.unlink)
        self.assertIn("lies in", self.ended(2, inside, "--out", self.out).stderr)

    # ---- failures

    def test_a_broken_mesh_affects_only_its_row(self):
        folder = temporary_folder(self)
        (folder / "broken.obj").write_text("v 0 0 0\nv 1 0 0\nf 1 2 9\n")
        (folder / "empty.ply").write_text("")
        sphere = sample(folder, "sphere", "ply")
        out = folder / "out"
        process = self.ended(1, folder / "broken.obj", sphere, folder / "empty.ply", "--out", out, "--jobs", 2, *LIGHT)
        found = rows(out)
        self.assertEqual([row["status"] == "failed" for row in found.values()], [True, False, True])
        self.assertRegex(found["broken"]["error"], r"broken\.obj:3: ")
        for name in ("broken", "empty"):
            self.assertNotIn("\n", found[name]["error"])
            self.assertIn(found[name]["error"].split(": ")[1], process.stderr)
            self.assertFalse((out / name).exists())
        self.assertGreater(found["sphere"]["seconds"], 0)
        suites = {suite.get("name").split(":")[0]: suite for suite in xml.etree.ElementTree.parse(out / "junit.xml").getroot().iter("testsuite")}
        self.assertEqual(suites["broken"].get("errors"), "1")
        self.assertEqual(suites["broken"].find("testcase/error").get("message"), found["broken"]["error"])
        page = (out / "index.html").read_text()
        self.assertIn("2</b> without a report", page)
        (folder / "broken.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
        before = (out / "sphere" / "results.json").stat().st_ino
        run("batch", folder / "broken.obj", sphere, "--out", out, *LIGHT)
        self.assertEqual({name: row["status"] == "failed" for name, row in rows(out).items()}, {"broken": False, "sphere": False})
        self.assertEqual((out / "sphere" / "results.json").stat().st_ino, before)

    def test_a_report_with_a_failed_section_is_linked_and_made_again(self):
        out = temporary_folder(self) / "out"
        words = [self.meshes / "sphere.ply", "--out", out, *LIGHT]
        self.ended(1, *words, MESHFOLIO_FAIL="q5")
        self.assertEqual(rows(out)["sphere"]["status"], "checks failed")
        self.assertIsNone(rows(out)["sphere"]["lambda_crit"])
        run("batch", *words)
        self.assertGreater(rows(out)["sphere"]["lambda_crit"], 0)

    # ---- finished reports are not made again

    def inodes(self, out):
        return {name: (out / name / "results.json").stat().st_ino for name in rows(out) if (out / name / "results.json").exists()}

    def test_a_second_run_makes_nothing_and_other_settings_make_all(self):
        folder = temporary_folder(self)
        mesh, out = sample(folder, "sphere", "ply"), folder / "out"
        run("batch", mesh, "--out", out, "--no-timings", *LIGHTEST)
        first, files = self.inodes(out), contents(out)
        process = run("batch", mesh, "--out", out, "--no-timings", *LIGHTEST)
        self.assertIn("1 mesh, 1 done before\n", process.stderr)
        self.assertEqual((self.inodes(out), contents(out)), (first, files))
        run("batch", mesh, "--out", out, *LIGHTEST)   # with timings
        second = self.inodes(out)
        self.assertNotEqual(second, first)
        self.assertIn("seconds", rows(out)["sphere"])
        run("batch", mesh, "--out", out, *LIGHTEST[:-1], 72)
        third = self.inodes(out)
        self.assertNotEqual(third, second)
        sample(folder, "sphere", "ply", 1)   # other bytes under the same name
        run("batch", mesh, "--out", out, *LIGHTEST[:-1], 72)
        self.assertNotEqual(self.inodes(out), third)

    def begun(self, out):
        """Starts a run with one job and waits for its first report."""
        words = [PROGRAM, "batch", self.meshes, "--out", out, "--jobs", "1", "--no-timings", *LIGHT]
        environment = {**os.environ, "XDG_CACHE_HOME": str(out.parent / "cache")}
        process = subprocess.Popen([str(word) for word in words], env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        limit = time.monotonic() + 200
        while not (out / "cube8" / "results.json").exists():
            self.assertIsNone(process.poll())
            self.assertLess(time.monotonic(), limit)
            time.sleep(0.02)
        return process

    def require_all_ended(self, out):
        limit = time.monotonic() + 20
        while processes_about(str(out)) and time.monotonic() < limit:
            time.sleep(0.05)
        self.assertEqual(processes_about(str(out)), [])

    def require_resumed(self, out):
        kept = (out / "cube8" / "results.json").stat().st_ino
        process = run("batch", self.meshes, "--out", out, "--no-timings", *LIGHT)
        self.assertRegex(process.stderr, "3 meshes, [123] done before")
        self.assertEqual((out / "cube8" / "results.json").stat().st_ino, kept)
        self.assertEqual(contents(out), contents(self.out))
        self.assertEqual(leftovers(out), [])

    def test_after_a_kill_it_continues(self):
        out = temporary_folder(self) / "out"
        process = self.begun(out)
        process.kill()
        process.communicate()
        self.require_all_ended(out)
        self.require_resumed(out)

    def test_an_interrupt_ends_its_children_and_keeps_finished_reports(self):
        out = temporary_folder(self) / "out"
        process = self.begun(out)
        process.send_signal(signal.SIGINT)
        stderr = process.communicate(timeout=20)[1]
        self.assertEqual(process.returncode, 130, stderr)
        self.require_all_ended(out)
        self.assertEqual(leftovers(out), [])
        json.loads((out / "batch.json").read_text())
        self.require_resumed(out)

    def test_two_batches_at_once_do_not_mix(self):
        out = temporary_folder(self) / "out"
        process = self.begun(out)
        self.assertIn("busy", self.ended(4, self.meshes, "--out", out, *LIGHT).stderr)
        process.communicate(timeout=280)
        self.assertEqual(contents(out), contents(self.out))


if __name__ == "__main__":
    unittest.main(verbosity=2)
