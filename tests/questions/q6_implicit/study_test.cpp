#include "questions/q6_implicit/study.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/linear/sparse_factor.h"
#include "geometry/smoothing/dirichlet_energy.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"
#include "questions/bench/mesh_class.h"
#include "questions/core/study_laws.h"

namespace meshfolio::q6_implicit {
using namespace testing_tools;

namespace {

ImplicitStudy implicit_study_on(const TriangleMesh& mesh, const std::string& name, std::vector<double> lambda = {},
                                std::vector<int> t = {}) {
    QuestionSettings settings = quick_settings();
    settings.lambda = std::move(lambda);
    settings.iterations = std::move(t);
    return implicit_study(library_mesh(mesh, name), settings);
}

Positions smoothed(const ImplicitStudy& study, SmoothingScheme scheme, double lambda, int iterations) {
    SmoothingOptions options;
    options.scheme = scheme;
    options.lambda = lambda;
    options.iterations = iterations;
    return smooth(study.subject.mesh(), options).X;
}

double energy_of(const ImplicitStudy& study, const Positions& X) {
    return dirichlet_energy(study.subject.laplacian.C, X) / study.subject.initial_energy;
}

}   // namespace

TEST(ImplicitStudy, TheGridIsEveryStepTimesEveryIterationCount) {
    const ImplicitStudy study = implicit_study_on(cube_mesh(3), "cube_grid", {0.02, 0.01, 0.02}, {7, 2, 7, 1});
    EXPECT_EQ(study.lambdas, (std::vector{0.01, 0.02}));
    EXPECT_EQ(study.iterations, (std::vector{1, 2, 7}));
    ASSERT_EQ(study.grid.size(), 6u);
    for (std::size_t l = 0; l < 2; ++l) {
        for (std::size_t t = 0; t < 3; ++t) {
            EXPECT_EQ(study.cell(l, t).lambda, study.lambdas[l]);
            EXPECT_EQ(study.cell(l, t).iterations, study.iterations[t]);
        }
    }
}

TEST(ImplicitStudy, ASweepIsAnalysedOnceAndFactoredOncePerStepSize) {
    const ImplicitStudy study = implicit_study_on(icosphere(2), "ball_sweep", {0.001, 0.01, 0.1}, {1, 2});
    int analyses = 0;
    for (const SmoothingRun& run : study.implicit_runs) {
        analyses += run.result.analyses;
        EXPECT_EQ(run.result.factorisations, 1);
        EXPECT_EQ(run.result.solver, LinearSolver::direct);
    }
    EXPECT_EQ(analyses, 1);
}

TEST(ImplicitStudy, ACellIsTheRunOfItsStepAndIterations) {
    const ImplicitStudy study = implicit_study_on(ellipsoid_mesh(2, {1.5, 1, 0.8}), "egg_cells", {0.002, 0.02}, {1, 3, 5});
    for (const SmoothingCell& cell : study.grid) {
        EXPECT_EQ(cell.implicit_X, smoothed(study, SmoothingScheme::implicit_euler, cell.lambda, cell.iterations));
        EXPECT_EQ(cell.explicit_X, smoothed(study, SmoothingScheme::explicit_euler, cell.lambda, cell.iterations));
        EXPECT_NEAR(cell.implicit_energy, energy_of(study, cell.implicit_X), 1e-12);
        EXPECT_NEAR(cell.explicit_energy, energy_of(study, cell.explicit_X), 1e-12);
        EXPECT_LT(cell.explicit_energy, cell.implicit_energy);   // 1 − λμ < 1/(1 + λμ)
        EXPECT_EQ(cell.explicit_blow_up, 0);
        EXPECT_EQ(cell.inverted_faces, 0);
    }
}

TEST(ImplicitStudy, DefaultStepsBeginWithinTheLimitAndGoFarBeyond) {
    const ImplicitStudy study = implicit_study_on(cube_mesh(4), "cube_default");
    std::vector<double> multiples;
    for (const double lambda : study.lambdas) multiples.push_back(lambda / study.subject.critical);
    expect_near(multiples, {0.5, 5, 50});
}

TEST(ImplicitStudy, ABlownUpRunHasNoFurtherPositions) {
    const ImplicitStudy study = implicit_study_on(cube_mesh(4), "cube_blow", {1}, {1, 50});
    ASSERT_GT(study.lambdas[0], 20 * study.subject.critical);
    const SmoothingCell &early = study.cell(0, 0), &late = study.cell(0, 1);
    EXPECT_GT(early.explicit_X.size(), 0);
    EXPECT_EQ(early.explicit_blow_up, 0);
    EXPECT_EQ(late.explicit_X.size(), 0);
    EXPECT_GT(late.explicit_blow_up, early.iterations);
    EXPECT_LE(late.explicit_blow_up, late.iterations);
    EXPECT_GT(late.implicit_X.size(), 0);
}

TEST(ImplicitStudy, FacesThatTurnOverAreCounted) {
    TriangleMesh folded = grid_mesh(8, 8, 1, 1);
    folded.X = with_gaussian_noise(folded.X, Vector3(0.08, 0.08, 0.02), 1);   // half an edge within the plane: some faces lie face down
    const ImplicitStudy study = implicit_study_on(folded, "folded", {1e-12, 1e-3, 1e-2, 1e-1}, {5});
    EXPECT_EQ(study.cell(0, 0).inverted_faces, 0);
    int inverted = 0;
    for (const SmoothingCell& cell : study.grid) {
        const Positions was = face_normals(study.subject.mesh()), is = face_normals(moved_to(study.subject.mesh(), cell.implicit_X));
        EXPECT_EQ(cell.inverted_faces, (was.cwiseProduct(is).rowwise().sum().array() < 0).count());
        inverted += cell.inverted_faces;
    }
    EXPECT_GT(inverted, 0);
}

TEST(ImplicitStudy, AHugeStepCollapsesTheMesh) {
    const ImplicitStudy study = implicit_study_on(icosphere(1), "ball_gone", {1e9}, {3});
    EXPECT_TRUE(study.grid.front().collapsed());
}

TEST(ImplicitStudy, TheMeasuredDampingIsThePredictedOne) {
    const ImplicitStudy study = implicit_study_on(ellipsoid_mesh(2, {1.5, 1, 0.8}), "egg_damping");
    EXPECT_GE(study.damped_modes, 3);   // the coordinates are among the lowest modes
    EXPECT_LT(study.worst_damping, 1e-6);
    EXPECT_LT(study.huge_step_energy, 1e-6);
}

TEST(ImplicitStudy, ComparedCostsReachTheSameEnergy) {
    const ImplicitStudy study = implicit_study_on(ellipsoid_mesh(4, {1.5, 1, 0.8}), "egg_cost");
    ASSERT_TRUE(study.good() && study.cost);
    const SmoothingCell& cell = *study.good();
    const SmoothingCost& cost = *study.cost;
    const double step = 0.5 * study.subject.critical;
    ASSERT_GT(cost.explicit_steps, 0);
    EXPECT_LE(energy_of(study, smoothed(study, SmoothingScheme::explicit_euler, step, cost.explicit_steps)), cell.implicit_energy);
    const Positions reached = smoothed(study, SmoothingScheme::explicit_euler, step, cost.explicit_steps);
    EXPECT_NEAR(cost.explicit_roughness, median_face_angle(moved_to(study.subject.mesh(), reached), study.subject.topology()), 1e-9);
    if (cost.explicit_steps > 1) {
        EXPECT_GT(energy_of(study, smoothed(study, SmoothingScheme::explicit_euler, step, cost.explicit_steps - 1)), cell.implicit_energy);
    }
    const double a_step = 6.0 * double(study.implicit_runs.front().result.factor_nonzeros);   // forward and back, three columns
    const double factor = implicit_operations_of(study.subject).factorisation;
    const double all_explicit = 3.0 * cost.explicit_steps * double(study.subject.laplacian.C.nonZeros());
    EXPECT_NEAR(cost.ratio, all_explicit / (cell.iterations * a_step + factor), 1e-12 * cost.ratio);
}

TEST(ImplicitStudy, AnImplicitStepReplacesNoMoreExplicitOnesThanBernoulliAllows) {
    const ImplicitStudy study = implicit_study_on(ellipsoid_mesh(3, {1.5, 1, 0.8}), "egg_bernoulli");
    int counted = 0;
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        for (int t = 1; t <= study.iterations.back(); ++t) {
            const int steps = study.explicit_steps_to(study.implicit_runs[l].energy[static_cast<std::size_t>(t)]);
            counted += steps > 0 ? 1 : 0;
            EXPECT_LE(steps, std::ceil(2 * t * study.lambdas[l] / study.subject.critical - 1e-9)) << l << ' ' << t;
        }
    }
    EXPECT_GT(counted, 10);
}

TEST(ImplicitStudy, TheBreakEvenIsTheOneThatLeavesMostOfTheSize) {
    ImplicitStudy study = implicit_study_on(ellipsoid_mesh(3, {1.5, 1, 0.8}), "egg_even");
    const auto with = [&](double implicit_step, double factorisation) {
        study.prices = {.explicit_step = 1, .implicit_step = implicit_step, .factorisation = factorisation};
        return study.break_even();
    };
    EXPECT_FALSE(with(1e9, 0)) << "dearer at any amount";
    EXPECT_FALSE(with(0, 0)) << "not counted";
    ASSERT_TRUE(with(1e-9, 0));
    EXPECT_EQ(with(1e-9, 0)->time(), study.lambdas.front()) << "cheaper from the first step on, and least is lost by it";
    const auto even = with(4, 8);
    ASSERT_TRUE(even);
    EXPECT_GT(even->lambda, study.subject.critical) << "a step within the limit replaces too few";
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        const auto found = study.break_even(l);
        if (found) {
            EXPECT_GE(even->kept, found->kept);
        }
        for (int t = 1; t <= study.iterations.back(); ++t)
            if (const double price = study.price(l, t); !std::isnan(price)) {
                if (found && t >= found->iterations) {
                    EXPECT_GE(price, 1);
                }
                if (found && t == found->iterations - 1) {
                    EXPECT_LT(price, 1);
                }
            }
    }
}

TEST(ImplicitStudy, RecommendsTheMostSmoothingThatKeepsTheVolume) {
    const ImplicitStudy study = implicit_study(library_mesh(cube_mesh(16), "cube_recommended"), quick_settings());
    ASSERT_NE(study.good(), nullptr);
    const SmoothingCell& good = *study.good();
    EXPECT_GE(good.kept, 0.95);
    const Positions once_more = smoothed(study, SmoothingScheme::implicit_euler, good.lambda, good.iterations + 1);
    EXPECT_LT(signed_volume(moved_to(study.subject.mesh(), once_more)), 0.95 * signed_volume(study.subject.mesh()));
    EXPECT_NEAR(signed_volume(moved_to(study.subject.mesh(), good.implicit_X)) / signed_volume(study.subject.mesh()), good.kept, 1e-9);
    for (const SmoothingCell& cell : study.grid) {
        const double volume = signed_volume(moved_to(study.subject.mesh(), cell.implicit_X)) / signed_volume(study.subject.mesh());
        if (volume < 0.95) continue;
        EXPECT_LE(good.implicit_energy, 1.01 * cell.implicit_energy);
    }
    QuestionSettings huge = quick_settings();
    huge.lambda = {1e6};
    const ImplicitStudy gone = implicit_study(library_mesh(cube_mesh(5), "cube_too_far"), huge);
    EXPECT_EQ(gone.good(), nullptr);
    EXPECT_EQ(gone.too_far(0), 1);
    const ImplicitStudy open = implicit_study(library_mesh(grid_mesh(20, 20, 1, 1), "grid_recommended"), quick_settings());
    ASSERT_NE(open.good(), nullptr);
    EXPECT_GE(open.good()->kept, 0.95);
}

TEST(ImplicitStudy, SmoothingGoesTooFarBelowHalfOfTheSize) {
    const ImplicitStudy study = implicit_study(library_mesh(cube_mesh(8), "cube_half"), quick_settings());
    int reached = 0;
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        const std::vector<double>& size = study.implicit_runs[l].size;
        const int t = study.too_far(l);
        for (int before = 0; before < (t > 0 ? t : static_cast<int>(size.size())); ++before) EXPECT_GE(size[before], 0.5) << l;
        if (t > 0) {
            EXPECT_LT(size[t], 0.5) << l;
            ++reached;
        }
    }
    EXPECT_TRUE(0 < reached && reached < static_cast<int>(study.lambdas.size())) << "a small step of ten does not go that far";
}

TEST(ImplicitStudy, TheGapMapComparesEqualTimes) {
    const ImplicitStudy study = implicit_study(library_mesh(cube_mesh(16), "cube_gap"), quick_settings());
    ASSERT_TRUE(study.good() && study.cost);
    const SmoothingCell& good = *study.good();
    const double half = 0.5 * study.subject.critical;
    const int steps = static_cast<int>(std::lround(good.time() / half));
    ASSERT_NEAR(steps * half, good.time(), 1e-9 * good.time()) << "own steps are multiples of half the limit";
    const Positions X = smoothed(study, SmoothingScheme::explicit_euler, half, steps);
    EXPECT_LE((study.cost->gap - (X - good.implicit_X).rowwise().norm()).norm(), 1e-9 * study.cost->gap.norm());
    EXPECT_NEAR(study.cost->gap_share, vertex_rms(X, good.implicit_X) / vertex_rms(study.subject.mesh().X, good.implicit_X), 1e-9);
    const ImplicitStudy uneven = implicit_study_on(cube_mesh(16), "cube_uneven", {0.7 * study.subject.critical}, {3});
    ASSERT_TRUE(uneven.cost);
    EXPECT_GT(uneven.cost->gap.size(), 0);
    EXPECT_LT(uneven.cost->gap_share, 0.5) << "steps of other sizes still have the same λt";
}

TEST(ImplicitStudy, EqualTimesAreComparedWithTheFewestSteps) {
    const ImplicitStudy study = implicit_study_on(ellipsoid_mesh(3, {1.5, 1, 0.8}), "egg_times", {0.001, 0.01}, {1, 3, 10});
    for (const SmoothingCell& cell : study.grid) EXPECT_EQ(cell.fewer_steps > 0, cell.lambda == 0.001 && cell.iterations == 10);
    const SmoothingCell &many = study.cell(0, 2), &few = study.cell(1, 0);
    EXPECT_EQ(many.fewer_steps, 1);
    EXPECT_NEAR(many.apart, vertex_rms(many.implicit_X, few.implicit_X) / vertex_rms(study.subject.mesh().X, many.implicit_X), 1e-12);
}

TEST(ImplicitStudy, TheStepOfTheGapIsTheLargestWithinTheLimit) {
    const ImplicitStudy first = implicit_study_on(icosphere(2), "ball_within");
    EXPECT_EQ(first.within_limit(), 0u);
    const double limit = first.subject.critical;
    EXPECT_EQ(implicit_study_on(icosphere(2), "ball_two", {0.1 * limit, 0.9 * limit, 2 * limit}).within_limit(), 1u);
    const ImplicitStudy none = implicit_study_on(icosphere(2), "ball_none", {2 * limit});
    EXPECT_FALSE(none.within_limit());
    EXPECT_TRUE(none.gaps().empty());
}

}   // namespace meshfolio::q6_implicit
