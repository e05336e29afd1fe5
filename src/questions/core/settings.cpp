#include "questions/core/settings.h"

#include <algorithm>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "embedded_data.h"
#include "embedded_reports.h"
#include "questions/core/experiment.h"

namespace meshfolio {

namespace {

template <class Value> using Named = std::pair<std::string_view, Value>;

constexpr Named<ExperimentKind> kinds[]{{"curvature", ExperimentKind::curvature},           {"forms", ExperimentKind::forms},
                                        {"reconstruction", ExperimentKind::reconstruction}, {"smoothing", ExperimentKind::smoothing},
                                        {"denoising", ExperimentKind::denoising},           {"error-curve", ExperimentKind::error_curve}};
constexpr Named<SmoothingMethod> scheme_names[]{{"explicit", {SmoothingScheme::explicit_euler, false}},
                                                {"implicit", {SmoothingScheme::implicit_euler, false}},
                                                {"explicit-rebuilt", {SmoothingScheme::explicit_euler, true}},
                                                {"implicit-rebuilt", {SmoothingScheme::implicit_euler, true}},
                                                {"taubin", {SmoothingScheme::taubin, false}}};
constexpr Named<NoiseUnit> noise_units[]{
    {"raw", NoiseUnit::raw}, {"box", NoiseUnit::box}, {"diagonal", NoiseUnit::diagonal}, {"edge", NoiseUnit::edge}};
constexpr Named<ExperimentColour> colours[]{{"none", ExperimentColour::none},
                                            {"h-cotan", ExperimentColour::h_cotan},
                                            {"h-uniform", ExperimentColour::h_uniform},
                                            {"gauss", ExperimentColour::gauss},
                                            {"distance", ExperimentColour::distance}};

template <class List> std::vector<std::string> names_in(const List& list) {
    std::vector<std::string> names;
    for (const auto& entry : list) names.emplace_back(entry.first);
    return names;
}

template <class List, class Value> std::string name_in(const List& list, const Value& value) {
    return std::string(std::ranges::find(list, value, [](const auto& entry) { return entry.second; })->first);
}

template <class List> auto value_in(const List& list, const std::string& what, const std::string& name) {
    const auto it = std::ranges::find(list, name, [](const auto& entry) { return entry.first; });
    if (it != std::end(list)) return it->second;
    throw UsageError("unknown " + what + " '" + printable(name) + "'", "did you mean '" + nearest_word(name, names_in(list)) + "'?");
}

}   // namespace

std::vector<std::string> experiment_kind_names() { return names_in(kinds); }
std::vector<std::string> smoothing_method_names() { return names_in(scheme_names); }
std::vector<std::string> noise_unit_names() { return names_in(noise_units); }
std::vector<std::string> experiment_colour_names() { return names_in(colours); }

std::string name_of(ExperimentKind kind) { return name_in(kinds, kind); }
std::string name_of(const SmoothingMethod& method) { return name_in(scheme_names, method); }
std::string name_of(NoiseUnit unit) { return name_in(noise_units, unit); }
std::string name_of(ExperimentColour colour) { return name_in(colours, colour); }

ExperimentKind experiment_kind_named(const std::string& name) { return value_in(kinds, "kind", name); }
SmoothingMethod smoothing_method_named(const std::string& name) { return value_in(scheme_names, "scheme", name); }
NoiseUnit noise_unit_named(const std::string& name) { return value_in(noise_units, "unit of noise", name); }
ExperimentColour experiment_colour_named(const std::string& name) { return value_in(colours, "colour", name); }

std::string_view bundled_report_text(const std::string& name) {
    for (const auto& file : meshfolio_embedded::embedded_reports())
        if (file.name == name + ".toml") return file.bytes;
    return {};
}

std::vector<std::string> bundled_report_names() {
    std::vector<std::string> names;
    for (const auto& file : meshfolio_embedded::embedded_reports()) names.emplace_back(file.name.substr(0, file.name.rfind('.')));
    std::ranges::sort(names);
    return names;
}

std::string_view default_settings_text() {
    for (const auto& file : meshfolio_embedded::embedded_data())
        if (file.name == "report.toml") return file.bytes;
    throw std::logic_error("data/report.toml, the default settings, is not compiled in");
}

}   // namespace meshfolio
