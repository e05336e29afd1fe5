#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/measures/mesh_error.h"
#include "questions/core/comparison_figure.h"
#include "questions/core/study_list.h"
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

namespace {

/// For ids and file names: σ in hundred-thousandths of the box diagonal, "sigma00300" for 0.3 %.
std::string sigma_name(double relative) {
    const std::string digits = std::to_string(std::llround(1e5 * relative));
    return "sigma" + std::string(digits.size() < 5 ? 5 - digits.size() : 0, '0') + digits;
}

}   // namespace

report::Facts facts_of(const DenoisingGrid& grid, const NoisyTrial& trial) {
    const SearchState& best = trial.found.by_shape;
    return {"mesh"_a = grid.name(),
            "noise"_a = readable_percent(trial.relative, 2),
            "edges"_a = readable(trial.sigma / grid.mean_edge, 2),
            "lambda"_a = readable(best.value, 2),
            "best"_a = best.step,
            "over"_a = 4 * best.step,
            "first_error"_a = readable_percent(trial.found.noisy.shape / grid.diagonal, 2),
            "least_error"_a = readable_percent(best.shape / grid.diagonal, 2),
            "gain"_a = readable(trial.gain(measures[0]), 2)};
}

void add_trial_figure(Answer& answer, const DenoisingGrid& grid, const NoisyTrial& trial) {
    const TriangleMesh& clean = grid.clean->mesh();
    const report::Facts facts = facts_of(grid, trial);
    const std::string id = id_of("q7", grid.name(), sigma_name(trial.relative));
    const auto coloured = [&](const TriangleMesh& mesh, const std::string& what, std::string label) {
        const Vector distance = shape_distances(clean, grid.clean->prepared->topology.vertex_faces, mesh.X) * (100 / grid.diagonal);
        return panel_of(mesh, id + "_" + what, std::move(label), distance);
    };
    std::vector<output::Panel> panels{coloured(trial.noisy, "noisy", "noisy")};
    const bool helped = trial.found.by_shape.step > 0;
    if (helped) {
        panels.push_back(coloured(trial.best, "best", words.line("trial.best", facts)));
        panels.push_back(coloured(trial.over, "over", words.line("trial.over", facts)));
    }
    SixViewFigure figure{.id = id,
                         .title = words.line("trial.title", facts),
                         .subtitle = words.line("trial.subtitle"),
                         .caption = words.line(helped ? "trial.caption" : "trial.caption.no_better", facts),
                         .panels = {panel_of(*grid.clean, id + "_clean", "clean")},
                         .range = output::robust_range(panels, "viridis", words.line("trial.colours"), "% of the box diagonal", 0.01),
                         .frame_panel = -1};               // noise may reach beyond the clean box
    figure.range->low = figure.range->clipped_below = 0;   // a distance begins at 0
    figure.panels.insert(figure.panels.end(), panels.begin(), panels.end());
    add_figure(answer, std::move(figure));
}

void add_before_after(Answer& answer, const DenoisingGrid& grid, const std::string& colormap) {
    const NoisyTrial& trial = *std::ranges::max_element(grid.trials, {}, [](const NoisyTrial& t) {
        const double gain = t.gain(measures[0]);
        return std::isnan(gain) ? 0 : gain;
    });
    if (trial.found.by_shape.step == 0) return;   // nothing was better than the noise
    const report::Facts facts = facts_of(grid, trial);
    const std::string id = id_of("q7", grid.name(), "before_after");
    add_comparison(answer, {.id = id,
                            .title = words.line("before_after.title", facts),
                            .subtitle = words.line("before_after.subtitle", facts),
                            .caption = words.line("before_after.caption", facts),
                            .before = panel_of(trial.noisy, id + "_noisy", words.line("before_after.noisy", facts)),
                            .after = panel_of(trial.best, id + "_denoised", words.line("before_after.denoised", facts)),
                            .diagonal = grid.diagonal,
                            .colormap = colormap,
                            .frame_panel = -1});   // noise may reach beyond the clean box
}

}   // namespace meshfolio::q7_denoising
