#include <gtest/gtest.h>

#include "mesh/sample_shapes.h"
#include "questions/answer_laws.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;

TEST(Q6, BundledMeshesPassTheirOwnChecks) {
    const Answer answer = answer_q6(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
}

TEST(Q6, AbsurdStepsStayStable) {
    QuestionSettings settings = quick_settings();
    settings.lambda = {1e9};
    const Answer answer = answer_q6(library_of(icosphere(2), "ball6"), settings, no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
}

TEST(Q6, TheTextFollowsTheData) {
    const auto prose = [](const TriangleMesh& mesh) {
        return prose_of(answer_q6(library_of(mesh, "body6"), quick_settings(), no_progress).section);
    };
    EXPECT_NE(prose(cube_mesh(6)), prose(grid_mesh(8, 8, 1, 1)));
}

TEST(Q6, EveryRealMesh) {
    const auto files = shared_meshes();
    if (files.empty()) GTEST_SKIP() << "no meshes beside the project";
    for (const auto& file : files) {
        if (std::filesystem::file_size(file) > 1000000) continue;
        SCOPED_TRACE(file);
        const Answer answer = answer_q6(MeshLibrary({}, {file}), quick_settings(), no_progress);
        expect_well_formed(answer);
        expect_checks_pass(answer.section);
    }
}
