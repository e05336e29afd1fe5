#include <cmath>

#include "base/number_text.h"
#include "geometry/linear/special_values.h"
#include "questions/core/comparison_figure.h"
#include "questions/core/study_list.h"
#include "questions/q5_explicit/parts.h"

namespace meshfolio::q5_explicit {

namespace {

output::Panel sweep_panel(const ExplicitStudy& study, const SmoothingRun& run) {
    const bool whole = run.in_view_iteration == run.result.iterations;
    return smoothing_panel(study.subject, whole ? run.result.X : run.in_view, id_of("q5", study.name(), step_name(run.lambda)),
                           words.line(whole ? "sweep.step" : "sweep.step.in_view", "step"_a = step_label(study.subject, run.lambda),
                                      "iteration"_a = run.in_view_iteration));
}

}   // namespace

void add_sweep_figure(Answer& answer, const ExplicitStudy& study) {
    const report::Facts facts{"mesh"_a = study.name(), "critical"_a = readable(study.subject.critical, 4),
                              "iterations"_a = study.runs.front().iterations};
    SixViewFigure figure{.id = id_of("q5", study.name(), "sweep"),
                         .title = words.line("sweep.title", facts),
                         .subtitle = words.line("sweep.subtitle", facts),
                         .caption = words.line("sweep.caption", facts)};
    for (const SmoothingRun& run : study.runs) figure.panels.push_back(sweep_panel(study, run));
    add_smoothing_figure(answer, study.subject, id_of("q5", study.name(), "before"), std::move(figure));
}

void add_before_after(Answer& answer, const ExplicitStudy& study, const std::string& colormap) {
    if (!study.recommended) return;
    const SmoothingRun& run = study.recommended->stopped;
    const report::Facts facts{"mesh"_a = study.name(),
                              "iterations"_a = run.result.iterations,
                              "step"_a = step_label(study.subject, run.lambda),
                              "fall"_a = energy_fall(run.energy.back()),
                              "turn"_a = readable(run.moved.mean_normal_angle * 180 / pi),
                              "volume"_a = words.line("before_after.volume", "volume"_a = readable_percent(run.size.back()))};
    const std::string id = id_of("q5", study.name(), "before_after");
    add_comparison(
        answer, {.id = id,
                 .title = words.line("before_after.title", facts),
                 .subtitle = words.line("before_after.subtitle", facts),
                 .caption = words.line("before_after.caption", facts),
                 .before = panel_of(*study.subject.source, id + "_input", "before"),
                 .after = panel_of(moved_to(study.subject.mesh(), run.result.X), id + "_smoothed", words.line("before_after.after", facts)),
                 .diagonal = study.subject.diagonal,
                 .colormap = colormap});
}

}   // namespace meshfolio::q5_explicit
