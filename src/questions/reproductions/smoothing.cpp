// Smoothing experiments of earlier reports: pictures, table and what was found.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "mesh/triangle_measures.h"
#include "questions/core/section_tools.h"
#include "questions/core/six_view_figure.h"
#include "questions/core/value_lists.h"
#include "questions/reproductions/parts.h"

namespace meshfolio::reproductions {

namespace {

using report::check_at_most;
using report::math;

/// The positions a run shows after one of the experiment's iterations; where it has left the picture, the last that are in view.
struct Shown {
    const Positions* X;
    int iteration;
    bool reached;   // and in view
};
Shown shown_at(const ExperimentRun& run, std::size_t index, int iteration) {
    if (index < run.run.snapshots.size() && iteration <= run.run.in_view_iteration) return {&run.run.snapshots[index], iteration, true};
    return {&run.run.in_view, run.run.in_view_iteration, false};
}

/// Is the result smaller than a few pixels of the picture?
bool has_shrunk_away(const ExperimentMesh& mesh, const Positions& X) {
    return bounding_box(moved_to(mesh.mesh(), X)).diagonal() < 0.01 * mesh.diagonal;
}

void add_figure_of(const Reproduction& r, const SmoothingExperiment& done, std::size_t m) {
    const Experiment& e = r.experiment;
    const ExperimentMesh& mesh = done.meshes[m];
    const ExperimentColour colour = e.colours.front();
    const std::string id = r.id_of(mesh.name());
    SixViewFigure figure;
    figure.id = id;
    figure.title = e.from + ": " + e.name;
    figure.subtitle = mesh.used->input.file;
    figure.panels.push_back(panel_of(*mesh.used, id + "_before", "before", colours_of(mesh, colour, mesh.mesh().X)));
    std::vector<std::string> gone, shrunk;   // out of the picture with their first step; too small to be seen in it
    for (const ExperimentRun& run : done.runs) {
        if (run.mesh != m) continue;
        if (run.run.in_view_iteration == 0 && run.run.result.blew_up) {
            gone.push_back("λ = " + given_text(e, run.given) + " (" + variant_text(e, run.kind, run.area, run.method) + ")");
            continue;
        }
        bool ended = false;   // a run that has left the picture is shown once
        for (std::size_t i = 0; i < e.iterations.size() && !ended; ++i) {
            const Shown shown = shown_at(run, i, e.iterations[i]);
            std::string label = variant_text(e, run.kind, run.area, run.method) + ", λ = " + given_text(e, run.given);
            if (e.lambda_unit != StepUnit::tau) label += " = " + chosen_text(run.share()) + " λ_crit";
            label += ", t = " + std::to_string(shown.iteration) + (shown.reached ? "" : ", the last in view");
            ended = !shown.reached;
            if (has_shrunk_away(mesh, *shown.X)) {
                shrunk.push_back(label);
                continue;
            }
            figure.panels.push_back(panel_of(moved_to(mesh.mesh(), *shown.X), id + "_" + std::to_string(figure.panels.size()), label,
                                             colours_of(mesh, colour, *shown.X)));
        }
    }
    figure.range = range_of(r, colour, {figure.panels.front()});
    figure.caption = mesh.used->input.file + " before and after each run, camera and scale those of the input.";
    if (figure.range) figure.caption += " Colours: " + figure.range->quantity + ", in the range of the input.";
    if (!gone.empty()) figure.caption += " Beyond the picture after the first step already, so not drawn: " + listed(gone) + ".";
    if (!shrunk.empty()) figure.caption += " Shrunk to less than can be seen, so not drawn: " + listed(shrunk) + ".";
    add_figure(r.answer, std::move(figure));
}

std::string outcome_of(const ExperimentMesh& mesh, const ExperimentRun& run, std::size_t index, double energy) {
    const Smoothed& result = run.run.result;
    if (index >= run.run.snapshots.size() && result.blew_up) return "blown up in iteration " + std::to_string(result.blow_up_iteration);
    if (index >= run.run.snapshots.size() && result.collapse_iteration > 0)
        return "nothing left in iteration " + std::to_string(result.collapse_iteration);
    if (has_shrunk_away(mesh, run.run.snapshots[index])) return "shrunk to almost a point";
    return energy > 1 ? "rougher than before" : "smoother";
}

void add_table(const Reproduction& r, const SmoothingExperiment& done) {
    const Experiment& e = r.experiment;
    report::Table table;
    table.id = r.id_of("runs");
    table.caption =
        "Every run. Energy: Dirichlet energy of the run's own operator over that of the input; moved: rms over the vertices; –: no "
        "volume where the mesh is open, nothing where the run had ended.";
    table.columns = {{"mesh"},
                     {"steps"},
                     {"λ, report"},
                     {"λ, here", "", 3},
                     {"λ/λ_crit", "", 3},
                     {"iterations", "", 6},
                     {"energy", "of input", 3},
                     {"moved", "% of box", 3},
                     {"volume", "% of input", 4},
                     {"inverted faces", "", 6},
                     {"outcome"}};
    for (const ExperimentRun& run : done.runs) {
        const ExperimentMesh& mesh = done.meshes[run.mesh];
        for (std::size_t i = 0; i < e.iterations.size(); ++i) {
            const auto t = static_cast<std::size_t>(e.iterations[i]);
            const bool reached = i < run.run.snapshots.size();
            const double energy = reached ? run.run.energy[t] : std::nan("");
            std::vector<report::Cell> row{mesh.name(),
                                          variant_text(e, run.kind, run.area, run.method),
                                          given_text(e, run.given),
                                          run.run.lambda,
                                          run.share(),
                                          double(t),
                                          cell_of(energy)};
            const std::monostate empty;
            if (reached) {
                const MeshDifference moved = compare_meshes(mesh.mesh(), moved_to(mesh.mesh(), run.run.snapshots[i]));
                row.insert(row.end(), {100 * moved.rms / mesh.diagonal, cell_of(run.run.volume.empty() ? NAN : 100 * run.run.volume[t]),
                                       double(moved.inverted_faces)});
            } else {
                row.insert(row.end(), {empty, empty, empty});
            }
            row.emplace_back(outcome_of(mesh, run, i, energy));
            table.rows.push_back(std::move(row));
        }
    }
    r.section().blocks.emplace_back(std::move(table));
}

// ---- what was found ---------------------------------------------------------------------------------------------------

using Runs = std::vector<const ExperimentRun*>;

template <class Chosen>
Runs runs_where(const SmoothingExperiment& done, std::size_t mesh, Chosen chosen) {
    Runs runs;
    for (const ExperimentRun& run : done.runs) {
        if (run.mesh == mesh && chosen(run)) runs.push_back(&run);
    }
    return runs;
}

template <class Value>
std::vector<double> values_of(const Runs& runs, Value value) {
    std::vector<double> values;
    for (const ExperimentRun* run : runs) values.push_back(value(*run));
    return values;
}

bool is_explicit(const ExperimentRun& run) { return run.method.scheme == SmoothingScheme::explicit_euler; }
double last_energy(const ExperimentRun& run) { return run.run.energy.back(); }
double share_of(const ExperimentRun& run) { return run.share(); }
int end_of(const ExperimentRun& run) { return run.run.result.blow_up_iteration; }

/// What became of some runs: how many, at which shares of the limit, and their energies or the iterations they ended in.
void tell_runs(report::Text& text, const Runs& runs, const std::string& what) {
    if (runs.empty()) return;
    Runs blown, whole;
    for (const ExperimentRun* run : runs) (run->run.result.blew_up ? blown : whole).push_back(run);
    report::extend(text, sentence_case(what), " (", range_text(values_of(runs, share_of)), " ", math("λ_crit"), "): ");
    if (!whole.empty()) {
        report::extend(text, blown.empty() ? "" : counted(static_cast<int>(whole.size()), "run") + " ended whole, ",
                       "after the last iteration ", range_text(values_of(whole, last_energy)), " times the energy of the input");
    }
    if (!blown.empty()) {
        const auto [first, last] = std::minmax_element(blown.begin(), blown.end(), [](auto a, auto b) { return end_of(*a) < end_of(*b); });
        report::extend(text, whole.empty() ? "" : "; ", counted(static_cast<int>(blown.size()), "run"), " blew up, in iteration ",
                       std::to_string(end_of(**first)));
        if (end_of(**last) > end_of(**first)) report::extend(text, " to ", std::to_string(end_of(**last)));
    }
    report::extend(text, ". ");
}

/// Of runs beyond the limit that ended whole with less energy: how far the top mode, for which λμ_max = 2λ/λ_crit, grew in them.
void tell_hidden_growth(report::Text& text, const Runs& beyond) {
    Runs hidden;
    for (const ExperimentRun* run : beyond) {
        if (!run->run.result.blew_up && last_energy(*run) < 1) hidden.push_back(run);
    }
    if (hidden.empty()) return;
    const auto growth = [](const ExperimentRun& run) { return std::pow(2 * run.share() - 1, run.run.result.iterations); };
    report::extend(text, "Where such steps ended whole, the top mode grew ", math("|1 − λμ_max|^t"), " = ",
                   range_text(values_of(hidden, growth)), "-fold all the same, which the energy does not show yet. ");
}

/// The gap between explicit and implicit runs at the same λ, against how far they moved.
void tell_pairs(report::Text& text, const SmoothingExperiment& done, std::size_t m) {
    for (const ExperimentRun& a : done.runs) {
        for (const ExperimentRun& b : done.runs) {
            const bool pair = a.mesh == m && b.mesh == m && is_explicit(a) && b.method.scheme == SmoothingScheme::implicit_euler &&
                              a.method.rebuild == b.method.rebuild && a.kind == b.kind && a.area == b.area && a.run.lambda == b.run.lambda;
            if (!pair || a.run.result.blew_up || a.run.snapshots.empty() || b.run.snapshots.empty()) continue;
            const double percent = 100 / done.meshes[m].diagonal;
            report::extend(text, "At ", readable(a.share()), " ", math("λ_crit"), " explicit and implicit results differ by ",
                           readable(percent * vertex_rms(a.run.snapshots.back(), b.run.snapshots.back())),
                           " % of the box (rms), having moved by ", readable(percent * a.run.moved.rms), " % and ",
                           readable(percent * b.run.moved.rms), " %. ");
        }
    }
}

/// Runs of one kind that reach the same diffusion time λt with different λ.
void tell_equal_times(report::Text& text, const Experiment& e, const SmoothingExperiment& done, std::size_t m) {
    std::vector<double> gaps, moves;
    for (const ExperimentRun& a : done.runs) {
        for (const ExperimentRun& b : done.runs) {
            const bool comparable =
                a.mesh == m && b.mesh == m && a.method == b.method && a.kind == b.kind && a.area == b.area && a.run.lambda < b.run.lambda;
            if (!comparable) continue;
            for (std::size_t i = 0; i < a.run.snapshots.size(); ++i) {
                for (std::size_t j = 0; j < b.run.snapshots.size(); ++j) {
                    if (std::abs(a.run.lambda * e.iterations[i] / (b.run.lambda * e.iterations[j]) - 1) > 1e-9) continue;
                    gaps.push_back(100 / done.meshes[m].diagonal * vertex_rms(a.run.snapshots[i], b.run.snapshots[j]));
                    moves.push_back(100 / done.meshes[m].diagonal * vertex_rms(done.meshes[m].mesh().X, b.run.snapshots[j]));
                }
            }
        }
    }
    if (gaps.empty()) return;
    report::extend(text, "The same ", math("λt"), " in more and smaller steps (", counted(static_cast<int>(gaps.size()), "pair"),
                   "): results differ by ", range_text(gaps), " % of the box where they moved by ", range_text(moves), " %. ");
}

report::Text found_on(const Reproduction& r, const SmoothingExperiment& done, std::size_t m) {
    report::Text text = report::text(report::strong("Found on " + done.meshes[m].name() + ": "));
    const auto frozen = [](const ExperimentRun& run) { return is_explicit(run) && !run.method.rebuild; };
    tell_runs(text, runs_where(done, m, [&](const ExperimentRun& run) { return frozen(run) && run.share() <= 1; }),
              "explicit steps within the limit");
    const Runs beyond = runs_where(done, m, [&](const ExperimentRun& run) { return frozen(run) && run.share() > 1; });
    tell_runs(text, beyond, "explicit steps beyond the limit");
    tell_hidden_growth(text, beyond);
    tell_runs(text, runs_where(done, m, [](const ExperimentRun& run) { return is_explicit(run) && run.method.rebuild; }),
              "explicit steps with the operator rebuilt at each");
    tell_runs(text, runs_where(done, m, [](const ExperimentRun& run) { return run.method.scheme == SmoothingScheme::implicit_euler; }),
              "implicit steps");
    tell_runs(text, runs_where(done, m, [](const ExperimentRun& run) { return run.method.scheme == SmoothingScheme::taubin; }),
              "Taubin's steps");
    tell_pairs(text, done, m);
    tell_equal_times(text, r.experiment, done, m);
    for (const UsableStep& usable : done.usable) {
        if (usable.mesh != m) continue;
        report::extend(text, "The largest λ that ", counted(usable.iterations, "step"), " bear is ", readable(usable.lambda), " = ",
                       readable(usable.lambda / usable.critical, 4), " ", math("λ_crit"), ". ");
    }
    return text;
}

void add_checks(const Reproduction& r, const SmoothingExperiment& done) {
    for (const ExperimentRun& run : done.runs) {
        const bool decays = run.method.scheme == SmoothingScheme::implicit_euler || run.share() < 1;
        const bool law = decays && !run.method.rebuild && run.method.scheme != SmoothingScheme::taubin;
        if (!law) continue;
        const std::string name = "energy never rises: " + name_of(run.method) + ", " + plain_text(run.share(), 3) + " λ_crit on " +
                                 done.meshes[run.mesh].name() + " (" + r.experiment.from + ", " + rows_text(r.experiment.rows) + ")";
        r.section().checks.push_back(energy_check(name, run.run));
    }
}

}   // namespace

void add_smoothing_reproduction(const Reproduction& r, const SmoothingExperiment& done) {
    add_opening(r, done.meshes);
    for (std::size_t m = 0; m < done.meshes.size(); ++m) add_figure_of(r, done, m);
    add_table(r, done);
    for (std::size_t m = 0; m < done.meshes.size(); ++m) r.section().blocks.emplace_back(report::Paragraph{found_on(r, done, m)});
    add_checks(r, done);
}

}   // namespace meshfolio::reproductions
