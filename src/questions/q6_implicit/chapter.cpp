// Question 6: implicit (backward Euler) smoothing after Desbrun et al. 1999, eq. 9, beside the explicit method.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "mesh/triangle_measures.h"
#include "questions/bench/smoothing_study.h"
#include "questions/core/comparison_figure.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/core/value_lists.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

using report::check_at_most;
using report::check_near;
using report::math;

// ---- results ----------------------------------------------------------------------------------------------------------

std::string label_of(const ImplicitStudy& study, const SmoothingCell& cell, const std::string& scheme) {
    return scheme + ", λ = " + step_label(study.subject, cell.lambda) + ", t = " + std::to_string(cell.iterations);
}

/// The diagonal of the box around X over that of the input.
double size_left(const ImplicitStudy& study, const Positions& X) {
    return bounding_box(moved_to(study.subject.mesh(), X)).diagonal() / study.subject.diagonal;
}

/// ", shrunk to 3 %" where the box has lost more than four fifths of its diagonal, or nothing.
std::string shrinkage(const ImplicitStudy& study, const Positions& X) {
    const double share = size_left(study, X);
    if (share > 0.2) return "";
    return share < 1e-4 ? ", shrunk to a point" : ", shrunk to " + readable_percent(share, 2);
}

output::Panel panel_of_cell(const ImplicitStudy& study, const SmoothingCell& cell, bool implicit) {
    const Positions& X = implicit ? cell.implicit_X : cell.explicit_X;
    const std::string scheme = implicit ? "implicit" : "explicit";
    return smoothing_panel(study.subject, X,
                           id_of("q6", study.name(), scheme + "_" + step_name(cell.lambda) + "_t" + std::to_string(cell.iterations)),
                           label_of(study, cell, scheme) + shrinkage(study, X));
}

void add_figure_of(Answer& answer, const ImplicitStudy& study, const std::string& what, std::string title, std::string caption,
                   std::vector<output::Panel> panels) {
    SixViewFigure figure;
    figure.id = id_of("q6", study.name(), what);
    figure.title = std::move(title);
    figure.subtitle = "λ_crit of the explicit scheme = " + readable(study.subject.critical, 4);
    figure.panels = std::move(panels);
    figure.caption = std::move(caption) +
                     " Coloured by cotangent mean curvature times the mean edge of the input; camera, scale and range are the input's.";
    add_smoothing_figure(answer, study.subject, id_of("q6", study.name(), what + "_before"), std::move(figure));
}

/// The largest step that leaves something to be seen at the middle number of iterations: three quarters of the size.
void add_before_after(Answer& answer, const ImplicitStudy& study, const std::string& colormap) {
    const SmoothingCell* shown = nullptr;
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        const SmoothingCell& cell = study.cell(l, study.middle_iteration());
        if (size_left(study, cell.implicit_X) > 0.75) shown = &cell;
    }
    if (shown == nullptr) return;
    const std::string times = counted(shown->iterations, "iteration");
    ComparisonFigure figure;
    figure.id = id_of("q6", study.name(), "before_after");
    figure.title = study.name() + " before and after " + times + ", implicit";
    figure.subtitle = "λ = " + step_label(study.subject, shown->lambda);
    figure.caption =
        study.name() + " before and after " + times + " of implicit smoothing at λ = " + step_label(study.subject, shown->lambda) +
        ", the largest step tried that keeps three quarters of the box diagonal, here " +
        readable_percent(size_left(study, shown->implicit_X)) + ". Of the Dirichlet energy " + readable_percent(shown->implicit_energy) +
        " is left" + (std::isnan(shown->volume_ratio) ? "" : ", of the volume " + readable_percent(shown->volume_ratio)) +
        (shown->explicit_blow_up > 0
             ? ". The explicit scheme blew up at this step in iteration " + std::to_string(shown->explicit_blow_up) + "."
             : ". The explicit scheme took this step without blowing up.");
    figure.before = panel_of(*study.subject.source, figure.id + "_input", "before");
    figure.after = panel_of(moved_to(study.subject.mesh(), shown->implicit_X), figure.id + "_smoothed", "after " + times);
    figure.diagonal = study.subject.diagonal;
    figure.colormap = colormap;
    add_comparison(answer, std::move(figure));
}

void add_figures(Answer& answer, const ImplicitStudy& study) {
    const std::string& name = study.name();
    const std::size_t t = study.middle_iteration();
    std::vector<output::Panel> steps, pairs;
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        const SmoothingCell& cell = study.cell(l, t);
        steps.push_back(panel_of_cell(study, cell, true));
        if (cell.explicit_X.size() > 0 && pairs.size() < 4) {
            output::Panel explicit_panel = panel_of_cell(study, cell, false), implicit_panel = panel_of_cell(study, cell, true);
            implicit_panel.name += "_beside";
            pairs.push_back(std::move(explicit_panel));
            pairs.push_back(std::move(implicit_panel));
        }
    }
    const std::string times = counted(study.iterations[t], "iteration");
    add_figure_of(answer, study, "steps", "Implicit smoothing of " + name + ": step sizes",
                  "Implicit smoothing of " + name + " with growing step, " + times + " each: stable at every one.", std::move(steps));
    if (!pairs.empty()) {
        add_figure_of(
            answer, study, "pairs", "Explicit beside implicit smoothing of " + name,
            "Explicit and implicit smoothing of " + name + " at equal step and " + times + ", where the explicit run did not blow up.",
            std::move(pairs));
    }
    if (study.iterations.size() < 2) return;
    std::vector<output::Panel> times_panels;
    const std::size_t l = std::min<std::size_t>(1, study.lambdas.size() - 1);
    for (std::size_t i = 0; i < study.iterations.size(); ++i) {
        output::Panel panel = panel_of_cell(study, study.cell(l, i), true);
        panel.name += "_series";
        times_panels.push_back(std::move(panel));
    }
    add_figure_of(
        answer, study, "iterations", "Implicit smoothing of " + name + ": iterations",
        "Implicit smoothing of " + name + " at λ = " + step_label(study.subject, study.lambdas[l]) + " with growing number of iterations.",
        std::move(times_panels));
}

void add_grid_table(report::Section& section, const ImplicitStudy& study) {
    report::Table table;
    table.id = id_of("q6", study.name(), "grid");
    table.caption =
        "Step size × iterations on " + study.name() +
        ", implicit beside explicit. Energy: Dirichlet energy over that of the input. Gap: rms "
        "distance between the two results. A mesh below 10⁻¹² of its energy has collapsed to a point and has no normals. Explicit –: "
        "the run had blown up, in the iteration of the last column (– there: it had not).";
    table.columns = {{"λ", "length²", 3},
                     {"λ/λ_crit", "", 3},
                     {"iterations", "", 4},
                     {"energy, implicit", "of input", 3},
                     {"energy, explicit", "of input", 3},
                     {"moved, implicit (rms)", "% of box", 3},
                     {"gap", "% of box", 3},
                     {"volume, implicit", "% of input", 4},
                     {"inverted faces, implicit", "", 6},
                     {"explicit blew up in", "iteration", 6}};
    for (const SmoothingCell& cell : study.grid) {
        const double percent = 100 / study.subject.diagonal;
        const bool both = cell.explicit_X.size() > 0;
        const report::Cell gap = both ? cell_of(percent * vertex_rms(cell.implicit_X, cell.explicit_X)) : report::Cell();
        table.rows.push_back({cell.lambda, cell.lambda / study.subject.critical, double(cell.iterations), cell.implicit_energy,
                              cell_of(cell.explicit_energy, both), percent * vertex_rms(study.subject.mesh().X, cell.implicit_X), gap,
                              cell_of(100 * cell.volume_ratio), cell_of(cell.inverted_faces, !cell.collapsed()),
                              cell_of(cell.explicit_blow_up, cell.explicit_blow_up > 0)});
    }
    section.blocks.push_back(std::move(table));
}

void add_cost_table(report::Section& section, const std::vector<ImplicitStudy>& studies) {
    report::Table table;
    table.id = "q6_cost";
    const bool unreached = std::any_of(studies.begin(), studies.end(), [](const ImplicitStudy& s) { return s.cost.explicit_steps <= 0; });
    table.caption =
        "What the same smoothness costs: implicit steps at the λ given, and the explicit steps at 0.95 λ_crit that reach the same "
        "Dirichlet energy" +
        std::string(unreached ? " (–: more than 3000)" : "") +
        ". Multiply–adds of the steps for three coordinates; the implicit method pays one factorisation on top. "
        "Seconds of this run are in the timings at the end.";
    table.columns = {{"mesh", "", 3},           {"energy reached", "of input", 3}, {"implicit λ/λ_crit", "", 3},
                     {"implicit steps", "", 5}, {"explicit steps", "", 5},         {"nonzeros of factor", "", 7},
                     {"nonzeros of C", "", 7},  {"implicit", "multiply–adds", 3},  {"explicit", "multiply–adds", 3}};
    for (const ImplicitStudy& study : studies) {
        const SmoothingCost& c = study.cost;
        const bool reached = c.explicit_steps > 0;
        table.rows.push_back({study.name(), c.energy, c.implicit_lambda / study.subject.critical, double(c.implicit_steps),
                              cell_of(c.explicit_steps, reached), double(c.factor_nonzeros), double(c.operator_nonzeros),
                              c.implicit_operations, cell_of(c.explicit_operations, reached)});
    }
    section.blocks.push_back(std::move(table));
}

// ---- checks -----------------------------------------------------------------------------------------------------------

void add_checks(report::Section& section, const ImplicitStudy& study) {
    const std::string on = " on " + study.name();
    section.checks.push_back(
        check_near("implicit damping of " + std::to_string(study.damped_modes) + " mode coefficients / (1 + λμ)^−t" + on, 1,
                   1 + study.worst_damping, 1e-6));
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        section.checks.push_back(
            energy_check("implicit energy never rises at " + plain_text(study.lambdas[l] / study.subject.critical, 3) + " λ_crit" + on,
                         study.implicit_runs[l]));
    }
    section.checks.push_back(check_at_most("energy after one implicit step at 10⁶ λ_crit / input" + on, 1, study.huge_step_energy, 0));
}

// ---- the section -----------------------------------------------------------------------------------------------------

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(section,
                  "Backward Euler: the Laplacian is taken at the new positions. Multiplied by M the system is symmetric positive definite "
                  "and linear, so one "
                  "sparse Cholesky factorisation serves all iterations and all three coordinates:");
    add_formula(section, "implicit_step", "q6_eq_step");
    add_paragraph(section, "Each eigenmode is divided by ", math("1 + λμ"), " a step, whatever λ:");
    add_formula(section, "implicit_damping", "q6_eq_damping");
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("q6");
    const auto meshes = meshes_for(library, settings, {"cube", "plane_ns", "fandisk_ns"}, section);
    add_method(section);

    add_heading(section, "Results");
    const auto studies = studies_of(meshes, "implicit smoothing", settings, progress, section, implicit_study);
    for (const ImplicitStudy& study : studies) {
        add_figures(answer, study);
        add_before_after(answer, study, settings.colormap);
        add_grid_table(section, study);
        add_checks(section, study);
        section.timings.push_back({"implicit steps on " + study.name() + " to the energy of the cost table", study.cost.implicit_seconds});
        if (study.cost.explicit_steps > 0)
            section.timings.push_back({"explicit steps on " + study.name() + " to the same energy", study.cost.explicit_seconds});
    }
    add_cost_table(section, studies);
    add_discussion(section, studies);

    const ImplicitStudy& last = studies.back();
    std::vector<std::string> times;
    for (const int t : last.iterations) times.push_back(std::to_string(t));
    section.parameters["iterations"] = listed(times);
    section.parameters["operator"] = "cotangent, of the input, barycentric areas";
    section.extent = counted(int(last.lambdas.size()), "step size") + " × " + listed(times) + " iterations on " +
                     listed(names_of(studies)) + ", each beside the explicit method at equal λ and iterations; cost of both";
    section.findings.push_back(
        {report::text("Q6: implicit smoothing of ", last.name(), " stays stable at ",
                      plain_text(last.lambdas.back() / last.subject.critical, 3), " times the explicit limit, and damps every mode as ",
                      math("(1 + λμ)^−t"), " predicts (largest deviation ", readable(last.worst_damping, 1), ")."),
         70});
    return answer;
}

extern const Chapter chapter{
    .id = "q6",
    .code = {{"smooth", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"implicit_step", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"ImplicitSolver::prepare", "src/geometry/smoothing/implicit_solver.cpp"},
             {"answer", "src/questions/q6_implicit/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q6_implicit
