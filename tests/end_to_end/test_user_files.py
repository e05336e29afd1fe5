"""Commands that replace a folder keep the user's files in it."""

import os
import shutil
import stat
import subprocess
import threading
import unittest
from pathlib import Path

from folders import tree
from program import run, sample, temporary_folder
from quick_report import quick_report

MARK = "This folder was made by meshfolio, which replaces it as a whole.\n"
REPORT = ["--quick", "--only", "certificates", "--alone", "--size", 64, "--no-timings"]
ODD = "two\nlines\udcff.txt"   # a name that is not UTF-8
GIT = shutil.which("git")


def git(folder, *words):
    options = ["-c", "user.name=a", "-c", "user.email=a@b.c", "-c", "safe.directory=*"]
    return subprocess.run([GIT, *options, *words], cwd=folder, capture_output=True, text=True, check=True).stdout


def put_user_files(folder, edited):
    """Puts files of the user into a folder that a command has made."""
    (folder / "thesis.tex").write_text("months of work")
    (folder / "thesis.tex").chmod(0o640)
    os.utime(folder / "thesis.tex", (1, 1_000_000_000))
    (folder / "docs" / "empty").mkdir(parents=True)
    (folder / "docs" / "build.sh").write_text("#!/bin/sh\n")
    (folder / "docs" / "build.sh").chmod(0o755)
    (folder / "docs").chmod(0o750)
    (folder / "link").symlink_to("/nowhere/at/all")
    (folder / "tables").mkdir(exist_ok=True)
    (folder / "tables" / "mine.csv").write_text("a,b\n")
    Path(os.fsdecode(os.fsencode(str(folder)) + b"/" + os.fsencode(ODD))).write_text("odd")
    os.mkfifo(folder / "pipe")
    if edited:
        (folder / edited).write_text("edited by hand")
    if GIT:
        git(folder, "init", "-q", ".")
        git(folder, "add", "thesis.tex", "docs")
        git(folder, "commit", "-q", "-m", "mine")


class Commands(unittest.TestCase):
    """The commands, each with its words, the folder that it replaces, and one of its files."""

    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls)
        cls.mesh = sample(cls.folder, "cube8")
        (cls.folder / "ada").mkdir()
        (cls.folder / "ada" / "answers.toml").write_text("kappa = 2.0\n")
        (cls.folder / "rubric.toml").write_text('[[item]]\nid = "kappa"\nwhat = "number"\nvalue = 2.0\npoints = 3\n')
        cls.part = cls.folder / "part"
        assert run("report", cls.mesh, "--quick", "--only", "certificates", "--size", 64, "--part", cls.part).returncode == 0
        cls.marking = ["mark", cls.folder / "ada", "--rubric", cls.folder / "rubric.toml", "--out"]

    def commands(self):
        own = temporary_folder(self)
        out = own / "out"
        return {
            "report": (["report", self.mesh, *REPORT, "--out", out], out, "report.md"),
            "report --only": (["report", self.mesh, "--quick", "--only", "certificates", "--size", 64, "--no-timings", "--out", own / "renewed"], own / "renewed", "summary.md"),
            "report --part": (["report", self.mesh, "--quick", "--only", "certificates", "--size", 64, "--part", own / "part"], own / "part", "report.md"),
            "report --from": (["report", "--from", self.part / "results.json", "--out", own / "from"], own / "from", "index.html"),
            "merge": (["merge", self.part, "--out", own / "merged"], own / "merged", "report.md"),
            "batch": (["batch", self.mesh, "--only", "certificates", "--size", 64, "--no-timings", "--out", own / "batch"], own / "batch" / "cube8", "report.md"),
            "batch, its index": (["batch", self.mesh, "--only", "certificates", "--size", 64, "--no-timings", "--out", own / "index"], own / "index", "batch.csv"),
            "verify": (["verify", "--quick", "--out", own / "verified"], own / "verified", "report.md"),
            "mark": ([*self.marking, own / "marks"], own / "marks", "class.csv"),
            "render": (["render", self.mesh, "--size", 32, "--views", "+x", "--out", own / "views"], own / "views", "sheet.png"),
            "spectrum": (["spectrum", self.mesh, "-k", 3, "--reconstruct", 3, "--out", own / "modes"], own / "modes", "cube8_k3.ply"),
        }

    def require_kept(self, out, edited, process):
        self.assertEqual(((out / "thesis.tex").read_text(), stat.S_IMODE((out / "thesis.tex").stat().st_mode)), ("months of work", 0o640))
        self.assertEqual((out / "thesis.tex").stat().st_mtime, 1_000_000_000)
        self.assertTrue((out / "docs" / "empty").is_dir())
        self.assertEqual([stat.S_IMODE((out / name).stat().st_mode) for name in ("docs", "docs/build.sh")], [0o750, 0o755])
        self.assertEqual(os.readlink(out / "link"), "/nowhere/at/all")
        self.assertEqual((out / "tables" / "mine.csv").read_text(), "a,b\n")
        self.assertIn(os.fsencode(ODD), os.listdir(os.fsencode(str(out))))
        self.assertTrue((out / "pipe").is_fifo())
        self.assertEqual((out / (edited + ".edited")).read_text(), "edited by hand")
        self.assertNotEqual((out / edited).read_bytes(), b"edited by hand")
        self.assertIn("kept", process.stderr)
        self.assertIn(edited + ".edited", process.stderr)
        if GIT:
            git(out, "fsck", "--strict")
            self.assertEqual([line for line in git(out, "status", "--porcelain").splitlines() if not line.startswith("??")], [])

    def test_each_command_keeps_the_users_files(self):
        for name, (words, out, edited) in self.commands().items():
            with self.subTest(name):
                first = run(*words)
                self.assertIn(first.returncode, (0, 1), first.stderr)
                fresh = tree(out)
                put_user_files(out, edited)
                process = run(*words)
                self.assertEqual(process.returncode, first.returncode, process.stderr)
                self.require_kept(out, edited, process)
                self.assertLessEqual(sum("kept" in line for line in process.stderr.splitlines()), 2, process.stderr)
                self.assertEqual({file: digest for file, digest in tree(out).items() if file in fresh}, fresh, "and what is ours is as it was")
                again = run(*words)
                self.assertEqual(again.returncode, first.returncode, again.stderr)
                self.require_kept(out, edited, process)
                self.assertFalse((out / (edited + ".edited.2")).exists())
                if (out / "SHA256SUMS").exists():
                    self.assertNotIn("thesis.tex", (out / "SHA256SUMS").read_text())
                self.assertEqual([p.name for p in out.parent.iterdir() if ".tmp-" in p.name or ".old-" in p.name], [])

    def test_submit_keeps_and_does_not_pack(self):
        _, report, _ = quick_report(self.folder)
        out = temporary_folder(self) / "out"
        shutil.copytree(report, out)
        put_user_files(out, "")
        process = run("submit", "--out", out, "--author", "Ada", "--without-pdf")
        self.assertEqual(process.returncode, 0, process.stderr)
        shutil.copy(out / "report.md", out / "report.md.edited")   # it refuses an edited report, so it replaces nothing
        (out / "report.md.edited").write_text("edited by hand")
        process = run("submit", "--out", out, "--author", "Ada", "--without-pdf")
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertIn("not packed", process.stderr)
        process.stderr += "report.md.edited"
        self.require_kept(out, "report.md", process)
        (out / "report.md").write_text("edited by hand")
        self.assertEqual(run("submit", "--out", out, "--author", "Ada", "--without-pdf").returncode, 3)
        self.assertEqual((out / "report.md").read_text(), "edited by hand")

    def test_a_folder_without_a_marker_is_refused(self):
        marks = {".meshfolio", ".meshfolio-marks", ".meshfolio-batch"}
        spoil = {
            "a folder": lambda path: path.mkdir(),
            "an empty file": lambda path: path.write_text(""),
            "another content": lambda path: path.write_text("settings of somebody else\n"),
            "a link": lambda path: path.symlink_to(self.part / ".meshfolio"),
            "nothing": lambda path: None,
        }
        for name, (words, out, _) in self.commands().items():
            if name in ("render", "spectrum", "batch"):   # these commands add files; for batch, the replaced folder is its index
                continue
            for kind, make in spoil.items():
                with self.subTest(name, mark=kind):
                    shutil.rmtree(out, ignore_errors=True)
                    (out / "docs").mkdir(parents=True)
                    (out / "docs" / "a").write_text("mine")
                    (out / ".git").write_text("gitdir: elsewhere\n")
                    for mark in marks:
                        make(out / mark)
                    before = tree(out)
                    process = run(*words)
                    self.assertEqual(process.returncode, 4, process.stderr)
                    self.assertEqual(tree(out), before)
                    self.assertEqual([p.name for p in out.parent.iterdir() if p.name.startswith(out.name + ".")], [])

    def test_a_home_is_refused_even_with_a_mark(self):
        for name, (words, out, _) in self.commands().items():
            if name in ("render", "spectrum", "batch"):
                continue
            with self.subTest(name):
                out.mkdir()
                for mark in (".meshfolio", ".meshfolio-marks"):
                    (out / mark).write_text(MARK)
                process = run(*words, HOME=out)
                self.assertEqual(process.returncode, 4, process.stderr)
                self.assertEqual(sorted(p.name for p in out.iterdir()), [".meshfolio", ".meshfolio-marks"])

    def test_verify_does_not_replace_a_report(self):
        words, out, _ = self.commands()["report"]
        self.assertEqual(run(*words).returncode, 0)
        before = tree(out)
        process = run("verify", "--quick", "--out", out)
        self.assertEqual(process.returncode, 4, process.stderr)
        self.assertEqual(tree(out), before)

    def test_a_failed_report_keeps_the_users_files_in_its_folder(self):
        words, out, _ = self.commands()["report"]
        failed = Path(str(out) + ".failed")
        self.assertEqual(run(*words).returncode, 0)
        self.assertEqual(run(*words, MESHFOLIO_FAIL="certificates").returncode, 1)
        put_user_files(failed, "report.md")
        process = run(*words, MESHFOLIO_FAIL="certificates")
        self.assertEqual(process.returncode, 1)
        self.require_kept(failed, "report.md", process)
        process = run(*words)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual((failed / "thesis.tex").read_text(), "months of work")
        self.assertFalse((failed / "results.json").exists())
        self.assertIn("out.failed", process.stderr)

    def test_foreign_pictures_are_kept(self):
        words, out, _ = self.commands()["render"]
        self.assertEqual(run(*words).returncode, 0)
        ours = (out / "sheet.png").read_bytes()
        self.assertEqual((ours.count(b"msFO"), run(*words).stderr.count("kept")), (1, 0), "our own are replaced")
        photo = ours.replace(ours[-24:-12], b"")   # simulates a program that changed the picture
        (out / "sheet.png").write_bytes(photo)
        (out / "photo.jpg").write_text("a photo")
        (out / "+x.png").unlink()
        (out / "+x.png").symlink_to("photo.jpg")
        self.assertEqual(run(*words).returncode, 0)
        self.assertEqual((out / "sheet.png").read_bytes(), ours)
        self.assertEqual((out / "sheet.png.edited").read_bytes(), photo)
        self.assertEqual(((out / "photo.jpg").read_text(), os.readlink(out / "+x.png.edited")), ("a photo", "photo.jpg"))

    def test_batch_trusts_only_the_sums(self):
        words, out, _ = self.commands()["batch"]
        first = run(*words)
        self.assertIn("done before", run(*words).stderr)
        whole = tree(out)
        (out / "mine.txt").write_text("mine")
        self.assertIn("1 done before", run(*words).stderr, "files of the user's change nothing")
        (out / "index.html").unlink()
        (out / "tables" / "certificates_geometry.csv").write_text("overwritten") if (out / "tables" / "certificates_geometry.csv").exists() else None
        process = run(*words)
        self.assertNotIn("done before", process.stderr)
        self.assertEqual(process.returncode, first.returncode)
        self.assertEqual({file: digest for file, digest in tree(out).items() if file in whole}, whole)
        self.assertEqual((out / "mine.txt").read_text(), "mine")

    def test_batches_at_once_lose_nothing(self):
        words, out, _ = self.commands()["batch"]
        self.assertIn(run(*words).returncode, (0, 1))
        put_user_files(out, "")
        put_user_files(out.parent, "batch.csv")
        (out / "report.md").write_text("edited by hand")
        ends = []
        threads = [threading.Thread(target=lambda: ends.append(run(*words))) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue(all(end.returncode in (0, 1) or "is busy" in end.stderr for end in ends), [end.stderr for end in ends])
        ended = [end for end in ends if end.returncode in (0, 1)]
        self.assertTrue(ended)
        ended[0].stderr = "".join(end.stderr for end in ended)
        self.require_kept(out, "report.md", ended[0])
        self.require_kept(out.parent, "batch.csv", ended[0])


if __name__ == "__main__":
    unittest.main(verbosity=2)
