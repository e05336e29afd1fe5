#include "geometry/smoothing/laplacian_smoothing.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "base/errors.h"
#include "geometry/operators/uniform_laplacian.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "geometry/spectrum/stability.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

constexpr SmoothingScheme all_schemes[] = {SmoothingScheme::explicit_euler, SmoothingScheme::implicit_euler, SmoothingScheme::taubin};

SmoothingOptions options_of(SmoothingScheme scheme, double lambda, int iterations) {
    SmoothingOptions options;
    options.scheme = scheme;
    options.lambda = lambda;
    options.iterations = iterations;
    return options;
}

/// |ĉ_j| after smoothing over that before, for every mode j of the input's own operator.
struct Damping {
    Vector mu, measured;
    double taubin_mu = 0;
};
Damping damping_of(const SmoothingOptions& options) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);   // without symmetry: its coordinates have a part in every mode
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const Spectrum spectrum = smallest_eigenpairs(laplacian, 1000);
    const Smoothed smoothed = smooth(mesh, options);
    const DenseMatrix W = laplacian.M.asDiagonal() * spectrum.eigenvectors;
    return {spectrum.eigenvalues, (W.transpose() * smoothed.X).rowwise().norm().cwiseQuotient((W.transpose() * mesh.X).rowwise().norm()),
            smoothed.taubin_mu};
}

void expect_damping(const Damping& damping, const std::function<double(double)>& law) {
    for (Eigen::Index j = 0; j < damping.mu.size(); ++j) {
        EXPECT_NEAR(damping.measured[j], std::abs(law(damping.mu[j])), 1e-9) << "mode " << j << ", mu " << damping.mu[j];
    }
}

Eigen::RowVector3d mass_centre(const Vector& M, const Positions& X) { return M.transpose() * X / M.sum(); }

}   // namespace

TEST(LaplacianSmoothing, ExplicitDampsEachModeByOneMinusLambdaMu) {
    const double lambda = 0.9 * critical_step(lopsided_ellipsoid(2));
    expect_damping(damping_of(options_of(SmoothingScheme::explicit_euler, lambda, 7)),
                   [&](double mu) { return std::pow(1 - lambda * mu, 7); });
}

TEST(LaplacianSmoothing, ImplicitDampsEachModeByOneOverOnePlusLambdaMu) {
    for (const double share : {0.5, 30.0}) {
        const double lambda = share * critical_step(lopsided_ellipsoid(2));
        expect_damping(damping_of(options_of(SmoothingScheme::implicit_euler, lambda, 5)),
                       [&](double mu) { return std::pow(1 + lambda * mu, -5); });
    }
}

TEST(LaplacianSmoothing, TaubinPassesLowModesAndDampsHighOnes) {
    const LargestEigenvalue top = largest_eigenvalue(laplace_beltrami(lopsided_ellipsoid(2)));
    SmoothingOptions options = options_of(SmoothingScheme::taubin, 0.6 * largest_stable_step(top), 4);
    const Damping by_pass_band = damping_of(options);
    EXPECT_LT(by_pass_band.taubin_mu, -options.lambda);
    EXPECT_NEAR(1 / options.lambda + 1 / by_pass_band.taubin_mu, 0.05 * top.value, 1e-10 * top.value) << "the pass-band";
    const auto law = [&](double m) { return [&options, m](double mu) { return std::pow((1 - options.lambda * mu) * (1 - m * mu), 4); }; };
    expect_damping(by_pass_band, law(by_pass_band.taubin_mu));
    options.taubin_mu = -1.05 * options.lambda;
    const Damping given = damping_of(options);
    EXPECT_DOUBLE_EQ(given.taubin_mu, options.taubin_mu);
    expect_damping(given, law(options.taubin_mu));
}

// f(μ) = (1 − λμ)(1 − mμ), sampled finely: 1 + (λ + m)²/(4λ|m|) at (1/λ + 1/m)/2 where |m| > λ, and the end of the spectrum beyond.
TEST(LaplacianSmoothing, TaubinGrowthIsTheLargestFactorOverTheSpectrum) {
    const LaplaceBeltrami laplacian = laplace_beltrami(lopsided_ellipsoid(2));
    const double top = largest_eigenvalue(laplacian).value;
    for (const double share : {0.1, 0.5, 0.9, 1.4}) {
        for (const double back : {-0.5, -1.0, -1.01, -1.05, -1.3}) {
            const SmoothingOptions options{.lambda = share / top, .taubin_mu = back * share / top};
            const TaubinGrowth growth = taubin_growth(laplacian, options);
            double largest = 0;
            for (int i = 0; i <= 20000; ++i) {
                const double mu = top * i / 20000;
                largest = std::max(largest, std::abs((1 - options.lambda * mu) * (1 - options.taubin_mu * mu)));
            }
            EXPECT_GE(growth.factor, largest * (1 - 1e-12));
            EXPECT_LT(growth.factor, largest + 1e-6);
            EXPECT_NEAR(std::abs((1 - options.lambda * growth.mu) * (1 - options.taubin_mu * growth.mu)), growth.factor, 1e-12);
            const double middle = 0.5 * (1 / options.lambda + 1 / options.taubin_mu);
            if (!growth.of_highest_mode && back < -1 && middle < top) {
                EXPECT_NEAR(growth.factor, 1 + std::pow(1 + back, 2) / (4 * -back), 1e-12);
                EXPECT_TRUE(growth.warning(1).empty());
                EXPECT_FALSE(growth.warning(1000000).empty());
            }
            if (!growth.of_highest_mode && back >= -1) {
                EXPECT_TRUE(growth.warning(1000000).empty()) << "nothing is raised";
            }
            if (growth.of_highest_mode && growth.factor > 1) {
                EXPECT_NE(growth.warning(1).find("highest mode"), std::string::npos);
            }
        }
    }
}

// The volume of a sphere is that of low modes: the run swells as the warning says, and keeps its volume where there is none.
TEST(LaplacianSmoothing, TaubinRunsThatSwellGiveAWarning) {
    const TriangleMesh mesh = irregular_sphere(3);
    SmoothingOptions options = options_of(SmoothingScheme::taubin, 0.5 * critical_step(mesh), 3000);
    const auto volume_after = [&] {
        return signed_volume(moved_to(mesh, smooth(mesh, options).X), Vector3::Zero()) / signed_volume(mesh, Vector3::Zero());
    };
    const TaubinGrowth growth = taubin_growth(laplace_beltrami(mesh), options);
    EXPECT_GT(volume_after(), 1.15);
    EXPECT_LT(volume_after(), std::pow(growth.factor, 3 * options.iterations));
    EXPECT_FALSE(growth.warning(options.iterations).empty());
    options.iterations = 20;
    EXPECT_NEAR(volume_after(), 1, 0.05);
    EXPECT_TRUE(growth.warning(options.iterations).empty());
}

TEST(LaplacianSmoothing, UniformStepsSolveTheirEquations) {
    const TriangleMesh mesh = side_by_side(irregular_sphere(2), moved_by(irregular_plane(6), {4, 0, 0}));
    const SparseMatrix U = uniform_laplacian(topology_of(mesh));
    SmoothingOptions options = options_of(SmoothingScheme::explicit_euler, 0.7, 1);
    options.laplacian = OperatorKind::uniform;
    EXPECT_LT((smooth(mesh, options).X - (mesh.X + 0.7 * (U * mesh.X))).cwiseAbs().maxCoeff(), 1e-14);
    options.scheme = SmoothingScheme::implicit_euler;
    for (const double lambda : {0.7, 50.0}) {
        options.lambda = lambda;
        const Positions X = smooth(mesh, options).X;
        EXPECT_LT((X - lambda * (U * X) - mesh.X).cwiseAbs().maxCoeff(), 1e-13 * lambda);
    }
}

TEST(LaplacianSmoothing, SingleStepsAreOneIteration) {
    const TriangleMesh mesh = irregular_sphere(2);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const double lambda = 0.5 * critical_step(mesh);
    EXPECT_LT((explicit_step(laplacian, lambda, mesh.X) - smooth(mesh, options_of(SmoothingScheme::explicit_euler, lambda, 1)).X).norm(),
              1e-14);
    EXPECT_LT((implicit_step(laplacian, lambda, mesh.X) - smooth(mesh, options_of(SmoothingScheme::implicit_euler, lambda, 1)).X).norm(),
              1e-13);
    EXPECT_THROW(explicit_step(laplacian, lambda, icosphere(1).X), MeshError);
    EXPECT_THROW(implicit_step(laplacian, lambda, icosphere(1).X), MeshError);
}

TEST(LaplacianSmoothing, ImplicitIsStableAtAnyStep) {
    for (const TriangleMesh& mesh : {irregular_sphere(3), irregular_plane(15), cube_mesh(6)}) {
        const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
        const double lambda = 1e6 * critical_step(mesh);
        const Smoothed smoothed = smooth(mesh, options_of(SmoothingScheme::implicit_euler, lambda, 3));
        EXPECT_FALSE(smoothed.blew_up);
        EXPECT_EQ(smoothed.iterations, 3);
        const Eigen::RowVector3d centre = mass_centre(laplacian.M, mesh.X);
        EXPECT_LT((smoothed.X.rowwise() - centre).cwiseAbs().maxCoeff(), 1e-8) << "all modes but the constant are gone";
    }
}

// 1ᵀMX changes by λ 1ᵀCX = 0.
TEST(LaplacianSmoothing, CentreOfMassStays) {
    const TriangleMesh mesh = side_by_side(lopsided_ellipsoid(2), moved_by(irregular_plane(8), {3, 0, 1}));
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    for (const SmoothingScheme scheme : all_schemes) {
        const Positions X = smooth(mesh, options_of(scheme, 0.6 * critical_step(mesh), 50)).X;
        EXPECT_LT((mass_centre(laplacian.M, X) - mass_centre(laplacian.M, mesh.X)).norm(), 1e-13);
        EXPECT_GT((X - mesh.X).norm(), 0.01) << "it did smooth";
    }
}

TEST(LaplacianSmoothing, MovesAndScalesWithTheMesh) {
    const TriangleMesh mesh = lopsided_ellipsoid(2);
    const double lambda = 0.8 * critical_step(mesh);
    for (const SmoothingScheme scheme : all_schemes) {
        for (const bool rebuild : {false, true}) {
            SmoothingOptions options = options_of(scheme, lambda, 10);
            options.rebuild = rebuild;
            const Positions X = smooth(mesh, options).X;
            EXPECT_LT((smooth(rotated_and_moved(mesh), options).X - rotated_and_moved({X, mesh.F}).X).cwiseAbs().maxCoeff(), 1e-12);
            for (const double s : {1e-9, 1e9}) {
                SmoothingOptions there = options;
                there.lambda = lambda * s * s;
                EXPECT_LT((smooth(scaled(mesh, s), there).X / s - X).cwiseAbs().maxCoeff(), 1e-12) << s;
            }
            const Vector3 far(1e7, -1e7, 1e7);
            const Positions away = smooth(moved_by(mesh, far), options).X;
            EXPECT_LT(((away.rowwise() - far.transpose()) - X).cwiseAbs().maxCoeff(), 1e-7) << "coordinates are rounded at 2e-9";
        }
    }
}

TEST(LaplacianSmoothing, ComponentsAreIndependent) {
    const TriangleMesh a = lopsided_ellipsoid(2), b = moved_by(irregular_plane(8), {4, 0, 0});
    for (const SmoothingScheme scheme : {SmoothingScheme::explicit_euler, SmoothingScheme::implicit_euler}) {
        const SmoothingOptions options = options_of(scheme, 0.5 * critical_step(side_by_side(a, b)), 20);
        const Positions together = smooth(side_by_side(a, b), options).X;
        EXPECT_LT((together.topRows(a.vertex_count()) - smooth(a, options).X).cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_LT((together.bottomRows(b.vertex_count()) - smooth(b, options).X).cwiseAbs().maxCoeff(), 1e-12);
    }
}

TEST(LaplacianSmoothing, UnreferencedVerticesStay) {
    const TriangleMesh mesh = irregular_sphere(2), more = with_unreferenced_vertex(mesh, {1e6, 0.1, -3});
    for (const SmoothingScheme scheme : all_schemes) {
        for (const OperatorKind laplacian : {OperatorKind::cotan, OperatorKind::uniform}) {
            SmoothingOptions options = options_of(scheme, 0.5 * critical_step(mesh), 3);
            options.laplacian = laplacian;
            if (laplacian == OperatorKind::uniform) options.lambda = 0.3;
            const Smoothed smoothed = smooth(more, options);
            EXPECT_EQ(smoothed.X.row(0), more.X.row(0));
            EXPECT_FALSE(smoothed.blew_up) << "where it lies does not matter";
            EXPECT_LT((smoothed.X.bottomRows(mesh.vertex_count()) - smooth(mesh, options).X).cwiseAbs().maxCoeff(), 1e-14);
        }
    }
}

TEST(LaplacianSmoothing, BlowUpIsDiagnosed) {
    const TriangleMesh mesh = irregular_sphere(3);
    const LargestEigenvalue top = largest_eigenvalue(laplace_beltrami(mesh));
    SmoothingOptions options = options_of(SmoothingScheme::explicit_euler, 1.5 * largest_stable_step(top), 1000);
    int calls = 0;
    options.after_step = [&](int iteration, const Positions& X) {
        EXPECT_EQ(iteration, ++calls);
        EXPECT_TRUE(X.allFinite());
        return true;
    };
    const Smoothed smoothed = smooth(mesh, options);
    EXPECT_TRUE(smoothed.blew_up);
    EXPECT_EQ(smoothed.iterations, calls);
    EXPECT_EQ(smoothed.blow_up_iteration, smoothed.iterations) << "beyond the limit, but finite";
    EXPECT_EQ(smoothed.blow_up_vertex, top.vertex) << "the vertex that sets the limit goes first";
    EXPECT_TRUE(smoothed.X.allFinite());
    const double radius = 1e3 * bounding_box(mesh).diagonal();
    EXPECT_GT(smoothed.X.row(top.vertex).norm(), 0.99 * radius);
    // |1 − λμ| = 2: from the mode's share of the mesh to the limit takes a known number of steps.
    const Vector mass = laplace_beltrami(mesh).M;
    const double start = (mesh.X.transpose() * mass.cwiseProduct(top.mode)).norm() * top.mode.maxCoeff();
    EXPECT_NEAR(smoothed.blow_up_iteration, std::log2(radius / start), 1.5);
}

TEST(LaplacianSmoothing, NumbersThatAreNotFiniteAreNotReturned) {
    const TriangleMesh mesh = irregular_sphere(2);
    SmoothingOptions options = options_of(SmoothingScheme::explicit_euler, 1e308, 10);
    options.blow_up_at = 1e307;
    const Smoothed at_once = smooth(mesh, options);
    EXPECT_TRUE(at_once.blew_up);
    EXPECT_EQ(at_once.blow_up_iteration, 1);
    EXPECT_EQ(at_once.iterations, 0);
    EXPECT_EQ(at_once.X, mesh.X);
    EXPECT_GE(at_once.blow_up_vertex, 0);
    options.lambda = 1e100;   // the squares of the third step overflow, the positions do not
    const Smoothed later = smooth(mesh, options);
    EXPECT_EQ(later.iterations, 2);
    EXPECT_TRUE(later.blew_up);
    EXPECT_TRUE(later.X.allFinite());
}

// dr/dt = −2/r: r² = r₀² − 4t when the operator follows the sphere, and exponential decay when it is frozen.
TEST(LaplacianSmoothing, RebuiltOperatorFollowsTheShrinkingSphere) {
    const TriangleMesh sphere = icosphere(3);
    constexpr int steps = 100;
    const double lambda = 0.15 / steps;
    for (const SmoothingScheme scheme : {SmoothingScheme::explicit_euler, SmoothingScheme::implicit_euler}) {
        SmoothingOptions options = options_of(scheme, lambda, steps);
        const double frozen = smooth(sphere, options).X.rowwise().norm().mean();
        options.rebuild = true;
        const Smoothed rebuilt = smooth(sphere, options);
        EXPECT_NEAR(frozen, std::exp(-2 * 0.15), 2e-3);
        EXPECT_NEAR(rebuilt.X.rowwise().norm().mean(), std::sqrt(1 - 4 * 0.15), 1e-2);
        EXPECT_EQ(rebuilt.factorisations, scheme == SmoothingScheme::implicit_euler ? steps : 0);
    }
}

TEST(LaplacianSmoothing, FrozenOperatorIsFactoredOnce) {
    const Smoothed smoothed = smooth(icosphere(2), options_of(SmoothingScheme::implicit_euler, 0.01, 12));
    EXPECT_EQ(smoothed.factorisations, 1);
    EXPECT_GE(smoothed.factor_nonzeros, 162 + 480);
    EXPECT_EQ(smooth(icosphere(2), options_of(SmoothingScheme::explicit_euler, 0.01, 2)).factorisations, 0);
}

TEST(LaplacianSmoothing, StopsWhenAsked) {
    SmoothingOptions options = options_of(SmoothingScheme::implicit_euler, 0.01, 50);
    Positions last;
    options.after_step = [&](int iteration, const Positions& X) {
        last = X;
        return iteration < 4;
    };
    const Smoothed smoothed = smooth(icosphere(2), options);
    EXPECT_EQ(smoothed.iterations, 4);
    EXPECT_EQ(smoothed.X, last);
}

TEST(LaplacianSmoothing, NoIterationsNoChange) {
    const TriangleMesh mesh = moved_by(irregular_sphere(2), {1e7, 0.3, -1e-5});
    for (const SmoothingScheme scheme : all_schemes) EXPECT_EQ(smooth(mesh, options_of(scheme, 1e-3, 0)).X, mesh.X);
}

TEST(LaplacianSmoothing, ThreadsDoNotChangeABit) {
    const TriangleMesh mesh = irregular_sphere(5);   // more rows than one task takes
    const SmoothingOptions options = options_of(SmoothingScheme::explicit_euler, 0.5 * critical_step(mesh), 5);
    const Positions X = smooth(mesh, options).X;
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(smooth(mesh, options).X, X);
}

TEST(LaplacianSmoothing, RefusesImpossibleSettings) {
    const TriangleMesh mesh = icosphere(1);
    for (const double lambda : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_THROW(smooth(mesh, options_of(SmoothingScheme::explicit_euler, lambda, 1)), MeshError);
    }
    EXPECT_THROW(smooth(mesh, options_of(SmoothingScheme::explicit_euler, 1, -1)), MeshError);
    SmoothingOptions taubin = options_of(SmoothingScheme::taubin, 0.01, 1);
    taubin.taubin_mu = 0.02;
    EXPECT_THROW(smooth(mesh, taubin), MeshError);
    EXPECT_THROW(smooth(mesh, options_of(SmoothingScheme::taubin, 1e6, 1)), MeshError) << "no pass-band";
    EXPECT_THROW(smooth({Positions::Zero(3, 3), Faces{{0, 1, 2}}}, options_of(SmoothingScheme::explicit_euler, 1, 1)), MeshError);
}

TEST(LaplacianSmoothing, Names) {
    EXPECT_EQ(smoothing_scheme_named("implicit"), SmoothingScheme::implicit_euler);
    EXPECT_THROW(smoothing_scheme_named("Explicit"), UsageError);
}

// One step at λμ = 1 takes the triangle to its centre: there is no operator to rebuild.
TEST(LaplacianSmoothing, ARebuiltFlowEndsWhereNothingIsLeft) {
    const TriangleMesh mesh = triangle({0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0});
    SmoothingOptions options;
    options.lambda = 0.5 * largest_stable_step(largest_eigenvalue(laplace_beltrami(mesh)));
    options.iterations = 10;
    options.rebuild = true;
    for (const double adaptive : {0.0, 0.95}) {
        options.adaptive = adaptive;
        const Smoothed run = smooth(mesh, options);
        EXPECT_GT(run.collapse_iteration, 1);
        EXPECT_EQ(run.iterations, run.collapse_iteration - 1);
        EXPECT_FALSE(run.blew_up);
        EXPECT_TRUE(run.X.allFinite());
        EXPECT_LT(surface_area({run.X, mesh.F}), 1e-20);
    }
    options.rebuild = false;
    EXPECT_EQ(smooth(mesh, options).collapse_iteration, 0) << "a frozen operator needs no surface";
}

/// A triangle by itself shrinks to a point: that is the end of a run, whatever its neighbours do, and no fault of the mesh.
TEST(LaplacianSmoothing, ATriangleThatShrinksAwayCollapses) {
    const TriangleMesh mesh = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const SmoothingOptions options{.lambda = 0.5 * critical_step(mesh), .iterations = 400, .rebuild = true, .monitor = true};
    const Smoothed run = smooth(mesh, options);
    EXPECT_GT(run.collapse_iteration, 1);
    EXPECT_TRUE(run.X.allFinite());
}

/// Numbering the vertices otherwise moves the result along, for every scheme.
TEST(LaplacianSmoothing, FollowsThePermutationOfItsVertices) {
    const TriangleMesh mesh = lopsided_ellipsoid(4);
    const int n = mesh.vertex_count();
    std::vector<int> place(static_cast<std::size_t>(n));
    std::iota(place.begin(), place.end(), 0);
    std::mt19937 random(7);
    for (std::size_t i = place.size() - 1; i > 0; --i) std::swap(place[i], place[random() % (i + 1)]);
    TriangleMesh permuted = mesh;
    for (int v = 0; v < n; ++v) permuted.X.row(place[std::size_t(v)]) = mesh.X.row(v);
    for (Eigen::Index i = 0; i < mesh.F.size(); ++i) permuted.F.data()[i] = place[std::size_t(mesh.F.data()[i])];
    const double step = critical_step(mesh), size = mesh.X.cwiseAbs().maxCoeff();
    const auto check = [&](const SmoothingOptions& options, double tolerance) {
        const Positions X = smooth(mesh, options).X, Y = smooth(permuted, options).X;
        EXPECT_LT((Y(place, Eigen::all) - X).cwiseAbs().maxCoeff(), tolerance * size);
    };
    SmoothingOptions stepwise;
    stepwise.lambda = 0.8 * step;
    stepwise.iterations = 100;
    check(stepwise, 1e-13);
    stepwise.scheme = SmoothingScheme::taubin;
    stepwise.taubin_mu = -0.85 * step;   // given: Lanczos would find it to 1e-10 only
    check(stepwise, 1e-13);
    check(options_of(SmoothingScheme::implicit_euler, 50 * step, 10), 1e-13);
    SmoothingOptions by_gradients = options_of(SmoothingScheme::implicit_euler, 50 * step, 10);
    by_gradients.memory_limit = 1;   // byte
    check(by_gradients, 1e-8);
}

/// Many steps of a run are the step on its own, taken as often.
TEST(LaplacianSmoothing, RunsAreSingleStepsRepeated) {
    const TriangleMesh mesh = with_unreferenced_vertex(lopsided_ellipsoid(3), {0.1, 0.2, 0.3});
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    const double step = critical_step(mesh);
    Positions X = mesh.X;
    SmoothingOptions options;
    options.lambda = 0.7 * step;
    options.iterations = 20;
    for (int t = 0; t < options.iterations; ++t) X = explicit_step(laplacian, options.lambda, X);
    EXPECT_LT((smooth(mesh, options).X - X).cwiseAbs().maxCoeff(), 1e-13);
    X = mesh.X;
    for (int t = 0; t < 5; ++t) X = implicit_step(laplacian, 9 * step, X);
    EXPECT_LT((smooth(mesh, options_of(SmoothingScheme::implicit_euler, 9 * step, 5)).X - X).cwiseAbs().maxCoeff(), 1e-13);
}
