#include <algorithm>
#include <cmath>

#include "base/number_text.h"
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

report::Facts facts_of(const DenoisingStudy& study, const DenoisingTrial& trial) {
    return {"mesh"_a = study.name(),
            "noise"_a = readable_percent(trial.relative, 2),
            "edges"_a = readable(trial.sigma / study.mean_edge, 2),
            "lambda"_a = readable(study.lambda),
            "squared_edges"_a = readable(study.lambda / (study.mean_edge * study.mean_edge), 2),
            "first_error"_a = readable(100 / study.diagonal * trial.rms.front()),
            "least_error"_a = readable(100 / study.diagonal * trial.least_rms()),
            "best"_a = trial.best_rms,
            "best_angle"_a = trial.best_angle,
            "last"_a = trial.iterations(),
            "gain"_a = readable(trial.gain(), 2),
            "factor"_a = readable(trial.gain())};
}

void add_trial_figure(Answer& answer, const DenoisingStudy& study, const DenoisingTrial& trial) {
    const report::Facts facts = facts_of(study, trial);
    const std::string id = id_of("q7", study.name(), sigma_name(trial.relative));
    const auto coloured = [&](const TriangleMesh& mesh, const std::string& what, std::string label) {
        const Vector distance = (mesh.X - study.clean->mesh().X).rowwise().norm() * (100 / study.diagonal);
        return panel_of(mesh, id + "_" + what, std::move(label), distance);
    };
    const bool reached = trial.minimum_reached();
    std::vector<output::Panel> panels{coloured(trial.noisy, "noisy", "noisy"),
                                      coloured(trial.best, "best", words.line(reached ? "trial.best" : "trial.falling", facts))};
    if (reached) panels.push_back(coloured(trial.last, "over", words.line("trial.over", facts)));

    SixViewFigure figure{.id = id,
                         .title = words.line("trial.title", facts),
                         .subtitle = words.line("trial.subtitle", facts),
                         .caption = words.line(reached ? "trial.caption.minimum" : "trial.caption.falling", facts),
                         .panels = {panel_of(*study.clean, id + "_clean", "clean")},
                         .range = output::robust_range(panels, "viridis", words.line("trial.colours"), "% of the box diagonal", 0.01),
                         .frame_panel = -1};               // noise may reach beyond the clean box
    figure.range->low = figure.range->clipped_below = 0;   // a distance begins at 0
    figure.panels.insert(figure.panels.end(), panels.begin(), panels.end());
    add_figure(answer, std::move(figure));
}

void add_before_after(Answer& answer, const DenoisingStudy& study, const std::string& colormap) {
    const DenoisingTrial& trial = *std::ranges::max_element(study.trials, {}, &DenoisingTrial::gain);
    if (trial.best_rms == 0) return;   // nothing was better than the noise
    const report::Facts facts = facts_of(study, trial);
    const std::string id = id_of("q7", study.name(), "before_after");
    add_comparison(answer, {.id = id,
                            .title = words.line("before_after.title", facts),
                            .subtitle = words.line("before_after.subtitle", facts),
                            .caption = words.line("before_after.caption", facts),
                            .before = panel_of(trial.noisy, id + "_noisy", words.line("before_after.noisy", facts)),
                            .after = panel_of(trial.best, id + "_denoised", words.line("before_after.denoised", facts)),
                            .diagonal = study.diagonal,
                            .colormap = colormap,
                            .frame_panel = -1});   // noise may reach beyond the clean box
}

}   // namespace meshfolio::q7_denoising
