#include <gtest/gtest.h>

#include <cmath>

#include "mesh/io/mesh_files.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "output/draw/framing.h"
#include "questions/core/study_laws.h"
#include "questions/q5_explicit/parts.h"
#include "questions/q5_explicit/study.h"
#include "temporary_folder.h"

namespace meshfolio::q5_explicit {
using namespace testing_tools;

TEST(Q5, BundledMeshesPassTheirOwnChecks) {
    const Answer answer = chapter_of_id("q5").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    // The text about steps beyond the limit must mention growth.
    EXPECT_NE(prose_of(answer.section).find("Too large a step amplifies"), std::string::npos);
    EXPECT_FALSE(answer.section.answer.empty());
    EXPECT_GT(answer.section.appendix_from, 0);
}

TEST(Q5, OnlyStepsBelowTheLimitAreRecommended) {
    QuestionSettings settings = quick_settings();
    settings.lambda = {1e3};   // far beyond the limit of a unit sphere
    const Answer answer = chapter_of_id("q5").answer(library_of(icosphere(2), "ball"), settings, no_progress);
    expect_well_formed(answer);
    EXPECT_NE(prose_of(answer.section).find("no step tried can be recommended"), std::string::npos);
}

TEST(Q5, TheAnswerSaysHalfTheLimitOnlyIfThatIsRecommended) {
    const auto answered = [](std::vector<double> limits) {
        const TriangleMesh mesh = icosphere(3);
        QuestionSettings settings = quick_settings();
        const double critical = smoothing_subject(library_mesh(mesh, "ball_half")).critical;
        for (const double limit : limits) settings.lambda.push_back(limit * critical);
        return report::plain(chapter_of_id("q5").answer(library_of(mesh, "ball_half"), settings, no_progress).section.answer);
    };
    EXPECT_TRUE(answered({}).starts_with("A good step is λ = 1/μ_max"));
    EXPECT_TRUE(answered({0.1, 1.2}).starts_with("A good step is at most λ = 1/μ_max"));
    EXPECT_TRUE(answered({0.8, 1.2}).starts_with("A good step stays below"));
    EXPECT_TRUE(answered({1.2}).starts_with("No step tried"));
}

TEST(Q5, TheTablesAreTheStudy) {
    const TriangleMesh mesh = ellipsoid_mesh(3, {1.5, 1, 0.8});
    const Answer answer = chapter_of_id("q5").answer(library_of(mesh, "egg5"), quick_settings(), no_progress);
    const ExplicitStudy study = explicit_study(library_mesh(mesh, "egg5"), quick_settings());
    const report::Table& steps = table_named(answer.section, "q5_steps");
    const SmoothingSubject& subject = study.subject;
    const double h = subject.mean_edge;
    std::vector<double> tau, in_edges, energy, moved, volume, inverted, predicted;
    for (const SmoothingRun& run : study.runs) {
        tau.push_back(run.lambda / subject.critical);
        in_edges.push_back(run.lambda / (h * h));
        const double factor = std::pow(std::abs(1 - run.lambda * subject.top.value), 20);
        predicted.push_back(factor < 1e-8 ? 0 : factor);
        if (run.result.blew_up) continue;
        energy.push_back(run.energy.back());
        moved.push_back(100 * vertex_rms(subject.mesh().X, run.result.X) / bounding_box(subject.mesh()).diagonal());
        volume.push_back(100 * signed_volume(moved_to(subject.mesh(), run.result.X)) / signed_volume(subject.mesh()));
        inverted.push_back(run.moved.inverted_faces);
    }
    expect_near(numbers(steps, "λ/λ_crit"), tau);
    std::vector<double> lambdas;
    for (const double limits : in_edges) lambdas.push_back(limits * h * h);
    expect_near(numbers(steps, "λ"), lambdas);
    expect_near(numbers(steps, "top mode ×, predicted"), predicted, 1e-9);
    expect_near(numbers(steps, "measured"), predicted, 1e-4);
    // A run that blew up has only the iteration of the blow-up.
    EXPECT_TRUE(study.runs.back().result.blew_up);
    expect_near(finite_numbers(steps, "energy"), energy);
    expect_near(finite_numbers(steps, "size"), volume, 1e-9);
    expect_near(finite_numbers(steps, "faces turned over"), inverted);
    expect_near(finite_numbers(steps, "rms moved"), moved);
    std::vector<std::string> outcomes;
    for (const report::Cell& cell : cells(steps, "outcome")) outcomes.push_back(std::get<std::string>(cell));
    EXPECT_EQ(outcomes[0], "stable");
    EXPECT_EQ(outcomes[1], "stable (our λ)");
    EXPECT_EQ(outcomes[2], "stable");
    EXPECT_EQ(outcomes[3], "growing");
    EXPECT_TRUE(outcomes[4].starts_with("blew up")) << outcomes[4];
    const report::Table& limits = table_named(answer.section, "q5_limits");
    expect_near(numbers(limits, "λ_crit"), {2 / subject.top.value});
    expect_near(numbers(limits, "λ_crit/h̄²"), {subject.critical / (h * h)});
    expect_near(numbers(limits, "our λ"), {0.5 * subject.critical});
    EXPECT_EQ(numbers(limits, "iterations")[0], study.recommended->stopped.iterations);
    expect_near(numbers(limits, "λt"), {0.5 * subject.critical * study.recommended->stopped.iterations / (h * h)});
    EXPECT_EQ(numbers(limits, "face angle before")[0], study.recommended->roughness_before);
    EXPECT_EQ(numbers(limits, "after")[0], study.recommended->roughness_after);
    EXPECT_GE(numbers(limits, "size")[0], 95);
    EXPECT_LE(numbers(table_named(answer.section, "q5_bounds"), "safe λ (Gershgorin)")[0], subject.critical);
}

TEST(Q5, TheInputStandsBesideTheRecommendedResult) {
    const TriangleMesh mesh = cube_mesh(10);
    const Answer answer = chapter_of_id("q5").answer(library_of(mesh, "cube5"), quick_settings(), no_progress);
    const ExplicitStudy study = explicit_study(library_mesh(mesh, "cube5"), quick_settings());
    const output::FigureRequest& figure = figure_named(answer, "q5_cube5_recommended");
    ASSERT_EQ(figure.panels.size(), 2u);
    EXPECT_EQ(figure.layout, output::Layout::six_views);
    EXPECT_EQ(figure.panels[0].mesh->X, study.subject.mesh().X);
    EXPECT_EQ(figure.panels[1].mesh->X, study.recommended->stopped.result.X);
}

TEST(Q5, SeveralMeshesShareOneFrameAtEqualBoxDiagonals) {
    const Answer answer = chapter_of_id("q5").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    const std::vector<output::Panel>& panels = figure_named(answer, "q5_recommended").panels;
    ASSERT_EQ(panels.size(), 6u);
    for (std::size_t i = 0; i < 3; ++i) {
        const TriangleMesh &input = *panels[2 * i].mesh, &result = *panels[2 * i + 1].mesh;
        EXPECT_NEAR(bounding_box(input).diagonal(), 1, 1e-12);
        EXPECT_LT(bounding_box(input).centre().norm(), 1e-12);
        // Smoothing keeps the barycentre, so input and result have the same scale and place.
        const SmoothingSubject subject = smoothing_subject(library_mesh(input, "resized" + std::to_string(i)));
        EXPECT_LT((subject.laplacian.M.transpose() * (result.X - input.X)).norm(), 1e-9 * subject.laplacian.M.sum());
    }
}

TEST(Q5, FramesAreStatesOfOneRunAndEmptyOnlyIfInvisible) {
    const std::vector<TriangleMesh> meshes{cube_mesh(4), ellipsoid_mesh(2, {1.5, 1, 0.8})};
    const TemporaryFolder folder;
    std::vector<std::filesystem::path> files;
    for (const char* name : {"cube_frames", "egg_frames"}) {
        files.push_back(folder.path() / (std::string(name) + ".ply"));
        write_mesh(files.back(), meshes[files.size() - 1]);
    }
    const Answer answer = chapter_of_id("q5").answer(MeshLibrary({}, files), quick_settings(), no_progress);
    const output::FigureRequest& figure = figure_named(answer, "q5_frames");
    const std::vector<SmoothingSubject> subjects{smoothing_subject(library_mesh(meshes[0], "cube_frames")),
                                                 smoothing_subject(library_mesh(meshes[1], "egg_frames"))};
    int seen = 4;
    for (const SmoothingSubject& subject : subjects)
        seen = std::min(seen, run_smoothing(subject, SmoothingScheme::explicit_euler, 2 * subject.critical, 4).in_view_iteration);
    ASSERT_GE(seen, 1);
    const std::vector<std::pair<double, int>> states{{0, 0}, {1.05, 10}, {1.05, 20}, {2, seen}, {2, 5}};
    EXPECT_EQ(figure.columns[3], "2 λ_crit, t = " + std::to_string(seen)) << "the last picture that still shows all spikes";
    EXPECT_EQ(figure.states, 5) << "each row has the frame of its input";
    ASSERT_EQ(figure.columns.size(), states.size());
    EXPECT_EQ(figure.rows, (std::vector<std::string>{"cube_frames", "egg_frames"}));
    ASSERT_EQ(figure.panels.size(), states.size() * meshes.size());
    int unlike = 0;   // spikes that are drawn smaller, or not at all
    for (std::size_t row = 0; row < meshes.size(); ++row) {
        const SmoothingSubject& subject = subjects[row];
        for (std::size_t column = 0; column < states.size(); ++column) {
            const auto [limits, t] = states[column];
            const output::Panel& panel = figure.panels[row * states.size() + column];
            const Positions X =
                t == 0 ? subject.mesh().X : run_smoothing(subject, SmoothingScheme::explicit_euler, limits * subject.critical, t).result.X;
            EXPECT_EQ(panel.mesh == nullptr, bounding_box(moved_to(subject.mesh(), X)).diagonal() > 2 * subject.diagonal) << panel.label;
            unlike += panel.mesh ? 0 : 1;
            if (!panel.mesh) continue;
            const output::FittedPositions fitted = output::fitted_into_frame(subject.mesh(), X);
            EXPECT_LT((panel.mesh->X - fitted.X).norm(), 1e-6 * subject.diagonal) << panel.label;
            unlike += fitted.scale < 1 ? 1 : 0;
        }
    }
    EXPECT_GT(unlike, 0) << "no spikes: nothing was seen";
}

TEST(Q5, WithoutAStepBeyondTheLimitThereAreNoFrames) {
    const TriangleMesh mesh = icosphere(2);
    QuestionSettings settings = quick_settings();
    settings.lambda = {0.4 * smoothing_subject(library_mesh(mesh, "ball_within")).critical};
    const Answer answer = chapter_of_id("q5").answer(library_of(mesh, "ball_within"), settings, no_progress);
    expect_well_formed(answer);
    for (const output::FigureRequest& figure : answer.figures) EXPECT_NE(figure.id, "q5_frames");
}

// The wave after t steps is the first one times (1 − λμ)ᵗ.
TEST(Q5, TheWaveIsMultipliedByTheFactorOfItsStep) {
    const report::Diagram wave = wave_diagram();
    ASSERT_EQ(wave.panels.size(), 3u);
    const std::vector<double> products{0.5, 1.5, 2.2};
    for (std::size_t p = 0; p < 3; ++p) {
        std::vector<double> crests[2];   // signed, of the explicit and the implicit wave
        for (const report::Diagram::Path& path : wave.panels[p].paths) {
            const bool is_explicit = path.style == report::Diagram::Style::accent;
            if (!is_explicit && path.style != report::Diagram::Style::dashed) continue;
            const auto crest = std::size_t(std::lround(0.25 / 2.5 * double(path.x.size() - 1)));
            crests[is_explicit ? 0 : 1].push_back(path.y[crest] - path.y[0]);
        }
        ASSERT_EQ(crests[0].size(), 3u);
        ASSERT_EQ(crests[1].size(), 2u);
        for (int t = 1; t <= 2; ++t) {
            EXPECT_NEAR(crests[0][t] / crests[0][0], std::pow(1 - products[p], t), 1e-9);
            EXPECT_NEAR(crests[1][t - 1] / crests[0][0], std::pow(1 / (1 + products[p]), t), 1e-9);
        }
    }
}

TEST(Q5, APanelHasAtMostFiveCurves) {
    const TriangleMesh mesh = icosphere(2);
    QuestionSettings settings = quick_settings();
    const double critical = smoothing_subject(library_mesh(mesh, "ball_many")).critical;
    for (int i = 1; i <= 9; ++i) settings.lambda.push_back(0.1 * i * critical);
    const Answer answer = chapter_of_id("q5").answer(library_of(mesh, "ball_many"), settings, no_progress);
    int plots = 0;
    for (const report::Block& block : answer.section.blocks) {
        const auto* plot = std::get_if<report::Plot>(&block);
        if (plot == nullptr || plot->id != "q5_energy") continue;
        ++plots;
        ASSERT_EQ(plot->series.size(), 5u);
        EXPECT_EQ(plot->series.front().name, "0.1 λ_crit");
        EXPECT_EQ(plot->series.back().name, "0.9 λ_crit");
    }
    EXPECT_EQ(plots, 1);
}

TEST(Q5, TheTextFollowsTheData) {
    const auto prose = [](const TriangleMesh& mesh) {
        return prose_of(chapter_of_id("q5").answer(library_of(mesh, "body5"), quick_settings(), no_progress).section);
    };
    EXPECT_NE(prose(cube_mesh(6)), prose(grid_mesh(8, 8, 1, 1)));
}

}   // namespace meshfolio::q5_explicit
