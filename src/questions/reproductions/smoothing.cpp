// Smoothing experiments of earlier reports: figures, table and results in words.
#include "questions/reproductions/study.h"

namespace meshfolio::reproductions {

namespace {

/// True if the positions cover at most a few pixels of the picture.
bool has_shrunk_away(const ExperimentMesh& mesh, const Positions& X) {
    return bounding_box(moved_to(mesh.mesh(), X)).diagonal() < 0.01 * mesh.diagonal;
}

/// Adds a figure of the mesh before and after each run, at the experiment's iterations. A run that leaves the picture is shown as it was
/// before, if it has made a step, and as it is after, made small enough.
void add_run_figure(const Reproduction& r, const SmoothingExperiment& done, const ExperimentMesh& mesh) {
    const Experiment& e = r.experiment;
    output::FigureRequest figure = figure_on(r, mesh, "before");
    Names shrunk;   // too small to be seen
    for (const ExperimentRun& run : done.results) {
        if (run.mesh != &mesh) continue;
        const auto label_at = [&](int iteration) {
            const std::string share = e.lambda_unit == StepUnit::tau ? "" : " = " + chosen_text(run.share()) + " λ_crit";
            return run_text(e, run) + share + ", t = " + std::to_string(iteration);
        };
        const SmoothingRun& s = run.run;
        for (std::size_t i = 0; i < e.iterations.size() && s.in_view_iteration > 0; ++i) {
            const bool in_view = i < s.snapshots.size() && e.iterations[i] <= s.in_view_iteration;
            const Positions& X = in_view ? s.snapshots[i] : s.in_view;
            std::string label = label_at(in_view ? e.iterations[i] : s.in_view_iteration);
            const bool collapsed = s.result.collapse_iteration == s.in_view_iteration + 1;
            if (!in_view) label = words.line(collapsed ? "run.before_collapse" : "run.last_in_view", "run"_a = label);
            if (has_shrunk_away(mesh, X)) shrunk.push_back(label);
            else add_panel(figure, r, mesh, X, label);
            if (!in_view) break;
        }
        if (s.out_of_view.size() == 0) continue;
        const Box there = bounding_box(moved_to(mesh.mesh(), s.out_of_view));
        const double times = std::max(1.0, there.diagonal() / mesh.diagonal);
        const Eigen::RowVector3d from = there.centre().transpose(), to = bounding_box(mesh.mesh()).centre().transpose();
        const Positions small = ((s.out_of_view.rowwise() - from) / times).rowwise() + to;
        const std::string label = label_at(s.in_view_iteration + 1);
        add_panel(figure, r, mesh, small, words.line("run.scaled", "run"_a = label, "times"_a = chosen_text(times)));
    }
    figure.range = range_of(r, e.colours.front(), {figure.panels.front()});
    std::string caption = words.line("smoothed.caption", "file"_a = figure.subtitle);
    if (figure.range) caption += " " + words.line("smoothed.caption.colours", "quantity"_a = figure.range->quantity);
    if (!shrunk.empty()) caption += " " + words.line("smoothed.caption.shrunk", "runs"_a = listed(shrunk));
    add_figure(r.answer, std::move(figure), std::move(caption));
}

/// A run at one of the experiment's iterations; NaN if the run had ended.
struct Snapshot {
    const ExperimentRun& run;
    int iteration;
    double energy = undefined, volume = undefined;    // over those of the input; no volume of an open mesh
    double moved = undefined, inverted = undefined;   // rms [% of box diagonal]; faces
    std::string outcome = {};
};
std::vector<Snapshot> snapshots_of(const SmoothingExperiment& done, const Experiment& e) {
    std::vector<Snapshot> rows;
    for (const ExperimentRun& run : done.results) {
        const Smoothed& result = run.run.result;
        const TriangleMesh& mesh = run.mesh->mesh();
        for (std::size_t i = 0; i < e.iterations.size(); ++i) {
            Snapshot& row = rows.emplace_back(Snapshot{run, e.iterations[i]});
            if (i >= run.run.snapshots.size()) {
                row.outcome = result.blew_up ? words.line("outcome.blown_up", "iteration"_a = result.blow_up_iteration)
                                             : words.line("outcome.collapsed", "iteration"_a = result.collapse_iteration);
                continue;
            }
            row.energy = run.run.energy[row.iteration];
            if (!run.run.volume.empty()) row.volume = run.run.volume[row.iteration];
            const MeshDifference moved = compare_meshes(mesh, moved_to(mesh, run.run.snapshots[i]));
            row.moved = 100 * moved.rms / run.mesh->diagonal;
            row.inverted = moved.inverted_faces;
            row.outcome = words.line(has_shrunk_away(*run.mesh, run.run.snapshots[i]) ? "outcome.shrunk"
                                     : row.energy > 1                                 ? "outcome.rougher"
                                                                                      : "outcome.smoother");
        }
    }
    return rows;
}

// ---- results in words -------------------------------------------------------------------------------------------------

using Runs = std::vector<const ExperimentRun*>;

double last_energy(const ExperimentRun* run) { return run->run.energy.back(); }

/// Adds the number of these runs that blew up, their shares of the limit, and their energies or the iterations in which they blew up.
void add_outcome(report::Text& text, const Runs& runs, std::string_view what) {
    if (runs.empty()) return;
    Runs whole;
    std::vector<int> blow_ups;
    for (const ExperimentRun* run : runs)
        if (run->run.result.blew_up) blow_ups.push_back(run->run.result.blow_up_iteration);
        else whole.push_back(run);
    std::string ends;
    if (!blow_ups.empty()) {
        const auto [first, last] = std::ranges::minmax(blow_ups);
        ends = span_of(std::to_string(first), std::to_string(last));
    }
    const std::string_view key = blow_ups.empty() ? "runs.whole" : whole.empty() ? "runs.blown" : "runs.both";
    add_sentence(text, words.say(key, "what"_a = words.line(what), "shares"_a = range_text(each_of(runs, &ExperimentRun::share)),
                                 "whole"_a = whole.size(), "energies"_a = whole.empty() ? "" : range_text(each_of(whole, last_energy)),
                                 "blown"_a = blow_ups.size(), "ends"_a = ends));
}

/// Adds the gaps between explicit and implicit runs with the same λ, and between runs of one kind with the same diffusion time λt.
void add_comparisons(report::Text& text, const Experiment& e, const Runs& runs) {
    std::vector<double> gaps, moves;   // [% of the box diagonal]
    for (const ExperimentRun* a : runs) {
        for (const ExperimentRun* b : runs) {
            const std::vector<Positions>&of_a = a->run.snapshots, &of_b = b->run.snapshots;
            const double percent = a->mesh->percent();
            const bool alike = a->kind == b->kind && a->area == b->area;
            const bool pair = alike && a->is(SmoothingScheme::explicit_euler) && b->is(SmoothingScheme::implicit_euler) &&
                              a->method.rebuild == b->method.rebuild && a->run.lambda == b->run.lambda;
            if (pair && !a->run.result.blew_up && !of_a.empty() && !of_b.empty())
                add_sentence(text, words.say("runs.pair", "share"_a = readable(a->share()),
                                             "apart"_a = readable(percent * vertex_rms(of_a.back(), of_b.back())),
                                             "explicit"_a = readable(percent * a->run.moved.rms),
                                             "implicit"_a = readable(percent * b->run.moved.rms)));
            if (!alike || a->method != b->method || !(a->run.lambda < b->run.lambda)) continue;
            for (std::size_t i = 0; i < of_a.size(); ++i)
                for (std::size_t j = 0; j < of_b.size(); ++j) {
                    if (std::abs(a->run.lambda * e.iterations[i] / (b->run.lambda * e.iterations[j]) - 1) > 1e-9) continue;
                    gaps.push_back(percent * vertex_rms(of_a[i], of_b[j]));
                    moves.push_back(percent * vertex_rms(a->mesh->mesh().X, of_b[j]));
                }
        }
    }
    if (gaps.empty()) return;
    add_sentence(text, words.say("runs.equal_times", "pairs"_a = gaps.size(), "gaps"_a = range_text(gaps), "moves"_a = range_text(moves)));
}

report::Text runs_found(const Experiment& e, const SmoothingExperiment& done, const ExperimentMesh& mesh) {
    report::Text text = words.say("found_on", "mesh"_a = mesh.name);
    const auto chosen = [&](auto choice) {
        Runs runs;
        for (const ExperimentRun& run : done.results)
            if (run.mesh == &mesh && choice(run)) runs.push_back(&run);
        return runs;
    };
    const auto frozen = [](const ExperimentRun& run) { return run.is(SmoothingScheme::explicit_euler) && !run.method.rebuild; };
    add_outcome(text, chosen([&](auto& run) { return frozen(run) && run.share() <= 1; }), "runs.within_limit");
    add_outcome(text, chosen([&](auto& run) { return frozen(run) && run.share() > 1; }), "runs.beyond_limit");

    std::vector<double> growths;   // of the top mode, λμ_max = 2λ/λ_crit, in runs beyond the limit that ended with less energy
    for (const ExperimentRun* run : chosen([&](auto& r) { return frozen(r) && r.share() > 1 && !r.run.result.blew_up; }))
        if (last_energy(run) < 1) growths.push_back(std::pow(2 * run->share() - 1, run->run.result.iterations));
    if (!growths.empty()) add_sentence(text, words.say("runs.hidden_growth", "growth"_a = range_text(growths)));

    const Runs rebuilt = chosen([](auto& run) { return run.is(SmoothingScheme::explicit_euler) && run.method.rebuild; });
    add_outcome(text, rebuilt, "runs.rebuilt");
    if (!rebuilt.empty()) add_sentence(text, words.say("runs.rebuilt_chaos"));
    add_outcome(text, chosen([](auto& run) { return run.is(SmoothingScheme::implicit_euler); }), "runs.implicit");
    add_outcome(text, chosen([](auto& run) { return run.is(SmoothingScheme::taubin); }), "runs.taubin");
    add_comparisons(text, e, chosen([](auto&) { return true; }));
    for (const auto& usable : done.usable)
        if (usable.mesh == &mesh)
            add_sentence(text, words.say("runs.usable", "steps"_a = e.iterations.back(), "lambda"_a = readable(usable.lambda),
                                         "share"_a = readable(usable.lambda / usable.critical, 4)));
    return text;
}

}   // namespace

void add_smoothing_reproduction(const Reproduction& r, const SmoothingExperiment& done) {
    add_opening(r, done.meshes);
    for (const ExperimentMesh& mesh : done.meshes) add_run_figure(r, done, mesh);
    add(r.section(), table(r.id_of("runs"), words.line("runs"), snapshots_of(done, r.experiment))
                         .column("mesh", [](auto& row) { return row.run.mesh->name; })
                         .column("steps", [&](auto& row) { return variant_text(r.experiment, row.run); })
                         .column("λ, report", [&](auto& row) { return given_text(r.experiment, row.run.given); })
                         .column("λ, here", [](auto& row) { return row.run.run.lambda; })
                         .column("λ/λ_crit", [](auto& row) { return row.run.share(); })
                         .column("iterations", {.digits = 6}, &Snapshot::iteration)
                         .column("energy", {.unit = "of input"}, [](auto& row) { return cell_of(row.energy); })
                         .column("moved", {.unit = "% of box"}, [](auto& row) { return cell_of(row.moved); })
                         .column("volume", {.unit = "% of input", .digits = 4}, [](auto& row) { return cell_of(100 * row.volume); })
                         .column("inverted faces", {.digits = 6}, [](auto& row) { return cell_of(row.inverted); })
                         .column("outcome", &Snapshot::outcome));
    for (const ExperimentMesh& mesh : done.meshes) add_paragraphs(r.section(), {runs_found(r.experiment, done, mesh)});
    for (const ExperimentRun& run : done.results) {
        const bool decays = run.is(SmoothingScheme::implicit_euler) || (run.is(SmoothingScheme::explicit_euler) && run.share() < 1);
        if (!decays || run.method.rebuild) continue;
        const std::string name = words.line("check.energy", "method"_a = name_of(run.method), "share"_a = plain_text(run.share(), 3),
                                            "mesh"_a = run.mesh->name, "where"_a = r.where());
        add(r.section(), energy_check(name, run.run));
    }
}

}   // namespace meshfolio::reproductions
