// Experiments of earlier reports on curvature, the ellipsoid and reconstruction: pictures, tables and what was found.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/curvature/fundamental_forms.h"
#include "questions/bench/ellipsoid_study.h"
#include "questions/core/section_tools.h"
#include "questions/core/six_view_figure.h"
#include "questions/core/value_lists.h"
#include "questions/reproductions/parts.h"

namespace meshfolio::reproductions {

namespace {

using report::check_at_most;
using report::check_near;
using report::math;

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

void add_field_figures(const Reproduction& r, const CurvatureExperiment& done) {
    const Experiment& e = r.experiment;
    for (std::size_t m = 0; m < done.meshes.size(); ++m) {
        for (const ExperimentColour colour : e.colours) {
            const ExperimentMesh& mesh = done.meshes[m];
            SixViewFigure figure;
            std::string what = name_of(colour);
            std::replace(what.begin(), what.end(), '-', '_');
            figure.id = r.id_of(mesh.name() + "_" + what);
            figure.title = e.from + ": " + e.name;
            figure.subtitle = mesh.used->input.file;
            bool open = false;
            for (const ExperimentField& field : done.fields) {
                if (field.mesh != m || field.colour != colour) continue;
                open = open || std::isfinite(field.largest_boundary);
                figure.panels.push_back(
                    panel_of(*mesh.used, figure.id + "_" + std::to_string(figure.panels.size()), field_title(e, field), field.drawn));
            }
            if (figure.panels.empty()) continue;
            figure.range = range_of(r, colour, figure.panels);
            figure.caption =
                (figure.panels.size() == 1 ? sentence_case(figure.panels.front().label) : "Curvature") + " of " + mesh.used->input.file;
            if (figure.panels.size() == 1) figure.panels.front().label.clear();
            if (figure.range) figure.caption += ": " + figure.range->quantity;
            figure.caption +=
                open ? ". The boundary is coloured by the same formula, as the report drew it; it is no curvature there." : ".";
            add_figure(r.answer, std::move(figure));
        }
    }
}

void add_field_table(const Reproduction& r, const CurvatureExperiment& done) {
    report::Table table;
    table.id = r.id_of("fields");
    table.caption =
        "The estimates, made free of the unit by the mean edge: ½‖Δx‖ over it, H times it, K times its square. Boundary vertices are left "
        "out, but for the last column: the largest value that the same formula gives there, – on closed meshes.";
    table.columns = {{"mesh"},          {"estimate"},       {"vertices", "", 6}, {"smallest", "", 3},
                     {"median", "", 3}, {"largest", "", 3}, {"> 0", "%", 3},     {"boundary", "", 3}};
    for (const ExperimentField& field : done.fields) {
        const ValueSummary& s = field.summary;
        table.rows.push_back({done.meshes[field.mesh].name(), field_title(r.experiment, field), double(s.count), cell_of(s.minimum),
                              cell_of(s.median), cell_of(s.maximum), cell_of(100 * field.positive), cell_of(field.largest_boundary)});
    }
    r.section().blocks.emplace_back(std::move(table));
}

/// rms of the difference of two fields over the rms of the first, where both are defined; NaN where the first is 0.
double relative_gap(const Vector& a, const Vector& b) {
    double gap = 0, size = 0;
    for (Eigen::Index v = 0; v < a.size(); ++v) {
        if (!std::isfinite(a[v]) || !std::isfinite(b[v])) continue;
        gap += (a[v] - b[v]) * (a[v] - b[v]);
        size += a[v] * a[v];
    }
    return size > 0 ? std::sqrt(gap / size) : std::nan("");
}

report::Text fields_found(const Reproduction& r, const CurvatureExperiment& done, std::size_t m) {
    report::Text text = report::text(report::strong("Found on " + done.meshes[m].name() + ": "));
    const ExperimentField* first_h = nullptr;
    for (const ExperimentField& field : done.fields) {
        if (field.mesh != m) continue;
        const std::string title = sentence_case(field_title(r.experiment, field));
        if (field.summary.count == 0) {
            report::extend(text, title, " is defined at no vertex. ");
            continue;
        }
        const bool flat = field.largest_inside < 1e-9;
        if (flat) {
            report::extend(text, title, " is 0 inside");
            if (field.largest_inside > 0) report::extend(text, " (to ", readable(field.largest_inside, 1), ")");
        } else {
            report::extend(text, title, " is positive at ", readable_percent(field.positive, 2), " of the vertices, ",
                           readable(field.summary.median, 2), " in the median and ", readable(field.largest_inside, 2),
                           " at the most in size");
        }
        if (std::isfinite(field.largest_boundary))
            report::extend(text, "; along the boundary the formula gives up to ", readable(field.largest_boundary, 2));
        if (field.colour == ExperimentColour::h_cotan && first_h != nullptr && !flat) {
            const double gap = relative_gap(first_h->inside, field.inside);
            if (gap == 0) report::extend(text, ", the same as ", field_title(r.experiment, *first_h), " everywhere inside");
            if (gap > 0)
                report::extend(text, ", off ", field_title(r.experiment, *first_h), " by ", readable_percent(gap, 2), " (rms, inside)");
        }
        if (field.colour == ExperimentColour::h_cotan && first_h == nullptr) first_h = &field;
        report::extend(text, ". ");
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
    SixViewFigure figure;
    figure.id = r.id_of(mesh.name());
    figure.title = r.experiment.from + ": " + r.experiment.name;
    figure.subtitle = mesh.used->input.file;
    figure.panels.push_back(panel_of(*mesh.used, figure.id + "_original", "original", colours_of(mesh, colour, mesh.mesh().X)));
    for (const RebuiltMesh& rebuilt : done.rebuilt) {
        if (rebuilt.mesh != m) continue;
        figure.panels.push_back(panel_of(moved_to(mesh.mesh(), rebuilt.X), figure.id + "_" + std::to_string(figure.panels.size()),
                                         rebuilt_label(r.experiment, rebuilt), colours_of(mesh, colour, rebuilt.X)));
    }
    figure.range = range_of(r, colour, figure.panels);
    figure.caption =
        mesh.used->input.file + " and what its smoothest k eigenvectors make of it; camera and scale are those of the original.";
    add_figure(r.answer, std::move(figure));
}

void add_rebuilt_table(const Reproduction& r, const ReconstructionExperiment& done) {
    report::Table table;
    table.id = r.id_of("errors");
    table.caption = "Errors of the reconstructions. Weighted: in the operator's own masses, in which no further mode can make it worse.";
    table.columns = {{"mesh"},
                     {"operator"},
                     {"k", "", 6},
                     {"rms error", "% of box", 3},
                     {"weighted", "% of box", 3},
                     {"largest", "% of box", 3},
                     {"volume", "% of original", 3},
                     {"eigenpair residual", "", 2}};
    for (const RebuiltMesh& rebuilt : done.rebuilt) {
        const ExperimentMesh& mesh = done.meshes[rebuilt.mesh];
        const double percent = 100 / mesh.diagonal;
        const bool closed = mesh.used->prepared->preflight.closed();
        table.rows.push_back({mesh.name(), std::string(operator_entry(rebuilt.kind).title), double(rebuilt.k),
                              percent * rebuilt.difference.rms, percent * rebuilt.mass_rms, percent * rebuilt.difference.max,
                              cell_of(100 * rebuilt.difference.volume_ratio, closed), rebuilt.residual});
    }
    r.section().blocks.emplace_back(std::move(table));
}

report::Text rebuilt_found(const Reproduction& r, const ReconstructionExperiment& done, std::size_t m) {
    report::Text text = report::text(report::strong("Found on " + done.meshes[m].name() + ": "));
    std::vector<const RebuiltMesh*> of_mesh;
    for (const RebuiltMesh& rebuilt : done.rebuilt) {
        if (rebuilt.mesh == m) of_mesh.push_back(&rebuilt);
    }
    for (std::size_t i = 0; i < of_mesh.size(); ++i) {
        const RebuiltMesh& rebuilt = *of_mesh[i];
        report::extend(text, i == 0 ? "rms error " : "; ", readable(100 * rebuilt.difference.rms / done.meshes[m].diagonal),
                       " % of the box with ", rebuilt_label(r.experiment, rebuilt));
    }
    report::extend(text, ".");
    return text;
}

/// In the operator's own masses the error cannot grow with k.
void add_rebuilt_checks(const Reproduction& r, const ReconstructionExperiment& done) {
    for (std::size_t i = 0; i + 1 < done.rebuilt.size(); ++i) {
        const RebuiltMesh &fewer = done.rebuilt[i], &more = done.rebuilt[i + 1];
        if (fewer.mesh != more.mesh || fewer.kind != more.kind || fewer.area != more.area) continue;
        r.section().checks.push_back(
            check_at_most("error falls from k = " + std::to_string(fewer.k) + " to " + std::to_string(more.k) + ", " +
                              std::string(operator_entry(more.kind).title) + " on " + done.meshes[more.mesh].name() + " (" +
                              r.experiment.from + ", " + rows_text(r.experiment.rows) + ")",
                          fewer.mass_rms / done.meshes[more.mesh].diagonal, more.mass_rms / done.meshes[more.mesh].diagonal, 1e-9));
    }
}

}   // namespace

void add_curvature_reproduction(const Reproduction& r, const CurvatureExperiment& done) {
    add_opening(r, done.meshes);
    add_field_figures(r, done);
    add_field_table(r, done);
    for (std::size_t m = 0; m < done.meshes.size(); ++m) r.section().blocks.emplace_back(report::Paragraph{fields_found(r, done, m)});
}

void add_reconstruction_reproduction(const Reproduction& r, const ReconstructionExperiment& done) {
    add_opening(r, done.meshes);
    for (std::size_t m = 0; m < done.meshes.size(); ++m) add_rebuilt_figure(r, done, m);
    add_rebuilt_table(r, done);
    for (std::size_t m = 0; m < done.meshes.size(); ++m) r.section().blocks.emplace_back(report::Paragraph{rebuilt_found(r, done, m)});
    add_rebuilt_checks(r, done);
}

void add_forms_reproduction(const Reproduction& r) {
    add_opening(r, {});
    constexpr int steps = 360;
    const Ellipsoid& e = tall_ellipsoid;
    report::Plot plot;
    plot.id = r.id_of("normal_curvature");
    plot.x_label = "θ";
    plot.y_label = "normal curvature [1/length]";
    report::Series angle{"unit tangent at angle θ from +y", {}, {}, {}, {}, report::Series::Style::line};
    report::Series parameters{"(du, dv) = (cos θ, sin θ)", {}, {}, {}, {}, report::Series::Style::dashed};
    double largest = 0, smallest = INFINITY, at_largest = 0, at_smallest = 0;
    for (int i = 0; i <= steps; ++i) {
        const double theta = 2 * M_PI * i / steps, kappa = tip_curvature_by_angle(e, theta);
        angle.x.push_back(theta);
        angle.y.push_back(kappa);
        parameters.x.push_back(theta);
        parameters.y.push_back(tip_curvature_by_parameters(e, theta));
        if (i < steps / 2 && kappa > largest) largest = kappa, at_largest = theta;
        if (i < steps / 2 && kappa < smallest) smallest = kappa, at_smallest = theta;
    }
    plot.series = {std::move(angle), std::move(parameters)};
    for (int i = 0; i <= 4; ++i)
        plot.vertical_lines.push_back({i * M_PI / 2, i == 0 ? "0" : i == 1 ? "π/2" : i == 2 ? "π" : i == 3 ? "3π/2" : "2π"});
    plot.caption = "Normal curvature of the ellipsoid with " + axes_text(e) + " at (a, 0, 0).";
    plot.alt = plot.caption;
    r.section().blocks.emplace_back(std::move(plot));
    const double at_pole = (ellipsoid_point(e, 0, M_PI) - Vector3(e.a, 0, 0)).norm();
    add_paragraph(r.section(), report::strong("Found: "), "With ", math("b < c"), " the largest value, ", readable(largest),
                  ", is at θ = ", readable(at_largest), " and again half a turn on, the smallest, ", readable(smallest), ", at ",
                  readable(at_smallest), "; with ", math("b > c"),
                  " they change places. The point itself is (u, v) = (0, π/2); (0, π) lies ", readable(at_pole),
                  " away: it is the south pole, where the first form is singular.");
    r.section().checks.push_back(check_near("normal curvature along y at (a, 0, 0): a/b²", e.a / (e.b * e.b), largest, 1e-12));
    r.section().checks.push_back(check_near("normal curvature along z at (a, 0, 0): a/c²", e.a / (e.c * e.c), smallest, 1e-12));
}

}   // namespace meshfolio::reproductions
