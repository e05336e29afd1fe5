"""Eigenvalues of −Cφ = μMφ: found by SciPy in double, then sharpened in long double.

Found by LAPACK (small) or ARPACK. Corrections with long-double residuals remove what rounding put into the steep modes, and the eigenvalue
is the Rayleigh quotient Σ w_ij (φ_i − φ_j)² / Σ M φ², whose error is the square of that of φ. That none was missed is shown by the negative
pivots of a factor of −C − σM, and for the largest one that none lies 1e-12 above it.
"""
import numpy as np
import scipy.linalg
from scipy.sparse import coo_matrix, diags
from scipy.sparse.linalg import ArpackNoConvergence, eigsh, splu

DENSE_UP_TO = 800
REAL = np.longdouble


class Problem:
    """Graph weights on edges between n vertices with masses; vertices without mass are left out."""

    def __init__(self, edges, weights, masses):
        kept = masses > 0
        name = np.cumsum(kept) - 1
        self.edges, self.w, self.M = name[edges], weights, masses[kept]
        self.n = int(kept.sum())
        w = self.w.astype(float)
        i, j = self.edges.T
        off = coo_matrix((np.concatenate([-w, -w]), (np.concatenate([i, j]), np.concatenate([j, i]))), shape=(self.n,) * 2)
        self.K = (off.tocsc() + diags(-np.asarray(off.sum(axis=1)).ravel())).tocsc()
        self.M_double = diags(self.M.astype(float)).tocsc()

    def stiffness_times(self, x):
        """−C x, by differences along edges."""
        i, j = self.edges.T
        flow = self.w * (x[i] - x[j])
        y = np.zeros(self.n, REAL)
        np.add.at(y, i, flow)
        np.add.at(y, j, -flow)
        return y

    def rayleigh_quotient(self, x):
        i, j = self.edges.T
        return (self.w * (x[i] - x[j]) ** 2).sum() / (self.M * x * x).sum()

    def factor(self, sigma):
        """LDLᵀ of −C − σM without exchanges, so that the signs of the pivots are those of the eigenvalues."""
        return splu(self.K - sigma * self.M_double, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0, options={"SymmetricMode": True})

    def count_below(self, sigma):
        lu = self.factor(sigma)
        if (lu.perm_r != lu.perm_c).any():
            raise ArithmeticError("rows were exchanged: the pivots count nothing")
        return int((lu.U.diagonal() < 0).sum())

    def gershgorin(self):
        bound = np.zeros(self.n, REAL)
        diagonal = np.zeros(self.n, REAL)
        for a in (0, 1):
            np.add.at(bound, self.edges[:, a], np.abs(self.w))
            np.add.at(diagonal, self.edges[:, a], self.w)
        return ((bound + np.abs(diagonal)) / self.M).max()

    def sharpened(self, vectors, sigma):
        """Long-double vectors: corrected twice with their residuals, then turned within their span so that they are eigenvectors there."""
        X = vectors.astype(REAL)
        solver = self.factor(sigma)
        for _ in range(2):
            for k in range(X.shape[1]):
                X[:, k] /= np.sqrt((self.M * X[:, k] ** 2).sum())
                X[:, k] -= solver.solve(self.residual(X[:, k]).astype(float))
        stiffness = np.array([[(X[:, i] * self.stiffness_times(X[:, j])).sum() for j in range(X.shape[1])] for i in range(X.shape[1])])
        mass = (X * self.M[:, None]).T @ X
        _, turn = scipy.linalg.eigh(((stiffness + stiffness.T) / 2).astype(float), mass.astype(float))
        return X @ turn.astype(REAL)

    def residual(self, x):
        return self.stiffness_times(x) - self.rayleigh_quotient(x) * self.M * x

    def relative_residual(self, x):
        """‖r‖/(μ‖x‖) in the norms of M⁻¹ and M: the relative error of μ is at most this, and about its square over the relative gap."""
        size = np.sqrt((self.residual(x) ** 2 / self.M).sum() / (self.M * x * x).sum())
        return size / self.rayleigh_quotient(x)


def cotangent(geometry):
    return Problem(geometry.edges, geometry.weights, geometry.areas["barycentric"])


def uniform(geometry):
    """D(I − D⁻¹W): every edge weighs 1, every vertex its valence."""
    return Problem(geometry.edges, np.ones(len(geometry.edges), REAL), geometry.valence)


def dense_pairs(problem):
    return scipy.linalg.eigh(problem.K.toarray(), problem.M_double.toarray())


def smallest(problem, indices, zeros):
    """[(index, μ)] for the wanted indices (ascending); the first `zeros` are exactly 0."""
    if problem.n <= DENSE_UP_TO:
        _, vectors = dense_pairs(problem)
    else:
        vectors = smallest_of_large(problem, max(indices) + 1)
    for i in indices:
        if i >= zeros and not problem.relative_residual(vectors[:, i].astype(REAL)) < 1e-8:
            raise ArithmeticError(f"eigenvalue {i} did not settle")
    return [(i, REAL(0) if i < zeros else problem.rayleigh_quotient(vectors[:, i].astype(REAL))) for i in indices]


def smallest_of_large(problem, k):
    """Eigenvectors of at least k eigenvalues, ascending."""
    area = float(problem.M.sum())
    start = np.cos(np.arange(problem.n))  # for the same bytes every time
    values, vectors = eigsh(problem.K, k=k + 4, M=problem.M_double / area, sigma=-1.0, tol=0, ncv=4 * k, v0=start)
    order = np.argsort(values)
    require_complete(problem, values[order] / area, k)
    return problem.sharpened(vectors[:, order], -1 / area)


def require_complete(problem, values, k):
    """Counts below the widest gap after the k-th value found."""
    gaps = np.diff(values)[k - 1:]
    last = k - 1 + int(np.argmax(gaps))
    sigma = (values[last] + values[last + 1]) / 2
    if problem.count_below(sigma) != last + 1:
        raise ArithmeticError(f"{problem.count_below(sigma)} eigenvalues below {sigma}, {last + 1} found")


def largest(problem):
    """μ_max. A Rayleigh quotient is never above it; the pivots show that it is not 1e-12 above the quotient."""
    if problem.n <= DENSE_UP_TO:
        values, vectors = dense_pairs(problem)
        value, x = values[-1], vectors[:, -1]
    else:
        value, x = lanczos_top(problem)
    solver = problem.factor(value * (1 + 1e-9))
    for _ in range(4):
        x = solver.solve(problem.M_double @ x)
        x /= np.linalg.norm(x)
    mu = problem.rayleigh_quotient(x.astype(REAL))
    if problem.count_below(float(mu * (1 + REAL(1e-12)))) != problem.n:
        raise ArithmeticError("an eigenvalue lies above the largest one found")
    return mu


def lanczos_top(problem):
    root = np.sqrt(problem.M.astype(float))
    B = diags(1 / root) @ problem.K @ diags(1 / root)
    for basis in (40, 120, 400):
        try:
            start = np.cos(np.arange(problem.n))
            values, vectors = eigsh(B, k=1, which="LA", ncv=min(basis, problem.n - 1), tol=1e-11, maxiter=3000, v0=start)
            return values[0], vectors[:, 0] / root
        except ArpackNoConvergence:
            continue
    raise ArithmeticError("ARPACK did not converge")
