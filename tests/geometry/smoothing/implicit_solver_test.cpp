#include "geometry/smoothing/implicit_solver.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/stability.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

constexpr double nothing_fits = 1;   // byte

SmoothingOptions implicit_options(double lambda, int iterations, double memory_limit = 0) {
    SmoothingOptions options;
    options.scheme = SmoothingScheme::implicit_euler;
    options.lambda = lambda;
    options.iterations = iterations;
    options.memory_limit = memory_limit;
    return options;
}

}   // namespace

TEST(ImplicitSolver, ConjugateGradientsEqualTheFactor) {
    for (const TriangleMesh& mesh : {lopsided_ellipsoid(4), irregular_plane(30), with_unreferenced_vertex(irregular_sphere(3), {4, 5, 6}),
                                     side_by_side(icosphere(2), moved_by(irregular_sphere(3), {3, 0, 0}))}) {
        const double diagonal = (mesh.X.colwise().maxCoeff() - mesh.X.colwise().minCoeff()).norm();
        for (const double times : {0.5, 30.0, 1e4}) {
            const double lambda = times * critical_step(mesh);
            const Smoothed direct = smooth(mesh, implicit_options(lambda, 5));
            const Smoothed by_gradients = smooth(mesh, implicit_options(lambda, 5, nothing_fits));
            EXPECT_EQ(direct.solver, LinearSolver::direct);
            EXPECT_EQ(direct.solver_iterations, 0);
            EXPECT_EQ(by_gradients.solver, LinearSolver::conjugate_gradients);
            EXPECT_GE(by_gradients.solver_iterations, 5);
            EXPECT_LT(by_gradients.factor_nonzeros, direct.factor_nonzeros);
            EXPECT_LT(largest_difference(direct.X, by_gradients.X), 1e-8 * diagonal) << times;
        }
    }
}

/// The residual of a step bounds its error: M − λC ≥ M.
TEST(ImplicitSolver, ConjugateGradientsKeepTheirBound) {
    const TriangleMesh mesh = lopsided_ellipsoid(4);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const OperatorWithMass whole = operator_with_mass(laplacian);
    const double lambda = 200 * critical_step(mesh);
    const Positions exact = implicit_step(laplacian, lambda, mesh.X);
    ImplicitSolver solver;
    solver.prepare(whole, lambda, nothing_fits);
    const Positions X = solver.step(mesh.X);
    const auto norms = [&](const Positions& Y) { return (laplacian.M.asDiagonal() * Y.cwiseAbs2()).colwise().sum().cwiseSqrt().eval(); };
    const Eigen::RowVector3d error = norms(X - exact), size = norms(mesh.X);
    for (int c = 0; c < 3; ++c) EXPECT_LT(error[c], 1.01 * ImplicitSolver::tolerance * size[c]);
    EXPECT_EQ(solver.work().iterations, [&] {
        ImplicitSolver again;
        again.prepare(whole, lambda, nothing_fits);
        again.step(mesh.X);
        return again.work().iterations;
    }());
}

TEST(ImplicitSolver, BothSolversKeepTheBarycentreAndTheConstant) {
    const TriangleMesh mesh = lopsided_ellipsoid(3);
    const Vector M = laplace_beltrami(mesh).M;
    const double lambda = 20 * critical_step(mesh);
    for (const double limit : {0.0, nothing_fits}) {
        const Positions X = smooth(mesh, implicit_options(lambda, 10, limit)).X;
        EXPECT_LT((M.transpose() * (X - mesh.X)).norm() / M.sum(), limit == 0 ? 1e-13 : 1e-9);
    }
    Positions flat(mesh.vertex_count(), 3);
    flat.rowwise() = Eigen::RowVector3d(1, -2, 3);
    ImplicitSolver solver;
    solver.prepare(operator_with_mass(laplace_beltrami(mesh)), lambda, nothing_fits);
    EXPECT_LT(largest_difference(solver.step(flat), flat), 1e-9);
    EXPECT_EQ(solver.work().iterations, 0) << "the start is the solution";
}

// The factor is made in the least memory that holds it, to the byte.
TEST(ImplicitSolver, AFactorThatJustFitsIsMade) {
    const TriangleMesh mesh = irregular_sphere(3);
    const OperatorWithMass whole = operator_with_mass(laplace_beltrami(mesh));
    const auto solver_within = [&](double bytes) {
        ImplicitSolver solver;
        solver.prepare(whole, 1, bytes);
        return solver.solver();
    };
    double too_little = nothing_fits, enough = 1e12;
    while (std::nextafter(too_little, enough) < enough) {
        const double between = too_little + (enough - too_little) / 2;
        (solver_within(between) == LinearSolver::direct ? enough : too_little) = between;
    }
    EXPECT_EQ(enough, std::round(enough)) << "what is needed is a whole number of bytes";
}

TEST(ImplicitSolver, ASweepOverLambdaIsAnalysedOnce) {
    const TriangleMesh mesh = lopsided_ellipsoid(3);
    const double step = critical_step(mesh);
    for (const double limit : {0.0, nothing_fits}) {
        ImplicitSolver solver;
        int factorisations = 0;
        for (const double times : {0.5, 5.0, 50.0, 1000.0}) {
            const SmoothingOptions options = implicit_options(times * step, 3, limit);
            const Smoothed swept = smooth(mesh, options, solver);
            EXPECT_EQ(swept.analyses, factorisations == 0 ? 1 : 0);
            EXPECT_EQ(swept.factorisations, 1);
            EXPECT_EQ(solver.work().factorisations, ++factorisations);
            EXPECT_EQ(swept.X, smooth(mesh, options).X) << "as with a solver of its own";
        }
        EXPECT_EQ(solver.work().analyses, 1);
    }
}

TEST(ImplicitSolver, TheFactorIsKeptForTheSameOperatorOnly) {
    const TriangleMesh mesh = lopsided_ellipsoid(2), moved = {mesh.X + 1e-3 * mesh.X.cwiseAbs2(), mesh.F};
    const SmoothingOptions options = implicit_options(10 * critical_step(mesh), 2);
    ImplicitSolver solver;
    const Positions X = smooth(mesh, options, solver).X;
    EXPECT_EQ(smooth(mesh, options, solver).X, X);
    EXPECT_EQ(solver.work().factorisations, 1);
    EXPECT_LT(largest_difference(smooth(moved, options, solver).X, smooth(moved, options).X), 1e-13);
    EXPECT_EQ(solver.work().analyses, 1) << "same triangles";
    EXPECT_EQ(solver.work().factorisations, 2);
    EXPECT_LT(largest_difference(smooth(irregular_sphere(2), options, solver).X, smooth(irregular_sphere(2), options).X), 1e-13);
    const TriangleMesh other = irregular_plane(9);
    EXPECT_LT(largest_difference(smooth(other, options, solver).X, smooth(other, options).X), 1e-13);
    EXPECT_GE(solver.work().analyses, 2) << "other triangles";
    const int n = other.vertex_count();
    const int analyses = solver.work().analyses;
    TriangleMesh turned = other;   // as many vertices and entries, joined otherwise
    for (int v = 0; v < n; ++v) turned.X.row((v + 5) % n) = other.X.row(v);
    for (Eigen::Index i = 0; i < turned.F.size(); ++i) turned.F.data()[i] = (turned.F.data()[i] + 5) % n;
    EXPECT_LT(largest_difference(smooth(turned, options, solver).X, smooth(turned, options).X), 1e-13);
    EXPECT_EQ(solver.work().analyses, analyses + 1);
    const Smoothed refused = smooth(other, implicit_options(options.lambda, 2, nothing_fits), solver);
    EXPECT_EQ(refused.solver, LinearSolver::conjugate_gradients) << "also with a factor at hand";
    EXPECT_EQ(smooth(other, options, solver).solver, LinearSolver::direct);
}

// The barycentre is kept, or the step is refused: one vertex close beside its neighbour makes roundings larger than the masses although
// every pivot stays positive.
TEST(ImplicitSolver, AStepWhoseRoundingReachesTheMassesIsRefused) {
    TriangleMesh mesh = grid_mesh(9, 9, 1, 1);
    constexpr int middle = 40;
    mesh.X.row(middle) = 1e-4 * mesh.X.row(middle) + (1 - 1e-4) * mesh.X.row(middle + 1);
    const OperatorWithMass whole = operator_with_mass(laplace_beltrami(mesh));
    const auto barycentre = [&](const Positions& X) { return Vector3(X.transpose() * whole.M / whole.M.sum()); };
    int refused = 0;
    for (int power = 1; power <= 21; ++power) {
        ImplicitSolver solver;
        try {
            solver.prepare(whole, std::pow(10.0, power));
        } catch (const SolverError&) {
            ++refused;
            continue;
        }
        EXPECT_LT((barycentre(solver.step(mesh.X)) - barycentre(mesh.X)).norm(), 0.01) << power;
    }
    EXPECT_GE(refused, 10);
    EXPECT_LE(refused, 16);
}

TEST(ImplicitSolver, ARebuiltOperatorIsAnalysedOnce) {
    SmoothingOptions options = implicit_options(0.01, 6);
    options.rebuild = true;
    const Smoothed rebuilt = smooth(irregular_sphere(3), options);
    EXPECT_EQ(rebuilt.analyses, 1);
    EXPECT_EQ(rebuilt.factorisations, 6);
}

TEST(ImplicitSolver, ThreadsDoNotChangeABitOfSeveralBlocks) {
    const TriangleMesh mesh = lopsided_ellipsoid(6);
    const double lambda = 20 * critical_step(mesh);
    std::vector<Positions> results;
    for (const double limit : {0.0, nothing_fits}) {
        const SmoothingOptions options = implicit_options(lambda, 2, limit);
        const Smoothed smoothed = smooth(mesh, options);
        // Below half of the bound ½√κ ln(2√κ/10⁻¹¹), κ = 1 + 2·20, that holds without the preconditioner.
        EXPECT_LT(smoothed.solver_iterations, 2 * 45);
        results.push_back(smoothed.X);
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        EXPECT_EQ(smooth(mesh, options).X, results.back());
    }
    EXPECT_LT(largest_difference(results[0], results[1]), 1e-9);
}
