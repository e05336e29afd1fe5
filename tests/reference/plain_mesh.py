"""Triangle meshes, read and made ready in the plainest way that does what mesh_checks.h promises.

Reads OBJ and OFF files of triangles, which all the meshes with reference values are; anything else is refused, not guessed.
"""
import hashlib
from pathlib import Path

import numpy as np


class Mesh:
    """X: n × 3 positions in long double [length]. F: m × 3 corners from 0. boundary, used: n flags."""

    def __init__(self, X, F):
        self.X = X.astype(np.longdouble)
        self.F = F
        self.used = np.zeros(len(X), bool)
        self.used[F] = True
        self.edges, sides = np.unique(np.sort(directed_edges(F), axis=1), axis=0, return_counts=True)
        if sides.max() > 2:
            raise ValueError("an edge with more than two triangles")
        self.boundary = np.zeros(len(X), bool)
        self.boundary[self.edges[sides == 1]] = True
        require_one_fan_each(F, self.boundary)

    @property
    def euler_characteristic(self):
        return int(self.used.sum()) - len(self.edges) + len(self.F)


def directed_edges(F):
    """3m × 2, the edge from each corner to the next."""
    return np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])


def require_one_fan_each(F, boundary):
    """Walks around each vertex: all its triangles must be met in one go, or curvature there is undefined."""
    after = [{} for _ in boundary]  # the ring around v: first corner of a triangle to its second
    for a, b, c in F.tolist():
        for v, first, second in ((a, b, c), (b, c, a), (c, a, b)):
            after[v][first] = second
    for v, ring in enumerate(after):
        if not ring:
            continue
        starts = set(ring) - set(ring.values()) if boundary[v] else {next(iter(ring))}
        here, steps = next(iter(starts)), 0
        while here in ring and steps <= len(ring):
            here, steps = ring[here], steps + 1
            if not boundary[v] and here in starts:
                break
        if steps != len(ring) or len(starts) != 1:
            raise ValueError(f"vertex {v} has more than one fan")


def sha256(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def read(path):
    """The mesh of a file, prepared.  Raises ValueError for what the tables do not cover."""
    lines = Path(path).read_text().splitlines()
    X, F = read_off(lines) if Path(path).suffix == ".off" else read_obj(lines)
    return prepared(np.array(X, float), np.array(F))


def read_obj(lines):
    X = [[float(word) for word in line.split()[1:4]] for line in lines if line.startswith("v ")]
    F = [[int(word.split("/")[0]) - 1 for word in line.split()[1:]] for line in lines if line.startswith("f ")]
    return X, F


def read_off(lines):
    rows = [line.split("#")[0].split() for line in lines]
    rows = [row for row in rows if row]
    if rows[0] != ["OFF"]:
        raise ValueError("not an OFF file")
    vertices, faces = int(rows[1][0]), int(rows[1][1])
    X = [[float(word) for word in row[:3]] for row in rows[2:2 + vertices]]
    F = [[int(word) for word in row[1:1 + int(row[0])]] for row in rows[2 + vertices:2 + vertices + faces]]
    return X, F


def prepared(X, F):
    """Faces that name a corner twice and repeated faces are dropped; closed components point outwards."""
    if F.ndim != 2 or F.shape[1] != 3 or F.min() < 0 or F.max() >= len(X):
        raise ValueError("not all faces are triangles of known vertices")
    F = F[(F[:, 0] != F[:, 1]) & (F[:, 1] != F[:, 2]) & (F[:, 2] != F[:, 0])]
    _, first = np.unique(np.sort(F, axis=1), axis=0, return_index=True)
    F = F[np.sort(first)].copy()
    if len(np.unique(directed_edges(F), axis=0)) != 3 * len(F):
        raise ValueError("neighbouring triangles are not oriented alike")
    component = components(len(X), F)[F[:, 0]]
    for one in np.unique(component):
        part = component == one
        if is_closed(F[part]) and six_volumes(X, F[part]).sum() < 0:
            F[part] = F[part][:, [0, 2, 1]]
    return Mesh(X, F)


def components(n, F):
    """n labels, equal where triangles connect."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components
    ends = directed_edges(F)
    graph = coo_matrix((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(n, n))
    return connected_components(graph, directed=False)[1]


def is_closed(F):
    _, sides = np.unique(np.sort(directed_edges(F), axis=1), axis=0, return_counts=True)
    return (sides == 2).all()


def six_volumes(X, F):
    p, q, r = (X[F[:, k]].astype(np.longdouble) - X[F[0, 0]] for k in range(3))
    return np.einsum("ij,ij->i", p, np.cross(q, r))
