#include "report/page/template_render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/errors.h"
#include "report/escape.h"
#include "report/page/view_model.h"
#include "report/sample_document.h"
#include "report/test_tools.h"

namespace meshfolio::report {
namespace {

using nlohmann::json;

/// Returns the message of the UsageError that an action throws; empty if it throws none.
template <class Action> std::string usage_error_of(Action action) {
    try {
        action();
    } catch (const UsageError& error) {
        return error.what();
    }
    return "";
}

/// Returns the bundled templates with `text` as report.md.
Templates with_markdown(const std::string& text) {
    const TemporaryFolder folder;
    folder.write("report.md", text);
    return Templates(folder.path());
}

std::string rendered(const std::string& text, const json& model) { return render(with_markdown(text), "report.md", model, xml_escape); }

TEST(TemplateRender, ListsConditionsAndEscapes) {
    const json model = {{"items", {{{"name", "<a>"}}, {{"name", "b"}}}}, {"yes", true}, {"no", false}, {"empty", json::array()}};
    EXPECT_EQ(rendered("{{#items}}[{{name}}|{{{name}}}]{{/items}}", model), "[&lt;a&gt;|<a>][b|b]");
    EXPECT_EQ(rendered("{{#yes}}y{{/yes}}{{#no}}n{{/no}}{{^no}}N{{/no}}{{^empty}}E{{/empty}}", model), "yNE");
}

TEST(TemplateRender, UnknownTagIsNamedWithItsLine) {
    EXPECT_EQ(
        usage_error_of([] { rendered("a\nb\n{{nothing}}", json::object()); }).rfind("report.md:3: nothing is called {{nothing}} here", 0),
        0u);
    EXPECT_NE(usage_error_of([] { rendered("{{#items}}{{nam}}{{/items}}", {{"items", {{{"name", "x"}}}}}); }), "");
    EXPECT_NE(usage_error_of([] { rendered("{{^nothing}}x{{/nothing}}", json::object()); }), "");
}

TEST(TemplateRender, SyntaxErrorIsNamedWithItsLine) {
    EXPECT_NE(
        usage_error_of([] { with_markdown("one\n{{#open}}\nthree"); }).find("report.md:2: template syntax: Unclosed section \"open\""),
        std::string::npos);
    EXPECT_NE(usage_error_of([] { with_markdown("one\n\n{{tag"); }).find("report.md:3: template syntax: Unclosed tag"), std::string::npos);
    EXPECT_NE(usage_error_of([] { with_markdown("{{/a}}"); }).find("report.md:1:"), std::string::npos);
    EXPECT_NE(usage_error_of([] { with_markdown("{{#a}}{{/b}}"); }).find("report.md:1:"), std::string::npos);
}

TEST(TemplateRender, ATemplateThatIncludesItselfIsRefused) {
    EXPECT_NE(usage_error_of([] { rendered("{{>report.md}}", json::object()); }).find("includes itself"), std::string::npos);
}

TEST(TemplateRender, UnknownIncludesAreNamedWithTheNearest) {
    const std::string error = usage_error_of([] { rendered("{{>/etc/passwd}}", json::object()); });
    EXPECT_TRUE(error.starts_with("report.md: {{>/etc/passwd}} includes no known template; did you mean '")) << error;
}

TEST(Templates, AnUnreadableOneIsRefused) {
    const TemporaryFolder folder;
    std::filesystem::create_symlink("nowhere", folder.path() / "report.html");
    EXPECT_NE(usage_error_of([&] { Templates(folder.path()); }).find("report.html"), std::string::npos);
}

TEST(Templates, LinksLeadNowhereOutsideTheirFolder) {
    const TemporaryFolder outside, folder;
    outside.write("secret", "root:x");
    folder.write("mine.md", "mine");
    std::filesystem::create_symlink("mine.md", folder.path() / "report.md");
    const TemporaryFolder links;
    std::filesystem::create_directory_symlink(folder.path(), links.path() / "theme");
    EXPECT_EQ(Templates(links.path() / "theme")["report.md"], "mine") << "the folder itself may be a link";
    for (const std::filesystem::path& target :
         {outside.path() / "secret", std::filesystem::path("..") / outside.path().filename() / "secret"}) {
        std::filesystem::remove(folder.path() / "report.md");
        std::filesystem::create_symlink(target, folder.path() / "report.md");
        EXPECT_NE(usage_error_of([&] { Templates(folder.path()); }).find("report.md: is a link that leads out"), std::string::npos)
            << target;
    }
    std::filesystem::remove(folder.path() / "report.md");
    std::filesystem::create_directory_symlink(outside.path(), folder.path() / "words");
    outside.write("q1.md", "## key\n");
    EXPECT_NE(usage_error_of([&] { Templates(folder.path()); }).find("words/q1.md: is a link that leads out"), std::string::npos);
}

TEST(Templates, FolderReplacesFileByFile) {
    const Templates replaced = with_markdown("mine");
    EXPECT_EQ(replaced["report.md"], "mine");
    EXPECT_EQ(replaced["report.html"], Templates()["report.html"]);
}

TEST(Templates, UnusableOnesAreUsageErrors) {
    EXPECT_NE(usage_error_of([] { Templates("/nowhere/at/all"); }).find("/nowhere/at/all"), std::string::npos);
    EXPECT_NE(usage_error_of([] { (void)Templates()["unknown.html"]; }).find("unknown.html"), std::string::npos);
    EXPECT_NE(usage_error_of([] { Templates().replace("report.md", "/nowhere"); }).find("/nowhere"), std::string::npos);
    const TemporaryFolder folder;
    folder.write("formulas.json", "{\n\n  oops }");
    EXPECT_NE(usage_error_of([&] { Templates(folder.path()); }).find("formulas.json:3"), std::string::npos);
    folder.write("formulas.json", "[1]");
    EXPECT_NE(usage_error_of([&] { (void)write_html({}, {}, Templates(folder.path())); }).find("formulas.json"), std::string::npos);
    std::filesystem::remove(folder.path() / "formulas.json");
    folder.write("report.css", "a { content: '</style>' }");
    EXPECT_NE(usage_error_of([&] { (void)write_html({}, {}, Templates(folder.path())); }).find("report.css"), std::string::npos);
}

json model_of(const Document& document, ViewOptions options = {}, const DrawnFigures& figures = sample_figures()) {
    options.lab_questions = "q1 ";
    json model = view_model(document, figures, Templates(), options);
    for (const char* extra : {"style", "scheme_script", "script", "policy", "viewer"}) model[extra] = "";   // of the page
    model["has_viewer"] = options.models;
    model["labs"] = json::array({{{"questions", "q1"}, {"data", ""}}});
    return model;
}

/// Models that together have every value: the sample has failed checks and no files of plots, all_well the opposite.
std::vector<json> complete_models() {
    Document all_well = sample_document();
    all_well.sections[0].points = 8;
    all_well.sections[0].intro = "Compute *it*.";
    Document without_questions = sample_document();
    without_questions.sections.erase(without_questions.sections.begin(), without_questions.sections.begin() + 3);
    for (Section& section : all_well.sections) std::erase_if(section.checks, [](const Check& check) { return !check.passed(); });
    ViewOptions with_files;
    with_files.plot_files = true;
    ViewOptions with_models;
    with_models.models = with_models.paper = true;
    with_models.lab_questions = "q1 ";
    // On paper nothing links to the other volume.
    Document parted = sample_document();
    parted.sections[0].appendix_from = 13;   // behind the tables
    parted.sections[3] = parted.sections[0];
    parted.sections[3].id = "truth";
    parted.sections[3].blocks.clear();
    ViewOptions on_paper;
    on_paper.page_numbers = on_paper.plain_formulas = true;
    ViewOptions appendix;
    appendix.volume = Volume::appendix;
    ViewOptions short_appendix = appendix;
    short_appendix.passed_checks = false;
    short_appendix.page_numbers = true;
    ViewOptions without_mathml;
    without_mathml.plain_formulas = true;
    return {model_of(sample_document()),
            model_of(all_well, with_files),
            model_of(sample_document(), without_mathml),
            model_of(sample_document(), with_models, sample_models()),
            model_of(sample_document(), {}, sample_layouts()),
            model_of(parted, on_paper),
            model_of(parted, appendix, sample_models()),
            model_of(parted, short_appendix),
            model_of(all_well, appendix),
            model_of(without_questions)};
}

/// Expects that the models know every tag of the template, and that one of them meets it: an unknown tag put before it is an error.
void expect_all_tags_known(const std::string& name) {
    std::vector<json> models;
    for (json model : complete_models()) {
        for (const bool is_screen : {true, false}) {   // the pages share the templates of blocks
            model["is_screen"] = is_screen;
            models.push_back(model);
        }
    }
    Templates templates;
    const auto error_of = [&](const json& model) { return usage_error_of([&] { (void)render(templates, name, model, xml_escape); }); };
    for (const json& model : models) EXPECT_EQ(error_of(model), "");
    std::set<std::string> files, open{name};
    while (!open.empty()) {
        const std::string file = *open.begin(), text = templates[file];
        open.erase(file);
        files.insert(file);
        for (const std::string& included : matches(text, "\\{\\{>([^}]*)\\}\\}"))
            if (!files.contains(included)) open.insert(included);
        for (std::size_t at = text.find("{{"); at != std::string::npos; at = text.find("{{", text.find("}}", at))) {
            if (text[at + 2] == '/' || text[at + 2] == '>') continue;
            templates.set(file, text.substr(0, at) + "{{unknown}}" + text.substr(at), file);
            const bool is_met = std::ranges::any_of(models, [&](const json& model) { return !error_of(model).empty(); });
            EXPECT_TRUE(is_met) << file << ": never met " << text.substr(at, 40);
        }
        templates.set(file, text, file);
    }
}

TEST(ViewModel, KnowsEveryTagOfTheHtmlTemplate) { expect_all_tags_known("report.html"); }

TEST(ViewModel, KnowsEveryTagOfTheMarkdownTemplate) { expect_all_tags_known("report.md"); }

TEST(ViewModel, KnowsEveryTagOfThePrintTemplate) { expect_all_tags_known("print.html"); }

TEST(ViewModel, KnowsEveryTagOfTheSummary) { expect_all_tags_known("summary.md"); }

TEST(ViewModel, UnknownFormulaIsNamed) {
    Document document = sample_document();
    document.sections[0].blocks.push_back(Formula{"no_such_formula", ""});
    try {
        (void)view_model(document, {}, Templates(), {});
        FAIL() << "no exception";
    } catch (const std::logic_error& error) {
        EXPECT_NE(std::string(error.what()).find("no_such_formula"), std::string::npos);
    }
}

}   // namespace
}   // namespace meshfolio::report
