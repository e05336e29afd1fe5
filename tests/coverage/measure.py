#!/usr/bin/env python3
"""How much of src/ and render/ the tests run: builds the preset "coverage" (Clang counts lines and both ways of every branch in the source
itself, without those the compiler adds for exceptions), runs all tests but the slow ones, and prints what was reached.

    tests/coverage/measure.py [--no-run] [--uncovered FILE] [-- ARGUMENTS OF CTEST]

--no-run only tells of the last run again; --uncovered writes every line that no test reaches. Needs clang-14 and llvm-14 (llvm-profdata,
llvm-cov). Exit code 1 under 90 % of the lines or 80 % of the branches."""
import argparse
import json
import os
import shutil
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "coverage"
PROFILES = BUILD / "profiles"
MERGED = BUILD / "merged.profdata"
GOALS = {"lines": 90.0, "branches": 80.0}


def run_tests(arguments):
    subprocess.run(["cmake", "--preset", "coverage"], cwd=ROOT, check=True, stdout=sys.stderr)
    subprocess.run(["cmake", "--build", str(BUILD)], check=True, stdout=sys.stderr)
    shutil.rmtree(PROFILES, ignore_errors=True)
    PROFILES.mkdir()
    # %2m: the runs of one program add up in two files, or a thousand tests would leave a thousand files of megabytes.
    counters = {**os.environ, "LLVM_PROFILE_FILE": str(PROFILES / "%2m.profraw")}
    tests = subprocess.run(["ctest", "--test-dir", str(BUILD), "-LE", "slow", "--parallel", str(os.cpu_count()), *arguments], env=counters)
    if tests.returncode != 0:
        print("some tests failed; what they reached counts all the same", file=sys.stderr)
    raw = sorted(str(f) for f in PROFILES.glob("*.profraw"))
    subprocess.run(["llvm-profdata-14", "merge", "-sparse", "-o", str(MERGED), *raw], check=True)
    return tests.returncode == 0


def exported():
    """Of each file of ours: its summary and its lines that were not reached."""
    programs = [BUILD / "meshfolio", *sorted((BUILD / "tests").glob("*_tests")), *sorted((BUILD / "tests/fuzz").glob("fuzz_*"))]
    programs = [str(p) for p in programs if p.is_file()]
    objects = [word for program in programs[1:] for word in ("-object", program)]
    command = ["llvm-cov-14", "export", programs[0], *objects, f"-instr-profile={MERGED}", "-skip-functions"]
    out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    files = {}
    for entry in json.loads(out)["data"][0]["files"]:
        name = str(Path(entry["filename"]).resolve().relative_to(ROOT))
        if not name.startswith(("src/", "render/")):   # the tests and what is generated, which llvm-cov adds
            continue
        files[name] = (entry["summary"], unreached(entry["segments"]))
    return files


def unreached(segments):
    """Lines whose last region has the count 0. A segment is [line, column, count, has count, begins a region, is a gap]."""
    lines = set()
    for this, following in zip(segments, segments[1:]):
        if this[3] and this[2] == 0 and not this[5]:
            lines.update(range(this[0], following[0] + (following[1] > 1)))
    return sorted(lines)


def percent(covered, count):
    return 100.0 * covered / count if count else 100.0


def folder_of(name):
    parts = name.split("/")
    return "/".join(parts[:2]) if parts[0] == "src" and len(parts) > 2 else parts[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--no-run", action="store_true")
    parser.add_argument("--uncovered", type=Path, metavar="FILE")
    parser.add_argument("ctest", nargs="*", help="further arguments of ctest, after --")
    options = parser.parse_args()
    passed = options.no_run or run_tests(options.ctest)
    files = exported()

    sums = defaultdict(lambda: defaultdict(lambda: [0, 0]))
    for name, (summary, _) in files.items():
        for kind in GOALS:
            for place in (folder_of(name), "all"):
                sums[place][kind][0] += summary[kind]["covered"]
                sums[place][kind][1] += summary[kind]["count"]
    print(f"{'':16}{'lines':>17}{'branches':>20}")
    for place in sorted(sums, key=lambda place: (place == "all", place)):
        row = [f"{covered:6}/{count:6} {percent(covered, count):5.1f} %" for covered, count in (sums[place][kind] for kind in GOALS)]
        print(f"{place:16}" + "".join(f"{cell:>20}" for cell in row))
    low = sorted((percent(s["lines"]["covered"], s["lines"]["count"]), name) for name, (s, _) in files.items())
    print("\nleast covered files, by lines")
    for share, name in low[:15]:
        print(f"  {share:5.1f} %  {name}")
    if options.uncovered:
        text = "".join(f"{name}:{line}: {source[line - 1].strip()}\n" for name, (_, lines) in sorted(files.items())
                       for source in [(ROOT / name).read_text().split("\n")] for line in lines if line <= len(source))
        options.uncovered.write_text(text)
    reached = all(percent(*sums["all"][kind]) >= goal for kind, goal in GOALS.items())
    sys.exit(0 if reached and passed else 1)


main()
