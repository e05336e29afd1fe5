#include "geometry/operators/mesh_operators.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/global_control.h>

#include <cstring>

#include "base/errors.h"
#include "base/parallel.h"
#include "geometry/curvature/curvature.h"
#include "geometry/operator_test_meshes.h"

namespace meshfolio {
namespace {

using namespace testing;

/// A triangle mesh with boundary, vertices of many triangles and of none, an edge of three triangles, and one without area.
TriangleMesh crowded_mesh() {
    const TriangleMesh disk = fan(200, 0.2);
    TriangleMesh mesh;
    mesh.X.resize(204, 3);
    mesh.X << disk.X, 2, 0, 0, 2, 1, 1, 1e50, 0, 0;
    mesh.F.resize(203, 3);
    mesh.F << disk.F, 0, 1, 201, 1, 0, 202, 0, 201, 201 - 1;
    mesh.X.row(200) = 0.5 * (mesh.X.row(0) + mesh.X.row(201));
    return mesh;
}

/// Vertex 0 has as many neighbours as triangles, but one of them in three triangles and one in one.
TriangleMesh three_triangles_at_an_edge() {
    TriangleMesh mesh{Positions(4, 3), Faces(3, 3)};
    mesh.X << 0, 0, 0, 1, 0, 0.2, 0, 1, 0.3, 0.7, 0.6, 0.5;
    mesh.F << 0, 1, 3, 0, 2, 3, 0, 3, 1;
    return mesh;
}

/// Apart from each other: (a, b, c), (b, c, a), (c, a, b), whose edges are equal, many of them to the last bit.
TriangleMesh equilateral_triangles(int count) {
    TriangleMesh mesh{Positions(3 * count, 3), Faces(count, 3)};
    NormalNumbers random(5);
    for (int t = 0; t < count; ++t) {
        const double a = random.uniform(), b = random.uniform(), c = random.uniform();
        mesh.X.middleRows(3 * t, 3) << a, b, c, b, c, a, c, a, b;
        mesh.F.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
    }
    return mesh;
}

/// Apart from each other, with two sides longer than the third and many times equal to the last bit; their common end is stored as every
/// corner.
TriangleMesh isosceles_triangles(int count) {
    TriangleMesh mesh{Positions(3 * count, 3), Faces(count, 3)};
    NormalNumbers random(6);
    for (int t = 0; t < count; ++t) {
        const double a = 1 + random.uniform(), b = 1 + random.uniform(), c = 1 + random.uniform();
        mesh.X.middleRows(3 * t, 3) << 0, 0, 0, a, b, c, b, c, a;
        for (const int k : {0, 1, 2}) mesh.F(t, (k + t) % 3) = 3 * t + k;
    }
    return mesh;
}

std::vector<TriangleMesh> many_meshes() {
    return {irregular_sphere(3),
            with_shuffled_vertices(irregular_sphere(4)).mesh,
            irregular_plane(12),
            torus_mesh(20, 9, 2, 0.7),
            equilateral_triangles(100),
            isosceles_triangles(100),
            cube_mesh(4),
            grid_mesh(9, 9, 1, 1),
            crowded_mesh(),
            three_triangles_at_an_edge(),
            scaled(irregular_sphere(2), 1e-30),
            triangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1})};
}

bool same_bytes(const Vector& a, const Vector& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

bool same_bytes(const SparseMatrix& A, const SparseMatrix& B) {
    const auto bytes = [&](auto* a, auto* b, Eigen::Index n) { return std::memcmp(a, b, static_cast<std::size_t>(n) * sizeof(*a)) == 0; };
    return A.nonZeros() == B.nonZeros() && bytes(A.outerIndexPtr(), B.outerIndexPtr(), A.cols() + 1) &&
           bytes(A.innerIndexPtr(), B.innerIndexPtr(), A.nonZeros()) && bytes(A.valuePtr(), B.valuePtr(), A.nonZeros());
}

/// Every number of the operators, to be compared.
void expect_same_bytes(const MeshOperators& a, const MeshOperators& b) {
    EXPECT_TRUE(same_bytes(a.C, b.C));
    for (Vector MeshOperators::*values : {&MeshOperators::barycentric, &MeshOperators::voronoi, &MeshOperators::mixed,
                                          &MeshOperators::angle_deficit, &MeshOperators::H, &MeshOperators::K}) {
        EXPECT_TRUE(same_bytes(a.*values, b.*values));
    }
}

/// Largest difference, NaN being equal to NaN.
double difference(const Vector& a, const Vector& b) {
    double largest = 0;
    for (Eigen::Index v = 0; v < a.size(); ++v) {
        EXPECT_EQ(std::isnan(a[v]), std::isnan(b[v])) << v;
        if (!std::isnan(a[v])) largest = std::max(largest, std::abs(a[v] - b[v]));
    }
    return largest;
}

double size_of(const Vector& a) { return a.array().isNaN().select(0, a.array().abs()).maxCoeff(); }

// One by one the matrix is assembled from its edges, and the areas are summed over the triangles: the same terms in the same order.
TEST(MeshOperators, AreThoseComputedOneByOne) {
    int number = 0;
    for (const TriangleMesh& mesh : many_meshes()) {
        SCOPED_TRACE(number++);
        const MeshTopology topology = topology_of(mesh);
        for (const AreaForm form : {AreaForm::barycentric, AreaForm::voronoi, AreaForm::mixed}) {
            const MeshOperators all = mesh_operators(mesh, topology, form);
            const LaplaceBeltrami laplacian = laplace_beltrami(mesh, form);
            EXPECT_TRUE(same_bytes(all.C, laplacian.C));
            EXPECT_TRUE(same_bytes(form == AreaForm::barycentric ? all.barycentric
                                   : form == AreaForm::voronoi   ? all.voronoi
                                                                 : all.mixed,
                                   laplacian.M));
            const Vector H = cotangent_mean_curvature(mesh, topology, laplacian), K = gaussian_curvature(mesh, topology, laplacian.M);
            EXPECT_LE(difference(all.H, H), 1e-15 * size_of(H));
            EXPECT_LE(difference(all.K, K), 1e-15 * size_of(K));
            EXPECT_TRUE(same_bytes(all.angle_deficit, angle_deficit(mesh, topology)));
        }
    }
}

TEST(MeshOperators, AngleDeficitIsThatOfTheCornerAngles) {
    for (const TriangleMesh& mesh : many_meshes()) {
        const MeshTopology topology = topology_of(mesh);
        Vector deficit = angle_deficit(mesh, topology);
        CornerValues angles = corner_angles(mesh);
        for (int t = 0; t < mesh.face_count(); ++t) {   // with a side of no length: right angles at its ends, or three alike
            if (angles.row(t).sum() > 0) continue;
            for (int k = 0; k < 3; ++k) {
                const bool alone = mesh.X.row(mesh.F(t, (k + 1) % 3)) == mesh.X.row(mesh.F(t, (k + 2) % 3));
                const bool one_point = alone && mesh.X.row(mesh.F(t, k)) == mesh.X.row(mesh.F(t, (k + 1) % 3));
                angles(t, k) = one_point ? pi / 3 : alone ? 0 : pi / 2;
            }
        }
        for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
            for (int k = 0; k < 3; ++k) deficit[mesh.F(t, k)] += angles(t, k);
        }
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            const double flat = topology.vertex_faces.size(v) == 0 ? 0 : topology.on_boundary[static_cast<std::size_t>(v)] ? pi : 2 * pi;
            EXPECT_NEAR(deficit[v], flat, 1e-13) << v;
        }
    }
}

// Equal edges are where the three corners of a triangle could disagree on which is the longest.
TEST(MeshOperators, SymmetricToTheLastBit) {
    for (const TriangleMesh& mesh :
         {equilateral_triangles(200), isosceles_triangles(200), grid_mesh(9, 9, 1, 1), rotated_and_moved(grid_mesh(9, 9, 1, 1)),
          rotated_and_moved(icosphere(3)), with_shuffled_vertices(rotated_and_moved(cube_mesh(5))).mesh}) {
        const SparseMatrix C = mesh_operators(mesh, topology_of(mesh)).C;
        EXPECT_TRUE(same_bytes(C, SparseMatrix(C.transpose())));
    }
}

TEST(MeshOperators, SameBytesForAnyNumberOfThreads) {
    const TriangleMesh mesh = with_shuffled_vertices(irregular_sphere(6)).mesh;
    const MeshTopology topology = topology_of(mesh);
    ASSERT_GT(block_count(mesh.vertex_count()), 2);
    const auto with_threads = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return mesh_operators(mesh, topology);
    };
    const MeshOperators one = with_threads(1);
    for (const std::size_t threads : {2, 3}) {
        expect_same_bytes(one, with_threads(threads));
    }
}

/// With one instruction set only, where the processor has it.
class MeshOperatorsInstructionSet : public ::testing::TestWithParam<std::pair<const char*, std::int64_t>> {
protected:
    void SetUp() override {
        if ((hwy::SupportedTargets() & GetParam().second) == 0) GTEST_SKIP() << "this processor has no " << GetParam().first;
    }
    void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
};
INSTANTIATE_TEST_SUITE_P(All, MeshOperatorsInstructionSet,
                         ::testing::Values(std::pair("SSSE3", HWY_SSSE3), std::pair("SSE4", HWY_SSE4), std::pair("AVX2", HWY_AVX2),
                                           std::pair("AVX512", HWY_AVX3)),
                         [](const auto& set) { return std::string(set.param.first); });

TEST_P(MeshOperatorsInstructionSet, SameBytesAsWithoutVectors) {
    for (const TriangleMesh& mesh : many_meshes()) {
        const MeshTopology topology = topology_of(mesh);
        hwy::SetSupportedTargetsForTest(HWY_EMU128);
        const MeshOperators least = mesh_operators(mesh, topology);
        hwy::SetSupportedTargetsForTest(GetParam().second);
        expect_same_bytes(mesh_operators(mesh, topology), least);
    }
}

TEST(MeshOperators, NeedNoEdgesButTheRightTopology) {
    const TriangleMesh mesh = icosphere(1);
    EXPECT_THROW(mesh_operators(mesh, topology_of(icosphere(2))), MeshError);
    EXPECT_TRUE(same_bytes(mesh_operators(mesh, topology_without_edges(mesh)).C, laplace_beltrami(mesh).C));
    MeshTopology wrong = topology_of(mesh);
    for (std::size_t v = 4; v < wrong.neighbours.start.size(); ++v) --wrong.neighbours.start[v];
    EXPECT_THROW(mesh_operators(mesh, wrong), MeshError);
    const TriangleMesh turned{triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).X, Faces{{0, 2, 1}}};
    MeshTopology one_neighbour = topology_of(turned);
    for (std::size_t v = 1; v < one_neighbour.neighbours.start.size(); ++v) --one_neighbour.neighbours.start[v];
    EXPECT_THROW(mesh_operators(turned, one_neighbour), MeshError);
}

}   // namespace
}   // namespace meshfolio
