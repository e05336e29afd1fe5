"""Documents that Pandoc makes with the filter, and what is in them."""

import json
import os
import shutil
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "end_to_end"))
from program import PROGRAM, SOURCE, temporary_folder  # noqa: E402

FILTER = SOURCE / "templates" / "pandoc" / "meshfolio.lua"
FAILED = 83   # exit code of Pandoc when a filter fails

if not shutil.which("pandoc"):
    print("skipped: pandoc is not installed")
    sys.exit(77)


class Made:
    """A run of Pandoc: exit code, messages, and the seconds it took."""

    def __init__(self, folder, document, *options, data=None, **environment):
        words = ["pandoc", f"--lua-filter={FILTER}", str(document), *map(str, options)]
        if data:
            words.append(f"--metadata=data={data}")
        began = time.monotonic()
        done = subprocess.run(words, cwd=folder, env={**os.environ, "MESHFOLIO": PROGRAM, **environment}, capture_output=True, timeout=600, stdin=subprocess.DEVNULL)
        self.seconds = time.monotonic() - began
        self.code, self.text, self.message = done.returncode, done.stdout.decode(), done.stderr.decode()


def nodes(tree, kind):
    """Returns the contents of all nodes of a kind, in the order of the document."""
    found = []
    if isinstance(tree, dict):
        if tree.get("t") == kind:
            found.append(tree.get("c"))
        tree = list(tree.values())
    if isinstance(tree, list):
        for item in tree:
            found += nodes(item, kind)
    return found


def words(tree):
    """Returns the text of a node."""
    if isinstance(tree, dict):
        if tree.get("t") in ("Str", "Code", "Math"):
            return tree["c"] if isinstance(tree["c"], str) else tree["c"][-1]
        return " " if tree.get("t") in ("Space", "SoftBreak") else words(list(tree.values()))
    return "".join(words(item) for item in tree) if isinstance(tree, list) else ""


class InDocuments(unittest.TestCase):
    """Each test writes documents into a folder of its own, beside a small mesh."""

    def setUp(self):
        self.folder = temporary_folder(self)
        shutil.copy(SOURCE / "data" / "cube8.obj", self.folder / "cube.obj")

    def write(self, text, name="a.md", meta=""):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"---\nmeshfolio: {{ size: 200 {meta} }}\n---\n{text}")
        return name

    def make(self, text, *options, meta="", **more):
        return Made(self.folder, self.write(text, meta=meta), *options, **more)

    def tree(self, text, *options, **more):
        """Returns the document as Pandoc has it after the filter."""
        made = self.make(text, "-t", "json", *options, **more)
        self.assertEqual(made.code, 0, made.message)
        return json.loads(made.text)

    def refused(self, text, line, **more):
        """Returns the message of a document that must fail at this line of its text."""
        made = self.make(text, "-t", "html", "-o", "a.html", **more)
        self.assertEqual(made.code, FAILED, made.message)
        self.assertFalse((self.folder / "a.html").exists())
        self.assertRegex(made.message.splitlines()[-1] if line else made.message, rf"^meshfolio: a\.md:{line + 3}: " if line else "^meshfolio: ")
        return made.message


def block(commands, attributes=""):
    return f"\n```{{.meshfolio {attributes}}}\n{commands}\n```\n"
