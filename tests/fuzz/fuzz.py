#!/usr/bin/env python3
"""Builds the fuzz targets with Clang and runs each: tests/fuzz/fuzz.py [--fast] [--seconds 30 | --runs N] [--jobs J] [target …]

Needs clang and its compiler-rt (Debian: clang-14 libclang-rt-14-dev). By default the targets run under AddressSanitizer and
UndefinedBehaviorSanitizer. --fast omits them, for tens of millions of executions; violated properties of the targets and failed assertions
of the standard library still stop a run. Seeds are tests/fuzz/seeds and tests/fuzz/regressions. Files of data, of templates and, with
--corpus DIR, below DIR are seeds if they have the target's ending and at most 4096 bytes. New inputs stay in build/fuzz/corpus, for both
kinds of run. A failing input is copied to tests/fuzz/regressions, where the ordinary tests replay it. Exit code 1 if any target failed."""
import argparse
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WORK = ROOT / "build" / "fuzz"
# Bytes of an input: short inputs find the same faults and run more often.
LONGEST = {"cotangent": 400, "page": 64, "rasterizer": 60, "png": 4096, "results": 4096}
LONGEST_TEXT = 512
LONGEST_SEED = 4096
LIMITS = ["-timeout=5", "-rss_limit_mb=1024", "-print_final_stats=1"]
# Keeps large pieces of memory instead of returning them after each execution.
KEEP_MEMORY = {"MALLOC_MMAP_THRESHOLD_": "100000000", "MALLOC_TRIM_THRESHOLD_": "100000000"}
# The fast build also omits the bookkeeping of rare features, which takes a third of its time.
FAST_LIMITS = ["-entropic=0"]
SANITIZER_OPTIONS = {"ASAN_OPTIONS": "detect_leaks=1:allocator_may_return_null=1", "UBSAN_OPTIONS": "print_stacktrace=1"}
FORMATS = {"settings": ".toml", "template": ".html", "results": ".json", "values": ".csv", "sums": "SHA256SUMS", "handed_in": ".zip"}


def build(preset, targets):
    subprocess.run(["cmake", "--preset", preset], cwd=ROOT, check=True, stdout=sys.stderr)
    subprocess.run(["cmake", "--build", str(ROOT / "build" / preset), "--target", *(f"fuzz_{t}" for t in targets)], check=True,
                   stdout=sys.stderr)


def seeds_of(target, extra):
    """Returns files of the target's format: its seeds, bundled meshes and settings, and files below the user's folder."""
    ending = FORMATS.get(target, "." + target)
    folders = [ROOT / "data", ROOT / "templates", *extra]
    files = [f for folder in folders for f in sorted(folder.rglob("*" + ending)) if f.is_file() and f.stat().st_size <= LONGEST_SEED]
    return files + [f for kind in ("seeds", "regressions") for f in sorted((ROOT / "tests/fuzz" / kind / target).glob("*"))]


def fuzz(target, options):
    corpus, found = WORK / "corpus" / target, WORK / "found" / target
    for folder in (corpus, found):
        folder.mkdir(parents=True, exist_ok=True)
    for number, seed in enumerate(seeds_of(target, options.corpus)):
        shutil.copy(seed, corpus / f"seed_{number:04}")
    program = ROOT / "build" / options.preset / "tests/fuzz" / f"fuzz_{target}"
    command = [str(program), str(corpus), f"-artifact_prefix={found}/", *LIMITS, f"-max_len={LONGEST.get(target, LONGEST_TEXT)}",
               *(FAST_LIMITS if options.fast else [])]
    command += [f"-runs={options.runs}"] if options.runs else [f"-max_total_time={options.seconds}"]
    done = subprocess.run(command, env={**os.environ, **SANITIZER_OPTIONS, **KEEP_MEMORY}, capture_output=True, text=True, errors="replace")
    executed = re.search(r"stat::number_of_executed_units:\s*(\d+)", done.stderr)
    rate = re.search(r"stat::average_exec_per_sec:\s*(\d+)", done.stderr)
    kept = [shutil.copy(f, regressions(target) / f.name) for f in found.glob("*") if not f.name.startswith("slow-unit")]
    print(f"{target:12} {executed[1] if executed else '?':>12} executions {rate[1] if rate else '?':>8} a second  "
          + ("clean" if done.returncode == 0 else f"FAILED, {len(kept)} inputs kept"), flush=True)
    if done.returncode != 0:
        print(done.stderr[-3000:], file=sys.stderr)
    return done.returncode == 0


def regressions(target):
    folder = ROOT / "tests/fuzz/regressions" / target
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def main():
    every = sorted(f.stem.removesuffix("_target") for f in (ROOT / "tests/fuzz").glob("*_target.cpp"))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("targets", nargs="*", choices=[*every, []], metavar="target", help=", ".join(every))
    parser.add_argument("--seconds", type=int, default=30, help="for each target")
    parser.add_argument("--runs", type=int, help="executions of each target, instead of seconds")
    parser.add_argument("--fast", action="store_true", help="without sanitizers")
    parser.add_argument("--jobs", type=int, default=1, help="targets at once")
    parser.add_argument("--corpus", type=Path, action="append", default=[], help="folder of further seeds")
    options = parser.parse_args()
    options.preset = "fuzz-fast" if options.fast else "fuzz"
    targets = options.targets or every
    build(options.preset, targets)
    with ThreadPoolExecutor(options.jobs) as pool:
        clean = list(pool.map(lambda target: fuzz(target, options), targets))
    sys.exit(0 if all(clean) else 1)


main()
