#include "questions/prediction/parts.h"

namespace meshfolio::prediction {

namespace {

/// Least and largest of what is looked at.
struct Range {
    double low = infinity, high = -infinity;
    void take(double x) {
        if (!std::isfinite(x)) return;
        low = std::min(low, x);
        high = std::max(high, x);
    }
    bool empty() const { return low > high; }
    /// "0.5 to 2", or "2"
    template <class Told>
    std::string told(Told in_words) const {
        return low == high ? in_words(low, 2) : in_words(low, 2) + " to " + in_words(high, 2);
    }
    std::string percent() const { return told(readable_percent); }
};

std::string best_iterations(const PredictionStudy& study) {
    Names expected, measured;
    for (const NoiseLevelStudy& level : study.levels) {
        expected.push_back(std::to_string(level.of(FlowOperator::clean).formula().best()));
        measured.push_back(std::to_string(level.of(FlowOperator::clean).measured.best()));
    }
    return words.line(expected == measured ? "foreseen.as_measured" : "foreseen.not_as_measured", "mesh"_a = study.name(),
                      "expected"_a = listed(expected), "measured"_a = listed(measured));
}

/// Compares expected and measured error with the operator of the clean mesh.
report::Text about_foreseen_error(const Studies& studies) {
    double off = 0, off_by_area = 0, errors = 0, regret = 0;
    for (const auto& [study, level] : levels_of(studies)) {
        const OperatorStudy& clean = level.of(FlowOperator::clean);
        off = std::max(off, deviation(clean.formula(), clean.measured));
        off_by_area = std::max(off_by_area, largest_mass_deviation(study, level));
        errors = std::max(errors, standard_distance(study, level).larger());
        regret = std::max(regret, clean.regret_of_formula);
    }
    const double most = std::max(off, off_by_area);
    report::Text t =
        words.say(most < 0.1 ? "foreseen" : "foreseen.off", "off"_a = readable_percent(most, 2), "errors"_a = readable(errors, 2),
                  "seeds"_a = studies.front().seeds, "iterations"_a = joined(each_of(studies, best_iterations), ", "));
    go_on(t, regret < 5e-5 ? words.say("foreseen.no_loss") : words.say("foreseen.loss", "regret"_a = readable_percent(regret, 2)));
    return t;
}

/// How far the error of an operator can be foreseen in this way, by the noise in mean edges.
std::string reach_of(const Studies& studies, FlowOperator kind, std::string_view name) {
    constexpr double close = 0.05;
    double good = 0, bad = infinity;
    Range off;
    for (const auto& [study, level] : levels_of(studies)) {
        const PredictedCurve* prediction = level.of(kind).prediction(name);
        if (prediction == nullptr) continue;
        const double far = deviation(*prediction, level.of(kind).measured);
        off.take(far);
        if (far > close) bad = std::min(bad, level.sigma_edges);
    }
    for (const auto& [study, level] : levels_of(studies))
        if (level.sigma_edges < bad) good = std::max(good, level.sigma_edges);
    if (off.empty()) return "";
    const std::string most = readable_percent(off.high, 2);
    if (!std::isfinite(bad)) return words.line("reach.everywhere", "off"_a = most);
    if (off.low == off.high) return words.line("reach.one_level", "off"_a = most);
    return words.line(good > 0 ? "reach.up_to" : "reach.nowhere", "edges"_a = readable(good, 2),
                      "off"_a = off.high > deviation_shown ? "more than " + readable_percent(deviation_shown, 4) : "up to " + most);
}

/// How much later than the formula expects the error is smallest with the noisy mesh's own operator.
report::Text about_delay(const Studies& studies) {
    Range delay;
    for (const auto& [study, level] : levels_of(studies)) {
        const OperatorStudy& own = level.of(FlowOperator::noisy);
        delay.take(own.measured.best() - own.formula().best());
    }
    const int early = -static_cast<int>(delay.low), late = static_cast<int>(delay.high);
    const char* key = early == 0 && late == 0 ? "own.in_time" : early <= 0 ? "own.later" : late <= 0 ? "own.earlier" : "own.either";
    return words.say(key, "early"_a = early, "late"_a = late);
}

report::Text about_own_operator(const Studies& studies) {
    const auto reach = [&](std::string_view name) { return reach_of(studies, FlowOperator::noisy, name); };
    report::Text t = words.say("own", "reach"_a = reach(by_formula));
    go_on(t, about_delay(studies));
    if (!std::ranges::all_of(levels_of(studies), [](auto& each) { return each.part.of(FlowOperator::noisy).minimum_reached(); }))
        go_on(t, words.say("own.still_falling"));
    go_on(t, words.say("own.others", "draws"_a = reach(by_draws), "derivative"_a = reach(by_derivative)));
    return t;
}

/// Why the formula breaks, at the level where it is farthest off.
std::pair<report::Text, report::Text> about_failure(const Studies& studies) {
    const auto off = [](const auto& each) {
        const OperatorStudy& own = each.part.of(FlowOperator::noisy);
        return deviation(own.formula(), own.measured);
    };
    const auto levels = levels_of(studies);
    const auto worst = std::ranges::max_element(levels, {}, off);
    const auto& [study, level] = *worst;
    const ErrorAccount account = error_account(level);
    if (account.iteration == 0 || off(*worst) < 0.05) return {};   // nothing has been smoothed yet, or nothing breaks
    const auto percent = [](double share) { return readable_percent(share, 2); };
    const auto signed_percent = [](double share) { return (share < 0 ? "−" : "+") + readable_percent(std::abs(share), 2); };
    return {words.say("breaks", "mesh"_a = study.name(), "sigma"_a = percent(level.sigma), "iteration"_a = account.iteration,
                      "measured"_a = percent(account.measured), "formula"_a = percent(account.formula),
                      "numbers"_a = signed_percent(account.numbers), "knowledge"_a = signed_percent(account.knowledge)),
            words.say("breaks.how", "area"_a = readable(level.facts.area, 2), "negative"_a = percent(level.facts.negative_weights),
                      "negative_before"_a = percent(study.clean_facts.negative_weights), "along_own"_a = percent(account.along_own),
                      "across_own"_a = percent(account.across_own), "along_clean"_a = percent(account.along_clean),
                      "across_clean"_a = percent(account.across_clean))};
}

report::Text about_divergence(const Studies& studies) {
    const NoiseLevelStudy& level = studies.front().levels.back();
    const OperatorStudy& own = level.of(FlowOperator::noisy);
    if (own.rule_seeds == 0) return {};
    Range off;
    for (const auto& [study, each] : levels_of(studies)) {
        const OperatorStudy& tried = each.of(FlowOperator::noisy);
        if (const PredictedCurve* stein = tried.prediction(by_stein)) off.take(deviation(*stein, tried.measured));
    }
    const int steps = std::min(5, own.measured.iterations());
    return words.say("stein", "steps"_a = steps, "mesh"_a = studies.front().name(),
                     "divergence"_a = readable_percent(own.divergence[steps], 2),
                     "held"_a = readable_percent(own.divergence_held[steps], 2), "off"_a = off.percent());
}

report::Text about_rebuilt_operator(const Studies& studies) {
    int better = 0, cases = 0;
    for (const auto& [study, level] : levels_of(studies)) {
        const OperatorStudy &own = level.of(FlowOperator::noisy), &rebuilt = level.of(FlowOperator::rebuilt);
        if (!own.minimum_reached() || !rebuilt.minimum_reached()) continue;
        ++cases;
        better += rebuilt.measured.square.minCoeff() < own.measured.square.minCoeff() * (1 - 1e-9) ? 1 : 0;
    }
    return paragraph_of({words.say("rebuilt", "formula"_a = reach_of(studies, FlowOperator::rebuilt, by_formula),
                                   "derivative"_a = reach_of(studies, FlowOperator::rebuilt, by_derivative)),
                         better > 0  ? words.say("rebuilt.better", "better"_a = better, "cases"_a = cases)
                         : cases > 0 ? words.say("rebuilt.not_better")
                                     : report::Text()});
}

/// How good σ̂ is, and where it is too large.
report::Text about_estimate(const Studies& studies) {
    const PredictionStudy* high_study = nullptr;
    const NoiseLevelStudy *high = nullptr, *low = nullptr;
    int within = 0, cases = 0;
    for (const auto& [study, level] : levels_of(studies)) {
        if (level.sigma_ratio.empty()) continue;
        const double ratio = level.mean_sigma_ratio();
        ++cases;
        within += std::abs(ratio - 1) <= 0.05 ? 1 : 0;
        if (high == nullptr || ratio > high->mean_sigma_ratio()) high = &level, high_study = &study;
        if (low == nullptr || ratio < low->mean_sigma_ratio()) low = &level;
    }
    if (cases == 0) return words.say("estimate.impossible");
    const std::string most = readable(high->mean_sigma_ratio(), 3);
    const std::string ratios = low == high ? most : "between " + readable(low->mean_sigma_ratio(), 3) + " and " + most;
    report::Text t = words.say("estimate", "ratios"_a = ratios);
    if (cases > 1) go_on(t, words.say("estimate.within", "within"_a = within, "cases"_a = cases));
    go_on(t, high->mean_sigma_ratio() > 1.05
                 ? words.say(high->kept < 0.9 ? "estimate.largest_at_detail" : "estimate.largest", "mesh"_a = high_study->name(),
                             "sigma"_a = readable_percent(high->sigma, 2), "kept"_a = readable_percent(high->kept, 2))
                 : words.say("estimate.close"));
    return t;
}

report::Text about_stopping(const Studies& studies) {
    Range stein, known, held, discrepancy, late;
    const PredictionStudy* worst_study = nullptr;
    const NoiseLevelStudy* worst = nullptr;
    for (const auto& [study, level] : levels_of(studies)) {
        const OperatorStudy& own = level.of(FlowOperator::noisy);
        const RuleOutcome* rule = own.rule(by_stein_estimated);
        if (rule == nullptr || !own.minimum_reached()) continue;
        if (worst == nullptr || rule->mean_regret() > stein.high) worst = &level, worst_study = &study;
        stein.take(rule->mean_regret());
        known.take(own.rule(by_stein)->mean_regret());
        held.take(own.rule(by_fixed_operator)->mean_regret());
        discrepancy.take(own.rule(by_discrepancy)->mean_regret());
        if (own.measured.best() > 0) late.take(own.rule(by_discrepancy)->mean_chosen() / own.measured.best());
    }
    if (stein.empty()) return {};
    report::Text t = words.say("stopping", "stein"_a = stein.percent(), "known"_a = known.percent());
    if (stein.high > 0.1)
        go_on(t, words.say(worst->mean_sigma_ratio() > 1.5 ? "stopping.worst_overestimated" : "stopping.worst",
                           "mesh"_a = worst_study->name(), "sigma"_a = readable_percent(worst->sigma, 2)));
    go_on(t, words.say(late.empty() ? "stopping.others" : "stopping.others_late", "held"_a = held.percent(),
                       "discrepancy"_a = discrepancy.percent(), "late"_a = late.told(readable)));
    return t;
}

}   // namespace

void add_discussion(report::Section& section, const Studies& studies) {
    add_words(section, words, "discussion");
    const auto [why, how] = about_failure(studies);
    add_paragraphs(section, {about_foreseen_error(studies), about_own_operator(studies), why, how, about_divergence(studies),
                             about_rebuilt_operator(studies), about_estimate(studies), about_stopping(studies)});
}

}   // namespace meshfolio::prediction
