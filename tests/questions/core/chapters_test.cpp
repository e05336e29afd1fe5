// Laws of every chapter: its own checks pass, and a mesh that cannot be used is said and loses no section.
#include <gtest/gtest.h>

#include <set>

#include "mesh/io/mesh_files.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_laws.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;

namespace {

/// A cube pressed flat into a needle: triangles without any area, whose operator has no mass.
TriangleMesh without_area() {
    TriangleMesh mesh = cube_mesh(3);
    mesh.X.rightCols(2).setZero();
    return mesh;
}

class BundledMeshes : public testing::TestWithParam<std::string> {};

/// New ones among them, until their own folder has a test of that.
std::vector<std::string> chapters_without_a_test_of_their_own() {
    static const std::set<std::string> tested_in_their_folder{"q1", "q2", "q4", "q5", "truth", "stability", "modes"};
    std::vector<std::string> ids = section_ids();
    std::erase_if(ids, [](const std::string& id) { return tested_in_their_folder.contains(id); });
    return ids;
}

class RealMeshes : public testing::TestWithParam<const char*> {};
/// A mesh that can be read but has no area, beside one that can be used.
class UnusableMesh : public testing::TestWithParam<const char*> {};

}   // namespace

TEST_P(BundledMeshes, PassTheChecksOfTheChapter) {
    const Answer answer = chapter_of_id(GetParam()).answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
}

INSTANTIATE_TEST_SUITE_P(EverySection, BundledMeshes, testing::ValuesIn(chapters_without_a_test_of_their_own()));

TEST_P(RealMeshes, PassTheChecksOfTheChapter) { check_real_meshes(chapter_of_id(GetParam()).answer); }

INSTANTIATE_TEST_SUITE_P(EverySection, RealMeshes, testing::Values("certificates", "q5", "q6", "q7", "modes", "methods"));

TEST_P(UnusableMesh, IsAFailedCheckBesideTheAnswerOnTheOther) {
    const TemporaryFolder folder;
    const auto good = folder.path() / "good.ply", flat = folder.path() / "pressed.ply";
    write_mesh(good, cube_mesh(3));
    write_mesh(flat, without_area());
    const Chapter* question = &chapter_of_id(GetParam());
    ASSERT_NE(question, nullptr);
    const Answer answer = question->answer(MeshLibrary({}, {flat, good}), quick_settings(), no_progress);
    EXPECT_EQ(answer.section.status, report::Status::ok);
    EXPECT_NE(answer.section.extent.find("good"), std::string::npos) << answer.section.extent;
    if (misses_a_mesh(answer.section)) {
        EXPECT_EQ(answer.section.extent.find("pressed"), std::string::npos) << answer.section.extent;
    }
    int failed = 0;
    for (const report::Check& check : answer.section.checks) {
        if (check.passed()) continue;
        ++failed;
        EXPECT_NE((check.name + check.note).find("pressed"), std::string::npos) << check.name << ": " << check.note;
    }
    EXPECT_GT(failed, 0);
    EXPECT_GT(answer.section.checks.size(), 1u) << "those of the other mesh";
}

INSTANTIATE_TEST_SUITE_P(EverySection, UnusableMesh,
                         testing::Values("q4", "q5", "q6", "q7", "stability", "modes", "methods", "operators", "certificates"));
