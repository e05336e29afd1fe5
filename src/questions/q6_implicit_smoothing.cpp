// Question 6: implicit (backward Euler) smoothing after Desbrun et al. 1999, eq. 9, beside the explicit method.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "geometry/laplace_spectrum.h"
#include "mesh/triangle_measures.h"
#include "number_text.h"
#include "questions/section_tools.h"
#include "questions/six_view_figure.h"
#include "questions/smoothing_study.h"

namespace meshfolio {

namespace {

using report::check_at_most;
using report::check_near;
using report::math;
using report::ref;

/// Steps in units of the explicit limit: within it, a little beyond, far beyond, absurdly far.
const std::vector<double> default_taus{0.5, 5, 50, 1000};

/// One cell of the grid λ × iterations, both schemes.
struct GridCell {
    double lambda = 0;
    int iterations = 0;
    Positions implicit_X, explicit_X;   // explicit_X is empty once the explicit run has blown up
    double implicit_energy = 0, explicit_energy = 0;
    int explicit_blow_up = 0;   // iteration; 0: none
    double volume_ratio = 0;    // of the implicit result; NaN when open
    int inverted_faces = 0;     // of the implicit result

    bool collapsed() const { return implicit_energy < 1e-12; }   // to a point
};

struct Study {
    SmoothingSubject subject;
    std::vector<double> lambdas;
    std::vector<int> iterations;
    std::vector<GridCell> grid;                               // λ by λ, iterations ascending
    std::vector<SmoothingRun> implicit_runs, explicit_runs;   // one a λ
    double worst_damping = 0;                                 // largest relative deviation from (1 + λμ)^−t
    int damped_modes = 0;                                     // modes that went into it

    const GridCell& cell(std::size_t lambda, std::size_t t) const { return grid[lambda * iterations.size() + t]; }
};

int inverted_faces(const TriangleMesh& before, const Positions& X) {
    const Positions was = face_normals(before), is = face_normals(moved_to(before, X));
    return static_cast<int>(((was.array() * is.array()).rowwise().sum() < 0).count());
}

/// Kept positions of a run that may have stopped early: nothing for the iterations it did not reach.
const Positions* kept(const SmoothingRun& run, std::size_t which) { return which < run.snapshots.size() ? &run.snapshots[which] : nullptr; }

void fill_grid(Study& study) {
    const bool closed = study.subject.source->prepared->preflight.closed();
    const double volume = signed_volume(study.subject.mesh());
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        for (std::size_t t = 0; t < study.iterations.size(); ++t) {
            const SmoothingRun &implicit_run = study.implicit_runs[l], &explicit_run = study.explicit_runs[l];
            const auto step = static_cast<std::size_t>(study.iterations[t]);
            GridCell cell;
            cell.lambda = study.lambdas[l];
            cell.iterations = study.iterations[t];
            cell.implicit_X = *kept(implicit_run, t);
            cell.implicit_energy = implicit_run.energy[step];
            if (const Positions* X = kept(explicit_run, t)) {
                cell.explicit_X = *X;
                cell.explicit_energy = explicit_run.energy[step];
            } else {
                cell.explicit_blow_up = explicit_run.result.blow_up_iteration;
            }
            if (cell.collapsed()) {   // a point to rounding: neither its volume nor its normals mean anything
                cell.volume_ratio = closed ? 0 : std::nan("");
                study.grid.push_back(std::move(cell));
                continue;
            }
            cell.volume_ratio = closed ? signed_volume(moved_to(study.subject.mesh(), cell.implicit_X)) / volume : std::nan("");
            cell.inverted_faces = inverted_faces(study.subject.mesh(), cell.implicit_X);
            study.grid.push_back(std::move(cell));
        }
    }
}

/// Compares the damping of the lowest modes with (1 + λμ)^−t, in the runs where they have not vanished.
void measure_damping(Study& study) {
    const SmoothingSubject& subject = study.subject;
    const int k = std::min(12, subject.source->prepared->preflight.vertices_in_use);
    const Spectrum low = smallest_eigenpairs(subject.laplacian, k);
    // Well above rounding, also that of coordinates far from the origin.
    const double rounding = 1e7 * std::numeric_limits<double>::epsilon() * subject.mesh().X.cwiseAbs().maxCoeff();
    const double visible = std::max(1e-6 * subject.diagonal, rounding) * std::sqrt(subject.laplacian.M.sum());
    // About the barycentre, which does not move: far from the origin the offset would drown the modes in rounding.
    const Vector& M = subject.laplacian.M;
    const Eigen::RowVector3d near = subject.mesh().X.row(0);
    const Eigen::RowVector3d barycentre = near + M.transpose() * (subject.mesh().X.rowwise() - near) / M.sum();
    for (const GridCell& cell : study.grid) {
        const Positions start = subject.mesh().X.rowwise() - barycentre, end = cell.implicit_X.rowwise() - barycentre;
        for (int i = 0; i < low.eigenvalues.size(); ++i) {
            const Vector weights = subject.laplacian.M.cwiseProduct(low.eigenvectors.col(i));
            const double before = (start.transpose() * weights).norm();
            const double after = (end.transpose() * weights).norm();
            if (before < visible || after < visible) continue;
            const double predicted = std::pow(1 + cell.lambda * low.eigenvalues[i], -cell.iterations);
            study.worst_damping = std::max(study.worst_damping, std::abs(after / before / predicted - 1));
            ++study.damped_modes;
        }
    }
}

Study study_of(std::shared_ptr<const LibraryMesh> mesh, const QuestionSettings& settings) {
    Study study;
    study.subject = smoothing_subject(std::move(mesh));
    study.lambdas = settings.lambda;
    if (study.lambdas.empty()) {
        for (const double tau : default_taus) study.lambdas.push_back(tau * study.subject.critical);
    }
    study.iterations = settings.iterations;
    if (study.iterations.empty()) study.iterations = settings.quick ? std::vector{1, 10} : std::vector{1, 10, 50};
    study.lambdas = each_once(study.lambdas);
    study.iterations = each_once(study.iterations);
    const int last = study.iterations.back();
    for (const double lambda : study.lambdas) {
        study.implicit_runs.push_back(run_smoothing(study.subject, SmoothingScheme::implicit_euler, lambda, last, study.iterations));
        study.explicit_runs.push_back(run_smoothing(study.subject, SmoothingScheme::explicit_euler, lambda, last, study.iterations));
    }
    fill_grid(study);
    measure_damping(study);
    return study;
}

std::string id_of(const Study& study, const std::string& what) { return "q6_" + study.subject.name() + "_" + what; }

std::string label_of(const Study& study, const GridCell& cell, const std::string& scheme) {
    return scheme + ", λ = " + step_label(study.subject, cell.lambda) + ", t = " + std::to_string(cell.iterations);
}

/// ", shrunk to 3 %" where the box has lost more than four fifths of its diagonal, or nothing.
std::string shrinkage(const Study& study, const Positions& X) {
    const double share = bounding_box(moved_to(study.subject.mesh(), X)).diagonal() / study.subject.diagonal;
    if (share > 0.2) return "";
    return share < 1e-4 ? ", shrunk to a point" : ", shrunk to " + readable_percent(share, 2);
}

output::Panel panel_of_cell(const Study& study, const GridCell& cell, bool implicit) {
    const Positions& X = implicit ? cell.implicit_X : cell.explicit_X;
    const std::string scheme = implicit ? "implicit" : "explicit";
    return panel_of(moved_to(study.subject.mesh(), X),
                    id_of(study, scheme + "_" + step_name(cell.lambda) + "_t" + std::to_string(cell.iterations)),
                    label_of(study, cell, scheme) + shrinkage(study, X), curvature_colours(study.subject, X));
}

/// Index of the iteration count that the figures over λ use: the middle one.
std::size_t middle_iteration(const Study& study) { return study.iterations.size() / 2; }

// ---- results ----------------------------------------------------------------------------------------------------------

output::Panel before_panel(const Study& study, const std::string& name) {
    return panel_of(*study.subject.source, id_of(study, name), "before", curvature_colours(study.subject, study.subject.mesh().X));
}

void add_smoothing_figure(Answer& answer, const Study& study, const std::string& what, std::string title, std::string caption,
                          std::vector<output::Panel> panels) {
    SixViewFigure figure;
    figure.id = id_of(study, what);
    figure.title = std::move(title);
    figure.subtitle = "λ_crit of the explicit scheme = " + readable(study.subject.critical, 4);
    figure.panels.push_back(before_panel(study, what + "_before"));
    for (output::Panel& panel : panels) figure.panels.push_back(std::move(panel));
    figure.range = output::robust_range({figure.panels.front()}, "diverging", "mean curvature × mean edge", "", 0.02);
    figure.caption = std::move(caption) +
                     " Coloured by cotangent mean curvature times the mean edge of the input; camera, scale and range are the input's.";
    add_figure(answer, std::move(figure));
}

void add_figures(Answer& answer, const Study& study) {
    const std::string& name = study.subject.name();
    const std::size_t t = middle_iteration(study);
    std::vector<output::Panel> steps, pairs;
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        const GridCell& cell = study.cell(l, t);
        steps.push_back(panel_of_cell(study, cell, true));
        if (cell.explicit_X.size() > 0 && pairs.size() < 4) {
            output::Panel explicit_panel = panel_of_cell(study, cell, false), implicit_panel = panel_of_cell(study, cell, true);
            implicit_panel.name += "_beside";
            pairs.push_back(std::move(explicit_panel));
            pairs.push_back(std::move(implicit_panel));
        }
    }
    const std::string times = counted(study.iterations[t], "iteration");
    add_smoothing_figure(answer, study, "steps", "Implicit smoothing of " + name + ": step sizes",
                         "Implicit smoothing of " + name + " with growing step, " + times + " each: stable at every one.",
                         std::move(steps));
    if (!pairs.empty()) {
        add_smoothing_figure(
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
    add_smoothing_figure(
        answer, study, "iterations", "Implicit smoothing of " + name + ": iterations",
        "Implicit smoothing of " + name + " at λ = " + step_label(study.subject, study.lambdas[l]) + " with growing number of iterations.",
        std::move(times_panels));
}

void add_grid_table(report::Section& section, const Study& study) {
    report::Table table;
    table.id = id_of(study, "grid");
    table.caption = "Step size × iterations on " + study.subject.name() +
                    ", implicit beside explicit. Energy: Dirichlet energy over that of the input. Gap: rms "
                    "distance between the two results. A mesh below 10⁻¹² of its energy has collapsed to a point and has no normals. Empty "
                    "explicit cells: the run had blown up (iteration in the last column).";
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
    for (const GridCell& cell : study.grid) {
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

/// What reaching the same smoothness costs: the energy of the implicit run with the largest λ below 100 λ_crit after the middle number of
/// iterations, and the explicit steps at 0.95 λ_crit that get there.
struct Cost {
    double energy = 0, implicit_lambda = 0;
    int implicit_steps = 0, explicit_steps = 0;                // explicit_steps 0: more than the limit tried
    double implicit_operations = 0, explicit_operations = 0;   // multiply–adds of the steps, without factorisation
    long long factor_nonzeros = 0, operator_nonzeros = 0;
    double implicit_seconds = 0, explicit_seconds = 0;
};

Cost cost_of(const Study& study) {
    constexpr int most_steps = 3000;
    Cost cost;
    std::size_t l = 0;
    for (std::size_t i = 0; i < study.lambdas.size(); ++i) {
        if (study.lambdas[i] < 100 * study.subject.critical) l = i;
    }
    const GridCell& cell = study.cell(l, middle_iteration(study));
    cost.energy = cell.implicit_energy;
    cost.implicit_lambda = cell.lambda;
    cost.implicit_steps = cell.iterations;
    using Clock = std::chrono::steady_clock;
    const auto seconds_since = [](Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); };

    SmoothingOptions options;
    options.scheme = SmoothingScheme::implicit_euler;
    options.lambda = cell.lambda;
    options.iterations = cell.iterations;
    Clock::time_point start = Clock::now();
    const Smoothed implicit_result = smooth(study.subject.mesh(), options);
    cost.implicit_seconds = seconds_since(start);

    options.scheme = SmoothingScheme::explicit_euler;
    options.lambda = 0.95 * study.subject.critical;
    options.iterations = most_steps;
    options.after_step = [&](int iteration, const Positions& X) {
        const bool there = dirichlet_energy(study.subject.laplacian.C, X) <= cost.energy * study.subject.initial_energy;
        if (there) cost.explicit_steps = iteration;
        return !there;
    };
    smooth(study.subject.mesh(), options);
    if (cost.explicit_steps > 0) {   // timed without the energy, which costs as much as a step
        options.after_step = {};
        options.iterations = cost.explicit_steps;
        start = Clock::now();
        smooth(study.subject.mesh(), options);
        cost.explicit_seconds = seconds_since(start);
    }
    cost.factor_nonzeros = implicit_result.factor_nonzeros;
    cost.operator_nonzeros = study.subject.laplacian.C.nonZeros();
    cost.implicit_operations = 3.0 * cost.implicit_steps * 2 * double(cost.factor_nonzeros);
    cost.explicit_operations = 3.0 * cost.explicit_steps * double(cost.operator_nonzeros);
    return cost;
}

void add_cost_table(report::Section& section, const std::vector<Study>& studies, const std::vector<Cost>& costs) {
    report::Table table;
    table.id = "q6_cost";
    table.caption =
        "What the same smoothness costs: implicit steps at the λ given, and the explicit steps at 0.95 λ_crit that reach the same "
        "Dirichlet energy "
        "(empty: more than 3000). Multiply–adds of the steps for three coordinates; the implicit method pays one factorisation on top. "
        "Seconds of this run are in the timings at the end.";
    table.columns = {{"mesh", "", 3},           {"energy reached", "of input", 3}, {"implicit λ/λ_crit", "", 3},
                     {"implicit steps", "", 5}, {"explicit steps", "", 5},         {"nonzeros of factor", "", 7},
                     {"nonzeros of C", "", 7},  {"implicit", "multiply–adds", 3},  {"explicit", "multiply–adds", 3}};
    for (std::size_t i = 0; i < studies.size(); ++i) {
        const Cost& c = costs[i];
        const bool reached = c.explicit_steps > 0;
        table.rows.push_back({studies[i].subject.name(), c.energy, c.implicit_lambda / studies[i].subject.critical,
                              double(c.implicit_steps), cell_of(c.explicit_steps, reached), double(c.factor_nonzeros),
                              double(c.operator_nonzeros), c.implicit_operations, cell_of(c.explicit_operations, reached)});
    }
    section.blocks.push_back(std::move(table));
}

// ---- checks -----------------------------------------------------------------------------------------------------------

void add_checks(report::Section& section, const Study& study) {
    const std::string on = " on " + study.subject.name();
    section.checks.push_back(
        check_near("implicit damping of " + std::to_string(study.damped_modes) + " mode coefficients / (1 + λμ)^−t" + on, 1,
                   1 + study.worst_damping, 1e-6));
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        const std::vector<double>& energy = study.implicit_runs[l].energy;
        double rise = 0;
        for (std::size_t t = 1; t < energy.size(); ++t) rise = std::max(rise, energy[t] - energy[t - 1]);
        section.checks.push_back(check_at_most(
            "implicit energy never rises at " + plain_text(study.lambdas[l] / study.subject.critical, 3) + " λ_crit" + on, 0, rise, 1e-12));
    }
    // One step at a million times the explicit limit: still a smoothing.
    const Positions X = implicit_step(study.subject.laplacian, 1e6 * study.subject.critical, study.subject.mesh().X);
    section.checks.push_back(check_at_most("energy after one implicit step at 10⁶ λ_crit / input" + on, 1,
                                           dirichlet_energy(study.subject.laplacian.C, X) / study.subject.initial_energy, 0));
}

// ---- what the numbers say ---------------------------------------------------------------------------------------------

report::Text agreement(const Study& study) {
    const GridCell& cell = study.cell(0, middle_iteration(study));
    const double moved = vertex_rms(study.subject.mesh().X, cell.implicit_X);
    if (cell.explicit_X.size() == 0 || moved <= 0 || cell.lambda > study.subject.critical) return {};
    const double share = vertex_rms(cell.implicit_X, cell.explicit_X) / moved;
    report::Text t =
        report::text("Within the explicit limit the two methods ",
                     share < 0.05  ? "agree closely"
                     : share < 0.3 ? "agree roughly"
                                   : "differ",
                     " on ", study.subject.name(), ": at λ = ", step_label(study.subject, cell.lambda), " and ",
                     counted(cell.iterations, "iteration"), " their results lie ", readable_percent(share, 2), " of the motion apart");
    report::extend(t, ", because ", math("1 − λμ"), " and ", math("1/(1 + λμ)"), " differ by ", math("(λμ)²"), " only where ", math("λμ"),
                   " is small.");
    return t;
}

report::Text beyond_the_limit(const Study& study) {
    const GridCell* blown = nullptr;
    for (const GridCell& cell : study.grid) {
        if (cell.explicit_blow_up > 0 && (blown == nullptr || cell.lambda < blown->lambda)) blown = &cell;
    }
    const GridCell& far = study.cell(study.lambdas.size() - 1, middle_iteration(study));
    report::Text t;
    if (blown != nullptr) {
        report::extend(t, "Beyond the limit they part: at ", plain_text(blown->lambda / study.subject.critical, 3),
                       "\u202fλ_crit the explicit run on ", study.subject.name(), " blows up in iteration ",
                       std::to_string(blown->explicit_blow_up), ", the implicit one does not. ");
    }
    if (far.collapsed()) {
        report::extend(t, "At ", plain_text(far.lambda / study.subject.critical, 3), "\u202fλ_crit and ",
                       counted(far.iterations, "iteration"), " ", study.subject.name(),
                       " has collapsed to a point: stable is not the same as useful.");
        return t;
    }
    report::extend(t, "At ", plain_text(far.lambda / study.subject.critical, 3), "\u202fλ_crit and ", counted(far.iterations, "iteration"),
                   " it leaves ", readable_percent(far.implicit_energy, 2), " of the Dirichlet energy of ", study.subject.name());
    if (std::isfinite(far.volume_ratio)) {
        report::extend(t, " and ", readable_percent(far.volume_ratio, 2), " of its volume",
                       far.volume_ratio < 0.5 ? ": stable is not the same as useful, the shape has shrunk away" : "");
    }
    if (far.inverted_faces > 0) report::extend(t, "; ", counted(far.inverted_faces, "face"), " point the other way");
    report::extend(t, ".");
    return t;
}

/// Is one step of 10 λ the same as ten of λ? Looks for two cells of equal λt.
report::Text iterations_against_steps(const Study& study) {
    for (const GridCell& a : study.grid) {
        for (const GridCell& b : study.grid) {
            if (a.iterations >= b.iterations || std::abs(a.lambda * a.iterations / (b.lambda * b.iterations) - 1) > 1e-9) continue;
            const double gap = vertex_rms(a.implicit_X, b.implicit_X), moved = vertex_rms(study.subject.mesh().X, b.implicit_X);
            const double share = gap / moved;
            return report::text("More iterations and larger steps are ",
                                share < 0.1   ? "nearly"
                                : share < 0.4 ? "roughly, but not quite,"
                                              : "not",
                                " interchangeable on ", study.subject.name(), ": ", std::to_string(b.iterations), " steps of ",
                                plain_text(b.lambda / study.subject.critical, 3), "\u202fλ_crit and ", std::to_string(a.iterations), " of ",
                                plain_text(a.lambda / study.subject.critical, 3), "\u202fλ_crit end ", readable_percent(share, 2),
                                " of the motion apart. Many small steps damp the high modes exponentially, one large "
                                "step only like ",
                                math("1/(1 + λμ)"), ".");
        }
    }
    return {};
}

report::Text price(const Study& study, const Cost& cost) {
    report::Text t = report::text("Is implicit cheaper? To bring ", study.subject.name(), " to ", readable_percent(cost.energy),
                                  " of its energy takes ", counted(cost.implicit_steps, "implicit step"), " or ");
    if (cost.explicit_steps == 0) {
        report::extend(t, "more than 3000 explicit ones: for this much smoothing the implicit method is the only practical one.");
        return t;
    }
    const double ratio = cost.explicit_operations / cost.implicit_operations;
    report::extend(t, counted(cost.explicit_steps, "explicit one"), ". An implicit step costs ",
                   readable(2.0 * double(cost.factor_nonzeros) / double(cost.operator_nonzeros), 2),
                   " times an explicit one, so in multiply–adds of the steps the explicit way is ",
                   ratio > 1 ? readable(ratio, 2) + " times as expensive" : "cheaper, " + readable(1 / ratio, 2) + " times", " (",
                   ref("q6_cost"), "), before the one factorisation is counted",
                   ratio > 1 ? "." : ": at this smoothness the implicit method buys stability, not speed.");
    return t;
}

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(section,
                  "Backward Euler: the Laplacian is taken at the new positions. Multiplied by M the system is symmetric positive definite "
                  "and linear, so one "
                  "sparse Cholesky factorisation serves all iterations and all three coordinates:");
    add_formula(section, "implicit_step", "q6_eq_step");
    add_paragraph(section, "Each eigenmode is divided by ", math("1 + λμ"), " a step, whatever λ:");
    add_formula(section, "implicit_damping", "q6_eq_damping");
    section.code = {{"smooth", "src/geometry/laplacian_smoothing.cpp", "factor once, solve three right-hand sides a step"},
                    {"implicit_step", "src/geometry/laplacian_smoothing.cpp", "(M − λC)X' = MX"},
                    {"SparseFactor", "src/geometry/sparse_factor.cpp", "Cholesky factorisation"},
                    {"answer_q6", "src/questions/q6_implicit_smoothing.cpp", "this section"}};
}

}   // namespace

Answer answer_q6(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("q6");
    const auto meshes = meshes_for(library, settings, {"cube", "plane_ns", "fandisk_ns"}, section);
    add_method(section);

    add_heading(section, "Results");
    std::vector<Study> studies;
    std::vector<Cost> costs;
    std::vector<std::string> names;
    for (const auto& mesh : meshes) {
        progress("implicit smoothing of " + mesh->name);
        studies.push_back(study_of(mesh, settings));
        costs.push_back(cost_of(studies.back()));
        names.push_back(mesh->name);
        add_figures(answer, studies.back());
        add_grid_table(section, studies.back());
        add_checks(section, studies.back());
        section.timings.push_back({"implicit steps on " + mesh->name + " to the energy of the cost table", costs.back().implicit_seconds});
        if (costs.back().explicit_steps > 0)
            section.timings.push_back({"explicit steps on " + mesh->name + " to the same energy", costs.back().explicit_seconds});
    }
    add_cost_table(section, studies, costs);

    add_heading(section, "Discussion");
    for (std::size_t i = 0; i < studies.size(); ++i) {
        for (report::Text t :
             {agreement(studies[i]), beyond_the_limit(studies[i]), iterations_against_steps(studies[i]), price(studies[i], costs[i])}) {
            if (!t.empty()) section.blocks.push_back(report::Paragraph{std::move(t)});
        }
    }

    const Study& last = studies.back();
    std::vector<std::string> times;
    for (const int t : last.iterations) times.push_back(std::to_string(t));
    section.parameters["iterations"] = listed(times);
    section.parameters["operator"] = "cotangent, of the input, barycentric areas";
    section.extent = counted(int(last.lambdas.size()), "step size") + " × " + listed(times) + " iterations on " + listed(names) +
                     ", each beside the explicit method at equal λ and iterations; cost of both";
    section.findings.push_back(
        {report::text("Q6: implicit smoothing of ", last.subject.name(), " stays stable at ",
                      plain_text(last.lambdas.back() / last.subject.critical, 3), " times the explicit limit, and damps every mode as ",
                      math("(1 + λμ)^−t"), " predicts (largest deviation ", readable(last.worst_damping, 1), ")."),
         70});
    return answer;
}

}   // namespace meshfolio
