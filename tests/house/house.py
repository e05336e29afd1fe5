#!/usr/bin/env python3
"""Measures of the source that keep it readable, and the table of lines in ARCHITECTURE.md.

    house.py            checks every measure; exit code 1 and a line for each that fails
    house.py --lines    prints the table of lines for each feature
    house.py --docstrings SEED COUNT    draws docstrings with their declarations, for a reader who does not know the code
"""

import random
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CODE = sorted(p for top in ("src", "render") for p in (ROOT / top).rglob("*") if p.suffix in (".cpp", ".h"))
TEXT = {p: p.read_text() for p in CODE}

# Feature, and the folders or files that it takes.
FEATURES = {
    "meshes: data structure, checks, samples": ["src/mesh/*.*", "src/mesh/samples"],
    "mesh formats": ["src/mesh/io"],
    "curvature": ["src/geometry/curvature"],
    "operators and linear algebra": ["src/geometry/operators", "src/geometry/linear"],
    "spectra": ["src/geometry/spectrum"],
    "spectra over several processes (MPI)": ["src/geometry/distributed"],
    "smoothing and denoising": ["src/geometry/smoothing", "src/geometry/denoising"],
    "measures of meshes": ["src/geometry/measures"],
    "seven questions": ["src/questions/q*"],
    "supporting chapters": [f"src/questions/{name}" for name in ("truth", "stability", "modes", "methods", "operators", "certificates")],
    "studies that chapters share": ["src/questions/bench", "src/questions/core"],
    "document and its writers": ["src/report/*.*", "src/report/page", "src/report/json", "src/report/svg", "src/report/markdown", "src/report/batch"],
    "PDF": ["src/report/pdf"],
    "renderer": ["render"],
    "figures, publication, cache": ["src/output"],
    "road of a report, plan, settings": ["src/run/*.*", "src/run/plan", "src/run/settings"],
    "live laboratory": ["src/run/lab"],
    "batch": ["src/run/batch"],
    "marking": ["src/run/mark"],
    "commands on one mesh": ["src/run/one_mesh"],
    "what changed between reports": ["src/run/diff"],
    "command line": ["src/cli", "src/*.*"],
    "submission": ["src/submission"],
    "Python module": ["src/python"],
    "files, numbers, terminal": ["src/base"],
}

DOCSTRING = re.compile(r"^[ \t]*///(?!<)(?: ?(.*))$")
RIDDLE_BEGINS = re.compile(r"(Those|The same|Of|What|Whose|Where|How|Who|Whom|Is|Are|So many)\b")
RIDDLES = re.compile(r"\b(what is|what was|what are|so many|so much|is told|are told|lest)\b|\w\?(?=\s|$)", re.I)


def of_feature(path, patterns):
    relative = path.relative_to(ROOT).as_posix()
    for pattern in patterns:
        if pattern.endswith("*.*"):
            if path.parent == ROOT / pattern[:-4]:
                return True
        elif pattern.endswith("*"):
            if relative.startswith(pattern[:-1]):
                return True
        elif relative.startswith(pattern + "/"):
            return True
    return False


def lines_of_features():
    lines = {name: sum(TEXT[p].count("\n") for p in CODE if of_feature(p, patterns)) for name, patterns in FEATURES.items()}
    whole = sum(text.count("\n") for text in TEXT.values())
    assert sum(lines.values()) == whole, "a file belongs to no feature, or to two"
    return lines, whole


def table():
    lines, whole = lines_of_features()
    rows = [f"| {name} | {count:,} |" for name, count in sorted(lines.items(), key=lambda item: -item[1])]
    return "\n".join(["| feature | lines |", "|---|--:|", *rows, f"| **all** | **{whole:,}** |"])


def check_table():
    """The table in ARCHITECTURE.md is that of `house.py --lines`, give or take 5 %."""
    lines, whole = lines_of_features()
    said = {m[0].strip("* "): int(m[1].replace(",", "")) for m in re.findall(r"^\| (\S[^|]*?) \| \**([\d,]+)\** \|$", (ROOT / "ARCHITECTURE.md").read_text(), re.M)}
    for name, count in {**lines, "all": whole}.items():
        if name not in said:
            yield f"ARCHITECTURE.md has no lines for '{name}': insert the table of tests/house/house.py --lines"
        elif abs(said[name] - count) > 20 + 0.05 * count:
            yield f"ARCHITECTURE.md says {said[name]} lines for '{name}', there are {count}: insert the table of tests/house/house.py --lines"


def check_readers():
    """results.json has one reader: src/report/json."""
    for path in CODE:
        relative = path.relative_to(ROOT).as_posix()
        if not relative.startswith("src/report/") and re.search(r"\bjson::parse\(", TEXT[path]) and re.search(r"results\.json|results_file", TEXT[path]):
            yield f"{relative} parses JSON beside results.json: report::read_json() is its reader"


def chapters():
    listed = (ROOT / "src/questions/core/chapter_list.cpp").read_text()
    for folder in re.findall(r"^    chapter\((\w+)\)", listed, re.M):
        text = (ROOT / f"src/questions/{folder}/chapter.cpp").read_text()
        yield folder, re.search(r'\.id = "(\w+)"', text).group(1)


def check_chapter_names():
    """A chapter is named in one file outside its folder: chapter_list.cpp."""
    code_only = {p: re.sub(r"//.*", "", text) for p, text in TEXT.items()}
    for folder, name in chapters():
        quoted = rf'"{name}"' if re.fullmatch(r"q\d+", name) else rf'(?:of_id\(|section_of\(|== )"{name}"'   # other names are words, too
        pattern = re.compile(rf'{quoted}|"{name}_|\b{folder}::|"questions/{folder}/')
        for path, text in code_only.items():
            relative = path.relative_to(ROOT).as_posix()
            if relative.startswith(f"src/questions/{folder}/"):
                continue
            found = pattern.search(text)
            if found:
                yield f"{relative} names the chapter {name}: {found.group(0)}"


def included(path):
    for name in re.findall(r'^#include "([^"]+)"', TEXT.get(path, ""), re.M):
        for base in (ROOT / "src", ROOT / "render", path.parent):
            if (base / name).exists():
                yield (base / name).resolve()
                break


def closure_of(path):
    seen, rest = set(), [path]
    while rest:
        one = rest.pop()
        if one in seen:
            continue
        seen.add(one)
        rest.extend(included(one))
    return seen


def check_closures():
    """The include closure of a chapter is at most 30 files of ours."""
    for folder, _ in chapters():
        count = len(closure_of(ROOT / f"src/questions/{folder}/chapter.cpp"))
        if count > 30:
            yield f"src/questions/{folder}/chapter.cpp includes {count} files, itself counted; 30 are allowed"


def docstrings():
    """(file, line, text, declaration) of every documentation comment."""
    for path in CODE:
        lines = TEXT[path].split("\n")
        i = 0
        while i < len(lines):
            start, words = i, []
            while i < len(lines) and (found := DOCSTRING.match(lines[i])):
                words.append(found.group(1) or "")
                i += 1
            if words:
                declaration = []
                while i < len(lines) and lines[i].strip() and len(declaration) < 6:
                    declaration.append(lines[i].strip())
                    i += 1
                    if declaration[-1].endswith((";", "{", "}")):
                        break
                yield path.relative_to(ROOT).as_posix(), start + 1, " ".join(words), declaration
            else:
                i += 1


def check_docstrings():
    """A documentation comment begins with a verb or names the thing, and asks no riddles."""
    for path, line, text, _ in docstrings():
        text = text.removeprefix("@file").strip()
        prose = re.sub(r'"[^"]*"|`[^`]*`', "", text)
        if RIDDLE_BEGINS.match(text) or RIDDLES.search(prose):
            yield f"{path}:{line}: say plainly: {text}"


def check_folders():
    """No folder has more than 40 files, no file more than 400 lines."""
    for folder in {p.parent for p in CODE}:
        count = sum(p.parent == folder for p in CODE)
        if count > 40:
            yield f"{folder.relative_to(ROOT)} has {count} files; 40 are allowed"
    for path, text in TEXT.items():
        if text.count("\n") > 400:
            yield f"{path.relative_to(ROOT)} has {text.count(chr(10))} lines; 400 are allowed"


def drawn(seed, count):
    public = [d for d in docstrings() if d[0].endswith(".h") and not d[2].startswith("@file") and "(" in " ".join(d[3])]
    for path, line, text, declaration in random.Random(seed).sample(public, count):
        print(f"{path}:{line}\n    /// {text}\n    " + "\n    ".join(declaration) + "\n")


def main():
    if "--lines" in sys.argv:
        print(table())
    elif "--docstrings" in sys.argv:
        drawn(int(sys.argv[2]), int(sys.argv[3]))
    else:
        failures = [line for check in (check_readers, check_chapter_names, check_closures, check_docstrings, check_folders, check_table) for line in check()]
        print("\n".join(failures))
        return 1 if failures else 0
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
