#include "report/pdf/print_page.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/errors.h"
#include "report/page/view_extent.h"
#include "report/pdf/print_pdf.h"
#include "report/sample_document.h"
#include "report/test_tools.h"

namespace meshfolio::report {
namespace {

/// The sample, its first section one that answers no question.
Document supporting_document() {
    Document document = sample_document();
    document.sections[0].id = "truth";
    return document;
}

PrintPage printed(const Document& document, PrintOptions options = {}) {
    return print_page(document, sample_figures(), Templates(), options);
}

constexpr PrintOptions whole{.extent = Extent::whole};

TEST(PrintPage, EveryLinkHasItsTargetInThePage) {
    for (const Document& document : {sample_document(), supporting_document(), hostile_document()}) {
        for (const PrintOptions& options : {PrintOptions{}, whole}) {
            const std::string page = body_of(printed(document, options).html);
            std::set<std::string> ids;
            for (const std::string& id : matches(page, " id=\"([^\"]*)\"")) EXPECT_TRUE(ids.insert(id).second) << id << " twice";
            for (const std::string& link : matches(page, " href=\"([^\"]*)\""))
                EXPECT_TRUE(link[0] == '#' && ids.contains(link.substr(1))) << link;
        }
    }
}

TEST(PrintPage, EveryPictureIsAFileBesideIt) {
    const PrintPage page = printed(sample_document());
    const auto sources = matches(page.html, " src=\"([^\"]*)\"");
    EXPECT_FALSE(sources.empty());
    for (const std::string& source : sources) EXPECT_TRUE(page.files.contains(source)) << source;
    EXPECT_EQ(page.files.size(), std::set<std::string>(sources.begin(), sources.end()).size());
}

TEST(PrintPage, IsWellFormedXml) {
    if (!has_program("xmllint")) GTEST_SKIP() << "xmllint is not installed";
    const TemporaryFolder folder;
    for (const Document& document : {sample_document(), supporting_document(), hostile_document(), Document()}) {
        const auto file = folder.write("page.html", printed(document).html);
        EXPECT_TRUE(succeeds("xmllint --noout '" + file.string() + "'"));
    }
}

TEST(PrintPage, ImagesHaveNoBackground) {
    // Chromium paints such a background now before, now after the picture: the PDF would differ from run to run.
    for (const std::string& rule : matches(Templates()["print.css"], "([^{}]*img[^{}]*\\{[^}]*\\})"))
        EXPECT_EQ(rule.find("background"), std::string::npos) << rule;
}

TEST(PrintPage, FormulasArePlainForEnginesWithoutMathml) {
    EXPECT_NE(printed(sample_document()).html.find("<math"), std::string::npos);
    EXPECT_EQ(printed(sample_document(), {.mathml = false}).html.find("<math"), std::string::npos);
}

TEST(PrintPage, UndecidedChecksAreListedInAWordAndAreNoFailure) {
    Document document = sample_document();
    for (const PrintOptions& options : {PrintOptions{}, whole}) {
        const std::string page = body_of(printed(document, options).html);
        EXPECT_NE(page.find("3 of 6 checks passed, 2 failed, 1 undecided.</p>"), std::string::npos) << "on the first page";
        EXPECT_NE(page.find("</strong>, 2 failed, 1 undecided</td>"), std::string::npos) << "in the opening table";
        EXPECT_NE(page.find("2 of 5 checks passed, 2 failed, 1 undecided.</figcaption>"), std::string::npos);
        EXPECT_NE(page.find("<span class=\"note\">rounding is larger than the gap</span>"), std::string::npos);
        EXPECT_NE(page.find("<td><em>undecided</em></td>"), std::string::npos);
    }
    document.sections.resize(1);
    std::erase_if(document.sections[0].checks, [](const Check& check) { return check.failed(); });
    EXPECT_EQ(body_of(printed(document).html).find("class=\"failure\""), std::string::npos);
    EXPECT_EQ(body_of(printed(document).html).find("All 3 checks"), std::string::npos);
}

TEST(PrintPage, HasNoTimings) {
    ASSERT_NE(write_html(sample_document(), sample_figures(), Templates()).find("Timings"), std::string::npos);
    for (const PrintOptions& options : {PrintOptions{}, whole})
        EXPECT_EQ(printed(sample_document(), options).html.find("Timings"), std::string::npos);
}

TEST(PrintPage, LongTablesAreCut) {
    Document document = sample_document();
    Table table{"q1_forty", "Long", {{.name = "number"}}, {}};
    for (int i = 0; i < 40; ++i) table.rows.push_back({static_cast<double>(i)});
    document.sections[0].blocks.push_back(table);
    EXPECT_NE(printed(document, {.table_rows = 10}).html.find("30 rows only in tables/q1_forty.csv"), std::string::npos);
    EXPECT_EQ(printed(document, whole).html.find("rows only in tables/q1_forty.csv"), std::string::npos);
}

TEST(PrintPage, ATableThatIsHardlyTooLongIsPrintedWhole) {
    for (const auto& [rows, is_cut] : {std::pair{14, false}, {15, true}}) {
        Document document = supporting_document();
        Table table{"truth_table", "", {{.name = "number"}}, {}};
        table.rows.assign(static_cast<std::size_t>(rows), {1.0});
        document.sections[0].blocks = {table};
        EXPECT_EQ(printed(document, {.table_rows = 10}).html.find("only in tables/truth_table.csv") != std::string::npos, is_cut) << rows;
    }
}

/// How many blocks of a supporting section are told, from the first on.
std::size_t told_of(std::vector<Block> blocks) {
    Section section;
    section.id = "truth";
    section.blocks = std::move(blocks);
    const auto told = blocks_shown(section, Extent::brief);
    for (std::size_t i = 0; i < told.size(); ++i) EXPECT_TRUE(told.contains(&section.blocks[i])) << i;
    return told.size();
}

TEST(PrintPage, NoSentenceIsLeftInTheMiddle) {
    const auto words = [](const char* said) { return Paragraph{text(said)}; };
    const Formula formula{"parseval", ""};
    const BulletList list{{text("one;")}};
    const Paragraph more = words("More.");
    EXPECT_EQ(told_of({words("It is so."), formula, more}), 1u);
    EXPECT_EQ(told_of({words("Is it so? (It is.)"), formula, more}), 1u);
    EXPECT_EQ(told_of({words("So that"), formula, more}), 2u);
    EXPECT_EQ(told_of({words("They are:"), formula, formula, list, more}), 4u);
    EXPECT_EQ(told_of({words("With its formula,"), formula, words("and the other one:"), list, more}), 4u);
    EXPECT_EQ(told_of({words("It is"), words("so."), more}), 2u);
    EXPECT_EQ(told_of({words("It ends with:"), Heading{"Results"}, more}), 1u);
    EXPECT_EQ(told_of({words("They are:")}), 1u);
    EXPECT_EQ(told_of({more, words("Not told:"), formula}), 1u);
    EXPECT_EQ(told_of({}), 0u);
}

TEST(PrintPage, NamesThePageForWhatIsLeftOut) {
    Document document = supporting_document();
    Table first{"truth_first", "First.", {{"see"}}, {{std::string("truth_second")}}}, second{"truth_second", "Second.", {{"a"}}, {{1.0}}};
    first.columns[0].reference = true;
    document.sections[0].findings = {{text("Found (", ref("truth_second"), ", ", ref("truth_first"), ")."), 9}};
    document.sections[0].blocks = {Paragraph{text("It is so.")}, first, second};
    const std::string brief = printed(document).html;
    EXPECT_NE(brief.find("(Table A.2 of index.html, <a href=\"#truth_first\">Table A.1</a>)"), std::string::npos);
    EXPECT_NE(brief.find(">Table A.2</th>"), std::string::npos) << "a cell has the name alone";
    EXPECT_NE(brief.find("this document leaves out is in index.html"), std::string::npos) << "its caption says where";
    const std::string all = printed(document, whole).html;
    EXPECT_EQ(all.find("of index.html"), std::string::npos);
    EXPECT_EQ(all.find("leaves out"), std::string::npos);
}

TEST(PrintPage, WhatIsLeftOutIsNamedButNotLinked) {
    const Document document = supporting_document();
    const Section& section = document.sections[0];
    const auto told = blocks_shown(section, Extent::brief);
    EXPECT_LT(told.size(), section.blocks.size());
    EXPECT_EQ(blocks_shown(section, Extent::whole).size(), section.blocks.size());
    const auto pictures = [](const std::set<const Block*>& blocks) {
        return std::count_if(blocks.begin(), blocks.end(),
                             [](const Block* b) { return std::holds_alternative<Figure>(*b) || std::holds_alternative<Plot>(*b); });
    };
    EXPECT_EQ(pictures(told), 1);
    // A question is told whole.
    EXPECT_EQ(blocks_shown(sample_document().sections[0], Extent::brief).size(), section.blocks.size());
}

TEST(PrintPage, OnlyFiguresShownNeedAPicture) {
    const auto brief = figures_shown(supporting_document(), Extent::brief), all = figures_shown(supporting_document(), Extent::whole);
    EXPECT_LE(brief.size(), all.size());
    const DrawnFigures drawn = sample_figures();
    std::size_t pictures = 0;
    for (const std::string& id : brief)
        for (const DrawnPanel& panel : drawn.at(id).panels) pictures += panel.pictures.size();
    EXPECT_EQ(printed(supporting_document()).files.size(), pictures);
    EXPECT_TRUE(std::includes(all.begin(), all.end(), brief.begin(), brief.end()));
}

TEST(PrintPage, HeadingsAreReadWithTheirWordsApart) {
    const auto headings = headings_of(
        "<head><title>x</title></head><h1>Mesh\nprocessing</h1><hr/><h2 id=\"q1\"><span class=\"number\">1</span> A &amp; "
        "<em>B</em></h2><h3>C</h3>");
    ASSERT_EQ(headings.size(), 3u);
    EXPECT_EQ(headings[0].title, "Mesh processing");
    EXPECT_EQ(headings[1].title, "1 A & B");
    EXPECT_EQ(headings[1].id, "q1");
    EXPECT_EQ(headings[2].level, 3);
}

TEST(PrintPage, EveryPageNumberThatIsAskedForHasItsHeading) {
    const PrintPage page = printed(supporting_document());
    std::set<std::string> ids;
    for (const PageHeading& heading : headings_of(page.html)) ids.insert(heading.id);
    const auto asked = matches(page.html, "@page:([^@]*)@");
    EXPECT_GE(asked.size(), supporting_document().sections.size());
    for (const std::string& id : asked) EXPECT_TRUE(ids.contains(id)) << id;
}

TEST(PrintPdf, APageWithAMissingPictureIsRefused) {
    // Engines pass over a missing picture without a word, and turn other links into paths of the machine.
    const TemporaryFolder folder;
    const PdfEngine engine{PdfEngine::Kind::chromium, "/bin/true", "Chromium 150"};
    for (const char* body : {"<img src=\"missing.jpg\"/>", "<a href=\"tables/a.csv\">a</a>", "<img src=\"empty.jpg\"/>"}) {
        PrintJob job;
        job.html = body;
        job.files["empty.jpg"] = "";
        try {
            (void)print_pdf(job, engine, folder.path());
            ADD_FAILURE() << body;
        } catch (const EngineError& error) {
            EXPECT_NE(std::string(error.what()).find("which is not there"), std::string::npos) << error.what();
        }
    }
}

TEST(PrintPdf, AnExitCodeOfZeroWithoutAPdfFails) {
    const TemporaryFolder folder;
    PrintJob job;
    job.html = "<h1>Title</h1>";
    EXPECT_THROW((void)print_pdf(job, {PdfEngine::Kind::chromium, "/bin/true", "Chromium 150"}, folder.path()), EngineError);
}

}   // namespace
}   // namespace meshfolio::report
