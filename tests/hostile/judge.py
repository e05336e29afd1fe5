"""Runs the built program on hostile inputs and judges the result. The environment variable MESHFOLIO gives the program's path."""

import os
import re
import resource
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "end_to_end"))
from folders import temporary_folder  # noqa: E402: lies in another folder

PROGRAM = os.path.abspath(os.environ["MESHFOLIO"])
MEGABYTES = 2000
SECONDS = 10  # processor time; other work on the machine must not count
TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
RAW = re.compile("[\0-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")  # control characters of a terminal


class Outcome:
    def __init__(self, process):
        self.code = process.returncode
        self.out = process.stdout
        self.err = process.stderr.decode("utf-8")  # strictly: messages are UTF-8 for any input
        self.lines = self.err.splitlines()
        self.errors = [line for line in self.lines if not line.startswith("meshfolio: warning: ")]


def limits(as_nobody, seconds=SECONDS):
    def apply():
        resource.setrlimit(resource.RLIMIT_AS, (MEGABYTES << 20, MEGABYTES << 20))
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if as_nobody:
            os.setgroups([])
            os.setgid(65534)
            os.setuid(65534)

    return apply


class Hostile(unittest.TestCase):
    """A test in an empty folder, in which no unexpected file may appear."""

    def setUp(self):
        self.folder = temporary_folder(self)

    def write(self, name, content=TETRAHEDRON):
        path = os.path.join(os.fsencode(self.folder), os.fsencode(name))
        with open(path, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return path

    def start(self, *words, as_nobody=False):
        variables = {"PATH": os.environ["PATH"], "MESHFOLIO_PDF": "off", "XDG_CACHE_HOME": str(self.folder / "cache")}
        program = self.copy_of_the_program() if as_nobody else PROGRAM
        command = [program, *(w if isinstance(w, (str, bytes)) else str(w) for w in words)]
        return subprocess.run(command, cwd=self.folder, env=variables, capture_output=True, stdin=subprocess.DEVNULL, timeout=120,
                              preexec_fn=limits(as_nobody))

    def copy_of_the_program(self):
        """Copies the program to a folder where every user may run it."""
        folder = temporary_folder(self)
        os.chmod(folder, 0o755)
        return shutil.copy(PROGRAM, folder)

    def judge(self, codes, *words, says=None, as_nobody=False):
        """Requires a run to end with one of the exit codes and a few harmless lines; one line if a single file is wrong."""
        codes = codes if isinstance(codes, tuple) else (codes,)
        outcome = Outcome(self.start(*words, as_nobody=as_nobody))
        told = f"{words!r:.300} ended with {outcome.code}: {outcome.err[:600]}"
        self.assertIn(outcome.code, codes, told)
        self.assertLessEqual(len(outcome.lines), 40, told)
        for line in outcome.lines:
            self.assertTrue(line.startswith("meshfolio: "), told)
            self.assertIsNone(RAW.search(line), told)
            self.assertLess(len(line), 9000, told)  # a path may have 4096 bytes, four characters each
        for words_of_internals in ("internal error", "terminate", "what():", "Sanitizer", "std::"):
            self.assertNotIn(words_of_internals, outcome.err)
        if outcome.code == 3:
            self.assertEqual(len(outcome.errors), 1, told)
        if says is not None:
            self.assertRegex(outcome.err, says, told)
        self.assertFalse([name for name in os.listdir(self.folder) if name.startswith("PWNED")], "the input was obeyed")
        return outcome
