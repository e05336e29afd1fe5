// Smoothing experiments of earlier reports: pictures, table and what was found.
#include "questions/reproductions/parts.h"

namespace meshfolio::reproductions {

namespace {

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

/// Positions that have left the picture, made small enough for it and moved back, and how many times larger they are.
struct Scaled {
    Positions X;
    double times;
};
Scaled scaled_into(const ExperimentMesh& mesh, const Positions& X) {
    const Box there = bounding_box(moved_to(mesh.mesh(), X));
    const double times = std::max(1.0, there.diagonal() / mesh.diagonal);
    const Eigen::RowVector3d from = there.centre().transpose(), to = bounding_box(mesh.mesh()).centre().transpose();
    return {((X.rowwise() - from) / times).rowwise() + to, times};
}

std::string run_label(const Experiment& e, const ExperimentRun& run, const Shown& shown) {
    std::string label = variant_text(e, run.kind, run.area, run.method) + ", λ = " + given_text(e, run.given);
    if (e.lambda_unit != StepUnit::tau) label += " = " + chosen_text(run.share()) + " λ_crit";
    label += ", t = " + std::to_string(shown.iteration);
    if (shown.reached) return label;
    const bool collapsed = run.run.result.collapse_iteration == shown.iteration + 1;
    return words.line(collapsed ? "run.before_collapse" : "run.last_in_view", "run"_a = label);
}

void add_figure_of(const Reproduction& r, const SmoothingExperiment& done, std::size_t m) {
    const Experiment& e = r.experiment;
    const ExperimentMesh& mesh = done.meshes[m];
    const ExperimentColour colour = e.colours.front();
    output::FigureRequest figure = figure_on(r, mesh, "before");
    Names shrunk;   // too small to be seen
    const auto add_panel = [&](const Positions& X, std::string label) {
        figure.panels.push_back(panel_of(moved_to(mesh.mesh(), X), figure.id + "_" + std::to_string(figure.panels.size()), std::move(label),
                                         colours_of(mesh, colour, X)));
    };
    for (const ExperimentRun& run : done.runs) {
        if (run.mesh != m) continue;
        // A run that has left the picture is shown as it was before, if it has made a step, and as it is after.
        bool ended = run.run.in_view_iteration == 0;
        for (std::size_t i = 0; i < e.iterations.size() && !ended; ++i) {
            const Shown shown = shown_at(run, i, e.iterations[i]);
            const std::string label = run_label(e, run, shown);
            ended = !shown.reached;
            if (has_shrunk_away(mesh, *shown.X)) {
                shrunk.push_back(label);
                continue;
            }
            add_panel(*shown.X, label);
        }
        if (run.run.out_of_view.size() == 0) continue;
        const Scaled after = scaled_into(mesh, run.run.out_of_view);
        const std::string label = run_label(e, run, {&after.X, run.run.in_view_iteration + 1, true});
        add_panel(after.X, words.line("run.scaled", "run"_a = label, "times"_a = chosen_text(after.times)));
    }
    figure.range = range_of(r, colour, {figure.panels.front()});
    std::string caption = words.line("smoothed.caption", "file"_a = figure.subtitle);
    if (figure.range) caption += " " + words.line("smoothed.caption.colours", "quantity"_a = figure.range->quantity);
    if (!shrunk.empty()) caption += " " + words.line("smoothed.caption.shrunk", "runs"_a = listed(shrunk));
    add_figure(r.answer, std::move(figure), std::move(caption));
}

/// A row of the table: a run at one of the experiment's iterations.
struct Snapshot {
    const ExperimentRun& run;
    const ExperimentMesh& mesh;
    std::size_t index;   // of the iteration
    int iteration;
    double energy = std::nan(""), volume = std::nan("");   // over those of the input; NaN: the run had ended, or the mesh is open
    std::optional<MeshDifference> moved = {};              // none: the run had ended
};

std::vector<Snapshot> snapshots_of(const SmoothingExperiment& done, const Experiment& e) {
    std::vector<Snapshot> rows;
    for (const ExperimentRun& run : done.runs) {
        for (std::size_t i = 0; i < e.iterations.size(); ++i) {
            Snapshot& row = rows.emplace_back(Snapshot{run, done.meshes[run.mesh], i, e.iterations[i]});
            if (i >= run.run.snapshots.size()) continue;
            row.energy = run.run.energy[row.iteration];
            if (!run.run.volume.empty()) row.volume = run.run.volume[row.iteration];
            row.moved = compare_meshes(row.mesh.mesh(), moved_to(row.mesh.mesh(), run.run.snapshots[i]));
        }
    }
    return rows;
}

std::string outcome_of(const Snapshot& row) {
    const Smoothed& result = row.run.run.result;
    if (!row.moved && result.blew_up) return words.line("outcome.blown_up", "iteration"_a = result.blow_up_iteration);
    if (!row.moved && result.collapse_iteration > 0) return words.line("outcome.collapsed", "iteration"_a = result.collapse_iteration);
    if (has_shrunk_away(row.mesh, row.run.run.snapshots[row.index])) return words.line("outcome.shrunk");
    return words.line(row.energy > 1 ? "outcome.rougher" : "outcome.smoother");
}

report::Table run_table(const Reproduction& r, const SmoothingExperiment& done) {
    const Experiment& e = r.experiment;
    const auto moved = [](const Snapshot& row) {
        return row.moved ? report::Cell(100 * row.moved->rms / row.mesh.diagonal) : report::Cell();
    };
    const auto inverted = [](const Snapshot& row) { return row.moved ? report::Cell(double(row.moved->inverted_faces)) : report::Cell(); };
    return table(r.id_of("runs"), words.line("runs"), snapshots_of(done, e))
        .column("mesh", [](auto& row) { return row.mesh.name(); })
        .column("steps", [&](auto& row) { return variant_text(e, row.run.kind, row.run.area, row.run.method); })
        .column("λ, report", [&](auto& row) { return given_text(e, row.run.given); })
        .column("λ, here", [](auto& row) { return row.run.run.lambda; })
        .column("λ/λ_crit", [](auto& row) { return row.run.share(); })
        .column("iterations", {.digits = 6}, &Snapshot::iteration)
        .column("energy", {.unit = "of input"}, [](auto& row) { return cell_of(row.energy); })
        .column("moved", {.unit = "% of box"}, moved)
        .column("volume", {.unit = "% of input", .digits = 4}, [](auto& row) { return cell_of(100 * row.volume); })
        .column("inverted faces", {.digits = 6}, inverted)
        .column("outcome", [](auto& row) { return outcome_of(row); });
}

// ---- what was found ---------------------------------------------------------------------------------------------------

using Runs = std::vector<const ExperimentRun*>;

bool is_explicit(const ExperimentRun& run) { return run.method.scheme == SmoothingScheme::explicit_euler; }
double last_energy(const ExperimentRun* run) { return run->run.energy.back(); }

/// In which iterations they blew up. @param blown  at least one
std::string ends_text(const Runs& blown) {
    const auto [first, last] =
        std::ranges::minmax(each_of(blown, [](const ExperimentRun* run) { return run->run.result.blow_up_iteration; }));
    return span_of(std::to_string(first), std::to_string(last));
}

/// What became of some runs: how many, at which shares of the limit, and their energies or the iterations they ended in.
void tell_runs(report::Text& text, const Runs& runs, std::string_view what) {
    if (runs.empty()) return;
    Runs blown, whole;
    for (const ExperimentRun* run : runs) (run->run.result.blew_up ? blown : whole).push_back(run);
    const std::string_view key = blown.empty() ? "runs.whole" : whole.empty() ? "runs.blown" : "runs.both";
    tell(text, words.say(key, "what"_a = words.line(what), "shares"_a = range_text(each_of(runs, &ExperimentRun::share)),
                         "whole"_a = whole.size(), "energies"_a = whole.empty() ? "" : range_text(each_of(whole, last_energy)),
                         "blown"_a = blown.size(), "ends"_a = blown.empty() ? "" : ends_text(blown)));
}

/// Tells how far the top mode (λμ_max = 2λ/λ_crit) grew in runs beyond the limit that ended with less energy.
void tell_hidden_growth(report::Text& text, const Runs& beyond) {
    Runs hidden;
    for (const ExperimentRun* run : beyond)
        if (!run->run.result.blew_up && last_energy(run) < 1) hidden.push_back(run);
    if (hidden.empty()) return;
    const auto growth = [](const ExperimentRun* run) { return std::pow(2 * run->share() - 1, run->run.result.iterations); };
    tell(text, words.say("runs.hidden_growth", "growth"_a = range_text(each_of(hidden, growth))));
}

/// The gap between explicit and implicit runs at the same λ, against how far they moved.
void tell_pairs(report::Text& text, const SmoothingExperiment& done, std::size_t m) {
    for (const ExperimentRun& a : done.runs) {
        for (const ExperimentRun& b : done.runs) {
            const bool pair = a.mesh == m && b.mesh == m && is_explicit(a) && b.method.scheme == SmoothingScheme::implicit_euler &&
                              a.method.rebuild == b.method.rebuild && a.kind == b.kind && a.area == b.area && a.run.lambda == b.run.lambda;
            if (!pair || a.run.result.blew_up || a.run.snapshots.empty() || b.run.snapshots.empty()) continue;
            const double percent = 100 / done.meshes[m].diagonal;
            const double apart = vertex_rms(a.run.snapshots.back(), b.run.snapshots.back());
            tell(text, words.say("runs.pair", "share"_a = readable(a.share()), "apart"_a = readable(percent * apart),
                                 "explicit"_a = readable(percent * a.run.moved.rms), "implicit"_a = readable(percent * b.run.moved.rms)));
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
    tell(text, words.say("runs.equal_times", "pairs"_a = gaps.size(), "gaps"_a = range_text(gaps), "moves"_a = range_text(moves)));
}

report::Text found_on(const Reproduction& r, const SmoothingExperiment& done, std::size_t m) {
    report::Text text = words.say("found_on", "mesh"_a = done.meshes[m].name());
    const auto chosen = [&](auto choice) {
        Runs runs;
        for (const ExperimentRun& run : done.runs)
            if (run.mesh == m && choice(run)) runs.push_back(&run);
        return runs;
    };
    const auto frozen = [](const ExperimentRun& run) { return is_explicit(run) && !run.method.rebuild; };
    tell_runs(text, chosen([&](auto& run) { return frozen(run) && run.share() <= 1; }), "runs.within_limit");
    const Runs beyond = chosen([&](auto& run) { return frozen(run) && run.share() > 1; });
    tell_runs(text, beyond, "runs.beyond_limit");
    tell_hidden_growth(text, beyond);
    const Runs rebuilt = chosen([](auto& run) { return is_explicit(run) && run.method.rebuild; });
    tell_runs(text, rebuilt, "runs.rebuilt");
    if (!rebuilt.empty()) tell(text, words.say("runs.rebuilt_chaos"));
    tell_runs(text, chosen([](auto& run) { return run.method.scheme == SmoothingScheme::implicit_euler; }), "runs.implicit");
    tell_runs(text, chosen([](auto& run) { return run.method.scheme == SmoothingScheme::taubin; }), "runs.taubin");
    tell_pairs(text, done, m);
    tell_equal_times(text, r.experiment, done, m);
    for (const UsableStep& usable : done.usable) {
        if (usable.mesh != m) continue;
        tell(text, words.say("runs.usable", "steps"_a = usable.iterations, "lambda"_a = readable(usable.lambda),
                             "share"_a = readable(usable.lambda / usable.critical, 4)));
    }
    return text;
}

void add_checks(const Reproduction& r, const SmoothingExperiment& done) {
    for (const ExperimentRun& run : done.runs) {
        const bool decays = run.method.scheme == SmoothingScheme::implicit_euler || run.share() < 1;
        if (!decays || run.method.rebuild || run.method.scheme == SmoothingScheme::taubin) continue;
        const std::string name = words.line("check.energy", "method"_a = name_of(run.method), "share"_a = plain_text(run.share(), 3),
                                            "mesh"_a = done.meshes[run.mesh].name(), "where"_a = r.where());
        add(r.section(), energy_check(name, run.run));
    }
}

}   // namespace

void add_smoothing_reproduction(const Reproduction& r, const SmoothingExperiment& done) {
    add_opening(r, done.meshes);
    for (std::size_t m = 0; m < done.meshes.size(); ++m) add_figure_of(r, done, m);
    add(r.section(), run_table(r, done));
    for (std::size_t m = 0; m < done.meshes.size(); ++m) add_paragraphs(r.section(), {found_on(r, done, m)});
    add_checks(r, done);
}

}   // namespace meshfolio::reproductions
