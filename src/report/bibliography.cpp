#include "report/bibliography.h"

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "report/page/mathml.h"

namespace meshfolio::report {

namespace {

/// Returns read(json) for a JSON template. Another structure is a usage error, as only a replaced file can have it.
template <class Read> auto read_json(const Templates& templates, const std::string& name, Read read) {
    try {
        return read(nlohmann::json::parse(templates[name]));
    } catch (const nlohmann::json::exception& problem) {
        throw UsageError(std::string("does not have the expected structure: ") + problem.what(),
                         "compare it with the file that comes with meshfolio", {name, 0});
    }
}

}   // namespace

std::map<std::string, FormulaForms> formulas_of(const Templates& templates) {
    return read_json(templates, "formulas.json", [](const nlohmann::json& json) {
        std::map<std::string, FormulaForms> formulas;
        for (const auto& [name, forms] : json.items()) {
            const std::string tex = forms.at("tex"), plain = forms.at("plain");
            formulas[name] = {tex, forms.contains("mathml") ? std::string(forms.at("mathml")) : display_mathml(name, tex, plain), plain};
        }
        return formulas;
    });
}

std::vector<CitedWork> bibliography_of(const Templates& templates) {
    return read_json(templates, "references.json", [](const nlohmann::json& json) {
        std::vector<CitedWork> works;
        for (const auto& work : json)
            works.push_back({work.at("id"), work.at("authors"), work.at("year"), work.at("title"), work.at("where")});
        return works;
    });
}

}   // namespace meshfolio::report
