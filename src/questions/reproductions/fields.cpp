// Experiments of earlier reports on curvature, the ellipsoid and reconstruction: figures, tables and results in words.
#include "geometry/curvature/fundamental_forms.h"
#include "questions/bench/ellipsoid_study.h"
#include "questions/reproductions/study.h"

namespace meshfolio::reproductions {

namespace {

// ---- curvature --------------------------------------------------------------------------------------------------------

/// "K", "uniform H", "H, clamped, mixed areas": with operator and area form if there are several.
std::string field_title(const Experiment& e, const ExperimentField& field) {
    std::string title = field.colour == ExperimentColour::gauss       ? "K"
                        : field.colour == ExperimentColour::h_uniform ? "uniform H"
                        : e.operators.size() > 1                      ? "H, " + std::string(operator_entry(field.kind).title)
                                                                      : "cotangent H";
    if (field.colour != ExperimentColour::h_uniform && e.areas.size() > 1) title += ", " + std::string(name_of(field.area)) + " areas";
    return title;
}

/// Adds a figure of the fields of this colour on the mesh, if there are any.
void add_field_figure(const Reproduction& r, const Done<ExperimentField>& done, const ExperimentMesh& mesh, ExperimentColour colour) {
    output::FigureRequest figure{.id = r.id_of(mesh.name + "_" + key_of(colour)),
                                 .title = r.experiment.from + ": " + r.experiment.name,
                                 .subtitle = mesh.used->input.file};
    bool open = false;
    for (const ExperimentField& field : done.results) {
        if (field.mesh != &mesh || field.colour != colour) continue;
        open = open || std::isfinite(field.largest_boundary);
        figure.panels.push_back(
            panel_of(*mesh.used, figure.id + "_" + std::to_string(figure.panels.size()), field_title(r.experiment, field), field.drawn));
    }
    if (figure.panels.empty()) return;
    figure.range = range_of(r, colour, figure.panels);
    std::string what = "Curvature";
    if (figure.panels.size() == 1) what = sentence_case(std::exchange(figure.panels.front().label, ""));
    std::string caption = words.line(figure.range ? "field.caption" : "field.caption.no_range", "what"_a = what, "file"_a = figure.subtitle,
                                     "quantity"_a = figure.range ? figure.range->quantity : "");
    if (open) caption += " " + words.line("field.caption.boundary");
    add_figure(r.answer, std::move(figure), std::move(caption));
}

/// Describes each field of the mesh; an estimate of H by cotangents is compared with the first one.
report::Text fields_found(const Experiment& e, const Done<ExperimentField>& done, const ExperimentMesh& mesh) {
    report::Text text = words.say("found_on", "mesh"_a = mesh.name);
    const ExperimentField* first_h = nullptr;
    for (const ExperimentField& field : done.results) {
        if (field.mesh != &mesh) continue;
        const std::string title = sentence_case(field_title(e, field));
        if (field.summary.count == 0) {
            add_sentence(text, words.say("field.undefined", "field"_a = title));
            continue;
        }
        const bool flat = field.largest_inside < 1e-9;
        std::string boundary, beside;
        if (std::isfinite(field.largest_boundary))
            boundary = words.line("field.boundary", "largest"_a = readable(field.largest_boundary, 2));
        if (field.colour == ExperimentColour::h_cotan && first_h && !flat) {
            const double gap = relative_error(field.inside, first_h->inside, Vector::Ones(field.inside.size()));
            if (std::isfinite(gap))
                beside = words.line(gap == 0 ? "field.same" : "field.off", "first"_a = field_title(e, *first_h),
                                    "gap"_a = readable_percent(gap, 2));
        }
        const std::string_view key = !flat ? "field.curved" : field.largest_inside > 0 ? "field.nearly_flat" : "field.flat";
        add_sentence(text,
                     words.say(key, "field"_a = title, "positive"_a = readable_percent(field.positive, 2),
                               "median"_a = readable(field.summary.median, 2), "largest"_a = readable(field.largest_inside, flat ? 1 : 2),
                               "boundary"_a = boundary, "beside"_a = beside));
        if (field.colour == ExperimentColour::h_cotan && !first_h) first_h = &field;
    }
    return text;
}

// ---- reconstruction ---------------------------------------------------------------------------------------------------

/// "k = 5, clamped, mixed areas": with operator and area form if there are several.
std::string rebuilt_label(const Experiment& e, const RebuiltMesh& rebuilt) {
    std::string label = "k = " + std::to_string(rebuilt.k);
    if (e.operators.size() > 1) label += ", " + std::string(operator_entry(rebuilt.kind).title);
    if (e.areas.size() > 1) label += ", " + std::string(name_of(rebuilt.area)) + " areas";
    return label;
}

report::Table rebuilt_table(const Reproduction& r, const Done<RebuiltMesh>& done) {
    const auto volume = [](const RebuiltMesh& rebuilt) {
        return cell_of(100 * rebuilt.difference.volume_ratio, rebuilt.mesh->used->preflight().encloses_volume());
    };
    return table(r.id_of("errors"), words.line("rebuilt.errors"), done.results)
        .column("mesh", [](auto& rebuilt) { return rebuilt.mesh->name; })
        .column("operator", [](auto& rebuilt) { return operator_entry(rebuilt.kind).title; })
        .column("k", {.digits = 6}, &RebuiltMesh::k)
        .column("rms error", {.unit = "% of box"}, [](auto& rebuilt) { return rebuilt.mesh->percent() * rebuilt.difference.rms; })
        .column("weighted", {.unit = "% of box"}, [](auto& rebuilt) { return rebuilt.mesh->percent() * rebuilt.mass_rms; })
        .column("largest", {.unit = "% of box"}, [](auto& rebuilt) { return rebuilt.mesh->percent() * rebuilt.difference.max; })
        .column("volume", {.unit = "% of original"}, volume)
        .column("eigenpair residual", {.digits = 2}, &RebuiltMesh::residual);
}

}   // namespace

void add_curvature_reproduction(const Reproduction& r, const Done<ExperimentField>& done) {
    add_opening(r, done.meshes);
    for (const ExperimentMesh& mesh : done.meshes)
        for (const ExperimentColour colour : r.experiment.colours) add_field_figure(r, done, mesh, colour);
    add(r.section(), table(r.id_of("fields"), words.line("fields"), done.results)
                         .column("mesh", [](auto& field) { return field.mesh->name; })
                         .column("estimate", [&](auto& field) { return field_title(r.experiment, field); })
                         .column("vertices", {.digits = 6}, [](auto& field) { return field.summary.count; })
                         .column("smallest", [](auto& field) { return cell_of(field.summary.minimum); })
                         .column("median", [](auto& field) { return cell_of(field.summary.median); })
                         .column("largest", [](auto& field) { return cell_of(field.summary.maximum); })
                         .column("> 0", {.unit = "%"}, [](auto& field) { return cell_of(100 * field.positive); })
                         .column("boundary", [](auto& field) { return cell_of(field.largest_boundary); }));
    for (const ExperimentMesh& mesh : done.meshes) add_paragraphs(r.section(), {fields_found(r.experiment, done, mesh)});
}

void add_reconstruction_reproduction(const Reproduction& r, const Done<RebuiltMesh>& done) {
    add_opening(r, done.meshes);
    for (const ExperimentMesh& mesh : done.meshes) {
        output::FigureRequest figure = figure_on(r, mesh, "original");
        for (const RebuiltMesh& rebuilt : done.results)
            if (rebuilt.mesh == &mesh) add_panel(figure, r, mesh, rebuilt.X, rebuilt_label(r.experiment, rebuilt));
        figure.range = range_of(r, r.experiment.colours.front(), figure.panels);
        add_figure(r.answer, std::move(figure), words.line("rebuilt.caption", "file"_a = mesh.used->input.file));
    }
    add(r.section(), rebuilt_table(r, done));
    for (const ExperimentMesh& mesh : done.meshes) {
        Names errors;
        for (const RebuiltMesh& rebuilt : done.results)
            if (rebuilt.mesh == &mesh)
                errors.push_back(words.line("rebuilt.error", "error"_a = readable(100 * rebuilt.difference.rms / mesh.diagonal),
                                            "label"_a = rebuilt_label(r.experiment, rebuilt)));
        add_paragraphs(r.section(), {words.say("rebuilt.found", "mesh"_a = mesh.name, "errors"_a = joined(errors))});
    }
    for (std::size_t i = 0; i + 1 < done.results.size(); ++i) {   // the error in the operator's own masses does not grow with k
        const RebuiltMesh &fewer = done.results[i], &more = done.results[i + 1];
        if (static_cast<const Variant&>(fewer) != more) continue;
        add(r.section(),
            check_at_most(words.line("check.rebuilt", "fewer"_a = fewer.k, "more"_a = more.k,
                                     "operator"_a = operator_entry(more.kind).title, "mesh"_a = more.mesh->name, "where"_a = r.where()),
                          fewer.mass_rms / more.mesh->diagonal, more.mass_rms / more.mesh->diagonal, 1e-9));
    }
}

void add_forms_reproduction(const Reproduction& r) {
    add_opening(r, {});
    constexpr int steps = 360;
    const Ellipsoid& e = tall_ellipsoid;
    report::Series angle{.name = words.line("forms.angle")};
    report::Series parameters{.name = words.line("forms.parameters"), .style = report::Series::Style::dashed};
    double largest = 0, smallest = INFINITY, at_largest = 0, at_smallest = 0;
    for (int i = 0; i <= steps; ++i) {
        const double theta = 2 * pi * i / steps, kappa = tip_curvature_by_angle(e, theta);
        add_point(angle, theta, kappa);
        add_point(parameters, theta, tip_curvature_by_parameters(e, theta));
        if (i < steps / 2 && kappa > largest) largest = kappa, at_largest = theta;
        if (i < steps / 2 && kappa < smallest) smallest = kappa, at_smallest = theta;
    }
    add(r.section(), report::Plot{.id = r.id_of("normal_curvature"),
                                  .caption = words.line("forms.caption", "axes"_a = axes_text(e)),
                                  .x_label = "θ",
                                  .y_label = "normal curvature [1/length]",
                                  .series = {std::move(angle), std::move(parameters)},
                                  .vertical_lines = {{0, "0"}, {pi / 2, "π/2"}, {pi, "π"}, {3 * pi / 2, "3π/2"}, {2 * pi, "2π"}}});
    const double at_pole = (ellipsoid_point(e, 0, pi) - Vector3(e.a, 0, 0)).norm();
    add_words(r.section(), words, "forms.found", "largest"_a = readable(largest), "at_largest"_a = readable(at_largest),
              "smallest"_a = readable(smallest), "at_smallest"_a = readable(at_smallest), "pole"_a = readable(at_pole));
    add(r.section(), check_near(words.line("check.forms.y"), e.a / (e.b * e.b), largest, 1e-12),
        check_near(words.line("check.forms.z"), e.a / (e.c * e.c), smallest, 1e-12));
}

}   // namespace meshfolio::reproductions
