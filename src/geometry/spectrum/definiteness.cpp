#include "geometry/spectrum/definiteness.h"

#include "base/at.h"
#include "geometry/linear/special_values.h"
#include "geometry/spectrum/eigenvalue_enclosure.h"
#include "geometry/spectrum/top_lanczos.h"

namespace meshfolio {
namespace {

constexpr double negligible = 1e-10;   // ν over max A_ii/M_i of the same component

/// The row sums of A = −C for Gershgorin and for the sum over triangles.
struct Rows {
    Vector excess;     // ≥ |min(Σ_j A_ij, 0)|, its rounding included
    Vector negative;   // Σ_j max(A_ij, 0) off the diagonal: weights below 0
    Vector around;     // Σ_j A_jj over the vertex of the row and its neighbours
    Vector entries;    // t_i
    Vector rounding;   // of Σ_j A_ij

    explicit Rows(const SparseMatrix& A) {
        for (Vector* values : {&excess, &negative, &around, &entries, &rounding}) values->setZero(A.rows());
        const Vector diagonal = A.diagonal();
        for (Eigen::Index i = 0; i < A.rows(); ++i) {
            double sum = 0, magnitude = 0;
            for (SparseMatrix::InnerIterator entry(A, i); entry; ++entry) {   // column i is row i
                sum += entry.value();
                magnitude += std::abs(entry.value());
                if (entry.row() != i) negative[i] += std::max(entry.value(), 0.0);
                around[i] += std::abs(diagonal[entry.row()]);
                ++entries[i];
            }
            rounding[i] = epsilon * (entries[i] + 2) * magnitude;
            excess[i] = std::max(-sum, 0.0) + rounding[i];
        }
    }
};

/// True if no entry joins a vertex with mass and one without: C restricted to the former is a sum over triangles, too.
bool stands_alone(const LaplaceBeltrami& laplacian) {
    for (Eigen::Index j = 0; j < laplacian.C.cols(); ++j) {
        for (SparseMatrix::InnerIterator entry(laplacian.C, j); entry; ++entry)
            if (entry.value() != 0 && (laplacian.M[entry.row()] > 0) != (laplacian.M[j] > 0)) return false;
    }
    return true;
}

/// Returns the operator without the stiffest vertex of each component, its diagonal computed such that rows of the whole sum to 0.
OperatorWithMass grounded(const OperatorWithMass& whole) {
    const Components components = components_of(whole.A);
    std::vector<int> ground(at(components.count), -1), row(at(whole.size()), -1);
    const Vector diagonal = whole.A.diagonal();
    for (int v = 0; v < whole.size(); ++v) {
        int& chosen = ground[at(components.label[at(v)])];
        if (chosen < 0 || diagonal[v] > diagonal[chosen]) chosen = v;
    }
    OperatorWithMass kept;
    for (int v = 0; v < whole.size(); ++v) {
        if (ground[at(components.label[at(v)])] == v) continue;
        row[at(v)] = kept.size();
        kept.vertex.push_back(v);
    }
    kept.M = whole.M(kept.vertex);
    kept.A.resize(kept.size(), kept.size());
    kept.A.reserve(whole.A.nonZeros());
    for (int j = 0; j < kept.size(); ++j) {
        const int v = kept.vertex[at(j)];
        double others = 0;
        for (SparseMatrix::InnerIterator entry(whole.A, v); entry; ++entry) others += entry.row() != v ? entry.value() : 0;
        kept.A.startVec(j);
        for (SparseMatrix::InnerIterator entry(whole.A, v); entry; ++entry) {
            const int i = row[std::size_t(entry.row())];
            if (i >= 0) kept.A.insertBack(i, j) = i == j ? 0 - others : entry.value();
        }
    }
    kept.A.finalize();
    return kept;
}

/// True if Cholesky proves the grounded matrix positive definite in spite of the rounding of the factor and of the row sums.
bool grounded_is_definite(const OperatorWithMass& whole, const Rows& rows, int& factorisations) {
    const OperatorWithMass kept = grounded(whole);
    if (kept.size() == 0) return true;
    const SparseMatrix S = -kept.A;
    const double sums = rows.rounding.cwiseQuotient(whole.M).maxCoeff();
    constexpr double usual = 400;   // roundings: measured 60 to 200 on surfaces of 1,000 to 6,000 vertices
    double delta = sums + epsilon * usual * whole.A.diagonal().cwiseQuotient(whole.M).maxCoeff();
    for (int repeat = 0; repeat < 3; ++repeat) {
        ++factorisations;
        const std::optional<SparseFactor> factor = factor_at(S, kept.M, -delta);
        if (!factor) return false;
        const double needed = (sums + rounding_of(*factor, kept.M, delta)) * (1 + 4 * epsilon);
        if (delta >= needed) return true;
        delta = 1.01 * needed;
    }
    return false;
}

/// Returns max A_jj/M_j over the component of each row: a speck, with its huge eigenvalues, excuses nothing elsewhere.
Vector stiffest_of_components(const OperatorWithMass& whole) {
    const Components components = components_of(whole.A);
    const Vector stiffness = whole.A.diagonal().cwiseQuotient(whole.M);
    Vector largest = Vector::Zero(components.count), of_rows(whole.size());
    for (int i = 0; i < whole.size(); ++i) {
        double& size = largest[components.label[at(i)]];
        size = std::max(size, stiffness[i]);
    }
    for (int i = 0; i < whole.size(); ++i) of_rows[i] = largest[components.label[at(i)]];
    return of_rows;
}

}   // namespace

Definiteness definiteness(const LaplaceBeltrami& laplacian, Assembly assembly) {
    using Verdict = Definiteness::Verdict;
    OperatorWithMass whole = operator_with_mass(laplacian);
    const double unit = std::exp2(std::round(std::log2(whole.M.mean())));   // a power of two: scaling by it is exact
    whole.M /= unit;
    const Rows rows(whole.A);
    const Vector stiffest = stiffest_of_components(whole);

    Definiteness found;
    found.mu_high = rayleigh_quotient(whole.A, whole.M, Vector::Ones(whole.size())).high / unit;
    double nu = infinity;
    const auto at_least = [&](const Vector& of_rows) {
        const Vector bound = of_rows.cwiseQuotient(whole.M) * (1 + 4 * epsilon);
        nu = std::min(nu, bound.maxCoeff());
        found.mu_low = -nu / unit;
        if ((bound.array() <= negligible * stiffest.array()).all()) found.verdict = Verdict::semidefinite;
        return found.semidefinite();
    };
    if (at_least(2 * rows.negative + rows.excess)) return found;
    const bool triangles = assembly == Assembly::triangles && stands_alone(laplacian);
    if (triangles && at_least(epsilon * (rows.entries.array() + 8).matrix().cwiseProduct(rows.around) + rows.excess)) return found;
    if (grounded_is_definite(whole, rows, found.factorisations) && at_least(rows.excess)) return found;

    const OperatorWithMass negated{-whole.A, whole.M, whole.vertex, whole.all_vertices, whole.copies};   // its top is the lowest mode
    const TopEstimate estimate = top_estimate(negated);
    const EnclosureOptions options{.high = nu, .least_scale = 1e-9 * stiffest.maxCoeff(), .width = 1e-6, .missing = estimate.change};
    const Enclosure bottom = enclose_largest(negated.A, negated.M, estimate.phi, options);
    found.factorisations += bottom.factorisations;
    found.mu_low = -bottom.high / unit;
    found.mu_high = std::min(found.mu_high, -bottom.low / unit);
    whole.M *= unit;
    found.bottom = top_mode(whole, bottom.quotient / unit, bottom.y);
    // If C is known to be a sum over triangles, eigenvalues below 0 can only be its rounding.
    const bool proved = found.mu_high < 0 && !triangles, nothing_below = bottom.high <= negligible * stiffest.minCoeff();
    if (proved || nothing_below) found.verdict = proved ? Verdict::indefinite : Verdict::semidefinite;
    return found;
}

}   // namespace meshfolio
