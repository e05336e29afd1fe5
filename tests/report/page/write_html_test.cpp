#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>

#include "base/base64.h"
#include "base/sha256.h"
#include "report/escape.h"
#include "report/numbering.h"
#include "report/page/page_design.h"
#include "report/sample_document.h"
#include "report/test_tools.h"
#include "report/writers.h"

namespace meshfolio::report {
namespace {

std::string sample_page() { return write_html(sample_document(), sample_figures(), Templates()); }
std::string sample_appendix() { return write_html(sample_document(), sample_figures(), Templates(), {.volume = Volume::appendix}); }
std::string hostile_page() { return write_html(hostile_document(), hostile_figures(), Templates()); }

/// Judged by a reader that is not ours.
std::vector<std::size_t> positions_of(const std::string& text, const std::vector<std::string>& parts) {
    std::vector<std::size_t> positions;
    for (const std::string& part : parts) {
        positions.push_back(text.find(part));
        EXPECT_NE(positions.back(), std::string::npos) << part;
    }
    return positions;
}

TEST(WriteHtml, IsWellFormedXml) {
    if (!has_program("xmllint")) GTEST_SKIP() << "xmllint is not installed";
    EXPECT_TRUE(is_well_formed(sample_page()));
    EXPECT_TRUE(is_well_formed(hostile_page()));
    EXPECT_TRUE(is_well_formed(write_html({}, {}, Templates())));
}

TEST(WriteHtml, FollowsTheOrderOfTheCoursework) {
    const auto positions = positions_of(body_of(sample_page()).substr(body_of(sample_page()).find("<main")),
                                        {"<h1>", "class=\"meshes\"", "Questions attempted and how far", "class=\"score\"",
                                         "class=\"cover\"", "id=\"q1\"", "id=\"q2\"", "id=\"q3\"", ">References</h2>"});
    EXPECT_TRUE(std::is_sorted(positions.begin(), positions.end()));
    const auto behind = positions_of(body_of(sample_appendix()).substr(body_of(sample_appendix()).find("<main")),
                                     {"<h1>Appendix to", "id=\"ground_truth\"", ">Provenance</h2>", ">Timings</h2>", ">Checks</h2>"});
    EXPECT_TRUE(std::is_sorted(behind.begin(), behind.end()));
}

TEST(WriteHtml, EveryLinkWithinThePageHasItsTarget) {
    const std::string page = body_of(sample_page());
    std::set<std::string> ids;
    for (const std::string& id : matches(page, " id=\"([^\"]*)\"")) EXPECT_TRUE(ids.insert(id).second) << id << " twice";
    const auto links = matches(page, "href=\"#([^\"]*)\"");
    EXPECT_GT(links.size(), 20u);
    for (const std::string& link : links) EXPECT_TRUE(ids.contains(link)) << link;
    for (const std::string& label : matches(page, "aria-labelledby=\"([^\" ]*)")) EXPECT_TRUE(ids.contains(label)) << label;
}

TEST(WriteHtml, NeedsNoNetworkAndNoOtherFileToBeRead) {
    const std::string page = sample_page();
    for (const std::string& source : matches(page, " src=\"([^\"]{0,40})")) EXPECT_EQ(source.rfind("data:image/jpeg;base64,", 0), 0u);
    for (const std::string& target : matches(page, " href=\"([^\"]*)\"")) EXPECT_EQ(target.find("//"), std::string::npos) << target;
    EXPECT_EQ(page.find("<link"), std::string::npos);
    EXPECT_EQ(page.find("@import"), std::string::npos);
    EXPECT_EQ(page.find(" style=\""), std::string::npos);   // the policy would block it
}

TEST(WriteHtml, PolicyAllowsExactlyTheInlineStyleAndScript) {
    const std::string page = sample_page();
    const std::string policy =
        page.substr(page.find("default-src"), page.find("\"/>", page.find("default-src")) - page.find("default-src"));
    EXPECT_EQ(policy.rfind("default-src &#39;none&#39;; img-src &#39;self&#39; data:;", 0), 0u);
    EXPECT_EQ(policy.find("unsafe"), std::string::npos);
    std::size_t elements = 0;
    for (const std::string element : {"style", "script"}) {
        const std::string sources = policy.substr(policy.find(element + "-src"), policy.find(';', policy.find(element + "-src")));
        for (std::size_t at = page.find("<" + element + ">"); at != std::string::npos; at = page.find("<" + element + ">", at + 1)) {
            const std::size_t begin = at + element.size() + 2;
            const std::string content = page.substr(begin, page.find("</" + element + ">", begin) - begin);
            EXPECT_NE(sources.find("&#39;sha256-" + base64(sha256_bytes(content)) + "&#39;"), std::string::npos) << element;
            ++elements;
        }
    }
    EXPECT_EQ(count_of(policy, "sha256-"), elements);
}

constexpr std::string_view small_viewer = "globalThis.meshfolioViewer = '</script>]]>';";

std::string page_with_models(std::string_view viewer) {
    return write_html(sample_document(), sample_models(), Templates(), {.viewer = viewer});
}

TEST(WriteHtml, TheViewerLiesInThePageAsDataAndThePolicyListsIt) {
    const std::string page = page_with_models(small_viewer);
    EXPECT_NE(page.find("<script type=\"application/zlib\" id=\"viewer-program\">" + packed(small_viewer) + "</script>"),
              std::string::npos);
    EXPECT_NE(page.find(" &#39;sha256-" + base64(sha256_bytes(std::string(small_viewer))) + "&#39;;"), std::string::npos);
    EXPECT_EQ(page.find(small_viewer), std::string::npos) << "not as a script that is parsed with the page";
    const DrawnFigures figures = sample_models();
    for (const DrawnModel& model : figures.at("q1_plane_h").models)
        EXPECT_NE(page.find("<script type=\"model/gltf-binary\" data-label=\"" + model.label + "\">" + packed(model.glb) + "</script>"),
                  std::string::npos);
    if (!has_program("xmllint")) GTEST_SKIP() << "xmllint is not installed";
    EXPECT_TRUE(is_well_formed(page));
}

TEST(WriteHtml, ModelsAreLinkedWithOrWithoutAViewer) {
    for (const std::string_view viewer : {small_viewer, std::string_view()}) {
        const std::string page = body_of(page_with_models(viewer));
        EXPECT_NE(page.find("<a href=\"models/q1_plane.glb\">3D model, before (GLB, 1 KB)</a>"), std::string::npos);
        EXPECT_NE(page.find("<a href=\"models/%CE%BB%20%3D%201.glb\">3D model (GLB, 1 KB)</a>"), std::string::npos);
    }
}

TEST(WriteHtml, CarriesNoViewerWithoutModelsAndNoModelsWithoutAViewer) {
    const std::string without_models = write_html(sample_document(), sample_figures(), Templates(), {.viewer = small_viewer});
    for (const std::string& page : {without_models, page_with_models("")}) {
        for (const char* trace : {"viewer-program", "meshfolioViewer", "model/gltf-binary", "data-turnable"})
            EXPECT_EQ(page.find(trace), std::string::npos) << trace;
    }
    EXPECT_EQ(without_models.find("model-stage"), std::string::npos) << "nor its styles";
}

TEST(WriteHtml, HostileNamesStayText) {
    const std::string page = body_of(hostile_page());
    EXPECT_EQ(count_of(page, "<script"), 1u);   // our own; that of the scheme is in the head
    EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
    EXPECT_NE(page.find("&lt;script&gt;alert(1)&lt;/script&gt;"), std::string::npos);
    EXPECT_NE(page.find("{{title}}"), std::string::npos);   // not a tag again
    for (const char c : page) EXPECT_FALSE(static_cast<unsigned char>(c) < 0x20 && c != '\n') << int(c);
}

TEST(WriteHtml, FailedQuestionIsARedBoxWithItsMessage) {
    const std::string page = body_of(sample_page());
    EXPECT_NE(page.find("<strong>This section failed.</strong> ellipsoid.obj:3: not a number"), std::string::npos);
    EXPECT_NE(page.find("This section was stopped, because another question had failed."), std::string::npos);
}

/// q4 refers to q2, which is not asked for; a page of text stands before q4, one at the end.
Document sheet() {
    Document document;
    document.title = "Sheet";
    document.sections.resize(3);
    for (std::size_t i = 0; i < 3; ++i) document.sections[i].id = "q" + std::to_string(2 + i), document.sections[i].title = "Chapter";
    Section &hidden = document.sections[0], &last = document.sections[1], &first = document.sections[2];
    hidden.title = "Hidden";
    hidden.status = Status::skipped;
    hidden.extent = not_asked_for;
    first.number = "1";
    first.title = "<b>Waves</b> & {{title}} | *co*";
    first.asked = "The question of another course.";
    first.intro = "# Setting\n\nCompute $λ_crit$ as in [[q3]].\n1. one\n2. two\n* <script>alert(1)</script>";
    first.points = 2.5;
    first.blocks = {Paragraph{text("As seen (", ref("q2"), ") and in ", ref("q2_table"), ".")}};
    last.number = "10";
    last.points = 1;
    document.pages = {{"Last words", "The end.", ""}, {"Before", "**Read** this.", "q4"}, {"Lost", "Nobody sees it.", "q2"}};
    sort_by_number(document);
    return document;
}

TEST(WriteHtml, ASheetHasItsOwnNumbersWordsAndPagesAndNothingElse) {
    const std::string page = body_of(write_html(sheet(), {}, Templates()));
    const auto positions =
        positions_of(page.substr(page.find("id=\"page-2\"")),
                     {"id=\"page-2\"", "<strong>Read</strong> this.", "id=\"q4\"", "<span class=\"points\">2.5 points</span>",
                      "<strong>Setting</strong>", "<p>1. one</p>", "<p>2. two</p>", "<li>&lt;script&gt;", "id=\"q3\"",
                      "<span class=\"points\">1 point</span>", "id=\"page-1\""});
    EXPECT_TRUE(std::is_sorted(positions.begin(), positions.end()));
    for (const char* absent : {"Nobody sees", "id=\"q2\"", "of another course", "<b>Waves", "alert(1)</script>", "src.txt", "Not asked"})
        EXPECT_EQ(page.find(absent), std::string::npos) << absent;
    EXPECT_NE(page.find("<a href=\"#q3\">Question 10</a>"), std::string::npos) << "numbers of the sheet in references";
    EXPECT_NE(page.find("As seen and in “Hidden” (not in this report)."), std::string::npos);
    EXPECT_NE(page.find("<b>2</b> of 2 questions answered"), std::string::npos);
}

TEST(WriteHtml, ASheetIsTheSameInPrintAndMarkdown) {
    const std::string print = write_html(sheet(), {}, Templates(), {.design = "print"}),
                      markdown = write_markdown(sheet(), {}, Templates());
    for (const char* part : {"Setting", "2.5 points", "Before", "Last words", "one"}) {
        EXPECT_NE(print.find(part), std::string::npos) << part;
        EXPECT_NE(markdown.find(part), std::string::npos) << part;
    }
    EXPECT_NE(markdown.find("## 1 "), std::string::npos);
    for (const std::string& text : {print, markdown})
        for (const char* absent : {"Nobody sees", "of another course", "<b>Waves", "src.txt"})
            EXPECT_EQ(text.find(absent), std::string::npos) << absent;
    if (has_program("xmllint")) {
        EXPECT_TRUE(is_well_formed(print));
        EXPECT_TRUE(is_well_formed(write_html(sheet(), {}, Templates())));
    }
}

TEST(WriteHtml, SaysWhichMeshStandsInForAnother) {
    EXPECT_NE(sample_page().find("<code>plane.obj</code> <span class=\"badge warn\">stand-in</span>"), std::string::npos);
    EXPECT_EQ(sample_page().find("<code>sphere.ply</code> <span"), std::string::npos);
}

TEST(WriteHtml, ScoresCountPassedChecks) {
    EXPECT_NE(sample_page().find("<b>3</b> of 6 checks passed, 2 failed, 1 undecided</a>"), std::string::npos);
    EXPECT_NE(sample_page().find("<b>1</b> of 2 questions answered"), std::string::npos) << "what was not asked for does not count";
    EXPECT_NE(sample_page().find("<a href=\"appendix.html#checks-q1\" class=\"failure\">2 of 5 checks failed</a>"), std::string::npos);
}

TEST(WriteHtml, AnUndecidedCheckHasItsReasonAndIsNoFailure) {
    const std::string page = body_of(sample_appendix());
    const std::size_t row = page.find("<tr class=\"undecided\">");
    ASSERT_NE(row, std::string::npos);
    const std::string text = page.substr(row, page.find("</tr>", row) - row);
    EXPECT_NE(text.find("count below <math><mi>σ</mi></math><span class=\"note\">rounding is larger than the gap</span>"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("<td class=\"numeric\">–</td>"), std::string::npos) << "no number: " << text;
    EXPECT_NE(text.find("<span class=\"badge warn\">undecided</span>"), std::string::npos) << "told in a word, not by its colour";
    EXPECT_EQ(count_of(page, "<tr class=\"not-passed\">"), 2u);
}

TEST(WriteHtml, UndecidedChecksAloneShowNeitherFailureNorAllPassed) {
    Document document = sample_document();
    document.sections.resize(1);
    std::erase_if(document.sections[0].checks, [](const Check& check) { return check.failed(); });
    const std::string page = body_of(write_html(document, sample_figures(), Templates()));
    EXPECT_NE(page.find("<b>2</b> of 3 checks passed, 1 undecided"), std::string::npos);
    const WriteOptions appendix{.volume = Volume::appendix};
    EXPECT_EQ(body_of(write_html(document, sample_figures(), Templates(), appendix)).find("All 3 passed"), std::string::npos);
    EXPECT_TRUE(matches(page, "class=\"([^\"]*failure)\"").empty());
    EXPECT_EQ(page.find("class=\"not-passed\""), std::string::npos);
    EXPECT_EQ(page.find("badge bad"), std::string::npos);
    document.sections[0].checks.pop_back();
    EXPECT_NE(body_of(write_html(document, sample_figures(), Templates(), appendix)).find("All 2 passed."), std::string::npos);
}

TEST(WriteHtml, TheAnswerStandsInTheOpeningTableAndFirstInItsSection) {
    const std::string page = body_of(sample_page()), answer = "<math><mi>H</mi></math> of the sphere is <strong>0.88 %</strong> off";
    const auto positions =
        positions_of(page, {"<ol class=\"attempted\">", answer, "id=\"q1\"", "<p class=\"answer\">" + answer, ">Method</h3>"});
    EXPECT_TRUE(std::is_sorted(positions.begin(), positions.end()));
}

TEST(WriteHtml, ReferencesAreLinksWithTheirNumbers) {
    const std::string page = sample_page();
    EXPECT_NE(page.find("<a href=\"#q1_plane_h\">Figure 1.1</a>"), std::string::npos);
    EXPECT_NE(page.find("<a href=\"#q1_errors\">Table 1.1</a>"), std::string::npos);
    EXPECT_NE(page.find("<a href=\"#q1_eq\">Equation (1.1)</a>"), std::string::npos);
    EXPECT_NE(page.find("<a href=\"#ref-desbrun_1999\">[1]</a>"), std::string::npos) << "the works that the report cites come first";
    EXPECT_EQ(count_of(page, "class=\"work-number\""), 1u) << "and no others are listed";
}

TEST(WriteHtml, ALedgerIsAPlainTableThatAScriptMaySortAndFilter) {
    const std::string page = sample_page();
    EXPECT_EQ(count_of(page, "<table data-sortable=\"true\">"), 3u) << "those that say so, and whatever has three rows";
    EXPECT_NE(page.find("<th scope=\"col\" data-filter=\"true\">verdict</th>"), std::string::npos);
    EXPECT_NE(page.find("<th scope=\"row\"><a href=\"#q1_errors\">Table 1.1</a></th><td>holds</td>"), std::string::npos);
    EXPECT_NE(page.find("data-value=\"0.25\""), std::string::npos);
    EXPECT_NE(page.find("<th scope=\"row\" class=\"numeric\" data-value=\"15\">15</th>"), std::string::npos);
    EXPECT_EQ(body_of(page).find("<select"), std::string::npos) << "without a script there is nothing that does nothing";
}

TEST(WriteHtml, PicturesHaveAltTextAndSizeAndLinks) {
    const std::string whole = sample_page(),
                      page = whole.substr(whole.find("id=\"q1\""));   // behind the opening, which has the first picture too
    EXPECT_NE(page.find("alt=\"A plane from six directions, values from 0 to 1.\" width=\"480\" height=\"400\" decoding=\"async\"/>"),
              std::string::npos);
    EXPECT_NE(page.find("alt=\"Figure 1.1: λ = 1, seen from \u2212z\""), std::string::npos);
    const DrawnFigure drawn = sample_figures().at("q1_plane_h");
    for (const DrawnPanel& panel : drawn.panels)
        for (const DrawnPicture& picture : panel.pictures)
            EXPECT_EQ(count_of(page, "base64," + base64(picture.jpeg) + "\""), 1u) << picture.view;
    EXPECT_EQ(count_of(page, "href=\"images/q1_plane_h_sheet.png\""), 1u);
    EXPECT_NE(page.find("<a href=\"images/q1_plane_h_%2Bx.png\">+x</a>"), std::string::npos);
}

TEST(WriteHtml, EveryWordOfAFigureIsText) {
    const std::string page = sample_page();
    for (const char* words :
         {"<mi>λ</mi><mo form=\"infix\">=</mo><mn>0.1</mn></math></", "=</mo><mn>1</mn></math></", "<p class=\"view-name\">+x</p>",
          "mean curvature <tspan font-style=\"italic\">H</tspan> [1/length]</text>", ">undefined</text>", " below</text>"})
        EXPECT_NE(page.find(words), std::string::npos) << words;
    EXPECT_EQ(count_of(page, "<p class=\"view-name\">"), 12u);
}

TEST(WriteHtml, OneMeshHasItsViewsBesideALargePicture) {
    const std::string page = write_html(sample_document(), sample_layouts(), Templates());
    positions_of(page, {"<div class=\"lead", "<div class=\"large\"><img", "<div class=\"three\">", "<p class=\"view-name\">\u2212z</p>"});
    EXPECT_EQ(count_of(page, "<div class=\"three\">"), 2u);
}

TEST(WriteHtml, AMatrixHasHeadsAndItsEmptyCellsSayWhy) {
    const std::string page = write_html(sample_document(), sample_layouts(), Templates());
    const auto positions = positions_of(page, {"<p class=\"head\">explicit</p>", "<p class=\"head\">implicit</p>", "<p class=\"head row\">",
                                               "<p class=\"empty\">blew up</p>"});
    EXPECT_TRUE(std::is_sorted(positions.begin(), positions.end()));
    EXPECT_EQ(count_of(page, "<p class=\"head row\">"), 2u);
}

TEST(WriteHtml, NeighbouringEmptyCellsOfOneReasonAreJoined) {
    DrawnFigures figures = sample_layouts();
    DrawnFigure& matrix = figures["q1_before_after"];
    matrix.in_a_line = 3;
    matrix.columns = {"t = 1", "t = 3", "t = 10"};
    matrix.rows = {"explicit", "implicit"};
    const DrawnPanel drawn = matrix.panels[0], dead{"blew up", {}}, dot{"a dot", {}};
    matrix.panels = {drawn, dead, dead, dead, dot, drawn};
    const std::string page = write_html(sample_document(), figures, Templates());
    EXPECT_EQ(count_of(page, "<p class=\"empty\">blew up</p>"), 2u) << "one a row";
    EXPECT_EQ(count_of(page, "across-2\"><p class=\"empty\">blew up</p>"), 1u);
    EXPECT_EQ(count_of(page, "across-1\"><p class=\"empty\">a dot</p>"), 1u) << "for another reason";
}

TEST(WriteHtml, PanelsLieInALineEachWithItsName) {
    const std::string page = sample_page();
    const auto positions = positions_of(
        page, {"id=\"q1_before_after\"", "<div class=\"cells columns-3", "<p class=\"panel-name\">before</p>",
               "<p class=\"panel-name\">after</p>", "<p class=\"panel-name\">moved</p>", "href=\"images/q1_before_after_sheet.png\""});
    EXPECT_TRUE(std::is_sorted(positions.begin(), positions.end()));
    EXPECT_EQ(count_of(page, "width=\"560\" height=\"500\""), 3u);
}

TEST(WriteHtml, TheFirstPageSaysWhichMeshesStandIn) {
    const std::string page = sample_page();
    EXPECT_NE(page.find("<b>On 2 meshes</b>, 1 of them <span"), std::string::npos);
    EXPECT_NE(page.find("<span class=\"stand-in\">plane</span>"), std::string::npos);
    EXPECT_NE(page.find("<span>sphere</span>"), std::string::npos);
}

TEST(WriteHtml, TheFirstPageNamesMeshesByTheirFilesEachOnce) {
    Document document = sample_document();
    Input lilium = document.sections[0].inputs[0], own = lilium, other = lilium;
    lilium.role = "lilium", lilium.file = "lilium_s.obj", lilium.stand_in = false;
    own.role = other.role = "your mesh", own.file = "cube.obj", other.file = "saddle.ply", own.stand_in = other.stand_in = false;
    document.sections[0].inputs = {lilium, own, other};
    document.sections[1].inputs = {lilium};
    const std::string page = write_html(document, sample_figures(), Templates());
    EXPECT_NE(page.find("<b>On 3 meshes</b>"), std::string::npos);
    for (const char* name : {"lilium_s", "cube", "saddle"}) EXPECT_EQ(count_of(page, std::string("<span>") + name + "</span>"), 1u) << name;
    EXPECT_EQ(page.find(">lilium<"), std::string::npos);
}

TEST(WriteHtml, TheContentsListTheHeadingsOfEverySection) {
    const std::string page = sample_page(), list = page.substr(page.find("<nav"), page.find("</nav>") - page.find("<nav"));
    EXPECT_NE(list.find("<a href=\"#section-1.1\"><span class=\"number\">1.1</span>Method</a>"), std::string::npos);
    EXPECT_EQ(count_of(list, "#section-"), 2u);
}

TEST(WriteHtml, TheFirstPictureWithValuesStandsOnTheFirstPageToo) {
    const std::string page = sample_page();
    const std::size_t cover = page.find("width=\"480\" height=\"400\"");
    ASSERT_NE(cover, std::string::npos);
    EXPECT_LT(cover, page.find("id=\"q1\""));
    DrawnFigures without_values = sample_figures();
    without_values.at("q1_plane_h").legend.reset();
    EXPECT_EQ(write_html(sample_document(), without_values, Templates(), {}).find("class=\"cover\""), std::string::npos);
}

TEST(WriteHtml, TimingsCanBeLeftOut) {
    const WriteOptions without{.volume = Volume::appendix, .timings = false};
    EXPECT_EQ(write_html(sample_document(), {}, Templates(), without).find("Timings"), std::string::npos);
    Document slower = sample_document();
    slower.timings = {{"everything", 99}};
    EXPECT_EQ(write_html(sample_document(), {}, Templates(), without), write_html(slower, {}, Templates(), without));
}

TEST(WriteHtml, EachVolumeLinksToTheOther) {
    Document document = sample_document();
    document.sections[0].appendix_from = static_cast<int>(document.sections[0].blocks.size()) - 2;
    document.sections[0].answer = text("See ", ref("q1_before_after"), ".");
    const std::string report = write_html(document, sample_figures(), Templates());
    const std::string appendix = write_html(document, sample_figures(), Templates(), {.volume = Volume::appendix});
    EXPECT_NE(report.find("<a href=\"appendix.html#q1_before_after\">Figure 1.5</a>"), std::string::npos);
    EXPECT_EQ(report.find("id=\"q1_before_after\""), std::string::npos);
    EXPECT_NE(appendix.find("id=\"q1_before_after\""), std::string::npos);
    EXPECT_NE(appendix.find("id=\"q1-further\""), std::string::npos);
    for (const std::string& link : matches(report, "href=\"appendix.html#([^\"]*)\""))
        EXPECT_NE(appendix.find(" id=\"" + link + "\""), std::string::npos) << link;
    for (const std::string& link : matches(appendix, "href=\"index.html#([^\"]*)\""))
        EXPECT_NE(report.find(" id=\"" + link + "\""), std::string::npos) << link;
}

TEST(WriteHtml, ManyLargePicturesAreQuick) {
    Document document = sample_document();
    DrawnFigures figures;
    for (int i = 0; i < 150; ++i) {
        const std::string id = "q1_many_" + std::to_string(i);
        document.sections[0].blocks.push_back(Figure{id, "caption", "alt"});
        figures[id].sheet = "images/" + id + ".png";
        figures[id].panels = {{"", {{"", 0, 0, 1200, 800, "", std::string(120000, char(i))}}}};
    }
    const std::clock_t begin = std::clock();
    const std::string page = write_html(document, figures, Templates());
    EXPECT_GT(page.size(), 23000000u);
    EXPECT_LT(std::clock() - begin, 10 * CLOCKS_PER_SEC);   // of the processor: 0.3 s; minutes where it grows with the square
}

}   // namespace
}   // namespace meshfolio::report
