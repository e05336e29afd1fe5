// Question 1: mean curvature from the uniform Laplacian, Gaussian curvature from the angle deficit.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/bench/uniform_curvature_study.h"
#include "questions/core/chapter.h"
#include "questions/core/section_tools.h"
#include "questions/core/six_view_figure.h"
#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {

namespace {

using report::Cell;
using report::check_at_most;
using report::check_near;
using report::math;

constexpr std::size_t barycentric = 0;   // in area_forms: the form used for figures and statistics

// ---- figures ----------------------------------------------------------------------------------------------------------

struct Curvature {
    std::string key, title, unit, caption;
    std::vector<output::Panel> panels;   // one a mesh
    double floor;                        // narrowest range
};

Curvature mean_curvature_length(const std::vector<MeshCurvature>& meshes) {
    Curvature q{"h", "Uniform mean curvature ½‖Δx‖", "% of mean edge", "Uniform ½‖Δx‖, signed, in % of the mean edge length", {}, 0.1};
    for (const MeshCurvature& c : meshes) {
        q.panels.push_back(
            panel_of(*c.subject.source, "q1_" + c.subject.name() + "_h", c.subject.name(), 100 / c.subject.mean_edge * c.length));
    }
    return q;
}

Curvature gaussian_curvature_by_size(const std::vector<MeshCurvature>& meshes) {
    Curvature q{"k", "Gaussian curvature from the angle deficit, × d²",
                "",  "Angle-deficit K (barycentric areas) times the squared box diagonal",
                {},  0.1};
    for (const MeshCurvature& c : meshes) {
        q.panels.push_back(
            panel_of(*c.subject.source, "q1_" + c.subject.name() + "_k", c.subject.name(), c.subject.diagonal * c.subject.diagonal * c.K));
    }
    return q;
}

void add_figures(Answer& answer, const std::vector<MeshCurvature>& meshes) {
    for (const Curvature& q : {mean_curvature_length(meshes), gaussian_curvature_by_size(meshes)}) {
        const output::ColorRange shared = output::robust_range(equally_weighted(q.panels), "diverging", q.title, q.unit, q.floor);
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            const CurvatureSubject& subject = meshes[i].subject;
            SixViewFigure figure;
            figure.id = q.panels[i].name;
            figure.title = q.title;
            figure.subtitle = subject.source->input.file + ", " + counted(subject.mesh().vertex_count(), "vertex", "vertices");
            figure.caption = q.caption + ", on " + subject.name() + ".";
            if (meshes.size() > 1) figure.caption += " All meshes share one colour range.";
            figure.caption += undefined_words(subject);
            figure.panels = {q.panels[i]};
            figure.range = range_for(shared, figure.panels);
            figure.turnable = q.key == "h";   // both quantities of a mesh have one shape
            add_figure(answer, std::move(figure));
            answer.figures.back().turnable = true;
        }
    }
}

// ---- tables -----------------------------------------------------------------------------------------------------------

void add_statistics(report::Section& section, const std::vector<MeshCurvature>& meshes) {
    report::Table table;
    table.id = "q1_statistics";
    table.caption =
        "The estimates over the vertices where they are defined. H scaled is ½‖Δx‖ times 4/h² (h²: mean squared edge of the one-ring).";
    table.columns = {{"mesh", ""},      {"quantity", ""}, {"unit", ""},       {"minimum", "", 4},
                     {"median", "", 4}, {"mean", "", 4},  {"maximum", "", 4}, {"standard deviation", "", 3},
                     {"defined", ""},   {"undefined", ""}};
    for (const MeshCurvature& c : meshes) {
        const auto row = [&](const char* quantity, const char* unit, const Vector& values) {
            const ValueSummary s = summary_of(values);
            table.rows.push_back({c.subject.name(), quantity, unit, cell_of(s.minimum), cell_of(s.median), cell_of(s.mean),
                                  cell_of(s.maximum), cell_of(s.standard_deviation), double(s.count), double(s.undefined)});
        };
        row("½‖Δx‖", "length", c.length);
        row("H scaled", "1/length", c.H);
        row("K", "1/length²", c.K);
    }
    section.blocks.push_back(std::move(table));
}

void add_error_table(report::Section& section, const std::vector<UniformRefinement>& refinements) {
    report::Table table;
    table.id = "q1_errors";
    table.caption =
        "Errors against the closed form on the finest meshes: L2 weighted by vertex area, L∞ over the largest true magnitude. H is ½‖Δx‖ "
        "times "
        "4/h²; its normal part is −½Δx·n times 4/h² with the surface's own normal. K is over barycentric areas. Jittered: the same "
        "triangles, "
        "vertices moved along the surface. The orders are fitted over the three finest levels.";
    table.columns = {{"surface", ""},   {"triangulation", ""}, {"vertices", ""},          {"smallest angle", "°", 3},
                     {"H, L2", "%", 3}, {"H, L∞", "%", 3},     {"H, order of L2", "", 2}, {"H normal part, L2", "%", 2},
                     {"K, L2", "%", 3}, {"K, L∞", "%", 3},     {"K, order of L2", "", 2}};
    for (const UniformRefinement& r : refinements) {
        const UniformErrors& e = r.finest();
        table.rows.push_back({r.surface.name, name_of(r.triangulation), double(e.vertices), e.smallest_angle * 180 / M_PI, 100 * e.H.l2,
                              100 * e.H.linf, uniform_H(r).order(), 100 * e.normal_part.l2, 100 * e.K[barycentric].l2,
                              100 * e.K[barycentric].linf, deficit_K(r).order()});
    }
    section.blocks.push_back(std::move(table));
}

void add_area_table(report::Section& section, const std::vector<UniformRefinement>& refinements, double FieldError::*norm,
                    const std::string& key, const std::string& norm_name) {
    report::Table table;
    table.id = "q1_area_forms_" + key;
    table.caption =
        norm_name +
        " error of K on the finest meshes, one row an area form. Vertices whose area is ≤ 0 have no K and are counted in the last column.";
    table.columns = {{"area form", ""}};
    for (const UniformRefinement& r : refinements) table.columns.push_back({r.title(), "%", 3, report::Column::Best::smallest});
    table.columns.push_back({"without K", "vertices", 3, report::Column::Best::smallest});
    for (std::size_t form = 0; form < area_forms.size(); ++form) {
        std::vector<Cell> row{area_name(area_forms[form])};
        int undefined = 0;
        for (const UniformRefinement& r : refinements) {
            row.push_back(100 * r.finest().K[form].*norm);
            undefined += r.finest().undefined[form];
        }
        row.push_back(double(undefined));
        table.rows.push_back(std::move(row));
    }
    section.blocks.push_back(std::move(table));
}

void add_convergence_plot(report::Section& section, const std::vector<UniformRefinement>& refinements, bool gaussian) {
    report::Plot plot;
    plot.id = gaussian ? "q1_k_convergence" : "q1_h_convergence";
    const std::string quantity = gaussian ? "K (barycentric areas)" : "uniform H (scaled)";
    plot.caption = "L2 error of " + quantity + " as the meshes are refined, regular and with jittered vertices.";
    plot.x_label = "mean edge [length]";
    plot.y_label = "relative L2 error [%]";
    plot.log_x = plot.log_y = true;
    plot.alt = "L2 error of " + quantity + " over mean edge.";
    for (const UniformRefinement& r : refinements) {
        const ErrorHistory history = gaussian ? deficit_K(r) : uniform_H(r);
        const bool regular = r.triangulation == Triangulation::regular;
        plot.series.push_back(
            error_series(r.title(), history, regular ? report::Series::Style::line_and_points : report::Series::Style::dashed));
        plot.alt += " " + r.title() + ": " + trend(history) + ".";
    }
    section.blocks.push_back(std::move(plot));
}

// ---- Gauss–Bonnet -----------------------------------------------------------------------------------------------------

void add_gauss_bonnet(report::Section& section, const std::vector<AngleSum>& sums) {
    report::Table table;
    table.id = "q1_gauss_bonnet";
    table.caption = "Gauss–Bonnet: the angle deficits (π − Σθ on the boundary) add up to 2πχ on every manifold mesh, however coarse.";
    table.columns = {{"mesh", ""}, {"vertices", ""}, {"χ", ""}, {"Σ deficit / 2π", "", 6}, {"difference", "", 2}, {"applies", ""}};
    for (const AngleSum& s : sums) {
        table.rows.push_back({s.mesh, double(s.vertices), double(s.euler), s.measured, s.measured - s.euler,
                              s.applies ? "yes" : "no: not manifold, or triangles without area"});
        if (s.applies)
            section.checks.push_back(check_near("Gauss–Bonnet: Σ deficit / 2π of " + s.mesh, s.euler, s.measured, s.tolerance()));
    }
    section.blocks.push_back(std::move(table));
}

// ---- flat meshes ------------------------------------------------------------------------------------------------------

void check_flat_mesh(report::Section& section, const FlatMesh& f) {
    if (f.curvature->subject.interior == 0) return;
    const std::string on = " inside " + f.curvature->subject.name();
    section.checks.push_back(
        check_at_most("uniform Δx · n in mean edges" + on, 0, f.normal_part, 1e-6, "the mesh is flat to 1e-6 of its box"));
    section.checks.push_back(check_at_most("angle deficit" + on, 0, f.deficit, 1e-5, "the mesh is flat to 1e-6 of its box"));
}

// ---- method, checks, findings -----------------------------------------------------------------------------------------

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(section, "Mean curvature by the uniform Laplacian: the mean of the one-ring minus the vertex.");
    add_formula(section, "uniform_laplacian", "q1_eq_uniform");
    add_formula(section, "mean_curvature_from_laplacian", "q1_eq_mean");
    add_paragraph(section, "The sign is that of ", math("−Δx·n"),
                  ", so that H > 0 on a sphere with outward normals. The uniform Laplacian has no unit, hence ", math("½‖Δx‖"),
                  " is a length; where it is compared with a curvature it is scaled by the edges of its ring:");
    add_formula(section, "uniform_scaling", "q1_eq_scaling");
    add_paragraph(section, "Gaussian curvature by the angle deficit over the barycentric area, a third of the triangles around:");
    add_formula(section, "angle_deficit", "q1_eq_deficit");
    add_formula(section, "barycentric_area");
    add_paragraph(section, "Compared with it are the Voronoi area,");
    add_formula(section, "voronoi_area");
    add_paragraph(section, "and the mixed one, which is the Voronoi area but in obtuse triangles:");
    add_formula(section, "mixed_area");
    add_paragraph(section,
                  "On the boundary neither is a curvature, so it is masked. Over the whole mesh the deficits obey Gauss–Bonnet, and on "
                  "surfaces with closed form the "
                  "estimates are held against it:");
    add_formula(section, "gauss_bonnet", "q1_eq_gauss_bonnet");
    add_formula(section, "relative_l2_error");
}

void add_refinement_checks(report::Section& section, const std::vector<UniformRefinement>& refinements) {
    const UniformRefinement& torus = refinement_on(refinements, "torus", Triangulation::regular);
    section.checks.push_back(check_near("order of K (barycentric areas, L2) on the regular torus", 2, deficit_K(torus).order(), 0.2));
    for (const Triangulation triangulation : {Triangulation::regular, Triangulation::jittered}) {
        const UniformRefinement& sphere = refinement_on(refinements, "sphere", triangulation);
        section.checks.push_back(
            check_at_most("normal part of scaled uniform H is 1/R at any points of a sphere, " + name_of(triangulation), 0,
                          sphere.finest().normal_part.linf, 1e-9, "mean of 1 − x·x_j over the ring is half its mean squared edge"));
    }
}

void add_findings(report::Section& section, const std::vector<UniformRefinement>& refinements, const std::vector<AngleSum>& sums) {
    const UniformRefinement& regular = refinement_on(refinements, "torus", Triangulation::regular);
    const UniformRefinement& jittered = refinement_on(refinements, "torus", Triangulation::jittered);
    section.findings.push_back(
        {report::text("Q1: on the torus, uniform H is off by ", readable_percent(uniform_H(regular).last()), " (L2) and K by ",
                      readable_percent(deficit_K(regular).last()), "; with jittered vertices by ",
                      readable_percent(uniform_H(jittered).last()), " and ", readable_percent(deficit_K(jittered).last()), "."),
         70});
    double gap = 0;
    for (const AngleSum& s : sums) gap = std::max(gap, s.applies ? std::abs(s.measured - s.euler) : 0);
    section.findings.push_back(
        {report::text("Q1: the angle deficits add up to 2πχ to ", readable(gap, 2), " of a turn on every manifold mesh."), 30});
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("q1");
    const auto sources = meshes_for(library, settings, {"plane", "lilium", "bumpy_cube", "sphere"}, section);
    add_method(section);

    add_heading(section, "Results");
    std::vector<MeshCurvature> meshes;
    std::vector<std::string> names;
    for (const auto& source : sources) {
        progress("uniform curvature of " + source->name);
        meshes.push_back(curvature_of(source));
        names.push_back(source->name);
    }
    add_figures(answer, meshes);
    add_statistics(section, meshes);
    const std::vector<UniformRefinement> refinements = refine_known_surfaces(settings, progress, "uniform curvature", uniform_errors);
    add_error_table(section, refinements);
    add_area_table(section, refinements, &FieldError::l2, "l2", "L2");
    add_area_table(section, refinements, &FieldError::linf, "linf", "L∞");
    add_convergence_plot(section, refinements, false);
    add_convergence_plot(section, refinements, true);
    const std::vector<AngleSum> sums = angle_sums(meshes, refinements);
    add_gauss_bonnet(section, sums);
    std::vector<FlatMesh> flat;
    for (const MeshCurvature& c : meshes) {
        if (c.subject.plane_normal) flat.push_back(flat_mesh(c));
    }
    for (const FlatMesh& f : flat) check_flat_mesh(section, f);
    add_refinement_checks(section, refinements);
    add_discussion(section, meshes, refinements, sums, flat, *shared_ground_truth(settings, progress));
    add_findings(section, refinements, sums);

    section.parameters = {
        {"area form", "barycentric"},
        {"colour range", "one a quantity, 2nd to 98th percentile over all meshes (each weighing the same), symmetric about 0"},
        {"levels of refinement", std::to_string(refinements.front().levels.size())},
        {"seed of the jitter", std::to_string(settings.seed)}};
    section.extent = "H and K on " + listed(names) + " in six views; errors on 3 surfaces with closed form, regular and jittered, " +
                     counted(static_cast<int>(refinements.front().levels.size()), "level") + " each; Gauss–Bonnet on " +
                     counted(static_cast<int>(sums.size()), "mesh", "meshes");
    return answer;
}

extern const Chapter chapter{
    .id = "q1",
    .code = {{"uniform_laplacian", "src/geometry/operators/uniform_laplacian.cpp"},
             {"uniform_mean_curvature", "src/geometry/curvature/curvature.cpp"},
             {"angle_deficit", "src/geometry/curvature/curvature.cpp"},
             {"gaussian_curvature", "src/geometry/curvature/curvature.cpp"},
             {"vertex_areas", "src/geometry/operators/vertex_areas.cpp"},
             {"known_surfaces", "src/questions/bench/known_surfaces.cpp"},
             {"answer", "src/questions/q1_uniform/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q1_uniform
