#include <gtest/gtest.h>

#include "mesh/sample_shapes.h"
#include "questions/answer_laws.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;

TEST(Q5, BundledMeshesPassTheirOwnChecks) {
    const Answer answer = answer_q5(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    // Beyond the limit something must be told about growth.
    EXPECT_NE(prose_of(answer.section).find("Too large a step amplifies"), std::string::npos);
}

TEST(Q5, OnlyStepsBelowTheLimitAreRecommended) {
    QuestionSettings settings = quick_settings();
    settings.lambda = {1e3};   // far beyond the limit of a unit sphere
    const Answer answer = answer_q5(library_of(icosphere(2), "ball"), settings, no_progress);
    expect_well_formed(answer);
    EXPECT_NE(prose_of(answer.section).find("none can be recommended"), std::string::npos);
}

TEST(Q5, TheTextFollowsTheData) {
    const auto prose = [](const TriangleMesh& mesh) {
        return prose_of(answer_q5(library_of(mesh, "body5"), quick_settings(), no_progress).section);
    };
    EXPECT_NE(prose(cube_mesh(6)), prose(grid_mesh(8, 8, 1, 1)));
}

TEST(Q5, EveryRealMesh) {
    const auto files = shared_meshes();
    if (files.empty()) GTEST_SKIP() << "no meshes beside the project";
    for (const auto& file : files) {
        if (std::filesystem::file_size(file) > 1000000) continue;
        SCOPED_TRACE(file);
        const Answer answer = answer_q5(MeshLibrary({}, {file}), quick_settings(), no_progress);
        expect_well_formed(answer);
        expect_checks_pass(answer.section);
    }
}
