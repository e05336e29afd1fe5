#include "report/pdf/print_pdf.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/errors.h"
#include "report/page/volumes.h"
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

std::string printed(const Document& document, PrintOptions options = {}) {
    return print_page(document, sample_figures(), Templates(), options);
}

constexpr PrintOptions appendix{.volume = Volume::appendix};

TEST(PrintPage, EveryLinkHasItsTargetInThePage) {
    for (const Document& document : {sample_document(), supporting_document(), hostile_document()}) {
        for (const PrintOptions& options : {PrintOptions{}, appendix}) {
            const std::string page = body_of(printed(document, options));
            std::set<std::string> ids;
            for (const std::string& id : matches(page, " id=\"([^\"]*)\"")) EXPECT_TRUE(ids.insert(id).second) << id << " twice";
            for (const std::string& link : matches(page, " href=\"([^\"]*)\""))
                EXPECT_TRUE(link[0] == '#' && ids.contains(link.substr(1))) << link;
        }
    }
}

std::vector<std::string> pictures_in(const std::string& page) { return matches(page, " src=\"([^\"]*)\""); }

TEST(PrintPage, EveryPictureIsInside) {
    const auto pictures = pictures_in(printed(sample_document()));
    EXPECT_FALSE(pictures.empty());
    for (const std::string& picture : pictures) EXPECT_TRUE(picture.starts_with("data:image/jpeg;base64,")) << picture;
}

TEST(PrintPage, IsWellFormedXml) {
    if (!has_program("xmllint")) GTEST_SKIP() << "xmllint is not installed";
    const TemporaryFolder folder;
    for (const Document& document : {sample_document(), supporting_document(), hostile_document(), Document()}) {
        const auto file = folder.write("page.html", printed(document));
        EXPECT_TRUE(succeeds("xmllint --noout '" + file.string() + "'"));
    }
}

TEST(PrintPage, ImagesHaveNoBackground) {
    // Chromium paints such a background now before, now after the picture: the PDF would differ from run to run.
    for (const std::string& rule : matches(Templates()["print.css"], "([^{}]*img[^{}]*\\{[^}]*\\})"))
        EXPECT_EQ(rule.find("background"), std::string::npos) << rule;
}

TEST(PrintPage, FormulasArePlainForEnginesWithoutMathml) {
    EXPECT_NE(printed(sample_document()).find("<math"), std::string::npos);
    EXPECT_EQ(printed(sample_document(), {.mathml = false}).find("<math"), std::string::npos);
}

TEST(PrintPage, ChecksThatDidNotPassAreListedInTheAppendix) {
    Document document = sample_document();
    EXPECT_NE(body_of(printed(document)).find("2 of 5 checks failed."), std::string::npos) << "in the opening table";
    const std::string page = body_of(printed(document, appendix));
    EXPECT_NE(page.find("3 of 6 checks passed, 2 failed, 1 undecided."), std::string::npos);
    EXPECT_NE(page.find("2 of 5 checks passed, 2 failed, 1 undecided.</figcaption>"), std::string::npos);
    EXPECT_NE(page.find("<span class=\"note\">rounding is larger than the gap</span>"), std::string::npos);
    EXPECT_NE(page.find("<td><em>undecided</em></td>"), std::string::npos);
    document.sections.resize(1);
    std::erase_if(document.sections[0].checks, [](const Check& check) { return check.failed(); });
    for (const PrintOptions& options : {PrintOptions{}, appendix})
        EXPECT_EQ(body_of(printed(document, options)).find("class=\"failure\""), std::string::npos);
    EXPECT_EQ(body_of(printed(document, appendix)).find("All 3 checks"), std::string::npos);
}

TEST(PrintPage, HasNoTimings) {
    ASSERT_NE(write_html(sample_document(), sample_figures(), Templates(), {.volume = Volume::appendix}).find("Timings"),
              std::string::npos);
    for (const PrintOptions& options : {PrintOptions{}, appendix})
        EXPECT_EQ(printed(sample_document(), options).find("Timings"), std::string::npos);
}

TEST(PrintPage, LongTablesAreCutUnlessTheyAreHardlyTooLong) {
    for (const auto& [rows, is_cut] : {std::pair{23, false}, {24, true}}) {
        Document document = sample_document();
        Table table{"q1_table", "", {{.name = "number"}}, {}};
        table.rows.assign(static_cast<std::size_t>(rows), {1.0});
        document.sections[0].answer = {};
        document.sections[0].blocks = {table};
        EXPECT_EQ(printed(document).find("8 rows only in tables/q1_table.csv") != std::string::npos, is_cut) << rows;
    }
}

TEST(PrintPage, ReferencesToTheOtherVolumeNameIt) {
    Document document = sample_document();
    Table first{"q1_first", "First.", {{"see"}}, {{std::string("q1_second")}}}, second{"q1_second", "Second.", {{"a"}}, {{1.0}}};
    first.columns[0].reference = true;
    Section& section = document.sections[0];
    section.answer = text("Found (", ref("q1_second"), ", ", ref("q1_first"), ").");
    section.blocks = {Paragraph{text("It is so.")}, first, second, Paragraph{text("See ", ref("q1_first"), ".")}};
    section.appendix_from = 2;
    const std::string report = printed(document);
    EXPECT_NE(report.find("(Table 1.2 of the appendix, <a href=\"#q1_first\">Table 1.1</a>)"), std::string::npos);
    EXPECT_NE(report.find(">Table 1.2</th>"), std::string::npos) << "a cell has the name alone";
    EXPECT_NE(report.find("What its cells refer to is in the appendix."), std::string::npos) << "its caption says where";
    EXPECT_NE(printed(document, appendix).find("See Table 1.1 of the report."), std::string::npos);
}

TEST(PrintPage, OnlyFiguresOfTheVolumeNeedAPicture) {
    Document document = sample_document();
    document.sections[0].appendix_from = static_cast<int>(document.sections[0].blocks.size()) - 2;
    const std::size_t all = pictures_in(printed(sample_document())).size();
    EXPECT_EQ(pictures_in(printed(sample_document(), appendix)).size(), 0u);
    EXPECT_LT(pictures_in(printed(document)).size(), all);
    EXPECT_EQ(pictures_in(printed(document)).size() + pictures_in(printed(document, appendix)).size(), all);
}

TEST(PrintPage, ReadsHeadingsWithSingleSpaces) {
    const auto headings = headings_of(
        "<head><title>x</title></head><h1>Mesh\nprocessing</h1><hr/><h2 id=\"q1\"><span class=\"number\">1</span> A &amp; "
        "<em>B</em></h2><h3>C</h3>");
    ASSERT_EQ(headings.size(), 3u);
    EXPECT_EQ(headings[0].title, "Mesh processing");
    EXPECT_EQ(headings[1].title, "1 A & B");
    EXPECT_EQ(headings[1].id, "q1");
    EXPECT_EQ(headings[2].level, 3);
}

TEST(PrintPage, EveryMarkOfAPageNumberHasItsHeading) {
    for (const PrintOptions& options : {PrintOptions{}, appendix}) {
        const std::string page = printed(supporting_document(), options);
        std::set<std::string> ids;
        for (const PageHeading& heading : headings_of(page)) ids.insert(heading.id);
        const auto asked = matches(page, "@page:([^@]*)@");
        EXPECT_GE(asked.size(), 2u);
        for (const std::string& id : asked) EXPECT_TRUE(ids.contains(id)) << id;
    }
}

TEST(PrintPdf, APageWithAMissingPictureIsRefused) {
    // Engines pass over a missing picture without a word, and turn other links into paths of the machine.
    const TemporaryFolder folder;
    const PdfEngine engine{PdfEngine::Kind::chromium, "/bin/true", "Chromium 150"};
    for (const char* body : {"<img src=\"missing.jpg\"/>", "<a href=\"tables/a.csv\">a</a>"}) {
        PrintJob job;
        job.html = body;
        try {
            (void)print_pdf(job, engine, folder.path());
            ADD_FAILURE() << body;
        } catch (const EngineError& error) {
            EXPECT_NE(std::string(error.what()).find("which is not in it"), std::string::npos) << error.what();
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
