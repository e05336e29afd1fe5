"""Several runs into one folder leave the complete output of one run."""

import shutil
import unittest

from common import WHOLE, Faults, add_user_files, ours, sums_hold, tree, user_files_are_kept

SIZES = [56, 64, 72, 80]


class Parallel(Faults):
    def test_reports_into_one_folder(self):
        expected = [self.report_tree(size) for size in SIZES]
        for number in range(50 if WHOLE else 5):
            if number % 2 == 0:   # the first run replaces nothing
                shutil.rmtree(self.out, ignore_errors=True)
            else:
                add_user_files(self.out)
            sizes = SIZES[: 2 + number % 3]
            processes = [self.start(*self.report_words(size=size)) for size in sizes]
            for end in map(self.end, processes):
                self.assertTrue(end.code == 0 or (end.code == 4 and "busy" in end.err), end.err)
            self.assertIn(ours(tree(self.out)), expected[: len(sizes)])
            self.assertTrue(sums_hold(self.out))
            self.assertTrue(number % 2 == 0 or user_files_are_kept(self.out))
            self.assertEqual(self.beside(), [])

    def test_reports_that_share_a_cache(self):
        new = self.report_tree(64)
        for _ in range(12 if WHOLE else 2):
            processes = [self.start(*self.report_words(self.place / str(i) / "out", cached=True)) for i in range(4)]
            for i, end in enumerate(map(self.end, processes)):
                self.assertEqual(end.code, 0, end.err)
                self.assertNotIn("warning", end.err)
                self.assertEqual(tree(self.place / str(i) / "out"), new)

    def test_single_files(self):
        mesh, result = self.mesh(), self.place / "x.ply"
        expected = set()
        for step in ("1e-4", "2e-4", "3e-4"):
            self.assertEqual(self.run_program("smooth", mesh, "-o", result, "--lambda", step).code, 0)
            expected.add(result.read_bytes())
        self.assertEqual(len(expected), 3)
        for _ in range(30 if WHOLE else 4):
            processes = [self.start("smooth", mesh, "-o", result, "--lambda", step) for step in ("1e-4", "2e-4", "3e-4")]
            for end in map(self.end, processes):
                self.assertEqual(end.code, 0, end.err)
            self.assertIn(result.read_bytes(), expected)
            self.assertEqual([p.name for p in self.place.iterdir()], ["x.ply"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
