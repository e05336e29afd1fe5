#include "questions/reproductions/study.h"

#include "base/number_text.h"

namespace meshfolio::reproductions {

namespace {

/// Says how raw parameters of the original were scaled to this mesh; empty if they are as given.
report::Text carried_words(const Experiment& experiment, const ExperimentMesh& mesh) {
    const OriginalMesh& original = mesh.originals.front();
    const auto rule = experiment.lambda.empty() ? Carried::as_given : lambda_rule(experiment, mesh, experiment.operators.front());
    if (rule == Carried::by_limit) {
        return words.say("carried.by_limit", "original"_a = original.name, "limit"_a = readable(original.lambda_crit),
                         "file"_a = mesh.used->input.file, "limit_here"_a = readable(mesh.cotan_critical));
    }
    const bool steps = rule == Carried::by_edge, noise = !experiment.noise.empty() && noise_rule(experiment, mesh) == Carried::by_edge;
    if (!steps && !noise) return {};
    return words.say(steps && noise ? "carried.both"
                     : steps        ? "carried.steps"
                                    : "carried.noise",
                     "original"_a = original.name, "edge"_a = readable(original.mean_edge), "file"_a = mesh.used->input.file,
                     "edge_here"_a = readable(mesh.mean_edge));
}

}   // namespace

void add_opening(const Reproduction& r, const std::vector<ExperimentMesh>& meshes) {
    const Experiment& e = r.experiment;
    add(r.section(),
        report::Heading{words.line("heading", "rows"_a = sentence_case(rows_text(e.rows)), "report"_a = e.from, "name"_a = e.name)});
    const auto original_words = [](const OriginalMesh& original) {
        return original.file.empty() ? words.line("original.lost", "mesh"_a = original.name) : original.file;
    };
    const auto mesh_words = [&](const ExperimentMesh& mesh) {
        return words.line(mesh.stand_in ? "mesh.stand_in" : "mesh.itself", "file"_a = mesh.used->input.file,
                          "vertices"_a = mesh.mesh().vertex_count(), "originals"_a = listed(each_of(mesh.originals, original_words)));
    };
    report::BulletList list;
    if (!e.said.empty()) list.items.push_back(words.say("opening.said", "said"_a = e.said));
    if (!meshes.empty()) list.items.push_back(words.say("opening.here", "meshes"_a = joined(each_of(meshes, mesh_words))));
    for (const ExperimentMesh& mesh : meshes)
        if (report::Text carried = carried_words(e, mesh); !carried.empty()) list.items.push_back(std::move(carried));
    if (!e.lost.empty()) list.items.push_back(words.say("opening.lost", "lost"_a = e.lost));
    if (!list.items.empty()) add(r.section(), std::move(list));
}

std::string Reproduction::where() const { return experiment.from + ", " + rows_text(experiment.rows); }

std::string rows_text(const std::vector<int>& rows) {
    return words.line("rows", "count"_a = rows.size(), "rows"_a = listed(each_of(rows, [](int row) { return std::to_string(row); })));
}

std::string given_text(const Experiment& experiment, double lambda) {
    const std::string unit = experiment.lambda_unit == StepUnit::tau ? " λ_crit" : experiment.lambda_unit == StepUnit::h2 ? " h̄²" : "";
    return chosen_text(lambda) + unit;
}

std::string noise_text(const Experiment& experiment, double noise) {
    const std::string percent = chosen_text(100 * noise) + "\u202f%";
    if (experiment.noise_unit == NoiseUnit::box) return words.line("noise.box", "percent"_a = percent);
    if (experiment.noise_unit == NoiseUnit::diagonal) return words.line("noise.diagonal", "percent"_a = percent);
    return chosen_text(noise) + (experiment.noise_unit == NoiseUnit::edge ? " h̄" : "");
}

std::string variant_text(const Experiment& experiment, const Variant& v) {
    std::string text = name_of(v.method);
    if (experiment.operators.size() > 1 || v.kind != OperatorKind::cotan) text += ", " + std::string(operator_entry(v.kind).title);
    if (experiment.areas.size() > 1 || v.area != AreaForm::barycentric) text += ", " + std::string(name_of(v.area)) + " areas";
    return text;
}

std::string run_text(const Experiment& experiment, const Variant& v) {
    return variant_text(experiment, v) + ", λ = " + given_text(experiment, v.given);
}

std::string chosen_text(double x) { return brief_text(x, 3); }

std::string range_text(const std::vector<double>& values) {
    const auto [low, high] = std::ranges::minmax(values);
    return span_of(chosen_text(low), chosen_text(high));
}

std::string sentence_case(std::string said) {
    if (!said.empty() && said.front() >= 'a' && said.front() <= 'z') said.front() = static_cast<char>(said.front() - 'a' + 'A');
    return said;
}

std::string key_of(ExperimentColour colour) {
    std::string key = name_of(colour);
    std::ranges::replace(key, '-', '_');
    return key;
}

output::FigureRequest figure_on(const Reproduction& r, const ExperimentMesh& mesh, const std::string& first_panel) {
    const std::string id = r.id_of(mesh.name);
    return {.id = id,
            .title = r.experiment.from + ": " + r.experiment.name,
            .subtitle = mesh.used->input.file,
            .panels = {
                panel_of(*mesh.used, id + "_" + first_panel, first_panel, colours_of(mesh, r.experiment.colours.front(), mesh.mesh().X))}};
}

void add_panel(output::FigureRequest& figure, const Reproduction& r, const ExperimentMesh& mesh, const Positions& X, std::string label) {
    figure.panels.push_back(panel_of(moved_to(mesh.mesh(), X), figure.id + "_" + std::to_string(figure.panels.size()), std::move(label),
                                     colours_of(mesh, r.experiment.colours.front(), X)));
}

std::optional<output::ColorRange> range_of(const Reproduction& r, ExperimentColour colour, const std::vector<output::Panel>& panels) {
    if (colour == ExperimentColour::none) return {};
    const bool distance = colour == ExperimentColour::distance;
    const std::string own = distance ? r.settings.colormap : "diverging";
    return output::robust_range(panels, r.experiment.colormap.empty() ? own : r.experiment.colormap, words.line("colour." + key_of(colour)),
                                distance ? "% of the box diagonal" : "", 1e-6);
}

}   // namespace meshfolio::reproductions
