// The answer to question 6, and what it rests on: the prices of the two schemes, and how smooth both leave a mesh.
#include <set>

#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

/// Which scheme is cheaper for what is recommended.
report::Text price_of_recommended(const Studies& studies) {
    const std::vector<double> ratios = prices(studies);
    return ratios.empty() ? report::Text() : words.say("answer.good." + price_key(ratios), "ratios"_a = span_of(ratios));
}

/// From which amount and with which step on implicit steps pay, and what is left of the size there; on which meshes they do at none tried.
report::Text pays_from(const Studies& studies) {
    Names paying, never;
    std::vector<double> kept;
    bool large = true;   // only steps beyond the explicit limit pay
    for (const ImplicitStudy& study : studies) {
        if (!study.prices.counted()) continue;
        const std::optional<BreakEven> even = study.break_even();
        if (!even) {
            never.push_back(study.name());
            continue;
        }
        for (std::size_t l = 0; l < study.lambdas.size() && study.lambdas[l] <= study.subject.critical; ++l)
            large = large && !study.break_even(l);
        paying.push_back(words.line("answer.even.mesh", "mesh"_a = study.name(), "time"_a = readable(in_edges(study, even->time()), 2),
                                    "limits"_a = in_limits(study.subject, even->lambda)));
        kept.push_back(100 * even->kept);
    }
    const report::Text left = kept.empty() ? report::Text() : words.say("answer.even.kept", "kept"_a = span_of(kept));
    return paragraph_of(
        {said_of(paying, words, large ? "answer.even.large" : "answer.even"), left, said_of(never, words, "answer.even.never")});
}

/// Whether the explicit runs blew up, and the last of them within how many steps, where one λ blew up first on all meshes.
report::Text stability_of(const Studies& studies) {
    double largest = 0;
    std::set<std::string> blown;
    int last = 0;
    bool all = true;
    for (const ImplicitStudy& study : studies) {
        largest = std::max(largest, study.lambdas.back() / study.subject.critical);
        const std::optional<std::size_t> l = study.first_blown();
        all = all && l.has_value();
        if (!l) continue;
        blown.insert(in_limits(study.subject, study.lambdas[*l]));
        last = std::max(last, study.explicit_runs[*l].result.blow_up_iteration);
    }
    const char* key = blown.empty() ? "answer.alike" : all && blown.size() == 1 ? "answer.blown" : "answer";
    return words.say(key, "limits"_a = readable(largest, 2), "blown"_a = blown.empty() ? "" : *blown.begin(), "last"_a = last);
}

/// Meshes on which the angle grows from almost none: it measures how round the shape has become.
report::Text roundness(const Studies& studies) {
    report::Text told;
    for (const ImplicitStudy& study : studies) {
        if (study.roughness > rough || !study.cost || !study.cost->reached()) continue;
        const SmoothingCost& cost = *study.cost;
        if (!(cost.roughness > 1.1 * study.roughness + 0.01)) continue;
        go_on(told, words.say("quality.round", "mesh"_a = study.name(), "input"_a = readable(study.roughness, 2),
                              "implicit"_a = readable(cost.roughness, 2), "explicit"_a = readable(cost.explicit_roughness, 2)));
    }
    return told;
}

}   // namespace

std::string span_of(const std::vector<double>& values) {
    const auto [low, high] = std::ranges::minmax(values);
    const std::string from = readable(low, 2), to = readable(high, 2);
    return from == to ? from : words.line("span", "low"_a = from, "high"_a = to);
}

std::vector<double> prices(const Studies& studies) {
    std::vector<double> ratios;
    for (const ImplicitStudy& study : studies)
        if (study.cost && !std::isnan(study.cost->ratio)) ratios.push_back(study.cost->ratio);
    return ratios;
}

std::string price_key(const std::vector<double>& ratios) {
    const auto [low, high] = std::ranges::minmax(ratios);
    if (low > 1 / 1.2 && high < 1.2) return "alike";
    return low >= 1 ? "dearer" : high <= 1 ? "cheaper" : "either";
}

std::string smoothness_key(const ImplicitStudy& study) {
    if (!study.cost || !study.cost->reached() || study.roughness <= rough || !(study.cost->explicit_roughness > 0)) return "";
    const double ratio = study.cost->roughness / study.cost->explicit_roughness;
    return ratio > 1.05 ? "smoother" : ratio < 1 / 1.05 ? "rougher" : "alike";
}

report::Text answer_of(const Studies& studies) {
    return paragraph_of({stability_of(studies), price_of_recommended(studies), pays_from(studies)});
}

/// What is recommended: "λt = 0.91 h̄² on plane".
report::Text summary_of(const Studies& studies) {
    Names told;
    for (const ImplicitStudy& study : studies)
        if (const SmoothingCell* good = study.good())
            told.push_back(words.line("recommended.mesh", "mesh"_a = study.name(), "time"_a = readable(in_edges(study, good->time()), 2)));
    const Names none = names_where(studies, [](const ImplicitStudy& study) { return !study.good(); });
    return paragraph_of({said_of(told, words, "recommended"), said_of(none, words, "recommended.none")});
}

/// How smooth both schemes leave what is recommended, at the same energy; on smooth meshes the angle tells something else.
report::Text quality_of(const Studies& studies) {
    report::Text told;
    for (const ImplicitStudy& study : studies) {
        const std::string key = smoothness_key(study);
        if (key.empty()) continue;
        go_on(told, words.say("quality." + key, "mesh"_a = study.name(), "implicit"_a = readable(study.cost->roughness, 2),
                              "explicit"_a = readable(study.cost->explicit_roughness, 2)));
    }
    if (!told.empty()) told = paragraph_of({words.say("quality"), told});
    return paragraph_of({told, roundness(studies)});
}

/// Which scheme to use: for what is recommended, and for more.
report::Text verdict_of(const Studies& studies) {
    const std::vector<double> ratios = prices(studies);
    if (ratios.empty()) return {};
    const std::string price = price_key(ratios);
    const auto none_is = [&](const char* key) {
        return std::ranges::none_of(studies, [&](const ImplicitStudy& study) { return smoothness_key(study) == key; });
    };
    const Names cheaper = names_where(studies, [](const ImplicitStudy& study) { return study.cost && study.cost->ratio < 1; });
    const Names dearer = names_where(studies, [](const ImplicitStudy& study) { return study.cost && study.cost->ratio >= 1; });
    const std::string key = price == "cheaper"  ? none_is("rougher") ? "explicit.smooth" : "explicit"
                            : price == "dearer" ? none_is("smoother") ? "implicit.smooth" : "implicit"
                                                : price;
    const bool more = std::ranges::any_of(studies, [](const ImplicitStudy& study) { return study.break_even().has_value(); });
    return paragraph_of(
        {words.say("verdict." + key, "ratios"_a = span_of(ratios), "cheaper"_a = listed(cheaper), "dearer"_a = listed(dearer)),
         more && price != "dearer" ? words.say("verdict.more") : report::Text()});
}

/// What a step and a factorisation cost, and which λ can pay: by (1 − h)ᵏ ≤ 1/(1 + kh), 2λ/λ_crit explicit steps of half of λ_crit damp
/// every mode as much as one implicit step.
report::Text price_of(const Studies& studies) {
    std::vector<double> factorisations, steps, least;
    for (const ImplicitStudy& study : studies) {
        if (!study.prices.counted()) continue;
        factorisations.push_back(study.prices.factorisation / study.prices.implicit_step);
        steps.push_back(study.prices.implicit_step / study.prices.explicit_step);
        least.push_back(steps.back() / 2);
    }
    if (steps.empty()) return {};
    return words.say("price", "step"_a = span_of(steps), "least"_a = span_of(least), "factorisation"_a = span_of(factorisations));
}

}   // namespace meshfolio::q6_implicit
