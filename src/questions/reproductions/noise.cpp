// Denoising experiments of earlier reports: figures, error curves, table and results in words.
#include <set>

#include "questions/bench/denoising_search.h"
#include "questions/reproductions/study.h"

namespace meshfolio::reproductions {

namespace {

/// True for runs that differ in their noise alone.
bool same_curve(const Variant& a, const Variant& b) { return a == b; }

/// Adds a figure with the noisy mesh of each level, and each run at the experiment's iterations.
void add_denoising_figure(const Reproduction& r, const Done<NoisyRun>& done, const ExperimentMesh& mesh) {
    const Experiment& e = r.experiment;
    output::FigureRequest figure = figure_on(r, mesh, "original");
    for (const double noise : e.noise) {
        const std::string with = "σ = " + noise_text(e, noise);
        bool first = true;
        for (const NoisyRun& run : done.results) {
            if (run.mesh != &mesh || run.noise != noise) continue;
            if (std::exchange(first, false)) add_panel(figure, r, mesh, run.noisy_X, "noisy, " + with);
            for (std::size_t i = 0; i < run.snapshots.size(); ++i)
                add_panel(figure, r, mesh, run.snapshots[i], run_text(e, run) + ", " + with + ", t = " + std::to_string(e.iterations[i]));
        }
    }
    figure.range = range_of(r, e.colours.front(), figure.panels);
    add_figure(r.answer, figure, words.line("denoised.caption", "file"_a = figure.subtitle));
}

/// The first run of the variant with minima nearest to those of the report; on stand-ins, which have other triangles, the first variant.
const NoisyRun& shown_variant(const Done<NoisyRun>& done) {
    const NoisyRun* nearest = &done.results.front();
    double least = infinity;
    for (const NoisyRun& candidate : done.results) {
        if (candidate.mesh->stand_in) continue;
        double gap = 0;
        for (const NoisyRun& run : done.results)
            if (same_curve(run, candidate) && run.minimum_said > 0) gap += std::abs(run.best - run.minimum_said);
        if (gap >= least) continue;
        least = gap;
        nearest = &candidate;
    }
    return *nearest;
}

/// Adds the error curves of a variant, and a figure of the meshes at the report's iterations and at those with the smallest error.
void add_error_curves(const Reproduction& r, const Done<NoisyRun>& done, const NoisyRun& chosen) {
    const Experiment& e = r.experiment;
    const ExperimentMesh& mesh = *chosen.mesh;
    const std::string_view key = done.results.size() <= e.noise.size() ? "error.caption"
                                 : mesh.stand_in                       ? "error.caption.first"
                                                                       : "error.caption.nearest";
    report::Plot plot{.id = r.id_of(mesh.name + "_error"),
                      .caption = words.line(key, "mesh"_a = mesh.name, "run"_a = run_text(e, chosen)),
                      .x_label = "iteration",
                      .y_label = "rms error [% of box diagonal]"};
    output::FigureRequest figure = figure_on(r, mesh, "original");
    for (const NoisyRun& run : done.results) {
        if (!same_curve(run, chosen)) continue;
        report::Series& series = plot.series.emplace_back(report::Series{.name = "σ = " + noise_text(e, run.noise)});
        for (int t = 0; t <= run.last(); ++t) add_point(series, t, run.percent(t));
        plot.markers.push_back({double(run.best), run.percent(run.best), "smallest, t = " + std::to_string(run.best)});
        if (run.collapse_iteration > 0)
            plot.markers.push_back(
                {double(run.last()), run.percent(run.last()), words.line("outcome.collapsed", "iteration"_a = run.collapse_iteration)});

        const auto label = [&](std::string_view panel, int iteration) {
            return words.line(panel, "noise"_a = noise_text(e, run.noise), "iteration"_a = iteration);
        };
        const auto index = static_cast<std::size_t>(std::ranges::find(e.iterations, run.minimum_said) - e.iterations.begin());
        if (index < run.snapshots.size()) add_panel(figure, r, mesh, run.snapshots[index], label("minimum.said", run.minimum_said));
        add_panel(figure, r, mesh, run.best_X, label("minimum.here", run.best));
    }
    add(r.section(), std::move(plot));
    figure.range = range_of(r, e.colours.front(), figure.panels);
    add_figure(r.answer, figure, words.line("minimum.caption", "file"_a = figure.subtitle, "run"_a = run_text(e, chosen)));
}

std::string outcome_of(const NoisyRun& run) {
    if (run.blew_up) return words.line("outcome.blew_up", "iteration"_a = run.blow_up_iteration);
    const std::string outcome = run.best == 0 ? "harms" : run.gain() >= works ? "works" : run.gain() >= helps ? "helps" : "fails";
    return run.collapse_iteration > 0 ? words.line("outcome.collapsed_too", "outcome"_a = outcome, "iteration"_a = run.collapse_iteration)
                                      : outcome;
}

/// A table of each run at the iterations of the experiment that it reached; of an error curve, at its end alone.
report::Table noise_table(const Reproduction& r, const Done<NoisyRun>& done) {
    const Experiment& e = r.experiment;
    struct Row {
        const NoisyRun& run;
        int iteration;
    };
    std::vector<Row> rows;
    for (const NoisyRun& run : done.results) {
        std::vector<int> iterations = each_once(each_of(e.iterations, [&](int t) { return std::min(t, run.last()); }));
        if (e.kind == ExperimentKind::error_curve) iterations = {run.last()};
        for (const int t : iterations) rows.push_back({run, t});
    }
    const report::Column in_box{.unit = "% of box"}, in_degrees{.unit = "°"};
    auto built = table(r.id_of("errors"), words.line("errors"), rows);
    built.column("mesh", [](auto& row) { return row.run.mesh->name; })
        .column("steps", [&](auto& row) { return variant_text(e, row.run); })
        .column("λ, report", [&](auto& row) { return given_text(e, row.run.given); })
        .column("λ, here", [](auto& row) { return row.run.lambda; })
        .column("σ, report", [&](auto& row) { return noise_text(e, row.run.noise); })
        .column("σ", {.unit = "mean edges"}, [](auto& row) { return std::sqrt(row.run.sigma.squaredNorm() / 3) / row.run.mesh->mean_edge; })
        .column("error, noisy", in_box, [](auto& row) { return row.run.percent(0); })
        .column("iterations", {.digits = 6}, &Row::iteration)
        .column("error there", in_box, [](auto& row) { return row.run.percent(row.iteration); });
    if (e.kind == ExperimentKind::error_curve)
        built.column("minimum, report", {.digits = 6}, [](auto& row) { return cell_of(row.run.minimum_said, row.run.minimum_said > 0); });
    return built.column("smallest at iteration", {.digits = 6}, [](auto& row) { return row.run.best; })
        .column("smallest", in_box, [](auto& row) { return row.run.percent(row.run.best); })
        .column("gain", {.unit = "×"}, [](auto& row) { return row.run.gain(); })
        .column("normals, noisy", in_degrees, [](auto& row) { return 180 / pi * row.run.noisy_angle; })
        .column("normals, last", in_degrees, [](auto& row) { return 180 / pi * row.run.last_angle; })
        .column("outcome", [](auto& row) { return outcome_of(row.run); });
}

/// Describes a run by its smallest error.
report::Text about_run(const Experiment& e, const NoisyRun& run) {
    const auto percent = [&](int t) { return readable(run.percent(t)); };
    const std::string_view key = run.blew_up              ? "run.blew_up"
                                 : run.best == 0          ? "run.harmed"
                                 : run.best == run.last() ? "run.falling"
                                                          : "run.least";
    return words.say(key, "run"_a = sentence_case(run_text(e, run)), "noise"_a = noise_text(e, run.noise),
                     "blow_up"_a = run.blow_up_iteration, "before"_a = percent(0), "after"_a = percent(run.last()),
                     "iterations"_a = run.last(), "best"_a = run.best, "least"_a = percent(run.best),
                     "collapse"_a = run.collapse_iteration);
}

/// Adds the minima of each variant on the mesh, over the noise levels.
void add_minima(report::Text& text, const Experiment& e, const Done<NoisyRun>& done, const ExperimentMesh& mesh) {
    for (const NoisyRun& first : done.results) {
        const auto same = [&](const NoisyRun& run) { return same_curve(run, first); };
        if (first.mesh != &mesh || &first != &*std::ranges::find_if(done.results, same)) continue;
        Names minima;
        bool later = true;
        int previous = -1;
        for (const NoisyRun& run : done.results) {
            if (!same(run)) continue;
            const std::string_view key = run.collapse_iteration > 0 ? "minima.collapsed" : "minima.last";
            minima.push_back(run.best == run.last() ? words.line(key, "iteration"_a = run.best) : std::to_string(run.best));
            later = later && run.best > previous;
            previous = run.best;
        }
        const bool ascending = minima.size() > 1 && std::ranges::is_sorted(e.noise);
        const std::string_view key = !ascending ? "minima" : later ? "minima.later" : "minima.not_later";
        add_sentence(text, words.say(key, "run"_a = sentence_case(run_text(e, first)), "minima"_a = listed(minima)));
    }
}

}   // namespace

void add_noisy_reproduction(const Reproduction& r, const Done<NoisyRun>& done) {
    add_opening(r, done.meshes);
    const bool curve = r.experiment.kind == ExperimentKind::error_curve;
    if (curve) add_error_curves(r, done, shown_variant(done));
    for (const ExperimentMesh& mesh : done.meshes)
        if (!curve) add_denoising_figure(r, done, mesh);
    add(r.section(), noise_table(r, done));
    for (const ExperimentMesh& mesh : done.meshes) {
        report::Text text = words.say("found_on", "mesh"_a = mesh.name);
        if (curve) add_minima(text, r.experiment, done, mesh);
        add_paragraphs(r.section(), {text});
        report::BulletList list;
        for (const NoisyRun& run : done.results)
            if (run.mesh == &mesh && !curve) list.items.push_back(about_run(r.experiment, run));
        if (!curve) add(r.section(), list);
    }
    std::set<std::pair<const ExperimentMesh*, double>> checked;   // the noise of each level on each mesh
    for (const NoisyRun& run : done.results) {
        if (run.noise == 0 || !checked.insert({run.mesh, run.noise}).second) continue;
        // The squares of 3n normal numbers with these weights: five standard deviations of their mean.
        const Vector3 squares = run.sigma.cwiseAbs2();
        const double spread = std::sqrt(2.0 / run.mesh->mesh().vertex_count()) * squares.norm() / squares.sum();
        const std::string name =
            words.line("check.noise", "noise"_a = noise_text(r.experiment, run.noise), "mesh"_a = run.mesh->name, "where"_a = r.where());
        add(r.section(), check_near(name, 1, run.rms.front() * run.rms.front() / squares.sum(), 5 * spread));
    }
}

}   // namespace meshfolio::reproductions
