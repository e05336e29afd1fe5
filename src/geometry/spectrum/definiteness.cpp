#include "geometry/spectrum/definiteness.h"

#include <cmath>
#include <vector>

#include "geometry/linear/special_values.h"
#include "geometry/spectrum/eigenvalue_enclosure.h"

namespace meshfolio {

namespace {

constexpr double negligible = 1e-10;   // ν over max A_ii/M_i of the same component

/// What Gershgorin and the sum over triangles need of A = −C.
struct Rows {
    Vector excess;     // ≥ |min(Σ_j A_ij, 0)|, its rounding included
    Vector negative;   // Σ_j max(A_ij, 0) off the diagonal: weights below 0
    Vector around;     // Σ_j A_jj over the row's vertex and those it is joined to
    Vector entries;    // t_i
    Vector rounding;   // of Σ_j A_ij
};

Rows rows_of(const SparseMatrix& A) {
    const Eigen::Index n = A.rows();
    const Vector diagonal = A.diagonal();
    Rows rows{Vector(n), Vector(n), Vector(n), Vector(n), Vector(n)};
    for (Eigen::Index i = 0; i < n; ++i) {
        double sum = 0, magnitude = 0, negative = 0, around = 0, entries = 0;
        for (SparseMatrix::InnerIterator entry(A, i); entry; ++entry) {   // column i is row i
            sum += entry.value();
            magnitude += std::abs(entry.value());
            if (entry.row() != i) negative += std::max(entry.value(), 0.0);
            around += std::abs(diagonal[entry.row()]);
            ++entries;
        }
        rows.rounding[i] = epsilon * (entries + 2) * magnitude;
        rows.excess[i] = std::max(-sum, 0.0) + rows.rounding[i];
        rows.negative[i] = negative;
        rows.around[i] = around;
        rows.entries[i] = entries;
    }
    return rows;
}

/// Are all entries between vertices with mass and vertices without 0? Then leaving the latter out leaves a sum over triangles.
bool stands_alone(const LaplaceBeltrami& laplacian) {
    for (Eigen::Index j = 0; j < laplacian.C.cols(); ++j) {
        for (SparseMatrix::InnerIterator entry(laplacian.C, j); entry; ++entry)
            if (entry.value() != 0 && (laplacian.M[entry.row()] > 0) != (laplacian.M[j] > 0)) return false;
    }
    return true;
}

/// A with rows that sum to 0, without the stiffest vertex of each component.
struct Grounded {
    SparseMatrix A;
    Vector M;
};

Grounded grounded(const OperatorWithMass& whole) {
    const Components components = components_of(whole.A);
    std::vector<int> ground(static_cast<std::size_t>(components.count), -1), row(static_cast<std::size_t>(whole.size()));
    const Vector diagonal = whole.A.diagonal();
    for (int v = 0; v < whole.size(); ++v) {
        int& chosen = ground[static_cast<std::size_t>(components.label[static_cast<std::size_t>(v)])];
        if (chosen < 0 || diagonal[v] > diagonal[chosen]) chosen = v;
    }
    std::vector<int> kept;
    for (int v = 0; v < whole.size(); ++v) {
        const bool grounds = ground[static_cast<std::size_t>(components.label[static_cast<std::size_t>(v)])] == v;
        row[static_cast<std::size_t>(v)] = grounds ? -1 : static_cast<int>(kept.size());
        if (!grounds) kept.push_back(v);
    }
    const auto n = static_cast<Eigen::Index>(kept.size());
    Grounded result{SparseMatrix(n, n), whole.M(kept)};
    result.A.reserve(whole.A.nonZeros());
    for (Eigen::Index j = 0; j < n; ++j) {
        const int v = kept[static_cast<std::size_t>(j)];
        double others = 0;
        for (SparseMatrix::InnerIterator entry(whole.A, v); entry; ++entry) others += entry.row() != v ? entry.value() : 0;
        result.A.startVec(j);
        for (SparseMatrix::InnerIterator entry(whole.A, v); entry; ++entry) {
            const int i = row[static_cast<std::size_t>(entry.row())];
            if (i >= 0) result.A.insertBack(i, j) = i == j ? 0 - others : entry.value();
        }
    }
    result.A.finalize();
    return result;
}

/// Does Cholesky prove that matrix positive definite, in spite of the rounding of the factor and of the rows' sums?
bool grounded_is_definite(const OperatorWithMass& whole, const Rows& rows, int& factorisations) {
    const Grounded kept = grounded(whole);
    if (kept.M.size() == 0) return true;
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

/// The lowest mode, from the top of M⁻¹C.
Enclosure enclose_bottom(const OperatorWithMass& whole, double nu, double stiffest) {
    const OperatorWithMass negated{-whole.A, whole.M, whole.vertex, whole.all_vertices, whole.copies};
    const TopEstimate estimate = top_estimate(negated);
    constexpr double width = 1e-6;
    return enclose_largest(negated.A, negated.M, estimate.phi,
                           {.high = nu, .least_scale = 1e-9 * stiffest, .width = width, .missing = estimate.change});
}

/// max A_jj/M_j over the component of each row: a speck, whose eigenvalues are huge, excuses nothing on the rest.
Vector stiffest_of_components(const OperatorWithMass& whole) {
    const Components components = components_of(whole.A);
    const Vector stiffness = whole.A.diagonal().cwiseQuotient(whole.M);
    Vector largest = Vector::Zero(components.count), of_rows(whole.size());
    for (int i = 0; i < whole.size(); ++i) {
        double& size = largest[components.label[static_cast<std::size_t>(i)]];
        size = std::max(size, stiffness[i]);
    }
    for (int i = 0; i < whole.size(); ++i) of_rows[i] = largest[components.label[static_cast<std::size_t>(i)]];
    return of_rows;
}

}   // namespace

Definiteness definiteness(const LaplaceBeltrami& laplacian, Assembly assembly) {
    using Verdict = Definiteness::Verdict;
    using Evidence = Definiteness::Evidence;
    OperatorWithMass whole = operator_with_mass(laplacian);
    const double unit = std::exp2(std::round(std::log2(whole.M.mean())));   // a power of two: scaling by it is exact
    whole.M /= unit;
    const Rows rows = rows_of(whole.A);
    const Vector stiffest = stiffest_of_components(whole);

    Definiteness found;
    found.mu_high = rayleigh_quotient(whole.A, whole.M, Vector::Ones(whole.size())).high / unit;
    double nu = infinity;
    const auto at_least = [&](const Vector& of_rows, Evidence evidence) {
        const Vector bound = of_rows.cwiseQuotient(whole.M) * (1 + 4 * epsilon);
        if (bound.maxCoeff() < nu) found.evidence = evidence;
        nu = std::min(nu, bound.maxCoeff());
        found.mu_low = -nu / unit;
        if ((bound.array() <= negligible * stiffest.array()).all()) found.verdict = Verdict::semidefinite;
        return found.semidefinite();
    };
    if (at_least(2 * rows.negative + rows.excess, Evidence::weights)) return found;
    const bool triangles = assembly == Assembly::triangles && stands_alone(laplacian);
    if (triangles && at_least(epsilon * (rows.entries.array() + 8).matrix().cwiseProduct(rows.around) + rows.excess, Evidence::triangles))
        return found;
    if (grounded_is_definite(whole, rows, found.factorisations) && at_least(rows.excess, Evidence::factor)) return found;

    const Enclosure bottom = enclose_bottom(whole, nu, stiffest.maxCoeff());
    found.factorisations += bottom.factorisations;
    found.mu_low = -bottom.high / unit;
    found.mu_high = std::min(found.mu_high, -bottom.low / unit);
    whole.M *= unit;
    found.bottom = top_mode(whole, bottom.quotient / unit, bottom.y);
    // Where C is known to be a sum over triangles, what lies below 0 can only be its rounding.
    const bool proved = found.mu_high < 0 && !triangles, nothing_below = bottom.high <= negligible * stiffest.minCoeff();
    if (proved || nothing_below) found.verdict = proved ? Verdict::indefinite : Verdict::semidefinite;
    found.evidence = proved ? Evidence::vector : nothing_below ? Evidence::factor : Evidence::none;
    return found;
}

}   // namespace meshfolio
