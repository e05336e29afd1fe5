#include "mesh/samples/sample_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "mesh/io/mesh_files.h"
#include "mesh/mesh_topology.h"
#include "mesh/samples/euler_characteristic.h"
#include "mesh/triangle_measures.h"
#include "source_dir.h"

using namespace meshfolio;
using meshfolio::testing::euler_characteristic;

namespace {

double degrees(double angle) { return angle * 180 / std::numbers::pi; }

/// Tolerance of distances: all samples have a size of about 1.
constexpr double rounding = 1e-6;

/// The bundled meshes are made once for all tests.
const TriangleMesh& sample(const std::string& name) {
    static std::map<std::string, TriangleMesh> made;
    if (!made.contains(name)) made[name] = make_sample(name);
    return made.at(name);
}

/// Properties that a sample must have.
struct Expected {
    std::string name;
    bool closed;
    int euler;
    int fewest_vertices, most_vertices;
    double smallest_angle;   // [degrees]; 0: noise makes triangles of any shape but none without area
};

std::ostream& operator<<(std::ostream& out, const Expected& e) { return out << e.name; }

const std::vector<Expected> expectations{
    {"cube", true, 2, 602, 602, 44.99},       {"cube8", true, 2, 8, 8, 44.99},          {"sphere", true, 2, 2562, 2562, 53.9},
    {"ellipsoid", true, 2, 2562, 2562, 20},   {"torus", true, 0, 2048, 2048, 29},       {"bumpy_cube", true, 2, 4500, 5500, 20},
    {"plane", false, 1, 100, 100, 44.99},     {"saddle", false, 1, 1089, 1089, 30},     {"lily", false, 0, 800, 1500, 20},
    {"creature", true, 2, 5000, 6500, 20},    {"plane_noisy", false, 1, 1900, 2100, 0}, {"fandisk_like", true, 2, 6000, 7000, 20},
    {"fandisk_noisy", true, 2, 6000, 7000, 0}};

class EverySample : public ::testing::TestWithParam<Expected> {};

/// The total length and the number of edges with a dihedral angle (between normals) above 40°.
struct SharpEdges {
    int count = 0;
    double length = 0;
};

SharpEdges sharp_edges(const TriangleMesh& mesh) {
    const Positions N = face_normals(mesh);
    std::map<std::pair<int, int>, int> first_face;
    SharpEdges sharp;
    for (int t = 0; t < mesh.face_count(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.F(t, k), b = mesh.F(t, (k + 1) % 3);
            const auto [other, is_new] = first_face.try_emplace(std::minmax(a, b), t);
            if (is_new || N.row(t).dot(N.row(other->second)) > std::cos(40 * std::numbers::pi / 180)) continue;
            ++sharp.count;
            sharp.length += (mesh.X.row(a) - mesh.X.row(b)).norm();
        }
    }
    return sharp;
}

/// Returns the number of vertices higher along `direction` than all their neighbours, and beyond 0.9.
int summits(const TriangleMesh& mesh, const Vector3& direction) {
    const MeshTopology topology = topology_of(mesh);
    const Vector height = mesh.X * direction;
    int count = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        bool is_summit = height[v] > 0.9;
        for (const int* w = topology.neighbours.begin(v); w != topology.neighbours.end(v); ++w)
            is_summit = is_summit && height[*w] < height[v];
        count += is_summit;
    }
    return count;
}

}   // namespace

TEST(SubdivideMidpoint, EachTriangleBecomesFourOfTheSameSurface) {
    for (const std::string name : {"creature", "lily", "cube8"}) {
        const TriangleMesh& mesh = sample(name);
        const TriangleMesh fine = subdivide_midpoint(mesh);
        EXPECT_EQ(fine.face_count(), 4 * mesh.face_count());
        EXPECT_EQ(fine.vertex_count(), mesh.vertex_count() + static_cast<int>(topology_of(mesh).edges.size()));
        EXPECT_EQ(euler_characteristic(fine), euler_characteristic(mesh));
        EXPECT_EQ(topology_of(fine).boundary_edge_count(), 2 * topology_of(mesh).boundary_edge_count());
        EXPECT_EQ(fine.X.topRows(mesh.vertex_count()), mesh.X);
        EXPECT_NEAR(surface_area(fine), surface_area(mesh), 1e-12 * surface_area(mesh));
        EXPECT_NEAR(signed_volume(fine), signed_volume(mesh), 1e-12);
        EXPECT_NEAR(mean_edge_length(fine), mean_edge_length(mesh) / 2, 0.05 * mean_edge_length(mesh));
    }
}

TEST(Icosphere, CountsAndRadius) {
    for (int level = 0; level <= 4; ++level) {
        const TriangleMesh mesh = icosphere(level, 2.5);
        EXPECT_EQ(mesh.vertex_count(), 10 * (1 << 2 * level) + 2);
        EXPECT_EQ(mesh.face_count(), 20 * (1 << 2 * level));
        EXPECT_LT((mesh.X.rowwise().norm().array() - 2.5).abs().maxCoeff(), 1e-15 * 4);
        EXPECT_EQ(euler_characteristic(mesh), 2);
        EXPECT_GT(signed_volume(mesh), 0);
    }
    EXPECT_THROW(icosphere(-1), UsageError);
}

TEST(Icosphere, VolumeConvergesWithTheSquareOfTheEdge) {
    const double exact = 4 * std::numbers::pi / 3;
    const double coarse = exact - signed_volume(icosphere(3)), fine = exact - signed_volume(icosphere(4));
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.02);
}

TEST(EllipsoidMesh, LiesOnTheEllipsoid) {
    const Vector3 axes(3, 0.5, 1);
    const TriangleMesh mesh = ellipsoid_mesh(3, axes);
    EXPECT_LT(((mesh.X.array().rowwise() / axes.transpose().array()).square().rowwise().sum() - 1).abs().maxCoeff(), 1e-14);
    EXPECT_NEAR(signed_volume(mesh), axes.prod() * signed_volume(icosphere(3)), 1e-12);
}

TEST(TorusMesh, LiesOnTheTorusAndHasItsTopology) {
    const TriangleMesh mesh = torus_mesh(30, 17, 2, 0.7);
    EXPECT_EQ(mesh.vertex_count(), 30 * 17);
    for (const auto& p : mesh.X.rowwise()) EXPECT_NEAR(std::hypot(std::hypot(p.x(), p.y()) - 2, p.z()), 0.7, 1e-14);
    EXPECT_EQ(euler_characteristic(mesh), 0);
    EXPECT_EQ(topology_of(mesh).boundary_edge_count(), 0);
    // The polygons are inscribed in circles, so 2π²Rr² (Pappus) shrinks by the factors of both polygons.
    const auto factor = [](int n) { return std::sin(2 * std::numbers::pi / n) / (2 * std::numbers::pi / n); };
    EXPECT_NEAR(signed_volume(mesh) / (2 * std::pow(std::numbers::pi, 2) * 2 * 0.49), factor(30) * factor(17), 0.002);
    EXPECT_THROW(torus_mesh(2, 8, 1, 0.5), UsageError);
}

TEST(GridMesh, IsAGraphWithUpwardNormals) {
    const TriangleMesh mesh = grid_mesh(5, 4, 8, 3, [](double x, double y) { return x - 2 * y; });
    EXPECT_EQ(mesh.vertex_count(), 20);
    EXPECT_EQ(mesh.face_count(), 24);
    EXPECT_EQ(topology_of(mesh).boundary_edge_count(), 14);
    EXPECT_EQ(mesh.X.col(2), mesh.X.col(0) - 2 * mesh.X.col(1));
    EXPECT_EQ(bounding_box(mesh).low, Vector3(0, -6, -6).cwiseMax(Vector3(0, 0, -6)));
    EXPECT_EQ(bounding_box(mesh).high, Vector3(8, 3, 8));
    EXPECT_GT(face_normals(mesh).col(2).minCoeff(), 0);
    EXPECT_THROW(grid_mesh(1, 4, 1, 1), UsageError);
}

TEST(CubeMesh, HasTheCubesAreaVolumeAndCorners) {
    for (const int n : {1, 2, 3, 10}) {
        const TriangleMesh mesh = cube_mesh(n, 1.5);
        EXPECT_EQ(mesh.vertex_count(), 6 * n * n + 2);
        EXPECT_EQ(mesh.face_count(), 12 * n * n);
        EXPECT_NEAR(signed_volume(mesh), 27, 1e-12);
        EXPECT_NEAR(surface_area(mesh), 54, 1e-12);
        EXPECT_EQ(euler_characteristic(mesh), 2);
        EXPECT_LT((mesh.X.cwiseAbs().rowwise().maxCoeff().array() - 1.5).abs().maxCoeff(), 1e-15);
    }
    EXPECT_THROW(cube_mesh(0), UsageError);
}

TEST(CubeMesh, EvenDivisionsMakeAllCornersAlike) {
    const TriangleMesh mesh = cube_mesh(6);
    const MeshTopology topology = topology_of(mesh);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.X.row(v).cwiseAbs().minCoeff() == 0.5) {
            EXPECT_EQ(topology.neighbours.size(v), 6);
        }
    }
}

TEST_P(EverySample, IsOneManifoldOfTheRightKind) {
    const Expected& expected = GetParam();
    const TriangleMesh& mesh = sample(expected.name);
    const MeshTopology topology = topology_of(mesh);
    EXPECT_EQ(topology.nonmanifold_edge_count(), 0);
    EXPECT_EQ(topology.nonmanifold_vertex_count(), 0);
    EXPECT_EQ(topology.component_count, 1);
    EXPECT_EQ(topology.boundary_edge_count() == 0, expected.closed);
    EXPECT_EQ(euler_characteristic(mesh), expected.euler);
    EXPECT_GE(mesh.vertex_count(), expected.fewest_vertices);
    EXPECT_LE(mesh.vertex_count(), expected.most_vertices);
    EXPECT_EQ(without_unreferenced_vertices(mesh).mesh.vertex_count(), mesh.vertex_count());
}

TEST_P(EverySample, NeighbouringTrianglesAgreeInOrientationAndClosedOnesPointOutwards) {
    const TriangleMesh& mesh = sample(GetParam().name);
    std::map<std::pair<int, int>, int> uses;   // of each directed edge
    for (const auto& f : mesh.F.rowwise()) {
        for (int k = 0; k < 3; ++k) ++uses[{f[k], f[(k + 1) % 3]}];
    }
    for (const auto& [edge, count] : uses) EXPECT_EQ(count, 1) << edge.first << " " << edge.second;
    if (GetParam().closed) {
        EXPECT_GT(signed_volume(mesh), 0.1);
    }
}

TEST_P(EverySample, HasTrianglesOfGoodShape) {
    EXPECT_GT(degrees(corner_angles(sample(GetParam().name)).minCoeff()), GetParam().smallest_angle);
}

TEST_P(EverySample, HasSixDecimals) {
    const TriangleMesh& mesh = sample(GetParam().name);
    for (const double x : mesh.X.reshaped()) {
        EXPECT_EQ(x, std::round(x * 1e6) / 1e6);
        EXPECT_FALSE(x == 0 && std::signbit(x));
    }
    EXPECT_GE(bounding_box(mesh).extent().maxCoeff(), 1);
    EXPECT_LT(mesh.X.cwiseAbs().maxCoeff(), 10);
}

TEST_P(EverySample, SubdividesIntoFourTimesTheTriangles) {
    const TriangleMesh& mesh = sample(GetParam().name);
    const TriangleMesh fine = make_sample(GetParam().name, 1);
    EXPECT_EQ(fine.face_count(), 4 * mesh.face_count());
    EXPECT_EQ(euler_characteristic(fine), GetParam().euler);
    EXPECT_EQ(topology_of(fine).nonmanifold_edge_count(), 0);
    EXPECT_EQ(topology_of(fine).boundary_edge_count(), 2 * topology_of(mesh).boundary_edge_count());
}

TEST_P(EverySample, IsBundledByteForByte) {
    const std::string file = GetParam().name + ".obj";
    EXPECT_TRUE(read_file(std::filesystem::path(MESHFOLIO_SOURCE_DIR) / "data" / file) == encode_mesh(sample(GetParam().name), file))
        << "data/" << file << " is not what `meshfolio sample " << GetParam().name << "` makes";
}

INSTANTIATE_TEST_SUITE_P(Samples, EverySample, ::testing::ValuesIn(expectations), [](const auto& p) { return p.param.name; });

TEST(Samples, AreAllTested) {
    ASSERT_EQ(sample_list().size(), expectations.size());
    for (std::size_t i = 0; i < expectations.size(); ++i) EXPECT_EQ(sample_list()[i].name, expectations[i].name);
}

TEST(Samples, ClosedFormsHoldToTheLastDecimal) {
    for (const auto& p : sample("sphere").X.rowwise()) EXPECT_NEAR(p.norm(), 1, rounding);
    for (const auto& p : sample("torus").X.rowwise()) EXPECT_NEAR(std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()), 0.4, rounding);
    for (const auto& p : sample("saddle").X.rowwise()) EXPECT_NEAR(p.z(), (p.x() * p.x() - p.y() * p.y()) / 2, 2 * rounding);
    const Vector3 axes(1.7, 1.1, 0.6);
    for (const auto& p : sample("ellipsoid").X.rowwise()) {
        const Vector3 q = p.transpose().cwiseQuotient(axes);
        EXPECT_NEAR((q.norm() - 1) * q.norm() / q.cwiseQuotient(axes).norm(), 0, rounding);   // distance to first order
    }
}

TEST(Samples, VerticesStayOnTheSurfaceWhenItIsSubdivided) {
    // The rows of the bundled mesh come first; a vertex off the surface would have been moved onto it.
    for (const std::string name : {"sphere", "ellipsoid", "bumpy_cube", "creature", "saddle", "fandisk_like", "cube"}) {
        const TriangleMesh& mesh = sample(name);
        const TriangleMesh fine = make_sample(name, 1);
        EXPECT_LT((fine.X.topRows(mesh.vertex_count()) - mesh.X).cwiseAbs().maxCoeff(), 2 * rounding) << name;
    }
}

TEST(Samples, ThePlaneIsExactlyFlatAndRegular) {
    const TriangleMesh& plane = sample("plane");
    EXPECT_TRUE((plane.X.col(2).array() == 0).all());
    EXPECT_TRUE((plane.X.array() == plane.X.array().round()).all());
    EXPECT_EQ(plane.face_count(), 162);
}

TEST(Samples, TheBumpyCubeIsADie) {
    const TriangleMesh& die = sample("bumpy_cube");
    for (int axis = 0; axis < 3; ++axis) {
        const int front = summits(die, Vector3::Unit(axis)), back = summits(die, -Vector3::Unit(axis));
        EXPECT_EQ(front, (std::array{2, 3, 1})[static_cast<std::size_t>(axis)]);
        EXPECT_EQ(front + back, 7);
    }
}

TEST(Samples, TheLilyHasTwoBoundaryLoopsAndSixPetals) {
    const TriangleMesh& lily = sample("lily");
    EXPECT_EQ(boundary_loops(lily).size(), 2u);
    std::array<int, 6> tips{};
    for (const auto& p : lily.X.rowwise()) {
        if (std::hypot(p.x(), p.y()) < 1.19) continue;
        const double turn = std::atan2(p.y(), p.x()) * 3 / std::numbers::pi;
        EXPECT_NEAR(turn, std::round(turn), 1e-5);
        ++tips[static_cast<std::size_t>((std::lround(turn) + 6) % 6)];
    }
    for (const int count : tips) EXPECT_EQ(count, 1);
}

TEST(Samples, TheFandisksSharpEdgesAreEdgesOfTheMesh) {
    // If triangles cut a feature, finer triangles would show other sharp edges. Curved edges grow a little.
    const SharpEdges coarse = sharp_edges(sample("fandisk_like")), fine = sharp_edges(make_sample("fandisk_like", 1));
    EXPECT_GT(coarse.count, 400);
    EXPECT_NEAR(fine.length / coarse.length, 1, 0.01);
    EXPECT_NEAR(static_cast<double>(fine.count) / coarse.count, 2, 0.02);
}

TEST(Samples, NoiseHasTheStatedSizeAndNothingElseChanges) {
    const TriangleMesh &clean = sample("fandisk_like"), &noisy = sample("fandisk_noisy");
    EXPECT_EQ(noisy.F, clean.F);
    const Positions step = noisy.X - clean.X;
    const double sigma = 0.2 * mean_edge_length(clean), n = static_cast<double>(step.size());
    EXPECT_NEAR(step.norm() / std::sqrt(n) / sigma, 1, 4 / std::sqrt(2 * n));
    EXPECT_NEAR(step.sum() / n / sigma, 0, 4 / std::sqrt(n));
}

TEST(Samples, AnUnknownNameIsRefusedWithTheNearest) {
    try {
        make_sample("fandisk_nosy");
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("did you mean \"fandisk_noisy\""), std::string::npos) << error.what();
    }
    EXPECT_THROW(make_sample("sphere", -1), UsageError);
    EXPECT_THROW(make_sample("sphere", 7), UsageError);
}
