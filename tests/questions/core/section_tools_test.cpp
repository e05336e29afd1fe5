#include "questions/core/section_tools.h"

#include <gtest/gtest.h>

#include "mesh/samples/sample_shapes.h"
#include "questions/core/study_laws.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;

namespace {

/// A study that the mesh called "bad" defeats.
std::string study_of(std::shared_ptr<const LibraryMesh> mesh, const QuestionSettings&) {
    if (mesh->name == "bad") throw SolverError("no factor", "clean the mesh");
    return mesh->name;
}

std::vector<std::string> studied(const std::vector<std::string>& names, report::Section& section) {
    LibraryMeshes meshes;
    for (const std::string& name : names) meshes.push_back(library_mesh(cube_mesh(1), name));
    return studies_of(meshes, "nothing", quick_settings(), no_progress, section, study_of);
}

}   // namespace

TEST(StudiesOf, AMeshThatDefeatsItsStudyCostsTheOthersNothing) {
    report::Section section;
    EXPECT_EQ(studied({"one", "bad", "two"}, section), (std::vector<std::string>{"one", "two"}));
    ASSERT_EQ(section.checks.size(), 1u);
    EXPECT_FALSE(section.checks.front().passed());
    EXPECT_EQ(section.checks.front().note, "bad.ply: no factor; clean the mesh");
}

TEST(StudiesOf, WithoutAnyTheSectionFailsAndNamesTheMesh) {
    report::Section section;
    try {
        studied({"bad", "bad"}, section);
        FAIL() << "nothing is left to study";
    } catch (const SolverError& error) {
        EXPECT_STREQ(error.what(), "bad.ply: no factor; clean the mesh; bad.ply: no factor; clean the mesh");
    }
}

TEST(ValueLists, AValueNamedTwiceIsOne) {
    EXPECT_EQ(each_once(std::vector{3, 1, 3, 2, 1}), (std::vector{1, 2, 3}));
    EXPECT_EQ(each_once(std::vector<double>{}), std::vector<double>{});
}

TEST(ValueLists, TheLastGivenCounts) {
    EXPECT_EQ(last_or({}, 7), 7);
    EXPECT_EQ(last_or({5, 3}, 7), 3);
}

TEST(ValueLists, RisesAreBetweenNeighbours) {
    const std::vector<double> values{5, 2, 3, 1, 1.5};
    EXPECT_EQ(largest_rise(values), 1);
    EXPECT_EQ(largest_rise(std::vector<double>(values.rbegin(), values.rend())), 3);
    EXPECT_EQ(largest_rise(std::vector<double>{3, 2, 1}), 0);
    EXPECT_EQ(largest_rise(std::vector<double>{1}), 0);
    EXPECT_EQ(largest_rise(std::vector<double>{}), 0);
}
