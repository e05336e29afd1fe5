"""meshfolio as a library: builds tests/library_example with an installed prefix and beside the source."""

import json
import re
import subprocess
import unittest
from pathlib import Path

from program import PROGRAM, SOURCE, run, sample, temporary_folder

BUILD = Path(PROGRAM).parent
CACHE = dict(re.findall(r"^(\w+):\w+=(.*)$", (BUILD / "CMakeCache.txt").read_text(), re.MULTILINE))
AS_BUILT = [f"-D{name}={CACHE[name]}" for name in ("CMAKE_CXX_COMPILER", "CMAKE_CXX_FLAGS", "CMAKE_BUILD_TYPE")]


class Library(unittest.TestCase):
    def cmake(self, *words):
        process = subprocess.run(["cmake", *map(str, words)], capture_output=True, text=True, timeout=600)
        self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
        return process.stdout

    def test_thirty_lines_draw_six_views_and_print_the_largest_step_from_an_installed_prefix(self):
        folder = temporary_folder(self)
        self.cmake("--install", BUILD, "--component", "development", "--prefix", folder / "here")
        moved = folder / "there"
        (folder / "here").rename(moved)
        build = folder / "build"
        self.cmake("-S", SOURCE / "tests/library_example", "-B", build, f"-DCMAKE_PREFIX_PATH={moved}", *AS_BUILT)
        self.cmake("--build", build)
        mesh = sample(folder, "creature")
        drawn = subprocess.run([build / "six_views", mesh], cwd=folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        limit = json.loads(run("inspect", mesh, "--json").stdout)["lambda_crit"]
        self.assertAlmostEqual(float(drawn.stdout.removeprefix("lambda_crit ")) / limit, 1, delta=1e-8)
        for view in ("+x", "-x", "+y", "-y", "+z", "-z"):
            png = (folder / f"{view}.png").read_bytes()
            self.assertEqual(png[:8] + png[16:24], b"\x89PNG\r\n\x1a\n" + b"\x00\x00\x01\x90" * 2, view)
        refused = subprocess.run([build / "six_views", "no.obj"], cwd=folder, capture_output=True, text=True, timeout=120)
        self.assertEqual((refused.returncode, refused.stdout), (3, ""))

    def test_beside_the_source_only_the_library_is_added_and_its_flags_stay_with_it(self):
        build = temporary_folder(self) / "build"
        words = ("-S", SOURCE / "tests/library_example", "-B", build, "-G", "Ninja", f"-DMESHFOLIO_SOURCE={SOURCE}")
        self.cmake(*words, "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", *AS_BUILT)
        compiled = json.loads((build / "compile_commands.json").read_text())
        ours = {re.search(r"-o \S*CMakeFiles/(\w+)\.dir", entry["command"])[1] for entry in compiled}
        library = {f"meshfolio_{name}" for name in ("base", "mesh", "geometry", "render")}
        self.assertLessEqual(library, ours)
        self.assertLessEqual(ours, library | {"six_views", "meshfolio_fast_headers"}, "neither program nor tests")
        command = next(entry["command"] for entry in compiled if entry["file"].endswith("six_views.cpp"))
        theirs = command.replace(CACHE["CMAKE_CXX_FLAGS"] or " ", " ")
        for leaked in (" -W", "-ffp-contract", "-mssse3", "cmake_pch", " -O2 "):
            self.assertNotIn(leaked, theirs)


if __name__ == "__main__":
    unittest.main(verbosity=2)
