#include "geometry/curvature/curvature.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "base/errors.h"
#include "base/parallel.h"
#include "geometry/curvature/analytic_surfaces.h"
#include "geometry/operator_test_meshes.h"
#include "geometry/operators/uniform_laplacian.h"

namespace meshfolio {
namespace {

using namespace testing;

Vector cotangent_H(const TriangleMesh& mesh, AreaForm area = AreaForm::barycentric) {
    return cotangent_mean_curvature(mesh, topology_of(mesh), laplace_beltrami(mesh, area));
}
Vector gauss_K(const TriangleMesh& mesh, AreaForm area = AreaForm::barycentric) {
    return gaussian_curvature(mesh, topology_of(mesh), vertex_areas(mesh, area));
}
Vector uniform_H(const TriangleMesh& mesh) { return uniform_mean_curvature(mesh, topology_of(mesh)); }
Vector uniform_H_scaled(const TriangleMesh& mesh) { return uniform_mean_curvature_scaled(mesh, topology_of(mesh)); }

/// Relative errors against the closed form: the largest, and the area-weighted root mean square over that of the truth.
struct Errors {
    double largest, l2;
};
using ClosedForm = std::function<CurvaturePair(const Vector3&)>;
Errors errors_of(const TriangleMesh& mesh, const Vector& measured, const ClosedForm& truth_at, double CurvaturePair::*quantity) {
    const Vector A = vertex_areas(mesh, AreaForm::barycentric);
    double largest = 0, size = 0, error_squared = 0, truth_squared = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const double truth = truth_at(mesh.X.row(v).transpose()).*quantity, error = measured[v] - truth;
        largest = std::max(largest, std::abs(error));
        size = std::max(size, std::abs(truth));
        error_squared += A[v] * error * error;
        truth_squared += A[v] * truth * truth;
    }
    return {largest / size, std::sqrt(error_squared / truth_squared)};
}

const ClosedForm unit_sphere = [](const Vector3&) { return sphere_curvature(1); };
const ClosedForm ring = [](const Vector3& p) { return torus_curvature(1, 0.4, p); };
const Vector3 half_axes(1.7, 1.1, 0.6);
const ClosedForm ellipsoid_truth = [](const Vector3& p) { return ellipsoid_curvature(half_axes, p); };

/// log₂ of the ratio of the errors of two meshes, the second twice as fine.
double order(double coarse, double fine) { return std::log2(coarse / fine); }

TEST(Curvature, OfTheIcosphereAsMeasuredIndependently) {
    const TriangleMesh coarse = icosphere(4), fine = icosphere(5);   // 2562 and 10242 vertices
    const auto H_errors = [](const TriangleMesh& mesh, AreaForm area) {
        return errors_of(mesh, cotangent_H(mesh, area), unit_sphere, &CurvaturePair::H);
    };
    EXPECT_NEAR(H_errors(coarse, AreaForm::barycentric).largest, 0.14517, 1e-5);
    EXPECT_NEAR(H_errors(fine, AreaForm::barycentric).largest, 0.14572, 1e-5);   // stalls: see the pentagon below
    EXPECT_NEAR(H_errors(coarse, AreaForm::barycentric).l2, 8.8e-3, 1e-4);
    EXPECT_NEAR(order(H_errors(coarse, AreaForm::barycentric).l2, H_errors(fine, AreaForm::barycentric).l2), 1, 0.1);
    for (const AreaForm area : {AreaForm::mixed, AreaForm::voronoi}) {
        EXPECT_NEAR(H_errors(coarse, area).largest, 8.7e-6, 1e-6);
        EXPECT_NEAR(order(H_errors(coarse, area).largest, H_errors(fine, area).largest), 2, 0.1);
    }
    const auto K_error = [](const TriangleMesh& mesh) {
        return errors_of(mesh, gauss_K(mesh, AreaForm::mixed), unit_sphere, &CurvaturePair::K).l2;
    };
    EXPECT_NEAR(K_error(coarse), 1.2e-3, 1e-4);
    EXPECT_NEAR(order(K_error(coarse), K_error(fine)), 2, 0.1);
}

TEST(Curvature, ConvergesQuadraticallyOnTheTorus) {
    const TriangleMesh coarse = torus_mesh(64, 32, 1, 0.4), fine = torus_mesh(128, 64, 1, 0.4);
    for (const AreaForm area : {AreaForm::barycentric, AreaForm::mixed, AreaForm::voronoi}) {
        const auto H_error = [&](const TriangleMesh& m) { return errors_of(m, cotangent_H(m, area), ring, &CurvaturePair::H).largest; };
        const auto K_error = [&](const TriangleMesh& m) { return errors_of(m, gauss_K(m, area), ring, &CurvaturePair::K).largest; };
        EXPECT_NEAR(order(H_error(coarse), H_error(fine)), 2, 0.15) << name_of(area);
        EXPECT_NEAR(order(K_error(coarse), K_error(fine)), 2, 0.15) << name_of(area);
        EXPECT_LT(H_error(fine), 3e-3);
        EXPECT_LT(K_error(fine), 1e-2);
    }
}

TEST(Curvature, ConvergesOnTheEllipsoidWithVoronoiAreas) {
    const TriangleMesh coarse = ellipsoid_mesh(4, half_axes), fine = ellipsoid_mesh(5, half_axes);
    const auto H_error = [&](const TriangleMesh& m) {
        return errors_of(m, cotangent_H(m, AreaForm::voronoi), ellipsoid_truth, &CurvaturePair::H).l2;
    };
    EXPECT_GT(order(H_error(coarse), H_error(fine)), 0.9);
    EXPECT_LT(H_error(fine), 1e-2);
}

TEST(Curvature, DoesNotConvergeOnIrregularMeshesWithBarycentricAreas) {
    const auto H_error = [](int level) {
        const TriangleMesh mesh = irregular_sphere(level);
        return errors_of(mesh, cotangent_H(mesh), unit_sphere, &CurvaturePair::H).l2;
    };
    EXPECT_GT(H_error(3), 0.05);
    EXPECT_GT(H_error(5), 0.8 * H_error(3));
}

// Flat regular pentagon, its ring lowered onto a sphere of radius R: weights cot 54°, area 5 sin 72°/6, drop 1/(2R), hence
// H R = 3 cot 54°/(2 sin 72°) = 1.1459. The twelve valence-5 vertices of an icosphere approach this.
TEST(Curvature, RegularPentagonOracle) {
    const double limit = 3 / std::tan(54 * pi / 180) / (2 * std::sin(72 * pi / 180));
    EXPECT_NEAR(limit, 1.1459, 1e-4);
    const TriangleMesh flat = fan(5);
    const double R = 50;
    const TriangleMesh lowered = fan(5, -1 / (2 * R));
    EXPECT_NEAR(R * cotangent_mean_curvature(lowered, topology_of(flat), laplace_beltrami(flat))[0], limit, 1e-14);
    EXPECT_NEAR(R * cotangent_H(lowered)[0], limit, 2 / (R * R));
    EXPECT_NEAR(cotangent_H(icosphere(3)).maxCoeff(), 1.14301, 1e-5);
}

// −½ Δx · n = 1/R identically for points on a sphere, however placed, with Voronoi areas and the exact normal.
TEST(Curvature, VoronoiIdentityOnTheSphere) {
    const double R = 2.5;
    const TriangleMesh mesh = irregular_sphere(3, R);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh, AreaForm::voronoi);
    const Positions Cx = laplacian.C * mesh.X;
    int obtuse = 0;
    for (Eigen::Index v = 0; v < mesh.X.rows(); ++v) {
        const double integrated = -0.5 * Cx.row(v).dot(mesh.X.row(v)) / R;
        EXPECT_NEAR(integrated, laplacian.M[v] / R, 1e-13);
        obtuse += laplacian.M[v] < 0.5 * vertex_areas(mesh, AreaForm::barycentric)[v] ? 1 : 0;
    }
    EXPECT_GT(obtuse, 0);
}

double median(Vector values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// (x_j − x_i) · n = −|e|²/(2R) on a sphere, so 4/mean|e|² times the normal part of ½ Δx is 1/R identically. The tangential part, the
// drift of the ring, is what the uniform operator adds where edges differ: none on regular solids, little at most vertices of the
// icosphere, but along the lines where its subdivisions meet it outgrows the curvature, by a factor 2 with every refinement.
TEST(Curvature, ScaledUniformIsTheCurvaturePlusTheDriftOfTheRing) {
    const double R = 3;
    for (const double H : uniform_H_scaled(icosphere(0, R))) EXPECT_NEAR(H, 1 / R, 1e-14);
    const TriangleMesh mesh = irregular_sphere(3, R);
    const MeshTopology topology = topology_of(mesh);
    const Positions Lx = uniform_laplacian(topology) * mesh.X;
    const Vector h2 = mean_squared_ring_edge(mesh, topology), H = uniform_H_scaled(mesh);
    for (Eigen::Index v = 0; v < H.size(); ++v) {
        EXPECT_NEAR(-2 * Lx.row(v).dot(mesh.X.row(v)) / R / h2[v], 1 / R, 1e-12);
        EXPECT_GT(std::abs(H[v]), 1 / R - 1e-12);
    }
    const Vector coarse = uniform_H_scaled(icosphere(4)), fine = uniform_H_scaled(icosphere(5));
    EXPECT_NEAR(median(fine), 1, 0.02);
    EXPECT_LT(median(fine), median(coarse));
    EXPECT_NEAR(fine.maxCoeff() / coarse.maxCoeff(), 2, 0.1);
    EXPECT_LT(uniform_H(icosphere(4)).maxCoeff(), 0.01);   // unscaled: a length of the order of the squared edge
}

TEST(Curvature, SignFollowsTheNormals) {
    const TriangleMesh sphere = irregular_sphere(3);
    const TriangleMesh hollow = turned_inside_out(sphere);
    EXPECT_GT(cotangent_H(icosphere(3)).minCoeff(), 0);
    EXPECT_GT(uniform_H(icosphere(3)).minCoeff(), 0);
    EXPECT_LT(largest_relative_difference(cotangent_H(hollow), -cotangent_H(sphere)), 1e-13);
    EXPECT_LT(largest_relative_difference(uniform_H(hollow), -uniform_H(sphere)), 1e-13);
    EXPECT_LT(largest_relative_difference(gauss_K(hollow), gauss_K(sphere)), 1e-11);
    const TriangleMesh saddle = grid_mesh(10, 10, 1, 1, [](double x, double y) { return (x - 0.5) * (x - 0.5) - (y - 0.5) * (y - 0.5); });
    const Vector K = gauss_K(saddle);
    for (Eigen::Index v = 0; v < K.size(); ++v) EXPECT_TRUE(std::isnan(K[v]) || K[v] < 0) << v;
}

TEST(Curvature, FlatInsideAPlaneWhateverItsTriangles) {
    const TriangleMesh mesh = irregular_plane(10);
    const Vector H = cotangent_H(rotated_and_moved(mesh)), K = gauss_K(rotated_and_moved(mesh));
    int inside = 0;
    for (Eigen::Index v = 0; v < H.size(); ++v) {
        if (std::isnan(H[v])) continue;
        EXPECT_LT(std::abs(H[v]), 1e-9);
        EXPECT_LT(std::abs(K[v]), 1e-9);
        ++inside;
    }
    EXPECT_EQ(inside, 64);   // of 10 × 10 points
}

TEST(Curvature, Laws) {
    const TriangleMesh mesh = irregular_sphere(2);
    const Renamed shuffled = with_shuffled_vertices(mesh);
    struct Law {
        const char* name;
        Vector (*of)(const TriangleMesh&);
        int power_of_scale;
    };
    for (const Law& law : {Law{"uniform", uniform_H, 1}, Law{"scaled uniform", uniform_H_scaled, -1},
                           Law{"cotangent", [](const TriangleMesh& m) { return cotangent_H(m); }, -1},
                           Law{"Gauss", [](const TriangleMesh& m) { return gauss_K(m); }, -2}}) {
        const Vector value = law.of(mesh);
        EXPECT_LT(largest_relative_difference(law.of(rotated_and_moved(mesh)), value), 1e-11) << law.name;
        EXPECT_LT(largest_relative_difference(in_original_order(law.of(shuffled.mesh), shuffled.name), value), 1e-11) << law.name;
        for (const double s : {3.0, 1e30, 1e-30}) {
            const Vector rescaled = law.of(scaled(mesh, s)) / std::pow(s, law.power_of_scale);
            EXPECT_LT(largest_relative_difference(rescaled, value), 1e-11) << law.name << " × " << s;
        }
    }
}

TEST(Curvature, FarFromTheOrigin) {
    TriangleMesh mesh = irregular_sphere(2);
    mesh.X = (mesh.X * 0x1p20).array().round();
    TriangleMesh far = mesh;
    far.X.array() += 0x1p50;   // 1e15, and exact
    EXPECT_LT(largest_relative_difference(cotangent_H(far), cotangent_H(mesh)), 1e-13);
    EXPECT_LT(largest_relative_difference(uniform_H(far), uniform_H(mesh)), 1e-13);
    EXPECT_LT(largest_relative_difference(gauss_K(far), gauss_K(mesh)), 1e-11);
}

void expect_gauss_bonnet(const TriangleMesh& mesh, const std::string& name) {
    const MeshTopology topology = topology_of(mesh);
    if (topology.nonmanifold_edge_count() + topology.nonmanifold_vertex_count() > 0) return;
    int used = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) used += topology.vertex_faces.size(v) > 0 ? 1 : 0;
    const int euler = used - static_cast<int>(topology.edges.size()) + mesh.face_count();
    EXPECT_NEAR(angle_deficit(mesh, topology).sum(), 2 * pi * euler, 1e-13 * mesh.face_count() + 1e-12) << name;
}

TEST(Curvature, GaussBonnet) {
    for (const Sample& sample : sample_list()) expect_gauss_bonnet(sample.make(0), std::string(sample.name));
    expect_gauss_bonnet(irregular_sphere(4), "irregular sphere");
    expect_gauss_bonnet(irregular_plane(20), "irregular plane");
    expect_gauss_bonnet(torus_mesh(30, 20, 2, 0.6), "torus");
    expect_gauss_bonnet(scaled(irregular_sphere(2), 1e-30), "tiny sphere");
}

// Neighbours at one point leave triangles with sides of no length, or with none at all.
TEST(Curvature, GaussBonnetWhereVerticesCoincide) {
    TriangleMesh mesh = irregular_sphere(2);
    mesh.X.row(mesh.F(7, 1)) = mesh.X.row(mesh.F(7, 0));
    expect_gauss_bonnet(mesh, "two at one point");
    mesh.X.row(mesh.F(7, 2)) = mesh.X.row(mesh.F(7, 0));
    expect_gauss_bonnet(mesh, "a triangle at one point");
    mesh.X.row(mesh.F(20, 0)) = 0.5 * (mesh.X.row(mesh.F(20, 1)) + mesh.X.row(mesh.F(20, 2)));
    expect_gauss_bonnet(mesh, "a triangle on a line");
}

TEST(Curvature, AngleDeficitOfCubeAndSquare) {
    const TriangleMesh cube = cube_mesh(1);
    for (const double deficit : angle_deficit(cube, topology_of(cube))) EXPECT_NEAR(deficit, pi / 2, 1e-14);
    const TriangleMesh square = grid_mesh(3, 3, 1, 1);
    const Vector turning = angle_deficit(square, topology_of(square));
    EXPECT_NEAR(turning.maxCoeff(), pi / 2, 1e-14);   // the corners; the sides are straight
    EXPECT_NEAR(turning.cwiseAbs().sum(), 2 * pi, 1e-13);
}

/// Two cones that meet in their tips, vertex 0; then a vertex of no triangle.
TriangleMesh two_cones_and_a_stray_vertex() {
    const TriangleMesh up = fan(6, 0.5), down = fan(6, -0.5);
    TriangleMesh mesh;
    mesh.X.resize(14, 3);
    mesh.X << up.X, down.X.bottomRows(6), 9, 9, 9;
    mesh.F.resize(12, 3);
    mesh.F << up.F, down.F.unaryExpr([](int v) { return v == 0 ? 0 : v + 6; });
    return mesh;
}

// The shapes where angles could go wrong: many triangles at a vertex, an edge of three triangles, a triangle without area, sides without
// length.
TEST(Curvature, AngleDeficitIsThatOfTheCornerAngles) {
    const TriangleMesh disk = fan(200, 0.2);
    TriangleMesh crowded{Positions(204, 3), Faces(203, 3)};
    crowded.X << disk.X, 2, 0, 0, 2, 1, 1, 1e50, 0, 0;
    crowded.F << disk.F, 0, 1, 201, 1, 0, 202, 0, 201, 200;
    crowded.X.row(200) = 0.5 * (crowded.X.row(0) + crowded.X.row(201));
    for (const TriangleMesh& mesh : {irregular_sphere(3), irregular_plane(12), crowded, scaled(irregular_sphere(2), 1e-30),
                                     triangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1}), triangle({0, 0, 0}, {0, 0, 0}, {1, 1, 1})}) {
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
        for (int t = 0; t < mesh.face_count(); ++t) {
            for (int k = 0; k < 3; ++k) deficit[mesh.F(t, k)] += angles(t, k);
        }
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            const double flat = topology.vertex_faces.size(v) == 0 ? 0 : topology.on_boundary[static_cast<std::size_t>(v)] ? pi : 2 * pi;
            EXPECT_NEAR(deficit[v], flat, 1e-13) << v;
        }
    }
}

// Sums run over the triangles in their order, whichever thread computes the terms.
TEST(Curvature, SameForAnyNumberOfThreads) {
    const TriangleMesh mesh = with_shuffled_vertices(irregular_sphere(6)).mesh;
    const MeshTopology topology = topology_of(mesh);
    ASSERT_GT(block_count(mesh.face_count()), 2);
    const auto with_threads = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
        return std::array{Vector(laplacian.C.coeffs()), laplacian.M, cotangent_mean_curvature(mesh, topology, laplacian),
                          gaussian_curvature(mesh, topology, laplacian.M)};
    };
    EXPECT_EQ(with_threads(1), with_threads(3));
}

TEST(Curvature, IsUndefinedAtBoundaryNonManifoldAndStrayVertices) {
    const TriangleMesh mesh = two_cones_and_a_stray_vertex();
    for (const Vector& value : {uniform_H(mesh), uniform_H_scaled(mesh), cotangent_H(mesh), gauss_K(mesh)}) {
        EXPECT_EQ(value.array().isNaN().count(), mesh.X.rows());
    }
    EXPECT_EQ(angle_deficit(mesh, topology_of(mesh))[13], 0);
    const TriangleMesh disk = fan(6, 0.5);
    for (const Vector& value : {uniform_H(disk), uniform_H_scaled(disk), cotangent_H(disk), gauss_K(disk)}) {
        EXPECT_TRUE(std::isfinite(value[0]));
        EXPECT_EQ(value.array().isNaN().count(), 6);
    }
}

TEST(Curvature, IsUndefinedWhereTheAreaIsNotPositive) {
    const TriangleMesh mesh = icosphere(1);
    const MeshTopology topology = topology_of(mesh);
    LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    laplacian.M[3] = 0;
    laplacian.M[4] = -1;
    for (const Vector& value : {cotangent_mean_curvature(mesh, topology, laplacian), gaussian_curvature(mesh, topology, laplacian.M)}) {
        EXPECT_TRUE(std::isnan(value[3]) && std::isnan(value[4]));
        EXPECT_EQ(value.array().isNaN().count(), 2);
    }
}

TEST(Curvature, RefusesSizesThatDoNotFit) {
    const TriangleMesh mesh = icosphere(1);
    const MeshTopology topology = topology_of(mesh), other = topology_of(icosphere(0));
    EXPECT_THROW(gaussian_curvature(mesh, topology, Vector::Ones(3)), MeshError);
    EXPECT_THROW(cotangent_mean_curvature(mesh, topology, laplace_beltrami(icosphere(0))), MeshError);
    EXPECT_THROW(uniform_mean_curvature(mesh, other), MeshError);
    EXPECT_THROW(angle_deficit(mesh, other), MeshError);
}

}   // namespace
}   // namespace meshfolio
