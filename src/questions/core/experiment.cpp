#include "questions/core/experiment.h"

#include <algorithm>
#include <array>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "embedded_reports.h"

namespace meshfolio {

namespace {

template <class Value>
struct Named {
    std::string_view name;
    Value value;
};

constexpr std::array kinds{
    Named<ExperimentKind>{"curvature", ExperimentKind::curvature},
    Named<ExperimentKind>{"forms", ExperimentKind::forms},
    Named<ExperimentKind>{"reconstruction", ExperimentKind::reconstruction},
    Named<ExperimentKind>{"smoothing", ExperimentKind::smoothing},
    Named<ExperimentKind>{"denoising", ExperimentKind::denoising},
    Named<ExperimentKind>{"error-curve", ExperimentKind::error_curve},
};
constexpr std::array scheme_names{
    Named<SmoothingMethod>{"explicit", {SmoothingScheme::explicit_euler, false}},
    Named<SmoothingMethod>{"implicit", {SmoothingScheme::implicit_euler, false}},
    Named<SmoothingMethod>{"explicit-rebuilt", {SmoothingScheme::explicit_euler, true}},
    Named<SmoothingMethod>{"implicit-rebuilt", {SmoothingScheme::implicit_euler, true}},
    Named<SmoothingMethod>{"taubin", {SmoothingScheme::taubin, false}},
};
constexpr std::array noise_units{
    Named<NoiseUnit>{"raw", NoiseUnit::raw},
    Named<NoiseUnit>{"box", NoiseUnit::box},
    Named<NoiseUnit>{"diagonal", NoiseUnit::diagonal},
    Named<NoiseUnit>{"edge", NoiseUnit::edge},
};
constexpr std::array colours{
    Named<ExperimentColour>{"none", ExperimentColour::none},           Named<ExperimentColour>{"h-cotan", ExperimentColour::h_cotan},
    Named<ExperimentColour>{"h-uniform", ExperimentColour::h_uniform}, Named<ExperimentColour>{"gauss", ExperimentColour::gauss},
    Named<ExperimentColour>{"distance", ExperimentColour::distance},
};

template <class List>
std::vector<std::string> names_in(const List& list) {
    std::vector<std::string> names;
    for (const auto& entry : list) names.emplace_back(entry.name);
    return names;
}

template <class List, class Value>
std::string name_in(const List& list, const Value& value) {
    return std::string(std::find_if(list.begin(), list.end(), [&](const auto& entry) { return entry.value == value; })->name);
}

template <class List>
auto value_in(const List& list, const std::string& what, const std::string& name) {
    const auto it = std::find_if(list.begin(), list.end(), [&](const auto& entry) { return entry.name == name; });
    if (it != list.end()) return it->value;
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
    for (const auto& file : meshfolio_embedded::embedded_reports()) {
        if (file.name == name + ".toml") return file.bytes;
    }
    return {};
}

std::vector<std::string> bundled_report_names() {
    std::vector<std::string> names;
    for (const auto& file : meshfolio_embedded::embedded_reports()) names.emplace_back(file.name.substr(0, file.name.rfind('.')));
    std::sort(names.begin(), names.end());
    return names;
}

}   // namespace meshfolio
