#include "geometry/measures/mesh_error.h"
#include "questions/bench/curvature_subject.h"
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

namespace {

/// Cases that have room beside each other.
constexpr std::size_t most_beside = 6;

/// For ids and file names: σ in hundred-thousandths of the box diagonal, "sigma00300" for 0.3 %.
std::string sigma_name(double relative) {
    const std::string digits = std::to_string(std::llround(1e5 * relative));
    return "sigma" + std::string(digits.size() < 5 ? 5 - digits.size() : 0, '0') + digits;
}

Vector distances_of(const DenoisingGrid& grid, const Positions& X) { return shape_distances(grid.clean->mesh(), X); }

/// Noisy, nearest to the surface and smoothed on, coloured by the distance to the surface in σ. @param name  of its panels
void add_states_of(output::FigureRequest& request, const DenoisingGrid& grid, const NoisyTrial& trial, const std::string& name) {
    const report::Facts facts = facts_of(grid, trial);
    const auto add_state = [&](const TriangleMesh& mesh, const std::string& what) {
        if (&mesh == &trial.noisy || trial.improved())
            request.panels.push_back(
                panel_of(mesh, name + "_" + what, words.line("panel." + what, facts), distances_of(grid, mesh.X) / trial.sigma));
        else
            request.panels.push_back({name + "_" + what, words.line("panel.no_better"), nullptr});
    };
    add_state(trial.noisy, "noisy");
    add_state(trial.best, "best");
    add_state(trial.over, "over");
}

/// A figure in one picture a panel. @param key  of its words
void add_pictures(Answer& answer, output::FigureRequest request, const std::string& key) {
    request.title = words.line(key + ".title");
    Names labels;
    for (const output::Panel& panel : request.panels) labels.push_back(panel.label);
    const std::string alt = words.line("figure.alt", "title"_a = request.title, "panels"_a = listed(labels));
    add_figure(answer, std::move(request), words.line(key + ".caption"), alt);
}

void transpose(output::FigureRequest& request) {
    std::vector<output::Panel> panels;
    for (std::size_t c = 0; c < request.columns.size(); ++c)
        for (std::size_t r = 0; r < request.rows.size(); ++r) panels.push_back(std::move(request.panels[r * request.columns.size() + c]));
    request.panels = std::move(panels);
    std::swap(request.rows, request.columns);
}

/// The grid whose noise to look at shows most of something, above `floor`; null where none does.
template <class Amount>
const DenoisingGrid* most_of(const Grids& grids, double floor, const Amount& amount) {
    const DenoisingGrid* most = nullptr;
    for (const DenoisingGrid& grid : grids) {
        const NoisyTrial& trial = grid.pictured();
        if (const double found = amount(grid, trial); trial.improved() && found > floor) most = &grid, floor = found;
    }
    return most;
}

}   // namespace

report::Facts facts_of(const DenoisingGrid& grid, const NoisyTrial& trial, report::Facts more) {
    const SearchState& best = trial.found.by_shape;
    const double gain = trial.gain(measures[0]);
    more.insert(more.end(),
                {"mesh"_a = grid.name(), "noise"_a = readable_percent(trial.relative, 2),
                 "edges"_a = readable(trial.sigma / grid.mean_edge, 2), "lambda"_a = readable(best.value, 2), "best"_a = best.step,
                 "volume"_a = readable_percent(trial.volume_by(measures[0]), 2), "over"_a = 4 * best.step, "verdict"_a = verdict_on(trial),
                 "angle"_a = readable(180 / pi * best.angle, 2), "gain"_a = readable(gain, gain < 1.1 ? 3 : 2)});
    return more;
}

std::vector<Case> pictured_cases(const Grids& grids) {
    const NoisyTrial &least = hardest_in(hardest(grids)), &most = leading_in(leading(grids));
    std::vector<Case> shown;
    for (const Case& c : cases_of(grids))
        if (&c.part == &c.whole.pictured() || &c.part == &least || &c.part == &most) shown.push_back(c);
    return shown;
}

output::ColorRange add_states(Answer& answer, const Grids& grids) {
    output::FigureRequest request{.id = "q7_states", .subtitle = words.line("trial.subtitle"), .layout = output::Layout::multiples};
    request.columns = {words.line("states.clean"), words.line("states.noisy"), words.line("states.best"), words.line("states.over")};
    for (const auto& [grid, trial] : pictured_cases(grids)) {
        const std::string name = request.id + "_" + grid.name() + "_" + sigma_name(trial.relative);
        const report::Facts facts = facts_of(grid, trial);
        request.rows.push_back(words.line(trial.improved() ? "states.row" : "states.row.no_better", facts));
        request.panels.push_back(panel_of(*grid.clean, name + "_clean", words.line("states.clean.panel", facts)));
        add_states_of(request, grid, trial, name);
    }
    const output::ColorRange colours = range_from_zero(request.panels, distance_colours, words.line("colours.surface"), 0.01, "σ");
    request.range = colours;
    if (request.rows.size() > request.columns.size() && request.rows.size() <= most_beside) transpose(request);
    add_pictures(answer, std::move(request), "states");
    return colours;
}

void add_views(Answer& answer, const Grids& grids, const output::ColorRange& colours) {
    output::FigureRequest figure{.id = "q7_views",
                                 .title = words.line("views.title"),
                                 .subtitle = words.line("trial.subtitle"),
                                 .frame_panel = -1,
                                 .coarse_edges = true};
    for (const DenoisingGrid& grid : grids) {
        const NoisyTrial& trial = grid.pictured();
        if (!trial.improved()) continue;
        figure.panels.push_back(panel_of(in_unit_box(grid.clean->mesh(), trial.best.X), "q7_views_" + grid.name(),
                                         words.line("views.panel", facts_of(grid, trial)), distances_of(grid, trial.best.X) / trial.sigma));
    }
    if (figure.panels.empty()) return;
    figure.range = range_for(colours, figure.panels);
    add_figure(answer, std::move(figure), words.line("views.caption"));
}

const DenoisingGrid* most_drifting(const Grids& grids) {
    return most_of(grids, 0, [](const DenoisingGrid&, const NoisyTrial& trial) {
        return trial.removed_along() < trial.removed_across() ? NoisyTrial::drift(trial.found.by_shape) / trial.sigma : 0;
    });
}

const DenoisingGrid* most_rounded(const Grids& grids) {
    return most_of(grids, 1, [](const DenoisingGrid& grid, const NoisyTrial& trial) {
        return grid.has_features() ? trial.taken.features.times() : NAN;
    });
}

const DenoisingGrid* most_shrunk(const Grids& grids) {
    return most_of(grids, 0.001, [](const DenoisingGrid&, const NoisyTrial& trial) { return 1 - trial.taken.volume; });
}

void add_limits(Answer& answer, const Grids& grids) {
    output::FigureRequest request{.id = "q7_limits", .layout = output::Layout::multiples};
    const auto add_panel = [&](const DenoisingGrid* grid, const std::string& what, TriangleMesh NoisyTrial::*shown, const auto& distances) {
        if (grid == nullptr) return;
        const TriangleMesh& mesh = grid->pictured().*shown;
        request.panels.push_back(panel_of(mesh, request.id + "_" + what, words.line("limits." + what, facts_of(*grid, grid->pictured())),
                                          distances(*grid, mesh.X) / grid->pictured().sigma));
    };
    add_panel(most_drifting(grids), "drift", &NoisyTrial::best, drifts);
    add_panel(most_rounded(grids), "edges", &NoisyTrial::clean_alike, distances_of);
    add_panel(most_shrunk(grids), "volume", &NoisyTrial::clean_alike, sinkings);
    if (request.panels.empty()) return;
    request.range = range_from_zero(request.panels, distance_colours, words.line("colours.limits"), 0.01, "σ");
    add_pictures(answer, std::move(request), "limits");
}

}   // namespace meshfolio::q7_denoising
