#include "questions/operators/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "mesh/samples/sample_shapes.h"
#include "mesh/vertex_noise.h"
#include "questions/bench/cotangent_study.h"
#include "questions/core/study_laws.h"

namespace meshfolio::operators {
using namespace testing_tools;

namespace {

/// Returns a bent open sheet of irregular triangles.
TriangleMesh bent_sheet() {
    TriangleMesh mesh = grid_mesh(9, 7, 1, 1);
    NormalNumbers random(5);
    for (Eigen::Index i = 0; i < mesh.X.rows(); ++i) {
        mesh.X(i, 0) += 0.03 * (2 * random.uniform() - 1);
        mesh.X(i, 1) = 3 * mesh.X(i, 1) + 0.03 * (2 * random.uniform() - 1);
        mesh.X(i, 2) = mesh.X(i, 0) * mesh.X(i, 0) - 0.2 * mesh.X(i, 1);
    }
    return mesh;
}

}   // namespace

TEST(OperatorLaboratory, EveryOperatorHasItsRow) {
    std::set<std::string> titles, ids;
    for (const LaboratoryOperator& laboratory_operator : laboratory_operators()) {
        EXPECT_TRUE(titles.insert(laboratory_operator.title()).second);
        EXPECT_TRUE(ids.insert(laboratory_operator.id()).second);
    }
    EXPECT_EQ(titles.size(), operator_list().size() + 2) << "all kinds, and the default with two other areas";
    const Answer answer = chapter_of_id("operators").answer(library_of(bent_sheet(), "sheet"), quick_settings(), no_progress);
    expect_well_formed(answer);
    expect_checks_pass(answer.section);
    const report::Table& table = table_named(answer.section, "operators_sheet_scores");
    ASSERT_EQ(table.rows.size(), titles.size());
    for (const auto& row : table.rows) EXPECT_TRUE(titles.count(std::get<std::string>(row.front())));
    EXPECT_EQ(answer.figures.front().panels.size(), titles.size()) << "small multiples, one an operator";
}

TEST(OperatorLaboratory, ChangesAreRelativeToTheDefault) {
    const LaboratoryMesh lab = laboratory_mesh(library_mesh(bent_sheet(), "sheet2"), quick_settings());
    const OperatorTrial &cotan = lab.trial(OperatorKind::cotan), &doubled = lab.trial(OperatorKind::cotan_no_half);
    EXPECT_EQ(cotan.critical_ratio, 1);
    EXPECT_EQ(cotan.spectrum_shift, 0);
    EXPECT_EQ(cotan.H_change, 0);
    EXPECT_NEAR(doubled.critical_ratio, 0.5, 1e-9);
    EXPECT_NEAR(doubled.spectrum_shift, 1, 1e-6);
    EXPECT_NEAR(doubled.H_change, 1, 1e-12);
    EXPECT_TRUE(std::isnan(lab.trial(OperatorKind::uniform).critical_ratio)) << "another unit";
    EXPECT_GT(lab.flips, 0);
}

TEST(OperatorLaboratory, ErrorsOnKnownSurfacesAreSmall) {
    const std::vector<KnownTrial> trials = known_trials(quick_settings());
    ASSERT_EQ(trials.size(), laboratory_operators().size());
    for (std::size_t i = 0; i < trials.size(); ++i) {
        const OperatorKind kind = laboratory_operators()[i].kind;
        const bool precise = kind == OperatorKind::cotan || kind == OperatorKind::cotan_no_half || kind == OperatorKind::idt ||
                             kind == OperatorKind::idt_original_mass || kind == OperatorKind::opposite_mean;
        if (kind == OperatorKind::tufted) continue;   // its flips round the boundary may bend linear functions near it
        EXPECT_EQ(trials[i].plane < 1e-10, precise) << laboratory_operators()[i].title();
        EXPECT_GT(trials[i].H_error[0], 0);
        // Question 3 has the same square and the same H.
        if (kind == OperatorKind::uniform) {
            EXPECT_EQ(trials[i].plane, irregular_plane(quick_settings().seed).uniform);
        }
        EXPECT_TRUE(kind != OperatorKind::cotan_no_half || std::abs(trials[i].eigenvalue_error - 1) < 0.1);
    }
}

TEST(OperatorLaboratory, NonPositiveAreasAreReported) {
    TriangleMesh mesh = grid_mesh(6, 6, 1, 1);
    mesh.X.col(1) += 3 * mesh.X.col(0);   // sheared: obtuse everywhere
    mesh.X.col(2) = 0.3 * mesh.X.col(0).cwiseAbs2();
    const LaboratoryMesh lab = laboratory_mesh(library_mesh(mesh, "sheared"), quick_settings());
    int without = 0;
    for (std::size_t i = 0; i < lab.trials.size(); ++i) {
        if (lab.trials[i].scores.without_mass == 0) continue;
        EXPECT_EQ(laboratory_operators()[i].area, AreaForm::voronoi);
        EXPECT_TRUE(std::isnan(lab.trials[i].scores.critical) && std::isnan(lab.trials[i].spectrum_shift));
        ++without;
    }
    EXPECT_EQ(without, 1);
    const Answer answer = chapter_of_id("operators").answer(library_of(mesh, "sheared"), quick_settings(), no_progress);
    expect_well_formed(answer);
    EXPECT_NE(prose_of(answer.section).find("Areas are not positive at"), std::string::npos);
}

TEST(OperatorLaboratory, TheTextFollowsTheFlips) {
    const Answer ball = chapter_of_id("operators").answer(library_of(icosphere(2), "lab_ball"), quick_settings(), no_progress);
    EXPECT_NE(prose_of(ball.section).find("no change beyond rounding"), std::string::npos) << "no edge is flipped";
    EXPECT_NE(report::plain(ball.section.answer).find("by less than 1\u202f%"), std::string::npos);
}

}   // namespace meshfolio::operators
