#include "run/one_mesh/conditions.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/nearest_word.h"
#include "base/number_text.h"
#include "mesh/samples/sample_shapes.h"
#include "run/arguments.h"

namespace meshfolio::run {

namespace {

void enter_measures(const nlohmann::json& json, const std::string& key, std::map<std::string, Measure>& measures) {
    if (json.is_object() || (json.is_array() && !json.empty() && json[0].is_number())) {
        for (const auto& [inner, value] : json.items()) enter_measures(value, key + (key.empty() ? "" : ".") + inner, measures);
    } else if (json.is_array()) {
        measures[key] = static_cast<double>(json.size());
    } else if (json.is_boolean()) {
        measures[key] = json.get<bool>();
    } else if (json.is_number()) {
        measures[key] = json.get<double>();
    } else {
        measures[key] = json.is_string() ? Measure(json.get<std::string>()) : Measure();
    }
}

/// Returns the measures of a sphere, on which nearly all are defined.
const std::map<std::string, Measure>& known_measures() {
    static const auto known =
        measures_of(inspect_mesh(prepare_mesh({icosphere(0), "", {}, {}}), OperatorKind::cotan, [](std::string_view) {}));
    return known;
}

/// Returns 1 for true and 0 for false; NaN if the measure is neither that nor a number.
double number_of(const Measure& measure) {
    if (const auto* truth = std::get_if<bool>(&measure)) return *truth ? 1 : 0;
    const auto* number = std::get_if<double>(&measure);
    return number != nullptr ? *number : std::nan("");
}

bool holds(double measured, const std::string& sign, double required) {
    if (std::isnan(measured)) return false;
    if (sign == "=") return measured == required;
    if (sign == "!=") return measured != required;
    if (sign == "<") return measured < required;
    if (sign == "<=") return measured <= required;
    return sign == ">" ? measured > required : measured >= required;
}

Condition condition_in(const std::string& text) {
    constexpr const char* remedy = "write NAME, NAME=VALUE, or another of = != < <= > >=, such as closed,components=1,smallest-angle>=5";
    const std::size_t begin = std::min(text.find_first_of("=!<>"), text.size());
    const std::size_t end = std::min(text.find_first_not_of("=!<>", begin), text.size());
    Condition condition{.text = text, .key = measure_key(text.substr(0, begin)), .sign = text.substr(begin, end - begin)};
    const Measure& example = known_measures().at(condition.key);
    const bool is_truth = std::holds_alternative<bool>(example);
    const std::string value = text.substr(end), in_option = "--require " + in_quotes(text);
    if (std::holds_alternative<std::string>(example) || condition.key == "why_no_volume")
        throw UsageError(in_option + ": this measure is a text", "take a number, or true or false");
    if (condition.sign == "==") condition.sign = "=";
    if (is_truth && condition.sign.empty() && value.empty()) {
        condition.sign = "=";
        return condition;
    }
    const bool is_equation = condition.sign == "=" || condition.sign == "!=";
    if (!is_equation && (is_truth || !contains({"<", "<=", ">", ">="}, condition.sign)))
        throw UsageError(in_option + (is_truth ? " compares true or false" : " has no condition on a number"), remedy);
    if (is_truth) {
        require_choice(in_option + ": value", value, {"yes", "no", "true", "false"});
        condition.required = value == "yes" || value == "true" ? 1 : 0;
    } else {
        condition.required = finite_number(in_option + ": value", value);
    }
    return condition;
}

std::string measured_text(const Condition& condition) {
    if (!std::holds_alternative<std::monostate>(condition.measured)) return text_of(condition.measured);
    return "undefined" + (condition.reason.empty() ? "" : ": " + condition.reason);
}

}   // namespace

std::map<std::string, Measure> measures_of(const Inspection& inspection) {
    std::map<std::string, Measure> measures;
    enter_measures(nlohmann::json::parse(inspection_json(inspection)), "", measures);
    return measures;
}

std::string measure_key(const std::string& name) {
    std::string key = name;
    std::ranges::replace(key, '-', '_');
    if (known_measures().contains(key)) return key;
    if (known_measures().contains(key + "_deg")) return key + "_deg";
    std::vector<std::string> known;
    for (const auto& [measure, value] : known_measures()) known.push_back(measure);
    throw UsageError("unknown measure " + in_quotes(name), suggestion(key, known) + "meshfolio inspect MESH --json has all names");
}

std::string text_of(const Measure& measure) {
    if (const auto* text = std::get_if<std::string>(&measure)) return *text;
    if (const auto* truth = std::get_if<bool>(&measure)) return *truth ? "yes" : "no";
    return exact_text(number_of(measure));
}

std::vector<Condition> conditions_in(const std::string& text) {
    std::vector<Condition> conditions;
    for (const std::string& part : split(text, ',')) conditions.push_back(condition_in(part));
    return conditions;
}

void try_on(const Inspection& inspection, std::vector<Condition>& conditions) {
    const std::map<std::string, Measure> measures = measures_of(inspection);
    for (Condition& condition : conditions) {
        if (const auto found = measures.find(condition.key); found != measures.end()) condition.measured = found->second;
        condition.holds = holds(number_of(condition.measured), condition.sign, condition.required);
        if (!std::holds_alternative<std::monostate>(condition.measured)) continue;
        if (condition.key == "volume") condition.reason = text_of(measures.at("why_no_volume"));
        if (condition.key == "genus") condition.reason = "the mesh is not one orientable manifold component";
        if (condition.key.starts_with("lambda_crit") || condition.key.starts_with("definiteness"))
            condition.reason = inspection.no_stability;
    }
}

std::string lines_of(const std::vector<Condition>& conditions) {
    std::size_t first = 0, second = 0;
    for (const Condition& condition : conditions) {
        first = std::max(first, condition.text.size());
        second = std::max(second, measured_text(condition).size());
    }
    std::string text;
    for (const Condition& condition : conditions) {
        const std::string measured = measured_text(condition);
        text += condition.text + std::string(first + 2 - condition.text.size(), ' ') + measured +
                std::string(second + 2 - measured.size(), ' ') + (condition.holds ? "holds" : "FAILS") + "\n";
    }
    return text;
}

std::string inspection_json(const Inspection& inspection, const std::vector<Condition>& conditions) {
    auto json = nlohmann::ordered_json::parse(inspection_json(inspection));
    for (const Condition& condition : conditions) {
        nlohmann::ordered_json measured;
        if (const auto* truth = std::get_if<bool>(&condition.measured)) measured = *truth;
        if (const auto* number = std::get_if<double>(&condition.measured)) measured = *number;
        json["conditions"].push_back({{"condition", condition.text}, {"measured", measured}, {"holds", condition.holds}});
    }
    return json.dump(2);
}

report::Document document_of(const std::vector<Condition>& conditions, const std::string& mesh) {
    using report::Check;
    report::Section section;
    section.id = "inspect";
    section.title = mesh;
    for (const Condition& condition : conditions) {
        const bool at_most = condition.sign.starts_with('<'), at_least = condition.sign.starts_with('>');
        section.checks.push_back({.name = condition.text,
                                  .expected = condition.sign == "!=" ? std::nan("") : condition.required,
                                  .measured = number_of(condition.measured),
                                  .status = condition.holds ? Check::Status::passed : Check::Status::failed,
                                  .kind = at_most    ? Check::Kind::at_most
                                          : at_least ? Check::Kind::at_least
                                                     : Check::Kind::near,
                                  .note = condition.reason});
    }
    report::Document document;
    document.sections = {std::move(section)};
    return document;
}

}   // namespace meshfolio::run
