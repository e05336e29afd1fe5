"""Temporary folders of tests, and their contents."""

import hashlib
import os
import tempfile
from pathlib import Path


def folder_in_memory():
    """Returns /dev/shm if it has room and may run programs, else None. meshfolio waits for the disk after each file that it writes,
    so a test that makes reports takes twice the time on a disk. `tests/faults/run.py --whole` writes to the disk."""
    place = "/dev/shm"
    try:
        system = os.statvfs(place)
    except OSError:
        return None
    may_run = not system.f_flag & getattr(os, "ST_NOEXEC", 0)
    has_room = system.f_bavail * system.f_frsize >= 4 << 30
    return place if may_run and has_room and os.access(place, os.W_OK | os.X_OK) else None


if not {"TMPDIR", "FAULTS_WHOLE"} & set(os.environ):
    tempfile.tempdir = folder_in_memory()


def temporary_folder(test):
    """Makes a folder that is removed after the test case, or, if `test` is a class, after all its cases."""
    folder = tempfile.TemporaryDirectory(prefix="meshfolio-test-")
    (test.addClassCleanup if isinstance(test, type) else test.addCleanup)(folder.cleanup)
    return Path(folder.name)


def digest(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def tree(folder):
    """Returns relative path → SHA-256 of all files in the folder and below; None if there is no folder."""
    folder = Path(folder)
    return {str(path.relative_to(folder)): digest(path) for path in sorted(folder.rglob("*")) if path.is_file()} if folder.is_dir() else None
