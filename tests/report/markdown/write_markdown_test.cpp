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

TEST(WriteMarkdown, ListsEndWithoutSeparator) {
    for (const std::string& line : lines_of(sample_text())) EXPECT_FALSE(line.ends_with("; ") || line.ends_with("; |")) << line;
}

/// A supporting section far too long: tables and figures, then the discussion, to which an answer refers.
Document with_long_section() {
    Document document = sample_document();
    Section supporting = document.sections[0];
    supporting.id = "truth";
    supporting.blocks = {Heading{"Results"}};
    const auto add_table = [&](const std::string& id, int rows) {
        Table table;
        table.id = id;
        table.caption = "Caption of " + id + ".";
        table.columns = {{"words"}};
        for (int r = 0; r < rows; ++r) table.rows.push_back({std::string(20000, 'x')});
        supporting.blocks.emplace_back(std::move(table));
    };
    for (int i = 0; i < 4; ++i) add_table("truth_long_" + std::to_string(i), 4);
    add_table("truth_short", 1);
    for (int i = 0; i < 100; ++i) {
        Table table;
        table.id = "truth_many_" + std::to_string(i);
        table.caption = std::string(3000, 'c');
        table.columns = {{"number"}};
        table.rows = {{1.0}};
        supporting.blocks.emplace_back(std::move(table));
    }
    supporting.blocks.push_back(Heading{"Discussion"});
    supporting.blocks.push_back(Paragraph{text("What is concluded from ", ref("truth_many_99"), ".")});
    document.sections[0].blocks.push_back(Paragraph{text("It rests on ", ref("truth_many_98"), ".")});
    document.sections.push_back(supporting);
    return document;
}

TEST(WriteMarkdown, WhatIsCutLeavesNoDeadLinkAndNoDanglingAnchor) {
    const std::string cut = write_markdown(with_long_section(), sample_figures(), Templates());
    EXPECT_LE(cut.size(), std::size_t{256 << 10});
    expect_links_with_targets(cut);
    EXPECT_NE(cut.find("It rests on [Table B.104](index.html#truth_many_98)."), std::string::npos);
    EXPECT_EQ(matches(cut, "(</a>\n\n\\*What stood here)").size(), 0u);
}

TEST(WriteMarkdown, TablesAreCutBeforeConclusions) {
    const std::string cut = write_markdown(with_long_section(), sample_figures(), Templates());
    EXPECT_NE(cut.find("What is concluded from [Table B.105](index.html#truth_many_99)."), std::string::npos);
    EXPECT_NE(cut.find("Caption of truth_long_0."), std::string::npos);
    EXPECT_EQ(cut.find(std::string(20000, 'x')), std::string::npos);
    EXPECT_NE(cut.find("*Its rows are left out"), std::string::npos);
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
    EXPECT_NE(sample_text({.timings = true, .plot_files = true}).find("](images/q1_error_versus_k.svg)"), std::string::npos);
}

TEST(WriteMarkdown, MapsAreDescribedOrShown) {
    EXPECT_NE(sample_text().find("**Figure 1.4.** Error over step and iteration. ([data](tables/q1_error_map.csv)) The error grows"),
              std::string::npos);
    EXPECT_NE(sample_text({.timings = true, .plot_files = true}).find("](images/q1_error_map.svg)"), std::string::npos);
}

TEST(WriteMarkdown, NeverExceedsItsLimit) {
    constexpr std::size_t limit = 256 << 10;
    Document document = sample_document();
    DrawnFigures figures;
    for (int i = 0; i < 150; ++i) {
        const std::string id = "q1_many_" + std::to_string(i);
        document.sections[0].blocks.push_back(Figure{id, "caption", "alt"});
        DrawnFigure& drawn = figures[id];
        for (int v = 0; v < 42; ++v)
            drawn.panels.push_back({"λ = 0." + std::to_string(v),
                                    {{"+x", 0, 0, 9, 9, "images/" + id + "_" + std::string(40, 'n') + std::to_string(v) + ".png", ""}}});
    }
    const std::string without_views = write_markdown(document, figures, Templates());
    EXPECT_LE(without_views.size(), limit);
    EXPECT_EQ(without_views.find("Single views"), std::string::npos);
    EXPECT_NE(without_views.find("## References"), std::string::npos);   // whole apart from that
    for (int i = 0; i < 300; ++i) document.sections[0].blocks.push_back(Paragraph{text(std::string(2000, 'x'))});
    const std::string cut = write_markdown(document, figures, Templates());
    EXPECT_LE(cut.size(), limit);
    EXPECT_NE(cut.find("see* `index.html`"), std::string::npos);
    EXPECT_GT(cut.size(), limit - 4096) << "no more is left out than must be";
    for (const char* whole : {"<a id=\"q1\"></a>\n\n## 1 ", "<a id=\"q2\"></a>\n\n## 2 ", "<a id=\"q3\"></a>\n\n## 3 ", "## References",
                              "## Provenance", "## Checks", "ellipsoid.obj:3: not a number"}) {
        EXPECT_NE(cut.find(whole), std::string::npos) << whole;
    }
}

TEST(WriteMarkdown, AnswersToQuestionsStayWholeWhileTheOthersAreCut) {
    Document document = sample_document();
    Section supporting = document.sections[0];
    supporting.blocks.clear();
    supporting.id = "truth";
    for (int i = 0; i < 100; ++i) {
        supporting.blocks.push_back(Paragraph{text(std::string(2000, 'x'))});
        document.sections[0].blocks.push_back(Paragraph{text(std::string(1000, 'y'))});
    }
    document.sections[0].blocks.push_back(Paragraph{text("The last word of the answer.")});
    supporting.blocks.push_back(Paragraph{text("The last word of what it rests on.")});
    document.sections.push_back(supporting);
    const std::string text = write_markdown(document, sample_figures(), Templates());
    EXPECT_LE(text.size(), std::size_t{256 << 10});
    EXPECT_NE(text.find("The last word of the answer."), std::string::npos);
    EXPECT_EQ(text.find("The last word of what it rests on."), std::string::npos);
    EXPECT_NE(text.find("## A "), std::string::npos);
}

TEST(WriteMarkdown, UndecidedChecksAreCountedAndNamed) {
    const std::string text = sample_text();
    EXPECT_NE(text.find("3 of 6 checks passed, 2 failed, 1 undecided.**"), std::string::npos);
    EXPECT_NE(text.find("| 2/5, 2 failed, 1 undecided |"), std::string::npos);
    EXPECT_NE(text.find("**3 of 6 passed, 2 failed, 1 undecided.** What is undecided is no failure"), std::string::npos);
    EXPECT_NE(text.find("count below σ (<i>rounding is larger than the gap</i>) | ≤\u202f30 | – | 0 | *undecided* |"), std::string::npos);
    EXPECT_NE(text.find("| **no** |"), std::string::npos) << "what failed has another mark";
}

TEST(WriteMarkdown, ChecksThatPassedAreLeftOutBeforeRowsAre) {
    Document document = sample_document();
    for (int i = 0; i < 3000; ++i) document.sections[1].checks.push_back(check_near("passes " + std::string(80, 'x'), 1, 1, 0));
    const std::string text = write_markdown(document, sample_figures(), Templates());
    EXPECT_EQ(text.find("passes x"), std::string::npos);
    EXPECT_NE(text.find("order of convergence on torus"), std::string::npos) << "what failed is still told";
    EXPECT_NE(text.find("count below σ"), std::string::npos) << "and what is undecided";
    EXPECT_NE(text.find("Those that passed are listed in `index.html`"), std::string::npos);
    EXPECT_EQ(sample_text().find("Those that passed are listed"), std::string::npos);
    EXPECT_EQ(text.find("see* `index.html`"), std::string::npos) << "nothing had to be cut";
}

}   // namespace
}   // namespace meshfolio::report
