// The index of many reports: what a row takes from a report, and that every file of it says the same.
#include "report/batch/batch.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "report/sample_document.h"
#include "report/test_tools.h"

namespace meshfolio::report {
namespace {

const BatchSources sources{{"edges", "certificates_connectivity-edges"}, {"euler_characteristic", "certificates_connectivity-chi"},
                           {"genus", "certificates_connectivity-genus"}, {"manifold", "certificates_connectivity-manifold"},
                           {"defects", "certificates_defects"},          {"lambda_critical", "q5_limits-lambda-crit"}};

/// A report as the preflight and question 5 leave it on one mesh.
Document report_on_a_mesh(std::vector<Check> checks, bool with_defects) {
    Input input;
    input.file = "a.obj", input.sha256 = "ab12", input.vertices = 8, input.triangles = 12;
    Section q5, preflight;
    q5.id = "q5";
    q5.checks = std::move(checks);
    q5.inputs = {input};
    q5.blocks = {Table{.id = "q5_limits", .columns = {{"mesh"}, {"λ_crit"}}, .rows = {{"a", 0.25}}}};
    preflight.id = "certificates";
    preflight.blocks = {Table{.id = "certificates_connectivity",
                              .columns = {{"mesh"}, {"edges"}, {"χ"}, {"genus"}, {"manifold"}},
                              .rows = {{"a", 18.0, 2.0, Cell(), "no"}}}};
    if (with_defects)
        preflight.blocks.push_back(
            Table{.id = "certificates_defects", .columns = {{"found"}, {"count"}, {"where"}}, .rows = {{"needles", 3.0, "a 3"}}});
    Document document;
    document.sections = {q5, preflight};
    document.timings = {{"all questions", 2}, {"up to writing", 3.5}};
    return document;
}

Batch three_rows() {
    const Document good = report_on_a_mesh({check_near("area", 1, 1.5, 2)}, false);
    const Document bad = report_on_a_mesh({check_near("area", 1, 1.5, 0.1), check_at_most("energy", 2, 1)}, true);
    Batch batch{
        {batch_row("a", "m/a.obj", good, true, sources), batch_row("b", hostile, bad, true, sources), {.name = "c", .file = "c.off"}}};
    batch.rows[0].report = "a/index.html";
    batch.rows[1].report = "b/index.html";
    batch.rows[2].state = BatchRow::State::failed;
    batch.rows[2].error = hostile;
    return batch;
}

TEST(Batch, ARowHasTheNumbersOfItsReport) {
    const BatchRow row = batch_row("a", "m/a.obj", report_on_a_mesh({check_near("area", 1, 1.5, 2)}, true), true, sources);
    EXPECT_EQ(row.state, BatchRow::State::good);
    EXPECT_EQ(row.sha256, "ab12");
    EXPECT_EQ(row.vertices, Cell(8.0));
    EXPECT_EQ(row.edges, Cell(18.0));
    EXPECT_EQ(row.genus, Cell());
    EXPECT_EQ(row.manifold, Cell("no"));
    EXPECT_EQ(row.lambda_critical, Cell(0.25));
    EXPECT_EQ(row.seconds, Cell(3.5));
    ASSERT_TRUE(row.defects.has_value());
    EXPECT_EQ(row.defects->front(), std::pair(std::string("needles"), 3.0));
}

TEST(Batch, NoDefectsDifferFromNotExamined) {
    Document document = report_on_a_mesh({}, false);
    EXPECT_EQ(batch_row("a", "a", document, true, sources).defects->size(), 0u);
    document.sections.back().status = Status::skipped;
    EXPECT_FALSE(batch_row("a", "a", document, true, sources).defects.has_value());
}

TEST(Batch, WithoutTimingsThereIsNoTime) {
    const Document document = report_on_a_mesh({}, false);
    EXPECT_EQ(batch_row("a", "a", document, false, sources).seconds, Cell());
    const Batch batch{{batch_row("a", "a", document, false, sources)}, false};
    EXPECT_EQ(write_csv(batch_table(batch)).find("time"), std::string::npos);
    EXPECT_EQ(write_batch_json(batch, "1").find("seconds"), std::string::npos);
}

TEST(Batch, ASectionOrACheckThatFailedMakesARowBad) {
    Document document = report_on_a_mesh({check_at_most("energy", 1, 2)}, false);
    EXPECT_EQ(batch_row("a", "a", document, true, sources).state, BatchRow::State::bad);
    document = report_on_a_mesh({undecided(check_at_most("energy", 1, 2), "why")}, false);
    EXPECT_EQ(batch_row("a", "a", document, true, sources).state, BatchRow::State::good);
    document.sections.front().status = Status::failed;
    EXPECT_EQ(batch_row("a", "a", document, true, sources).state, BatchRow::State::bad);
}

TEST(Batch, TheShareIsOneAtTheLimitAndMoreBeyond) {
    EXPECT_DOUBLE_EQ(used_share(check_near("x", 1, 1.5, 0.5)), 1);
    EXPECT_DOUBLE_EQ(used_share(check_at_most("x", 2.5, 1.5, 0.5)), 0.5);
    EXPECT_DOUBLE_EQ(used_share(check_at_least("x", 0.5, 1)), 0.5);
    EXPECT_EQ(used_share(check_at_most("x", 0.5, -3)), 0);
    EXPECT_EQ(used_share(check_at_most("x", 1, 0.98)), 0);   // by a theorem, and not nearly beyond it
    EXPECT_EQ(used_share(check_at_least("x", 1, 1, 1e-9)), 0);
    EXPECT_DOUBLE_EQ(used_share(check_at_least("x", 2, 1.5, 1)), 0.5);
    EXPECT_EQ(used_share(check_near("x", 1, 1, 0)), 0);
    EXPECT_EQ(used_share(check_at_least("x", 60, 60)), 0);   // a count, met exactly
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Check& check :
         {check_near("x", 1, 2, 0.5), check_near("x", 1, 2, 0), check_at_most("x", 0, 1), check_at_most("x", 1, 1.5),
          check_at_least("x", 2, 1), check_at_least("x", 2, -1), check_at_least("x", -1, -2), check_near("x", 1, nan, 1)}) {
        EXPECT_TRUE(check.failed()) << words_of(check);
        EXPECT_GT(used_share(check), 1) << words_of(check);
    }
}

TEST(Batch, TheWorstCheckIsAFailedOneIfThereIsAny) {
    Section section;
    section.id = "q1";
    section.checks = {check_near("close", 0, 0.9, 1), check_near("far", 0, 0.1, 1), undecided(check_near("unknown", 0, 9, 1), "why")};
    EXPECT_EQ(worst_check({section})->id, "q1-close");
    Section failing = section;
    failing.id = "q3";
    failing.checks.push_back(check_at_most("beyond", 1, 1.0001));
    EXPECT_EQ(worst_check({section, failing})->id, "q3-beyond");
    EXPECT_FALSE(worst_check({}).has_value());
}

TEST(Batch, ShowsTheCheckThatExceedsItsUsualShare) {
    Batch batch;
    for (const double own : {0.1, 0.2, 0.3, 0.6}) {
        Section section;
        section.id = "q1";
        section.checks = {check_near("always close", 0, 0.9, 1), check_near("this one", 0, own, 1),
                          undecided(check_near("open", 0, 9, 1), "why")};
        batch.rows.push_back({.name = "a", .file = "a", .sections = {section}});
    }
    const auto usual = usual_shares(batch);
    EXPECT_DOUBLE_EQ(usual.at("q1-this-one"), 0.2);
    EXPECT_EQ(worst_check(batch.rows.back().sections)->id, "q1-always-close");
    EXPECT_EQ(worst_check(batch.rows.back().sections, usual)->id, "q1-this-one");
    EXPECT_EQ(worst_check(batch.rows.front().sections, usual)->id, "q1-always-close") << "nothing is unusual";
    EXPECT_TRUE(worst_check(batch.rows.front().sections, usual)->is_usual);
    EXPECT_FALSE(worst_check(batch.rows.back().sections, usual)->is_usual);
    batch.rows.back().sections.front().checks.push_back(check_at_most("beyond", 1, 1.0001));
    EXPECT_EQ(worst_check(batch.rows.back().sections, usual)->id, "q1-beyond") << "a failed one comes first";
}

TEST(Batch, ChecksOfDifferentMeshesHaveOneCommonId) {
    Batch batch;
    for (const char* mesh : {"cube_8", "torus"}) {
        Section section;
        section.id = "q5";
        section.checks = {check_near(std::string("bound on ") + mesh, 0, *mesh == 'c' ? 0.5 : 0.9, 1)};
        batch.rows.push_back({.name = mesh, .file = mesh, .sections = {section}});
    }
    EXPECT_EQ(usual_shares(batch), (std::map<std::string, double>{{"q5-bound-on-", 0.5}}));
    EXPECT_DOUBLE_EQ(worst_check(batch.rows.back().sections, usual_shares(batch), "torus")->beyond, 0.4);
}

TEST(Batch, EveryFileHasEveryMeshOnce) {
    const Batch batch = three_rows();
    const auto json = nlohmann::json::parse(write_batch_json(batch, "1"));
    ASSERT_EQ(json["meshes"].size(), 3u);
    EXPECT_EQ(json["meshes"][0]["lambda_crit"], 0.25);
    EXPECT_EQ(json["units"]["lambda_crit"], "length²");
    EXPECT_TRUE(json["meshes"][0]["vertices"].is_number_integer()) << json["meshes"][0]["vertices"];
    EXPECT_EQ(json["meshes"][0]["checks"]["passed"], 1);
    EXPECT_EQ(json["meshes"][1]["worst_check"]["failed"], true);
    EXPECT_EQ(json["meshes"][1]["defects"][0]["count"], 3.0);
    EXPECT_EQ(json["meshes"][2]["status"], "failed");
    const Table table = batch_table(batch);
    ASSERT_EQ(table.rows.size(), 3u);
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
    const std::string junit = write_batch_junit(batch);
    EXPECT_NE(junit.find("<testsuite name=\"a: m/a.obj\" id=\"0\""), std::string::npos) << junit;
    EXPECT_NE(junit.find("tests=\"1\" failures=\"0\" errors=\"1\""), std::string::npos) << junit;
}

TEST(Batch, ThePageIsOneFileWithoutASource) {
    const std::string page = write_batch_page(three_rows(), "1", Templates());
    EXPECT_NE(page.find("<a href=\"a/index.html\">a</a>"), std::string::npos);
    EXPECT_NE(page.find("data-value=\"0.25\""), std::string::npos);
    EXPECT_NE(page.find("default-src &#39;none&#39;"), std::string::npos);
    EXPECT_NE(page.find("<h1>Reports on 3 meshes</h1>"), std::string::npos);
    for (const char* loaded : {"<link", " src=\"http", "@import", "<script src"}) EXPECT_EQ(page.find(loaded), std::string::npos) << loaded;
    EXPECT_EQ(page.find(hostile), std::string::npos);   // escaped, wherever it stands
}

}   // namespace
}   // namespace meshfolio::report
