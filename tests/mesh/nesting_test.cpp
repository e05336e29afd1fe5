// The orientation of closed shells and the volume of surfaces, compared with volumes known by construction and winding numbers by solid
// angles.
#include "mesh/nesting.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "mesh/mesh_checks.h"
#include "mesh/orientation.h"
#include "mesh/small_meshes.h"
#include "mesh/triangle_measures.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

PreparedMesh prepared_solid(const TriangleMesh& mesh) { return prepare_mesh({mesh, "m.obj", {}, {}}); }

TriangleMesh turned(TriangleMesh mesh) {
    mesh.F.col(1).swap(mesh.F.col(2));
    return mesh;
}

/// Returns a cube of edge `size` about `centre`.
TriangleMesh cube(double size, const Vector3& centre = Vector3::Zero()) {
    TriangleMesh mesh = unit_cube();
    mesh.X = moved(mesh.X, centre - Vector3::Constant(size / 2), size);
    return mesh;
}

/// Returns a box of a × b × c with its lowest corner at `low`.
TriangleMesh box_of_solid(double a, double b, double c, const Vector3& low = Vector3::Zero()) {
    TriangleMesh mesh = unit_cube();
    mesh.X = (mesh.X * Vector3(a, b, c).asDiagonal()).rowwise() + low.transpose();
    return mesh;
}

TriangleMesh all_of(const std::vector<TriangleMesh>& meshes) {
    TriangleMesh all = meshes.front();
    for (std::size_t i = 1; i < meshes.size(); ++i) all = joined(all, meshes[i]);
    return all;
}

/// Returns the mesh with one vertex for equal positions.
TriangleMesh welded(TriangleMesh mesh) {
    for (int corner = 0; corner < mesh.F.size(); ++corner) {
        int& v = mesh.F.data()[corner];
        for (int u = 0; u < v; ++u)
            if (mesh.X.row(u) == mesh.X.row(v)) v = u;
    }
    return mesh;
}

/// Returns the mesh with vertices, faces and corners in another order, moved rigidly.
TriangleMesh shuffled(const TriangleMesh& mesh, std::mt19937& random, bool move) {
    std::vector<int> vertex(static_cast<std::size_t>(mesh.vertex_count())), face(static_cast<std::size_t>(mesh.face_count()));
    std::iota(vertex.begin(), vertex.end(), 0);
    std::iota(face.begin(), face.end(), 0);
    std::shuffle(vertex.begin(), vertex.end(), random);
    std::shuffle(face.begin(), face.end(), random);
    TriangleMesh other = mesh;
    for (int v = 0; v < mesh.vertex_count(); ++v) other.X.row(vertex[static_cast<std::size_t>(v)]) = mesh.X.row(v);
    for (int t = 0; t < mesh.face_count(); ++t) {
        const int begin = static_cast<int>(random() % 3);
        for (int k = 0; k < 3; ++k)
            other.F(face[static_cast<std::size_t>(t)], k) = vertex[static_cast<std::size_t>(mesh.F(t, (begin + k) % 3))];
    }
    if (!move) return other;
    std::normal_distribution<double> normal;
    const Eigen::Quaterniond turn = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    other.X =
        (other.X * turn.toRotationMatrix().transpose()).rowwise() + Eigen::RowVector3d(normal(random), normal(random), normal(random));
    return other;
}

/// Returns Σ of the solid angles of the triangles seen from p, over 4π (van Oosterom & Strackee 1983).
double winding_number(const TriangleMesh& mesh, const Vector3& p) {
    double sum = 0;
    for (int t = 0; t < mesh.face_count(); ++t) {
        const Vector3 a = mesh.X.row(mesh.F(t, 0)).transpose() - p, b = mesh.X.row(mesh.F(t, 1)).transpose() - p,
                      c = mesh.X.row(mesh.F(t, 2)).transpose() - p;
        const double A = a.norm(), B = b.norm(), C = c.norm();
        sum += 2 * std::atan2(a.dot(b.cross(c)), A * B * C + a.dot(b) * C + b.dot(c) * A + c.dot(a) * B);
    }
    return sum / (4 * std::numbers::pi);
}

void expect_left_alone(const TriangleMesh& mesh, double volume, const char* what) {
    const PreparedMesh result = prepared_solid(mesh);
    ASSERT_EQ(result.mesh.face_count(), mesh.face_count()) << what;
    EXPECT_EQ(result.mesh.F, mesh.F) << what;
    EXPECT_EQ(result.preflight.inside_out_components + result.preflight.flipped_faces, 0) << what;
    EXPECT_TRUE(result.preflight.encloses_volume()) << what;
    EXPECT_NEAR(result.preflight.volume, volume, 1e-12 * (1 + std::abs(volume))) << what;
}

double volume_of(const TriangleMesh& mesh) { return prepared_solid(mesh).preflight.volume; }

TriangleMesh klein_bottle(int n, int m) {
    TriangleMesh mesh;
    mesh.X.resize(n * m, 3);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / m;
            const double r = 2 + std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
            mesh.X.row(i * m + j) << r * std::cos(u), r * std::sin(u), std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v);
        }
    }
    mesh.F = grid_faces(n + 1, m, false, true);   // the last row is the first one, run through backwards
    for (int& v : mesh.F.reshaped())
        if (v >= n * m) v = (m - (v - n * m)) % m;
    return mesh;
}

/// Two tetrahedra on both sides of the triangle (1, 2, 3), which is there once; with_wall: twice, once for each.
TriangleMesh two_tetrahedra(bool with_wall) {
    TriangleMesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}},
                                {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 4}, {2, 3, 4}, {3, 1, 4}, {1, 2, 3}, {1, 3, 2}});
    if (!with_wall) mesh.F.conservativeResize(7, 3);
    return mesh;
}

}   // namespace

/// (±1, 0, 0), (0, ±1, 0), (0, 0, ±1).
TriangleMesh octahedron() {
    return mesh_of({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                   {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

// A shell may fill the box of the shell around it and still lies within that shell.
TEST(Nesting, ShellsOfOneBoxAreToldApart) {
    expect_left_alone(all_of({cube(2), turned(octahedron())}), 8 - 4.0 / 3, "a cavity in a cube");
    EXPECT_NEAR(volume_of(all_of({turned(cube(2)), octahedron()})), 8 - 4.0 / 3, 1e-12) << "all inverted";
    EXPECT_NEAR(volume_of(all_of({cube(2), octahedron()})), 8 - 4.0 / 3, 1e-12) << "the cavity outwards";
}

// Walls thinner than the digits of most files count as walls.
TEST(Nesting, ThinWallsHaveTwoSides) {
    for (const double gap : {1e-5, 1e-6, 1e-7, 1e-9}) {
        const double inner = 2 * (1 - gap), volume = 8 - inner * inner * inner;
        for (const TriangleMesh& mesh : {all_of({cube(2), turned(cube(inner))}), all_of({turned(cube(2)), cube(inner)}),
                                         all_of({cube(2), cube(inner)}), all_of({turned(cube(2)), turned(cube(inner))})})
            EXPECT_NEAR(volume_of(mesh), volume, 1e-13) << gap;
    }
}

// For any orientation in the file: bodies point outwards, cavities inwards, islands outwards. Shells that agree stay as they are.
TEST(Nesting, ShellsAlternateByDepth) {
    std::mt19937 random(1);
    for (int depth = 1; depth <= 4; ++depth) {
        for (int ways = 0; ways < 1 << depth; ++ways) {
            std::vector<TriangleMesh> shells;
            double volume = 0;
            int wrong = 0;
            for (int d = 0; d < depth; ++d) {
                const double size = 4 - 0.9 * d;
                const bool inwards = (ways >> d & 1) != 0;
                shells.push_back(inwards ? turned(cube(size)) : cube(size));
                volume += (d % 2 == 0 ? 1 : -1) * size * size * size;
                wrong += inwards != (d % 2 == 1) ? 1 : 0;
            }
            std::shuffle(shells.begin(), shells.end(), random);
            const TriangleMesh mesh = shuffled(all_of(shells), random, true);
            const PreparedMesh result = prepared_solid(mesh);
            EXPECT_EQ(result.preflight.inside_out_components, wrong) << depth << " " << ways;
            EXPECT_NEAR(result.preflight.volume, volume, 1e-12 * 64) << depth << " " << ways;
            EXPECT_TRUE(wrong > 0 || result.mesh.F == mesh.F);
            EXPECT_EQ(prepared_solid(result.mesh).preflight.inside_out_components, 0);   // the result agrees with itself
        }
    }
}

TEST(Nesting, AFilledCavityIsNamed) {
    const PreparedMesh result = prepared_solid(joined(cube(3), cube(1)));
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_EQ(result.warnings[0].message, "1 closed component within a body pointed outwards (positive volume), reoriented as a cavity");
    EXPECT_NEAR(result.preflight.volume, 26, 1e-12);
}

TEST(Nesting, CavitiesThatTouchTheWallStayCavities) {
    const TriangleMesh body = cube(4);
    expect_left_alone(welded(joined(body, turned(cube(2, {1, 1, 1})))), 56, "a vertex and three walls");
    expect_left_alone(joined(body, turned(cube(2, {0, 0, 1}))), 56, "a wall");
    expect_left_alone(joined(body, turned(cube(2, {0, 1, 1}))), 56, "two walls along an edge");
    expect_left_alone(joined(body, turned(box_of_solid(4, 1, 1, {-2, -0.5, -0.5}))), 60, "a channel from wall to wall");
}

TEST(Nesting, ABodyThatFillsACavityIsLeftAlone) {
    expect_left_alone(all_of({cube(4), turned(cube(2)), cube(2)}), 64, "filled");
    expect_left_alone(all_of({cube(2), turned(cube(2)), cube(4)}), 64, "in another order");
    TriangleMesh nearly = cube(2);
    nearly.X *= 1 + 1e-9;
    expect_left_alone(all_of({cube(4), nearly, turned(cube(2))}), 64 + (nearly.X.maxCoeff() - 1) * 24, "up to the rounding of a file");
}

TEST(Nesting, BodiesSideBySideAddUpWhateverTheyShare) {
    std::mt19937 random(3);
    const auto both_ways = [&](const TriangleMesh& a, const TriangleMesh& b, double volume, const char* what) {
        expect_left_alone(welded(joined(a, b)), volume, what);
        for (int i = 0; i < 5; ++i) EXPECT_NEAR(volume_of(shuffled(welded(joined(turned(a), b)), random, i > 0)), volume, 1e-12) << what;
    };
    both_ways(box_of_solid(1, 1, 1), box_of_solid(1, 1, 1, {3, 0, 0}), 2, "nothing");
    both_ways(box_of_solid(1, 1, 1), box_of_solid(1, 1, 1, {1, 1, 1}), 2, "a vertex");
    both_ways(box_of_solid(1, 1, 1), box_of_solid(1, 1, 1, {1, 1, 0}), 2, "an edge");
    both_ways(box_of_solid(1, 1, 1), box_of_solid(0.5, 0.5, 0.5, {1, 0.2, 0.2}), 1.125, "part of a face");
    expect_left_alone(two_tetrahedra(true), 0.5, "a face that both have");
    EXPECT_NEAR(volume_of(turned(two_tetrahedra(true))), 0.5, 1e-15);   // turned as a whole
}

// The volume of a wall without a counterpart would depend on the origin, and so on the rest of the file.
TEST(Nesting, AWallInsideABodyLeavesNoVolume) {
    const PreparedMesh result = prepared_solid(two_tetrahedra(false));
    EXPECT_TRUE(std::isnan(result.preflight.volume));
    EXPECT_EQ(result.preflight.unbalanced_edges, 3);
    EXPECT_TRUE(result.preflight.closed());
    EXPECT_NE(why_no_volume(result.mesh, result.topology).find("wall"), std::string::npos);
    EXPECT_TRUE(std::isnan(volume_of(joined(two_tetrahedra(false), cube(2, {9, 9, 9})))));
    EXPECT_EQ(edges_out_of_balance_by_component(joined(two_tetrahedra(false), cube(2, {9, 9, 9})),
                                                topology_of(joined(two_tetrahedra(false), cube(2, {9, 9, 9})))),
              (std::vector{3, 0}));
}

TEST(Nesting, SurfacesWithoutAnInsideHaveNoVolume) {
    for (const TriangleMesh& mesh : {flat_grid(4, 5), moebius_strip(9), klein_bottle(12, 9)}) {
        const PreparedMesh result = prepared_solid(mesh);
        EXPECT_TRUE(std::isnan(result.preflight.volume));
        EXPECT_NE(why_no_volume(result.mesh, result.topology), "");
        EXPECT_FALSE(encloses_volume(result.mesh, result.topology));
        EXPECT_TRUE(std::isnan(enclosed_volume(result.mesh)));
    }
    EXPECT_TRUE(prepared_solid(klein_bottle(12, 9)).preflight.closed());
    const PreparedMesh klein = prepared_solid(klein_bottle(12, 9));
    EXPECT_NE(why_no_volume(klein.mesh, klein.topology).find("orientation"), std::string::npos);
    TriangleMesh pillow = flat_grid(2, 2);
    pillow.F.conservativeResize(4, 3);
    pillow.F.bottomRows(2) = pillow.F.topRows(2).rowwise().reverse().eval();
    EXPECT_EQ(prepared_solid(pillow).preflight.volume, 0);   // it has two sides, and nothing between them
}

TEST(Nesting, OpenAndIntersectingSurfacesHoldNothing) {
    TriangleMesh open = cube(4);
    open.F.conservativeResize(10, 3);   // without a wall
    const TriangleMesh inside = joined(open, turned(cube(1)));
    EXPECT_EQ(prepared_solid(inside).preflight.inside_out_components, 1);
    EXPECT_EQ(prepared_solid(joined(open, cube(1))).preflight.inside_out_components, 0);
    expect_left_alone(joined(cube(2), cube(2, {1, 1, 1})), 16, "overlapping");
    // A prism within the box of a bent one, half in it: its box lies in the other's, its surface does not.
    TriangleMesh bent = all_of({box_of_solid(4, 1, 2), box_of_solid(1, 3, 2, {0, 1, 0})});
    expect_left_alone(joined(torus(24, 12), cube(0.4, {1.5, 0, 0.2})), signed_volume(torus(24, 12)) + 0.064, "across a torus");
    expect_left_alone(joined(torus(24, 12), cube(0.4)), signed_volume(torus(24, 12)) + 0.064, "in the hole of a torus");
    expect_left_alone(joined(bent, box_of_solid(1, 1, 1, {2, 2, 0.5})), 14 + 1, "beside");
}

TEST(Nesting, OppositeFacesStayAndRepeatedOnesGo) {
    const TriangleMesh closed = two_tetrahedra(true);
    for (int copies = 1; copies <= 3; ++copies) {
        for (int opposite = 0; opposite <= 3; ++opposite) {
            TriangleMesh mesh = tetrahedron();
            const auto first = mesh.F.row(3).eval();
            mesh.F.conservativeResize(3 + copies + opposite, 3);
            for (int i = 0; i < copies; ++i) mesh.F.row(3 + i) = first;
            for (int i = 0; i < opposite; ++i) mesh.F.row(3 + copies + i) << first(1), first(0), first(2);
            const Preflight p = prepared_solid(mesh).preflight;
            EXPECT_EQ(p.dropped_duplicate_faces, copies - 1 + std::max(0, opposite - 1));
            EXPECT_EQ(p.opposite_faces, opposite > 0 ? 1 : 0);
            EXPECT_EQ(p.triangles, 4 + (opposite > 0 ? 1 : 0));
            EXPECT_EQ(p.encloses_volume(), opposite == 0);
        }
    }
    EXPECT_EQ(prepared_solid(closed).preflight.opposite_faces, 1);
    EXPECT_EQ(prepared_solid(closed).preflight.dropped_duplicate_faces, 0);
}

// Random tetrahedra and cubes of all sizes, apart or nested, each turned at random: after preparation the sum of the winding
// numbers is 1 right inside a body and 0 right inside a cavity.
TEST(Nesting, AgreesWithSolidAngles) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<TriangleMesh> bodies;
        std::vector<std::pair<Vector3, double>> balls;   // around each body
        while (bodies.size() < 12) {
            const Vector3 centre(uniform(random), uniform(random), uniform(random));
            const double radius = std::exp2(3 * uniform(random) - 3);
            const auto disjoint = [&](const auto& ball) {
                const double apart = (ball.first - centre).norm();
                const double inner = 1 / std::sqrt(3.0);   // of a cube's balls
                return apart > ball.second + radius || apart + radius < inner * ball.second || apart + ball.second < inner * radius;
            };
            if (!std::all_of(balls.begin(), balls.end(), disjoint)) continue;
            balls.emplace_back(centre, radius);
            bodies.push_back(shuffled(cube(2 * radius / std::sqrt(3.0)), random, false));
            bodies.back().X = moved(rotated(bodies.back().X), centre);
            if (random() % 2 == 0) bodies.back() = turned(bodies.back());
        }
        const TriangleMesh result = prepared_solid(all_of(bodies)).mesh;
        const Positions normals = face_normals(result);
        for (int t = 0; t < result.face_count(); t += 6) {
            const Vector3 centroid = (result.X.row(result.F(t, 0)) + result.X.row(result.F(t, 1)) + result.X.row(result.F(t, 2))) / 3;
            const Vector3 step = 1e-6 * normals.row(t);
            EXPECT_NEAR(winding_number(result, centroid - step), 1, 1e-6);   // behind every face is matter
            EXPECT_NEAR(winding_number(result, centroid + step), 0, 1e-6);
        }
    }
}

// 20,000 cavities in one body, in a row and in a block, beside as many bodies.
TEST(Nesting, ManyShellsTakeSeconds) {
    const auto begin = std::chrono::steady_clock::now();
    constexpr int count = 20000;
    TriangleMesh many;
    const TriangleMesh one = turned(tetrahedron());
    many.X.resize(4 * count, 3);
    many.F.resize(4 * count, 3);
    for (int i = 0; i < count; ++i) {
        many.X.middleRows(4 * i, 4) = moved(one.X, i % 2 == 0 ? Vector3(i, 0, 0) : Vector3(2 * (i % 20), 2 * (i / 20 % 20), 2 * (i / 400)));
        many.F.middleRows(4 * i, 4) = one.F.array() + 4 * i;
    }
    const double volume = count / 6.0, outer = 1e5;
    EXPECT_EQ(prepared_solid(many).preflight.inside_out_components, count);
    EXPECT_NEAR(prepared_solid(joined(many, cube(outer))).preflight.volume, outer * outer * outer - volume, 1e-12 * outer * outer * outer);
    EXPECT_EQ(prepared_solid(joined(many, cube(outer))).preflight.inside_out_components, 0);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}
