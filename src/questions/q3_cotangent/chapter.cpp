// Question 3: mean curvature from the cotangent Laplace–Beltrami operator, beside that of the uniform Laplacian.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/chapter.h"
#include "questions/core/section_tools.h"
#include "questions/core/six_view_figure.h"
#include "questions/q3_cotangent/error_indicator.h"
#include "questions/q3_cotangent/parts.h"

namespace meshfolio::q3_cotangent {

namespace {

using report::Cell;
using report::check_at_most;
using report::check_near;
using report::math;

// ---- figures and tables of the meshes ---------------------------------------------------------------------------------

void add_comparison_figure(Answer& answer, const CotangentComparison& c) {
    const CurvatureSubject& s = c.subject;
    const std::string id = "q3_" + s.name() + "_h";
    SixViewFigure figure;
    figure.id = id;
    figure.title = "Mean curvature × mean edge: uniform, cotangent, difference";
    figure.subtitle = s.source->input.file + ", " + counted(s.mesh().vertex_count(), "vertex", "vertices");
    figure.panels = {panel_of(*s.source, id + "_uniform", "uniform, × 4/h²", s.mean_edge * c.uniform),
                     panel_of(*s.source, id + "_cotangent", "cotangent", s.mean_edge * c.cotangent),
                     panel_of(*s.source, id + "_difference", "cotangent − uniform", s.mean_edge * c.difference)};
    // The two estimates set the range; the difference is drawn in it, so that its colours weigh the same.
    figure.range = output::robust_range({figure.panels[0], figure.panels[1]}, "diverging", "H × mean edge", "", 0.01, 0.03);
    figure.range = range_for(*figure.range, figure.panels);
    figure.caption = "Mean curvature of " + s.name() + " times its mean edge length (" + readable(s.mean_edge) +
                     "): by the uniform Laplacian of question 1 (scaled by 4/h²), by the cotangent operator, and cotangent minus uniform. "
                     "All rows share camera "
                     "and colour range.";
    figure.caption += undefined_words(s);
    figure.turnable = true;
    add_figure(answer, std::move(figure));
    answer.figures.back().turnable = true;
}

/// Curvature is a magnitude here: the sign of a flat surface's H is that of rounding.
void add_plane_figure(Answer& answer, const PlaneTest& plane, const std::string& colormap) {
    SixViewFigure figure;
    figure.id = "q3_h_irregular_plane";
    figure.title = "False curvature |H| × mean edge of an irregular flat square";
    figure.subtitle = counted(plane.mesh.vertex_count(), "vertex", "vertices") + ", inner ones moved within the plane";
    figure.panels = {panel_of(plane.mesh, "q3_uniform_irregular_plane", "uniform, × 4/h²", plane.uniform_H.cwiseAbs()),
                     panel_of(plane.mesh, "q3_cotangent_irregular_plane", "cotangent", plane.cotangent_H.cwiseAbs()),
                     panel_of(plane.mesh, "q3_clamped_irregular_plane", "cotangent, clamped", plane.clamped_H.cwiseAbs())};
    figure.range = output::robust_range(figure.panels, colormap, "|H| × mean edge", "", 0.01);
    figure.range->low = 0;
    figure.range = range_for(*figure.range, figure.panels);
    figure.edges = true;
    figure.caption =
        "What the operators read on a flat square whose inner vertices were moved within it; every value but 0 is an error. Largest: "
        "uniform " +
        readable(plane.uniform) + ", cotangent " + readable(plane.cotangent, 2) + ", cotangent with negative weights clamped " +
        readable(plane.clamped) + ".";
    add_figure(answer, std::move(figure));
}

void add_difference_table(report::Section& section, const std::vector<CotangentComparison>& meshes) {
    report::Table table;
    table.id = "q3_differences";
    table.caption =
        "Both estimates of H and their difference over the inner vertices; a jump is the rms difference of H between neighbours; the last "
        "column counts vertices where they disagree about the "
        "sign.";
    table.columns = {{"mesh", ""},
                     {"uniform, median", "1/length", 4},
                     {"uniform, std", "1/length", 3},
                     {"cotangent, median", "1/length", 4},
                     {"cotangent, std", "1/length", 3},
                     {"uniform, jump", "1/length", 3},
                     {"cotangent, jump", "1/length", 3},
                     {"difference, rms", "1/length", 3},
                     {"difference, largest", "1/length", 3},
                     {"difference, rms", "% of uniform rms", 3},
                     {"other sign", "% of vertices", 3}};
    for (const CotangentComparison& c : meshes) {
        const ValueSummary uniform = summary_of(c.uniform), cotangent = summary_of(c.cotangent);
        const bool curved = c.drift > 1e-9 || c.precision > 1e-9;
        table.rows.push_back({c.subject.name(), cell_of(uniform.median), cell_of(uniform.standard_deviation), cell_of(cotangent.median),
                              cell_of(cotangent.standard_deviation), c.jump_uniform, c.jump_cotangent, c.rms_difference,
                              largest_magnitude(c.difference),
                              curved && c.rms_uniform > 0 ? Cell(100 * c.rms_difference / c.rms_uniform) : Cell(), 100 * c.sign_change});
    }
    section.blocks.push_back(std::move(table));
}

void add_variant_table(report::Section& section, const std::vector<CotangentComparison>& meshes) {
    report::Table table;
    table.id = "q3_variants";
    table.caption =
        "The operator and two variants, barycentric areas: edges with negative weight, the smallest weight, largest ½‖Lx‖ inside (mean "
        "curvature) and "
        "on the boundary (there the pull along the surface, no curvature), both times the mean edge, and how much H changes inside.";
    table.columns = {{"mesh", ""},
                     {"operator", ""},
                     {"negative weights, inside", "edges"},
                     {"negative weights, boundary", "edges"},
                     {"smallest weight", "", 3},
                     {"largest inside", "", 3},
                     {"change inside, rms", "%", 3},
                     {"largest on boundary", "", 3}};
    for (const CotangentComparison& c : meshes) {
        for (const OperatorVariant& v : c.variants) {
            table.rows.push_back({c.subject.name(), v.name, double(v.negative_inside), double(v.negative_boundary), v.smallest_weight,
                                  v.inside, cell_of(100 * v.change), v.boundary});
        }
    }
    section.blocks.push_back(std::move(table));
}

// ---- errors against the closed form -----------------------------------------------------------------------------------

void add_error_table(report::Section& section, const std::vector<CotangentRefinement>& refinements, double FieldError::*norm,
                     const std::string& key, const std::string& norm_name) {
    report::Table table;
    table.id = "q3_errors_" + key;
    table.caption = norm_name +
                    " error of H on the finest meshes, one row an estimator. Clamped: barycentric areas, negative weights set to 0. "
                    "Vertices of area ≤ 0 have no H.";
    table.columns = {{"estimator", ""}};
    for (const CotangentRefinement& r : refinements) table.columns.push_back({r.title(), "%", 3, report::Column::Best::smallest});
    table.columns.push_back({"without H", "vertices"});
    const auto add_row = [&](std::string name, auto error_of, auto undefined_of) {
        std::vector<Cell> row{std::move(name)};
        int undefined = 0;
        for (const CotangentRefinement& r : refinements) {
            row.push_back(100 * error_of(r.finest()).*norm);
            undefined += undefined_of(r.finest());
        }
        row.push_back(double(undefined));
        table.rows.push_back(std::move(row));
    };
    const auto none = [](const CotangentErrors&) { return 0; };
    add_row(
        "uniform, × 4/h²", [](const CotangentErrors& e) { return e.uniform; }, none);
    for (std::size_t form = 0; form < area_forms.size(); ++form) {
        add_row(
            "cotangent, " + area_name(area_forms[form]), [form](const CotangentErrors& e) { return e.H[form]; },
            [form](const CotangentErrors& e) { return e.undefined[form]; });
    }
    add_row(
        "cotangent, clamped", [](const CotangentErrors& e) { return e.clamped; }, none);
    section.blocks.push_back(std::move(table));
}

void add_order_table(report::Section& section, const std::vector<CotangentRefinement>& refinements) {
    report::Table table;
    table.id = "q3_orders";
    table.caption = "Order p of error ≈ c·hᵖ in L2, and L∞ for barycentric areas, fitted over the three finest of " +
                    counted(static_cast<int>(refinements.front().levels.size()), "mesh", "meshes") +
                    ". The coarsest and finest size, the smallest angle and the negative weights of the finest.";
    table.columns = {{"surface", ""},
                     {"triangulation", ""},
                     {"from", "vertices"},
                     {"to", "vertices"},
                     {"smallest angle", "°", 3},
                     {"negative weights", "% of edges", 3},
                     {"uniform", "", 3},
                     {"barycentric", "", 3},
                     {"barycentric, L∞", "", 3},
                     {"Voronoi", "", 3},
                     {"mixed", "", 3}};
    for (const CotangentRefinement& r : refinements) {
        table.rows.push_back({r.surface.name, name_of(r.triangulation), double(r.levels.front().vertices), double(r.finest().vertices),
                              r.finest().smallest_angle * 180 / M_PI, 100 * r.finest().negative_weights,
                              cell_of(scaled_uniform_H(r).order()), cell_of(cotangent_H(r, barycentric).order()),
                              cell_of(cotangent_H(r, barycentric, &FieldError::linf).order()), cell_of(cotangent_H(r, voronoi).order()),
                              cell_of(cotangent_H(r, mixed).order())});
    }
    section.blocks.push_back(std::move(table));
}

void add_convergence_plot(report::Section& section, const std::vector<CotangentRefinement>& refinements, Triangulation triangulation) {
    report::Plot plot;
    plot.id = "q3_convergence_" + name_of(triangulation);
    plot.caption = "L2 error of H over the mean edge on " + name_of(triangulation) +
                   " meshes: a colour for each surface; dashes and points for each estimator, the scaled uniform one without points.";
    plot.x_label = "mean edge [length]";
    plot.y_label = "relative L2 error [%]";
    plot.log_x = plot.log_y = true;
    plot.alt = "L2 error of H over mean edge, " + name_of(triangulation) + " meshes.";
    int surface = 0;
    for (const CotangentRefinement& r : refinements) {
        if (r.triangulation != triangulation) continue;
        const auto add = [&](const std::string& estimator, const ErrorHistory& history, report::Series::Style style, std::size_t pattern) {
            plot.series.push_back(error_series(r.surface.name + ", " + estimator, history, style));
            plot.series.back().color = surface;
            plot.series.back().pattern = static_cast<int>(pattern);
            plot.alt += " " + plot.series.back().name + ": " + trend(history) + ".";
        };
        for (std::size_t form = 0; form < area_forms.size(); ++form)
            add(area_name(area_forms[form]), cotangent_H(r, form), report::Series::Style::line_and_points, form);
        add("uniform", scaled_uniform_H(r), report::Series::Style::dashed, area_forms.size());
        ++surface;
    }
    section.blocks.push_back(std::move(plot));
}

void add_checks(report::Section& section, const std::vector<CotangentRefinement>& refinements, const PlaneTest& plane,
                const std::vector<CotangentComparison>& meshes) {
    const CotangentRefinement& torus = refinement_on(refinements, "torus", Triangulation::regular);
    for (const std::size_t form : {barycentric, voronoi, mixed}) {
        section.checks.push_back(check_near("order of cotangent H (" + area_name(area_forms[form]) + ", L2) on the regular torus", 2,
                                            cotangent_H(torus, form).order(), 0.2));
    }
    const CotangentErrors& sphere = refinement_on(refinements, "sphere", Triangulation::regular).finest();
    section.checks.push_back(check_near("barycentric H on the icosphere, L∞, stalls at 3 cot 54°/(2 sin 72°) − 1", pentagon_excess(),
                                        sphere.H[barycentric].linf, 0.25 * sphere.mean_edge * sphere.mean_edge, "the tolerance is h²/4"));
    section.checks.push_back(
        check_at_most("cotangent H × mean edge inside an irregular flat square (linear precision)", 0, plane.cotangent, 1e-10));
    for (const CotangentComparison& c : meshes) {
        if (!c.subject.plane_normal || c.subject.interior == 0) continue;
        section.checks.push_back(check_at_most("cotangent H × mean edge inside the flat " + c.subject.name(), 0, c.precision, 1e-5,
                                               "the mesh is flat to 1e-6 of its box"));
    }
}

// ---- method and findings ----------------------------------------------------------------------------------------------

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(
        section,
        "The Laplace–Beltrami operator with cotangent weights, a half for every corner opposite the edge, over lumped vertex areas:");
    add_formula(section, "cotangent_weights", "q3_eq_weights");
    add_formula(section, "cotangent_laplacian", "q3_eq_laplacian");
    add_formula(section, "mean_curvature_from_laplacian");
    add_paragraph(
        section,
        "Areas are barycentric unless said otherwise; Voronoi and mixed ones are compared. Boundary vertices are masked, for there ",
        math("Lx"), " is the pull along the surface. Question 1's estimate is scaled to a curvature first:");
    add_formula(section, "uniform_scaling");
    add_paragraph(section, "On surfaces with closed form, refined step by step, the order of convergence is the slope of the error:");
    add_formula(section, "convergence_order", "q3_eq_order");
}

void add_findings(report::Section& section, const std::vector<CotangentComparison>& meshes,
                  const std::vector<CotangentRefinement>& refinements, const PlaneTest& plane) {
    const CotangentErrors& regular = refinement_on(refinements, "torus", Triangulation::regular).finest();
    const CotangentRefinement& jittered = refinement_on(refinements, "torus", Triangulation::jittered);
    section.findings.push_back(
        {report::text("Q3: on the regular torus cotangent H (mixed areas) is off by ", readable_percent(regular.H[mixed].l2),
                      ", uniform H by ", readable_percent(regular.uniform.l2), " (L2)."),
         80});
    section.findings.push_back(
        {report::text("Q3: with jittered vertices the error of cotangent H on the torus ", trend(cotangent_H(jittered, mixed)), "."), 72});
    section.findings.push_back(
        {report::text("Q3: inside an irregular flat square |H| × mean edge is ", readable(plane.cotangent, 2), " (cotangent), ",
                      readable(plane.uniform, 2), " (uniform) and ", readable(plane.clamped, 2), " (cotangent, clamped)."),
         45});
    const auto curved = std::find_if(meshes.begin(), meshes.end(), [](const CotangentComparison& c) {
        return !c.subject.plane_normal && c.jump_uniform > 0 && c.jump_cotangent > 0;
    });
    if (curved == meshes.end()) return;
    section.findings.push_back(
        {report::text("Q3: on ", curved->subject.name(), " H changes from a vertex to its neighbour by ", readable(curved->jump_cotangent),
                      " (rms) with cotangent and by ", readable(curved->jump_uniform), " with uniform weights."),
         55});
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("q3");
    const auto sources = meshes_for(library, settings, {"lilium", "plane"}, section);
    add_method(section);

    add_heading(section, "Results");
    std::vector<CotangentComparison> meshes;
    std::vector<std::string> names;
    for (const auto& source : sources) {
        progress("cotangent curvature of " + source->name);
        meshes.push_back(compare_operators(source));
        names.push_back(source->name);
        add_comparison_figure(answer, meshes.back());
    }
    add_difference_table(section, meshes);
    add_variant_table(section, meshes);
    const auto refinements = refine_known_surfaces(settings, progress, "cotangent curvature", cotangent_errors);
    const PlaneTest plane = irregular_plane(settings.seed);
    add_plane_figure(answer, plane, settings.colormap);
    add_error_table(section, refinements, &FieldError::l2, "l2", "L2");
    add_error_table(section, refinements, &FieldError::linf, "linf", "L∞");
    add_order_table(section, refinements);
    add_convergence_plot(section, refinements, Triangulation::regular);
    add_convergence_plot(section, refinements, Triangulation::jittered);
    add_error_indicator(answer, meshes, settings);
    add_checks(section, refinements, plane, meshes);
    add_discussion(section, meshes, refinements, plane, *shared_ground_truth(settings, progress));
    add_findings(section, meshes, refinements, plane);

    const int levels = static_cast<int>(refinements.front().levels.size());
    int most_vertices = 0;
    for (const CotangentRefinement& r : refinements) most_vertices = std::max(most_vertices, r.finest().vertices);
    section.parameters = {{"area form", "barycentric; Voronoi and mixed compared"},
                          {"negative weights", "kept; clamping compared"},
                          {"levels of refinement", std::to_string(levels)},
                          {"seed of the jitter", std::to_string(settings.seed)}};
    section.extent = "cotangent H beside uniform H on " + listed(names) +
                     " in six views; errors and orders of 3 area forms on 3 surfaces, regular and jittered, " + counted(levels, "level") +
                     " each, up to " + std::to_string(most_vertices) + " vertices";
    return answer;
}

extern const Chapter chapter{
    .id = "q3",
    .title = "Cotangent Laplace–Beltrami curvature",
    .asked = "Does the cotangent discretisation improve the estimated mean curvature?",
    .code = {{"laplace_beltrami", "src/geometry/operators/cotangent_laplacian.cpp", "C and M from a mesh"},
             {"corner_cotangents", "src/geometry/operators/cotangent_laplacian.cpp", "cotangents from positions or edge lengths"},
             {"vertex_areas", "src/geometry/operators/vertex_areas.cpp", "barycentric, Voronoi and mixed areas"},
             {"cotangent_mean_curvature", "src/geometry/curvature/curvature.cpp", "H = ±½‖Lx‖"},
             {"uniform_mean_curvature_scaled", "src/geometry/curvature/curvature.cpp", "question 1's estimate times 4/h²"},
             {"compare_operators", "src/questions/bench/cotangent_study.cpp", "both estimates and the variants on a mesh"},
             {"jet_curvature", "src/geometry/curvature/jet_fit.cpp", "H of a degree-3 jet, the second opinion"},
             {"answer", "src/questions/q3_cotangent/chapter.cpp", "this section"}},
    .answer = answer,
};

}   // namespace meshfolio::q3_cotangent
