// Tables and checks of the section "prediction".
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/prediction/parts.h"

namespace meshfolio::prediction {

namespace {

using Columns = std::vector<report::Column>;

/// What every table begins with: mesh and noise.
Columns begun(Columns more) {
    Columns columns{{"mesh", "", 3}, {"σ", "% of box", 3}, {"σ", "mean edges", 3}};
    columns.insert(columns.end(), more.begin(), more.end());
    return columns;
}
std::vector<report::Cell> begun(const PredictionStudy& study, const NoiseLevelStudy& level, std::vector<report::Cell> more) {
    std::vector<report::Cell> row{study.name(), 100 * level.sigma, level.sigma_edges};
    row.insert(row.end(), more.begin(), more.end());
    return row;
}

/// "23", or "40, still falling" at the end of the run.
report::Cell best_cell(int best, int iterations) {
    return best < iterations || best == 0 ? std::to_string(best) : std::to_string(best) + ", still falling";
}

std::string collapsed_words(const std::vector<PredictionStudy>& studies) {
    int collapsed = 0;
    for (const PredictionStudy& study : studies) {
        for (const NoiseLevelStudy& level : study.levels) {
            for (const OperatorStudy& operated : level.operators) collapsed += operated.collapsed;
        }
    }
    if (collapsed == 0) return "No run ended early.";
    return counted(collapsed, "run") + " ended early, because triangles collapsed, and " + (collapsed == 1 ? "stays" : "stay") +
           " where that was.";
}

report::Cell best_of(const PredictedCurve* prediction, int iterations) {
    return prediction == nullptr ? report::Cell{} : best_cell(prediction->best(), iterations);
}

report::Cell deviation_of(const OperatorStudy& study, std::string_view name) {
    const PredictedCurve* prediction = study.prediction(name);
    if (prediction == nullptr) return {};
    const double off = deviation(*prediction, study.measured);
    return off > deviation_shown ? report::Cell{"> " + plain_text(100 * deviation_shown)}
                                 : report::Cell{100 * off};   // a derivative near a collapse has no bound
}

/// "on cube from all 602 modes, on lily from 18 probes"
std::string how_predicted(const std::vector<PredictionStudy>& studies) {
    std::string told;
    for (const PredictionStudy& study : studies) {
        const DenoisingPrediction& p = study.prediction;
        told += (told.empty() ? "on " : ", on ") + study.name() + " from ";
        told += p.modes > 0 ? "all " + std::to_string(p.modes) + " modes" : std::to_string(p.probes) + " probes";
    }
    return told;
}

}   // namespace

double largest_mass_deviation(const PredictionStudy& study, const NoiseLevelStudy& level) {
    const MeasuredCurve& measured = level.of(FlowOperator::clean).measured;
    const ExpectedError& expected = study.prediction.mass;
    const Vector predicted = expected.squared(level.sigma) / expected.weight_sum;
    double largest = 0;
    for (Eigen::Index t = 0; t < measured.mass.size(); ++t) {
        largest = std::max(largest, std::abs(std::sqrt(predicted[t] / measured.mass[t]) - 1));
    }
    return largest;
}

report::Table clean_prediction_table(const std::vector<PredictionStudy>& studies) {
    report::Table table;
    table.id = "prediction_clean";
    table.caption =
        "The clean mesh's operator: what the formula expects before any noise is drawn, and the mean of " +
        counted(studies.front().seeds, "noisy mesh", "noisy meshes") +
        ". Errors: root of the mean squared error over vertices and seeds, at the measured best iteration. Farthest: largest deviation of "
        "the expected from the measured curve over all iterations, for the plain rms and weighted by area; and in standard errors of the "
        "mean of the squared error, that of the probes included, the larger of both norms. Regret: by how much the measured error at the "
        "expected best iteration exceeds the smallest. Expected: " +
        how_predicted(studies) + ".";
    table.columns = begun({{"best iteration, expected"},
                           {"best iteration, measured"},
                           {"by area, expected"},
                           {"by area, measured"},
                           {"error, expected", "% of box", 4},
                           {"error, measured", "% of box", 4},
                           {"farthest, vertices", "%", 2},
                           {"farthest, area", "%", 2},
                           {"farthest", "std. errors", 2},
                           {"regret", "%", 2}});
    for (const PredictionStudy& study : studies) {
        for (const NoiseLevelStudy& level : study.levels) {
            const OperatorStudy& clean = level.of(FlowOperator::clean);
            const int best = clean.measured.best(), steps = clean.measured.iterations();
            const StandardDistance off = standard_distance(study, level);
            table.rows.push_back(
                begun(study, level,
                      {best_cell(clean.formula().best(), steps), best_cell(best, steps),
                       best_cell(std::min(study.prediction.mass.best(level.sigma), steps), steps),
                       best_cell(first_smallest(clean.measured.mass), steps), 100 * std::sqrt(clean.formula().square[best]),
                       100 * std::sqrt(clean.measured.square[best]), 100 * deviation(clean.formula(), clean.measured),
                       100 * largest_mass_deviation(study, level), std::max(off.vertices, off.mass), 100 * clean.regret_of_formula}));
        }
    }
    return table;
}

report::Table operator_prediction_table(const std::vector<PredictionStudy>& studies) {
    report::Table table;
    table.id = "prediction_operators";
    table.caption =
        "The operators that a user has: that of the noisy mesh, and that of the current positions at every step. Best iteration, measured "
        "over " +
        counted(studies.front().seeds, "seed") + " and foreseen, and how far each prediction of the rms error is off at most. " +
        "Formula: the operator of the clean mesh. Draws: the same formula with the operators of " +
        counted(studies.front().draws, "other noisy mesh", "other noisy meshes") +
        ", mean. First order: bias of the run without noise, and the derivative of the whole run, of which the operator's is "
        "a "
        "part (" +
        counted(studies.front().derivative_probes, "probe") + "). Stein: the estimate from the noisy meshes alone, σ known, mean. " +
        collapsed_words(studies);
    table.columns = begun({{"operator"},
                           {"best, measured"},
                           {"formula", "best"},
                           {"draws", "best"},
                           {"first order", "best"},
                           {"Stein", "best"},
                           {"formula", "% off", 2},
                           {"draws", "% off", 2},
                           {"first order", "% off", 2},
                           {"Stein", "% off", 2}});
    for (const PredictionStudy& study : studies) {
        for (const NoiseLevelStudy& level : study.levels) {
            for (const FlowOperator kind : {FlowOperator::noisy, FlowOperator::rebuilt}) {
                const OperatorStudy& own = level.of(kind);
                const int steps = own.measured.iterations();
                table.rows.push_back(
                    begun(study, level,
                          {name_of(kind), best_cell(own.measured.best(), steps), best_of(own.prediction(by_formula), steps),
                           best_of(own.prediction(by_draws), steps), best_of(own.prediction(by_derivative), steps),
                           best_of(own.prediction(by_stein), steps), deviation_of(own, by_formula), deviation_of(own, by_draws),
                           deviation_of(own, by_derivative), deviation_of(own, by_stein)}));
            }
        }
    }
    return table;
}

ErrorAccount error_account(const NoiseLevelStudy& level) {
    const OperatorStudy& own = level.of(FlowOperator::noisy);
    const Vector &measured = own.measured.square, &formula = own.formula().square, &draws = own.prediction(by_draws)->square;
    Eigen::Index t = 0;
    (formula.cwiseQuotient(measured).array().log().abs()).maxCoeff(&t);
    const double noise = 3 * level.sigma * level.sigma;
    ErrorAccount account;
    account.iteration = static_cast<int>(t);
    account.formula = formula[t] / noise;
    account.numbers = (draws[t] - formula[t]) / noise;
    account.knowledge = (measured[t] - draws[t]) / noise;
    account.measured = measured[t] / noise;
    const MeasuredCurve& clean = level.of(FlowOperator::clean).measured;
    const double variance = level.sigma * level.sigma;
    account.along_own = own.measured.along[t] / (2 * variance);
    account.along_clean = clean.along[t] / (2 * variance);
    account.across_own = (measured[t] - own.measured.along[t]) / variance;
    account.across_clean = (clean.square[t] - clean.along[t]) / variance;
    return account;
}

report::Table why_table(const std::vector<PredictionStudy>& studies) {
    report::Table table;
    table.id = "prediction_why";
    table.caption =
        "Why the formula fails with the noisy mesh's own operator, at the iteration where it is farthest off: the mean squared error as a "
        "share of the noise's, 3σ², made up of what the formula expects, what the other numbers of a noisy operator add (those of other "
        "draws, which know nothing of the noise they smooth), and what is left: that the operator is made from the very noise it smooths. "
        "Along and across the clean surface: the squared error over that of the noise in these directions, 2σ² and σ², with the own and "
        "with "
        "the clean operator. Area and negative weights: of the noisy meshes, area over that of the clean mesh.";
    table.columns = begun({{"iteration"},
                           {"formula", "% of noise", 3},
                           {"other numbers", "% of noise", 3},
                           {"own noise", "% of noise", 3},
                           {"measured", "% of noise", 3},
                           {"along, own", "% of noise", 3},
                           {"along, clean", "% of noise", 3},
                           {"across, own", "% of noise", 3},
                           {"across, clean", "% of noise", 3},
                           {"area", "× clean", 3},
                           {"negative weights", "%", 2}});
    for (const PredictionStudy& study : studies) {
        for (const NoiseLevelStudy& level : study.levels) {
            const ErrorAccount account = error_account(level);
            table.rows.push_back(
                begun(study, level,
                      {std::to_string(account.iteration), 100 * account.formula, 100 * account.numbers, 100 * account.knowledge,
                       100 * account.measured, 100 * account.along_own, 100 * account.along_clean, 100 * account.across_own,
                       100 * account.across_clean, level.facts.area, 100 * level.facts.negative_weights}));
        }
    }
    return table;
}

report::Table rule_table(const std::vector<PredictionStudy>& studies) {
    report::Table table;
    table.id = "prediction_rule";
    table.caption =
        "Choosing the iteration without the clean mesh. σ̂/σ: mean estimate of the noise over the true one. Regret: error at the chosen "
        "iteration over the smallest of the same run, less one, mean over the seeds (" +
        std::to_string(studies.front().levels.front().of(FlowOperator::noisy).rule_seeds) + " of the noisy, " +
        std::to_string(studies.front().levels.front().of(FlowOperator::rebuilt).rule_seeds) + " of the rebuilt operator on " +
        studies.front().name() +
        "); worst: the largest of them. Held fixed: the divergence of the smoothing matrix, as if it did not depend on the noise. "
        "Discrepancy: stop "
        "when the mesh has moved as far as the noise. –: no σ̂ on this mesh, a rule that is not for this operator, or an error "
        "that was still falling at the last iteration, so that nothing can be said of regret.";
    table.columns = begun({{"operator"},
                           {"σ̂/σ", "", 3},
                           {"best, measured"},
                           {"chosen", "mean", 3},
                           {"regret", "%", 2},
                           {"worst", "%", 2},
                           {"σ known", "regret, %", 2},
                           {"held fixed", "regret, %", 2},
                           {"discrepancy", "chosen", 3},
                           {"discrepancy", "regret, %", 2}});
    for (const PredictionStudy& study : studies) {
        for (const NoiseLevelStudy& level : study.levels) {
            for (const FlowOperator kind : {FlowOperator::noisy, FlowOperator::rebuilt}) {
                const OperatorStudy& own = level.of(kind);
                const bool reached = own.minimum_reached();
                const auto regret = [&](std::string_view name) {
                    const RuleOutcome* rule = own.rule(name);
                    return rule == nullptr || !reached ? report::Cell{} : report::Cell{100 * rule->mean_regret()};
                };
                const auto chosen = [&](std::string_view name) {
                    const RuleOutcome* rule = own.rule(name);
                    return rule == nullptr ? report::Cell{} : report::Cell{rule->mean_chosen()};
                };
                const RuleOutcome* rule = own.rule(by_stein_estimated);
                table.rows.push_back(
                    begun(study, level,
                          {name_of(kind), cell_of(level.mean_sigma_ratio()), best_cell(own.measured.best(), own.measured.iterations()),
                           chosen(by_stein_estimated), regret(by_stein_estimated),
                           rule == nullptr || !reached ? report::Cell{} : report::Cell{100 * rule->worst_regret()}, regret(by_stein),
                           regret(by_fixed_operator), chosen(by_discrepancy), regret(by_discrepancy)}));
            }
        }
    }
    return table;
}

std::vector<report::Check> prediction_checks(const std::vector<PredictionStudy>& studies) {
    constexpr double far = 5, wrong = 1.5;
    std::vector<report::Check> checks;
    for (const PredictionStudy& study : studies) {
        for (const NoiseLevelStudy& level : study.levels) {
            const std::string at = " at σ = " + plain_text(100 * level.sigma, 3) + " % on " + study.name();
            const StandardDistance right = standard_distance(study, level), control = standard_distance(study, level, wrong);
            checks.push_back(report::check_at_most(
                "Expected and measured error with the clean operator, standard errors apart" + at, far, right.vertices, 0,
                "largest over the iterations; the mean of " + std::to_string(study.seeds) + " squared errors"));
            checks.push_back(report::check_at_most("The same weighted by area" + at, far, right.mass));
            // A formula that rounding drowns cannot be told from a wrong one.
            if (study.condition < 1e12) {
                checks.push_back(
                    report::check_at_least("Control: with 1.5 σ in the formula, standard errors apart" + at, far, control.vertices));
            }
            // p(t) is the expected, m(t) the measured curve, off by δ at most: m(t_p) ≤ (1 + δ)p(t_p) ≤ (1 + δ)p(t_m) ≤ m(t_m)(1 + δ)/(1 −
            // δ).
            const OperatorStudy& clean = level.of(FlowOperator::clean);
            const double off = deviation(clean.formula(), clean.measured);
            if (off < 0.5) {
                checks.push_back(report::check_at_most("Regret of the expected best iteration, bounded by the deviation of the curves" + at,
                                                       (1 + off) / (1 - off) - 1, clean.regret_of_formula, 1e-12));
            }
        }
    }
    return checks;
}

}   // namespace meshfolio::prediction
