// Denoising experiments of earlier reports: pictures, error curves, table and what was found.
#include <limits>

#include "questions/bench/denoising_search.h"
#include "questions/reproductions/parts.h"

namespace meshfolio::reproductions {

namespace {

double percent_of(const NoisyExperiment& done, const NoisyRun& run) { return 100 / done.meshes[run.mesh].diagonal; }
int last_iteration(const NoisyRun& run) { return static_cast<int>(run.rms.size()) - 1; }
bool same_curve(const NoisyRun& a, const NoisyRun& b) {
    return a.mesh == b.mesh && a.method == b.method && a.kind == b.kind && a.area == b.area && a.given == b.given;
}

std::string run_label(const Experiment& e, const NoisyRun& run) {
    return variant_text(e, run.kind, run.area, run.method) + ", λ = " + given_text(e, run.given);
}

output::Panel panel_at(const Reproduction& r, const NoisyExperiment& done, const NoisyRun& run, const Positions& X, std::string name,
                       std::string label) {
    const ExperimentMesh& mesh = done.meshes[run.mesh];
    return panel_of(moved_to(mesh.mesh(), X), std::move(name), std::move(label), colours_of(mesh, r.experiment.colours.front(), X));
}

/// Shows for each noise level the noisy mesh and each run at the experiment's iterations.
void add_denoising_figure(const Reproduction& r, const NoisyExperiment& done, std::size_t m) {
    const Experiment& e = r.experiment;
    output::FigureRequest figure = figure_on(r, done.meshes[m], "original");
    const auto next_name = [&] { return figure.id + "_" + std::to_string(figure.panels.size()); };
    for (const double noise : e.noise) {
        bool first = true;
        for (const NoisyRun& run : done.runs) {
            if (run.mesh != m || run.noise != noise) continue;
            const std::string with = "σ = " + noise_text(e, noise);
            if (first) figure.panels.push_back(panel_at(r, done, run, run.noisy->X, next_name(), "noisy, " + with));
            first = false;
            for (std::size_t i = 0; i < run.snapshots.size(); ++i) {
                const std::string label = run_label(e, run) + ", " + with + ", t = " + std::to_string(e.iterations[i]);
                figure.panels.push_back(panel_at(r, done, run, run.snapshots[i], next_name(), label));
            }
        }
    }
    figure.range = range_of(r, e.colours.front(), figure.panels);
    add_figure(r.answer, figure, words.line("denoised.caption", "file"_a = figure.subtitle));
}

/// The variant whose minima are nearest to the report's, by its first run. On a stand-in, whose triangles differ, the first variant.
const NoisyRun& shown_variant(const NoisyExperiment& done) {
    const NoisyRun* nearest = &done.runs.front();
    double least = std::numeric_limits<double>::infinity();
    for (const NoisyRun& candidate : done.runs) {
        if (done.meshes[candidate.mesh].stand_in) continue;
        double gap = 0;
        for (const NoisyRun& run : done.runs)
            if (same_curve(run, candidate) && run.minimum_said > 0) gap += std::abs(run.best - run.minimum_said);
        if (gap >= least) continue;
        least = gap;
        nearest = &candidate;
    }
    return *nearest;
}

/// The original beside the meshes at the iterations of the report and at those with the smallest error.
void add_minimum_figure(const Reproduction& r, const NoisyExperiment& done, const NoisyRun& chosen) {
    const Experiment& e = r.experiment;
    output::FigureRequest figure = figure_on(r, done.meshes[chosen.mesh], "original");
    const auto add = [&](const NoisyRun& run, const Positions& X, int iteration, std::string_view key) {
        figure.panels.push_back(panel_at(r, done, run, X, figure.id + "_" + std::to_string(figure.panels.size()),
                                         words.line(key, "noise"_a = noise_text(e, run.noise), "iteration"_a = iteration)));
    };
    for (const NoisyRun& run : done.runs) {
        if (!same_curve(run, chosen)) continue;
        const auto index = static_cast<std::size_t>(std::ranges::find(e.iterations, run.minimum_said) - e.iterations.begin());
        if (index < run.snapshots.size()) add(run, run.snapshots[index], run.minimum_said, "minimum.said");
        add(run, run.best_X, run.best, "minimum.here");
    }
    figure.range = range_of(r, e.colours.front(), figure.panels);
    add_figure(r.answer, figure, words.line("minimum.caption", "file"_a = figure.subtitle, "run"_a = run_label(e, chosen)));
}

report::Plot error_plot(const Reproduction& r, const NoisyExperiment& done, const NoisyRun& chosen) {
    const Experiment& e = r.experiment;
    const ExperimentMesh& mesh = done.meshes[chosen.mesh];
    const std::string_view key = done.runs.size() <= e.noise.size() ? "error.caption"
                                 : mesh.stand_in                    ? "error.caption.first"
                                                                    : "error.caption.nearest";
    report::Plot plot{.id = r.id_of(mesh.name() + "_error"),
                      .caption = words.line(key, "mesh"_a = mesh.name(), "run"_a = run_label(e, chosen)),
                      .x_label = "iteration",
                      .y_label = "rms error [% of box diagonal]"};
    for (const NoisyRun& run : done.runs) {
        if (!same_curve(run, chosen)) continue;
        report::Series series{.name = "σ = " + noise_text(e, run.noise)};
        for (std::size_t t = 0; t < run.rms.size(); ++t) add_point(series, double(t), percent_of(done, run) * run.rms[t]);
        plot.series.push_back(std::move(series));
        plot.markers.push_back({double(run.best), percent_of(done, run) * run.rms[run.best], "smallest, t = " + std::to_string(run.best)});
        if (run.collapse_iteration > 0) {
            plot.markers.push_back({double(last_iteration(run)), percent_of(done, run) * run.rms.back(),
                                    words.line("outcome.collapsed", "iteration"_a = run.collapse_iteration)});
        }
    }
    return plot;
}

std::string outcome_of(const NoisyRun& run) {
    if (run.blew_up) return words.line("outcome.blew_up", "iteration"_a = run.blow_up_iteration);
    const std::string outcome = run.best == 0 ? "harms" : run.gain() >= works ? "works" : run.gain() >= helps ? "helps" : "fails";
    return run.collapse_iteration > 0 ? words.line("outcome.collapsed_too", "outcome"_a = outcome, "iteration"_a = run.collapse_iteration)
                                      : outcome;
}

/// A row of the table: a run after an iteration.
struct Reached {
    const NoisyRun& run;
    int iteration;
};

/// Takes the end of an error curve, else the iterations of the experiment that the run reached.
std::vector<Reached> reached_by(const NoisyExperiment& done, const Experiment& e) {
    std::vector<Reached> rows;
    for (const NoisyRun& run : done.runs) {
        const int end = last_iteration(run);
        std::vector<int> iterations;
        for (const int t : e.iterations) iterations.push_back(std::min(t, end));
        if (e.kind == ExperimentKind::error_curve || iterations.front() == end) iterations = {end};
        iterations.erase(std::unique(iterations.begin(), iterations.end()), iterations.end());   // Clang 14 knows no std::ranges::unique
        for (const int t : iterations) rows.push_back({run, t});
    }
    return rows;
}

report::Table noise_table(const Reproduction& r, const NoisyExperiment& done) {
    const Experiment& e = r.experiment;
    const report::Column in_box{.unit = "% of box"}, in_degrees{.unit = "°"};
    const auto rms = [&](const Reached& row, int t) { return percent_of(done, row.run) * row.run.rms[t]; };
    const auto edges = [&](const Reached& row) { return std::sqrt(row.run.sigma.squaredNorm() / 3) / done.meshes[row.run.mesh].mean_edge; };
    auto built = table(r.id_of("errors"), words.line("errors"), reached_by(done, e));
    built.column("mesh", [&](auto& row) { return done.meshes[row.run.mesh].name(); })
        .column("steps", [&](auto& row) { return variant_text(e, row.run.kind, row.run.area, row.run.method); })
        .column("λ, report", [&](auto& row) { return given_text(e, row.run.given); })
        .column("λ, here", [](auto& row) { return row.run.lambda; })
        .column("σ, report", [&](auto& row) { return noise_text(e, row.run.noise); })
        .column("σ", {.unit = "mean edges"}, edges)
        .column("error, noisy", in_box, [&](auto& row) { return rms(row, 0); })
        .column("iterations", {.digits = 6}, &Reached::iteration)
        .column("error there", in_box, [&](auto& row) { return rms(row, row.iteration); });
    if (e.kind == ExperimentKind::error_curve)
        built.column("minimum, report", {.digits = 6}, [](auto& row) { return cell_of(row.run.minimum_said, row.run.minimum_said > 0); });
    return built.column("smallest at iteration", {.digits = 6}, [](auto& row) { return row.run.best; })
        .column("smallest", in_box, [&](auto& row) { return rms(row, row.run.best); })
        .column("gain", {.unit = "×"}, [](auto& row) { return row.run.gain(); })
        .column("normals, noisy", in_degrees, [](auto& row) { return 180 / pi * row.run.noisy_angle; })
        .column("normals, last", in_degrees, [](auto& row) { return 180 / pi * row.run.last_angle; })
        .column("outcome", [](auto& row) { return outcome_of(row.run); });
}

// ---- what was found ---------------------------------------------------------------------------------------------------

report::Text about_run(const Reproduction& r, const NoisyExperiment& done, const NoisyRun& run) {
    const int end = last_iteration(run);
    const auto percent = [&](int t) { return readable(percent_of(done, run) * run.rms[t]); };
    const std::string_view key = run.blew_up ? "run.blew_up" : run.best == 0 ? "run.harmed" : run.best == end ? "run.falling" : "run.least";
    return words.say(key, "run"_a = sentence_case(run_label(r.experiment, run)), "noise"_a = noise_text(r.experiment, run.noise),
                     "blow_up"_a = run.blow_up_iteration, "before"_a = percent(0), "after"_a = percent(end), "iterations"_a = end,
                     "best"_a = run.best, "least"_a = percent(run.best), "collapse"_a = run.collapse_iteration);
}

report::BulletList told_runs(const Reproduction& r, const NoisyExperiment& done, std::size_t m) {
    report::BulletList list;
    for (const NoisyRun& run : done.runs)
        if (run.mesh == m) list.items.push_back(about_run(r, done, run));
    return list;
}

/// The minima of each variant beside those of the report.
void tell_minima(report::Text& text, const Reproduction& r, const NoisyExperiment& done, std::size_t m) {
    const bool ascending = std::ranges::is_sorted(r.experiment.noise);
    std::vector<const NoisyRun*> told;
    for (const NoisyRun& first : done.runs) {
        const auto seen = [&](const NoisyRun* other) { return same_curve(*other, first); };
        if (first.mesh != m || std::ranges::any_of(told, seen)) continue;
        told.push_back(&first);
        Names minima;
        bool later = true;
        int previous = -1;
        for (const NoisyRun& run : done.runs) {
            if (!same_curve(run, first)) continue;
            const std::string_view key = run.collapse_iteration > 0 ? "minima.collapsed" : "minima.last";
            minima.push_back(run.best == last_iteration(run) ? words.line(key, "iteration"_a = run.best) : std::to_string(run.best));
            later = later && run.best > previous;
            previous = run.best;
        }
        const std::string_view key = minima.size() < 2 || !ascending ? "minima" : later ? "minima.later" : "minima.not_later";
        tell(text, words.say(key, "run"_a = sentence_case(run_label(r.experiment, first)), "minima"_a = listed(minima)));
    }
}

void add_checks(const Reproduction& r, const NoisyExperiment& done) {
    for (const NoisyRun& run : done.runs) {
        const bool first = &run == &*std::ranges::find_if(done.runs, [&](const NoisyRun& other) {
            return other.mesh == run.mesh && other.noise == run.noise;
        });
        if (!first || run.noise == 0) continue;
        // The squares of 3n normal numbers with these weights: five standard deviations of their mean.
        const ExperimentMesh& mesh = done.meshes[run.mesh];
        const Vector3 squares = run.sigma.cwiseAbs2();
        const double spread = std::sqrt(2.0 / mesh.mesh().vertex_count()) * squares.norm() / squares.sum();
        const std::string name =
            words.line("check.noise", "noise"_a = noise_text(r.experiment, run.noise), "mesh"_a = mesh.name(), "where"_a = r.where());
        add(r.section(), check_near(name, 1, run.rms.front() * run.rms.front() / squares.sum(), 5 * spread));
    }
}

}   // namespace

void add_noisy_reproduction(const Reproduction& r, const NoisyExperiment& done) {
    add_opening(r, done.meshes);
    const bool curve = r.experiment.kind == ExperimentKind::error_curve;
    if (curve) {
        const NoisyRun& chosen = shown_variant(done);
        add(r.section(), error_plot(r, done, chosen));
        add_minimum_figure(r, done, chosen);
    }
    for (std::size_t m = 0; m < done.meshes.size() && !curve; ++m) add_denoising_figure(r, done, m);
    add(r.section(), noise_table(r, done));
    for (std::size_t m = 0; m < done.meshes.size(); ++m) {
        report::Text text = words.say("found_on", "mesh"_a = done.meshes[m].name());
        if (curve) tell_minima(text, r, done, m);
        add_paragraphs(r.section(), {text});
        if (!curve) add(r.section(), told_runs(r, done, m));
    }
    add_checks(r, done);
}

}   // namespace meshfolio::reproductions
