#include "geometry/measures/mesh_facts.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "geometry/curvature/curvature.h"
#include "geometry/operators/cotangent_laplacian.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/spectrum_certificate.h"
#include "geometry/spectrum/stability.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

PreparedMesh prepared(const TriangleMesh& mesh) { return prepare_mesh({mesh, "m.obj", {}, {}}); }

/// A mesh far away and at another scale, and the same mesh back home. Moving rounds the coordinates once; both have them rounded, so
/// that every difference is an error of the formulas.
struct FarAndNear {
    TriangleMesh far, near;
    double scale;
};
FarAndNear far_and_near(const TriangleMesh& mesh, double scale) {
    const Eigen::RowVector3d away = Eigen::RowVector3d(1, -1, 1) * std::ldexp(2.0, 20);   // a million boxes of size about 2
    FarAndNear pair{mesh, mesh, scale};
    pair.far.X = (mesh.X.rowwise() + away) * scale;        // rounded here
    pair.near.X = (pair.far.X / scale).rowwise() - away;   // not here
    return pair;
}

std::vector<FarAndNear> pairs() {
    std::vector<FarAndNear> all;
    for (const double scale : {std::ldexp(1.0, -20), 1.0, std::ldexp(1.0, 20)}) {
        all.push_back(far_and_near(lopsided_ellipsoid(3), scale));
        all.push_back(far_and_near(irregular_plane(14), scale));
    }
    return all;
}

double difference_of_defined(const Vector& a, const Vector& b) {
    double largest = 0, size = 0;
    for (Eigen::Index i = 0; i < a.size(); ++i) {
        EXPECT_EQ(std::isnan(a[i]), std::isnan(b[i])) << i;
        if (std::isnan(a[i])) continue;
        largest = std::max(largest, std::abs(a[i] - b[i]));
        size = std::max(size, std::abs(b[i]));
    }
    return largest / size;
}

}   // namespace

TEST(MeshFacts, SpacingIsThatOfTheFarthestCoordinate) {
    EXPECT_EQ(coordinate_spacing(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})), 0x1p-52);
    EXPECT_EQ(coordinate_spacing(triangle({-1e9, 0, 0}, {1, 0, 0}, {0, 1, 0})), 0x1p-23);
    EXPECT_EQ(coordinate_spacing(triangle({0, 0, 3e-300}, {0, 1e-300, 0}, {0, 0, 0})), std::nextafter(3e-300, 1) - 3e-300);
}

// The numbers themselves show whether they were written with d decimals, in single precision or in full.
TEST(MeshFacts, WrittenSpacingIsThatOfTheFile) {
    const TriangleMesh mesh = lopsided_ellipsoid(3);
    const auto rounded_to = [&](double spacing) { return Positions((mesh.X / spacing).array().round() * spacing); };
    for (const int decimals : {2, 4, 6, 9}) {
        Positions X = mesh.X;
        char text[64];
        for (double& x : X.reshaped()) {
            std::snprintf(text, sizeof text, "%.*f", decimals, x);
            x = std::strtod(text, nullptr);
        }
        EXPECT_DOUBLE_EQ(written_spacing(X), std::pow(10.0, -decimals)) << decimals;
    }
    const double farthest = mesh.X.cwiseAbs().maxCoeff();
    EXPECT_DOUBLE_EQ(written_spacing(mesh.X.cast<float>().cast<double>()), std::ldexp(1.0, std::ilogb(farthest) - 23));
    EXPECT_DOUBLE_EQ(written_spacing(mesh.X), std::ldexp(1.0, std::ilogb(farthest) - 52));
    EXPECT_LE(written_spacing(rounded_to(0x1p-10)), 0x1p-10) << "a grid of binary fractions";
}

TEST(MeshFacts, AGridIsNotRounded) {
    TriangleMesh block = cube_mesh(1);
    block.X *= 8;
    EXPECT_EQ(mesh_facts(prepared(block)).written_steps, 0) << "whole numbers need no rounding";
    for (const double step : {0.3, 0.05, 0.125}) {
        TriangleMesh grid = grid_mesh(5, 5, 4, 4);
        grid.X = (grid.X * step).eval();
        for (double& x : grid.X.reshaped()) x = std::round(x * 1000) / 1000;
        EXPECT_NEAR(mesh_facts(prepared(grid)).written_steps, 1, 1e-9) << step;
    }
}

TEST(MeshFacts, ExtremesOfAKnownTriangle) {
    const TriangleMesh mesh = triangle({0, 0, 0}, {3, 0, 0}, {0, 4, 0});
    const MeshFacts facts = mesh_facts(prepared(mesh));
    EXPECT_NEAR(facts.shortest_edge, 3, 1e-15);
    EXPECT_NEAR(facts.longest_edge, 5, 1e-15);
    EXPECT_NEAR(facts.smallest_angle, std::atan2(3, 4), 1e-15);
    EXPECT_NEAR(facts.diagonal, 5, 1e-15);
    EXPECT_NEAR(facts.offset, 0.5, 1e-15);
    EXPECT_LT(facts.gauss_bonnet_residual, 1e-15);
    EXPECT_NEAR(facts.total_deficit, 2 * pi, 1e-14);
    EXPECT_EQ(facts.counts.zero_area_faces, 0);
    EXPECT_NEAR(facts.coordinate_rounding, std::ldexp(1.0, -50) / 3, 1e-20);
}

TEST(MeshFacts, CountsWhatIsThere) {
    const MeshFacts facts = mesh_facts(prepared(with_unreferenced_vertex(icosphere(1), {50, 0, 0})));
    EXPECT_EQ(facts.unreferenced_vertices, 1);
    EXPECT_LT(facts.offset, 1e-15);   // of the vertices in use
    const MeshFacts flat = mesh_facts(prepared(triangle({0, 0, 0}, {1, 0, 0}, {2, 0, 0})));
    EXPECT_EQ(flat.counts.zero_area_faces, 1);
    EXPECT_EQ(flat.smallest_angle, 0);
    const MeshFacts away = mesh_facts(prepared(moved_by(icosphere(1), {1e7, 0, 0})));
    EXPECT_NEAR(away.offset, 1e7 / (2 * std::sqrt(3)), 1e6);
    EXPECT_NEAR(away.coordinate_rounding * away.shortest_edge, std::ldexp(1.0, -29), 1e-20);   // 2²³ < 10⁷ < 2²⁴
}

TEST(MeshFacts, GaussBonnetOfOtherGenera) {
    EXPECT_LT(mesh_facts(prepared(torus_mesh(20, 11, 2, 0.6))).gauss_bonnet_residual, 1e-13);
    EXPECT_LT(mesh_facts(prepared(side_by_side(icosphere(2), irregular_plane(6)))).gauss_bonnet_residual, 1e-13);
}

TEST(MeshFacts, NothingChangesWhenMoved) {
    for (const TriangleMesh& mesh : {lopsided_ellipsoid(3), irregular_plane(14), torus_mesh(30, 12, 2, 0.3)}) {
        for (const double scale : {0x1p-20, 1.0, 0x1p20}) EXPECT_LT(change_when_moved(prepared(mesh), scale), 1e-14) << scale;
    }
}

// A scale that is no power of two rounds every coordinate of one of the two meshes anew: the change must show.
TEST(MeshFacts, AChangedMeshHasOtherFacts) { EXPECT_GT(change_when_moved(prepared(lopsided_ellipsoid(3)), 3e5), 1e-12); }

TEST(PlaceAndScale, OperatorsAndCurvature) {
    for (const auto& [far, near, scale] : pairs()) {
        const MeshTopology topology = topology_of(far);
        const LaplaceBeltrami a = laplace_beltrami(far), b = laplace_beltrami(near);
        const auto change = [](const Vector& x, double unit, const Vector& y) { return difference_of_defined(x * unit, y); };
        const auto H = [&](const TriangleMesh& mesh, const LaplaceBeltrami& L) { return cotangent_mean_curvature(mesh, topology, L); };
        const auto K = [&](const TriangleMesh& mesh, const LaplaceBeltrami& L) { return gaussian_curvature(mesh, topology, L.M); };
        EXPECT_LT(change(a.C.coeffs(), 1, b.C.coeffs()), 1e-14);
        EXPECT_LT(change(a.M, 1 / (scale * scale), b.M), 1e-14);
        const Vector voronoi_far = vertex_areas(far, AreaForm::voronoi), voronoi_near = vertex_areas(near, AreaForm::voronoi);
        EXPECT_LT(change(voronoi_far, 1 / (scale * scale), voronoi_near), 1e-14);
        EXPECT_LT(change(H(far, a), scale, H(near, b)), 1e-14);
        EXPECT_LT(change(K(far, a), scale * scale, K(near, b)), 1e-14);
    }
}

TEST(PlaceAndScale, LargestStableStep) {
    for (const auto& [far, near, scale] : pairs()) {
        const double a = largest_stable_step(largest_eigenvalue(laplace_beltrami(far))) / (scale * scale);
        const double b = largest_stable_step(largest_eigenvalue(laplace_beltrami(near)));
        EXPECT_NEAR(a / b, 1, 1e-11) << scale;
    }
}

TEST(PlaceAndScale, EigenvaluesAndTheirCertificates) {
    for (const auto& [far, near, scale] : pairs()) {
        const LaplaceBeltrami operators[] = {laplace_beltrami(far), laplace_beltrami(near)};
        const Spectrum a = smallest_eigenpairs(operators[0], 8), b = smallest_eigenpairs(operators[1], 8);
        for (int i = 0; i < 8; ++i) EXPECT_NEAR(a.eigenvalues[i] * scale * scale, b.eigenvalues[i], 1e-11 * b.eigenvalues[7]);
        EXPECT_TRUE(certify_spectrum(far, operators[0], a).holds());
        EXPECT_TRUE(certify_spectrum(near, operators[1], b).holds());
    }
}

TEST(PlaceAndScale, Smoothing) {
    for (const auto& [far, near, scale] : pairs()) {
        const double step = 0.4 * largest_stable_step(largest_eigenvalue(laplace_beltrami(near)));
        for (const SmoothingScheme scheme : {SmoothingScheme::explicit_euler, SmoothingScheme::implicit_euler, SmoothingScheme::taubin}) {
            for (const bool rebuild : {false, true}) {
                SmoothingOptions options;
                options.scheme = scheme;
                options.iterations = 5;
                options.rebuild = rebuild;
                options.lambda = step;
                const Positions there = smooth(near, options).X;
                options.lambda = step * scale * scale;
                const Positions here = (smooth(far, options).X / scale).rowwise() - Eigen::RowVector3d(1, -1, 1) * std::ldexp(2.0, 20);
                // The result lies far away, so that its coordinates are rounded to 2⁻³² once more.
                EXPECT_LT((here - there).cwiseAbs().maxCoeff(), 0x1p-31) << scale << " " << rebuild;
            }
        }
    }
}
