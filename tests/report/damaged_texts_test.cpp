// Results and templates, damaged in every place.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "damaged_bytes.h"
#include "report/escape.h"
#include "report/json/json_line.h"
#include "report/json/read_json.h"
#include "report/page/template_render.h"
#include "report/sample_document.h"
#include "report/test_tools.h"
#include "report/writers.h"

namespace meshfolio::report {
namespace {

using testing_tools::for_each_damage;
using testing_tools::is_one_line_about;

void read_or_refuse(const std::string& text) {
    try {
        read_json(text, "results.json");
    } catch (const InputError& error) {
        EXPECT_TRUE(is_one_line_about("results.json", error.what()));
    }
}

// One section with one table: small enough to be damaged everywhere.
TEST(DamagedResults, AreReadOrRefusedWithTheirLine) {
    Document document;
    document.title = "T";
    document.sections.resize(1);
    document.sections[0].id = "q1";
    document.sections[0].title = "Q";
    document.sections[0].checks = {check_near("c", 1, 1, 0.5)};
    const std::string text = nlohmann::json::parse(write_json(document, {})).dump();
    EXPECT_NO_THROW(read_json(text, "results.json"));
    for_each_damage(text, read_or_refuse);
}

TEST(DamagedResults, AreReadOrRefusedWithTheirLineForTheWholeSample) {
    const std::string text = write_json(sample_document(), sample_figures());
    for_each_damage(text, read_or_refuse, 1 + text.size() / 60);
}

TEST(DeepResults, AreRefusedWithTheLimitAndTheLine) {
    const std::string deep = std::string(1000000, '[') + std::string(1000000, ']');
    for (const std::string& text : {"{\n\"schema_version\": " + deep + "}", "\n" + deep, "{\"a\\\"\": \"[\",\n\"b\": " + deep}) {
        try {
            read_json(text, "results.json");
            FAIL();
        } catch (const InputError& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with("results.json:2: is nested more than 64 deep")) << error.what();
        }
    }
    EXPECT_FALSE(deeper_than(2, R"({"[[[[": ["]", "\\"], "\"[": [1]})"));
    EXPECT_EQ(deeper_than(2, R"([[], [], [[]]])"), 10u);
}

Templates with_page(const std::string& text) {
    const TemporaryFolder folder;
    folder.write("report.md", text);
    return Templates(folder.path());
}

std::string outcome(const std::string& text, const nlohmann::json& model) {
    try {
        return render(with_page(text), "report.md", model, xml_escape);
    } catch (const UsageError& error) {
        return error.what();
    }
}

TEST(DamagedTemplates, ArePrintedOrRefusedWithTheirLine) {
    const nlohmann::json model = {{"title", "<T>"}, {"items", {{{"name", "a"}}, {{"name", "b"}}}}, {"yes", true}, {"no", false}};
    const std::string text =
        "{{! c }}# {{title}} {{{title}}}\n{{#items}}\n- {{name}}{{#yes}} y{{/yes}}\n{{/items}}\n{{^no}}n{{/no}} }}{{&title}}\n";
    EXPECT_EQ(outcome(text, model), "# &lt;T&gt; <T>\n- a y\n- b y\nn }}<T>\n");
    const TemporaryFolder folder;
    for_each_damage(text, [&](const std::string& damaged) {
        folder.write("report.md", damaged);
        try {
            render(Templates(folder.path()), "report.md", model, xml_escape);
        } catch (const UsageError& error) {
            const std::string message = error.what();
            EXPECT_NE(message.find("report.md"), std::string::npos) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    });
}

// Each limit is named.
TEST(TemplateLimits, AreNamedWithTheFile) {
    const auto times = [](int count, const std::string& text) {
        std::string all;
        for (int i = 0; i < count; ++i) all += text;
        return all;
    };
    nlohmann::json model = {{"title", std::string(1 << 20, 'x')}, {"items", nlohmann::json::array()}};
    for (int i = 0; i < 100; ++i) model["items"].push_back(i);
    const auto expect = [&](const std::string& text, const std::string& words) {
        const std::string said = outcome(text, model);
        EXPECT_NE(said.find(words), std::string::npos) << said.substr(0, 300);
        EXPECT_NE(said.find("report.md"), std::string::npos) << said.substr(0, 300);
    };
    EXPECT_EQ(outcome(times(32, "{{#title}}") + "x" + times(32, "{{/title}}"), model), "x");
    expect("\n" + times(33, "{{#title}}") + "x" + times(33, "{{/title}}"), "report.md:2: template syntax: more than 32 sections");
    expect(times(100000, "{{#title}}"), "more than 32 sections");
    expect("\n\n{{=<% %>=}}", "report.md:3: template syntax: the delimiters of tags cannot be changed");
    expect("{{>report.md}}", "include one another more than 100 deep");
    expect(times(4, "{{#items}}") + times(4, "{{/items}}"), "more than 30000000 steps");
    expect(times(2, "{{#items}}") + "{{title}}" + times(2, "{{/items}}"), "more than 268435456 bytes");
    expect(std::string(5 << 20, 'x'), "more than the limit of 4194304");
}

}   // namespace
}   // namespace meshfolio::report
