// Denoising experiments of earlier reports: pictures, error curves, table and what was found.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/six_view_figure.h"
#include "questions/reproductions/parts.h"

namespace meshfolio::reproductions {

namespace {

using report::check_near;
using report::math;

double percent_of(const NoisyExperiment& done, const NoisyRun& run) { return 100 / done.meshes[run.mesh].diagonal; }
double rms_at(const NoisyRun& run, int iteration) { return run.rms[static_cast<std::size_t>(iteration)]; }
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

SixViewFigure figure_frame(const Reproduction& r, const NoisyExperiment& done, std::size_t m) {
    const Experiment& e = r.experiment;
    const ExperimentMesh& mesh = done.meshes[m];
    SixViewFigure figure;
    figure.id = r.id_of(mesh.name());
    figure.title = e.from + ": " + e.name;
    figure.subtitle = mesh.used->input.file;
    figure.panels.push_back(panel_of(*mesh.used, figure.id + "_original", "original", colours_of(mesh, e.colours.front(), mesh.mesh().X)));
    return figure;
}

/// Of each level of noise the noisy mesh, and each run at the experiment's iterations.
void add_denoising_figure(const Reproduction& r, const NoisyExperiment& done, std::size_t m) {
    const Experiment& e = r.experiment;
    SixViewFigure figure = figure_frame(r, done, m);
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
    figure.caption = done.meshes[m].used->input.file + ", with noise and smoothed again; camera and scale are those of the original.";
    figure.range = range_of(r, e.colours.front(), figure.panels);
    add_figure(r.answer, std::move(figure));
}

/// On the report's own mesh the runs over whose curves the minima lie nearest to the report's: the first run of the curve's levels. The
/// report's iterations belong to the triangles of that mesh: on a stand-in they choose nothing, and the first variant is shown.
const NoisyRun& shown_variant(const NoisyExperiment& done) {
    const NoisyRun* nearest = &done.runs.front();
    double least = std::numeric_limits<double>::infinity();
    for (const NoisyRun& candidate : done.runs) {
        if (done.meshes[candidate.mesh].stand_in) continue;
        double gap = 0;
        for (const NoisyRun& run : done.runs) {
            if (same_curve(run, candidate) && run.minimum_said > 0) gap += std::abs(run.best - run.minimum_said);
        }
        if (gap >= least) continue;
        least = gap;
        nearest = &candidate;
    }
    return *nearest;
}

/// The original beside the meshes at the iterations of the report and at those with the smallest error.
void add_minimum_figure(const Reproduction& r, const NoisyExperiment& done, const NoisyRun& chosen) {
    const Experiment& e = r.experiment;
    SixViewFigure figure = figure_frame(r, done, chosen.mesh);
    const auto add = [&](const NoisyRun& run, const Positions& X, const std::string& what) {
        const std::string label = "σ = " + noise_text(e, run.noise) + ", " + what;
        figure.panels.push_back(panel_at(r, done, run, X, figure.id + "_" + std::to_string(figure.panels.size()), label));
    };
    for (const NoisyRun& run : done.runs) {
        if (!same_curve(run, chosen)) continue;
        const auto it = std::find(e.iterations.begin(), e.iterations.end(), run.minimum_said);
        const auto index = static_cast<std::size_t>(it - e.iterations.begin());
        if (index < run.snapshots.size())
            add(run, run.snapshots[index], "t = " + std::to_string(run.minimum_said) + ", where the report has its minimum");
        add(run, run.best_X, "t = " + std::to_string(run.best) + ", the smallest error here");
    }
    figure.caption = done.meshes[chosen.mesh].used->input.file + " and what " + run_label(e, chosen) +
                     " makes of its noisy copies; camera and scale are those of the original.";
    figure.range = range_of(r, e.colours.front(), figure.panels);
    add_figure(r.answer, std::move(figure));
}

void add_error_plot(const Reproduction& r, const NoisyExperiment& done, const NoisyRun& chosen) {
    const Experiment& e = r.experiment;
    report::Plot plot;
    plot.id = r.id_of(done.meshes[chosen.mesh].name() + "_error");
    plot.x_label = "iteration";
    plot.y_label = "rms error [% of box diagonal]";
    for (const NoisyRun& run : done.runs) {
        if (!same_curve(run, chosen)) continue;
        report::Series series{"σ = " + noise_text(e, run.noise), {}, {}, {}, {}, report::Series::Style::line};
        for (std::size_t t = 0; t < run.rms.size(); ++t) {
            series.x.push_back(double(t));
            series.y.push_back(percent_of(done, run) * run.rms[t]);
        }
        plot.series.push_back(std::move(series));
        plot.markers.push_back(
            {double(run.best), percent_of(done, run) * rms_at(run, run.best), "smallest, t = " + std::to_string(run.best)});
    }
    plot.caption = "Error against the clean " + done.meshes[chosen.mesh].name() + " over the iterations, " + run_label(e, chosen) +
                   (done.runs.size() <= e.noise.size() ? "."
                    : done.meshes[chosen.mesh].stand_in
                        ? ": the first of the variants in the table. Which of them is the report's, only its own mesh can tell."
                        : ": of the variants in the table the one whose minima lie nearest to the report's.");
    plot.alt = plot.caption;
    r.section().blocks.emplace_back(std::move(plot));
}

std::string outcome_of(const NoisyRun& run) {
    if (run.blew_up) return "blew up in iteration " + std::to_string(run.blow_up_iteration);
    if (run.best == 0) return "harms";
    return run.gain() >= 2 ? "works" : run.gain() >= 1.2 ? "helps" : "fails";
}

void add_table(const Reproduction& r, const NoisyExperiment& done) {
    const Experiment& e = r.experiment;
    const bool curve = e.kind == ExperimentKind::error_curve;
    report::Table table;
    table.id = r.id_of("errors");
    table.caption =
        "Errors (rms over the vertices, against the clean mesh) with the noisy mesh's own operator. Gain: error of the noisy mesh over the "
        "smallest reached; works: ≥ 2, helps: ≥ 1.2, fails: below, harms: no iteration is better than none.";
    table.columns = {{"mesh"},
                     {"steps"},
                     {"λ, report"},
                     {"λ, here", "", 3},
                     {"σ, report"},
                     {"σ", "mean edges", 3},
                     {"error, noisy", "% of box", 3},
                     {"iterations", "", 6},
                     {"error there", "% of box", 3},
                     {"smallest at iteration", "", 6},
                     {"smallest", "% of box", 3},
                     {"gain", "×", 3},
                     {"normals, noisy", "°", 3},
                     {"normals, last", "°", 3},
                     {"outcome"}};
    if (curve) table.columns.insert(table.columns.begin() + 9, {"minimum, report", "", 6});
    for (const NoisyRun& run : done.runs) {
        const ExperimentMesh& mesh = done.meshes[run.mesh];
        const double percent = percent_of(done, run), degrees = 180 / M_PI;
        const double edges = std::sqrt(run.sigma.squaredNorm() / 3) / mesh.mean_edge;
        const int end = last_iteration(run);
        std::vector<int> iterations;
        for (const int t : e.iterations) iterations.push_back(std::min(t, end));
        if (curve || iterations.front() == end) iterations = {end};
        iterations.erase(std::unique(iterations.begin(), iterations.end()), iterations.end());
        for (const int t : iterations) {
            std::vector<report::Cell> row{mesh.name(),
                                          variant_text(e, run.kind, run.area, run.method),
                                          given_text(e, run.given),
                                          run.lambda,
                                          noise_text(e, run.noise),
                                          edges,
                                          percent * run.rms.front(),
                                          double(t),
                                          percent * rms_at(run, t),
                                          double(run.best),
                                          percent * rms_at(run, run.best),
                                          run.gain(),
                                          degrees * run.noisy_angle,
                                          degrees * run.last_angle,
                                          outcome_of(run)};
            if (curve) row.insert(row.begin() + 9, cell_of(run.minimum_said, run.minimum_said > 0));
            table.rows.push_back(std::move(row));
        }
    }
    r.section().blocks.emplace_back(std::move(table));
}

// ---- what was found ---------------------------------------------------------------------------------------------------

report::BulletList told_runs(const Reproduction& r, const NoisyExperiment& done, std::size_t m) {
    report::BulletList list;
    for (const NoisyRun& run : done.runs) {
        if (run.mesh != m) continue;
        const double percent = percent_of(done, run);
        list.items.emplace_back();
        report::Text& text = list.items.back();
        report::extend(text, sentence_case(run_label(r.experiment, run)), ", σ = ", noise_text(r.experiment, run.noise), ": ");
        if (run.blew_up) {
            report::extend(text, "blew up in iteration ", std::to_string(run.blow_up_iteration), ".");
            continue;
        }
        const int end = last_iteration(run);
        report::extend(text, readable(percent * run.rms.front()), " % of the box before, ", readable(percent * rms_at(run, end)),
                       " % after ", counted(end, "iteration"));
        if (run.best == 0) {
            report::extend(text, ", never less than before.");
        } else if (run.best == end) {
            report::extend(text, ", still falling.");
        } else {
            report::extend(text, ", least at iteration ", std::to_string(run.best), " with ", readable(percent * rms_at(run, run.best)),
                           " %.");
        }
    }
    return list;
}

/// The minima of each variant beside those of the report.
void tell_minima(report::Text& text, const Reproduction& r, const NoisyExperiment& done, std::size_t m) {
    const bool ascending = std::is_sorted(r.experiment.noise.begin(), r.experiment.noise.end());
    std::vector<const NoisyRun*> told;
    for (const NoisyRun& first : done.runs) {
        const auto seen = [&](const NoisyRun* other) { return same_curve(*other, first); };
        if (first.mesh != m || std::any_of(told.begin(), told.end(), seen)) continue;
        told.push_back(&first);
        std::vector<std::string> minima;
        bool later = true;
        int previous = -1;
        for (const NoisyRun& run : done.runs) {
            if (!same_curve(run, first)) continue;
            minima.push_back(std::to_string(run.best) + (run.best == last_iteration(run) ? " (the last)" : ""));
            later = later && run.best > previous;
            previous = run.best;
        }
        report::extend(text, sentence_case(run_label(r.experiment, first)), ": smallest error at iteration ", listed(minima),
                       minima.size() < 2 || !ascending ? ""
                       : later                         ? ", later with each level of noise"
                                                       : ", not later with each level",
                       ". ");
    }
}

void add_checks(const Reproduction& r, const NoisyExperiment& done) {
    for (const NoisyRun& run : done.runs) {
        const bool first = &run == &*std::find_if(done.runs.begin(), done.runs.end(), [&](const NoisyRun& other) {
            return other.mesh == run.mesh && other.noise == run.noise;
        });
        if (!first || run.noise == 0) continue;
        // The squares of 3n normal numbers with these weights: five standard deviations of their mean.
        const ExperimentMesh& mesh = done.meshes[run.mesh];
        const Vector3 squares = run.sigma.cwiseAbs2();
        const double spread = std::sqrt(2.0 / mesh.mesh().vertex_count()) * squares.norm() / squares.sum();
        r.section().checks.push_back(check_near("noise as asked: mean square / Σσ², σ = " + noise_text(r.experiment, run.noise) + " on " +
                                                    mesh.name() + " (" + r.experiment.from + ", " + rows_text(r.experiment.rows) + ")",
                                                1, run.rms.front() * run.rms.front() / squares.sum(), 5 * spread));
    }
}

}   // namespace

void add_noisy_reproduction(const Reproduction& r, const NoisyExperiment& done) {
    add_opening(r, done.meshes);
    const bool curve = r.experiment.kind == ExperimentKind::error_curve;
    if (curve) {
        const NoisyRun& chosen = shown_variant(done);
        add_error_plot(r, done, chosen);
        add_minimum_figure(r, done, chosen);
    }
    for (std::size_t m = 0; m < done.meshes.size() && !curve; ++m) add_denoising_figure(r, done, m);
    add_table(r, done);
    for (std::size_t m = 0; m < done.meshes.size(); ++m) {
        report::Text text = report::text(report::strong("Found on " + done.meshes[m].name() + ": "));
        if (curve) tell_minima(text, r, done, m);
        r.section().blocks.emplace_back(report::Paragraph{std::move(text)});
        if (!curve) r.section().blocks.emplace_back(told_runs(r, done, m));
    }
    add_checks(r, done);
}

}   // namespace meshfolio::reproductions
