"""With little address space (RLIMIT_AS, from 64 MB up) a run gives a result or one line about memory; it never crashes or hangs.
A file that does not fit into memory is refused as too large, with exit code 3. Below some 120 MB the libraries cannot be loaded: the loader
prints the line and exits with code 127."""

import json
import resource
import shutil
import tempfile
import unittest

from common import WHOLE, Faults, some, tree

# Uses the disk: in /dev/shm, a report that ends by an uncaught exception may leave its unfinished folder to the next run.
tempfile.tempdir = None

MEGABYTE = 1 << 20
SIZES = [*range(64, 112, 3), *(112 + i / 4 for i in range(80)), *range(132, 260, 3), *range(260, 600, 20), 768, 1024, 2048] if WHOLE else [64, 96, 100, 104, 108, 112, *range(117, 136, 3), 143, 200]
LOADER = "error while loading shared libraries"


class Memory(Faults):
    def limited(self, megabytes, *words):
        limit = (int(megabytes * MEGABYTE),) * 2
        end = self.run_program(*words, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, limit))
        self.assertIn(end.code, (0, 1, 3, 127), f"{words[0]} with {megabytes} MB: {end.err}")
        if end.code == 127:   # the loader has two messages for this
            self.assertTrue(LOADER in end.err or end.err == "out of memory\n", end.err)
        return end

    def require_result_or_one_line(self, result, *words):
        """With enough memory the result equals that without a limit. With the warning that a factor does not fit, it agrees to a tolerance."""
        self.sweep()
        self.assertEqual(self.run_program(*words).code, 0)
        expected, ended_well, whole = tree(self.place), 0, self.place.with_name("whole.ply")
        if (self.place / "x.ply").exists():
            shutil.copy(self.place / "x.ply", whole)
        for megabytes in some(SIZES, 8):
            self.sweep()
            end = self.limited(megabytes, *words)
            ended_well += end.code == 0
            if end.code == 0 and "conjugate gradients" in end.err:
                end = self.run_program("compare", whole, self.place / "x.ply", "--json")
                self.assertLess(json.loads(end.out)["max"], 1e-9, megabytes)
            elif end.code == 0:
                self.assertEqual(tree(self.place), expected, megabytes)
            else:
                lines = [line for line in end.err.splitlines() if "warning: " not in line and "certificate: " not in line]
                self.assertEqual(len(lines), 1, f"{words[0]} with {megabytes} MB: {end.err}")
                told = any(said in lines[0] for said in ("out of memory", "GB of memory", LOADER))
                self.assertTrue(told, f"{words[0]} with {megabytes} MB: {lines[0]}")
                self.assertEqual(tree(self.place), {}, megabytes)
        self.assertGreater(ended_well, 0)

    def test_commands_on_one_mesh(self):
        mesh, place = self.mesh("torus", "--subdivide", 1), self.place
        for words in (["inspect", mesh], ["render", mesh, "--size", 256, "--out", place / "views"],
                      ["spectrum", mesh, "-k", 20, "--vectors", place / "vectors.npy"],
                      ["smooth", mesh, "--scheme", "implicit", "--lambda", "1e-3", "-o", place / "x.ply"]):
            with self.subTest(words[0]):
                self.require_result_or_one_line(place, *words)

    def test_reports(self):
        """A question without memory is shown as failed, or there is no report."""
        mesh = self.mesh("torus")
        words = ["report", "--quick", "--only", "q2,q4", "--pdf", "off", "--no-cache", "--size", 64, "--out", self.out, mesh]
        outcomes = set()
        for megabytes in some(SIZES, 10):
            self.sweep()
            end = self.limited(megabytes, *words)
            last = end.err.splitlines()[-1]
            if self.out.exists():
                questions = json.loads((self.out / "results.json").read_text())["questions"]
                failed = [q["id"] for q in questions if q["status"] == "failed"]
                self.assertEqual(end.code, 1 if failed else 0, end.err)
                self.assertTrue(not failed or "out of memory" in end.err, end.err)
            else:
                self.assertNotEqual(end.code, 0)
                self.assertTrue("out of memory" in last or LOADER in last, f"{megabytes} MB: {last}")
            outcomes.add(end.code)
            # A run without memory for handling an exception may leave only its unfinished folder to the next run.
            self.assertTrue(all(end.code != 0 and name.startswith("out.tmp-") for name in self.beside()), self.beside())
            shutil.rmtree(self.out, ignore_errors=True)
        self.assertEqual(self.run_program(*words).code, 0)
        self.assertEqual(self.beside(), [], "the next run sweeps it")
        self.assertIn(0, outcomes)
        self.assertIn(1, outcomes)


if __name__ == "__main__":
    unittest.main(verbosity=2)
