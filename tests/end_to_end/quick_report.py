"""Makes one quick report of the bundled meshes for all tests that read it: CTest's fixture `quick_report` (`quick_report.py FOLDER`). A test
that runs alone makes its own."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from program import run

WORDS = ["report", "--quick", "--size", 64, "--no-timings"]


def quick_report(folder):
    """Returns the finished process, the report, which tests must not change, and its cache. Makes them in `folder` if CTest has not."""
    made = os.environ.get("QUICK_REPORT")
    if not made:
        return make(Path(folder) / "made")
    out, words = Path(made) / "out", [(Path(made) / name).read_text() for name in ("stdout", "stderr")]
    return subprocess.CompletedProcess(WORDS, 0, *words), out, Path(made) / "cache"


def make(folder):
    shutil.rmtree(folder, ignore_errors=True)   # removes the cache, too: a report of another program is of no use
    folder.mkdir(parents=True)
    out, cache = folder / "out", folder / "cache"
    process = run(*WORDS, "--threads", 2, "--out", out, XDG_CACHE_HOME=cache)
    assert process.returncode == 0, process.stderr
    for name, words in (("stdout", process.stdout), ("stderr", process.stderr)):
        (folder / name).write_text(words)
    return process, out, cache


if __name__ == "__main__":
    make(Path(sys.argv[1]))
