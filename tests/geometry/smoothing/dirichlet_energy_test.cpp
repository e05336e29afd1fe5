#include "geometry/smoothing/dirichlet_energy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/operator_test_meshes.h"
#include "geometry/solver_test_meshes.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

using namespace testing;

/// A grid with one vertex a little beside the edge that it cuts: a cap of that height, with cotangents that are the inverse of it.
TriangleMesh grid_with_cap(double height) {
    TriangleMesh mesh = grid_mesh(8, 8, 1, 1);
    const int a = mesh.F(40, 0), b = mesh.F(40, 1), c = mesh.F(40, 2);
    const int cap = mesh.vertex_count();
    Positions X(cap + 1, 3);
    X << mesh.X, 0.5 * (mesh.X.row(a) + mesh.X.row(b)) + height * (mesh.X.row(c) - mesh.X.row(a));
    Faces F(mesh.F.rows() + 2, 3);
    F << mesh.F, Eigen::RowVector3i(cap, b, c), Eigen::RowVector3i(a, b, cap);
    F.row(40) << a, cap, c;
    return {X, F};
}

struct WatchedRun {
    std::vector<double> energy, rounding;
    double largest_rise() const {
        double rise = -INFINITY;
        for (std::size_t t = 1; t < energy.size(); ++t) rise = std::max(rise, energy[t] - energy[t - 1]);
        return rise;
    }
    bool within_rounding() const {
        for (std::size_t t = 1; t < energy.size(); ++t)
            if (!(energy[t] - energy[t - 1] <= rounding[t])) return false;
        return true;
    }
};

/// The energy of a run; `spoil` may change the positions after a step.
template <class Spoil> WatchedRun watched(const TriangleMesh& mesh, SmoothingScheme scheme, double share_of_limit, int steps, Spoil spoil) {
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const double lambda = share_of_limit * critical_step(mesh);
    EnergyWatch watch(laplacian, scheme, lambda, mesh.X);
    Positions X = mesh.X;
    for (int t = 1; t <= steps; ++t) {
        X = scheme == SmoothingScheme::implicit_euler ? implicit_step(laplacian, lambda, X) : explicit_step(laplacian, lambda, X);
        spoil(t, X);
        watch.look(X);
    }
    return {watch.energy(), watch.rounding()};
}

WatchedRun watched(const TriangleMesh& mesh, SmoothingScheme scheme, double share_of_limit, int steps) {
    return watched(mesh, scheme, share_of_limit, steps, [](int, Positions&) {});
}

constexpr SmoothingScheme schemes[] = {SmoothingScheme::explicit_euler, SmoothingScheme::implicit_euler};

}   // namespace

TEST(DirichletEnergy, OfTheMeshItselfIsItsArea) {
    for (const TriangleMesh& mesh : {irregular_sphere(3), grid_mesh(5, 7, 1, 2), grid_with_cap(1e-6)})
        EXPECT_NEAR(dirichlet_energy(laplace_beltrami(mesh).C, mesh.X) / surface_area(mesh), 1, 1e-9);
}

TEST(EnergyWatch, RoundingIsSmallOnSoundMeshesWhereverTheyLie) {
    for (const SmoothingScheme scheme : schemes) {
        const WatchedRun run = watched(irregular_sphere(3), scheme, 0.9, 10);
        EXPECT_TRUE(run.within_rounding());
        for (const double rounding : run.rounding) EXPECT_LT(rounding / run.energy.front(), 1e-12);
        EXPECT_TRUE(watched(moved_by(irregular_sphere(3), {1e5, 0, 0}), scheme, 0.9, 10).within_rounding());
    }
}

TEST(EnergyWatch, ARiseOfABillionthIsMoreThanRounding) {
    for (const SmoothingScheme scheme : schemes) {
        const TriangleMesh mesh = irregular_sphere(3);
        const WatchedRun run = watched(mesh, scheme, 1e-9, 3, [&](int t, Positions& X) {
            if (t == 2) X = X * (1 + 0.5e-9);   // areas grow by a billionth; steps this small take nothing away
        });
        EXPECT_NEAR(run.largest_rise() / run.energy.front(), 1e-9, 1e-11);
        EXPECT_FALSE(run.within_rounding());
    }
}

// Weights of 1/height nearly cancel in every sum.
TEST(EnergyWatch, CapsRaiseTheEnergyByNoMoreThanTheirRounding) {
    for (const double height : {1e-3, 1e-6, 1e-9, 1e-11}) {
        for (const SmoothingScheme scheme : schemes)
            EXPECT_TRUE(watched(grid_with_cap(height), scheme, 0.95, 30).within_rounding()) << height;
    }
}

TEST(EnergyWatch, AnUnstableRunRisesBeyondIt) {
    EXPECT_FALSE(watched(irregular_sphere(2), SmoothingScheme::explicit_euler, 1.5, 60).within_rounding());
}

}   // namespace meshfolio
