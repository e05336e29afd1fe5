#include <algorithm>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/reproductions/parts.h"
#include "report/brief_number.h"

namespace meshfolio::reproductions {

namespace {

/// "bunny.off", or "the dragon, which is not to be had".
std::string original_words(const OriginalMesh& original) {
    return original.file.empty() ? "the " + original.name + ", which is not to be had" : original.file;
}

std::string mesh_words(const ExperimentMesh& mesh) {
    const std::string used = mesh.used->input.file + " (" + counted(mesh.mesh().vertex_count(), "vertex", "vertices") + ")";
    if (!mesh.stand_in) return used + " itself";
    std::vector<std::string> originals;
    for (const OriginalMesh& original : mesh.originals) originals.push_back(original_words(original));
    return used + " in place of " + listed(originals);
}

/// How raw numbers of the original became numbers here; empty when they are as given.
report::Text carried_words(const Experiment& experiment, const ExperimentMesh& mesh) {
    const OriginalMesh& original = mesh.originals.front();
    const OperatorKind kind = experiment.operators.front();
    const bool steps = !experiment.lambda.empty();
    if (steps && lambda_rule(experiment, mesh, kind) == Carried::by_limit) {
        return report::text("The λ belong to the ", original.name, ", whose ", report::math("λ_crit"), " is ",
                            readable(original.lambda_crit), ". On ", mesh.used->input.file, ", with ", report::math("λ_crit"), " = ",
                            readable(mesh.cotan_critical), ", they are the same multiples of it.");
    }
    const bool by_edge = steps && lambda_rule(experiment, mesh, kind) == Carried::by_edge;
    const bool noise_by_edge = !experiment.noise.empty() && noise_rule(experiment, mesh) == Carried::by_edge;
    if (!by_edge && !noise_by_edge) return {};
    const std::string what = by_edge && noise_by_edge ? "λ and σ" : by_edge ? "The λ" : "The σ";
    return report::text(what, " belong to the ", original.name, ", whose mean edge is ", readable(original.mean_edge), ". On ",
                        mesh.used->input.file, ", with ", readable(mesh.mean_edge), ", they are the same multiples of the mean edge",
                        by_edge ? (noise_by_edge ? " and its square." : "'s square.") : ".");
}

}   // namespace

void add_opening(const Reproduction& r, const std::vector<ExperimentMesh>& meshes) {
    const Experiment& e = r.experiment;
    add_heading(r.section(), sentence_case(rows_text(e.rows)) + " (" + e.from + "): " + e.name);
    report::BulletList list;
    if (!e.said.empty()) list.items.push_back(report::text(report::strong("The report: "), e.said));
    if (!meshes.empty()) {
        std::vector<std::string> words;
        for (const ExperimentMesh& mesh : meshes) words.push_back(mesh_words(mesh));
        std::string joined;
        for (const std::string& word : words) joined += (joined.empty() ? "" : "; ") + word;
        list.items.push_back(report::text(report::strong("Here: "), joined, "."));
    }
    for (const ExperimentMesh& mesh : meshes) {
        if (const report::Text words = carried_words(e, mesh); !words.empty()) list.items.push_back(words);
    }
    if (!e.lost.empty()) list.items.push_back(report::text(report::strong("Not in the report: "), e.lost));
    if (!list.items.empty()) r.section().blocks.emplace_back(std::move(list));
}

std::string rows_text(const std::vector<int>& rows) {
    std::vector<std::string> numbers;
    for (const int row : rows) numbers.push_back(std::to_string(row));
    return (rows.size() == 1 ? "row " : "rows ") + listed(numbers);
}

std::string given_text(const Experiment& experiment, double lambda) {
    const std::string unit = experiment.lambda_unit == StepUnit::tau ? " λ_crit" : experiment.lambda_unit == StepUnit::h2 ? " h̄²" : "";
    return chosen_text(lambda) + unit;
}

std::string noise_text(const Experiment& experiment, double noise) {
    switch (experiment.noise_unit) {
        case NoiseUnit::box:
            return chosen_text(100 * noise) + "\u202f% of the box";
        case NoiseUnit::diagonal:
            return chosen_text(100 * noise) + "\u202f% of the diagonal";
        case NoiseUnit::edge:
            return chosen_text(noise) + " h̄";
        case NoiseUnit::raw:
            break;
    }
    return chosen_text(noise);
}

std::string variant_text(const Experiment& experiment, OperatorKind kind, AreaForm area, const SmoothingMethod& method) {
    std::string words = name_of(method);
    if (experiment.operators.size() > 1 || kind != OperatorKind::cotan) words += ", " + std::string(operator_entry(kind).title);
    if (experiment.areas.size() > 1 || area != AreaForm::barycentric) words += ", " + std::string(name_of(area)) + " areas";
    return words;
}

std::string chosen_text(double x) { return report::brief(x, 3); }

std::string range_text(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const std::string first = chosen_text(*low), last = chosen_text(*high);
    return first == last ? first : first + " to " + last;
}

std::string sentence_case(std::string words) {
    if (!words.empty() && words.front() >= 'a' && words.front() <= 'z') words.front() = static_cast<char>(words.front() - 'a' + 'A');
    return words;
}

std::optional<output::ColorRange> range_of(const Reproduction& r, ExperimentColour colour, const std::vector<output::Panel>& panels) {
    const auto range = [&](const std::string& own, const std::string& quantity, const std::string& unit, double floor) {
        const std::string map = r.experiment.colormap.empty() ? own : r.experiment.colormap;
        return output::robust_range(panels, map, quantity, unit, floor);
    };
    switch (colour) {
        case ExperimentColour::none:
            return {};
        case ExperimentColour::h_cotan:
            return range("diverging", "H by cotangents × mean edge", "", 1e-6);
        case ExperimentColour::h_uniform:
            return range("diverging", "H by uniform weights / mean edge", "", 1e-6);
        case ExperimentColour::gauss:
            return range("diverging", "K × squared mean edge", "", 1e-6);
        case ExperimentColour::distance:
            break;
    }
    return range(r.settings.colormap, "distance to the original", "% of the box diagonal", 1e-6);
}

}   // namespace meshfolio::reproductions
