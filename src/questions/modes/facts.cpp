#include "questions/modes/mode_study.h"
#include "questions/modes/prediction_study.h"

namespace meshfolio::modes {

namespace {

std::string percent(double share) { return readable_percent(share, 2); }

// ---- the shape

// ---- noise

/// Returns the deviation of a prediction from the measurement.
double off_of(const NoiseLevelStudy& level, FlowOperator kind, std::string_view name = by_formula) {
    return deviation(*level.of(kind).prediction(name), level.of(kind).measured);
}

/// Returns the largest mean regret of a rule over the levels with a known minimum; NaN if it was tried on none.
double largest_regret(const PredictionStudies& studies, std::string_view name) {
    double largest = undefined;
    for (const auto& [study, level] : levels_of(studies)) {
        const OperatorStudy& own = level.of(FlowOperator::noisy);
        if (const RuleOutcome* rule = own.rule(name); rule && own.minimum_reached()) largest = std::fmax(largest, rule->mean_regret);
    }
    return largest;
}

}   // namespace

report::Facts shape_facts(const ModeStudies& studies) {
    double worst = 0;
    for (const ModeStudy& study : studies)
        worst = std::max(worst, largest_of(study.dampings, [&](const ModeDamping& d) { return d.deviation(study.eigenvalues); }));
    const ModeDamping& close = studies.front().dampings[1];

    return list_of("laws"_a = (worst < law_tolerance), "worst"_a = readable(worst, 2), "first"_a = studies.front().name(),
                   "steps"_a = close.steps, "left"_a = percent(std::abs(close.law(studies.front().subject.top.value))));
}

report::Facts noise_facts(const PredictionStudies& studies) {
    const auto levels = levels_of(studies);
    double off = 0, own = 0, regret = 0, stein = 0, least_sigma = undefined, most_sigma = undefined;
    int late = 0, early = 0;
    for (const auto& [study, level] : levels) {
        off = std::max({off, off_of(level, FlowOperator::clean), largest_mass_deviation(study, level)});
        own = std::max(own, off_of(level, FlowOperator::noisy));
        regret = std::max(regret, level.of(FlowOperator::clean).regret_of_formula);
        stein = std::max(stein, off_of(level, FlowOperator::noisy, by_stein));
        const int later = level.of(FlowOperator::noisy).measured.best() - level.of(FlowOperator::noisy).formula().best();
        late = std::max(late, later), early = std::max(early, -later);
        least_sigma = std::fmin(least_sigma, level.sigma_ratio);
        most_sigma = std::fmax(most_sigma, level.sigma_ratio);
    }
    const auto& [study, level] = *std::ranges::max_element(levels, {}, [](auto& each) { return off_of(each.part, FlowOperator::noisy); });
    const ErrorAccount account = error_account(level);
    const bool fails = own > 0.05 && account.iteration > 0;
    const double sigma_off = std::fmax(1 - least_sigma, most_sigma - 1);   // NaN where σ cannot be estimated
    const double held = largest_regret(studies, by_fixed_operator), by_estimate = largest_regret(studies, by_stein_estimated);
    const bool stops_late = std::ranges::all_of(levels, [](auto& each) {
        const OperatorStudy& operated = each.part.of(FlowOperator::noisy);
        const RuleOutcome* rule = operated.rule(by_discrepancy);
        return !rule || rule->mean_chosen > operated.measured.best();
    });
    return list_of(
        "seeds"_a = studies.front().seeds, "foreseen"_a = off < 0.1, "off"_a = percent(off),
        "regret"_a = regret < 5e-5 ? "" : percent(regret), "own"_a = percent(own), "late"_a = late, "early"_a = early, "fails"_a = fails,
        "mesh"_a = study.name(), "sigma"_a = percent(level.sigma),
        "numbers"_a =
            fails && account.numbers > 0 && account.knowledge > 0 ? percent(account.numbers / (account.numbers + account.knowledge)) : "",
        "along"_a = fails && account.along_own > account.along_clean, "along_own"_a = percent(account.along_own),
        "along_clean"_a = percent(account.along_clean), "stein"_a = percent(stein),
        "no_sigma"_a = std::ranges::all_of(levels, [](auto& each) { return std::isnan(each.part.sigma_ratio); }),
        "sigma_off"_a = sigma_off < 0.5 ? percent(sigma_off) : "",
        "sigma_times"_a = sigma_off >= 0.5 ? span_of(readable(least_sigma, 2), readable(most_sigma, 2)) : "",
        "rule"_a = by_estimate < 1 ? percent(by_estimate) : "", "rule_times"_a = by_estimate >= 1 ? readable(1 + by_estimate, 2) : "",
        "held"_a = held > by_estimate ? percent(held) : "", "discrepancy"_a = percent(largest_regret(studies, by_discrepancy)),
        "stops_late"_a = stops_late);
}

void add_record(report::Section& section, const ModeStudies& shapes, const PredictionStudies& noisy, const QuestionSettings& settings) {
    const PredictionStudy& first = noisy.front();
    Names levels;
    std::vector<double> noise;
    for (const NoiseLevelStudy& level : first.levels) {
        noise.push_back(level.sigma);
        levels.push_back(readable_percent(level.sigma, 2));
    }
    section.parameters = {{"operator", words.line("parameter.operator")},
                          {"noise", {words.line("parameter.noise", "levels"_a = listed(levels)), noise, "box diagonal"}},
                          {"seeds", first.seeds},
                          {"seed", settings.seed}};
    for (const PredictionStudy& study : noisy) {
        const double lambda = study.lambda * study.diagonal * study.diagonal;
        section.parameters["λ on " + study.name()] = {plain_text(lambda, 6), lambda, "length²"};
    }
    section.extent =
        words.line("extent", "meshes"_a = listed(names_of(shapes)), "noisy"_a = listed(names_of(noisy)), "seeds"_a = first.seeds);
}

}   // namespace meshfolio::modes
