#include <algorithm>

#include "base/number_text.h"
#include "geometry/linear/special_values.h"
#include "questions/core/study_list.h"
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

namespace {

/// Did the run end before the error or the angle had turned?
bool is_unended(const Case& c) { return !c.part.minimum_reached() || c.part.best_angle == c.part.iterations(); }

/// Over 1 + t, so that the noisy mesh, t = 0, has a place on the logarithmic axis. [% of the box diagonal]
report::Series error_series(const DenoisingStudy& study, std::string name, const std::vector<double>& errors, std::size_t first) {
    report::Series series{.name = std::move(name)};
    for (std::size_t t = first; t < errors.size(); ++t) {
        series.x.push_back(1 + static_cast<double>(t));
        series.y.push_back(100 / study.diagonal * errors[t]);
    }
    return series;
}

}   // namespace

std::string length_of_runs(const DenoisingStudy& study) {
    return words.line(study.most_iterations > study.iterations ? "runs.twice" : "runs.fixed", "least"_a = study.iterations,
                      "most"_a = study.most_iterations);
}

report::Table result_table(const Studies& studies) {
    const auto percent = [](const Case& c, double error) { return 100 / c.whole.diagonal * error; };
    const double degrees = 180 / pi;
    const std::vector<Case> cases = cases_of(studies);
    std::string caption = words.line("results.table", "runs"_a = length_of_runs(studies.front()));
    if (std::ranges::any_of(cases, is_unended)) caption += " " + words.line("results.unended");
    return table("q7_results", caption, cases)
        .column("mesh", [](auto& c) { return c.whole.name(); })
        .column("σ", {.unit = "% of box"}, [](auto& c) { return 100 * c.part.relative; })
        .column("σ", {.unit = "mean edges"}, [](auto& c) { return c.part.sigma / c.whole.mean_edge; })
        .column("error, noisy", {.unit = "% of box"}, [&](auto& c) { return percent(c, c.part.rms.front()); })
        .column("best iteration", {.digits = 5}, [](auto& c) { return c.part.best_rms; })
        .column("error, best", {.unit = "% of box"}, [&](auto& c) { return percent(c, c.part.least_rms()); })
        .column("gain", {.unit = "×"}, [](auto& c) { return c.part.gain(); })
        .column("normal angle, noisy", {.unit = "°"}, [&](auto& c) { return degrees * c.part.angle.front(); })
        .column("best iteration (angle)", {.digits = 5}, [](auto& c) { return c.part.best_angle; })
        .column("normal angle, best", {.unit = "°"}, [&](auto& c) { return degrees * c.part.least_angle(); })
        .column("error at features / elsewhere", {.unit = "×"}, [](auto& c) { return cell_of(c.part.feature_rms / c.part.smooth_rms); })
        .column("error, last", {.unit = "% of box"}, [&](auto& c) { return percent(c, c.part.rms.back()); })
        .column("outcome", [](auto& c) { return outcome_of(c.part); });
}

report::Plot error_plot(const DenoisingStudy& study) {
    const std::string caption = words.line("errors", "mesh"_a = study.name());
    report::Plot plot{.id = id_of("q7", study.name(), "error_versus_iteration"),
                      .caption = caption,
                      .alt = caption,
                      .x_label = "1 + iteration t",
                      .y_label = words.line("errors.axis"),
                      .log_x = true,
                      .log_y = true};
    for (const DenoisingTrial& trial : study.trials) {
        plot.series.push_back(error_series(study, "σ = " + readable_percent(trial.relative, 2), trial.rms, 0));
        plot.markers.push_back({1 + static_cast<double>(trial.best_rms), 100 / study.diagonal * trial.least_rms(),
                                words.line(trial.minimum_reached() ? "errors.minimum" : "errors.falling", "best"_a = trial.best_rms)});
    }
    plot.series.push_back(error_series(study, "without noise", study.without_noise, 1));
    plot.series.back().style = report::Series::Style::dashed;
    return plot;
}

}   // namespace meshfolio::q7_denoising
