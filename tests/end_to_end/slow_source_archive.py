"""Builds the source of a submission from scratch in another folder, as its INSTRUCTIONS.md says, and compares src.txt and the tables.

A compiler cache in CMAKE_CXX_COMPILER_LAUNCHER shortens the test from several minutes to one. The build still finds and
reads every file; it only skips compiling sources that were compiled before."""

import json
import os
import subprocess
import time
import unittest
import zipfile

from program import run, temporary_folder

QUICK = ("report", "--quick", "--size", 64, "--pdf", "off", "--no-timings")


class SourceArchive(unittest.TestCase):
    def test_it_builds_and_gives_the_same_tables(self):
        folder = temporary_folder(self)
        out, unpacked = folder / "out", folder / "elsewhere"
        self.assertEqual(run(*QUICK, "--out", out).returncode, 0)
        process = run("submit", "--out", out, "--author", "Ada Lovelace", "--without-pdf")
        self.assertEqual(process.returncode, 0, process.stderr)
        with zipfile.ZipFile(out / "submission.zip") as archive:
            archive.extractall(unpacked)
        source, build = unpacked / "source", unpacked / "source" / "build" / "release"
        kind = json.loads((out / "results.json").read_text())["provenance"]["build_type"]
        began = time.monotonic()
        self.command(source, "cmake", "-S", ".", "-B", build, "-G", "Ninja", f"-DCMAKE_BUILD_TYPE={kind}", "-DMESHFOLIO_TESTS=OFF")
        self.command(source, "cmake", "--build", build, "--parallel", 2)
        print(f"built from scratch in {time.monotonic() - began:.0f} s")

        again = folder / "again"
        words = [str(build / "meshfolio"), *map(str, QUICK), "--out", str(again)]
        process = subprocess.run(words, capture_output=True, text=True)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual((again / "src.txt").read_bytes(), (unpacked / "src.txt").read_bytes())
        tables = sorted(path.name for path in (out / "tables").iterdir())
        self.assertEqual(sorted(path.name for path in (again / "tables").iterdir()), tables)
        self.assertGreater(len(tables), 50)
        for name in tables:
            self.assertEqual((again / "tables" / name).read_bytes(), (unpacked / "tables" / name).read_bytes(), name)

    def command(self, folder, *words):
        environment = {**os.environ, "CCACHE_BASEDIR": str(folder)}
        process = subprocess.run(list(map(str, words)), cwd=folder, capture_output=True, text=True, env=environment)
        self.assertEqual(process.returncode, 0, process.stdout[-2000:] + process.stderr[-2000:])


if __name__ == "__main__":
    unittest.main(verbosity=2)
