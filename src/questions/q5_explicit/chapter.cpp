// Question 5: explicit Laplacian smoothing, the step it allows, and what a larger one does.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/bench/smoothing_study.h"
#include "questions/core/comparison_figure.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/core/value_lists.h"
#include "questions/q5_explicit/parts.h"

namespace meshfolio::q5_explicit {

namespace {

using report::check_at_least;
using report::check_at_most;
using report::check_near;
using report::math;

// ---- results ----------------------------------------------------------------------------------------------------------

void add_sweep_figure(Answer& answer, const ExplicitStudy& study) {
    SixViewFigure figure;
    figure.id = id_of("q5", study.name(), "sweep");
    figure.title = "Explicit smoothing of " + study.name();
    figure.subtitle = "λ_crit = " + readable(study.subject.critical, 4) + ", " + counted(study.runs.front().iterations, "iteration");
    for (const SmoothingRun& run : study.runs) {
        std::string label = "λ = " + step_label(study.subject, run.lambda);
        const bool whole = run.in_view_iteration == run.result.iterations;
        if (!whole) label += ", iteration " + std::to_string(run.in_view_iteration) + ", the last in view";
        const Positions& shown = whole ? run.result.X : run.in_view;
        figure.panels.push_back(smoothing_panel(study.subject, shown, id_of("q5", study.name(), step_name(run.lambda)), label));
    }
    figure.caption =
        "Before and after explicit smoothing of " + study.name() +
        ", one row a step size, coloured by cotangent mean "
        "curvature times the mean edge length of the input. Camera, scale and colour range are those of the input in every row.";
    add_smoothing_figure(answer, study.subject, id_of("q5", study.name(), "before"), std::move(figure));
}

/// What the recommended step does to the mesh.
void add_before_after(Answer& answer, const ExplicitStudy& study, const std::string& colormap) {
    if (study.best < 0) return;
    const SmoothingRun& run = study.runs[static_cast<std::size_t>(study.best)];
    const std::string times = counted(run.result.iterations, "iteration");
    ComparisonFigure figure;
    figure.id = id_of("q5", study.name(), "before_after");
    figure.title = study.name() + " before and after " + times;
    figure.subtitle = "explicit, λ = " + step_label(study.subject, run.lambda);
    figure.caption = study.name() + " before and after " + times +
                     " with the recommended step, λ = " + step_label(study.subject, run.lambda) + ": the Dirichlet energy falls " +
                     energy_fall(run.energy.back()) + ", and the normals turn by " + readable(run.moved.mean_normal_angle * 180 / M_PI) +
                     "° on average" +
                     (std::isnan(run.volume_ratio) ? "." : "; " + readable(100 * run.volume_ratio) + "\u202f% of the volume is left.");
    figure.before = panel_of(*study.subject.source, figure.id + "_input", "before");
    figure.after = panel_of(moved_to(study.subject.mesh(), run.result.X), figure.id + "_smoothed", "after " + times);
    figure.diagonal = study.subject.diagonal;
    figure.colormap = colormap;
    add_comparison(answer, std::move(figure));
}

/// The top mode starts a thousandth of an edge high: factors below 10⁻⁸ are rounding and count as 0.
double above_rounding(double factor) { return factor < 1e-8 ? 0 : factor; }

void add_sweep_table(report::Section& section, const ExplicitStudy& study) {
    report::Table table;
    table.id = id_of("q5", study.name(), "sweep_table");
    table.caption = "Explicit smoothing of " + study.name() +
                    " with fixed operator. The top mode is predicted to grow by |1 − λμ_max| a step; "
                    "measured over 20 steps. Energy: Dirichlet energy over that of the input." +
                    (study.subject.source->prepared->preflight.closed() ? "" : " No volume (–): the mesh is open.");
    table.columns = {{"λ", "length²", 3},
                     {"λ/λ_crit", "", 3},
                     {"λ/h̄²", "", 3},
                     {"iterations", "", 4},
                     {"top mode ×, predicted", "", 4},
                     {"top mode ×, measured", "", 4},
                     {"energy", "of input", 3},
                     {"rms moved", "% of box", 3},
                     {"volume", "% of input", 4},
                     {"smallest angle", "°", 3},
                     {"inverted faces", "", 6},
                     {"outcome", "", 3}};
    for (std::size_t i = 0; i < study.runs.size(); ++i) {
        const SmoothingRun& run = study.runs[i];
        const double h2 = study.subject.mean_edge * study.subject.mean_edge;
        const std::string outcome = run.result.blew_up     ? "blew up in iteration " + std::to_string(run.result.blow_up_iteration)
                                    : !study.stable(i)     ? "growing"
                                    : int(i) == study.best ? "recommended"
                                                           : "stable";
        table.rows.push_back({run.lambda, run.lambda / study.subject.critical, run.lambda / h2, double(run.result.iterations),
                              above_rounding(study.amplification[i].predicted), above_rounding(study.amplification[i].measured),
                              run.energy.back(), 100 * run.moved.rms / study.subject.diagonal, cell_of(100 * run.volume_ratio),
                              run.smallest_angle * 180 / M_PI, double(run.moved.inverted_faces), outcome});
    }
    section.blocks.push_back(std::move(table));
}

void add_energy_plot(report::Section& section, const ExplicitStudy& study) {
    report::Plot plot;
    plot.id = id_of("q5", study.name(), "energy");
    plot.x_label = "iteration";
    plot.y_label = "Dirichlet energy / that of the input";
    plot.log_y = true;
    std::vector<std::string> cut;
    for (const SmoothingRun& run : study.runs) {
        report::Series series{plain_text(run.lambda / study.subject.critical, 3) + " λ_crit", {}, {}, {}, {}, report::Series::Style::line};
        // Beyond twenty the curve has made its point and would flatten all others.
        for (std::size_t t = 0; t < run.energy.size() && run.energy[t] < 20; ++t) {
            series.x.push_back(double(t));
            series.y.push_back(run.energy[t]);
        }
        if (series.y.size() < run.energy.size()) cut.push_back(plain_text(run.lambda / study.subject.critical, 3));
        plot.series.push_back(std::move(series));
    }
    std::vector<std::string> falling, rising;
    for (const SmoothingRun& run : study.runs) {
        (run.energy.back() < 1 ? falling : rising).push_back(plain_text(run.lambda / study.subject.critical, 3));
    }
    plot.caption = "Dirichlet energy of " + study.name() + " over the iterations";
    if (!falling.empty()) plot.caption += "; it ends below that of the input at " + listed(falling) + " λ_crit";
    if (!rising.empty())
        plot.caption += (falling.empty() ? "; it ends above that of the input at " : ", above it at ") + listed(rising) + " λ_crit";
    plot.caption += ".";
    if (!cut.empty()) plot.caption += " The curve at " + listed(cut) + " λ_crit ends with its last value below 20.";
    plot.alt = plot.caption;
    section.blocks.push_back(std::move(plot));
}

void add_limit_table(report::Section& section, const std::vector<ExplicitStudy>& studies) {
    report::Table table;
    table.id = "q5_limits";
    table.caption =
        "The largest stable step of each mesh: λ_crit = 2/μ_max by Lanczos, the safe step of the Gershgorin bound, rounded down (0 where "
        "−C "
        "is not proved semidefinite), "
        "and λ_crit of the uniform operator, whose λ has no unit. The vertex is the one where the top mode is largest.";
    table.columns = {{"mesh", "", 3},
                     {"μ_max", "1/length²", 4},
                     {"λ_crit", "length²", 4},
                     {.name = "safe λ (Gershgorin)", .unit = "length²", .digits = 4, .rounding = report::Column::Rounding::down},
                     {"λ_crit/h̄²", "", 3},
                     {"vertex", "", 8},
                     {"vertices sharing the mode", "", 2},
                     {"uniform μ_max", "", 4},
                     {"uniform λ_crit", "", 4}};
    for (const ExplicitStudy& study : studies) {
        const LargestEigenvalue& top = study.subject.top;
        table.rows.push_back({study.name(), top.value, study.subject.critical, study.subject.safe(),
                              study.subject.critical / (study.subject.mean_edge * study.subject.mean_edge), double(top.vertex), top.support,
                              study.uniform.top, study.uniform.critical});
    }
    section.blocks.push_back(std::move(table));
}

/// What triangles without area would do to the limit, on the meshes that have some.
void add_faces_without_area(report::Section& section, const std::vector<ExplicitStudy>& studies) {
    for (const ExplicitStudy& study : studies) {
        if (!(study.subject.critical_floored > 0)) continue;
        const int faces = study.subject.source->prepared->preflight.zero_area_faces;
        add_paragraph(section, counted(faces, "triangle"), " of ", study.name(), faces == 1 ? " has" : " have",
                      " no area and so no stiffness: ", math("λ_crit"), " = ", readable(study.subject.critical, 4),
                      ". With their cotangents cut off at 10¹² it would be ", readable(study.subject.critical_floored, 4),
                      ". Flip their longest edges, or take the intrinsic Delaunay operator.");
    }
}

// ---- checks -----------------------------------------------------------------------------------------------------------

void add_checks(report::Section& section, const ExplicitStudy& study) {
    const SmoothingSubject& subject = study.subject;
    const std::string on = " on " + subject.name();
    section.checks.push_back(
        check_at_least("Gershgorin bound ≥ μ_max" + on, subject.top.value, subject.top.upper_bound, 1e-9 * subject.top.value));
    const report::Check semidefinite = check_at_least("−C has no eigenvalue below 0 but for rounding, μ_min / μ_max" + on, 0,
                                                      subject.bottom.mu_low / subject.top.value, 1e-10);
    section.checks.push_back(
        subject.bottom.semidefinite() || subject.bottom.indefinite()
            ? semidefinite
            : report::undecided(semidefinite, "a negative part as small as rounding can neither be shown nor excluded"));
    for (std::size_t i = 0; i < study.runs.size(); ++i) {
        const SmoothingRun& run = study.runs[i];
        const std::string at = " at " + plain_text(run.lambda / subject.critical, 3) + " λ_crit" + on;
        if (run.lambda > 0.9 * subject.critical) {
            const Amplification& a = study.amplification[i];
            section.checks.push_back(check_near("top mode after 20 steps, measured / |1 − λμ|²⁰" + at, 1, a.measured / a.predicted, 1e-4));
        }
        if (study.stable(i)) {
            section.checks.push_back(energy_check("energy never rises" + at, run));
            section.checks.push_back(
                check_at_most("M-barycentre stays, drift / box diagonal" + at, 0, barycentre_drift(subject, run.result.X), 1e-10));
        }
    }
}

// ---- the section -----------------------------------------------------------------------------------------------------

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(
        section,
        "Diffusion flow, one forward Euler step after the other, with the cotangent operator of the input (barycentric areas, free "
        "boundary):");
    add_formula(section, "explicit_step", "q5_eq_step");
    add_paragraph(section, "Each eigenmode is multiplied by ", math("1 − λμ"), " a step. The step is stable as long as no mode grows:");
    add_formula(section, "explicit_damping");
    add_formula(section, "stability_limit", "q5_eq_limit");
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("q5");
    const auto meshes = meshes_for(library, settings, {"cube", "plane_ns", "fandisk_ns"}, section);
    add_method(section);

    add_heading(section, "Results");
    const auto studies = studies_of(meshes, "explicit smoothing", settings, progress, section, explicit_study);
    add_limit_table(section, studies);
    add_faces_without_area(section, studies);
    for (const ExplicitStudy& study : studies) {
        add_sweep_figure(answer, study);
        add_before_after(answer, study, settings.colormap);
        add_sweep_table(section, study);
        add_energy_plot(section, study);
        add_checks(section, study);
        section.parameters["λ_crit of " + study.name()] = plain_text(study.subject.critical, 6);
    }
    add_discussion(section, studies);

    section.parameters["iterations"] = std::to_string(studies.front().runs.front().iterations);
    section.parameters["operator"] = "cotangent, of the input, barycentric areas";
    section.extent = "λ swept below and above the predicted limit on " + listed(names_of(studies)) +
                     "; growth measured, blow-up caught; a recommended λ for each";
    const ExplicitStudy& last = studies.back();
    section.findings.push_back(
        {report::text("Q5: explicit smoothing of ", last.name(), " is stable up to λ = ", readable(last.subject.critical, 4),
                      ", predicted from one eigenvalue; beyond it the top mode grew as predicted, to within ",
                      readable_percent(std::abs(last.amplification.back().measured / last.amplification.back().predicted - 1), 1), "."),
         75});
    return answer;
}

extern const Chapter chapter{
    .id = "q5",
    .code = {{"smooth", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"explicit_step", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"ExplicitRows", "src/geometry/smoothing/diffusion_kernels.cpp"},
             {"largest_eigenvalue", "src/geometry/spectrum/stability.cpp"},
             {"answer", "src/questions/q5_explicit/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q5_explicit
