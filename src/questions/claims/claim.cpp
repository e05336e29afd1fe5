#include "questions/claims/claim.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"

namespace meshfolio::claims {

namespace {

constexpr std::size_t cases_in_words = 5;   // more are summed up; all are in the table

/// The one of `chosen` whose value is nearest to the threshold; ratios where that makes sense, so that sizes count alike.
std::size_t nearest_to_threshold(const Rule& rule, const std::vector<Case>& cases, const std::vector<std::size_t>& chosen) {
    const auto distance = [&](std::size_t i) {
        const double value = cases[i].value;
        return value > 0 && rule.threshold > 0 ? std::abs(std::log(value / rule.threshold)) : 1e3 + std::abs(value - rule.threshold);
    };
    return *std::min_element(chosen.begin(), chosen.end(), [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
}

/// "3 %", "2 mean edges", "1 mean edge".
std::string with_unit_of(const Rule& rule, const std::string& number) {
    std::string unit(rule.unit);
    if (number == "1" && unit.ends_with('s')) unit.pop_back();
    return number + (unit.empty() ? "" : "\u202f" + unit);
}

/// "random triangles (27.3 %) and …"; beyond a handful "7 cases, from 3 % (…) to 8 % (…)".
std::string values_of(const JudgedClaim& judged, const std::vector<std::size_t>& chosen) {
    const std::vector<Case>& cases = judged.measurement.cases;
    const Rule& rule = judged.claim->rule;
    if (chosen.size() > cases_in_words) {
        const auto [low, high] = std::minmax_element(chosen.begin(), chosen.end(),
                                                     [&](std::size_t a, std::size_t b) { return cases[a].value < cases[b].value; });
        const std::string many = counted(static_cast<int>(chosen.size()), "case") + ", ";
        if (cases[*low].value == cases[*high].value) return many + "all " + with_unit(cases[*low].value, rule);
        return many + "from " + with_unit(cases[*low].value, rule) + " (" + cases[*low].condition + ") to " +
               with_unit(cases[*high].value, rule) + " (" + cases[*high].condition + ")";
    }
    std::vector<std::string> values;
    for (const std::size_t i : chosen) values.push_back(with_unit(cases[i].value, rule) + " (" + cases[i].condition + ")");
    return listed(values);
}

}   // namespace

std::string_view word_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::holds:
            return "holds";
        case Verdict::conditional:
            return "holds with condition";
        case Verdict::refuted:
            return "refuted";
        case Verdict::undecidable:
            break;
    }
    return "not decidable here";
}

std::string_view symbol_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::holds:
            return "✓";
        case Verdict::conditional:
            return "◐";
        case Verdict::refuted:
            return "✗";
        case Verdict::undecidable:
            break;
    }
    return "?";
}

std::string_view words_of(Property property, bool lacking) {
    switch (property) {
        case Property::flat:
            return lacking ? "is not flat" : "is flat";
        case Property::not_flat:
            return lacking ? "is flat" : "is not flat";
        case Property::closed:
            return lacking ? "is open and encloses no volume" : "is closed";
        case Property::flat_with_edges:
            return lacking ? "has no flat parts with sharp edges between them" : "has flat parts with sharp edges between them";
        case Property::negative_weights:
            return lacking ? "has no negative cotangent weight" : "has negative cotangent weights";
        case Property::unequal_areas:
            return lacking ? "has vertices of equal areas" : "has vertices of different areas";
        case Property::clean_form_known:
            return lacking ? "has noise under which the surface is not known" : "has noise over a known surface";
        case Property::above_1500_vertices:
            break;
    }
    return lacking ? "has no more than 1500 vertices" : "has more than 1500 vertices";
}

std::string with_unit(double value, const Rule& rule) {
    const bool count = std::trunc(value) == value && std::abs(value) < 1e4;
    int digits = 3;   // more where the value would otherwise be printed as if it were the threshold
    while (digits < 8 && value != rule.threshold && readable(value, digits) == readable(rule.threshold, digits)) ++digits;
    return with_unit_of(rule, count ? plain_text(value) : readable(value, digits));
}

std::string words_of(const Rule& rule) {
    // A threshold is a round number: as many digits as it has.
    const std::string number =
        std::abs(rule.threshold) >= 1e-4 || rule.threshold == 0 ? plain_text(rule.threshold) : readable(rule.threshold, 1);
    return (rule.relation == Rule::Relation::at_most ? "at most " : "at least ") + with_unit_of(rule, number);
}

std::string beginning_of(const Rule& rule) {
    const bool closes_with_comma = rule.quantity.find(", ") != std::string_view::npos;
    return std::string(rule.quantity) + (closes_with_comma ? ", is" : " is");
}

Decision decide(const Rule& rule, const Measurement& measurement) {
    Decision decision;
    decision.why = measurement.undecidable;
    if (!decision.why.empty()) return decision;
    for (std::size_t i = 0; i < measurement.cases.size(); ++i) {
        const double value = measurement.cases[i].value;
        if (std::isfinite(value)) (rule.satisfied_by(value) ? decision.within : decision.beyond).push_back(i);
    }
    if (decision.within.empty() && decision.beyond.empty()) {
        decision.why = "the quantity is not defined on this mesh";
        return decision;
    }
    decision.verdict = decision.beyond.empty() ? Verdict::holds : decision.within.empty() ? Verdict::refuted : Verdict::conditional;
    decision.deciding = nearest_to_threshold(rule, measurement.cases, decision.beyond.empty() ? decision.within : decision.beyond);
    return decision;
}

report::Text rule_text(const JudgedClaim& judged) {
    const Claim& claim = *judged.claim;
    return report::text("True if ", beginning_of(claim.rule), " ", words_of(claim.rule),
                        judged.measurement.cases.size() > 1 ? " in every case." : ".");
}

report::Text verdict_text(const JudgedClaim& judged) {
    const Decision& decision = judged.decision;
    const std::string word(word_of(decision.verdict));
    report::Text t = report::text(
        report::strong(std::string(symbol_of(decision.verdict)) + "\u00a0" + static_cast<char>(word[0] - 'a' + 'A') + word.substr(1)));
    switch (decision.verdict) {
        case Verdict::undecidable:
            report::extend(t, ": ", decision.why, ".");
            break;
        case Verdict::conditional:
            report::extend(t, ". On the side it needs: ", values_of(judged, decision.within),
                           "; on the other: ", values_of(judged, decision.beyond), ".");
            break;
        case Verdict::holds:
            report::extend(t, ". Measured: ", values_of(judged, decision.within), ".");
            break;
        case Verdict::refuted:
            report::extend(t, ". Measured: ", values_of(judged, decision.beyond), ".");
            break;
    }
    if (decision.verdict == Verdict::undecidable) return t;
    if (!judged.measurement.remark.empty()) report::extend(t, " ", judged.measurement.remark);
    if (!judged.measurement.meshes.empty()) report::extend(t, " Measured on ", judged.measurement.meshes, ".");
    return t;
}

}   // namespace meshfolio::claims
