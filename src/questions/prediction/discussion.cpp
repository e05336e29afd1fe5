// What the numbers of the section "prediction" say.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/prediction/parts.h"

namespace meshfolio::prediction {

namespace {

using report::math;
using report::ref;
using Studies = std::vector<PredictionStudy>;

/// Least and largest of what is looked at.
struct Range {
    double low = INFINITY, high = -INFINITY;
    void take(double x) {
        if (!std::isfinite(x)) return;
        low = std::min(low, x);
        high = std::max(high, x);
    }
    bool empty() const { return low > high; }
    std::string percent() const {
        return low == high ? readable_percent(low, 2) : readable_percent(low, 2) + " to " + readable_percent(high, 2);
    }
};

template <class Visit>
void for_levels(const Studies& studies, Visit visit) {
    for (const PredictionStudy& study : studies) {
        for (const NoiseLevelStudy& level : study.levels) visit(study, level);
    }
}

std::string best_iterations(const PredictionStudy& study) {
    std::vector<std::string> expected, measured;
    for (const NoiseLevelStudy& level : study.levels) {
        expected.push_back(std::to_string(level.of(FlowOperator::clean).formula().best()));
        measured.push_back(std::to_string(level.of(FlowOperator::clean).measured.best()));
    }
    if (expected == measured) return study.name() + " " + listed(expected) + ", as measured";
    return study.name() + " " + listed(expected) + ", measured " + listed(measured);
}

report::Text clean_words(const Studies& studies) {
    double off = 0, off_by_area = 0, errors = 0, regret = 0;
    std::vector<std::string> iterations;
    for_levels(studies, [&](const PredictionStudy& study, const NoiseLevelStudy& level) {
        const OperatorStudy& clean = level.of(FlowOperator::clean);
        const StandardDistance distance = standard_distance(study, level);
        off = std::max(off, deviation(clean.formula(), clean.measured));
        off_by_area = std::max(off_by_area, largest_mass_deviation(study, level));
        errors = std::max({errors, distance.vertices, distance.mass});
        regret = std::max(regret, clean.regret_of_formula);
    });
    for (const PredictionStudy& study : studies) iterations.push_back(best_iterations(study));
    report::Text t =
        report::text("With the operator of the clean mesh the expected error is known before any noise is drawn (", ref("prediction_clean"),
                     "): the measured curves are within ", readable_percent(off, 2), " of it (", readable_percent(off_by_area, 2),
                     " weighted by area), at most ", readable(errors, 2), " standard errors of the mean of ",
                     counted(studies.front().seeds, "seed"), ". Best iterations expected at rising noise: ");
    for (std::size_t i = 0; i < iterations.size(); ++i) report::extend(t, i > 0 ? "; " : "", iterations[i]);
    report::extend(t, ". Whoever stops at the expected one ",
                   regret < 5e-5 ? std::string("loses nothing") : "loses at most " + readable_percent(regret, 2), ".");
    return t;
}

/// How far the error of an operator can be foreseen in this way, by the noise in mean edges.
report::Text reach_of(const Studies& studies, FlowOperator kind, std::string_view name) {
    constexpr double close = 0.05;
    double good = 0, bad = INFINITY;
    Range off;
    for_levels(studies, [&](const PredictionStudy&, const NoiseLevelStudy& level) {
        const PredictedCurve* prediction = level.of(kind).prediction(name);
        if (prediction == nullptr) return;
        const double far = deviation(*prediction, level.of(kind).measured);
        off.take(far);
        if (far > close) bad = std::min(bad, level.sigma_edges);
    });
    for_levels(studies, [&](const PredictionStudy&, const NoiseLevelStudy& level) {
        if (level.sigma_edges < bad) good = std::max(good, level.sigma_edges);
    });
    if (off.empty()) return {};
    if (!std::isfinite(bad)) return report::text("is never more than ", readable_percent(off.high, 2), " off");
    if (off.low == off.high) return report::text("is ", readable_percent(off.high, 2), " off");
    report::Text t = good > 0 ? report::text("is within 5 % up to σ = ", readable(good, 2), " mean edges")
                              : report::text("is more than 5 % off even at the smallest noise (", readable(bad, 2), " mean edges)");
    report::extend(
        t, ", and ",
        off.high > deviation_shown ? "more than " + readable_percent(deviation_shown, 4) : "up to " + readable_percent(off.high, 2),
        " off at some level");
    return t;
}

report::Text noisy_words(const Studies& studies) {
    report::Text t = report::text("A user has the operator of the noisy mesh only (", ref("prediction_operators"),
                                  "). There the formula with the clean operator ");
    report::extend(t, reach_of(studies, FlowOperator::noisy, by_formula), ". ");
    Range late;
    bool all_reached = true;
    for_levels(studies, [&](const PredictionStudy&, const NoiseLevelStudy& level) {
        const OperatorStudy& own = level.of(FlowOperator::noisy);
        late.take(own.measured.best() - own.formula().best());
        all_reached = all_reached && own.minimum_reached();
    });
    if (late.low == 0 && late.high == 0) {
        report::extend(t, "Its best iteration is right nonetheless, at every level. ");
    } else if (late.low >= 0) {
        report::extend(t, "The measured minimum comes up to ", counted(static_cast<int>(late.high), "iteration"),
                       " later than it expects. ");
    } else if (late.high <= 0) {
        report::extend(t, "The measured minimum comes up to ", counted(-static_cast<int>(late.low), "iteration"),
                       " earlier than it expects. ");
    } else {
        report::extend(t, "The measured minimum comes between ", counted(-static_cast<int>(late.low), "iteration"), " earlier and ",
                       std::to_string(static_cast<int>(late.high)), " later than it expects. ");
    }
    if (!all_reached) report::extend(t, "(Where the error was still falling at the last iteration, that is counted.) ");
    report::extend(t, "The formula with the operators of other noisy meshes ", reach_of(studies, FlowOperator::noisy, by_draws),
                   "; the derivative of the whole run about the clean mesh ", reach_of(studies, FlowOperator::noisy, by_derivative), ".");
    return t;
}

/// At the level where the formula is farthest off.
report::Text why_words(const Studies& studies) {
    const PredictionStudy* worst_study = nullptr;
    const NoiseLevelStudy* worst = nullptr;
    double farthest = -1;
    for_levels(studies, [&](const PredictionStudy& study, const NoiseLevelStudy& level) {
        const OperatorStudy& own = level.of(FlowOperator::noisy);
        const double off = deviation(own.formula(), own.measured);
        if (off > farthest) farthest = off, worst = &level, worst_study = &study;
    });
    const ErrorAccount account = error_account(*worst);
    if (account.iteration == 0 || farthest < 0.05) return {};   // nothing has been smoothed yet, or nothing breaks
    const auto signed_percent = [](double share) { return (share < 0 ? "−" : "+") + readable_percent(std::abs(share), 2); };
    report::Text t = report::text(
        "Why it breaks (", ref("prediction_why"), "): farthest off is ", worst_study->name(), " at σ = ", readable_percent(worst->sigma, 2),
        ", iteration ", std::to_string(account.iteration), ", where ", readable_percent(account.measured, 2),
        " of the squared error of the noise is measured and ", readable_percent(account.formula, 2),
        " was expected. Noise multiplies the area by ", readable(worst->facts.area, 3), " and makes ",
        readable_percent(worst->facts.negative_weights, 2), " of the weights negative (",
        readable_percent(worst_study->clean_facts.negative_weights, 2),
        " before); an operator with such numbers, made from other noise, accounts for ", signed_percent(account.numbers), ". The rest, ",
        signed_percent(account.knowledge),
        ", is there because the operator is made from the noise it smooths. It moves vertices along the normals of the noisy mesh, for "
        "wherever that is flat linear functions are its zero modes: noise along the surface it cannot tell from a triangulation that is "
        "so. ");
    report::extend(t, "Of the noise along the surface ", readable_percent(account.along_own, 2), " is left then, of that across it ",
                   readable_percent(account.across_own, 2), ", squared and with the shape lost; with the clean operator ",
                   readable_percent(account.along_clean, 2), " and ", readable_percent(account.across_clean, 2), ".");
    return t;
}

report::Text divergence_words(const Studies& studies) {
    const NoiseLevelStudy& level = studies.front().levels.back();
    const OperatorStudy& own = level.of(FlowOperator::noisy);
    if (own.rule_seeds == 0) return {};
    const int t = std::min(5, own.measured.iterations());
    report::Text text = report::text(
        "What is exact for any operator is Stein's identity (", ref("prediction_eq_stein"),
        "): the divergence says how much of a change of the input a run passes on. After ", counted(t, "iteration"), " on ",
        studies.front().name(), " at σ = ", readable_percent(level.sigma, 2), " it is ", readable_percent(own.divergence[t], 2),
        " of that of no smoothing; were the operator held fixed, it would be ", readable_percent(own.divergence_held[t], 2), ".");
    Range off;
    for_levels(studies, [&](const PredictionStudy&, const NoiseLevelStudy& each) {
        const OperatorStudy& tried = each.of(FlowOperator::noisy);
        if (const PredictedCurve* stein = tried.prediction(by_stein)) off.take(deviation(*stein, tried.measured));
    });
    report::extend(text, " Knowing σ, the estimates from the noisy meshes, which never see the clean one, are in the mean ", off.percent(),
                   " from what was measured with the operator of each noisy mesh.");
    return text;
}

report::Text rebuilt_words(const Studies& studies) {
    report::Text t = report::text("With the operator rebuilt at every step the formula ");
    report::extend(t, reach_of(studies, FlowOperator::rebuilt, by_formula), ", the derivative of the run ",
                   reach_of(studies, FlowOperator::rebuilt, by_derivative), ". ");
    int better = 0, cases = 0;
    for_levels(studies, [&](const PredictionStudy&, const NoiseLevelStudy& level) {
        const OperatorStudy &own = level.of(FlowOperator::noisy), &rebuilt = level.of(FlowOperator::rebuilt);
        if (!own.minimum_reached() || !rebuilt.minimum_reached()) return;
        ++cases;
        better += rebuilt.measured.square.minCoeff() < own.measured.square.minCoeff() * (1 - 1e-9) ? 1 : 0;
    });
    if (cases == 0) return t;
    report::extend(t, "Where both runs reach their minimum, that of the rebuilt operator is smaller than that of the noisy mesh's own in ",
                   std::to_string(better), " of ", counted(cases, "case"), ".");
    return t;
}

report::Text estimate_words(const Studies& studies) {
    const PredictionStudy* high_study = nullptr;
    const NoiseLevelStudy *high = nullptr, *low = nullptr;
    int within = 0, cases = 0;
    for_levels(studies, [&](const PredictionStudy& study, const NoiseLevelStudy& level) {
        if (level.sigma_ratio.empty()) return;
        const double ratio = level.mean_sigma_ratio();
        ++cases;
        within += std::abs(ratio - 1) <= 0.05 ? 1 : 0;
        if (high == nullptr || ratio > high->mean_sigma_ratio()) high = &level, high_study = &study;
        if (low == nullptr || ratio < low->mean_sigma_ratio()) low = &level;
    });
    if (cases == 0)
        return report::text(
            "On so few vertices no patch has more points than a quadratic has coefficients: σ cannot be estimated, and no rule be used.");
    report::Text t = report::text("The estimate of the noise from the mesh alone (", ref("prediction_rule"), ") is within 5 % in ",
                                  std::to_string(within), " of ", counted(cases, "case"), ", ",
                                  low == high ? "" : "between " + readable(low->mean_sigma_ratio(), 3) + " and ",
                                  readable(high->mean_sigma_ratio(), 3), " times the true σ. ");
    if (high->mean_sigma_ratio() > 1.05) {
        report::extend(t, "It is largest on ", high_study->name(), " at σ = ", readable_percent(high->sigma, 2), " (",
                       readable(high->sigma_edges, 2), " mean edges), where noise alone explains ", readable_percent(high->kept, 2),
                       " of the patches",
                       high->kept < 0.9 ? ": what a quadratic over two rings cannot follow, creases and detail, is taken for noise." : ".");
    } else {
        report::extend(t, "Nowhere is shape taken for noise to any extent that matters.");
    }
    return t;
}

report::Text rule_words(const Studies& studies) {
    Range stein, known, held, discrepancy, late;
    const PredictionStudy* worst_study = nullptr;
    const NoiseLevelStudy* worst = nullptr;
    for_levels(studies, [&](const PredictionStudy& study, const NoiseLevelStudy& level) {
        const OperatorStudy& own = level.of(FlowOperator::noisy);
        const RuleOutcome* rule = own.rule(by_stein_estimated);
        if (rule == nullptr || !own.minimum_reached()) return;
        if (worst == nullptr || rule->mean_regret() > stein.high) worst = &level, worst_study = &study;
        stein.take(rule->mean_regret());
        known.take(own.rule(by_stein)->mean_regret());
        held.take(own.rule(by_fixed_operator)->mean_regret());
        discrepancy.take(own.rule(by_discrepancy)->mean_regret());
        if (own.measured.best() > 0) late.take(own.rule(by_discrepancy)->mean_chosen() / own.measured.best());
    });
    if (stein.empty()) return {};
    report::Text t =
        report::text("Minimising Stein's estimate with the estimated σ, which needs nothing but the noisy mesh, costs ", stein.percent(),
                     " in the mean over the seeds beyond the best iteration of each with the noisy mesh's own operator; with σ known ",
                     known.percent(), ". ");
    if (stein.high > 0.1) {
        report::extend(t, "The worst case is ", worst_study->name(), " at σ = ", readable_percent(worst->sigma, 2),
                       worst->mean_sigma_ratio() > 1.5 ? ", where σ is overestimated and the shape smoothed away. " : ". ");
    }
    report::extend(t, "With the operator's dependence on the noise left out the same rule costs ", held.percent(),
                   "; the discrepancy principle ", ref("morozov_1966"), " costs ", discrepancy.percent());
    if (!late.empty()) {
        report::extend(t, " and stops, where the best iteration is not 0, at ", readable(late.low, 2));
        if (late.high > late.low) report::extend(t, " to ", readable(late.high, 2));
        report::extend(t, " times it");
    }
    report::extend(t, ".");
    return t;
}

}   // namespace

void add_discussion(report::Section& section, const Studies& studies) {
    add_heading(section, "Discussion");
    add_paragraphs(section, {clean_words(studies), noisy_words(studies), why_words(studies), divergence_words(studies),
                             rebuilt_words(studies), estimate_words(studies), rule_words(studies)});
}

}   // namespace meshfolio::prediction
