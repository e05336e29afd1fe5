"""Tools of all fault tests: runs of the program, folders, old and new reports, tracing and injecting system calls.
The environment variable MESHFOLIO gives the program's path; FAULTS_WHOLE tries every moment instead of a selection."""

import collections
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "end_to_end"))
from folders import temporary_folder, tree  # noqa: E402: lies in another folder

SOURCE = Path(__file__).resolve().parents[2]
PROGRAM = os.path.abspath(os.environ.get("MESHFOLIO", SOURCE / "build" / "release" / "meshfolio"))
WHOLE = bool(os.environ.get("FAULTS_WHOLE"))
STRACE = shutil.which("strace")
ONE_CPU = ["taskset", "-c", str(min(os.sched_getaffinity(0)))]   # one thread, so that calls have the same order in every run


def can_trace():
    return bool(STRACE) and subprocess.run([STRACE, "-qq", "-o", "/dev/null", "true"], capture_output=True).returncode == 0


def can_mount():
    return subprocess.run(["unshare", "-m", "true"], capture_output=True).returncode == 0 if shutil.which("unshare") else False


needs_strace = unittest.skipUnless(can_trace(), "strace is not installed, or may not trace here")
needs_mount = unittest.skipUnless(can_mount(), "no private mount namespace may be made here")

signal.signal(signal.SIGHUP, lambda *_: None)   # under nohup, started programs would ignore it, too

Call = collections.namedtuple("Call", "name number paths line")   # the thread's call number `number` with this name
End = collections.namedtuple("End", "code out err seconds")


def some(items, number):
    """Returns all with FAULTS_WHOLE, else `number` evenly spread ones, with the first and the last."""
    if WHOLE or len(items) <= number:
        return list(items)
    return [items[round(i * (len(items) - 1) / (number - 1))] for i in range(number)]


def of_each_kind(calls):
    """Returns all with FAULTS_WHOLE, else the middle call of each name, two renames and the last call."""
    if WHOLE:
        return list(calls)
    kinds = {}
    for call in calls:
        kinds.setdefault(call.name, []).append(call)
    chosen = [call for name, same in kinds.items() for call in (some(same, 2) if name.startswith("rename") else [same[len(same) // 2]])]
    return sorted({*chosen, calls[-1]}, key=calls.index)


def below(files, folder):
    """Returns the part of a tree below a folder."""
    return {name.removeprefix(folder + "/"): value for name, value in files.items() if name.startswith(folder + "/")}


EDITED = {".meshfolio": "report.md", ".meshfolio-marks": "class.csv"}   # by the mark of the folder


def add_user_files(folder):
    """Adds a file, a folder with an empty folder, and a link, and edits one of our files. A command that replaces the folder must keep all."""
    (folder / "thesis.tex").write_text("months of work")
    (folder / "thesis.tex").chmod(0o640)
    (folder / "docs" / "empty").mkdir(parents=True)
    (folder / "docs" / "a").write_text("a")
    (folder / "link").symlink_to("/nowhere/at/all")
    for mark, edited in EDITED.items():
        if (folder / mark).exists():
            (folder / edited).write_text("edited by hand")


def user_files_are_kept(folder):
    """Returns the files of add_user_files(); an edited file may be named NAME.edited."""
    edited = next(name for mark, name in EDITED.items() if (folder / mark).exists())
    return ((folder / "thesis.tex").read_text() == "months of work" and (folder / "thesis.tex").stat().st_mode & 0o777 == 0o640 and
            (folder / "docs" / "empty").is_dir() and (folder / "docs" / "a").read_text() == "a" and os.readlink(folder / "link") == "/nowhere/at/all" and
            "edited by hand" in [(folder / name).read_text() for name in (edited, edited + ".edited") if (folder / name).exists()])


def is_user_file(name):
    return name in ("thesis.tex", "docs/a") or name.endswith(".edited")


def ours(files):
    """Returns the files of a tree without those of the user."""
    return None if files is None else {name: value for name, value in files.items() if not is_user_file(name)}


def sums_hold(folder):
    """True if SHA256SUMS lists all our files with their digests; files that the user edited do not count."""
    listed = dict(reversed(line.split("  ", 1)) for line in (folder / "SHA256SUMS").read_text().splitlines())
    found = {name: value for name, value in tree(folder).items() if name not in ("SHA256SUMS", ".gitignore") and not is_user_file(name)}
    listed.pop(".gitignore", None)
    for name in EDITED.values():
        if name in found and (folder / name).read_bytes() == b"edited by hand":
            found[name] = listed.get(name)
    return listed == found


MADE = tempfile.TemporaryDirectory(prefix="meshfolio-faults-")   # old and new reports that many tests share


class Faults(unittest.TestCase):
    """A test in an empty folder, with its own cache and folder for temporary files."""

    def setUp(self):
        self.folder = temporary_folder(self).resolve()
        self.random = random.Random(self.id())   # the same moments in every run, as far as clocks permit
        for name in ("place", "tmp", "cache"):
            (self.folder / name).mkdir()
        self.place = self.folder / "place"   # contains only outputs
        self.out = self.place / "out"
        self.environment = {**os.environ, "MESHFOLIO_PDF": "off", "TMPDIR": str(self.folder / "tmp"),
                            "XDG_CACHE_HOME": str(self.folder / "cache"), "LC_ALL": "C"}

    def start(self, *arguments, wrap=(), program=PROGRAM, **options):
        options = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "cwd": self.folder,
                   "env": self.environment, "start_new_session": True, **options}
        process = subprocess.Popen([*map(str, [*wrap, program, *arguments])], **options)
        self.addCleanup(lambda: (process.poll() is None and process.kill(), process.communicate()))
        return process

    def end(self, process, limit=120):
        began = time.monotonic()
        out, err = process.communicate(timeout=limit)
        words = [(b or b"").decode(errors="replace") for b in (out, err)]
        return End(process.returncode, *words, time.monotonic() - began)

    def run_program(self, *arguments, **options):
        return self.end(self.start(*arguments, **options))

    def mesh(self, name="torus", *options):
        path = self.folder / f"{name}.ply"
        self.assertEqual(self.run_program("sample", name, "-o", path, *options).code, 0)
        return path

    # ---- reports: old and new differ in the size of their pictures

    def report_words(self, out=None, size=64, threads=1, cached=False):
        words = ["report", "--quick", "--only", "q2", "--pdf", "off", "--no-timings", "--size", size, "--threads", threads]
        return [*words, *([] if cached else ["--no-cache"]), "--out", out or self.out]

    def report_of(self, size):
        return Path(MADE.name) / f"made-{size}" / "out"

    def report_tree(self, size):
        """Makes such a report and returns its tree."""
        out = self.report_of(size)
        if not out.exists():
            end = self.run_program(*self.report_words(out, size))
            self.assertEqual(end.code, 0, end.err)
            self.assertTrue(sums_hold(out))
        return tree(out)

    def with_old_and_new(self):
        """Puts an old report in place. Returns its tree and the tree of the new report that report_words() makes."""
        old, new = self.report_tree(72), self.report_tree(64)
        self.assertNotEqual(old, new)
        self.restore_old()
        return old, new

    def with_renewal(self):
        """Puts a report of question 2 in place. Returns its tree, the tree with one more section, and the words that add it."""
        self.old_folder = self.report_of(64)
        old = self.report_tree(64)
        self.restore_old()
        words = ["certificates" if word == "q2" else word for word in self.report_words()]
        self.assertEqual(self.run_program(*words).code, 0)
        new = tree(self.out)
        self.restore_old()
        return old, new, words

    def with_parts(self):
        """Puts an old report in place. Returns its tree, the tree of two merged parts, and the words that merge them."""
        self.old_folder = self.report_of(72)
        old, parts = self.report_tree(72), [self.folder / "certificates", self.folder / "q2"]
        for part in parts:
            self.assertEqual(self.run_program("report", "--quick", "--size", 64, "--part", part, "--only", part.name).code, 0)
        words = ["merge", *parts, "--pdf", "off", "--out", self.out]
        self.sweep()
        shutil.rmtree(self.out, ignore_errors=True)
        self.assertEqual(self.run_program(*words).code, 0)
        new = tree(self.out)
        self.restore_old()
        return old, new, words

    def with_marks(self):
        """Puts old marks in place. Returns their tree, the tree of the marks of a better answer, and the words that mark it."""
        self.old_folder = self.folder / "made-marks" / "out"
        rubric, student = self.folder / "rubric.toml", self.folder / "ada"
        rubric.write_text('[[item]]\nid = "kappa"\nwhat = "number"\nvalue = 2.0\npoints = 3\n')
        student.mkdir(exist_ok=True)
        trees = []
        for answer, out in (("1.0", self.old_folder), ("2.0", self.out)):
            (student / "answers.toml").write_text(f"kappa = {answer}\n")
            out.parent.mkdir(parents=True, exist_ok=True)
            shutil.rmtree(out, ignore_errors=True)
            words = ["mark", student, "--rubric", rubric, "--out", out]
            self.assertEqual(self.run_program(*words).code, 0)
            trees.append(tree(out))
        self.restore_old()
        return *trees, words

    def with_batch(self):
        """Puts an old batch in place. Returns its tree, the tree with pictures of another size, the words that make it, and their exit code."""
        self.old_folder = self.folder / "made-batch" / "out"
        words = ["batch", self.mesh(), self.mesh("cube8"), "--only", "certificates", "--pdf", "off", "--no-timings", "--no-cache", "--jobs", 1, "--size"]
        trees = []
        for size, out in ((72, self.old_folder), (64, self.out)):
            end = self.run_program(*words, size, "--out", out)
            self.assertIn(end.code, (0, 1), end.err)
            trees.append(tree(out))
        self.restore_old()
        return *trees, [*words, 64, "--out", self.out], end.code

    def require_batch_of(self, old, new, when):
        """Requires each report and each index file to be the complete old or new one, or a leftover that the next run removes."""
        now = tree(self.out)
        index = {name: value for name, value in now.items() if "/" not in name and not name.startswith(".")}
        for name, value in index.items():
            self.assertTrue(".part-" in name or name in old, f"{when}: {name}")
        rows = json.loads((self.out / "batch.json").read_text())["meshes"]
        self.assertEqual([row["name"] for row in rows], ["torus", "cube8"], when)
        for name in ("torus", "cube8"):
            report = below(now, name)
            self.assertIn(report, (below(old, name), below(new, name)), f"{when}: neither the old {name} nor the new one")
            self.assertTrue(sums_hold(self.out / name), when)
        return [name for name in ("torus", "cube8") if below(now, name) == below(new, name)]

    old_folder = None
    user_files = False   # the old folder has it, too

    def restore_old(self):
        self.sweep()
        shutil.rmtree(self.out, ignore_errors=True)
        shutil.copytree(self.old_folder or self.report_of(72), self.out)
        if self.user_files:
            add_user_files(self.out)

    def beside(self):
        """Returns the names beside the output, in the folder for temporary files and in the root of the cache."""
        cache = self.folder / "cache" / "meshfolio"
        return ([p.name for p in self.place.iterdir() if p != self.out] + [p.name for p in (self.folder / "tmp").iterdir()] +
                [p.name for p in (cache.iterdir() if cache.is_dir() else []) if p.name not in ("entries", "objects")])

    def sweep(self):
        for name in [p for p in self.place.iterdir() if p != self.out] + list((self.folder / "tmp").iterdir()):
            shutil.rmtree(name) if name.is_dir() and not name.is_symlink() else name.unlink()

    # ---- system calls

    def calls(self, names, *arguments, within=None, code=0, **options):
        """Returns the calls of these names that touch the folder `within` (default: that of outputs), in a run that must end with `code`."""
        log = self.folder / "trace"
        wrap = [*ONE_CPU, STRACE, "-f", "-y", "-qq", "-e", "signal=none", "-o", log, "-e", "trace=" + ",".join(names)]
        end = self.run_program(*arguments, wrap=wrap, **options)
        self.assertEqual(end.code, code, end.err)
        found = [call for call in parsed_calls(log.read_text(errors="replace"))
                 if any(path.startswith(str(within or self.place)) for path in call.paths)]
        self.assertTrue(found, "no call was seen")
        return found

    def run_with(self, call, what, *arguments, limit=120):
        """Runs the program and tampers with one call ("error=ENOSPC", "signal=KILL"). Returns its end, and whether the call was made."""
        log = self.folder / "trace"
        wrap = [*ONE_CPU, STRACE, "-f", "-qq", "-e", "signal=none", "-o", log, "-e", f"trace={call.name}", "-e", f"inject={call.name}:{what}:when={call.number}"]
        end = self.end(self.start(*arguments, wrap=wrap), limit)
        return end, "(INJECTED)" in log.read_text(errors="replace")


def parsed_calls(log):
    """Returns each number once: calls of different threads with the same number are tampered with together."""
    counts, seen, calls = collections.Counter(), set(), []
    for line in log.splitlines():
        match = re.match(r"(\d+) +([a-z0-9_]+)\((.*)", line)
        if not match:
            continue
        thread, name, words = match.groups()
        counts[thread, name] += 1
        number = counts[thread, name]
        described = re.match(r"\d+<(/[^>]*)>", words)
        paths = [described[1]] if described else []
        if name not in ("write", "pwrite64", "writev", "read"):
            paths += re.findall(r'"((?:[^"\\]|\\.)*)"', words)
        if paths and (name, number, paths[0]) not in seen:
            seen.add((name, number, paths[0]))
            calls.append(Call(name, number, tuple(paths), line))
    return calls
