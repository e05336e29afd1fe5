#!/usr/bin/env python3
"""Do the tests notice a wrong formula? Plants faults in the numerical kernels, one at a time, and runs the tests on each:

    tests/mutation/mutate.py [--mutants 60] [--seed 1] [--list] [FILE …]

A mutant is one sign, factor, comparison or index of one line of src/geometry or render/ (or of the FILEs), drawn at random, as many from
each file as it has lines. The tree is copied to build/mutation and built there; a mutant is killed when a test fails, crashes or takes
ten times as long. The tests of the same module run first, then all of the layer, then those of the layer above. What cannot change any
result (equivalent.tsv: file, line, mutated line, why) is told apart. Exit code 1 if fewer than 95 % are killed."""
import argparse
import os
import random
import re
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TREE = ROOT / "build" / "mutation" / "tree"
BUILD = ROOT / "build" / "mutation" / "build"
LAYERS = {"src/geometry": ("geometry_tests", "questions_tests"), "render": ("render_tests", "output_tests")}
ENOUGH = 0.95

# The code is formatted: a binary operator stands between spaces, < and > of templates do not.
SWAPS = [(r" \+ ", " - "), (r" - ", " + "), (r" \* ", " / "), (r" / ", " * "), (r" \+= ", " -= "), (r" -= ", " += "),
         (r" < ", " <= "), (r" <= ", " < "), (r" > ", " >= "), (r" >= ", " > "), (r" == ", " != "), (r" != ", " == "),
         (r" && ", " || "), (r" \|\| ", " && "), (r"std::max\(", "std::min("), (r"std::min\(", "std::max("),
         (r"std::sin\(", "std::cos("), (r"std::cos\(", "std::sin("), (r"\.x\b", ".y"), (r"\.y\b", ".z"), (r"\.z\b", ".x"),
         (r"\[0\]", "[1]"), (r"\[1\]", "[0]"), (r"\b0\.5 \*", "0.25 *"), (r"\b2 \*", "3 *"), (r"\b4 \*", "2 *"), (r"/ 2\b", "/ 4"),
         (r"/ 3\b", "/ 4"), (r"return -", "return "), (r"\(-", "("), (r"% 3\b", "% 2"), (r"\+ 1\b", "+ 2")]
# Not code that computes: directives, messages, declarations of types, what only guards against a caller's mistake.
NO_CODE = re.compile(r"^\s*(#|//|template|using|namespace|static_assert|throw|enum|struct|class)|throw |std::string|operator")


@dataclass(frozen=True)
class Mutant:
    file: str
    line: int   # counted from 1
    before: str
    after: str

    def name(self):
        return f"{self.file}:{self.line}: {self.after.strip()}"


def mutants_of(file):
    """Every mutant of a file; comments and texts are not code."""
    found = []
    for number, line in enumerate((ROOT / file).read_text().splitlines(), 1):
        code = re.sub(r'"(\\.|[^"\\])*"', lambda text: "\0" * len(text[0]), line.split("//")[0])
        if NO_CODE.search(code):
            continue
        for pattern, replacement in SWAPS:
            for place in re.finditer(pattern, code):
                found.append(Mutant(file, number, line, line[:place.start()] + replacement + line[place.end():]))
    return found


def draw(files, count, seed):
    """The same for the same seed; every file in turn, so that none of the small ones is left out by chance."""
    chance = random.Random(seed)
    left = {file: mutants_of(file) for file in files}
    left = {file: mutants for file, mutants in left.items() if mutants}
    for mutants in left.values():
        chance.shuffle(mutants)
    order = sorted(left)
    chance.shuffle(order)
    drawn = []
    while left and len(drawn) < count:
        for file in order:
            if left.get(file) and len(drawn) < count:
                drawn.append(left[file].pop())
            elif not left.get(file):
                left.pop(file, None)
    return drawn


def copy_tree():
    """What git knows of the folder as it stands, so that nothing stale is compiled; only what changed is written: a second run builds little."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True, capture_output=True)
    names = {name for name in os.fsdecode(listed.stdout).split("\0") if name and (ROOT / name).exists()}
    for file in TREE.rglob("*"):
        if file.is_file() and str(file.relative_to(TREE)) not in names:
            file.unlink()
    for name in sorted(names):
        copy = TREE / name
        if not copy.exists() or copy.read_bytes() != (ROOT / name).read_bytes():
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, copy)


def build(target):
    cache = {"CCACHE_BASEDIR": str(TREE), "CCACHE_NOHASHDIR": "1"}   # what was compiled anywhere else need not be again
    return subprocess.run(["cmake", "--build", str(BUILD), "--target", target], env={**os.environ, **cache}, capture_output=True, text=True)


def suites_beside(file, program):
    """The test suites of tests/<layer>/<module>_test.cpp, as a filter of Google Test."""
    test = TREE / "tests" / program.removesuffix("_tests") / (Path(file).stem + "_test.cpp")
    suites = set(re.findall(r"^(?:TEST|TEST_F|TEST_P)\((\w+)", test.read_text(), re.M)) if test.exists() else set()
    return ":".join(f"*{suite}.*" for suite in sorted(suites))


def run_tests(program, filter_="*", limit=3600.0):
    """The first failing test, "crash" or "hangs"; nothing when all pass."""
    command = [str(BUILD / "tests" / program), "--gtest_brief=1", "--gtest_fail_fast", f"--gtest_filter={filter_}"]
    try:
        done = subprocess.run(command, cwd=BUILD / "tests", capture_output=True, text=True, errors="replace", timeout=limit)
    except subprocess.TimeoutExpired:
        return "hangs"
    if done.returncode == 0:
        return ""
    failed = re.search(r"\[  FAILED  \] (\S+)", done.stdout)
    return failed[1].rstrip(",") if failed else f"crash ({done.returncode})"


class Programs:
    """Test programs, each built when it is first needed, with the time that it may take."""

    def __init__(self):
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        subprocess.run(["cmake", "-S", str(TREE), "-B", str(BUILD), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DMESHFOLIO_TESTS=ON",
                        "-DCMAKE_CXX_FLAGS=-D_GLIBCXX_ASSERTIONS", *launcher],   # a wrong index is a crash at once
                       check=True, stdout=subprocess.DEVNULL)
        self.limits = {}

    def limit(self, program):
        """Of the tree as it is: only call it without a mutant."""
        if program not in self.limits:
            if (done := build(program)).returncode != 0:
                sys.exit(done.stdout[-3000:])
            began = time.monotonic()
            if failed := run_tests(program):
                sys.exit(f"{program} fails without any mutant: {failed}")
            self.limits[program] = 10 * (time.monotonic() - began) + 10
        return self.limits[program]


class planted:
    """The tree with a mutant in it."""

    def __init__(self, mutant):
        self.file, self.mutant = TREE / mutant.file, mutant

    def __enter__(self):
        self.text = self.file.read_text()
        lines = self.text.split("\n")
        lines[self.mutant.line - 1] = self.mutant.after
        self.file.write_text("\n".join(lines))

    def __exit__(self, *_):
        self.file.write_text(self.text)


def verdict(mutant, programs):
    """How the mutant dies; "" if it lives, nothing if it is no program."""
    layer = next(layer for layer in LAYERS if mutant.file.startswith(layer))
    own, above = LAYERS[layer]
    limit = programs.limit(own)
    with planted(mutant):
        if build(own).returncode != 0:
            return None
        near = suites_beside(mutant.file, own)
        killer = (run_tests(own, near, limit) if near else "") or run_tests(own, limit=limit)
    if killer:
        return killer
    limit = programs.limit(above)
    with planted(mutant):
        return run_tests(above, limit=limit) if build(above).returncode == 0 else None


def equivalents():
    file = Path(__file__).with_name("equivalent.tsv")
    rows = [line.split("\t") for line in file.read_text().splitlines() if line and not line.startswith("#")] if file.exists() else []
    return {(row[0], row[1]): row[2] for row in rows}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", metavar="FILE", help="instead of all of src/geometry and render/")
    parser.add_argument("--mutants", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--list", action="store_true", help="only print the mutants")
    options = parser.parse_args()
    files = options.files or sorted(str(f.relative_to(ROOT)) for layer in LAYERS for f in (ROOT / layer).glob("*.cpp"))
    drawn = draw(files, options.mutants * 2, options.seed)   # some are no programs
    if options.list:
        print("\n".join(m.name() for m in drawn[:options.mutants]))
        return

    TREE.mkdir(parents=True, exist_ok=True)
    copy_tree()
    programs = Programs()
    known, killed, lived, same = equivalents(), 0, [], 0
    for mutant in drawn:
        if killed + len(lived) + same == options.mutants:
            break
        if (mutant.file, mutant.after.strip()) in known:
            same += 1
            print(f"same    {mutant.name()}  <- {known[mutant.file, mutant.after.strip()]}", flush=True)
            continue
        killer = verdict(mutant, programs)
        if killer is None:
            continue
        killed += bool(killer)
        if not killer:
            lived.append(mutant)
        print(f"{'killed' if killer else 'LIVES '}  {mutant.name()}" + (f"  <- {killer}" if killer else ""), flush=True)
    counted = killed + len(lived)
    print(f"{killed} of {counted} mutants killed ({100 * killed / max(counted, 1):.1f} %), {same} more change no result")
    sys.exit(0 if killed >= ENOUGH * counted else 1)


main()
