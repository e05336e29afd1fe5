// Tables, plots and checks of the section "modes".
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/modes/parts.h"

namespace meshfolio::modes {

namespace {

using Style = report::Series::Style;

constexpr double invisible = 1e-13;   // factors below are rounding

std::string scheme_name(SmoothingScheme scheme) { return scheme == SmoothingScheme::explicit_euler ? "explicit" : "implicit"; }

std::string relative_step(const ModeStudy& study, double lambda) { return plain_text(lambda / study.subject.critical, 3) + "\u202fλ_crit"; }

/// |factor| where it can be seen above rounding.
double visible(double factor) { return std::abs(factor) > invisible ? std::abs(factor) : std::nan(""); }

report::Series law_line(const ModeStudy& study, const ModeDamping& damping) {
    report::Series line{relative_step(study, damping.lambda), {}, {}};
    constexpr int points = 240;
    for (int i = 0; i <= points; ++i) {
        line.x.push_back(double(i) / points);
        line.y.push_back(visible(damping.law(line.x.back() * study.subject.top.value)));
    }
    return line;
}

/// Some sixty of the modes, evenly through them, the last included.
report::Series measured_points(const ModeStudy& study, const ModeDamping& damping) {
    report::Series points{relative_step(study, damping.lambda) + ", measured", {}, {}, {}, {}, Style::points};
    const Eigen::Index n = study.eigenvalues.size(), shown = std::min<Eigen::Index>(n, 60);
    for (Eigen::Index k = 0; k < shown; ++k) {
        const Eigen::Index i = shown > 1 ? k * (n - 1) / (shown - 1) : 0;
        points.x.push_back(study.eigenvalues[i] / study.subject.top.value);
        points.y.push_back(visible(damping.measured[i]));
    }
    return points;
}

/// A curve over the targets that are reached at all.
template <class Value>
report::Series over_targets(const ModeStudy& study, std::string name, Value value) {
    report::Series line{std::move(name), {}, {}};
    for (const SmoothingTarget& target : study.curve) {
        line.x.push_back(100 * target.energy);
        line.y.push_back(value(target));
    }
    return line;
}

double operations_of(const SmoothingWay& way) { return way.steps > 0 ? way.operations : std::nan(""); }

report::Plot empty_target_plot(const ModeStudy& study, const std::string& what, std::string y_label) {
    report::Plot plot;
    plot.id = id_of("modes", study.name(), what);
    plot.x_label = "Dirichlet energy left [% of the input's]; smoother to the left";
    plot.y_label = std::move(y_label);
    plot.log_x = plot.log_y = true;
    return plot;
}

/// Runs whose energy is above rounding, and the largest relative difference between it and what was said beforehand.
std::pair<int, double> worst_energy(const ModeStudy& study) {
    std::pair<int, double> worst{0, 0};
    for (const TriedWay& run : study.tried) {
        if (!(run.rounding < 1e-7)) continue;
        ++worst.first;
        worst.second = std::max(worst.second, std::abs(run.energy / run.way.energy - 1));
    }
    return worst;
}

}   // namespace

report::Table damping_table(const std::vector<ModeStudy>& studies) {
    report::Table table;
    table.id = "modes_damping";
    table.caption =
        "Coordinates that have each mode in them with coefficient 1 are smoothed, and every coefficient is compared with its law. Left of "
        "the "
        "top mode: its factor after the steps, with its sign, predicted and measured. Deviation: the largest of all modes, over the "
        "largest "
        "factor and 1.";
    table.columns = {{"mesh", "", 3},
                     {"modes", "", 6},
                     {"scheme", "", 3},
                     {"λ/λ_crit", "", 3},
                     {"steps", "", 4},
                     {"left of the top mode", "law", 5},
                     {"left of the top mode", "measured", 5},
                     {"deviation", "", 2}};
    for (const ModeStudy& study : studies) {
        const std::string modes = std::to_string(study.eigenvalues.size()) + (study.all ? " (all)" : "");
        const Eigen::Index top = study.eigenvalues.size() - 1;
        for (const ModeDamping& d : study.dampings) {
            table.rows.push_back({study.name(), modes, scheme_name(d.scheme), d.lambda / study.subject.critical, double(d.steps),
                                  d.law(study.eigenvalues[top]), d.measured[top], d.deviation(study.eigenvalues)});
        }
    }
    return table;
}

report::Plot damping_plot(const ModeStudy& study, SmoothingScheme scheme) {
    report::Plot plot;
    const std::string name = scheme_name(scheme);
    plot.id = id_of("modes", study.name(), name);
    plot.x_label = "eigenvalue μ/μ_max";
    plot.y_label = "what is left of a mode";
    plot.log_y = true;
    std::vector<std::string> steps;
    for (const ModeDamping& d : study.dampings) {
        if (d.scheme == scheme) plot.series.push_back(law_line(study, d));
    }
    int law = 0;
    for (const ModeDamping& d : study.dampings) {
        if (d.scheme != scheme) continue;
        plot.series.push_back(measured_points(study, d));
        plot.series.back().color = plot.series.back().pattern = law++;   // of the line they are to lie on
        steps.push_back(relative_step(study, d.lambda));
    }
    const int count = study.dampings.front().steps;
    plot.caption = "What " + std::to_string(count) + " " + name + " steps leave of each mode of " + study.name() + ": lines " +
                   (scheme == SmoothingScheme::explicit_euler ? "|1 − λμ|" : "1/(1 + λμ)") + " to the power " + std::to_string(count) +
                   ", points measured" + (study.all && study.eigenvalues.size() > 60 ? ", of some sixty of them." : ".");
    plot.alt =
        "Factors of " + counted(static_cast<int>(study.eigenvalues.size()), "mode") + " at " + listed(steps) +
        ": the points lie on the lines of the law" +
        (scheme == SmoothingScheme::explicit_euler ? ", which dip where λμ = 1 and rise again towards μ_max." : ", which only fall.");
    return plot;
}

report::Table gap_table(const std::vector<ModeStudy>& studies) {
    report::Table table;
    table.id = "modes_gap";
    table.caption =
        "Explicit against implicit at equal step and iterations: area-weighted rms distance of the results. Predicted: from the spectral "
        "measure of the input, before either run. First order: tλ²‖L² exp(tλL) X‖, what is left of it for small steps. –: the "
        "explicit run blew up.";
    table.columns = {{"mesh", "", 3},
                     {"λ", "length²", 3},
                     {"λ/λ_crit", "", 3},
                     {"iterations", "", 5},
                     {"motion", "% of box", 4},
                     {"gap measured", "% of box", 4},
                     {"gap predicted", "% of box", 4},
                     {"first order", "% of box", 3},
                     {"gap / motion", "%", 3}};
    for (const ModeStudy& study : studies) {
        for (const SchemeGap& gap : study.gaps) {
            table.rows.push_back({study.name(), gap.lambda, gap.lambda / study.subject.critical, double(gap.steps), 100 * gap.motion,
                                  cell_of(100 * gap.measured), cell_of(100 * gap.predicted, gap.predicted < 1e10),
                                  cell_of(100 * gap.leading), cell_of(100 * gap.measured / gap.motion)});
        }
    }
    return table;
}

report::Table cost_table(const ModeStudy& study) {
    report::Table table;
    table.id = id_of("modes", study.name(), "cost");
    table.caption =
        "What a given smoothness of " + study.name() +
        " costs. Explicit: at 0.95 λ_crit, as many steps as it takes. Implicit: 1, 3 or 10 steps of the λ that reaches the "
        "energy exactly, as few as stay within " +
        readable_percent(implicit_accuracy, 1) +
        " of the exact flow, and as few as are as true to it as the explicit result. Error: rms distance from the exact flow of "
        "the same energy, over the motion of that flow. Multiply–adds with the factorisation (" +
        readable(study.factor.factorisation) + " of them), without its symbolic analysis.";
    table.columns = {{"energy left", "% of input", 3},   {"way", "", 3},          {"λ/λ_crit", "", 3}, {"steps", "", 7}, {"error", "%", 3},
                     {"operations", "multiply–adds", 3}, {"over explicit", "", 3}};
    for (const SmoothingTarget& target : study.targets) {
        const auto add = [&](const std::string& name, const SmoothingWay& way) {
            const bool there = way.steps > 0, both = there && target.explicit_way.steps > 0;
            table.rows.push_back({100 * target.energy, name, cell_of(way.lambda / study.subject.critical, way.lambda > 0),
                                  cell_of(way.steps, there), cell_of(100 * way.error, there), cell_of(way.operations, there),
                                  cell_of(both ? way.operations / target.explicit_way.operations : 0, both)});
        };
        add("explicit", target.explicit_way);
        const auto names = implicit_way_names();
        for (std::size_t which = 0; which < names.size(); ++which) add(names[which], target.implicit_ways[which]);
    }
    return table;
}

report::Plot cost_plot(const ModeStudy& study) {
    report::Plot plot = empty_target_plot(study, "operations", "multiply–adds, factorisation included");
    plot.series.push_back(
        over_targets(study, "explicit, 0.95 λ_crit", [](const SmoothingTarget& t) { return operations_of(t.explicit_way); }));
    std::vector<std::string> crossings;
    const auto names = implicit_way_names();
    for (std::size_t which = 0; which < names.size(); ++which) {
        plot.series.push_back(
            over_targets(study, names[which], [&](const SmoothingTarget& t) { return operations_of(t.implicit_ways[which]); }));
        const auto& crossing = study.crossings[which];
        if (!crossing) continue;
        if (crossing->energy < study.curve.front().energy)
            plot.markers.push_back({100 * crossing->energy, operations_of(crossing->implicit_ways[which]), ""});
        crossings.push_back("“" + names[which] + "” below " + readable_percent(crossing->energy, 2));
    }
    plot.caption = "Operations for a given smoothness of " + study.name() + ". Rings: from there on the implicit way is the cheaper one.";
    plot.alt =
        "Explicit operations rise as less energy is left; " +
        (crossings.empty() ? std::string("no implicit way becomes cheaper.") : "it becomes cheaper to take " + listed(crossings) + ".");
    return plot;
}

report::Plot truth_plot(const ModeStudy& study) {
    report::Plot plot = empty_target_plot(study, "truth", "distance from the exact flow [% of its motion]");
    const auto error = [](const SmoothingWay& way) { return way.steps > 0 ? 100 * way.error : std::nan(""); };
    plot.series.push_back(over_targets(study, "explicit, 0.95 λ_crit", [&](const SmoothingTarget& t) { return error(t.explicit_way); }));
    const auto names = implicit_way_names();
    for (std::size_t which = 0; which < std::size(implicit_steps); ++which)
        plot.series.push_back(over_targets(study, names[which], [&](const SmoothingTarget& t) { return error(t.implicit_ways[which]); }));
    plot.caption = "How true each way is to the exact flow of " + study.name() + " with the same energy: what the operations buy.";
    const SmoothingTarget& last = study.curve.back();
    plot.alt = "At " + readable_percent(last.energy, 2) + " of the energy the explicit result is " +
               readable_percent(last.explicit_way.error, 2) + " of the motion from the exact flow, one implicit step " +
               readable_percent(last.implicit_ways.front().error, 2) + ".";
    return plot;
}

report::Table crossing_table(const std::vector<ModeStudy>& studies) {
    report::Table table;
    table.id = "modes_crossing";
    table.caption =
        "From which smoothness on implicit is cheaper: the energy below which each way takes fewer operations than explicit smoothing, "
        "down "
        "to the least energy looked at, to which the spectral measure reaches (–: nowhere), and the errors there. Step, factorisation: "
        "what an implicit step and a factorisation cost, in explicit steps.";
    table.columns = {{"mesh", "", 3},
                     {"step", "explicit steps", 3},
                     {"factorisation", "explicit steps", 3},
                     {"down to", "% of energy", 2},
                     {"way", "", 3},
                     {"cheaper below", "% of energy", 3},
                     {"steps there", "", 5},
                     {"its error", "%", 3},
                     {"explicit error", "%", 3}};
    for (const ModeStudy& study : studies) {
        const auto names = implicit_way_names();
        for (std::size_t which = 0; which < names.size(); ++which) {
            const bool there = study.crossings[which].has_value();
            const SmoothingTarget& at = there ? *study.crossings[which] : study.curve.front();
            const SmoothingWay& way = at.implicit_ways[which];
            table.rows.push_back({study.name(), study.implicit_step / study.explicit_step, study.factor.factorisation / study.explicit_step,
                                  100 * study.curve.back().energy, names[which], cell_of(100 * at.energy, there), cell_of(way.steps, there),
                                  cell_of(100 * way.error, there),
                                  cell_of(100 * at.explicit_way.error, there && at.explicit_way.steps > 0)});
        }
    }
    return table;
}

bool seen(const ModeStudy& study, const SchemeGap& gap) { return gap.measured > 1e8 * study.rounding; }

std::vector<report::Check> mode_checks(const std::vector<ModeStudy>& studies) {
    std::vector<report::Check> checks;
    for (const ModeStudy& study : studies) {
        const std::string on = " on " + study.name();
        double damping = 0, gap = 0;
        int gaps = 0;
        for (const ModeDamping& d : study.dampings) damping = std::max(damping, d.deviation(study.eigenvalues));
        for (const SchemeGap& g : study.gaps) {
            if (!(g.lambda <= study.subject.critical && seen(study, g))) continue;
            gap = std::max(gap, std::abs(g.predicted / g.measured - 1));
            ++gaps;
        }
        checks.push_back(report::check_at_most(
            "largest deviation of " + counted(static_cast<int>(study.eigenvalues.size()), "mode") + " from the laws of damping" + on, 1e-9,
            damping));
        if (gaps > 0) checks.push_back(report::check_at_most("gap between the schemes, predicted / measured − 1" + on, 1e-6, gap));
        if (const auto [runs, worst] = worst_energy(study); runs > 0)
            checks.push_back(report::check_at_most("energy of " + counted(runs, "run") + ", measured / predicted − 1" + on, 1e-6, worst));
    }
    return checks;
}

}   // namespace meshfolio::modes
