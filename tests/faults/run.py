#!/usr/bin/env python3
"""Tests faults and determinism of the built program: kill, space, signals, parallel, streams, memory, determinism, files_touched.

  MESHFOLIO=build/release/meshfolio tests/faults/run.py [--whole] [PART …]

By default it tries a sample of the moments, in seconds; --whole tries all of them, in half an hour. `--whole determinism` also builds the
program in differently named folders, with -O2 and with -O3. Tests that the machine does not permit are reported as skipped."""

import os
import sys
import unittest

PARTS = ["kill", "space", "signals", "parallel", "streams", "memory", "determinism", "files_touched"]


def main(words):
    if "--whole" in words:
        os.environ["FAULTS_WHOLE"] = "yes"
    parts = [word for word in words if word != "--whole"] or PARTS
    unknown = [part for part in parts if part not in PARTS]
    if unknown:
        sys.exit(f"{__doc__}\nno such part: {', '.join(unknown)}")
    result = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.loadTestsFromNames(parts))
    if result.testsRun == len(result.skipped):
        return 77   # CTest shows this code as skipped
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
