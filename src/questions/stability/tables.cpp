// Tables, plots and checks of the section "stability".
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/stability/parts.h"

namespace meshfolio::stability {

namespace {

/// |1 − λμ|ᵗ or what was measured of it, at some fifteen steps of the run.
/// @param first  step to begin with: runs that obey one law would hide each other, so their points alternate
report::Series curve(const std::string& name, const ModeGrowth& growth, bool measured, double first = 0) {
    report::Series series;
    series.name = name;
    series.style = measured ? report::Series::Style::points : report::Series::Style::dashed;
    const int stride = std::max(2, growth.steps() / 15);
    for (int t = static_cast<int>(first * stride); t <= growth.steps(); t += stride) {
        series.x.push_back(t);
        series.y.push_back(measured ? growth.factor[static_cast<std::size_t>(t)] : growth.predicted(t));
    }
    return series;
}

std::string vertex_text(int vertex) { return vertex >= 0 ? std::to_string(vertex) : "–"; }

/// The step something happened in, or "never".
report::Cell when(int iteration) { return iteration > 0 ? std::to_string(iteration) : std::string("never"); }

/// 1e-8, unless the rounding of a large factor forbids it.
report::Check width_check(std::string name, const StabilityCertificate& proved) {
    constexpr double wanted = 1e-8;
    report::Check check = report::check_at_most(std::move(name), wanted, proved.relative_width());
    if (check.passed() || proved.rounding < 0.2 * wanted) return check;
    return report::undecided(std::move(check), "the rounding of a factor of " +
                                                   counted(static_cast<int>(proved.factor_nonzeros), "entry", "entries") +
                                                   " forbids a narrower bracket");
}

/// Where that is neither proved nor refuted, the check decides nothing.
report::Check semidefinite_check(std::string name, const StabilityCertificate& proved) {
    const Definiteness& d = proved.bottom;
    report::Check check = report::check_at_least(std::move(name), 0, (d.indefinite() ? d.mu_high : d.mu_low) / proved.mu_high, 1e-10);
    if (d.semidefinite() || d.indefinite()) return check;
    return report::undecided(std::move(check), "μ_min lies between " + readable(d.mu_low, 2) + " and " + readable(d.mu_high, 2) +
                                                   ", which cannot be told from 0");
}

}   // namespace

report::Table certificate_table(const std::vector<StabilityStudy>& studies) {
    report::Table table;
    table.id = "stability_certificates";
    table.caption =
        "The limit of explicit smoothing between two proved bounds, the vertex that sets it, and how many vertices share its mode. Width: "
        "how far the bounds are apart. Tries: 1 when the Cholesky factorisation just above the value of Lanczos ran to its end at once. "
        "Below 0: no eigenvalue of −L lies farther below 0 than this share of μ_max, which is rounding. "
        "Safe λ: twice the inverse of the Gershgorin bound, rounded down, which stands beside μ_max in the last column. λ of the uniform "
        "operator has no "
        "unit.";
    table.columns = {{"mesh", "", 3},
                     {"operator", "", 3},
                     {"vertex", "", 8},
                     {"sharing", "vertices", 3},
                     {.name = "stable up to λ", .unit = "length²", .digits = 10, .rounding = report::Column::Rounding::down},
                     {.name = "unstable beyond λ", .unit = "length²", .digits = 10, .rounding = report::Column::Rounding::up},
                     {"width", "relative", 2},
                     {"tries", "", 3},
                     {.name = "below 0", .unit = "of μ_max", .digits = 2, .rounding = report::Column::Rounding::up},
                     {.name = "safe λ", .unit = "length²", .digits = 4, .rounding = report::Column::Rounding::down},
                     {"bound / μ_max", "", 3}};
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit* limit : study.operators()) {
            const StabilityCertificate& proved = limit->certificate;
            table.rows.push_back({study.name(), limit->name, double(proved.top.vertex), proved.top.support, proved.lambda_low(),
                                  proved.lambda_high(), proved.relative_width(), double(proved.factorisations),
                                  -proved.bottom.mu_low / proved.mu_high, proved.lambda_safe(), proved.top.upper_bound / proved.top.value});
        }
    }
    return table;
}

report::Table unit_table(const std::vector<StabilityStudy>& studies) {
    report::Table table;
    table.id = "stability_units";
    table.caption =
        "Steps of the cotangent operator in all units: raw (an area), τ = λμ_max/2, which is 1 at the limit, and λ over the squared mean "
        "edge. The last column is how far ten such steps reach: ℓ = √(4λt) as a share of the box diagonal.";
    table.columns = {{"mesh", "", 3}, {"step", "", 3}, {"λ", "length²", 4},
                     {"τ", "", 4},    {"λ/h̄²", "", 3}, {"ten steps reach", "% of box", 3}};
    for (const StabilityStudy& study : studies) {
        const double critical = study.cotangent.critical();
        const std::vector<std::pair<std::string, double>> steps = {{"limit", critical},
                                                                   {"largest without overshoot", 0.5 * critical},
                                                                   {"safe by Gershgorin", study.cotangent.certificate.lambda_safe()},
                                                                   {"one hundredth of h̄²", 0.01 * study.mean_edge * study.mean_edge}};
        for (const auto& [name, lambda] : steps) {
            const StepInUnits units = step_in_units(lambda, critical, study.mean_edge);
            table.rows.push_back(
                {study.name(), name, units.raw, units.tau, units.h2, 100 * smoothing_strength(10 * lambda, study.diagonal)});
        }
    }
    return table;
}

report::Table growth_table(const std::vector<StabilityStudy>& studies) {
    report::Table table;
    table.id = "stability_growth";
    table.caption =
        "The coefficient of the top mode after many steps of the frozen operator, over that at the start, where the mode is a thousandth "
        "of "
        "the mean edge high: measured beside the predicted |1 − λμ_max|\u2060ᵗ. Energy: Dirichlet energy at the end over that at the "
        "start.";
    table.columns = {{"mesh", "", 3},
                     {"operator", "", 3},
                     {"λ/λ_crit", "", 3},
                     {"steps", "", 5},
                     {"predicted factor", "", 6},
                     {"measured factor", "", 6},
                     {"measured/predicted − 1", "", 2},
                     {"energy", "of start", 3}};
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit* limit : study.operators()) {
            for (const ModeGrowth* growth : {&limit->below, &limit->beyond}) {
                const double predicted = growth->predicted(growth->steps());
                table.rows.push_back({study.name(), limit->name, growth->lambda / limit->critical(), double(growth->steps()), predicted,
                                      growth->factor.back(), growth->factor.back() / predicted - 1, growth->energy_ratio});
            }
        }
    }
    return table;
}

report::Plot growth_plot(const StabilityStudy& study) {
    report::Plot plot;
    plot.id = id_of("stability", study.name(), "growth");
    plot.x_label = "step";
    plot.y_label = "top mode / that at the start";
    plot.log_y = true;
    for (const OperatorLimit* limit : study.operators()) {
        const double first = limit == &study.cotangent ? 0 : 0.5;
        plot.series.push_back(curve(limit->name + ", 1.01 λ_crit", limit->beyond, true, first));
        plot.series.push_back(curve(limit->name + ", 0.99 λ_crit", limit->below, true, first));
    }
    plot.series.push_back(curve("predicted, 1.01 λ_crit", study.cotangent.beyond, false));
    plot.series.push_back(curve("predicted, 0.99 λ_crit", study.cotangent.below, false));
    const int steps = study.cotangent.beyond.steps();
    plot.caption = "The top mode of " + study.name() + " over " + std::to_string(steps) + " explicit steps: at 1.01 λ_crit it ends at " +
                   readable(study.cotangent.beyond.factor.back(), 4) + " times its start (cotangent) and " +
                   readable(study.uniform.beyond.factor.back(), 4) + " times (uniform), at 0.99 λ_crit at " +
                   readable(study.cotangent.below.factor.back(), 3) + " and " + readable(study.uniform.below.factor.back(), 3) +
                   ". Dashed: |1 − λμ_max|\u2060ᵗ. Points of the two operators alternate.";
    plot.alt = plot.caption;
    return plot;
}

report::Table flow_table(const RebuiltFlow& flow) {
    report::Table table;
    table.id = id_of("stability", flow.name(), "flow_table");
    table.caption = "Curvature flow of " + flow.name() + ", where it crosses the limit, turns a triangle over and leaves " +
                    readable(SmoothingOptions().blow_up_at) + " box diagonals. Rebuilt: the operator of the current positions in each of " +
                    counted(flow.iterations, "step") + ", from half the limit of the input; adaptive: no step exceeds " +
                    readable(flow.share, 3) +
                    " of the limit that the Gershgorin bound of its operator proves. Frozen: the operator of "
                    "the input, " +
                    readable(flow.beyond, 1) + " times its limit, at most " + counted(flow.frozen.iterations, "step") + ".";
    table.columns = {{"run"},
                     {"largest λμ_max", "", 4},
                     {"beyond 2 in step"},
                     {"at vertex"},
                     {"first face turned in step"},
                     {"face"},
                     {"blew up in step"},
                     {"at vertex", "first"},
                     {"turned at the end", "faces", 6}};
    for (const auto& [name, watched] : flow.runs()) {
        const Smoothed& run = watched->run;
        table.rows.push_back({name, largest_product(run), when(run.crossing_iteration), vertex_text(run.crossing_vertex),
                              when(watched->turned_iteration), vertex_text(watched->turned_face), when(run.blow_up_iteration),
                              vertex_text(run.blow_up_vertex), double(watched->inverted)});
    }
    return table;
}

report::Table flow_time_table(const RebuiltFlow& flow) {
    report::Table table;
    table.id = id_of("stability", flow.name(), "flow_time");
    table.caption = "How far each of these runs of " + flow.name() + " came.";
    table.columns = {{"run"},
                     {"first λ", "length²", 4},
                     {"last λ", "of the first", 3},
                     {"steps done", "", 6},
                     {"time reached", "length²", 4},
                     {"time reached", "% of steps × λ", 4},
                     {"ended by"}};
    for (const auto& [name, watched] : flow.runs()) {
        const Smoothed& run = watched->run;
        const std::string end = run.blew_up ? "blow-up" : run.collapse_iteration > 0 ? "collapse" : "number of steps";
        table.rows.push_back({name, watched->lambda, run.steps.back().lambda / watched->lambda, double(run.iterations), run.time,
                              100 * run.time / (watched->lambda * watched->iterations), end});
    }
    return table;
}

report::Plot flow_plot(const RebuiltFlow& flow) {
    report::Plot plot;
    plot.id = id_of("stability", flow.name(), "flow");
    plot.x_label = "step";
    plot.y_label = "λμ_max of the operator in use";
    plot.log_y = true;
    for (const auto& [name, watched] : flow.runs()) {
        report::Series series;
        series.name = name;
        series.style = report::Series::Style::line_and_points;
        const std::vector<StepStability>& steps = watched->run.steps;
        for (std::size_t t = 0; t < steps.size(); ++t) {
            series.x.push_back(double(t + 1));
            series.y.push_back(steps[t].top);
        }
        plot.series.push_back(std::move(series));
    }
    plot.series.push_back({"limit 2", {1, double(flow.iterations)}, {2, 2}, {}, {}, report::Series::Style::dashed});
    plot.caption = "λμ_max of the curvature flow of " + flow.name() + ": with the operator rebuilt and fixed λ it goes from " +
                   readable(flow.fixed.run.steps.front().top, 3) + " to " + readable(largest_product(flow.fixed.run), 3) +
                   " at most, with the adaptive step it stays at or below " + readable(largest_product(flow.adaptive.run), 3) +
                   "; with the frozen operator it is " + readable(largest_product(flow.frozen.run), 3) + " in every step" +
                   (flow.frozen.run.blew_up ? ", until the run blows up in step " + std::to_string(flow.frozen.run.blow_up_iteration) +
                                                  " at vertex " + std::to_string(flow.frozen.run.blow_up_vertex)
                                            : std::string()) +
                   ".";
    plot.alt = plot.caption;
    return plot;
}

std::vector<report::Check> stability_checks(const std::vector<StabilityStudy>& studies, const RebuiltFlow& flow) {
    using report::check_at_least;
    using report::check_at_most;
    using report::check_near;
    std::vector<report::Check> checks;
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit* limit : study.operators()) {
            const std::string on = " of the " + limit->name + " operator on " + study.name();
            const StabilityCertificate& proved = limit->certificate;
            checks.push_back(width_check("Relative width of the proved bounds" + on, proved));
            checks.push_back(semidefinite_check("−C has no eigenvalue below 0 but for rounding, μ_min / μ_max" + on, proved));
            checks.push_back(
                check_at_least("Gershgorin bound / proved upper bound" + on, 1, proved.top.upper_bound / proved.mu_high, 1e-8));
            checks.push_back(check_near("Growth at 1.01 λ_crit, measured / predicted" + on, 1,
                                        limit->beyond.factor.back() / limit->beyond.predicted(limit->beyond.steps()), 1e-3));
            checks.push_back(check_at_most("Largest factor of the top mode at 0.99 λ_crit after the start" + on, 1,
                                           *std::max_element(limit->below.factor.begin() + 1, limit->below.factor.end())));
            checks.push_back(check_at_most("Factor of the top mode at 0.99 λ_crit, less that predicted" + on, 0,
                                           limit->below.factor.back() - limit->below.predicted(limit->below.steps()), 1e-6));
        }
        checks.push_back(check_at_most("Uniform μ_max lies in (0, 2] on " + study.name(), 2, study.uniform.certificate.mu_low));
    }
    checks.push_back(check_at_most("Largest λμ_max of the adaptive flow of " + flow.name(), 2, largest_product(flow.adaptive.run)));
    return checks;
}

}   // namespace meshfolio::stability
