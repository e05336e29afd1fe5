"""Areas, weights and curvatures at the vertices of a mesh, in 80-bit long double.

None of the formulas is that of src/geometry, which works in double from dot and cross products of edges:

    area of a triangle      half of base times altitude, the altitude by Gram–Schmidt
    C_ij                    −∫ ∇φ_i·∇φ_j of the hat functions, whose gradients are h/|h|² with the altitude vectors h
    Voronoi area            the kite between a corner, two midpoints and the circumcentre, laid out in the plane
    angle                   2·atan2(|û − v̂|, |û + v̂|) of the unit edges (Kahan)
    mean curvature vector   the gradient of the area: C x = −∇A
    side of the normal      the gradient of the volume
"""
import numpy as np

if np.finfo(np.longdouble).nmant != 63:
    raise SystemExit("these tables need the 80-bit long double of x86")

REAL = np.longdouble
PI = 4 * np.arctan(REAL(1))
FLAT_LIMIT = REAL(1e-11)  # below 1e-12 src/geometry floors; nothing here may come near


def dot(a, b):
    return (a * b).sum(axis=1)


def length(a):
    return np.sqrt(dot(a, a))


def sum_at(vertices, values, n):
    """n sums (or n × 3) of values that stand at vertices."""
    total = np.zeros((n,) + values.shape[1:], REAL)
    np.add.at(total, vertices, values)
    return total


class Triangles:
    """Per triangle, with k the corner: p[k] position, h[k] altitude vector onto it, base[k] length of the side opposite."""

    def __init__(self, mesh):
        self.p = [mesh.X[mesh.F[:, k]] for k in range(3)]
        self.h, self.base = [], []
        for k in range(3):
            side = self.p[(k + 2) % 3] - self.p[(k + 1) % 3]
            edge = self.p[k] - self.p[(k + 1) % 3]
            self.h.append(edge - (dot(edge, side) / dot(side, side))[:, None] * side)
            self.base.append(length(side))
        self.area = length(self.h[0]) * self.base[0] / 2
        flattest = (2 * self.area / np.max(self.base, axis=0) ** 2).min()
        if not flattest > FLAT_LIMIT:
            raise ValueError(f"a triangle of no area (2A/longest² = {flattest:.1e}): its cotangents are a convention")

    def angle(self, k):
        u, v = self.p[(k + 1) % 3] - self.p[k], self.p[(k + 2) % 3] - self.p[k]
        u, v = u / length(u)[:, None], v / length(v)[:, None]
        return 2 * np.arctan2(length(u - v), length(u + v))

    def half_cotangent(self, k):
        """The weight that this triangle gives to the side opposite corner k."""
        g, f = (self.h[c] / dot(self.h[c], self.h[c])[:, None] for c in ((k + 1) % 3, (k + 2) % 3))
        return -self.area * dot(g, f)

    def kite(self, k):
        """Signed area at corner k up to the circumcentre."""
        u, v = self.p[(k + 1) % 3] - self.p[k], self.p[(k + 2) % 3] - self.p[k]
        b = length(u)                          # u along the first axis
        x, y = dot(u, v) / b, 2 * self.area / b
        centre = (dot(v, v) - b * x) / (2 * y)  # its first coordinate is b/2
        return (b / 2 * centre + b / 2 * y / 2 - centre * x / 2) / 2

    def area_gradient(self, k):
        return (self.base[k] / length(self.h[k]) / 2)[:, None] * self.h[k]

    def mixed_share(self, k):
        """Meyer et al. 2003: the kite, or half or a quarter of an obtuse triangle."""
        squares = [base * base for base in self.base]
        excess = [squares[c] - squares[(c + 1) % 3] - squares[(c + 2) % 3] for c in range(3)]  # > 0: obtuse at c
        obtuse = np.max(excess, axis=0) > 0
        return np.where(obtuse, np.where(excess[k] > 0, self.area / 2, self.area / 4), self.kite(k))


class Geometry:
    """All that the tables hold of one mesh; n values each."""

    def __init__(self, mesh):
        n, F = len(mesh.X), mesh.F
        t = Triangles(mesh)
        around = lambda share: sum(sum_at(F[:, k], share(k), n) for k in range(3))
        self.total_area = t.area.sum()
        self.areas = {"barycentric": around(lambda k: t.area / 3), "voronoi": around(t.kite), "mixed": around(t.mixed_share)}

        inside = mesh.used & ~mesh.boundary
        A = np.where(inside, self.areas["barycentric"], 1)
        self.deficit = np.where(mesh.used, np.where(mesh.boundary, PI, 2 * PI) - around(t.angle), 0)
        self.normal = around(lambda k: np.cross(t.p[(k + 1) % 3] - t.p[k], t.p[(k + 2) % 3] - t.p[k]))  # six times ∇volume
        self.curvatures = {
            "h_cotan": Curvature.of_vectors(inside, around(t.area_gradient), self.normal,
                                            around(lambda k: length(t.area_gradient(k))), 2 * A),
            "k_gauss": Curvature(inside, self.deficit / A, 2 * PI / A),
            "h_uniform": self.uniform_mean_curvature(mesh, inside)}
        self.edges, self.weights = edge_weights(mesh, t)

    def uniform_mean_curvature(self, mesh, inside):
        n, (i, j) = len(mesh.X), mesh.edges.T
        both_ends = lambda a, b: sum_at(i, a, n) + sum_at(j, b, n)
        step = mesh.X[j] - mesh.X[i]
        ones = np.ones(len(step), REAL)
        self.valence = both_ends(ones, ones)
        twice = 2 * np.where(mesh.used, self.valence, 1)
        return Curvature.of_vectors(inside, both_ends(-step, step), self.normal, both_ends(length(step), length(step)), twice)


class Curvature:
    """n values, NaN at the boundary.

    terms      what each value is the sum of: rounding is relative to this, however small the value is
    undecided  flags where the sign is rounding: the value is, or the vector lies along the surface
    """

    def __init__(self, inside, values, terms):
        nan = REAL("nan")
        self.values, self.terms = np.where(inside, values, nan), np.where(inside, terms, nan)
        self.undecided = inside & (np.abs(values) <= 1e-13 * terms)

    @classmethod
    def of_vectors(cls, inside, vectors, normals, terms, divisor):
        """From −Δx and the normal, both times anything positive."""
        along, size = dot(vectors, normals), length(vectors)
        curvature = cls(inside, np.where(along < 0, -size, size) / divisor, terms / divisor)
        curvature.undecided |= inside & (np.abs(along) <= 1e-13 * terms * length(normals))
        return curvature


def edge_weights(mesh, t):
    """The distinct edges and C_ij of each."""
    sides = np.concatenate([mesh.F[:, [(k + 1) % 3, (k + 2) % 3]] for k in range(3)])
    shares = np.concatenate([t.half_cotangent(k) for k in range(3)])
    edges, where = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True)
    return edges, sum_at(where, shares, len(edges))
