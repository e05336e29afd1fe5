#include "geometry/measures/operator_scores.h"

#include <Eigen/Geometry>

#include "base/at.h"
#include "base/errors.h"
#include "geometry/linear/special_values.h"
#include "geometry/measures/mesh_laws.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "geometry/spectrum/stability.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

bool on_boundary(const MeshTopology& topology, int v) { return topology.on_boundary[at(v)] != 0; }

int vertices_without_mass(const Vector& M, const MeshTopology& topology) {
    int count = 0;
    for (int v = 0; v < M.size(); ++v) count += topology.vertex_faces.size(v) > 0 && !(M[v] > 0) ? 1 : 0;
    return count;
}

void score_weights(OperatorScores& scores, const SparseMatrix& C, const MeshTopology& topology) {
    double largest = 0;
    scores.smallest_weight = infinity;
    const auto for_each_weight = [&](auto visit) {
        for (int j = 0; j < C.cols(); ++j) {
            for (SparseMatrix::InnerIterator entry(C, j); entry; ++entry)
                if (entry.row() < j) visit(static_cast<int>(entry.row()), j, entry.value());
        }
    };
    for_each_weight([&](int, int, double weight) {
        ++scores.weights;
        largest = std::max(largest, std::abs(weight));
        scores.smallest_weight = std::min(scores.smallest_weight, weight);
    });
    for_each_weight([&](int i, int j, double weight) {
        if (weight >= -1e-9 * largest) return;
        ++(on_boundary(topology, i) && on_boundary(topology, j) ? scores.negative_boundary : scores.negative_inside);
    });
}

/// True if all triangles around an interior vertex are parallel to one plane.
bool is_flat(const TriangleMesh& mesh, const MeshTopology& topology, int v) {
    const Incidence& around = topology.vertex_faces;
    if (around.size(v) == 0 || on_boundary(topology, v) || topology.nonmanifold[at(v)] != 0) return false;
    const auto normal = [&](int t) -> Vector3 {
        const Vector3 a = mesh.X.row(mesh.F(t, 0)), b = mesh.X.row(mesh.F(t, 1)), c = mesh.X.row(mesh.F(t, 2));
        return (b - a).cross(c - a).stableNormalized();
    };
    const Vector3 first = normal(*around.begin(v));
    return std::all_of(around.begin(v), around.end(v), [&](int t) { return (normal(t) - first).norm() < 1e-9; });
}

}   // namespace

OperatorScores operator_scores(const LaplaceBeltrami& laplacian, const MeshTopology& topology, Assembly assembly) {
    OperatorScores scores;
    scores.asymmetry = asymmetry(laplacian.C);
    scores.negative = negative_eigenvalues(laplacian.C);
    score_weights(scores, laplacian.C, topology);
    scores.without_mass = vertices_without_mass(laplacian.M, topology);
    scores.critical = scores.lowest = undefined;
    if (scores.without_mass > 0) return scores;
    const Definiteness found = definiteness(laplacian, assembly);
    scores.critical = largest_stable_step(largest_eigenvalue(laplacian));
    scores.verdict = found.verdict;
    scores.lowest = (found.indefinite() ? found.mu_high : found.mu_low) * scores.critical / 2;
    return scores;
}

Vector smallest_nonzero_eigenvalues(const LaplaceBeltrami& laplacian, const MeshTopology& topology, int count) try {
    if (vertices_without_mass(laplacian.M, topology) > 0) return {};
    // Clamping may add zeros to the one of each component, so more pairs are requested until enough others remain.
    for (int asked = count + topology.component_count;; asked *= 2) {
        const Spectrum spectrum = smallest_eigenpairs(laplacian, asked, {.dense_below = 200});
        const Vector& mu = spectrum.eigenvalues;
        const auto zeros = std::count(mu.begin(), mu.end(), 0.0);
        if (mu.size() - zeros >= count || mu.size() < asked) return mu.segment(zeros, std::min<Eigen::Index>(count, mu.size() - zeros));
    }
} catch (const SolverError&) {   // −C is indefinite, which other scores show, or too badly conditioned
    return {};
}

double largest_relative_change(const Vector& eigenvalues, const Vector& reference) {
    const Eigen::Index common = std::min(eigenvalues.size(), reference.size());
    if (common == 0) return undefined;
    return (eigenvalues.head(common).array() / reference.head(common).array() - 1).abs().maxCoeff();
}

double linear_precision(const LaplaceBeltrami& laplacian, const TriangleMesh& mesh, const MeshTopology& topology) {
    const Box box = bounding_box(mesh);
    const Positions CX = laplacian.C * (mesh.X.rowwise() - box.centre().transpose());
    const Vector M = summed_at_first(laplacian.copies, laplacian.M);
    double largest = undefined;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (!is_flat(mesh, topology, v) || !(M[v] > 0)) continue;
        largest = std::max(std::isnan(largest) ? 0 : largest, 0.5 * CX.row(v).norm() / M[v]);
    }
    return largest;
}

}   // namespace meshfolio
