#include "questions/q7_denoising/study.h"

namespace meshfolio::q7_denoising {

namespace {

/// Plots shape and noise over the modes.
report::Plot mode_plot(const Reasons& reasons) {
    const ModeBands& bands = reasons.bands;
    report::Facts facts = facts_of(*reasons.grid, reasons.grid->pictured());
    facts.push_back("amount"_a = readable(reasons.parts.best_lambda * reasons.parts.best_step, 2));
    report::Plot plot{.id = "q7_modes",
                      .caption = words.line("modes", facts),
                      .x_label = words.line("modes.x"),
                      .y_label = words.line("modes.y"),
                      .log_x = true,
                      .log_y = true};
    plot.series = {{.name = words.line("modes.shape"), .x = bands.mu, .y = bands.shape, .style = report::Series::Style::line_and_points},
                   {.name = words.line("modes.noise"), .x = bands.mu, .y = bands.noise, .style = report::Series::Style::points},
                   {.name = words.line("modes.kept"), .x = bands.mu, .y = bands.kept, .style = report::Series::Style::dashed}};
    return plot;
}

/// Plots the parts of the error, and the errors of all levels, over the amount of smoothing.
report::Plot error_plot(const Reasons& reasons) {
    const DenoisingGrid& grid = *reasons.grid;
    report::Plot plot{.id = "q7_error",
                      .caption = words.line("errors", facts_of(grid, grid.pictured())),
                      .x_label = words.line("errors.x"),
                      .y_label = words.line("errors.y"),
                      .log_x = true,
                      .log_y = true};
    const std::string one = words.line("errors.one", facts_of(grid, grid.pictured())), all = words.line("errors.all");
    const auto add_curve = [&](const ErrorCurve& curve, std::string name, const std::string& panel, bool is_dashed) {
        using enum report::Series::Style;
        plot.series.push_back(
            {.name = std::move(name), .x = curve.amount, .y = curve.error, .style = is_dashed ? dashed : line, .panel = panel});
    };
    const auto mark_least = [&](const ErrorCurve& curve, const std::string& panel) {
        plot.markers.push_back({curve.amount[curve.least()], curve.error[curve.least()], "", panel});
    };
    add_curve(reasons.parts.total, words.line("errors.total"), one, false);
    add_curve(reasons.parts.noise, words.line("errors.noise"), one, true);
    add_curve(reasons.parts.shape, words.line("errors.shape"), one, true);
    mark_least(reasons.parts.total, one);
    for (std::size_t i = 0; i < reasons.levels.size(); ++i) {
        add_curve(reasons.levels[i], words.line("errors.level", facts_of(grid, grid.trials[i])), all, false);
        mark_least(reasons.levels[i], all);
    }
    add_curve(reasons.parts.surface, words.line("errors.clean"), all, true);
    return plot;
}

}   // namespace

const DenoisingGrid& grid_with_largest_gain(const Grids& grids) {
    const auto gain = [](const NoisyTrial& trial) { return std::fmax(0, trial.gain()); };
    return *std::ranges::max_element(grids, {}, [&](const DenoisingGrid& grid) { return largest_of(grid.trials, gain); });
}

report::Table result_table(const Grids& grids) {
    // Rounded down, so that 1.10 and 2.00 are reached and verdicts can be counted.
    const report::Column gain{.unit = "×", .rounding = Rounding::down, .heat = Heat{1, 8}};
    const std::vector<Case> cases = cases_of(grids);
    const std::size_t samples = std::ranges::max(each_of(cases, [](const Case& c) { return c.part.further_gains.size(); }));
    return table("q7_results", words.line("results.table", "samples"_a = samples > 0 ? samples + 1 : 0), cases)
        .column("mesh", [](auto& c) { return c.whole.name(); })
        .column("σ", {.unit = "% of box", .digits = 2}, [](auto& c) { return 100 * c.part.relative; })
        .column("σ", {.unit = "mean edges", .digits = 2}, [](auto& c) { return c.whole.edges(c.part); })
        .column("best λt", {.unit = "h̄²", .digits = 2}, [](auto& c) { return cell_of(c.part.amount(), c.part.improved()); })
        .column("gain", gain, [](auto& c) { return cell_of(c.part.gain()); })
        .column("±", {.digits = 2}, [](auto& c) { return cell_of(c.part.spread()); })
        .column("volume", {.unit = "%"}, [](auto& c) { return cell_of(100 * c.part.residual.volume); })
        .column("verdict", [](auto& c) { return verdict_on(c.part); });
}

report::Table measure_table(const Grids& grids) {
    const std::vector<Case> cases = cases_of(grids);
    const report::Column gain{.unit = "×", .rounding = Rounding::down, .heat = Heat{1, 8}};
    const auto unended = std::ranges::count_if(cases, [](const Case& c) { return lies_at_an_end(c.part, c.part.found.by_shape); });
    auto measured = table("q7_measures", words.line("measures.table", "unended"_a = unended), cases);
    measured.column("mesh", [](auto& c) { return c.whole.name(); }).column("σ", {.unit = "% of box", .digits = 2}, [](auto& c) {
        return 100 * c.part.relative;
    });
    for (const Measure& measure : measures) {
        const auto better = [&](auto& c) { return c.part.best_by(measure).step > 0; };
        const std::string name = words.line("measure." + std::string(measure.key));
        measured.column(name + ": gain", gain, [&](auto& c) { return cell_of(c.part.gain(measure)); })
            .column("λ", {.unit = "h̄²"}, [&](auto& c) { return cell_of(c.part.best_by(measure).value, better(c)); })
            .column("t", {.digits = 5}, [&](auto& c) { return cell_of(c.part.best_by(measure).step, better(c)); });
    }
    return measured.column("alone: gain", gain, [](auto& c) { return cell_of(c.part.stopped.gain); });
}

report::Table remains_table(const Grids& grids) {
    const auto left = [](const DenoisingGrid& grid) -> const SurfaceErrors& { return grid.pictured().residual; };
    const auto lost = [](const DenoisingGrid& grid) -> const SurfaceErrors& { return grid.pictured().clean_loss; };
    const auto at_edges = [](const DenoisingGrid& grid, double value) { return cell_of(value, grid.has_features()); };
    const auto degrees = [&](const DenoisingGrid& grid, double angle) { return at_edges(grid, 180 / pi * angle); };
    std::string caption = words.line("remains.table");
    if (!std::ranges::all_of(grids, &DenoisingGrid::has_features)) caption += " " + words.line("remains.none");
    return table("q7_remains", caption, grids)
        .column("mesh", &DenoisingGrid::name)
        .column("σ", {.unit = "% of box", .digits = 2}, [](auto& g) { return 100 * g.pictured().relative; })
        .column("removed along", {.unit = "% of error²", .digits = 2}, [](auto& g) { return cell_of(100 * g.pictured().removed_along()); })
        .column("across", {.unit = "% of error²", .digits = 2}, [](auto& g) { return cell_of(100 * g.pictured().removed_across()); })
        .column("normals at edges", {.unit = "°", .digits = 2}, [&](auto& g) { return degrees(g, left(g).feature_angle); })
        .column("elsewhere", {.unit = "°", .digits = 2}, [&](auto& g) { return degrees(g, left(g).other_angle); })
        .column("volume", {.unit = "%"}, [&](auto& g) { return cell_of(100 * left(g).volume); })
        .column("clean: edges", {.unit = "× elsewhere", .digits = 2}, [&](auto& g) { return at_edges(g, lost(g).features.times()); })
        .column("clean: volume", {.unit = "%"}, [&](auto& g) { return cell_of(100 * lost(g).volume); });
}

void add_reason_plots(report::Section& section, const Reasons& reasons) {
    if (!reasons.bands.mu.empty()) add(section, mode_plot(reasons));
    if (reasons.grid) add(section, error_plot(reasons));
}

report::Map gain_map(const DenoisingGrid& grid) {
    const double gained = std::fmax(1, largest_of(grid.trials, [](const NoisyTrial& trial) { return trial.gain(); }));
    const double largest = std::exp2(std::max(1.0, std::ceil(std::log2(gained))));   // a power of two, so that no gain is beyond the scale
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

void add_checks(report::Section& section, const Grids& grids) {
    for (const DenoisingGrid& grid : grids) {
        const report::Fact mesh = "mesh"_a = grid.name();
        const double n = grid.clean->mesh().vertex_count();
        for (const NoisyTrial& trial : grid.trials) {
            // rms of 3n normal numbers has relative standard deviation 1/√(6n); five of them.
            add(section, check_near(words.line("check.noise", "percent"_a = plain_text(100 * trial.relative, 3), mesh), 1,
                                    trial.found.noisy.rms / (std::sqrt(3.0) * trial.sigma), 5 / std::sqrt(6 * n)));
            // The nearest point of the surface is no farther than the vertex's clean position.
            add(section, check_at_most(words.line("check.surface", "percent"_a = plain_text(100 * trial.relative, 3), mesh), 1,
                                       trial.found.by_rms.shape / trial.found.by_rms.rms, 1e-12));
        }
    }
}

void add_record(report::Section& section, const Grids& grids, const QuestionSettings& settings) {
    const DenoisingGrid& first = grids.front();
    const std::vector<double> noise = tries_of(settings, first.mean_edge).noise;
    const bool in_edges = tries_in_edges(settings);
    const std::string levels =
        words.line("parameter.noise", "in_edges"_a = in_edges, "edges"_a = readable(level_in_edges, 2),
                   "levels"_a = listed(each_of(noise, [](double relative) { return readable_percent(relative, 2); })));
    const std::string steps = listed(each_of(first.lambdas, [](double lambda) { return readable(lambda, 3); }));
    section.parameters = {
        {"noise", {levels, noise, "box diagonal"}},
        {"λ", {words.line("parameter.lambda", "steps"_a = steps), first.lambdas, "h̄²"}},
        {"iterations", {words.line("parameter.iterations", "last"_a = first.iterations), static_cast<double>(first.iterations)}},
        {"seed", settings.seed}};
    section.extent = words.line("extent", "levels"_a = levels, "steps"_a = first.lambdas.size(), "iterations"_a = first.iterations,
                                "meshes"_a = listed(names_of(grids)));
}

}   // namespace meshfolio::q7_denoising
