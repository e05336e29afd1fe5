#include <gtest/gtest.h>

#include "mesh/sample_shapes.h"
#include "questions/answer_laws.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;

TEST(Q7, BundledMeshesPassTheirOwnChecks) {
    const Answer answer = answer_q7(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
}

TEST(Q7, TheSeedDecidesTheNoise) {
    QuestionSettings settings = quick_settings();
    const MeshLibrary library = library_of(cube_mesh(6), "box7");
    const auto noisy = [&](std::uint64_t seed) {
        settings.seed = seed;
        return answer_q7(library, settings, no_progress).figures.front().panels[1].mesh->X;
    };
    EXPECT_EQ(noisy(1), noisy(1));
    EXPECT_NE(noisy(1), noisy(2));
}

TEST(Q7, WhereNoIterationHelpsTheReportSaysSo) {
    QuestionSettings settings = quick_settings();
    settings.noise = {1e-9};
    const Answer answer = answer_q7(library_of(cube_mesh(6), "nearly_clean"), settings, no_progress);
    expect_well_formed(answer);
    EXPECT_NE(prose_of(answer.section).find("no iteration is better than none"), std::string::npos);
}

TEST(Q7, TheTextFollowsTheData) {
    const auto prose = [](const TriangleMesh& mesh) {
        return prose_of(answer_q7(library_of(mesh, "body7"), quick_settings(), no_progress).section);
    };
    EXPECT_NE(prose(cube_mesh(6)), prose(grid_mesh(8, 8, 1, 1)));
}

TEST(Q7, EveryRealMesh) {
    const auto files = shared_meshes();
    if (files.empty()) GTEST_SKIP() << "no meshes beside the project";
    for (const auto& file : files) {
        if (std::filesystem::file_size(file) > 1000000) continue;
        SCOPED_TRACE(file);
        const Answer answer = answer_q7(MeshLibrary({}, {file}), quick_settings(), no_progress);
        expect_well_formed(answer);
        expect_checks_pass(answer.section);
    }
}
