// Experiments of earlier reports on curvature, the ellipsoid and reconstruction: pictures, tables and what was found.
#include "geometry/curvature/fundamental_forms.h"
#include "questions/bench/ellipsoid_study.h"
#include "questions/reproductions/parts.h"

namespace meshfolio::reproductions {

namespace {

// ---- curvature --------------------------------------------------------------------------------------------------------

std::string field_title(const Experiment& e, const ExperimentField& field) {
    const bool by_operator = field.colour == ExperimentColour::h_cotan && e.operators.size() > 1;
    const bool by_area = field.colour != ExperimentColour::h_uniform && e.areas.size() > 1;
    std::string title = field.colour == ExperimentColour::gauss       ? "K"
                        : field.colour == ExperimentColour::h_uniform ? "uniform H"
                                                                      : "cotangent H";
    if (by_operator) title = "H, " + std::string(operator_entry(field.kind).title);
    if (by_area) title += ", " + std::string(name_of(field.area)) + " areas";
    return title;
}

void add_field_figure(const Reproduction& r, const CurvatureExperiment& done, std::size_t m, ExperimentColour colour) {
    const ExperimentMesh& mesh = done.meshes[m];
    output::FigureRequest figure{.id = r.id_of(mesh.name() + "_" + key_of(colour)),
                                 .title = r.experiment.from + ": " + r.experiment.name,
                                 .subtitle = mesh.used->input.file};
    bool open = false;
    for (const ExperimentField& field : done.fields) {
        if (field.mesh != m || field.colour != colour) continue;
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

report::Table field_table(const Reproduction& r, const CurvatureExperiment& done) {
    return table(r.id_of("fields"), words.line("fields"), done.fields)
        .column("mesh", [&](auto& field) { return done.meshes[field.mesh].name(); })
        .column("estimate", [&](auto& field) { return field_title(r.experiment, field); })
        .column("vertices", {.digits = 6}, [](auto& field) { return field.summary.count; })
        .column("smallest", [](auto& field) { return cell_of(field.summary.minimum); })
        .column("median", [](auto& field) { return cell_of(field.summary.median); })
        .column("largest", [](auto& field) { return cell_of(field.summary.maximum); })
        .column("> 0", {.unit = "%"}, [](auto& field) { return cell_of(100 * field.positive); })
        .column("boundary", [](auto& field) { return cell_of(field.largest_boundary); });
}

/// @param first_h  the first estimate of H by cotangents on that mesh, when this is a later one
report::Text about_field(const Reproduction& r, const ExperimentField& field, const ExperimentField* first_h) {
    const std::string title = sentence_case(field_title(r.experiment, field));
    if (field.summary.count == 0) return words.say("field.undefined", "field"_a = title);
    const std::string boundary =
        std::isfinite(field.largest_boundary) ? words.line("field.boundary", "largest"_a = readable(field.largest_boundary, 2)) : "";
    if (field.largest_inside < 1e-9) {
        return words.say(field.largest_inside > 0 ? "field.nearly_flat" : "field.flat", "field"_a = title,
                         "largest"_a = readable(field.largest_inside, 1), "boundary"_a = boundary);
    }
    std::string beside;
    if (field.colour == ExperimentColour::h_cotan && first_h != nullptr) {
        const double gap = relative_error(field.inside, first_h->inside, Vector::Ones(field.inside.size()));
        if (std::isfinite(gap))
            beside = words.line(gap == 0 ? "field.same" : "field.off", "first"_a = field_title(r.experiment, *first_h),
                                "gap"_a = readable_percent(gap, 2));
    }
    return words.say("field.curved", "field"_a = title, "positive"_a = readable_percent(field.positive, 2),
                     "median"_a = readable(field.summary.median, 2), "largest"_a = readable(field.largest_inside, 2),
                     "boundary"_a = boundary, "beside"_a = beside);
}

report::Text fields_found(const Reproduction& r, const CurvatureExperiment& done, std::size_t m) {
    report::Text text = words.say("found_on", "mesh"_a = done.meshes[m].name());
    const ExperimentField* first_h = nullptr;
    for (const ExperimentField& field : done.fields) {
        if (field.mesh != m) continue;
        tell(text, about_field(r, field, first_h));
        if (field.colour == ExperimentColour::h_cotan && first_h == nullptr && field.summary.count > 0) first_h = &field;
    }
    return text;
}

// ---- reconstruction ---------------------------------------------------------------------------------------------------

std::string rebuilt_label(const Experiment& e, const RebuiltMesh& rebuilt) {
    std::string label = "k = " + std::to_string(rebuilt.k);
    if (e.operators.size() > 1) label += ", " + std::string(operator_entry(rebuilt.kind).title);
    if (e.areas.size() > 1) label += ", " + std::string(name_of(rebuilt.area)) + " areas";
    return label;
}

void add_rebuilt_figure(const Reproduction& r, const ReconstructionExperiment& done, std::size_t m) {
    const ExperimentMesh& mesh = done.meshes[m];
    const ExperimentColour colour = r.experiment.colours.front();
    output::FigureRequest figure = figure_on(r, mesh, "original");
    for (const RebuiltMesh& rebuilt : done.rebuilt) {
        if (rebuilt.mesh != m) continue;
        figure.panels.push_back(panel_of(moved_to(mesh.mesh(), rebuilt.X), figure.id + "_" + std::to_string(figure.panels.size()),
                                         rebuilt_label(r.experiment, rebuilt), colours_of(mesh, colour, rebuilt.X)));
    }
    figure.range = range_of(r, colour, figure.panels);
    add_figure(r.answer, std::move(figure), words.line("rebuilt.caption", "file"_a = mesh.used->input.file));
}

report::Table rebuilt_table(const Reproduction& r, const ReconstructionExperiment& done) {
    const auto percent = [&](const RebuiltMesh& rebuilt) { return 100 / done.meshes[rebuilt.mesh].diagonal; };
    const auto volume = [&](const RebuiltMesh& rebuilt) {
        return cell_of(100 * rebuilt.difference.volume_ratio, done.meshes[rebuilt.mesh].used->preflight().encloses_volume());
    };
    return table(r.id_of("errors"), words.line("rebuilt.errors"), done.rebuilt)
        .column("mesh", [&](auto& rebuilt) { return done.meshes[rebuilt.mesh].name(); })
        .column("operator", [](auto& rebuilt) { return operator_entry(rebuilt.kind).title; })
        .column("k", {.digits = 6}, &RebuiltMesh::k)
        .column("rms error", {.unit = "% of box"}, [&](auto& rebuilt) { return percent(rebuilt) * rebuilt.difference.rms; })
        .column("weighted", {.unit = "% of box"}, [&](auto& rebuilt) { return percent(rebuilt) * rebuilt.mass_rms; })
        .column("largest", {.unit = "% of box"}, [&](auto& rebuilt) { return percent(rebuilt) * rebuilt.difference.max; })
        .column("volume", {.unit = "% of original"}, volume)
        .column("eigenpair residual", {.digits = 2}, &RebuiltMesh::residual);
}

report::Text rebuilt_found(const Reproduction& r, const ReconstructionExperiment& done, std::size_t m) {
    Names errors;
    for (const RebuiltMesh& rebuilt : done.rebuilt)
        if (rebuilt.mesh == m)
            errors.push_back(words.line("rebuilt.error", "error"_a = readable(100 * rebuilt.difference.rms / done.meshes[m].diagonal),
                                        "label"_a = rebuilt_label(r.experiment, rebuilt)));
    return words.say("rebuilt.found", "mesh"_a = done.meshes[m].name(), "errors"_a = joined(errors));
}

/// Checks that the error in the operator's own masses does not grow with k.
void add_rebuilt_checks(const Reproduction& r, const ReconstructionExperiment& done) {
    for (std::size_t i = 0; i + 1 < done.rebuilt.size(); ++i) {
        const RebuiltMesh &fewer = done.rebuilt[i], &more = done.rebuilt[i + 1];
        if (fewer.mesh != more.mesh || fewer.kind != more.kind || fewer.area != more.area) continue;
        const ExperimentMesh& mesh = done.meshes[more.mesh];
        add(r.section(),
            check_at_most(words.line("check.rebuilt", "fewer"_a = fewer.k, "more"_a = more.k,
                                     "operator"_a = operator_entry(more.kind).title, "mesh"_a = mesh.name(), "where"_a = r.where()),
                          fewer.mass_rms / mesh.diagonal, more.mass_rms / mesh.diagonal, 1e-9));
    }
}

}   // namespace

void add_curvature_reproduction(const Reproduction& r, const CurvatureExperiment& done) {
    add_opening(r, done.meshes);
    for (std::size_t m = 0; m < done.meshes.size(); ++m)
        for (const ExperimentColour colour : r.experiment.colours) add_field_figure(r, done, m, colour);
    add(r.section(), field_table(r, done));
    for (std::size_t m = 0; m < done.meshes.size(); ++m) add_paragraphs(r.section(), {fields_found(r, done, m)});
}

void add_reconstruction_reproduction(const Reproduction& r, const ReconstructionExperiment& done) {
    add_opening(r, done.meshes);
    for (std::size_t m = 0; m < done.meshes.size(); ++m) add_rebuilt_figure(r, done, m);
    add(r.section(), rebuilt_table(r, done));
    for (std::size_t m = 0; m < done.meshes.size(); ++m) add_paragraphs(r.section(), {rebuilt_found(r, done, m)});
    add_rebuilt_checks(r, done);
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
