#include "questions/bench/bench_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/curvature/analytic_surfaces.h"
#include "geometry/linear/special_values.h"
#include "mesh/samples/sample_shapes.h"

namespace meshfolio {

namespace {

constexpr double torus_R = 1, torus_r = 0.4;
constexpr double cylinder_r = 1, cylinder_length = 4;
constexpr double catenoid_c = 1, catenoid_length = 3;
constexpr Saddle graph{1.2, 0.8};
const Vector3 axes(1.5, 1.0, 0.75);   // of the ellipsoid and its band

Vector3 around_axis(double turns, double radius, double z) {
    return {radius * std::cos(2 * pi * turns), radius * std::sin(2 * pi * turns), z};
}

Vector3 radial(const Vector3& p) { return Vector3(p.x(), p.y(), 0).normalized(); }

/// Returns a function that makes grids closed around the z axis. `point` takes the turn and the share of the length, from 0 to 1.
template <class Point> auto tube(const Point& point) {
    return [point](int around, int along) { return parameter_mesh(around, along + 1, true, point); };
}

KnownSurface sphere() {
    KnownSurface sphere = ellipsoid_surface(Vector3::Ones());
    sphere.name = "sphere";
    sphere.dimensions = curvature_words.line("dimensions.sphere");
    sphere.mesh_at = [](int level) { return icosphere(level); };
    sphere.projected = sphere.normal_at = [](const Vector3& p) { return Vector3(p.normalized()); };
    sphere.curvature_at = [](const Vector3&) { return sphere_curvature(1); };
    return sphere;
}

KnownSurface ellipsoid() {
    KnownSurface ellipsoid = ellipsoid_surface(axes);
    ellipsoid.name = "ellipsoid";
    ellipsoid.dimensions = curvature_words.line("dimensions.ellipsoid");
    return ellipsoid;
}

/// Returns the ellipsoid between 45° and 135° from its z axis as a grid, regular everywhere unlike the stretched icosphere.
KnownSurface ellipsoid_band() {
    const auto mesh = tube([](double s, double t) {
        const double v = pi * (0.75 - 0.5 * t);
        return Vector3(axes.cwiseProduct(around_axis(s, std::sin(v), std::cos(v))));
    });
    KnownSurface band = ellipsoid_surface(axes);
    band.name = "ellipsoid band";
    band.dimensions = curvature_words.line("dimensions.ellipsoid_band");
    band.mesh_at = [=](int level) { return mesh(8 << level, 2 << level); };
    band.stretched_at = [=](int level) { return mesh(4 << level, 4 << level); };
    band.half_axes.setZero();
    return band;
}

KnownSurface torus() {
    const auto tube_centre = [](const Vector3& p) { return Vector3(torus_R * radial(p)); };
    return {.name = "torus",
            .dimensions = curvature_words.line("dimensions.torus"),
            .mesh_at = [](int level) { return torus_mesh(4 << level, 2 << level, torus_R, torus_r); },
            .stretched_at = [](int level) { return torus_mesh(2 << level, 4 << level, torus_R, torus_r); },
            .projected = [=](const Vector3& p) { return Vector3(tube_centre(p) + torus_r * (p - tube_centre(p)).normalized()); },
            .normal_at = [=](const Vector3& p) { return Vector3((p - tube_centre(p)).normalized()); },
            .curvature_at = [](const Vector3& p) { return torus_curvature(torus_R, torus_r, p); }};
}

KnownSurface cylinder() {
    const auto mesh = tube([](double s, double t) { return around_axis(s, cylinder_r, cylinder_length * (t - 0.5)); });
    return {.name = "cylinder",
            .dimensions = curvature_words.line("dimensions.cylinder"),
            .mesh_at = [=](int level) { return mesh(4 << level, 3 << level); },
            .stretched_at = [=](int level) { return mesh(2 << level, 6 << level); },
            .projected = [](const Vector3& p) { return Vector3(cylinder_r * radial(p) + p.z() * Vector3::UnitZ()); },
            .normal_at = radial,
            .curvature_at = [](const Vector3&) { return cylinder_curvature(cylinder_r); }};
}

KnownSurface catenoid() {
    const auto radius = [](double z) { return catenoid_c * std::cosh(z / catenoid_c); };
    const auto mesh = tube([=](double s, double t) {
        const double z = catenoid_length * (t - 0.5);
        return around_axis(s, radius(z), z);
    });
    return {.name = "catenoid",
            .dimensions = curvature_words.line("dimensions.catenoid"),
            .mesh_at = [=](int level) { return mesh(4 << level, 2 << level); },
            .stretched_at = [=](int level) { return mesh(2 << level, 5 << level); },
            .projected = [=](const Vector3& p) { return Vector3(radius(p.z()) * radial(p) + p.z() * Vector3::UnitZ()); },
            .normal_at = [](const Vector3& p) { return catenoid_normal(catenoid_c, p); },
            .curvature_at = [](const Vector3& p) { return catenoid_curvature(catenoid_c, p); }};
}

KnownSurface saddle() {
    const auto lifted = [](const Vector3& p) { return Vector3(p.x(), p.y(), graph.height(p.x(), p.y())); };
    const auto mesh = [=](int nx, int ny) {
        return parameter_mesh(nx + 1, ny + 1, false, [=](double s, double t) { return lifted({2 * s - 1, 2 * t - 1, 0}); });
    };
    return {.name = "saddle",
            .dimensions = curvature_words.line("dimensions.saddle"),
            .mesh_at = [=](int level) { return mesh(4 << level, 4 << level); },
            .stretched_at = [=](int level) { return mesh(8 << level, 2 << level); },
            .projected = lifted,
            .normal_at = [](const Vector3& p) { return graph.normal_at(p); },
            .curvature_at = [](const Vector3& p) { return graph.curvature_at(p); }};
}

}   // namespace

KnownSurface ellipsoid_surface(const Vector3& half_axes) {
    return {.mesh_at = [=](int level) { return ellipsoid_mesh(level, half_axes); },
            // The points of the icosphere are drawn towards the equator plane, where it is stretched four to one.
            .stretched_at =
                [=](int level) {
                    TriangleMesh mesh = icosphere(level);
                    mesh.X.col(2) *= 0.25;
                    mesh.X.rowwise().normalize();
                    mesh.X.array().rowwise() *= half_axes.transpose().array();
                    return mesh;
                },
            .projected = [=](const Vector3& p) { return Vector3(p / p.cwiseQuotient(half_axes).norm()); },
            .normal_at = [=](const Vector3& p) { return Vector3(p.cwiseQuotient(half_axes.cwiseAbs2()).normalized()); },
            .curvature_at = [=](const Vector3& p) { return ellipsoid_curvature(half_axes, p); },
            .half_axes = half_axes};
}

std::vector<KnownSurface> known_surfaces() { return {sphere(), ellipsoid(), ellipsoid_band(), torus(), cylinder(), catenoid(), saddle()}; }

KnownSurface known_surface(const std::string& name) {
    std::vector<KnownSurface> surfaces = known_surfaces();
    const auto found = std::ranges::find(surfaces, name, &KnownSurface::name);
    if (found == surfaces.end()) throw std::logic_error("no known surface has the name '" + name + "'");
    return std::move(*found);
}

}   // namespace meshfolio
