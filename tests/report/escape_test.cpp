#include "report/escape.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/sample_document.h"

namespace meshfolio::report {
namespace {

bool is_utf8(const std::string& text) {
    try {
        return !nlohmann::json(text).dump().empty();   // strict by default
    } catch (const nlohmann::json::exception&) {
        return false;
    }
}

TEST(Escape, SafeTextIsOneLineOfValidUtf8WithoutControls) {
    const std::string safe = safe_text(hostile);
    EXPECT_TRUE(is_utf8(safe));
    for (const char c : safe) EXPECT_FALSE(static_cast<unsigned char>(c) < 0x20) << int(c);
    EXPECT_EQ(safe.find("\xEF\xBF\xBF"), std::string::npos);   // U+FFFF is no character of XML
    EXPECT_EQ(safe.find("\u202E"), std::string::npos);         // would turn the text around
    EXPECT_NE(safe.find("é∞"), std::string::npos);
    EXPECT_NE(safe.find("\\xff"), std::string::npos);
}

TEST(Escape, SafeTextLeavesGoodTextAlone) { EXPECT_EQ(safe_text("λ_crit = 2/μ_max\u202f%"), "λ_crit = 2/μ_max\u202f%"); }

TEST(Escape, XmlSpecialsBecomeEntitiesOfXml) {
    EXPECT_EQ(xml_escape("<a b=\"c\" d='e'>&"), "&lt;a b=&quot;c&quot; d=&#39;e&#39;&gt;&amp;");
}

TEST(Escape, MarkdownKeepsNamesReadable) {
    EXPECT_EQ(markdown_escape("images/q1_plane_h-sheet.png"), "images/q1_plane_h-sheet.png");
    EXPECT_EQ(markdown_escape("a|b"), "a\\|b");
    EXPECT_EQ(markdown_escape("_x_ *y* `z` [l](u) <t> & $"), "\\_x\\_ \\*y\\* \\`z\\` \\[l\\](u) &lt;t&gt; &amp; \\$");
}

TEST(Escape, MarkdownTextCannotBeginABlock) {
    EXPECT_EQ(markdown_escape("# no heading"), "\\# no heading");
    EXPECT_EQ(markdown_escape("- no item"), "\\- no item");
    EXPECT_EQ(markdown_escape("12. no item"), "12\\. no item");
    EXPECT_EQ(markdown_escape("---"), "\\---");
    EXPECT_EQ(markdown_escape("#q1_plane -1 + 0.5 # -"), "#q1_plane -1 + 0.5 # -");
}

TEST(Escape, MarkdownTextIsNoLink) {
    EXPECT_EQ(markdown_escape("see https://a.org, www.a.org: a@b.org"), "see https\\://a.org, www\\.a.org: a\\@b.org");
    EXPECT_EQ(markdown_escape("a:b 1.5 x.www"), "a:b 1.5 x.www");
}

TEST(Escape, UrlsHoldNothingThatNeedsQuoting) {
    EXPECT_EQ(url_path("meshes/q4_a k5.ply"), "meshes/q4_a%20k5.ply");
    EXPECT_EQ(url_path(hostile).find_first_of("<>\"'`|() \n\\[]"), std::string::npos);
    EXPECT_EQ(url_path("\xff%"), "%FF%25");
}

}   // namespace
}   // namespace meshfolio::report
