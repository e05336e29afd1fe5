// The answer to question 6, and what it rests on: the prices of the two schemes, and how smooth both leave a mesh.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/bench/sentences.h"
#include "questions/core/study_list.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

using Names = std::vector<std::string>;

bool blows_up(const ImplicitStudy& study) { return study.first_blown().has_value(); }

/// Of the priced results far beyond the limit, where that is not all: ", which leaves 2.8 % to 78 % of the size".
std::string left_far_beyond(const Studies& studies) {
    double least = INFINITY, most = 0;
    for (const ImplicitStudy& study : studies) {
        for (const SmoothingCost& cost : study.costs) {
            if (cost.recommended || std::isnan(cost.ratio())) continue;
            least = std::min(least, cost.cell.kept);
            most = std::max(most, cost.cell.kept);
        }
    }
    if (!(least < size_to_keep)) return "";
    const std::string from = readable_percent(least, 2), to = readable_percent(most, 2);
    return words.line("answer.shrinks", "kept"_a = from == to ? from : words.line("span", "low"_a = from, "high"_a = to));
}

/// Which scheme is cheaper for what is recommended.
report::Text price_of_recommended(const Studies& studies) {
    const std::vector<double> ratios = prices(studies, true);
    if (ratios.empty()) return {};
    const std::string smoothness = smoothness_key(studies);
    return words.say("answer.good." + price_key(ratios), "ratios"_a = span_of(ratios),
                     "smooth"_a = smoothness.empty() ? "" : words.line("answer.smooth." + smoothness));
}

/// Which scheme is cheaper far beyond the limit: "dearer.too" where implicit smoothing wins anyway, else "dearer.only".
report::Text price_far_beyond(const Studies& studies) {
    const std::vector<double> ratios = prices(studies, false), recommended = prices(studies, true);
    if (ratios.empty()) return {};
    std::string key = price_key(ratios);
    if (key == "dearer") key += !recommended.empty() && price_key(recommended) == "dearer" ? ".too" : ".only";
    return words.say("answer.far." + key, "ratios"_a = span_of(ratios), "shrinks"_a = left_far_beyond(studies));
}

/// Meshes on which the angle grows from almost none: it measures how round the shape has become.
report::Text roundness(const Studies& studies) {
    report::Text told;
    for (const ImplicitStudy& study : studies) {
        if (study.roughness > rough) continue;
        for (const SmoothingCost& cost : study.costs) {
            if (!cost.reached() || !(cost.roughness > 1.1 * study.roughness + 0.01)) continue;
            const report::Facts facts{"mesh"_a = study.name(), "input"_a = readable(study.roughness, 2),
                                      "implicit"_a = readable(cost.roughness, 2), "explicit"_a = readable(cost.explicit_roughness, 2),
                                      "kept"_a = readable_percent(cost.cell.kept, 2)};
            told = paragraph_of({told, words.say(told.empty() ? "quality.round" : "quality.round.more", facts)});
        }
    }
    return told;
}

}   // namespace

std::string span_of(const std::vector<double>& values) {
    const auto [low, high] = std::ranges::minmax(values);
    const std::string from = readable(low, 2), to = readable(high, 2);
    return from == to ? from : words.line("span", "low"_a = from, "high"_a = to);
}

std::vector<double> prices(const Studies& studies, bool recommended) {
    std::vector<double> ratios;
    for (const ImplicitStudy& study : studies)
        for (const SmoothingCost& cost : study.costs)
            if (cost.recommended == recommended && !std::isnan(cost.ratio())) ratios.push_back(cost.ratio());
    return ratios;
}

std::string price_key(const std::vector<double>& ratios) {
    const auto [low, high] = std::ranges::minmax(ratios);
    if (low > 1 / 1.2 && high < 1.2) return "alike";
    return low >= 1 ? "dearer" : high <= 1 ? "cheaper" : "either";
}

std::string smoothness_key(const Studies& studies) {
    double least = INFINITY, most = 0;   // implicit over explicit
    for (const ImplicitStudy& study : studies) {
        for (const SmoothingCost& cost : study.costs) {
            if (!cost.recommended || !cost.reached() || study.roughness <= rough || !(cost.explicit_roughness > 0)) continue;
            const double ratio = cost.roughness / cost.explicit_roughness;
            least = std::min(least, ratio);
            most = std::max(most, ratio);
        }
    }
    if (most == 0) return "";
    if (least > 0.9 && most < 1.1) return "alike";
    return least > 0.98 ? "smoother" : most < 1.02 ? "rougher" : "mixed";
}

report::Text answer_of(const Studies& studies) {
    double largest = 0;
    for (const ImplicitStudy& study : studies) largest = std::max(largest, study.lambdas.back() / study.subject.critical);
    return paragraph_of({words.say(std::ranges::any_of(studies, blows_up) ? "answer" : "answer.alike", "limits"_a = readable(largest, 2)),
                         price_of_recommended(studies), price_far_beyond(studies)});
}

/// What is recommended: "λt = 0.91 h̄² on plane".
report::Text summary_of(const Studies& studies) {
    Names told, none;
    for (const ImplicitStudy& study : studies) {
        const double h = study.subject.mean_edge;
        if (const SmoothingCell* good = study.good())
            told.push_back(words.line("recommended.mesh", "mesh"_a = study.name(), "time"_a = readable(good->time() / (h * h), 2)));
        else
            none.push_back(study.name());
    }
    return paragraph_of({said_of(told, words, "recommended"), said_of(none, words, "recommended.none")});
}

/// How smooth both schemes leave what is recommended, at the same energy; on smooth meshes the angle tells something else.
report::Text quality_of(const Studies& studies) {
    Names told;
    for (const ImplicitStudy& study : studies)
        for (const SmoothingCost& cost : study.costs)
            if (cost.recommended && cost.reached() && study.roughness > rough && cost.explicit_roughness > 0)
                told.push_back(words.line("quality.mesh", "mesh"_a = study.name(), "implicit"_a = readable(cost.roughness, 2),
                                          "explicit"_a = readable(cost.explicit_roughness, 2)));
    return paragraph_of({said_of(told, words, "quality." + smoothness_key(studies)), roundness(studies)});
}

/// What a step and a factorisation cost; where explicit smoothing is too slow to be priced.
report::Text price_of(const Studies& studies) {
    Names only;
    std::vector<double> factorisations, steps;
    for (const ImplicitStudy& study : studies) {
        for (const SmoothingCost& cost : study.costs) {
            if (!(cost.factorisation > 0)) continue;
            factorisations.push_back(cost.factorisation);
            steps.push_back(cost.step);
        }
        if (!std::ranges::all_of(study.costs, &SmoothingCost::reached)) only.push_back(study.name());
    }
    return paragraph_of({factorisations.empty()
                             ? report::Text()
                             : words.say("price", "step"_a = span_of(steps), "factorisation"_a = span_of(factorisations)),
                         said_of(only, words, "price.only")});
}

}   // namespace meshfolio::q6_implicit
