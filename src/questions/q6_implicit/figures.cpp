#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "mesh/triangle_measures.h"
#include "questions/core/comparison_figure.h"
#include "questions/core/study_list.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

/// The diagonal of the box around X over that of the input.
double size_left(const ImplicitStudy& study, const Positions& X) {
    return bounding_box(moved_to(study.subject.mesh(), X)).diagonal() / study.subject.diagonal;
}

/// Says something where the box has lost more than four fifths of its diagonal.
std::string shrinkage(double share) {
    if (share > 0.2) return "";
    return share < 1e-4 ? words.line("panel.point") : words.line("panel.shrunk", "share"_a = readable_percent(share, 2));
}

output::Panel panel_of_cell(const ImplicitStudy& study, const SmoothingCell& cell, const std::string& scheme = "implicit",
                            const std::string& suffix = "") {
    const Positions& X = scheme == "implicit" ? cell.implicit_X : cell.explicit_X;
    const std::string what = scheme + "_" + step_name(cell.lambda) + "_t" + std::to_string(cell.iterations) + suffix;
    return smoothing_panel(study.subject, X, id_of("q6", study.name(), what),
                           words.line("panel", "scheme"_a = scheme, "step"_a = step_label(study.subject, cell.lambda),
                                      "iterations"_a = cell.iterations, "shrunk"_a = shrinkage(size_left(study, X))));
}

/// @param what  also begins the keys of its words
void add_figure_of(Answer& answer, const ImplicitStudy& study, const std::string& what, const report::Facts& facts,
                   std::vector<output::Panel> panels) {
    SixViewFigure figure{.id = id_of("q6", study.name(), what),
                         .title = words.line(what + ".title", facts),
                         .subtitle = words.line("figure.subtitle", "critical"_a = readable(study.subject.critical, 4)),
                         .caption = words.line("figure.caption", "caption"_a = words.line(what + ".caption", facts)),
                         .panels = std::move(panels)};
    add_smoothing_figure(answer, study.subject, id_of("q6", study.name(), what + "_before"), std::move(figure));
}

}   // namespace

void add_figures(Answer& answer, const ImplicitStudy& study) {
    std::vector<output::Panel> steps, pairs, iterations;
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        const SmoothingCell& cell = study.middle_cell(l);
        steps.push_back(panel_of_cell(study, cell));
        if (!cell.has_explicit() || pairs.size() == 4) continue;
        pairs.push_back(panel_of_cell(study, cell, "explicit"));
        pairs.push_back(panel_of_cell(study, cell, "implicit", "_beside"));
    }
    const std::size_t second = std::min<std::size_t>(1, study.lambdas.size() - 1);
    for (std::size_t t = 0; t < study.iterations.size(); ++t)
        iterations.push_back(panel_of_cell(study, study.cell(second, t), "implicit", "_series"));

    const report::Facts facts{"mesh"_a = study.name(), "iterations"_a = study.iterations[study.middle_iteration()],
                              "step"_a = step_label(study.subject, study.lambdas[second])};
    add_figure_of(answer, study, "steps", facts, std::move(steps));
    if (!pairs.empty()) add_figure_of(answer, study, "pairs", facts, std::move(pairs));
    if (iterations.size() > 1) add_figure_of(answer, study, "iterations", facts, std::move(iterations));
}

void add_before_after(Answer& answer, const ImplicitStudy& study, const std::string& colormap) {
    if (!study.recommended) return;
    const Recommendation& good = *study.recommended;
    const auto run = std::ranges::find(study.explicit_runs, good.lambda, &SmoothingRun::lambda);
    const int blow_up = run->result.blew_up ? run->result.blow_up_iteration : 0;
    const report::Facts facts{
        "mesh"_a = study.name(),
        "iterations"_a = good.iterations,
        "step"_a = step_label(study.subject, good.lambda),
        "fall"_a = energy_fall(good.energy),
        "kept"_a = readable_percent(good.kept),
        "explicit"_a = words.line(blow_up > 0 ? "before_after.blew_up" : "before_after.lasted", "iteration"_a = blow_up)};
    const std::string id = id_of("q6", study.name(), "before_after");
    add_comparison(answer,
                   {.id = id,
                    .title = words.line("before_after.title", facts),
                    .subtitle = words.line("before_after.subtitle", facts),
                    .caption = words.line("before_after.caption", facts),
                    .before = panel_of(*study.subject.source, id + "_input", "before"),
                    .after = panel_of(moved_to(study.subject.mesh(), good.X), id + "_smoothed", words.line("before_after.after", facts)),
                    .diagonal = study.subject.diagonal,
                    .colormap = colormap});
}

}   // namespace meshfolio::q6_implicit
