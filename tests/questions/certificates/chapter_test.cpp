#include <gtest/gtest.h>

#include "mesh/samples/sample_shapes.h"
#include "questions/certificates/planted_faults.h"
#include "questions/core/study_laws.h"

namespace meshfolio::certificates {
using namespace testing_tools;

namespace {

Answer answer_on(const TriangleMesh& mesh, const std::string& name) {
    return chapter_of_id("certificates").answer(library_of(mesh, name), quick_settings(), no_progress);
}

}   // namespace

TEST(CertificatesSection, AllChecksHoldOnOpenPlainAndFineMeshes) {
    for (const auto& [name, mesh] : {std::pair{"cert_grid", grid_mesh(9, 7, 2, 1)}, std::pair{"cert_box", cube_mesh(1)},
                                     std::pair{"cert_torus", torus_mesh(30, 12, 1, 0.4)}}) {
        SCOPED_TRACE(name);
        const Answer answer = answer_on(mesh, name);
        expect_well_formed(answer);
        expect_checks_pass(answer.section);
    }
}

// An edge is a million times longer than the others: an eigenvalue is as small as rounding, and a triangle has no area.
TEST(CertificatesSection, NoCheckFailsOnAMeshAMillionTimesLongerThanWide) {
    TriangleMesh mixed{Positions(4, 3), Faces(4, 3)};
    mixed.F << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    for (const double width : {1e-6, 1.0}) {
        mixed.X << 0, 0, 0, 1e6, 0, 0, 0, width, 0, 0, 0, 1;
        const report::Score score = report::score_of(answer_on(mixed, width < 1 ? "cert_mixed" : "cert_needle").section.checks);
        EXPECT_EQ(score.failed, 0u) << width;
    }
}

TEST(CertificatesSection, TheTableOfFaultsHasEveryFaultWithItsMeasuredValues) {
    const Answer answer = answer_on(icosphere(2), "cert_ball");
    const report::Table& table = table_named(answer.section, "certificates_faults");
    const std::vector<PlantedFault> faults = planted_faults();
    ASSERT_EQ(table.rows.size(), faults.size());
    const std::vector<FaultTrial> trials = trials_of(ellipsoid_specimen());
    const auto caught = cells(table, "caught");
    for (std::size_t i = 0; i < faults.size(); ++i) {
        EXPECT_EQ(std::get<std::string>(table.rows[i][0]), faults[i].name);
        EXPECT_EQ(std::get<std::string>(caught[i]) == "yes", trials[i].caught());
        EXPECT_EQ(std::get<double>(cells(table, "with the fault")[i]), trials[i].faulty.measured);
    }
}

TEST(CertificatesSection, TheTableOfSpectraHasTheMeasuredValues) {
    QuestionSettings settings = quick_settings();
    settings.k = {9};
    const TriangleMesh mesh = icosphere(3);
    const Answer answer = chapter_of_id("certificates").answer(library_of(mesh, "cert_ball_nine"), settings, no_progress);
    const report::Table& table = table_named(answer.section, "certificates_spectra");
    EXPECT_EQ(numbers(table, "k"), std::vector<double>{9});
    EXPECT_EQ(numbers(table, "counted"), std::vector<double>{9});   // 1 + 3 + 5: no cluster is cut
    EXPECT_EQ(numbers(table, "found"), std::vector<double>{9});
    EXPECT_EQ(std::get<std::string>(cells(table, "verdict")[0]), "proved");
    EXPECT_NEAR(numbers(table, "σ")[0], 9, 0.2);   // in the middle between l(l + 1) = 6 and 12
    EXPECT_LT(numbers(table, "δ")[0], 1e-3 * numbers(table, "gap")[0]);
}

}   // namespace meshfolio::certificates
