"""Tests `submit` on a quick report: the contents of the archive, its checks, and each reason to refuse a report."""

import json
import re
import shutil
import stat
import subprocess
import tempfile
import unittest
import zipfile
from hashlib import sha256
from pathlib import Path

import file_readers
from folders import tree
from program import PROGRAM, SOURCE, run, temporary_folder
from quick_report import quick_report

AUTHOR = "Ada Lovelace"
PAPERS = ("report.pdf", "appendix.pdf")


def renew_sums(out):
    """Renews SHA256SUMS after a change to the report."""
    (out / "SHA256SUMS").write_text("".join(f"{value}  {path}\n" for path, value in sorted(tree(out).items()) if path != "SHA256SUMS"))


KEPT = tempfile.TemporaryDirectory(prefix="meshfolio-test-")
REPORT = Path(KEPT.name) / "out"


def setUpModule():
    """Makes one quick report for all tests; each works on a copy."""
    global MADE
    MADE = quick_report(KEPT.name)[1]
    shutil.copytree(MADE, REPORT)
    assert run("report", "--from", REPORT / "results.json", "--out", REPORT, "--author", AUTHOR).returncode == 0


def tearDownModule():
    KEPT.cleanup()


class Reported(unittest.TestCase):
    def copy(self):
        out = temporary_folder(self) / "out"
        shutil.copytree(REPORT, out)
        return out

    def submit(self, out, *options, author=AUTHOR, **environment):
        named = ("--author", author) if author else ()
        return run("submit", "--out", out, *named, "--without-pdf", *options, **environment)


class Archive(Reported):
    @classmethod
    def setUpClass(cls):
        cls.out = Path(KEPT.name) / "submitted"
        shutil.copytree(REPORT, cls.out)
        cls.process = run("submit", "--out", cls.out, "--author", AUTHOR, "--without-pdf", "--with-images")
        assert cls.process.returncode == 0, cls.process.stderr
        cls.zip = zipfile.ZipFile(cls.out / "submission.zip")
        cls.files = {info.filename: cls.zip.read(info) for info in cls.zip.infolist()}

    def test_its_path_is_on_stdout(self):
        self.assertEqual(self.process.stdout, f"{self.out}/submission.zip\n")

    def test_the_report_is_in_it_whole_and_unchanged(self):
        for path, value in tree(REPORT).items():
            if path not in (".meshfolio", "SHA256SUMS"):
                self.assertEqual(sha256(self.files[path]).hexdigest(), value, path)
        self.assertTrue(any(re.fullmatch(r"meshes/q4_\w+_k5\.ply", name) for name in self.files))

    def test_the_manifest_names_every_other_file(self):
        lines = self.files["MANIFEST.sha256"].decode().splitlines()
        listed = {line[66:]: line[:64] for line in lines}
        self.assertEqual(len(listed), len(lines))
        self.assertEqual(listed, {name: sha256(data).hexdigest() for name, data in self.files.items() if name != "MANIFEST.sha256"})

    def test_sha256sum_and_unzip_agree(self):
        folder = temporary_folder(self)
        self.zip.extractall(folder)
        check = subprocess.run(["sha256sum", "--check", "--quiet", "--strict", "MANIFEST.sha256"], cwd=folder, capture_output=True, text=True)
        self.assertEqual((check.returncode, check.stdout), (0, ""), check.stderr)

    def test_entries_are_sorted_with_fixed_times_and_modes(self):
        names = self.zip.namelist()
        self.assertEqual(names, sorted(names, key=str.encode))
        self.assertEqual(len(names), len(set(names)))
        for info in self.zip.infolist():
            self.assertEqual(info.date_time, (1980, 1, 1, 0, 0, 0), info.filename)
            mode = info.external_attr >> 16
            script = info.filename.startswith("source/") and self.files[info.filename].startswith(b"#!")
            self.assertEqual(mode, stat.S_IFREG | (0o755 if script else 0o644), info.filename)
            self.assertNotIn("..", info.filename.split("/"))
            self.assertFalse(info.filename.startswith("/") or "\\" in info.filename)

    def test_nothing_in_it_is_a_program(self):
        for name, data in self.files.items():
            for magic in (b"\x7fELF", b"MZ", b"\xcf\xfa\xed\xfe", b"\xca\xfe\xba\xbe", b"!<arch>"):
                self.assertFalse(data.startswith(magic), name)
            self.assertFalse({"build", "CMakeFiles", "node_modules"} & set(name.split("/")[:-1]), name)

    def test_source_is_what_git_holds(self):
        git = shutil.which("git") and subprocess.run(["git", "-C", SOURCE, "ls-files", "-s"], capture_output=True, text=True)
        if not git or git.returncode != 0 or not git.stdout:
            self.skipTest("no git here")
        held = {line.split("\t")[1]: line[:6] == "100755" for line in git.stdout.splitlines()}
        packed = {i.filename[7:]: i.external_attr >> 16 & 0o111 != 0 for i in self.zip.infolist() if i.filename.startswith("source/")}
        self.assertEqual(sorted(packed.items() ^ held.items()), [])
        for path in held:
            self.assertEqual(self.files["source/" + path], (SOURCE / path).read_bytes(), path)

    def test_every_mesh_and_every_picture_opens(self):
        folder = temporary_folder(self)
        meshes = [n for n in self.files if n.endswith(".ply") and not n.startswith("source/tests/")]   # those of tests are unusual
        pictures = [n for n in self.files if n.endswith(".png") and not n.startswith("source/tests/")]
        self.assertGreaterEqual(len(meshes), 3)
        self.assertGreater(len(pictures), 50)
        for number, name in enumerate(meshes + pictures):
            path = folder / str(number)
            path.write_bytes(self.files[name])
            if name.endswith(".ply"):
                vertices, triangles = file_readers.ply(path)
                self.assertTrue(all(0 <= i < len(vertices) for t in triangles for i in t), name)
            else:
                width, height = file_readers.png_size(path)
                self.assertGreater(width * height, 0, name)

    def test_every_citation_is_the_line_of_a_definition(self):
        lines = self.files["src.txt"].decode().split("\n")
        pages = {True: self.files["index.html"].decode(), False: self.files["appendix.html"].decode()}
        results = json.loads(self.files["results.json"])
        count = 0
        for section in results["questions"] + results["supporting"]:
            for code in section["code"]:
                line = lines[code["line"] - 1]
                self.assertEqual(int(line[:6]), code["line"])
                name = re.escape(code["function"])
                self.assertRegex(line, rf"^ *\d+  ((.* |.*::)?{name}\(.*|(class|struct) {name}\b.*)$")
                self.assertFalse(line.endswith(";"), line)
                self.assertTrue(f"L{code['line']}" in pages[section in results["questions"]], code)
                self.assertIn(f"L{code['line']}", self.files["INSTRUCTIONS.md"].decode())
                count += 1
        self.assertGreater(count, 60)

    def test_every_line_of_the_source_is_numbered(self):
        lines = self.files["src.txt"].decode().split("\n")
        self.assertEqual(lines.pop(), "")
        self.assertEqual([int(line[:6]) for line in lines], list(range(1, len(lines) + 1)))

    def test_the_instructions_say_who_and_how(self):
        text = self.files["INSTRUCTIONS.md"].decode()
        self.assertIn(AUTHOR, text)
        self.assertNotIn("{{", text)
        for word in ("./build-report", "libeigen3-dev", "cmake --build", "sha256sum --check", "src.txt"):
            self.assertIn(word, text)
        self.assertNotIn("report.pdf", text)
        for path in re.findall(r"`([\w./-]+)`", text):
            if "/" in path and not path.startswith("./") and path not in ("source/out/",):
                inside = path if path.startswith(("source/", "images/", "meshes/", "tables/")) else "source/" + path
                self.assertTrue(any(n.startswith(inside) for n in self.files), path)

    def test_notices_cover_every_library_of_the_program(self):
        if not shutil.which("dpkg") or not shutil.which("ldd"):
            self.skipTest("no Debian here")
        # Packages that CMake names, and their dependencies. Dependencies of libarchive and qpdf are named as a group.
        linked = subprocess.run(["objdump", "-p", PROGRAM], capture_output=True, text=True).stdout
        needed = re.findall(r"NEEDED\s+(lib[a-z_]+)", linked)
        self.assertGreater(len(needed), 8)
        words = {"libdeflate": "libdeflate", "libnettle": "nettle", "libtinyobjloader_double": "tinyobjloader", "libtbb": "oneTBB", "libpugixml": "pugixml",
                 "libhwy": "Highway", "libarchive": "libarchive", "libqpdf": "qpdf", "libstdc": "libstdc++",
                 "libm": "GNU C library", "libgcc_s": "libgcc", "libc": "GNU C library"}
        for library in needed:
            self.assertIn(library, words, "name it in src/submission/NOTICES.md, and here")
            self.assertIn(words[library], self.files["NOTICES.md"].decode(), library)

    def test_the_folder_holds_it_with_its_sums(self):
        sums = dict(reversed(line.split("  ", 1)) for line in (self.out / "SHA256SUMS").read_text().splitlines())
        self.assertEqual(sums, {k: v for k, v in tree(self.out).items() if k != "SHA256SUMS"})
        self.assertEqual(set(tree(self.out)) - set(tree(REPORT)), {"submission.zip"})

    def test_no_path_of_this_machine_leaks(self):
        for name, data in self.files.items():
            for place in (KEPT.name, str(MADE)):
                self.assertNotIn(place.encode(), data, name)
            if not name.startswith("source/"):
                self.assertNotIn(str(SOURCE).encode(), data, name)


class Again(Reported):
    @classmethod
    def setUpClass(cls):
        cls.out = temporary_folder(cls) / "out"
        shutil.copytree(REPORT, cls.out)
        cls.process = run("submit", "--out", cls.out, "--author", AUTHOR, "--without-pdf", TZ="UTC")
        assert cls.process.returncode == 0, cls.process.stderr

    def test_the_same_bytes_wherever_and_whenever(self):
        other = self.copy()
        for zone in ("Asia/Tokyo", "UTC"):   # a submitted report can be submitted again
            self.assertEqual(self.submit(other, TZ=zone).returncode, 0)
            self.assertEqual(tree(other), tree(self.out), zone)

    def test_another_author_another_archive(self):
        other = self.copy()
        self.submit(other, author="Émilie du Châtelet")
        for out, author in ((self.out, AUTHOR), (other, "Émilie du Châtelet")):
            self.assertIn(author, zipfile.ZipFile(out / "submission.zip").read("INSTRUCTIONS.md").decode())

    def test_images_are_packed_only_with_their_option(self):
        """With the option, class Archive finds the whole report."""
        names = zipfile.ZipFile(self.out / "submission.zip").namelist()
        self.assertEqual([n for n in names if n.startswith("images/") or n in ("report.md", "appendix.md")], [])
        self.assertLessEqual({"index.html", "appendix.html"}, set(names))
        self.assertTrue((self.out / "images").is_dir(), "the report keeps them")

    def test_both_pdfs_are_taken_along(self):
        out = self.copy()
        for name in PAPERS:
            (out / name).write_bytes(b"%PDF-1.7\n%%EOF\n")
        renew_sums(out)
        process = run("submit", "--out", out, "--author", AUTHOR)
        self.assertEqual(process.returncode, 0, process.stderr)
        archive = zipfile.ZipFile(out / "submission.zip")
        for name in PAPERS:
            self.assertIn(name, archive.namelist())
            self.assertIn(f"`{name}`", archive.read("INSTRUCTIONS.md").decode())


class Refusals(Reported):
    def refuse(self, code, expected, out, *options, pdf=False, author=AUTHOR):
        """Requires this exit code, one line with `expected`, and no change on the disk."""
        before = tree(out) if out.is_dir() else None
        named = ("--author", author) if author else ()
        process = run("submit", "--out", out, *named, *(() if pdf else ("--without-pdf",)), *options)
        self.assertEqual((process.returncode, process.stdout), (code, ""), process.stderr)
        self.assertEqual(len(process.stderr.splitlines()), 1, process.stderr)
        self.assertTrue(process.stderr.startswith("meshfolio: "), process.stderr)
        self.assertIn(expected, process.stderr)
        self.assertIn("; ", process.stderr, "says what to do")
        self.assertEqual(tree(out) if out.is_dir() else None, before)
        self.assertEqual([p.name for p in out.parent.iterdir()], ["out"] if before is not None else [])

    def edit_results(self, out, change):
        results = json.loads((out / "results.json").read_text())
        change(results)
        (out / "results.json").write_text(json.dumps(results))
        renew_sums(out)

    def test_no_report(self):
        folder = temporary_folder(self)
        self.refuse(3, "is not a folder", folder / "out")
        (folder / "out").mkdir()
        (folder / "out" / "thesis.tex").write_text("precious")
        self.refuse(3, "holds no report of meshfolio", folder / "out")

    def test_a_question_that_failed_was_skipped_or_is_missing(self):
        out = self.copy()
        self.edit_results(out, lambda r: r["questions"][3].update(status="failed", failure="no spectrum"))
        self.refuse(1, "q4 failed: no spectrum", out)
        self.edit_results(out, lambda r: r["questions"][3].update(status="skipped"))
        self.refuse(1, "q4 is skipped", out)

        def remove(results):
            results["questions"].pop(3)
            used = [(mesh["file"], mesh["sha256"]) for section in results["questions"] + results["supporting"] for mesh in section["inputs"]]
            results["provenance"]["inputs"] = [mesh for mesh in results["provenance"]["inputs"] if (mesh["file"], mesh["sha256"]) in used]

        self.edit_results(out, remove)
        self.refuse(1, "q4 is missing", out)

    def test_failed_and_undecided_checks_are_counted_apart_and_do_not_prevent_a_submission(self):
        out = self.copy()

        def change(results):
            first, second, third = results["questions"][0]["checks"][:3]
            first.update(status="undecided", passed=None, note="rounding")
            second.update(status="failed", passed=False)
            third.update(status="failed", passed=False)

        self.edit_results(out, change)
        process = self.submit(out)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertIn("warning: q1: 1 check undecided, as the report says", process.stderr)
        self.assertIn("warning: q1: 2 checks failed, as the report says", process.stderr)

    def test_a_report_of_some_questions(self):
        out = temporary_folder(self) / "out"
        run("report", "--quick", "--size", 64, "--only", "q2", "--pdf", "off", "--out", out)
        self.refuse(1, "q1 is skipped", out)

    def test_a_citation_that_does_not_resolve(self):
        out = self.copy()
        self.edit_results(out, lambda r: r["questions"][0]["code"][0].update(function="nowhere"))
        self.refuse(1, "q1 cites nowhere of src/geometry/operators/uniform_laplacian.cpp, which src.txt does not define", out)

    def test_a_citation_of_another_line(self):
        out = self.copy()
        self.edit_results(out, lambda r: r["supporting"][0]["code"][0].update(line=7))
        self.refuse(1, "truth cites jet_curvature", out)

    def test_source_of_another_version(self):
        out = self.copy()
        (out / "src.txt").write_text((out / "src.txt").read_text().replace("return", "retur", 1))
        renew_sums(out)
        self.refuse(3, "the report is of another version", out)

    def test_a_missing_or_false_pdf(self):
        out = self.copy()
        self.refuse(3, "--without-pdf", out, pdf=True)
        for name, other in (PAPERS, PAPERS[::-1]):
            (out / name).write_bytes(b"%PDF-1.7\n%%EOF\n")
            renew_sums(out)
            self.refuse(3, f"{other}: is not there", out, pdf=True)
            (out / other).write_text("a PDF in name alone")
            renew_sums(out)
            self.refuse(3, f"{other}: is no PDF", out, pdf=True)
            (out / name).unlink()
            (out / other).unlink()

    def test_a_file_changed_removed_or_added(self):
        out = self.copy()
        table = next((out / "tables").iterdir())
        kept = table.read_bytes()
        table.write_bytes(kept.replace(b"1", b"2", 1))
        self.refuse(3, f"{table.name}: was changed", out)
        table.unlink()
        self.refuse(3, f"{table.name} is listed and not there", out)
        table.write_bytes(kept)
        sums = (out / "SHA256SUMS").read_text()
        (out / "SHA256SUMS").write_text("sums\n" + sums)
        self.refuse(3, "SHA256SUMS:1: is no line of sha256sum", out)
        (out / "SHA256SUMS").write_text(sums + "0" * 64 + "  ../../secret\n")
        self.refuse(3, "leads outside its folder", out)
        (out / "SHA256SUMS").unlink()
        self.refuse(3, "SHA256SUMS: is not there", out)

    def test_results_that_cannot_be_read(self):
        out = self.copy()
        (out / "results.json").write_text('{"title": 7}')
        renew_sums(out)
        self.refuse(3, "results.json:1: ", out)

    def test_executable_files_are_refused(self):
        out = self.copy()
        for name, data, expected in (
            ("tool", Path("/proc/self/exe").read_bytes()[:4096], "is an ELF program"),
            ("images/tool.png", b"MZ\x90\x00", "is a Windows program"),
            ("tables/tool.csv", b"\xcf\xfa\xed\xfe", "is a Mach-O program"),
            ("meshes/make.ply", b"#!/bin/sh\n", "is a script"),
            ("build/log.txt", b"", "lies in a build folder"),
            ("CMakeCache.txt", b"", "is what a build leaves"),
            ("main.o", b"", "is what a build leaves"),
        ):
            with self.subTest(name):
                (out / name).parent.mkdir(exist_ok=True)
                (out / name).write_bytes(data)
                renew_sums(out)
                self.refuse(3, f"{name}: {expected}", out)
                (out / name).unlink()
        (out / "report.md").chmod(0o755)
        renew_sums(out)
        self.refuse(3, "report.md: is executable", out)

    def test_links(self):
        out = self.copy()
        (out / "passwd.txt").symlink_to("/etc/passwd")
        sums = (out / "SHA256SUMS").read_text()
        (out / "SHA256SUMS").write_text(sums + "0" * 64 + "  passwd.txt\n")
        self.refuse(3, "passwd.txt: is a link", out)
        (out / "passwd.txt").unlink()
        (out / "SHA256SUMS").write_text(sums)
        shutil.move(out / "tables", out.parent / "tables")
        (out / "tables").symlink_to(out.parent / "tables")
        moved = self.submit(out)
        self.assertEqual(moved.returncode, 3)
        self.assertIn("is listed and not there", moved.stderr)

    def test_files_of_the_users_stay_and_are_not_packed(self):
        out = self.copy()
        (out / "notes.txt").write_text("mine")
        (out / "more").symlink_to("/etc")
        process = self.submit(out)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertIn("notes.txt", process.stderr)
        self.assertEqual(((out / "notes.txt").read_text(), str((out / "more").readlink())), ("mine", "/etc"))
        packed = zipfile.ZipFile(out / "submission.zip").namelist()
        self.assertEqual([name for name in packed if "notes" in name or name.startswith("more")], [])

    def test_no_author_or_another(self):
        out = self.copy()
        self.refuse(2, "--author is not at most 200 bytes on one line", out, author="Ada\nLovelace")
        self.assertEqual(self.submit(out, author=None).returncode, 0, "the report's own author is enough")
        shutil.rmtree(out)
        shutil.copytree(MADE, out)
        self.refuse(2, "give --author NAME", out, author=None)

    def test_the_author_is_put_on_the_report_in_the_same_command(self):
        out, named = self.copy(), "Alan Turing"
        shutil.rmtree(out)
        shutil.copytree(MADE, out)
        for author in (AUTHOR, named):
            self.assertEqual(self.submit(out, author=author).returncode, 0)
            self.assertIn(author, (out / "index.html").read_text())
        self.assertNotIn(AUTHOR, (out / "report.md").read_text())
        again = temporary_folder(self) / "out"
        self.assertEqual(run("report", "--from", MADE / "results.json", "--out", again, "--author", named).returncode, 0)
        (out / "submission.zip").unlink()
        (again / "SHA256SUMS").unlink(), (out / "SHA256SUMS").unlink()
        self.assertEqual(tree(out), tree(again))
        self.assertEqual(run("report", "--author", "a\nb", "--out", out).returncode, 2)

    def test_without_tests_the_source_can_be_built(self):
        out = self.copy()
        self.assertEqual(self.submit(out, "--without-tests").returncode, 0)
        with zipfile.ZipFile(out / "submission.zip") as packed:
            names = set(packed.namelist())
            sourced = re.findall(r'\$root/([\w/.-]+)', packed.read("source/build-report").decode())
        self.assertTrue({"source/" + name for name in sourced if not name.startswith(("build", "out"))} <= names, sourced)
        self.assertEqual([name for name in names if name.startswith("source/tests/") or name == "source/run-tests"], ["source/tests/setup.sh"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
