#include <gtest/gtest.h>

#include "report/escape.h"
#include "report/sample_document.h"
#include "report/test_tools.h"
#include "report/writers.h"

namespace meshfolio::report {
namespace {

std::string sample_text(const WriteOptions& options = {}) {
    return write_markdown(sample_document(), sample_figures(), Templates(), options);
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines(1);
    for (const char c : text) {
        if (c == '\n') {
            lines.emplace_back();
        } else {
            lines.back() += c;
        }
    }
    return lines;
}

/// Bars that separate cells: those without a backslash in front.
std::size_t cell_bars(const std::string& line) {
    std::size_t bars = 0;
    for (std::size_t i = 0; i < line.size(); ++i) bars += line[i] == '|' && (i == 0 || line[i - 1] != '\\');
    return bars;
}

/// Every table has a head, and all its lines have as many cells.
void expect_whole_tables(const std::string& text) {
    std::size_t width = 0, tables = 0;
    bool below_head = false;
    for (const std::string& line : lines_of(text)) {
        if (line.empty() || line.front() != '|') {
            width = 0;
            continue;
        }
        if (width == 0) {
            width = cell_bars(line);
            ++tables;
            below_head = true;
        } else if (below_head) {
            EXPECT_EQ(line.find_first_not_of("|:- "), std::string::npos) << "no head above " << line;
            below_head = false;
        }
        EXPECT_EQ(cell_bars(line), width) << line;
    }
    EXPECT_GE(tables, 6u);
}

TEST(WriteMarkdown, TablesKeepTheirCells) {
    expect_whole_tables(sample_text());
    expect_whole_tables(write_markdown(hostile_document(), hostile_figures(), Templates()));
    Document little_known = sample_document();
    little_known.provenance = {};
    expect_whole_tables(write_markdown(little_known, sample_figures(), Templates()));
}

TEST(WriteMarkdown, PicturesAreRelativeAndFormulasAreTex) {
    const std::string text = sample_text();
    EXPECT_NE(text.find("![A plane from six directions, values from 0 to 1.](images/q1_plane_h_sheet.png)"), std::string::npos);
    EXPECT_NE(text.find("$$\n(\\Delta_{\\text{uni}}"), std::string::npos);
    EXPECT_NE(text.find("\\tag*{ (1.1) }"), std::string::npos);
    EXPECT_EQ(text.find("data:"), std::string::npos);
    EXPECT_EQ(text.find("<math"), std::string::npos);
}

void expect_links_with_targets(const std::string& text) {
    const auto anchors = matches(text, "<a id=\"([^\"]*)\"></a>");
    const std::set<std::string> ids(anchors.begin(), anchors.end());
    EXPECT_EQ(ids.size(), anchors.size());
    const auto links = matches(text, "\\]\\(#([^)]*)\\)");
    EXPECT_GT(links.size(), 10u);
    for (const std::string& link : links) EXPECT_TRUE(ids.contains(link)) << link;
}

TEST(WriteMarkdown, LinksWithinHaveTheirTargets) { expect_links_with_targets(sample_text()); }

TEST(WriteMarkdown, LinksToTheOtherVolume) {
    Document document = sample_document();
    document.sections[0].appendix_from = static_cast<int>(document.sections[0].blocks.size()) - 2;
    document.sections[0].answer = text("See ", ref("q1_before_after"), " and ", ref("ground_truth"), ".");
    const std::string report = write_markdown(document, sample_figures(), Templates());
    expect_links_with_targets(report);
    EXPECT_NE(report.find("[Figure 1.5](appendix.md#q1_before_after) and [Section A](appendix.md#ground_truth)"), std::string::npos);
    const std::string appendix = write_markdown(document, sample_figures(), Templates(), {.volume = Volume::appendix});
    EXPECT_NE(appendix.find("<a id=\"q1_before_after\"></a>"), std::string::npos);
    EXPECT_EQ(appendix.find("<a id=\"q1_errors\"></a>"), std::string::npos);
}

TEST(WriteMarkdown, ListsEndWithoutSeparator) {
    for (const std::string& line : lines_of(sample_text())) EXPECT_FALSE(line.ends_with("; ") || line.ends_with("; |")) << line;
}

TEST(WriteMarkdown, HostileNamesStayText) {
    const std::string text = write_markdown(hostile_document(), hostile_figures(), Templates());
    EXPECT_EQ(text.find("<script"), std::string::npos);
    EXPECT_NE(text.find("&lt;script&gt;alert(1)"), std::string::npos);
    for (const char c : text) EXPECT_FALSE(static_cast<unsigned char>(c) < 0x20 && c != '\n') << int(c);
}

TEST(WriteMarkdown, LongTablesPointToTheirCsv) {
    EXPECT_NE(sample_text().find("… 410 rows more in the CSV file"), std::string::npos);
    EXPECT_NE(sample_text().find("([CSV](tables/q1_long.csv))"), std::string::npos);
}

TEST(WriteMarkdown, PlotsAreLinkedOnlyWhenTheirFilesAreThere) {
    EXPECT_EQ(sample_text().find("images/q1_error_versus_k.svg"), std::string::npos);
    EXPECT_NE(sample_text({.plot_files = true}).find("](images/q1_error_versus_k.svg)"), std::string::npos);
}

TEST(WriteMarkdown, MapsAreDescribedOrShown) {
    EXPECT_NE(sample_text().find("**Figure 1.4.** Error over step and iteration. ([data](tables/q1_error_map.csv)) The error grows"),
              std::string::npos);
    EXPECT_NE(sample_text({.plot_files = true}).find("](images/q1_error_map.svg)"), std::string::npos);
}

TEST(WriteMarkdown, UndecidedChecksAreCountedAndNamed) {
    EXPECT_NE(sample_text().find("3 of 6 checks passed, 2 failed, 1 undecided.**"), std::string::npos);
    const std::string text = sample_text({.volume = Volume::appendix});
    EXPECT_NE(text.find("**3 of 6 passed, 2 failed, 1 undecided.** An undecided check is no failure"), std::string::npos);
    EXPECT_NE(text.find("count below <i>σ</i> (<i>rounding is larger than the gap</i>) | ≤\u202f30 | – | 0 | *undecided* |"),
              std::string::npos);
    EXPECT_NE(text.find("| **no** |"), std::string::npos) << "what failed has another mark";
}

TEST(WriteMarkdown, ChecksThatPassedAreLeftOutWhereTheFileWouldBeTooLong) {
    Document document = sample_document();
    for (int i = 0; i < 3000; ++i) document.sections[1].checks.push_back(check_near("passes " + std::string(80, 'x'), 1, 1, 0));
    const std::string text = write_markdown(document, sample_figures(), Templates(), {.volume = Volume::appendix});
    EXPECT_LT(text.size(), std::size_t{256 << 10});
    EXPECT_EQ(text.find("passes x"), std::string::npos);
    EXPECT_NE(text.find("order of convergence on torus"), std::string::npos) << "what failed is still told";
    EXPECT_NE(text.find("count below <i>σ</i>"), std::string::npos) << "and what is undecided";
    EXPECT_NE(text.find("The checks that passed are listed in `appendix.html`"), std::string::npos);
    EXPECT_EQ(sample_text({.volume = Volume::appendix}).find("The checks that passed are listed"), std::string::npos);
}

TEST(WriteSummary, HasEveryAnswerAndTheChecksThatDidNotPass) {
    const std::string text = write_summary(sample_document(), Templates());
    EXPECT_NE(text.find("| 1 Uniform Laplace curvature | complete | <i>H</i> of the sphere is <b>0.88 %</b> off"), std::string::npos)
        << text;
    EXPECT_NE(text.find("| **failed** | ellipsoid.obj:3: not a number"), std::string::npos);
    EXPECT_NE(text.find("order of convergence on torus"), std::string::npos);
    EXPECT_EQ(text.find("L2 error of H on sphere"), std::string::npos) << "it passed";
}

TEST(WriteSummary, IsNeverLongerThanAJobSummaryShouldBe) {
    Document document = sample_document();
    for (int i = 0; i < 300; ++i) document.sections[0].checks.push_back(check_near("fails " + std::string(80, 'x'), 1, 2, 0));
    const std::string text = write_summary(document, Templates());
    EXPECT_LE(text.size(), 20'000u);
    EXPECT_NE(text.find("fails xxx"), std::string::npos);
    document.sections[0].warnings.assign(500, std::string(200, 'w'));
    EXPECT_LE(write_summary(document, Templates()).size(), 20'000u);
    EXPECT_LE(write_summary(hostile_document(), Templates()).size(), 20'000u);
}

}   // namespace
}   // namespace meshfolio::report
