#include "questions/bench/smoothing_study.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/smoothing/dirichlet_energy.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"
#include "questions/core/study_laws.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;

namespace {

SmoothingSubject ball_subject() { return smoothing_subject(library_mesh(icosphere(2), "ball")); }

constexpr SmoothingScheme both_schemes[] = {SmoothingScheme::explicit_euler, SmoothingScheme::implicit_euler};

}   // namespace

TEST(EnergyCheck, PassesFailsOrIsUndecided) {
    SmoothingRun run;
    run.energy = {1, 0.9, 0.9 + 1e-9};
    run.energy_rounding = {0, 1e-13, 1e-13};
    EXPECT_TRUE(energy_check("", run).failed()) << "a rise of a billionth";
    run.energy_rounding[2] = 2e-9;
    EXPECT_EQ(energy_check("", run).status, report::Check::Status::undecided) << "that rounding could have made";
    run.energy_rounding[1] = 1e-8;
    run.energy = {1, 0.9, 0.8};
    EXPECT_EQ(energy_check("", run).status, report::Check::Status::undecided) << "or could hide";
    run.energy_rounding = {0, 1e-13, 1e-13};
    EXPECT_TRUE(energy_check("", run).passed());
    run.result.blew_up = true;
    EXPECT_TRUE(energy_check("", run).failed());
}

// Noisy triangles become so thin after some steps with rebuilt operators that M − λC cannot be factored.
TEST(SmoothUntilCollapse, ARebuiltRunKeepsWhatItReached) {
    const TriangleMesh clean = make_sample("creature");
    const double edge = mean_edge_length(clean);
    const TriangleMesh noisy = moved_to(clean, with_gaussian_noise(clean.X, 0.01 * bounding_box(clean).extent(), 1));
    SmoothingOptions options{.scheme = SmoothingScheme::implicit_euler, .lambda = edge * edge, .iterations = 60, .rebuild = true};
    EXPECT_THROW(smooth(noisy, options), SolverError);
    int seen = 0;
    options.after_step = [&](int iteration, const Positions&) { return seen = iteration, true; };
    ImplicitSolver solver;
    const Smoothed run = smooth_until_collapse(noisy, options, solver);
    ASSERT_GT(run.collapse_iteration, 1);
    EXPECT_EQ(run.iterations, run.collapse_iteration - 1);
    EXPECT_EQ(seen, run.iterations);
    EXPECT_FALSE(run.blew_up);
    options.iterations = run.iterations;
    const Smoothed prefix = smooth(noisy, options);
    EXPECT_EQ(prefix.X, run.X) << "the same steps";
    EXPECT_DOUBLE_EQ(prefix.time, run.time);
    EXPECT_EQ(smooth_until_collapse(noisy, options, solver).collapse_iteration, 0) << "the solver is as good as new";
}

TEST(SmoothingStudy, TinyStepsLeaveTheMeshAsItIs) {
    const SmoothingSubject subject = ball_subject();
    for (const auto& step : {explicit_step, implicit_step}) {
        EXPECT_LT((step(subject.laplacian, 0, subject.mesh().X) - subject.mesh().X).cwiseAbs().maxCoeff(), 1e-14);
    }
    for (const SmoothingScheme scheme : both_schemes) {
        const SmoothingRun run = run_smoothing(subject, scheme, 1e-15 * subject.critical, 3);
        EXPECT_LT(run.moved.max, 1e-12);
        EXPECT_EQ(run.moved.inverted_faces, 0);
        EXPECT_NEAR(run.energy.back(), 1, 1e-12);
        EXPECT_NEAR(run.volume.back(), 1, 1e-12);
    }
}

TEST(SmoothingStudy, HasOneValuePerIterationAndTheInput) {
    const SmoothingSubject subject = ball_subject();
    for (const SmoothingScheme scheme : both_schemes) {
        const SmoothingRun run = run_smoothing(subject, scheme, 0.4 * subject.critical, 6, {1, 4, 6});
        EXPECT_EQ(run.result.iterations, 6);
        ASSERT_EQ(run.energy.size(), 7u);
        ASSERT_EQ(run.volume.size(), 7u);
        EXPECT_EQ(run.energy.front(), 1);
        EXPECT_EQ(run.volume.front(), 1);
        ASSERT_EQ(run.snapshots.size(), 3u);
        EXPECT_EQ(run.snapshots[1], run_smoothing(subject, scheme, 0.4 * subject.critical, 4).result.X);
        EXPECT_EQ(run.snapshots[2], run.result.X);
        EXPECT_NEAR(run.energy[4], dirichlet_energy(subject.laplacian.C, run.snapshots[1]) / subject.initial_energy, 1e-12);
        EXPECT_NEAR(run.volume[1], signed_volume(moved_to(subject.mesh(), run.snapshots[0])) / signed_volume(subject.mesh()), 1e-12);
        EXPECT_NEAR(run.volume.back(), run.moved.volume_ratio, 1e-12);
        EXPECT_EQ(run.in_view_iteration, 6);
        EXPECT_EQ(run.in_view, run.result.X);
    }
}

TEST(SmoothingStudy, ABallShrinksAndItsEnergyFalls) {
    const SmoothingSubject subject = ball_subject();
    for (const SmoothingScheme scheme : both_schemes) {
        const SmoothingRun run = run_smoothing(subject, scheme, 0.4 * subject.critical, 6);
        for (std::size_t t = 1; t < run.energy.size(); ++t) {
            EXPECT_LT(run.energy[t], run.energy[t - 1]);
            EXPECT_LT(run.volume[t], run.volume[t - 1]);
        }
        // A ball stays a ball: energy ~ r², volume ~ r³, motion 1 − r, equal angles.
        const double r = std::sqrt(run.energy.back());
        EXPECT_NEAR(run.volume.back(), r * r * r, 1e-2 * r * r * r);
        EXPECT_NEAR(run.moved.rms, 1 - r, 1e-2);
        EXPECT_NEAR(smallest_angle(moved_to(subject.mesh(), run.result.X)), smallest_angle(subject.mesh()), 0.05);
    }
}

TEST(SmoothingStudy, AnOpenMeshHasNoVolume) {
    const SmoothingRun run = run_smoothing(smoothing_subject(library_mesh(grid_mesh(5, 5, 1, 1), "open")), both_schemes[1], 0.01, 2);
    EXPECT_TRUE(run.volume.empty());
}

TEST(SmoothingStudy, APictureShowsTheLastPositionsInView) {
    const SmoothingSubject subject = ball_subject();
    const SmoothingRun run = run_smoothing(subject, SmoothingScheme::explicit_euler, 20 * subject.critical, 30);
    ASSERT_TRUE(run.result.blew_up);
    EXPECT_LT(run.in_view_iteration, run.result.blow_up_iteration);
    const auto widest = [](const Positions& X) { return X.cwiseAbs().maxCoeff(); };
    const double shown = widest(subject.mesh().X) / 0.92;   // the input's widest extent takes that much of a picture
    EXPECT_LE(widest(run.in_view), shown + 1e-9);
    const SmoothingRun next = run_smoothing(subject, SmoothingScheme::explicit_euler, 20 * subject.critical, run.in_view_iteration + 1);
    EXPECT_GT(widest(next.result.X), shown);
}

TEST(SmoothingStudy, StepsAreTheGivenOnesOrMultiplesOfTheLimit) {
    const SmoothingSubject subject = ball_subject();
    QuestionSettings settings;
    expect_near(steps_of(settings, subject.critical, {2, 0.5}), {0.5 * subject.critical, 2 * subject.critical});
    settings.lambda = {0.3, 0.1, 0.3};
    EXPECT_EQ(steps_of(settings, subject.critical, {2, 0.5}), (std::vector{0.1, 0.3}));
}

TEST(SmoothingStudy, ColoursAreCurvatureTimesMeanEdge) {
    const SmoothingSubject subject = ball_subject();
    const Vector once = curvature_colours(subject, subject.mesh().X), twice = curvature_colours(subject, 2 * subject.mesh().X);
    EXPECT_NEAR(once.mean(), subject.mean_edge, 0.05 * subject.mean_edge);   // H = 1, positive on a ball
    EXPECT_NEAR(twice.mean(), once.mean() / 2, 1e-9);
}

TEST(SmoothingStudy, SizeIsKeptUntilItFallsBelow) {
    SmoothingRun run;
    run.size = {1, 0.98, 0.95, 0.94, 0.9};
    EXPECT_EQ(iterations_keeping_size(run, 0.95), 2);
    EXPECT_EQ(iterations_keeping_size(run, 0.99), 0);
    EXPECT_EQ(iterations_keeping_size(run, 0.5), -1);
    run.size = {1, std::nan("")};   // no numbers any more
    EXPECT_EQ(iterations_keeping_size(run, 0.5), 0);
}

TEST(SmoothingStudy, MeasuresTheComponentThatLosesMost) {
    const TriangleMesh large = icosphere(3), small = icosphere(1, 0.1);   // the small one shrinks first
    TriangleMesh both;
    both.X.resize(large.X.rows() + small.X.rows(), 3);
    both.X << large.X, (small.X.rowwise() + Eigen::RowVector3d(3, 0, 0));
    both.F.resize(large.F.rows() + small.F.rows(), 3);
    both.F << large.F, (small.F.array() + large.vertex_count()).matrix();
    const auto size_of = [](const TriangleMesh& mesh, const std::string& name) {
        const SmoothingSubject subject = smoothing_subject(library_mesh(mesh, name));
        return run_smoothing(subject, SmoothingScheme::implicit_euler, 1e-3, 3).size;
    };
    const std::vector<double> whole = size_of(both, "both"), alone = size_of(small, "small");
    ASSERT_EQ(whole.size(), 4u);
    for (std::size_t t = 0; t < whole.size(); ++t) EXPECT_NEAR(whole[t], alone[t], 1e-9) << t;
    EXPECT_LT(whole.back(), size_of(large, "large").back());
    const SmoothingSubject sheet = smoothing_subject(library_mesh(grid_mesh(8, 8, 1, 1), "sheet"));   // open: the spread
    const SmoothingRun run = run_smoothing(sheet, SmoothingScheme::implicit_euler, 1e-2, 2);
    const auto spread = [&](const Positions& X) {   // about the barycentre, which stays
        const Vector& M = sheet.laplacian.M;
        const Eigen::RowVector3d centre = M.transpose() * X / M.sum();
        return M.dot((X.rowwise() - centre).rowwise().squaredNorm());
    };
    EXPECT_NEAR(run.size.back(), spread(run.result.X) / spread(sheet.mesh().X), 1e-12);
}
