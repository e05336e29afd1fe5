#include "report/writers.h"

#include <gtest/gtest.h>

#include "report/page/page_design.h"
#include "report/sample_document.h"

namespace meshfolio::report {
namespace {

constexpr std::string_view lab_viewer = "globalThis.meshfolioViewer = {};";

/// The sample's question has it.
std::string page_with(std::vector<Lab> labs, Volume volume = Volume::report, const std::string& design = "report") {
    return write_html(sample_document(), {}, Templates(),
                      {.volume = volume, .design = design, .viewer = lab_viewer, .labs = std::move(labs)});
}

TEST(Labs, AreReadBackFromThePage) {
    const std::vector<Lab> labs{lab_of("q1", "some modes"), lab_of("q5 q7", std::string("\0\xff", 2))};
    const std::vector<Lab> read = labs_in(page_with(labs));
    ASSERT_EQ(read.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(read[i].questions, labs[i].questions);
        EXPECT_EQ(read[i].data, labs[i].data);
    }
    EXPECT_EQ(page_with(read), page_with(labs));
}

TEST(Labs, OnlyTheReportForTheScreenHasThemAndOnlyWithAViewer) {
    const Lab lab = lab_of("q1", "modes");
    EXPECT_NE(page_with({lab}).find("<div class=\"lab\" id=\"lab-q1\" data-question=\"q1\">"), std::string::npos);
    const std::string without_viewer = write_html(sample_document(), {}, Templates(), {.viewer = "", .labs = {lab}});
    for (const std::string& page :
         {page_with({lab}, Volume::appendix), page_with({lab}, Volume::report, "print"), without_viewer, page_with({})}) {
        EXPECT_EQ(page.find("x-meshfolio-lab"), std::string::npos);
        EXPECT_EQ(page.find("class=\"lab\""), std::string::npos);
    }
}

TEST(Labs, MalformedDataIsSkipped) {
    const std::string tag = "<script type=\"application/x-meshfolio-lab\" data-questions=\"";
    EXPECT_EQ(labs_in(tag + "q1\">AA==</script>").size(), 1u);
    for (const char* rest : {"", "q1", "q1\">", "q1\">AA==", "q1\"><b></script>", "q1&quot;\">AA==</script>", "q1\"></script>"})
        EXPECT_EQ(labs_in(tag + rest).size(), 0u) << rest;
}

TEST(Labs, TheirOwnPageEscapesTheNameOfTheMesh) {
    const std::string page = write_lab_page("<b>{{title}}", lab_of("lab", "modes"), Templates(), lab_viewer);
    EXPECT_NE(page.find("<h1>Laboratory: &lt;b&gt;{{title}}</h1>"), std::string::npos);
    EXPECT_EQ(labs_in(page).size(), 1u);
    EXPECT_NE(page.find(packed(lab_viewer)), std::string::npos);
}

}   // namespace
}   // namespace meshfolio::report
