"""Runs the built program. Its path comes from the environment variable MESHFOLIO."""

import os
import subprocess
import tempfile
from pathlib import Path

from folders import temporary_folder  # noqa: F401: most tests import both from here

PROGRAM = os.path.abspath(os.environ["MESHFOLIO"])
SOURCE = Path(__file__).resolve().parents[2]


def run(*arguments, cwd=None, **environment):
    """Runs the program; keyword arguments are environment variables. Reports have no PDF unless requested. Returns the finished process with
    text streams. The cache is empty unless XDG_CACHE_HOME is given, so a second run computes everything again."""
    words = [PROGRAM, *map(str, arguments)]
    with tempfile.TemporaryDirectory(prefix="meshfolio-cache-") as cache:
        variables = {**os.environ, "MESHFOLIO_PDF": "off", "XDG_CACHE_HOME": cache, **{name: str(value) for name, value in environment.items()}}
        return subprocess.run(
            words, cwd=cwd, env=variables, capture_output=True, text=True, timeout=280, stdin=subprocess.DEVNULL
        )


def sample(folder, name, ending="obj", subdivide=0):
    """Writes a bundled mesh into the folder."""
    path = folder / f"{name}.{ending}"
    process = run("sample", name, "-o", path, "--subdivide", subdivide)
    assert process.returncode == 0, process.stderr
    return path
