#include "geometry/curvature/analytic_surfaces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/curvature/fundamental_forms.h"
#include "geometry/operator_test_meshes.h"
#include "mesh/mesh_topology.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

using namespace testing;

/// Returns H and K from central differences of a parametrisation: an independent oracle.
CurvaturePair curvature_by_differences(const std::function<Vector3(double, double)>& p, double u, double v) {
    const double h = 1e-3;
    const Vector3 pu = (p(u + h, v) - p(u - h, v)) / (2 * h), pv = (p(u, v + h) - p(u, v - h)) / (2 * h);
    const Vector3 puu = (p(u + h, v) - 2 * p(u, v) + p(u - h, v)) / (h * h), pvv = (p(u, v + h) - 2 * p(u, v) + p(u, v - h)) / (h * h);
    const Vector3 puv = (p(u + h, v + h) - p(u + h, v - h) - p(u - h, v + h) + p(u - h, v - h)) / (4 * h * h);
    const Vector3 n = pu.cross(pv).normalized();
    const double E = pu.dot(pu), F = pu.dot(pv), G = pv.dot(pv), e = puu.dot(n), f = puv.dot(n), g = pvv.dot(n);
    return {-(e * G - 2 * f * F + g * E) / (2 * (E * G - F * F)), (e * g - f * f) / (E * G - F * F)};
}

void expect_equal(const CurvaturePair& a, const CurvaturePair& b) {
    EXPECT_NEAR(a.H, b.H, 1e-5);
    EXPECT_NEAR(a.K, b.K, 1e-5);
}

TEST(AnalyticSurfaces, EllipsoidOfEqualAxesIsASphere) {
    const Vector3 p = 2 * Vector3(0.3, -0.8, 0.5).normalized();
    EXPECT_NEAR(ellipsoid_curvature({2, 2, 2}, p).H, sphere_curvature(2).H, 1e-15);
    EXPECT_NEAR(ellipsoid_curvature({2, 2, 2}, p).K, sphere_curvature(2).K, 1e-15);
}

// The distance h of the tangent plane from the centre knows nothing of (u, v): an oracle for the fundamental forms.
TEST(AnalyticSurfaces, EllipsoidAgreesWithItsFundamentalForms) {
    const Ellipsoid ellipsoid{1.7, 1.1, 0.6};
    NormalNumbers random(5);
    for (int i = 0; i < 100; ++i) {
        const double u = 2 * pi * random.uniform(), v = 0.02 + (pi - 0.04) * random.uniform();
        const FundamentalForms forms = ellipsoid_forms(ellipsoid, u, v);
        const CurvaturePair oracle = ellipsoid_curvature({1.7, 1.1, 0.6}, ellipsoid_point(ellipsoid, u, v));
        EXPECT_NEAR(mean_curvature(forms) / oracle.H, 1, 1e-11);
        EXPECT_NEAR(gaussian_curvature(forms) / oracle.K, 1, 1e-11);
    }
}

TEST(AnalyticSurfaces, TorusAtItsOuterInnerAndTopCircle) {
    const double R = 2, r = 0.5;
    EXPECT_NEAR(torus_curvature(R, r, {R + r, 0, 0}).H, 0.5 * (1 / r + 1 / (R + r)), 1e-15);
    EXPECT_NEAR(torus_curvature(R, r, {R + r, 0, 0}).K, 1 / (r * (R + r)), 1e-15);
    EXPECT_NEAR(torus_curvature(R, r, {0, R - r, 0}).H, 0.5 * (1 / r - 1 / (R - r)), 1e-15);
    EXPECT_NEAR(torus_curvature(R, r, {0, R - r, 0}).K, -1 / (r * (R - r)), 1e-15);
    EXPECT_NEAR(torus_curvature(R, r, {0, -R, r}).H, 0.5 / r, 1e-15);
    EXPECT_NEAR(torus_curvature(R, r, {0, -R, r}).K, 0, 1e-15);
}

// ∫K dA = ∬ cos v du dv = 0 for the torus, by the trapezoidal rule, which is exact for it.
TEST(AnalyticSurfaces, TotalCurvatureOfTheTorusVanishes) {
    const double R = 2, r = 0.5;
    double total = 0;
    for (int i = 0; i < 16; ++i) {
        const double v = 2 * pi * i / 16;
        const double rho = R + r * std::cos(v);
        total += torus_curvature(R, r, {rho, 0, r * std::sin(v)}).K * r * rho;
    }
    EXPECT_NEAR(total, 0, 1e-14);
}

TEST(AnalyticSurfaces, ClosedFormsAgreeWithFiniteDifferences) {
    const auto catenoid = [](double u, double v) {
        const double rho = 0.7 * std::cosh(v / 0.7);
        return Vector3(rho * std::cos(u), rho * std::sin(u), v);
    };
    const auto cylinder = [](double u, double v) { return Vector3(2 * std::cos(u), 2 * std::sin(u), v); };
    const Saddle saddle{1.3, 0.6};
    const auto graph = [&](double x, double y) { return Vector3(x, y, saddle.height(x, y)); };
    for (const double u : {0.1, 1.7, 4.0}) {
        for (const double v : {-0.6, 0.0, 0.8}) {
            expect_equal(catenoid_curvature(0.7, catenoid(u, v)), curvature_by_differences(catenoid, u, v));
            expect_equal(cylinder_curvature(2), curvature_by_differences(cylinder, u, v));
            expect_equal(saddle.curvature_at(graph(u, v)), curvature_by_differences(graph, u, v));
        }
    }
}

TEST(AnalyticSurfaces, NormalsAreAcrossBothTangents) {
    const Saddle saddle{1.3, 0.6};
    const double h = 1e-6;
    for (const double u : {0.3, 1.1}) {
        const auto catenoid = [](double a, double v) { return Vector3(std::cosh(v) * std::cos(a), std::cosh(v) * std::sin(a), v); };
        const auto graph = [&](double x, double y) { return Vector3(x, y, saddle.height(x, y)); };
        const Vector3 n = catenoid_normal(1, catenoid(u, 0.5)), m = saddle.normal_at(graph(u, 0.5));
        EXPECT_NEAR(n.dot(catenoid(u + h, 0.5) - catenoid(u - h, 0.5)) / h, 0, 1e-8);
        EXPECT_NEAR(n.dot(catenoid(u, 0.5 + h) - catenoid(u, 0.5 - h)) / h, 0, 1e-8);
        EXPECT_NEAR(m.dot(graph(u + h, 0.5) - graph(u - h, 0.5)) / h, 0, 1e-8);
        EXPECT_NEAR(m.dot(graph(u, 0.5 + h) - graph(u, 0.5 - h)) / h, 0, 1e-8);
        EXPECT_NEAR(n.norm(), 1, 1e-14);
        EXPECT_GT(m.z(), 0);
    }
}

TEST(AnalyticSurfaces, MeshesAreManifoldAndClosedWherePeriodic) {
    const auto round = [](double s, double t) { return Vector3(std::cos(2 * M_PI * s), std::sin(2 * M_PI * s), t); };
    const MeshTopology tube = topology_of(parameter_mesh(8, 5, true, round));
    EXPECT_TRUE(tube.oriented_manifold);
    EXPECT_EQ(tube.boundary_edge_count(), 16);
    const TriangleMesh sheet = parameter_mesh(4, 5, false, [](double s, double t) { return Vector3(s, t, 0); });
    EXPECT_EQ(topology_of(sheet).boundary_edge_count(), 14);
    EXPECT_NEAR(surface_area(sheet), 1, 1e-14);
    EXPECT_GT(face_normals(sheet).col(2).minCoeff(), 0.9);   // counter-clockwise from above
}

}   // namespace
}   // namespace meshfolio
