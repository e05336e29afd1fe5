// Templates: any text has a syntax problem with its line, or is evaluated against a model: printed, or refused with one line. What the
// model says never becomes a tag.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "fuzz/fuzz_input.h"
#include "report/escape.h"
#include "report/page/template_render.h"

namespace {

using namespace meshfolio;

/// A little of everything a view model holds; its words look like tags and markup.
const nlohmann::json& model() {
    static const nlohmann::json model = {{"title", "<{{{b}}}>"},
                                         {"number", 1.5},
                                         {"yes", true},
                                         {"no", false},
                                         {"none", nlohmann::json::array()},
                                         {"one", {{"name", "{{#yes}}"}, {"two", {{"name", "&"}}}}},
                                         {"rows", {{{"name", "a"}, {"last", false}}, {{"name", "{{>report.html}}"}, {"last", true}}}}};
    return model;
}

void require_one_line(const char* what) {
    fuzzing::require(std::string_view(what).find('\n') == std::string_view::npos, "an error is one line");
}

}   // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    static report::Templates templates;
    std::string text(fuzzing::text_of(bytes, size));
    const auto problem = report::syntax_problem(text);
    if (problem) {
        const long lines = 1 + std::count(text.begin(), text.end(), '\n');
        fuzzing::require(problem->line >= 0 && problem->line <= lines, "a problem lies within the text");
        return 0;
    }
    try {
        templates.set("report.html", text, "fuzz.html");
        const std::string printed = report::render(templates, "report.html", model(), report::xml_escape);
        if (text.find("{{{") == std::string::npos && text.find("{{") != std::string::npos && text.find('<') == std::string::npos &&
            text.find('&') == std::string::npos && text.find("{{>") == std::string::npos && text.find('=') == std::string::npos) {
            fuzzing::require(printed.find('<') == std::string::npos, "what the model says is escaped");
        }
    } catch (const UsageError& error) {
        require_one_line(error.what());
    }
    return 0;
}
