#include "geometry/measures/mesh_error.h"
#include "questions/bench/curvature_subject.h"
#include "questions/q7_denoising/study.h"

namespace meshfolio::q7_denoising {

namespace {

/// Returns σ for ids and file names, in hundred-thousandths of the box diagonal: "sigma00300" for 0.3 %.
std::string sigma_name(double relative) {
    const std::string digits = std::to_string(std::llround(1e5 * relative));
    return "sigma" + std::string(digits.size() < 5 ? 5 - digits.size() : 0, '0') + digits;
}

Vector distances_of(const DenoisingGrid& grid, const Positions& X) { return shape_distances(grid.clean->mesh(), X); }

/// Adds a figure of one picture a panel. @param key  of its words
void add_pictures(Answer& answer, output::FigureRequest request, const std::string& key) {
    request.title = words.line(key + ".title");
    Names labels;
    for (const output::Panel& panel : request.panels) labels.push_back(panel.label);
    const std::string alt = words.line("figure.alt", "title"_a = request.title, "panels"_a = listed(labels));
    add_figure(answer, std::move(request), words.line(key + ".caption"), alt);
}

/// Returns the grid with the largest amount of pictured() above `floor`; null if there is none.
template <class Amount> const DenoisingGrid* most_of(const Grids& grids, double floor, const Amount& amount) {
    const DenoisingGrid* most = nullptr;
    for (const DenoisingGrid& grid : grids) {
        const NoisyTrial& trial = grid.pictured();
        if (const double found = amount(grid, trial); trial.improved() && found > floor) most = &grid, floor = found;
    }
    return most;
}

}   // namespace

report::Facts facts_of(const DenoisingGrid& grid, const NoisyTrial& trial) {
    const SearchState& best = trial.found.by_shape;
    return {"mesh"_a = grid.name(),
            "noise"_a = readable_percent(trial.relative, 2),
            "edges"_a = readable(grid.edges(trial), 2),
            "lambda"_a = readable(best.value, 2),
            "best"_a = best.step,
            "over"_a = 4 * best.step,
            "verdict"_a = verdict_on(trial),
            "gain"_a = readable(rounded_down(trial.gain(), 2), 2)};
}

void add_states(Answer& answer, const Grids& grids) {
    output::FigureRequest request{.id = "q7_states", .subtitle = words.line("trial.subtitle"), .layout = output::Layout::multiples};
    request.columns = {words.line("states.clean"), words.line("states.noisy"), words.line("states.best"), words.line("states.over")};
    for (const DenoisingGrid& grid : grids) {
        const NoisyTrial& trial = grid.pictured();
        const std::string name = request.id + "_" + grid.name() + "_" + sigma_name(trial.relative);
        const report::Facts facts = facts_of(grid, trial);
        request.rows.push_back(words.line(trial.improved() ? "states.row" : "states.row.no_better", facts));
        request.panels.push_back(panel_of(*grid.clean, name + "_clean", words.line("states.clean.panel", facts)));
        for (const auto& [mesh, what] : {std::pair{&trial.noisy, "noisy"}, {&trial.best, "best"}, {&trial.over, "over"}}) {
            output::Panel& panel = request.panels.emplace_back(output::Panel{name + "_" + what, words.line("panel.no_better"), nullptr});
            if (mesh == &trial.noisy || trial.improved())
                panel =
                    panel_of(*mesh, panel.name, words.line("panel." + std::string(what), facts), distances_of(grid, mesh->X) / trial.sigma);
        }
    }
    request.range = range_from_zero(request.panels, "pale", words.line("colours.surface"), 0.01, "σ");
    add_pictures(answer, std::move(request), "states");
}

void add_views(Answer& answer, const Grids& grids) {
    output::FigureRequest figure{.id = "q7_views",
                                 .title = words.line("views.title"),
                                 .subtitle = words.line("trial.subtitle"),
                                 .frame_panel = -1,
                                 .coarse_edges = true};
    for (const DenoisingGrid& grid : grids) {
        const NoisyTrial& trial = grid.trials.back();
        if (!trial.improved()) continue;
        figure.panels.push_back(panel_of(in_unit_box(grid.clean->mesh(), trial.best.X), "q7_views_" + grid.name(),
                                         words.line("views.panel", facts_of(grid, trial)), distances_of(grid, trial.best.X) / trial.sigma));
    }
    if (figure.panels.empty()) return;
    figure.range = range_from_zero(figure.panels, "pale", words.line("colours.surface"), 0.01, "σ");
    add_figure(answer, std::move(figure), words.line("views.caption"));
}

const DenoisingGrid* most_drifting(const Grids& grids) {
    return most_of(grids, 0, [](const DenoisingGrid&, const NoisyTrial& trial) {
        return trial.removed_along() < trial.removed_across() ? NoisyTrial::drift(trial.found.by_shape) / trial.sigma : 0;
    });
}

const DenoisingGrid* most_rounded(const Grids& grids) {
    return most_of(grids, 1.2, [](const DenoisingGrid& grid, const NoisyTrial& trial) {
        return grid.has_features() ? trial.clean_loss.features.times() : NAN;
    });
}

const DenoisingGrid* most_shrunk(const Grids& grids) {
    return most_of(grids, 0.001, [](const DenoisingGrid&, const NoisyTrial& trial) { return 1 - trial.clean_loss.volume; });
}

void add_losses(Answer& answer, const Grids& grids) {
    output::FigureRequest request{.id = "q7_losses", .layout = output::Layout::multiples};
    const auto add_panel = [&](const DenoisingGrid* grid, const std::string& what) {
        if (grid == nullptr) return;
        const NoisyTrial& trial = grid->pictured();
        request.panels.push_back(panel_of(trial.clean_alike, request.id + "_" + what, words.line("losses." + what, facts_of(*grid, trial)),
                                          distances_of(*grid, trial.clean_alike.X) / trial.sigma));
    };
    add_panel(most_rounded(grids), "edges");
    add_panel(most_shrunk(grids), "volume");
    if (request.panels.empty()) return;
    request.range = range_from_zero(request.panels, "pale", words.line("colours.surface"), 0.01, "σ");
    add_pictures(answer, std::move(request), "losses");
}

}   // namespace meshfolio::q7_denoising
