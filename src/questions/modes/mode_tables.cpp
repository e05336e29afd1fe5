#include "questions/modes/mode_study.h"

namespace meshfolio::modes {

namespace {

using Style = report::Series::Style;

constexpr double invisible = 1e-13;       // factors below are rounding
constexpr Eigen::Index most_shown = 60;   // points

/// Returns |factor|; NaN if it is rounding.
double visible(double factor) { return std::abs(factor) > invisible ? std::abs(factor) : undefined; }

}   // namespace

report::Plot damping_plot(const ModeStudies& studies) {
    const ModeStudy& study = studies.front();
    const double top = study.subject.top.value;
    const Eigen::Index n = study.eigenvalues.size(), shown = std::min(n, most_shown);
    report::Plot plot{.id = id_of("modes", study.name(), "damping"),
                      .caption = words.line("damping", "steps"_a = study.dampings.front().steps, "mesh"_a = study.name(),
                                            "some"_a = study.all && n > most_shown),
                      .alt = words.line("damping.alt", "modes"_a = n),
                      .x_label = words.line("damping.x"),
                      .y_label = words.line("damping.y"),
                      .log_y = true};
    const auto add_curves = [&](const ModeDamping& damping, const std::string& key, const std::string& panel) {
        report::Series& law = plot.series.emplace_back(report::Series{.name = words.line(key), .panel = panel});
        constexpr int points = 240;
        for (int i = 0; i <= points; ++i) {
            const double share = double(i) / points;
            add_point(law, share, visible(damping.law(share * top)));
        }
        report::Series& measured =
            plot.series.emplace_back(report::Series{.name = words.line(key + ".measured"), .style = Style::points, .panel = panel});
        for (Eigen::Index k = 0; k < shown; ++k) {   // some of the modes, evenly spaced, with the last
            const Eigen::Index i = shown > 1 ? k * (n - 1) / (shown - 1) : 0;
            add_point(measured, study.eigenvalues[i] / top, visible(damping.measured[i]));
        }
    };
    for (int i = 0; i < damped_steps; ++i) {
        const ModeDamping &by_explicit = study.dampings[i], &by_implicit = study.dampings[damped_steps + i];
        const std::string explicit_step = in_limits(study.subject, by_explicit.lambda),
                          implicit_step = in_limits(study.subject, by_implicit.lambda);
        const std::string panel =
            words.line("damping.panel", "step"_a = explicit_step, "implicit"_a = implicit_step == explicit_step ? "" : implicit_step);
        add_curves(by_explicit, "damping.explicit", panel);
        add_curves(by_implicit, "damping.implicit", panel);
    }
    return plot;
}

void add_shape_checks(report::Section& section, const ModeStudies& studies) {
    for (const ModeStudy& study : studies) {
        double damping = 0;
        for (const ModeDamping& d : study.dampings) damping = std::max(damping, d.deviation(study.eigenvalues));
        add(section, check_at_most(words.line("check.damping", "modes"_a = study.eigenvalues.size(), "mesh"_a = study.name()),
                                   law_tolerance, damping));
    }
}

}   // namespace meshfolio::modes
