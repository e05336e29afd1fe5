"""Closed and full standard streams in all combinations: the exit code is not 0 only if output was lost, and no output file gets the number
of a stream."""

import itertools
import os
import unittest

from common import WHOLE, Faults, tree

STATES = ["open", "closed", "full"]


class Streams(Faults):
    def run_with_streams(self, states, *words):
        """Returns the exit code."""
        def prepare():
            for descriptor, state in enumerate(states):
                if state == "closed":
                    os.close(descriptor)
        full = os.open("/dev/full", os.O_RDWR)
        sink = os.open("/dev/null", os.O_RDWR)
        streams = dict(zip(("stdin", "stdout", "stderr"), (full if state == "full" else sink for state in states)))
        try:
            return self.run_program(*words, preexec_fn=prepare, **streams).code
        finally:
            os.close(full)
            os.close(sink)

    def test_a_command_that_prints(self):
        mesh = self.mesh()
        for states in itertools.product(STATES, repeat=3):
            self.assertEqual(self.run_with_streams(states, "inspect", mesh), 0 if states[1] == "open" else 4, states)

    def test_a_command_that_writes_a_file_and_warns(self):
        """Without --lambda, smooth warns; the result is the same as with open streams."""
        mesh, result = self.mesh(), self.place / "x.ply"
        words = ["smooth", mesh, "-o", result]
        self.assertEqual(self.run_program(*words).code, 0)
        expected = result.read_bytes()
        for states in itertools.product(STATES, repeat=3):
            result.unlink()
            self.assertEqual(self.run_with_streams(states, *words), 0, states)
            self.assertEqual(result.read_bytes(), expected, states)
            self.assertEqual([p.name for p in self.place.iterdir()], ["x.ply"])

    def test_a_report_is_written_although_its_path_cannot_be_printed(self):
        expected = self.report_tree(64)
        combinations = list(itertools.product(STATES, repeat=3))
        for states in combinations if WHOLE else [("closed",) * 3, ("open", "full", "closed"), ("full", "open", "full"), ("closed", "open", "closed")]:
            code = self.run_with_streams(states, *self.report_words())
            self.assertEqual(code, 0 if states[1] == "open" else 4, states)
            self.assertEqual((tree(self.out), self.beside()), (expected, []), states)

    def test_a_failure_shows_in_the_exit_code_alone(self):
        for states in itertools.product(STATES, repeat=3):
            self.assertEqual(self.run_with_streams(states, "inspect", self.folder / "missing.obj"), 3, states)


if __name__ == "__main__":
    unittest.main(verbosity=2)
