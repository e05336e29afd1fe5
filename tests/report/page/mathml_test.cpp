// Laws of spacing and style that hold in every formula, displayed or in a sentence.
#include "report/page/mathml.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "base/errors.h"
#include "report/bibliography.h"
#include "report/page/math_markup.h"
#include "report/page/view_blocks.h"
#include "report/words.h"
#include "report/writers.h"

namespace meshfolio::report {
namespace {

struct Element {
    std::string name, attributes, text;
    std::vector<Element> children;
    bool has(const std::string& attribute) const { return attributes.find(attribute) != std::string::npos; }
};

/// Reads the elements up to an end tag.
std::vector<Element> elements_of(const std::string& xml, std::size_t& at, std::string& text) {
    std::vector<Element> elements;
    while (at < xml.size() && xml.compare(at, 2, "</") != 0) {
        if (xml[at] != '<') {
            text += xml[at++];
            continue;
        }
        const std::size_t end = xml.find('>', at);
        std::string tag = xml.substr(at + 1, end - at - 1);
        at = end + 1;
        const bool is_empty = tag.ends_with('/');
        Element element;
        element.name = tag.substr(0, tag.find_first_of(" /"));
        element.attributes = tag.substr(element.name.size());
        if (!is_empty) {
            element.children = elements_of(xml, at, element.text);
            EXPECT_EQ(xml.substr(at, element.name.size() + 3), "</" + element.name + ">") << xml;
            at += element.name.size() + 3;
        }
        elements.push_back(element);
    }
    return elements;
}

std::vector<Element> parsed(const std::string& xml) {
    std::size_t at = 0;
    std::string text;
    std::vector<Element> elements = elements_of(xml, at, text);
    EXPECT_EQ(at, xml.size()) << xml;
    EXPECT_EQ(text, "");
    return elements;
}

bool is_one_of(const std::string& c, const std::string& set) { return !c.empty() && set.find(c) != std::string::npos; }
bool is_fence(const Element& e) { return e.name == "mo" && is_one_of(e.text, "()[]{}⟨⟩|‖"); }
bool is_row(const Element& e) { return e.name == "math" || e.name == "mrow" || e.name == "mtd" || e.name == "msqrt"; }
/// Returns the base of an element with scripts.
const Element& core(const Element& e) {
    return (e.name.starts_with("msu") || e.name.starts_with("mund") || e.name == "mover") && !e.children.empty() ? core(e.children[0]) : e;
}
bool is_function_name(const Element& e) { return core(e).name == "mi" && core(e).text.size() > 1 && std::isalpha(core(e).text[0]) != 0; }

void each(const Element& element, const auto& what) {
    what(element);
    for (const Element& child : element.children) each(child, what);
}

/// A sign at the beginning, or behind what waits for something, binds to what follows; elsewhere it joins two things.
void expect_signs(const std::vector<Element>& row, const std::string& formula) {
    const Element* before = nullptr;
    for (const Element& e : row) {
        if (e.name == "mspace" || e.text == "\u2061") continue;
        const bool waits = before == nullptr || (core(*before).name == "mo" && !before->has("postfix"));
        if (e.name == "mo" && is_one_of(e.text, "+−±")) {
            EXPECT_EQ(e.has("form=\"prefix\""), waits) << e.text << " in " << formula;
        }
        EXPECT_NE(e.text, "-") << formula;
        before = &e;
    }
}

void expect_functions(const std::vector<Element>& row, const std::string& formula) {
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (!is_function_name(row[i]) || core(row[i]).text == "II") continue;
        EXPECT_FALSE(core(row[i]).has("mathvariant")) << formula;
        if (i + 1 < row.size()) {
            EXPECT_TRUE(row[i + 1].name == "mo" && is_one_of(row[i + 1].text, "\u2061+−·×/=<>≤≥≈,"))
                << "behind " << core(row[i]).text << " in " << formula;
        }
        if (i > 0 && row[i - 1].name != "mspace") {
            EXPECT_EQ(row[i - 1].name, "mo") << "before " << core(row[i]).text << " in " << formula;
        }
    }
}

/// An mrow begins and ends with matching fences, which stretch only around tall contents.
void expect_fences(const Element& element, const std::string& formula) {
    const std::vector<Element>& row = element.children;
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (!is_fence(row[i])) continue;
        const bool first = i == 0 && row[i].has("form=\"prefix\""), last = i + 1 == row.size() && row[i].has("form=\"postfix\"");
        EXPECT_TRUE(element.name == "mrow" && (first || last)) << row[i].text << " in " << formula;
    }
    if (row.empty() || !(is_fence(row.front()) || is_fence(row.back()))) return;
    ASSERT_TRUE(is_fence(row.front()) && is_fence(row.back()) && row.size() > 1) << formula;
    EXPECT_EQ(row.front().has("stretchy"), row.back().has("stretchy")) << formula;
    if (is_one_of(row.front().text, "|‖")) {
        EXPECT_EQ(row.front().text, row.back().text) << formula;
    }
    bool tall = false;
    const auto look = [&](const Element& e, const auto& self) -> void {
        if (e.name == "mfrac" || e.name.starts_with("mund") || e.name == "mtable") tall = true;
        for (const Element& child : e.children)
            if (child.name != "mstyle" && !(e.name.starts_with("ms") && &child != &e.children[0] && e.name != "msqrt")) self(child, self);
    };
    look(element, look);
    EXPECT_EQ(!row.front().has("stretchy=\"false\""), tall) << formula;
}

void expect_letters(const Element& e, const std::string& formula) {
    const bool digits = std::ranges::any_of(e.text, [](char c) { return c >= '0' && c <= '9'; });
    if (digits) {
        EXPECT_EQ(e.name, "mn") << formula;
    }
    if (e.name != "mi") return;
    const bool capital_greek = e.text >= "Α" && e.text <= "Ω" && e.text.size() == 2, small_greek = is_small_greek(e.text);
    if (capital_greek) {
        EXPECT_TRUE(e.has("mathvariant=\"normal\"")) << e.text << " in " << formula;
    }
    if (small_greek) {
        EXPECT_FALSE(e.has("mathvariant")) << e.text << " in " << formula;
    }
}

void expect_laws(const std::string& xml, const std::string& formula) {
    for (const Element& math : parsed(xml)) {
        if (math.name == "wbr") continue;
        EXPECT_EQ(math.name, "math");
        each(math, [&](const Element& e) {
            if (is_row(e)) {
                expect_signs(e.children, formula);
                expect_functions(e.children, formula);
            }
            expect_fences(e, formula);
            expect_letters(e, formula);
        });
    }
}

/// All mathematics in sentences of the words.
std::set<std::string> inline_formulas() {
    static const std::regex marked(R"(\$([^$]+)\$)");
    std::set<std::string> formulas;
    const Templates templates;
    for (const std::string& file : templates.names()) {
        if (!file.starts_with("words/")) continue;
        for (const Message& message : messages_of(templates[file], file)) {
            for (const std::string& paragraph : message.paragraphs) {
                if (paragraph.starts_with("$$")) continue;
                for (std::sregex_iterator it(paragraph.begin(), paragraph.end(), marked), end; it != end; ++it) formulas.insert((*it)[1]);
                for (const Run& run : prose(std::regex_replace(paragraph, marked, "")))
                    if (run.kind == Run::Kind::math) formulas.insert(run.content);
            }
        }
    }
    return formulas;
}

TEST(Mathml, EveryDisplayedFormulaKeepsTheConvention) {
    for (const auto& [name, forms] : formulas_of(Templates())) {
        expect_laws(forms.mathml, name);
        EXPECT_NE(forms.mathml.find("alttext="), std::string::npos) << name;
    }
}

TEST(Mathml, EveryFormulaInASentenceKeepsTheConvention) {
    const auto formulas = inline_formulas();
    EXPECT_GT(formulas.size(), 150u);
    for (const std::string& formula : formulas) expect_laws(inline_mathml(formula), formula);
}

TEST(Mathml, LinesBreakOnlyBehindRelationsOfLongFormulas) {
    for (const std::string& formula : inline_formulas()) {
        const std::vector<Element> pieces = parsed(inline_mathml(formula));
        const auto length = std::ranges::count_if(formula, [](char c) { return (c & '\xc0') != '\x80'; });
        if (length <= 25) {
            EXPECT_EQ(pieces.size(), 1u) << formula;
        }
        for (std::size_t i = 0; i + 1 < pieces.size(); i += 2) EXPECT_TRUE(is_one_of(pieces[i].children.back().text, "=≈<>")) << formula;
    }
    EXPECT_EQ(parsed(inline_mathml("(du, dv) = (cos θ/b, −sin θ/c)")).size(), 3u);
}

TEST(Mathml, VectorsAreBoldInSentencesAsInDisplay) {
    const auto written_as = [](const std::string& letter, const Element& e) { return e.name == "mi" && e.text == letter; };
    for (const std::string& formula : inline_formulas()) {
        for (const Element& math : parsed(inline_mathml(formula))) {
            each(math, [&](const Element& e) {
                if (is_row(e)) {
                    for (const Element& child : e.children)
                        EXPECT_FALSE(written_as("x", core(child)) || written_as("n", core(child))) << formula;
                }
            });
        }
    }
    EXPECT_EQ(inline_mathml("x_i"), "<math><msub><mi>𝐱</mi><mi>i</mi></msub></math>");
    EXPECT_NE(inline_mathml("−2Hn").find("<mi>H</mi><mi>𝐧</mi>"), std::string::npos);
    EXPECT_NE(inline_mathml("κ_n").find("<mi>n</mi>"), std::string::npos);
    EXPECT_NE(inline_mathml("p_u").find("𝐩"), std::string::npos);
    EXPECT_EQ(inline_mathml("p"), "<math><mi>p</mi></math>");
}

TEST(Mathml, SentencesAndDisplayWriteTheSame) {
    const auto inside = [](const std::string& math) { return math.substr(math.find('>') + 1); };
    for (const auto& [words, tex] :
         std::initializer_list<std::pair<const char*, const char*>>{{"λ_crit = 2/μ_max", R"(\lambda_{\text{crit}} = 2/\mu_{\max})"},
                                                                    {"κ_n(θ) = κ_1 cos²θ", R"(\kappa_n(\theta) = \kappa_1 \cos^2\theta)"},
                                                                    {"ΦᵀMΦ", R"(\Phi^\top M\Phi)"},
                                                                    {"‖Δx‖²", R"(\lVert\Delta\mathbf{x}\rVert^2)"},
                                                                    {"|1 − λμ_i|^t", R"(|1 - \lambda\mu_i|^t)"},
                                                                    {"√(2H² − K)", R"(√(2H^2 - K))"},
                                                                    {"ĉ_i h̄", R"(\hat{c}_i\,\bar{h})"}})
        EXPECT_EQ(inside(inline_mathml(words)), inside(display_mathml("", tex, ""))) << words;
}

TEST(Mathml, UnknownTexIsAUsageErrorWithTheFormulasName) {
    for (const char* tex : {R"(\unknown)", "x^", R"(\frac{1})", "{x", "x}", R"(\mathbf{})", R"(\mathcal{B})",
                            R"(\begin{cases} x \end{cases})", R"(\begin{aligned} x)"}) {
        try {
            (void)display_mathml("mine", tex, "");
            ADD_FAILURE() << tex;
        } catch (const UsageError& problem) {
            EXPECT_NE(std::string(problem.what()).find("mine"), std::string::npos) << problem.what();
        }
    }
}

TEST(Mathml, WritesUnusualFormulasOfSentences) {
    for (const std::string formula :
         {"", "√", "((((a", "a)", "_a", "a_{b_{c_{d_{e_{f", "a}}b", "\\foo & # ~", "+_i", "²'x", "<|a", "a_", "^2"})
        (void)parsed(inline_mathml(formula));
    (void)parsed(inline_mathml(std::string(20000, '(')));
}

TEST(Prose, NamesOfMeshesAreNoFormulas) {
    for (const std::string name : {"t_rex", "H_scan.obj", "t\u00f6 rus's.obj", "cube_8k", "k_means2.ply"})
        for (const std::string& words : {"On " + name + " it is", name, "Table of " + name + ", twice"})
            for (const auto& run : prose(words)) EXPECT_NE(run.kind, report::Run::Kind::math) << words << ": " << run.content;
    EXPECT_EQ(prose("with x_i beside it").at(1).content, "x_i");
    EXPECT_EQ(prose("below \u03bb_crit it is").at(1).content, "\u03bb_crit");
}

TEST(Prose, PunctuationBehindAFormulaStaysAtIt) {
    const nlohmann::json view = prose_view("as K = 0, yet (u, v) is");
    EXPECT_EQ(view["runs"][1]["tail"], ",");
    EXPECT_EQ(view["runs"][3]["lead"], "(");
    EXPECT_EQ(view["runs"][5]["tail"], ")");
    for (const auto& run : view["runs"])
        EXPECT_TRUE(!run["is_math"] || std::string(run["mathml"]).ends_with(std::string(run["tail"]) + "</span>")) << run["mathml"];
}

}   // namespace
}   // namespace meshfolio::report
