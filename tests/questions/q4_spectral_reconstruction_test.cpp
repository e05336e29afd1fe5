#include <gtest/gtest.h>

#include "mesh/sample_shapes.h"
#include "questions/answer_laws.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;

namespace {

Answer answer_on(const TriangleMesh& mesh, const std::string& name, std::vector<int> k) {
    QuestionSettings settings = quick_settings();
    settings.k = std::move(k);
    return answer_q4(library_of(mesh, name), settings, no_progress);
}

const report::Table& table_named(const report::Section& section, const std::string& id) {
    for (const report::Block& block : section.blocks) {
        if (const auto* table = std::get_if<report::Table>(&block); table && table->id == id) return *table;
    }
    throw std::logic_error("no table " + id);
}

}   // namespace

TEST(Q4, BundledMeshPassesItsOwnChecks) {
    const Answer answer = answer_q4(MeshLibrary({}, {}), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    EXPECT_EQ(answer.meshes.size(), answer.section.output_meshes.size());
}

TEST(Q4, AllModesGiveTheMeshBack) {
    const Answer answer = answer_on(torus_mesh(24, 12, 1, 0.4), "torus_all", {5, 24 * 12});
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    EXPECT_EQ(answer.meshes.back().name, "q4_torus_all_k288.ply");
    EXPECT_LT((answer.meshes.back().mesh->X - torus_mesh(24, 12, 1, 0.4).X).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Q4, MoreModesThanVerticesAreCut) {
    const Answer answer = answer_on(cube_mesh(1), "cube_few", {3, 5000});
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    EXPECT_EQ(table_named(answer.section, "q4_cube_few_errors").rows.size(), 2u);
}

TEST(Q4, ErrorFallsWithK) {
    const Answer answer = answer_on(ellipsoid_mesh(3, {1.7, 1.1, 0.6}), "egg", {4, 9, 16, 25});
    const report::Table& table = table_named(answer.section, "q4_egg_errors");
    for (std::size_t i = 1; i < table.rows.size(); ++i)
        EXPECT_LT(std::get<double>(table.rows[i][2]), std::get<double>(table.rows[i - 1][2]));
}

TEST(Q4, TheTextFollowsTheData) {
    EXPECT_NE(prose_of(answer_on(cube_mesh(6), "body", {5, 20}).section), prose_of(answer_on(icosphere(2), "body", {5, 20}).section));
}

TEST(Q4, EveryRealMesh) {
    const auto files = shared_meshes();
    if (files.empty()) GTEST_SKIP() << "no meshes beside the project";
    for (const auto& file : files) {
        if (std::filesystem::file_size(file) > 1000000) continue;
        SCOPED_TRACE(file);
        QuestionSettings settings = quick_settings();
        settings.k = {5, 20};
        const Answer answer = answer_q4(MeshLibrary({}, {file}), settings, no_progress);
        expect_well_formed(answer);
        expect_checks_pass(answer.section);
    }
}
