#include "geometry/measures/operator_scores.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/dense_pairs.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/stability.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

SparseMatrix sparse(const DenseMatrix& dense) { return dense.sparseView(); }

}   // namespace

// Every number against a dense computation of its definition.
TEST(OperatorScores, AgreeWithDenseMatrices) {
    const TriangleMesh mesh = side_by_side(irregular_sphere(1), moved_by(irregular_plane(6), {4, 0, 0}));
    const MeshTopology topology = topology_of(mesh);
    for (const OperatorEntry& entry : operator_list()) {
        const LaplaceBeltrami laplacian = laplace_operator(mesh, entry.kind);
        const OperatorScores scores = operator_scores(laplacian, topology);
        const DenseMatrix C(laplacian.C);
        const double largest = C.cwiseAbs().maxCoeff();
        const Vector eigenvalues = dense_pairs(-C).eigenvalues;
        EXPECT_EQ(scores.negative.below, (eigenvalues.array() < -1e-9 * largest).count()) << entry.name;
        EXPECT_LT(scores.asymmetry, 1e-15) << entry.name;
        double smallest = INFINITY;
        int negative = 0, at_boundary = 0, weights = 0;
        for (int j = 0; j < C.cols(); ++j) {
            for (int i = 0; i < j; ++i) {
                if (laplacian.C.coeff(i, j) == 0) continue;
                ++weights;
                smallest = std::min(smallest, C(i, j));
                const auto edge_of_sheet = [&](int v) { return topology.on_boundary[static_cast<std::size_t>(v)] != 0; };
                negative += C(i, j) < -1e-8 ? 1 : 0;
                at_boundary += C(i, j) < -1e-8 && edge_of_sheet(i) && edge_of_sheet(j) ? 1 : 0;
            }
        }
        EXPECT_EQ(scores.negative_inside + scores.negative_boundary, negative) << entry.name;
        EXPECT_EQ(scores.negative_boundary, at_boundary) << entry.name;
        EXPECT_GE(scores.weights, weights) << entry.name << ": entries that are 0 count as well";
        EXPECT_TRUE(negative == 0 || scores.smallest_weight == smallest) << entry.name;
        EXPECT_EQ(scores.without_mass, 0) << entry.name;
        EXPECT_EQ(scores.critical, largest_stable_step(largest_eigenvalue(laplacian))) << entry.name;
    }
}

TEST(OperatorScores, DetectBrokenOperators) {
    const TriangleMesh mesh = irregular_sphere(1);
    const MeshTopology topology = topology_of(mesh);
    const LaplaceBeltrami good = laplace_beltrami(mesh);
    const DenseMatrix C(good.C);

    DenseMatrix lopsided = C;
    lopsided(0, 1) += 1;
    EXPECT_GT(operator_scores({sparse(lopsided), good.M}, topology).asymmetry, 1e-3);
    EXPECT_EQ(operator_scores({sparse(-C), good.M}, topology).negative.below, mesh.vertex_count() - 1) << "the sign of C";
    Vector M = good.M;
    M[3] = -1;
    const OperatorScores scores = operator_scores({good.C, M}, topology);
    EXPECT_EQ(scores.without_mass, 1);
    EXPECT_TRUE(std::isnan(scores.critical));
    EXPECT_EQ(smallest_nonzero_eigenvalues({good.C, M}, topology, 5).size(), 0);
}

TEST(OperatorScores, BoundaryWeightsAreCountedApart) {
    TriangleMesh cap = triangle({-1, 0, 0}, {1, 0, 0}, {0, 0.2, 0});
    const OperatorScores scores = operator_scores(laplace_beltrami(cap), topology_of(cap));
    EXPECT_EQ(scores.negative_boundary, 1);
    EXPECT_EQ(scores.negative_inside, 0);
    EXPECT_NEAR(scores.smallest_weight, 0.5 * std::cos(2 * std::atan(5.0)) / std::sin(2 * std::atan(5.0)), 1e-14);
}

TEST(OperatorScores, EigenvaluesOfTheSphere) {
    const TriangleMesh mesh = icosphere(3);
    const Vector mu = smallest_nonzero_eigenvalues(laplace_operator(mesh, OperatorKind::cotan), topology_of(mesh), 8);
    Vector truth(8);
    truth << 2, 2, 2, 6, 6, 6, 6, 6;
    EXPECT_LT(largest_relative_change(mu, truth), 0.01);
    EXPECT_NEAR(largest_relative_change(2 * mu, mu), 1, 1e-12);
    EXPECT_TRUE(std::isnan(largest_relative_change(Vector(), mu)));
}

TEST(OperatorScores, LinearPrecisionIsThatOfFlatVertices) {
    TriangleMesh flat = irregular_plane(12, 0.25);
    flat.X.col(0) *= 3;
    const MeshTopology topology = topology_of(flat);
    const auto precision = [&](OperatorKind kind) { return linear_precision(laplace_operator(flat, kind), flat, topology); };
    EXPECT_LT(precision(OperatorKind::cotan), 1e-10);
    EXPECT_LT(precision(OperatorKind::idt), 1e-9);
    EXPECT_GT(precision(OperatorKind::clamped), 0.1);
    EXPECT_GT(precision(OperatorKind::edge_normalised), 0.1);
    const TriangleMesh ball = irregular_sphere(2);
    EXPECT_TRUE(std::isnan(linear_precision(laplace_beltrami(ball), ball, topology_of(ball)))) << "nothing is flat";
    EXPECT_NEAR(linear_precision(laplace_operator(scaled(flat, 10), OperatorKind::clamped), scaled(flat, 10), topology),
                precision(OperatorKind::clamped) / 10, 1e-10);
}

// The coordinates are exact in both places: the difference is the rounding of the operator.
TEST(OperatorScores, LinearPrecisionDoesNotDependOnThePlace) {
    TriangleMesh here = irregular_plane(12);
    here.X = ((here.X * 1048576).array().round() / 1048576).eval();
    const TriangleMesh far = moved_by(here, {16777216, -8388608, 16777216});
    const MeshTopology topology = topology_of(here);
    const double score = linear_precision(laplace_beltrami(here), here, topology);
    EXPECT_LT(score, 1e-10);
    EXPECT_NEAR(linear_precision(laplace_beltrami(far), far, topology), score, score);
}
