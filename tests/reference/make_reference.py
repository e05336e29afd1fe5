#!/usr/bin/python3
"""Makes the reference tables beside it, or checks them.

    make_reference.py [--check] [--only PART-OF-NAME] [FOLDER]

FOLDER holds the shared meshes (default: ../shared/meshes beside the project); the bundled ones of data/ are always included.
--check computes everything anew and compares with the tables to 1e-12; meshes that are not there are named. See README.md.
"""
import argparse
import csv
import sys
import time
from pathlib import Path

import numpy as np

import plain_mesh
import spectra
from long_double import Geometry

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parent.parent
TABLES = ("meshes", "vertices", "eigenvalues")
KEYS = {"meshes": 1, "vertices": 2, "eigenvalues": 2}  # leading columns that name a row
NAMES = ("mesh", "sha256", "vertex", "index")
SPREAD = 8
EIGENVALUES = 12
ALL_EIGENVALUES_UP_TO = 800


def text(value):
    """17 significant digits, which name a double; nothing where undefined."""
    if isinstance(value, (str, int, np.integer)):
        return str(value)
    return "" if np.isnan(value) else f"{float(value):.17g}"


def mesh_row(name, path, mesh, geometry, wanted):
    row = {"mesh": name, "sha256": plain_mesh.sha256(path), "vertices": int(mesh.used.sum()), "triangles": len(mesh.F),
           "euler": mesh.euler_characteristic, "area": geometry.total_area}
    for form, areas in geometry.areas.items():
        row |= {f"{form}_sum": areas.sum(), f"{form}_min": areas[mesh.used].min(), f"{form}_max": areas[mesh.used].max()}
    for column, curvature in geometry.curvatures.items():
        row |= curvature_norms(column, curvature, geometry.areas["barycentric"])
    row |= {"deficit_sum": geometry.deficit.sum(), "mu_max": spectra.largest(wanted)}
    row |= {"lambda_crit": 2 / row["mu_max"], "gershgorin": wanted.gershgorin(),
            "lambda_crit_uniform": 2 / spectra.largest(spectra.uniform(geometry))}
    return row


def curvature_norms(column, curvature, areas):
    """∫|f| and √∫f² over the interior vertices, the same of the terms, how many are negative, and how many may be either."""
    inside = ~np.isnan(curvature.values)
    A, row = areas[inside], {}
    for suffix, f in (("", curvature.values[inside]), ("_terms", curvature.terms[inside])):
        row |= {f"{column}_l1{suffix}": (A * np.abs(f)).sum(), f"{column}_l2{suffix}": np.sqrt((A * f * f).sum())}
    sure = inside & ~curvature.undecided
    return row | {f"{column}_negative": int((curvature.values[sure] < 0).sum()), f"{column}_undecided": int((inside & ~sure).sum())}


def telling_vertices(mesh, geometry):
    """Some spread evenly, and those where rounding bites most: the extremes of every column."""
    used = np.flatnonzero(mesh.used)
    chosen = list(used[[i * (len(used) - 1) // (SPREAD - 1) for i in range(SPREAD)]])
    for curvature in geometry.curvatures.values():
        inside = np.flatnonzero(~np.isnan(curvature.values) & ~curvature.undecided)
        chosen += list(inside[[np.argmax(np.abs(curvature.values[inside]))]]) if len(inside) else []
    chosen.append(used[np.argmin(geometry.areas["voronoi"][used])])
    return sorted(set(int(v) for v in chosen))


def vertex_rows(name, mesh, geometry):
    columns = {**geometry.areas, "deficit": geometry.deficit}
    for column, curvature in geometry.curvatures.items():
        columns |= {column: curvature.values, f"{column}_terms": curvature.terms}
    return [{"mesh": name, "vertex": v} | {column: values[v] for column, values in columns.items()}
            for v in telling_vertices(mesh, geometry)]


def eigenvalue_rows(name, mesh, problem):
    indices = set(range(min(EIGENVALUES, problem.n)))
    if problem.n <= ALL_EIGENVALUES_UP_TO:
        indices |= {problem.n // 4, problem.n // 2, 3 * problem.n // 4, problem.n - 1}
    zeros = len(np.unique(plain_mesh.components(len(mesh.X), mesh.F)[mesh.used]))
    return [{"mesh": name, "index": i, "eigenvalue": mu} for i, mu in spectra.smallest(problem, sorted(indices), zeros)]


def rows_of(name, path):
    mesh = plain_mesh.read(path)
    geometry = Geometry(mesh)
    problem = spectra.cotangent(geometry)
    return {"meshes": [mesh_row(name, path, mesh, geometry, problem)], "vertices": vertex_rows(name, mesh, geometry),
            "eigenvalues": eigenvalue_rows(name, mesh, problem)}


def mesh_files(folder):
    """{name: path}, the bundled meshes first; a shared one is named by its path below the folder."""
    files = {f"data/{path.name}": path for path in sorted((PROJECT / "data").glob("*.obj"))}
    shared = sorted(path for ending in ("obj", "off") for path in folder.rglob(f"*.{ending}"))
    return files | {path.relative_to(folder).as_posix(): path for path in shared}


def computed(files):
    tables = {table: [] for table in TABLES}
    for name, path in files.items():
        start = time.perf_counter()
        for table, rows in rows_of(name, path).items():
            tables[table] += [{column: text(value) for column, value in row.items()} for row in rows]
        print(f"{name}: {time.perf_counter() - start:.1f} s", file=sys.stderr, flush=True)
    return tables


def read_table(table):
    with open(HERE / f"{table}.csv", newline="") as file:
        return list(csv.DictReader(file))


def write_table(table, rows):
    with open(HERE / f"{table}.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def agree(column, old, new, tolerance=1e-12):
    """Entries of one column of two rows: equal, or close for what they are sums of."""
    if old[column] == new[column]:
        return True
    if "" in (old[column], new[column]) or column in NAMES:
        return False
    was, now = float(old[column]), float(new[column])
    rounding = 1e-17 * float(old.get(f"{column}_terms") or 0) + (1e-15 if column.startswith("deficit") else 0)
    return abs(was - now) <= tolerance * abs(was) + rounding


def check(files, part_of_name):
    """Number of entries that differ."""
    wrong = 0
    known = {row["mesh"] for row in read_table("meshes") if part_of_name in row["mesh"]}
    for name in sorted(known - set(files)):
        print(f"{name}: not there, not checked")
    fresh = computed({name: path for name, path in files.items() if name in known})
    for table in TABLES:
        key = lambda row: tuple(row.values())[:KEYS[table]]
        new = {key(row): row for row in fresh[table]}
        for row in read_table(table):
            if row["mesh"] not in known & set(files):
                continue
            other = new.get(key(row), dict.fromkeys(row, ""))
            for column in row:
                if not agree(column, row, other):
                    print(f"{table} {' '.join(key(row))} {column}: {row[column]} in the table, {other[column]} now")
                    wrong += 1
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=Path, default=PROJECT.parent / "shared" / "meshes")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    files = mesh_files(options.folder)
    if options.check:
        wrong = check(files, options.only)
        print(f"{wrong} entries differ" if wrong else "all entries agree")
        return 1 if wrong else 0
    if options.only:
        parser.error("--only goes with --check: the tables are written whole")
    for table, rows in computed(files).items():
        write_table(table, rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
