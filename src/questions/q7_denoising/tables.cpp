#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

namespace {

/// A row of the table of results: one noisy mesh by one measure.
struct Judged {
    const DenoisingGrid& grid;
    const NoisyTrial& trial;
    const Measure& measure;

    const SearchState& best() const { return trial.best_by(measure); }
    bool better() const { return best().step > 0; }
    double shown(const SearchState& state) const { return state.*measure.error * (measure.is_angle() ? 180 / pi : 100 / grid.diagonal); }
};

std::vector<Judged> judged_in(const Grids& grids) {
    std::vector<Judged> rows;
    for (const Case& c : cases_of(grids))
        for (const Measure& measure : measures) rows.push_back({c.whole, c.part, measure});
    return rows;
}

/// Starts at the noisy mesh (t = 0) and ends where it stays on the curve without noise. [% of the box diagonal]
report::Series error_series(const DenoisingGrid& grid, const NoisyTrial& trial) {
    constexpr double joined = 0.1;   // of the distance without noise
    report::Series series{
        .name = "σ = " + readable_percent(trial.relative, 2), .x = {0}, .y = {100 / grid.diagonal * trial.found.noisy.shape}};
    std::ptrdiff_t apart = 0;   // the last place where it is
    for (const SearchState& state : trial.states) {
        if (state.value != grid.middle_lambda()) continue;
        add_point(series, state.step, 100 / grid.diagonal * state.shape);
        const int t = state.step;
        if (t >= std::ssize(grid.without_noise) || std::abs(state.shape / grid.without_noise[t] - 1) > joined)
            apart = std::ssize(series.x) - 1;
    }
    const std::ptrdiff_t least = std::ranges::min_element(series.y) - series.y.begin();
    const std::ptrdiff_t shown = std::min(std::max(apart, least) + 2, std::ssize(series.x));
    series.x.resize(shown);
    series.y.resize(shown);
    return series;
}

/// The gain in distance to the surface; NaN where the noise does not move the surface.
double surface_gain(const NoisyTrial& trial) { return trial.gain(measures[0]); }

}   // namespace

const NoisyTrial& leading_in(const DenoisingGrid& grid) {
    return *std::ranges::max_element(grid.trials, {}, [](const NoisyTrial& trial) { return std::fmax(0, surface_gain(trial)); });
}

const NoisyTrial& hardest_in(const DenoisingGrid& grid) {
    return *std::ranges::min_element(grid.trials, {}, [](const NoisyTrial& trial) { return std::fmin(infinity, surface_gain(trial)); });
}

const DenoisingGrid& leading(const Grids& grids) {
    return *std::ranges::max_element(grids, {}, [](const DenoisingGrid& grid) { return std::fmax(0, surface_gain(leading_in(grid))); });
}

const DenoisingGrid& hardest(const Grids& grids) {
    return *std::ranges::min_element(grids, {}, [](auto& grid) { return std::fmin(infinity, surface_gain(hardest_in(grid))); });
}

report::Table result_table(const Grids& grids) {
    const auto gain_by = [](std::size_t m) { return [m](const Case& c) { return cell_of(c.part.gain(measures[m])); }; };
    // Rounded down: 1.10 and 2.00 are reached, so that verdicts can be counted.
    const report::Column gain{.unit = "×", .rounding = Rounding::down, .heat = Heat{1, 8}};
    const std::vector<Case> cases = cases_of(grids);
    std::string caption = words.line("results.table");
    const auto most = std::ranges::max_element(cases, {}, [](const Case& c) { return c.part.further_gains.size(); });
    if (const std::size_t samples = most->part.further_gains.size(); samples > 0)
        caption += " " + words.line("results.samples", "samples"_a = samples + 1);
    return table("q7_results", std::move(caption), cases)
        .column("mesh", [](auto& c) { return c.whole.name(); })
        .column("σ", {.unit = "% of box", .digits = 2}, [](auto& c) { return 100 * c.part.relative; })
        .column("σ", {.unit = "mean edges", .digits = 2}, [](auto& c) { return c.part.sigma / c.whole.mean_edge; })
        .column("λt", {.unit = "h̄²", .digits = 2},
                [](auto& c) { return cell_of(c.part.found.by_shape.value * c.part.found.by_shape.step, c.part.improved()); })
        .column("gain: surface", gain, gain_by(0))
        .column("±", {.digits = 2}, [](auto& c) { return cell_of(c.part.spread()); })
        .column("places", gain, gain_by(1))
        .column("normals", gain, gain_by(2))
        .column("volume", {.unit = "%"}, [](auto& c) { return cell_of(100 * c.part.remains.volume); })
        .column("verdict", [](auto& c) { return verdict_on(c.part); })
        .column("alone", {.unit = "×", .rounding = Rounding::down}, [](auto& c) { return cell_of(c.part.stopped.gain); });
}

report::Table count_table(const Grids& grids) {
    struct Row {
        const Measure& measure;
        Count count;
    };
    std::vector<Row> rows;
    for (const Measure& measure : measures)
        if (Count count = count_of(grids, measure); count.cases() > 0) rows.push_back({measure, std::move(count)});
    return table("q7_counts", words.line("counts"), rows)
        .column("by", [](auto& r) { return words.line("by." + std::string(r.measure.key)); })
        .column("works", {.digits = 5}, [](auto& r) { return r.count.works; })
        .column("helps", {.digits = 5}, [](auto& r) { return r.count.helps; })
        .column("fails", {.digits = 5}, [](auto& r) { return r.count.fails; })
        .column("fails by shrinking", {.digits = 5}, [](auto& r) { return static_cast<double>(r.count.shrinking.size()); })
        .column("volume left", [](auto& r) { return listed(r.count.shrinking); });
}

report::Table measure_table(const Grids& grids) {
    const std::vector<Judged> rows = judged_in(grids);
    std::string caption = words.line("measures.table");
    if (std::ranges::any_of(rows, [](const Judged& row) { return is_unended(row.grid, row.best()); }))
        caption += " " + words.line("results.unended");
    return table("q7_measures", caption, rows)
        .column("mesh", [](auto& r) { return r.grid.name(); })
        .column("σ", {.unit = "% of box", .digits = 2}, [](auto& r) { return 100 * r.trial.relative; })
        .column("measure", [](auto& r) { return words.line("measure." + std::string(r.measure.key)); })
        .column("noisy", {.unit = "% of box, °"}, [](auto& r) { return r.shown(r.trial.found.noisy); })
        .column("best", {.unit = "% of box, °"}, [](auto& r) { return r.shown(r.best()); })
        .column("gain", {.unit = "×", .rounding = Rounding::down}, [](auto& r) { return cell_of(r.trial.gain(r.measure)); })
        .column("λ", {.unit = "h̄²"}, [](auto& r) { return cell_of(r.best().value, r.better()); })
        .column("t", {.digits = 5}, [](auto& r) { return cell_of(r.best().step, r.better()); })
        .column("verdict", [](auto& r) { return verdict_on(r.trial, r.measure); });
}

report::Table remains_table(const Grids& grids) {
    const auto left = [](const DenoisingGrid& grid) -> const Remains& { return grid.pictured().remains; };
    const auto taken = [](const DenoisingGrid& grid) -> const Remains& { return grid.pictured().taken; };
    const auto at_edges = [](const DenoisingGrid& grid, double value) { return cell_of(value, grid.has_features()); };
    const auto degrees = [&](const DenoisingGrid& grid, double angle) { return at_edges(grid, 180 / pi * angle); };
    std::string caption = words.line("remains.table");
    if (!std::ranges::all_of(grids, &DenoisingGrid::has_features)) caption += " " + words.line("remains.none");
    return table("q7_remains", caption, grids)
        .column("mesh", &DenoisingGrid::name)
        .column("3V/A", {.unit = "h̄", .digits = 2}, [](auto& g) { return cell_of(g.thickness); })
        .column("σ", {.unit = "% of box", .digits = 2}, [](auto& g) { return 100 * g.pictured().relative; })
        .column("removed along", {.unit = "% of error²", .digits = 2}, [](auto& g) { return cell_of(100 * g.pictured().removed_along()); })
        .column("across", {.unit = "% of error²", .digits = 2}, [](auto& g) { return cell_of(100 * g.pictured().removed_across()); })
        .column("normals at edges", {.unit = "°", .digits = 2}, [&](auto& g) { return degrees(g, left(g).feature_angle); })
        .column("elsewhere", {.unit = "°", .digits = 2}, [&](auto& g) { return degrees(g, left(g).other_angle); })
        .column("volume", {.unit = "%"}, [&](auto& g) { return cell_of(100 * left(g).volume); })
        .column("clean: edges", {.unit = "× elsewhere", .digits = 2}, [&](auto& g) { return at_edges(g, taken(g).features.times()); })
        .column("clean: volume", {.unit = "%"}, [&](auto& g) { return cell_of(100 * taken(g).volume); });
}

report::Plot error_plot(const DenoisingGrid& grid) {
    report::Plot plot{.id = id_of("q7", grid.name(), "error_versus_iteration"),
                      .caption = words.line("errors", "mesh"_a = grid.name(), "lambda"_a = readable(grid.middle_lambda(), 2)),
                      .x_label = "iteration t",
                      .y_label = words.line("errors.axis"),
                      .log_x = true,
                      .log_y = true};
    for (const NoisyTrial& trial : grid.trials) {
        report::Series series = error_series(grid, trial);
        const auto least = std::ranges::min_element(series.y);
        const double x = series.x[least - series.y.begin()];
        plot.markers.push_back({x, *least, words.line("errors.minimum", "best"_a = std::lround(x))});
        plot.series.push_back(std::move(series));
    }
    report::Series clean{.name = "without noise", .style = report::Series::Style::dashed};
    for (std::size_t t = 1; t < grid.without_noise.size(); ++t) add_point(clean, double(t), 100 / grid.diagonal * grid.without_noise[t]);
    plot.series.push_back(std::move(clean));
    return plot;
}

report::Map gain_map(const DenoisingGrid& grid) {
    const double gained = std::fmax(1, surface_gain(leading_in(grid)));
    const double largest = std::exp2(std::max(1.0, std::ceil(std::log2(gained))));   // a power of two: no gain is beyond the scale
    report::Map map{.id = id_of("q7", grid.name(), "gains"),
                    .caption = words.line("gains", "mesh"_a = grid.name()),
                    .x_label = "iteration t",
                    .y_label = "λ [h̄²]",
                    .value_label = words.line("gains.axis"),
                    .y = grid.lambdas,
                    .log_x = true,
                    .log_y = true,
                    .log_values = true,
                    .colours = report::Map::Colours::diverging,
                    .middle = 1,
                    .range = report::Map::Range{1 / largest, largest},
                    .undefined = words.line("gains.ended")};
    for (int t = 1; t <= grid.iterations; ++t) map.x.push_back(t);
    for (const NoisyTrial& trial : grid.trials) {
        report::Map::Panel panel{"σ = " + readable_percent(trial.relative, 2),
                                 std::vector<double>(map.x.size() * map.y.size(), std::nan(""))};
        for (const SearchState& state : trial.states) {
            const auto row = std::ranges::find(grid.lambdas, state.value) - grid.lambdas.begin();
            panel.values[row * grid.iterations + state.step - 1] = trial.found.noisy.shape / state.shape;
        }
        if (const SearchState& best = trial.found.by_shape; best.step > 0)
            panel.markers.push_back({static_cast<double>(best.step), best.value, "B"});
        map.panels.push_back(std::move(panel));
    }
    return map;
}

}   // namespace meshfolio::q7_denoising
