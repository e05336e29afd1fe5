"""The four earlier reports of data/documents/earlier, made by Pandoc on bundled meshes and on their own."""

import re
import resource
import shutil
import unittest

from document import SOURCE, Made, temporary_folder
from test_examples import Page

EARLIER = SOURCE / "data" / "documents" / "earlier"
FIGURES = {"s0": 15, "s1": 0, "s2": 14, "s3": 17}   # the last numbered figure of each report
ORIGINALS = SOURCE.parent / "shared" / "meshes"


def coverage(text):
    """Returns the rows of the table at the head: what the report has, ids of blocks, and the state."""
    rows = [line.strip("|").split(" | ") for line in text.splitlines() if re.match(r"\| .* \| (\[|–)", line)]
    return [(what.strip(), re.findall(r"\(#([\w-]+)\)", blocks), state.strip()) for what, blocks, state in rows]


class Earlier(unittest.TestCase):

    def make(self, **more):
        """Makes all four with small pictures and without the longest runs, in a folder that looks like data; yields name, source and page."""
        folder = temporary_folder(self) / "data"
        shutil.copytree(EARLIER, folder / "documents" / "earlier", ignore=lambda _, names: [n for n in names if not n.endswith(".md")])
        for mesh in (SOURCE / "data").glob("*.obj"):
            shutil.copy(mesh, folder)
        for name in FIGURES:
            path = folder / "documents" / "earlier" / f"{name}.md"
            text = re.sub(r"(?m)^  size: \d+$", "  size: 150", path.read_text())
            text = text.replace("30000", "3000").replace("5000", "600")   # the two longest runs of s2
            path.write_text(text)
            made = Made(path.parent, path.name, "--standalone", "-o", f"{name}.html", **more)
            self.assertEqual(made.code, 0, made.message)
            html = (path.parent / f"{name}.html").read_text()
            for file in Page(html).files:
                self.assertGreater((path.parent / file).stat().st_size, 200, file)
            yield name, text, html

    def check(self, name, text, html):
        rows, page = coverage(text), Page(html)
        self.assertNotIn("meshfolio-error", page.classes, name)
        self.assertGreater(len(rows), 13)
        for what, ids, state in rows:
            self.assertRegex(state, "^(done|partly: .|not here: .)", what)
            self.assertEqual(bool(ids), not state.startswith("not here"), what)
            self.assertLessEqual(set(ids), page.ids, f"{name}: {what}")
        listed = {int(number) for what, _, _ in rows for figures in re.findall(r"[Ff]igures? ([\d, and]+)", what)
                  for number in re.findall(r"\d+", figures)}
        self.assertLessEqual(set(range(1, FIGURES[name] + 1)), listed, name)

    def test_on_bundled_meshes(self):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        for made in self.make():
            self.check(*made)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        print(f"the four earlier reports: {seconds:.0f} s of processors")

    def test_on_their_own_meshes(self):
        if not ORIGINALS.is_dir():
            self.skipTest("the meshes of the reports are not beside the project")
        sizes = {"s0": "3485", "s1": "3485", "s2": "19970", "s3": "7229"}   # vertices of a mesh of each
        for name, text, html in self.make(data=ORIGINALS):
            self.check(name, text, html)
            self.assertIn(sizes[name], html, name)


if __name__ == "__main__":
    unittest.main()
