#include <gtest/gtest.h>

#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/study_laws.h"
#include "questions/methods/study.h"

namespace meshfolio::methods {
using namespace testing_tools;

namespace {

MeshCharacter character_of(const TriangleMesh& mesh) { return mesh_character(mesh, topology_of(mesh)); }

QuestionSettings with_noise_of(std::vector<double> shares) {
    QuestionSettings settings = quick_settings();
    settings.noise = std::move(shares);
    return settings;
}

DenoisingLaboratory laboratory_of(const TriangleMesh& mesh, const QuestionSettings& settings = quick_settings()) {
    return {search_budget(settings), {denoising_trials(denoising_subject("subject", mesh, 10000), settings)}};
}

double gain_of(const NoiseTrial& trial, DenoisingMethod method) {
    for (const SearchResult& result : trial.results) {
        if (result.method == method) return result.gain();
    }
    return std::nan("");
}

}   // namespace

TEST(MeshClass, FollowsFromTheAnglesBetweenFaces) {
    EXPECT_EQ(character_of(grid_mesh(5, 5, 1, 1)).kind(), MeshClass::flat);
    EXPECT_EQ(character_of(icosphere(3)).kind(), MeshClass::smooth);
    EXPECT_EQ(character_of(cube_mesh(6)).kind(), MeshClass::sharp_edged);
    TriangleMesh crumpled = icosphere(3);
    crumpled.X = with_gaussian_noise(crumpled.X, Vector3::Constant(0.5 * mean_edge_length(crumpled)), 1);
    EXPECT_EQ(character_of(crumpled).kind(), MeshClass::rough);
    EXPECT_TRUE(character_of(grid_mesh(5, 5, 1, 1)).open);
    EXPECT_FALSE(character_of(cube_mesh(2)).open);
}

TEST(MeshClass, HasTheKnownValuesOfACube) {
    const MeshCharacter cube = character_of(cube_mesh(6));
    // 218 vertices, 12 edges with 5 inner vertices each and 8 corners on features.
    EXPECT_NEAR(cube.feature_share, 68.0 / 218, 1e-12);
    EXPECT_NEAR(cube.typical_angle, 0, 1e-6);
    EXPECT_NEAR(cube.largest_angle, 90, 1e-6);
    const TriangleMesh mesh = cube_mesh(6);
    EXPECT_TRUE(feature_vertices(mesh, topology_of(mesh))[static_cast<std::size_t>(sharpest_vertex(mesh, topology_of(mesh)))]);
}

TEST(DenoisingSearch, EveryMethodSpendsTheSameBudget) {
    const SearchBudget budget{6, 8};
    for (const DenoisingEntry& entry : denoising_list()) {
        const SearchPlan plan = search_plan(entry.method, budget, 0.1, 1000);
        EXPECT_EQ(static_cast<int>(plan.values.size()) * plan.steps, budget.total()) << entry.name;
        for (std::size_t i = 2; i < plan.values.size(); ++i)
            EXPECT_NEAR(plan.values[i] / plan.values[i - 1], plan.values[1] / plan.values[0], 1e-9) << entry.name;
    }
    EXPECT_NEAR(search_plan(DenoisingMethod::explicit_flow, budget, 0.1, 1000).values.back(), 0.9, 1e-12);
    EXPECT_NEAR(search_plan(DenoisingMethod::explicit_flow, budget, 0.1, 1000).unit, 0.002, 1e-15) << "λ_crit = 2/μ_max";
    EXPECT_NEAR(search_plan(DenoisingMethod::implicit_flow, budget, 0.1, 1000).unit, 0.01, 1e-15);
}

TEST(DenoisingSearch, TheBestResultCanBeReproduced) {
    const DenoisingLaboratory laboratory = laboratory_of(cube_mesh(5));
    const DenoisingTrials& mesh = laboratory.meshes.front();
    for (const NoiseTrial& trial : mesh.trials) {
        const TriangleMesh noisy = moved_to(mesh.subject.mesh, trial.noisy);
        for (const SearchResult& r : trial.results) {
            ASSERT_TRUE(r.defined);
            EXPECT_LE(r.by_shape.shape, r.noisy.shape);
            EXPECT_LE(r.by_rms.rms, r.noisy.rms);
            EXPECT_LE(r.by_angle.angle, r.noisy.angle);
            EXPECT_EQ(r.steps, laboratory.budget.total());
            EXPECT_NEAR(shape_rms(mesh.subject.mesh, r.X), r.by_shape.shape, 1e-15);
            EXPECT_NEAR(r.difference.rms, r.by_shape.rms, 1e-15);
            EXPECT_NEAR(r.difference.mean_normal_angle, r.by_shape.angle, 1e-14);
            if (r.by_shape.step == 0) continue;
            DenoisingOptions options;
            options.method = r.method;
            options.parameter = r.by_shape.value * search_plan(r.method, laboratory.budget, trial.mean_edge, trial.largest_eigenvalue).unit;
            options.steps = r.by_shape.step;
            ImplicitSolver solver;
            const DenoisingRun run = denoise({noisy, mesh.subject.topology, trial.largest_eigenvalue}, options, solver);
            EXPECT_LT((run.X - r.X).cwiseAbs().maxCoeff(), 1e-14) << denoising_entry(r.method).name;
        }
    }
}

TEST(DenoisingLaboratory, VolumeKeepingDiffusionWinsOnABallAndNormalFiltersOnACube) {
    const NoiseTrial cube = laboratory_of(cube_mesh(8), with_noise_of({0.01})).meshes.front().trials.front();
    const NoiseTrial ball = laboratory_of(icosphere(3), with_noise_of({0.01})).meshes.front().trials.front();
    EXPECT_GT(gain_of(cube, DenoisingMethod::guided_normals), 1.3 * gain_of(cube, DenoisingMethod::volume_rescaled));
    EXPECT_GT(gain_of(ball, DenoisingMethod::volume_rescaled), 1.2 * gain_of(ball, DenoisingMethod::guided_normals));
    EXPECT_GT(gain_of(ball, DenoisingMethod::volume_rescaled), 1.2 * gain_of(ball, DenoisingMethod::implicit_flow));
}

TEST(DenoisingLaboratory, WithTinyNoiseNoFlowImprovesACube) {
    const DenoisingLaboratory laboratory = laboratory_of(cube_mesh(5), with_noise_of({1e-7}));
    for (const SearchResult& r : laboratory.meshes.front().trials.front().results) {
        if (filters_normals(r.method)) continue;
        EXPECT_EQ(r.gain(), 1) << denoising_entry(r.method).name;
    }
}

TEST(DenoisingLaboratory, AveragesOfAClassAreGeometricAndSkipUndefinedMethods) {
    const DenoisingLaboratory laboratory = laboratory_of(grid_mesh(8, 8, 1, 1));
    const std::vector<ClassResult> classes = class_results(laboratory);
    ASSERT_EQ(classes.size(), 1u);
    EXPECT_EQ(classes[0].title, "flat, open");
    const auto& trials = laboratory.meshes.front().trials;
    ASSERT_EQ(trials.size(), 2u);
    for (std::size_t i = 0; i < denoising_list().size(); ++i) {
        if (denoising_list()[i].method == DenoisingMethod::volume_rescaled) {
            EXPECT_TRUE(std::isnan(classes[0].gain[i]));
            continue;
        }
        EXPECT_NEAR(classes[0].gain[i], std::sqrt(trials[0].results[i].gain() * trials[1].results[i].gain()), 1e-12);
    }
}

TEST(DenoisingLaboratory, CutsLargeMeshesToAPatch) {
    const DenoisingSubject subject = denoising_subject("ball", icosphere(4), 200);
    EXPECT_TRUE(subject.is_patch());
    EXPECT_LE(subject.mesh.vertex_count(), 200);
    EXPECT_EQ(subject.whole_vertices, 2562);
    EXPECT_EQ(subject.class_title(), "smooth, open");
    EXPECT_FALSE(subject.has_volume_to_keep);
}

TEST(Methods, TheUsualReportPassesItsChecks) {
    const Answer answer = chapter_of_id("methods").answer(library_of(icosphere(2), "methods_ball"), QuestionSettings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    const report::Table& gains = table_named(answer.section, "methods_gains");
    EXPECT_EQ(gains.rows.size(), 7u) << "four levels of Gaussian noise, two other kinds, and 20 % of the box";
    EXPECT_EQ(answer.figures.front().panels.size(), answer.figures.front().columns.size()) << "one noisy mesh";
    EXPECT_NE(prose_of(answer.section).find("20\u202f% of the box"), std::string::npos);
}

// A method that only rescales the result of another has the same normals.
TEST(Methods, ATieInNormalsNamesNoSecondWinner) {
    DenoisingLaboratory laboratory = laboratory_of(cube_mesh(4), with_noise_of({0.01}));
    const auto discussion_with_angle = [&](double angle_of_the_second) {
        for (NoiseTrial& trial : laboratory.meshes.front().trials) {
            for (SearchResult& r : trial.results) {
                r.noisy.shape = r.noisy.angle = 1;
                r.by_shape.shape = r.by_angle.angle = 1;
            }
            trial.results[0].by_shape.shape = 0.6;
            trial.results[1].by_shape.shape = 0.5;
            trial.results[0].by_angle.angle = 0.4;
            trial.results[1].by_angle.angle = angle_of_the_second;
        }
        report::Section section;
        add_words(section, words, "discussion", facts_of(laboratory));
        return prose_of(section);
    };
    const std::string tied = discussion_with_angle(0.4), beaten = discussion_with_angle(0.41);
    const std::string count = std::to_string(laboratory.meshes.front().trials.size());
    EXPECT_EQ(tied.find("depends on the measure"), std::string::npos) << tied;
    EXPECT_NE(beaten.find("on " + count + " of " + count + " noisy meshes the normals"), std::string::npos) << beaten;
}

TEST(Methods, TheTableShowsTheStudy) {
    const TriangleMesh box = cube_mesh(4);
    const Answer answer = chapter_of_id("methods").answer(library_of(box, "methods_box"), quick_settings(), no_progress);
    const report::Table& table = table_named(answer.section, "methods_gains");
    const DenoisingLaboratory laboratory = laboratory_of(box);
    const std::vector<NoiseTrial>& trials = laboratory.meshes.front().trials;
    ASSERT_EQ(trials.size(), table.rows.size());
    for (std::size_t method = 0; method < denoising_list().size(); ++method) {
        const auto gains = numbers(table, std::string(denoising_list()[method].title));
        for (std::size_t row = 0; row < trials.size(); ++row) EXPECT_NEAR(gains[row], trials[row].results[method].gain(), 1e-9);
    }
    const auto places = numbers(table, "largest in places");
    for (std::size_t row = 0; row < trials.size(); ++row)
        for (const SearchResult& result : trials[row].results) EXPECT_GE(places[row], result.rms_gain());
}

TEST(Methods, AnswersForOddMeshes) {
    TriangleMesh triangle;
    triangle.X.resize(3, 3);
    triangle.X << 0, 0, 0, 1, 0, 0, 0, 1, 0;
    triangle.F.resize(1, 3);
    triangle.F << 0, 1, 2;
    TriangleMesh far_away = cube_mesh(2);
    far_away.X = 1e9 * (far_away.X.array() + 5);
    TriangleMesh pair = cube_mesh(2);
    pair.F.conservativeResize(pair.F.rows() + 1, 3);
    pair.F.bottomRows(1) << 0, 1, 25;      // a fin
    TriangleMesh unequal = icosphere(1);   // 20 % of the box turns the small ball inside out
    const TriangleMesh small = moved_to(icosphere(1), (0.4 * icosphere(1).X).rowwise() + Eigen::RowVector3d(3, 0, 0));
    const auto n = unequal.X.rows(), m = unequal.F.rows();
    unequal.X.conservativeResize(2 * n, 3);
    unequal.X.bottomRows(n) = small.X;
    unequal.F.conservativeResize(2 * m, 3);
    unequal.F.bottomRows(m) = small.F.array() + static_cast<int>(n);
    int i = 0;
    for (const TriangleMesh& mesh : {triangle, far_away, cube_mesh(1), pair, unequal}) {
        const Answer answer =
            chapter_of_id("methods").answer(library_of(mesh, "methods_odd" + std::to_string(i++)), QuestionSettings(), no_progress);
        expect_well_formed(answer);
        expect_checks_pass(answer.section);
    }
}

}   // namespace meshfolio::methods
