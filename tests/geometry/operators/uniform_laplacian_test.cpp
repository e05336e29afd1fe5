#include "geometry/operators/uniform_laplacian.h"

#include <gtest/gtest.h>

#include "geometry/operator_test_meshes.h"

namespace meshfolio {
namespace {

using namespace testing;

TEST(UniformLaplacian, IsTheMeanOfTheRingMinusTheVertex) {
    const TriangleMesh mesh = irregular_plane(6);
    const MeshTopology topology = topology_of(mesh);
    const SparseMatrix L = uniform_laplacian(topology);
    const Positions Lx = L * mesh.X;
    for (int i = 0; i < mesh.vertex_count(); ++i) {
        Vector3 mean = Vector3::Zero();
        const int valence = topology.neighbours.size(i);
        for (const int* j = topology.neighbours.begin(i); j != topology.neighbours.end(i); ++j) mean += mesh.X.row(*j) / valence;
        EXPECT_LT((Lx.row(i) - (mean.transpose() - mesh.X.row(i))).norm(), 1e-15);
        EXPECT_EQ(L.coeff(i, i), -1);
        EXPECT_EQ(SparseMatrix(L.transpose()).col(i).nonZeros(), valence + 1);
    }
    EXPECT_LT((L * Vector::Ones(L.cols())).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(UniformLaplacian, IsSymmetricOnlyWhereValencesAgree) {
    const SparseMatrix regular = uniform_laplacian(topology_of(torus_mesh(6, 5, 2, 1)));
    EXPECT_EQ(DenseMatrix(regular - SparseMatrix(regular.transpose())).cwiseAbs().maxCoeff(), 0);
    const SparseMatrix open = uniform_laplacian(topology_of(grid_mesh(4, 4, 1, 1)));
    EXPECT_GT(DenseMatrix(open - SparseMatrix(open.transpose())).cwiseAbs().maxCoeff(), 0.01);
}

// In a regular hexagon of edge h the mean of |x_j|² is h², which is h²/4 times Δ(x² + y²) = 4; linear functions give 0.
TEST(UniformLaplacian, HexagonGivesAQuarterOfTheSquaredEdgeTimesTheLaplacian) {
    const double h = 0.3;
    const TriangleMesh mesh = scaled(fan(6), h);
    const SparseMatrix L = uniform_laplacian(topology_of(mesh));
    EXPECT_NEAR((L * Vector(mesh.X.rowwise().squaredNorm()))[0], h * h, 1e-16);
    EXPECT_LT((L * mesh.X).row(0).norm(), 1e-16);
    EXPECT_NEAR(mean_squared_ring_edge(mesh, topology_of(mesh))[0], h * h, 1e-16);
}

TEST(UniformLaplacian, UnreferencedVerticesHaveEmptyRows) {
    TriangleMesh mesh = fan(5);
    mesh.X.conservativeResize(8, 3);
    mesh.X.bottomRows(2).setConstant(4);
    const SparseMatrix L = uniform_laplacian(topology_of(mesh));
    ASSERT_EQ(L.rows(), 8);
    EXPECT_EQ((L * mesh.X).bottomRows(2).cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ(mean_squared_ring_edge(mesh, topology_of(mesh)).tail(2).maxCoeff(), 0);
}

TEST(MeanSquaredRingEdge, FollowsMotionScaleAndOrder) {
    const TriangleMesh mesh = irregular_sphere(2);
    const Vector h2 = mean_squared_ring_edge(mesh, topology_of(mesh));
    const TriangleMesh moved = rotated_and_moved(mesh), larger = scaled(mesh, 5);
    EXPECT_LT(largest_relative_difference(mean_squared_ring_edge(moved, topology_of(moved)), h2), 1e-13);
    EXPECT_LT(largest_relative_difference(mean_squared_ring_edge(larger, topology_of(larger)), 25 * h2), 1e-14);
    const Renamed shuffled = with_shuffled_vertices(mesh);
    const Vector renamed = mean_squared_ring_edge(shuffled.mesh, topology_of(shuffled.mesh));
    EXPECT_LT(largest_relative_difference(in_original_order(renamed, shuffled.name), h2), 1e-14);
}

}   // namespace
}   // namespace meshfolio
