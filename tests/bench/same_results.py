#!/usr/bin/env python3
"""Lists differences between the outputs of two programs: reports (full and quick, on bundled and other meshes), verify and every command on one mesh.

    same_results.py OLD NEW [--meshes FOLDER] [--runs report,verify] [--keep FOLDER] [--tolerance 1e-11]

Without --tolerance every byte must agree, except src.txt, the lines of citations and the commit. With --tolerance, numbers in texts may differ
by this share of the larger one, and pictures are compared decoded (needs ImageMagick's `compare`). With --keep FOLDER, OLD runs only once.
The folder of --meshes holds the course's meshes in coursework/ and others in classic/. Exit code 1 if the outputs differ."""

import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

DATA = Path(__file__).resolve().parents[2] / "data"
NUMBER = re.compile(rb"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
TEXTS = {".csv", ".json", ".md", ".html", ".svg", ".txt", ".obj", ".out", ".err", ".css", ".js"}
# These may always differ: the commit, and lines and lengths of cited files.
COMMIT = re.compile(rb'("commit": ?"|commit |commit <code>|Commit[^\n]*?<code>)([0-9a-f]{12}|unknown)\b')
CITED = re.compile(rb"src\.txt#L\d+|\| L\d+ \||>L\d+<|(?<=\.cpp):\d+|(?<=\.h):\d+|(\"line(s)?\": ?)\d+")
CITED_NAME = re.compile(rb"(src|render)/[\w/.-]+\.(cpp|h)|\banswer(_\w+)?\b")


def runs(meshes):
    """Returns name → words of each command; {out} is its own empty folder."""
    quiet = ["--no-cache", "--no-timings", "--pdf", "off", "--out", "{out}/report"]
    commands = {"report": ["report", *quiet], "report-quick": ["report", "--quick", *quiet],
                "report-torus": ["report", DATA / "torus.obj", "--quick", *quiet], "verify": ["verify", "--quick", "--out", "{out}/truth"],
                "laboratory": ["report", "--config", "laboratory", "--quick", "--only", "stability,modes,methods", *quiet]}
    own = [DATA / "creature.obj", DATA / "fandisk_noisy.obj", DATA / "plane.obj"]
    if meshes:
        commands["report-coursework"] = ["report", "--data", meshes / "coursework", *quiet]
        commands["report-camel"] = ["report", meshes / "classic" / "camel_b.obj", "--quick", *quiet]
        commands["report-bumpy"] = ["report", meshes / "classic" / "bumpy.off", "--quick", *quiet]
        own += [meshes / "classic" / name for name in ("ogre.obj", "cow.off", "cube.obj")]
    for mesh in own:
        name = mesh.stem
        commands[f"inspect-{name}"] = ["inspect", mesh, "--json"]
        commands[f"inspect-opposite-{name}"] = ["inspect", mesh, "--operator", "opposite-mean"]
        commands[f"render-{name}"] = ["render", mesh, "--field", "h-cotan", "--size", "300", "--out", "{out}"]
        commands[f"curvature-{name}"] = ["curvature", mesh, "--jets", "--operator", "tufted", "--csv", "{out}/fields.csv"]
        commands[f"spectrum-{name}"] = ["spectrum", mesh, "-k", "12", "--csv", "{out}/modes.csv", "--reconstruct", "5,12", "--out", "{out}/k"]
        for scheme in ("explicit", "implicit", "taubin"):
            commands[f"{scheme}-{name}"] = ["smooth", mesh, "-o", "{out}/smooth.ply", "--scheme", scheme, "--iterations", "7"]
    return commands


def ran(program, words, out):
    out.mkdir(parents=True)
    environment = {**os.environ, "LC_ALL": "C", "XDG_CACHE_HOME": str(out.parent / "no cache")}
    end = subprocess.run([program, *(str(word).replace("{out}", str(out)) for word in words)], capture_output=True, env=environment)
    where = str(out).encode()
    (out / "stdout.out").write_bytes(end.stdout.replace(where, b"OUT"))
    lines = [line for line in end.stderr.replace(where, b"OUT").splitlines(True) if not re.search(rb" in [0-9.e-]+ s$| answered | s\n", line)]
    (out / "stderr.err").write_bytes(b"".join(lines) + b"exit code %d\n" % end.returncode)


def joined(value):
    """Returns the JSON with neighbouring pieces of plain text joined."""
    if isinstance(value, dict):
        return {key: joined(each) for key, each in value.items()}
    if not isinstance(value, list):
        return value
    pieces = []
    for each in map(joined, value):
        if isinstance(each, str) and pieces and isinstance(pieces[-1], str):
            pieces[-1] += each
        else:
            pieces.append(each)
    return pieces


def comparable(path):
    data = path.read_bytes()
    if path.name == "results.json":
        data = json.dumps(joined(json.loads(data)), indent=1, ensure_ascii=False).encode()
    return CITED_NAME.sub(b"CITED", CITED.sub(b"", COMMIT.sub(b"", data))) if path.suffix in TEXTS else data


def numbers_agree(old, new, tolerance):
    if NUMBER.sub(b"#", old) != NUMBER.sub(b"#", new):
        return False
    pairs = zip(map(float, NUMBER.findall(old)), map(float, NUMBER.findall(new)))
    return all(abs(a - b) <= tolerance * max(abs(a), abs(b)) + 1e-15 for a, b in pairs)


def pictures_agree(old, new):
    return subprocess.run(["compare", "-metric", "AE", old, new, "null:"], capture_output=True).returncode == 0


def same(old, new, tolerance):
    a, b = comparable(old), comparable(new)
    if a == b:
        return True
    if tolerance is None:
        return False
    return pictures_agree(old, new) if old.suffix == ".png" else old.suffix in TEXTS and numbers_agree(a, b, tolerance)


def first_difference(old, new):
    if old.suffix not in TEXTS:
        return f"{hashlib.sha256(old.read_bytes()).hexdigest()[:8]} and {hashlib.sha256(new.read_bytes()).hexdigest()[:8]}"
    a, b = comparable(old), comparable(new)
    at = next((i for i, (x, y) in enumerate(zip(a, b)) if x != y), min(len(a), len(b)))
    return f"\n    {a[max(0, at - 60):at + 100]!r}\n    {b[max(0, at - 60):at + 100]!r}"


def differences(old, new, tolerance):
    """Yields the files that differ between the two folders, except src.txt and the list of sums, which follow from the source and other files."""
    files = {p.relative_to(folder) for folder in (old, new) for p in folder.rglob("*") if p.is_file() and p.name not in ("src.txt", "SHA256SUMS")}
    for file in sorted(files):
        if not (old / file).exists() or not (new / file).exists():
            yield f"{file}: only {'the old' if (old / file).exists() else 'the new'} program writes it"
        elif not same(old / file, new / file, tolerance):
            yield f"{file}: {first_difference(old / file, new / file)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("--meshes", type=Path)
    parser.add_argument("--runs", help="only runs whose names begin with one of these")
    parser.add_argument("--keep", type=Path, help="what the old program wrote is kept here, and taken from here the next time")
    parser.add_argument("--tolerance", type=float)
    options = parser.parse_args()
    wanted = tuple((options.runs or "").split(","))
    differing = compared = 0
    with tempfile.TemporaryDirectory(prefix="same-results-") as folder:
        kept = options.keep or Path(folder) / "old"
        for name, words in runs(options.meshes and options.meshes.resolve()).items():
            if not name.startswith(wanted):
                continue
            old, new = kept / name, Path(folder) / "new" / name
            if not (old / "stderr.err").exists():
                shutil.rmtree(old, ignore_errors=True)
                ran(options.old.resolve(), words, old)
            ran(options.new.resolve(), words, new)
            found = list(differences(old, new, options.tolerance))
            compared += sum(p.is_file() for p in new.rglob("*"))
            differing += len(found)
            print(f"{name}: {len(found) or 'none'} differ", flush=True)
            for line in found[:8]:
                print("  " + line, flush=True)
            shutil.rmtree(new)
    print(f"{compared} files, {differing} differ")
    return differing > 0


if __name__ == "__main__":
    sys.exit(main())
