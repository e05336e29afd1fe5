#include <gtest/gtest.h>

#include "base/file_bytes.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/bench/defects.h"
#include "questions/core/mesh_roles.h"
#include "questions/core/study_laws.h"
#include "temporary_folder.h"

namespace meshfolio::certificates {
using namespace testing_tools;

namespace {

Answer preflight_on(const TriangleMesh& mesh, const std::string& name) {
    return chapter_of_id("certificates").answer(library_of(mesh, name), quick_settings(), no_progress);
}

bool has_table(const report::Section& section, const std::string& id) {
    return std::any_of(section.blocks.begin(), section.blocks.end(), [&](const report::Block& block) {
        const auto* table = std::get_if<report::Table>(&block);
        return table != nullptr && table->id == id;
    });
}

TriangleMesh ball_with_defects() {
    TriangleMesh mesh = icosphere(2);
    mesh.X.conservativeResize(mesh.X.rows() + 1, 3);
    mesh.X.bottomRows(1) << 0, 0, 0;
    std::swap(mesh.F(3, 0), mesh.F(3, 1));
    mesh.F.conservativeResize(mesh.F.rows() + 2, 3);
    mesh.F.bottomRows(2) << mesh.F(9, 0), mesh.F(9, 1), mesh.F(9, 2), 1, 1, 2;
    return mesh;
}

}   // namespace

TEST(PreflightSection, BundledMeshesAreSoundAndListedOnce) {
    const Answer answer = chapter_of_id("certificates").answer(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    EXPECT_EQ(table_named(answer.section, "certificates_connectivity").rows.size(), answer.section.inputs.size());
    EXPECT_EQ(answer.section.inputs.size(), mesh_role_list().size());
}

TEST(PreflightSection, EveryDefectHasARowWithConsequenceAndRepair) {
    const Answer answer = preflight_on(ball_with_defects(), "pre_ball");
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    const report::Table& table = table_named(answer.section, "certificates_defects");
    EXPECT_EQ(numbers(table, "count"), (std::vector<double>{1, 1, 1, 1}));
    const auto found = cells(table, "found"), affects = cells(table, "affects"), done = cells(table, "what was done");
    std::size_t row = 0;
    for (const Defect& defect : defect_list()) {
        if (row == found.size() || std::get<std::string>(found[row]) != defect.name()) continue;
        EXPECT_EQ(std::get<std::string>(affects[row]), affected_for_people(defect));
        EXPECT_EQ(std::get<std::string>(done[row]), defect.done());
        ++row;
    }
    EXPECT_EQ(row, 4u);
    EXPECT_EQ(table_named(answer.section, "certificates_looked_for").rows.size(), defect_list().size());
    EXPECT_NE(prose_of(answer.section).find("dropped or turned on pre_ball"), std::string::npos);
}

// Most files have six decimals: that is no defect, but the text mentions it.
TEST(PreflightSection, ReportsTheRoundingOfTheFile) {
    TriangleMesh mesh = icosphere(2);
    mesh.X = ((mesh.X * 1e6).array().round() / 1e6).matrix().eval();
    const Answer answer = preflight_on(mesh, "pre_six");
    const double steps = numbers(table_named(answer.section, "certificates_geometry"), "steps of coordinates").front();
    EXPECT_NEAR(steps, 1e-6 / numbers(table_named(answer.section, "certificates_geometry"), "shortest edge").front(), 1e-12);
    EXPECT_NE(prose_of(answer.section).find("A file rounds its coordinates"), std::string::npos);
    EXPECT_EQ(prose_of(preflight_on(icosphere(2), "pre_full").section).find("A file rounds"), std::string::npos);
    EXPECT_EQ(prose_of(preflight_on(cube_mesh(1), "pre_grid").section).find("A file rounds"), std::string::npos);
}

TEST(PreflightSection, SoundMeshesHaveNoTableOfDefects) {
    const Answer answer = preflight_on(icosphere(2), "pre_sound");
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    EXPECT_FALSE(has_table(answer.section, "certificates_defects"));
    const std::vector<double> totals = numbers(table_named(answer.section, "certificates_looked_for"), "count in all");
    EXPECT_EQ(totals, std::vector<double>(defect_list().size(), 0));
    EXPECT_NE(prose_of(answer.section).find("Nothing is wrong with pre_sound"), std::string::npos);
}

TEST(PreflightSection, AnUnreadableMeshIsReportedAndTheRestIsAnswered) {
    const testing_tools::TemporaryFolder data;
    const std::filesystem::path folder = data.path() / "decompose";
    std::filesystem::create_directories(folder);
    write_file(folder / "armadillo.obj", "v 0 0 0\nf 1 2 3\n");
    const Answer answer = chapter_of_id("certificates").answer(MeshLibrary({data.path()}, {}), quick_settings(), no_progress);
    EXPECT_EQ(answer.section.inputs.size(), mesh_role_list().size() - 1);
    const auto failed =
        std::count_if(answer.section.checks.begin(), answer.section.checks.end(), [](const auto& c) { return !c.passed(); });
    EXPECT_EQ(failed, 1);
    EXPECT_NE(answer.section.warnings.front().find("armadillo"), std::string::npos);
}

TEST(PreflightSection, WordsFollowTheShapeAndTheFindings) {
    const std::string ball = prose_of(preflight_on(icosphere(2), "pre_even").section);
    EXPECT_NE(ball.find("No triangle is thin"), std::string::npos);
    EXPECT_EQ(ball.find("Some defects stay"), std::string::npos);
    TriangleMesh thin = icosphere(2);
    thin.X.col(2) *= 50;
    EXPECT_NE(prose_of(preflight_on(thin, "pre_thin").section).find("make explicit steps small"), std::string::npos);
    TriangleMesh seam = icosphere(2);
    seam.X.row(0) = seam.X.row(1);
    EXPECT_NE(prose_of(preflight_on(seam, "pre_seam").section).find("vertices exactly on an earlier one (pre_seam 1)"), std::string::npos);
    const Answer one = preflight_on(grid_mesh(4, 4, 1, 1), "pre_sheet");
    EXPECT_NE(report::plain(one.section.answer).find("the mesh departs from"), std::string::npos);
}

}   // namespace meshfolio::certificates
