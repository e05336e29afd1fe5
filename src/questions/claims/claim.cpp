#include <stdexcept>

#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

constexpr std::array sources{Source{"s0", "S0"},
                             Source{"s1", "S1"},
                             Source{"s2", "S2"},
                             Source{"s3", "S3"},
                             Source{"meyer", "Meyer et al. 2003", "meyer_2003"},
                             Source{"wardetzky", "Wardetzky 2008", "wardetzky_2008"},
                             Source{"vallet", "Vallet & Lévy 2008", "vallet_levy_2008"},
                             Source{"rippa", "Rippa 1990", "rippa_1990"},
                             Source{"taubin", "Taubin 1995", "taubin_1995"},
                             Source{"desbrun", "Desbrun et al. 1999", "desbrun_1999"}};

/// Key and symbol of each verdict.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> verdicts{
    {{"holds", "✓"}, {"conditional", "◐"}, {"refuted", "✗"}, {"undecidable", "?"}}};

/// "holds", "holds with condition", "refuted", "not decidable here".
std::string word_of(Verdict verdict) { return words.line("verdict." + std::string(verdicts[int(verdict)].first)); }

/// "3 %", "2 mean edges", "1 mean edge".
std::string with_unit_of(const Rule& rule, const std::string& number) {
    std::string unit(rule.unit);
    if (number == "1" && unit.ends_with('s')) unit.pop_back();
    return number + (unit.empty() ? "" : "\u202f" + unit);
}

/// "27.3 % (random triangles) and …".
std::string values_of(const JudgedClaim& judged, const std::vector<std::size_t>& chosen) {
    return listed(each_of(chosen, [&](std::size_t i) {
        const auto& [condition, value] = judged.measurement.cases[i];
        return with_unit(value, judged.claim->rule) + " (" + condition + ")";
    }));
}

Measurement unmeasured(const Error& error) { return {.undecidable = words.line("unmeasured", "why"_a = error.what())}; }

Measurement measured(const Claim& claim, ClaimBench& bench) try {
    if (claim.effort == full && bench.settings().quick) return {.undecidable = words.line("not_in_quick_run")};
    const Measurable about = bench.measurable(claim.about);
    if (!about.why_not.empty()) return {.undecidable = about.why_not};
    Measurement measurement = claim.measure(bench, about.meshes);
    if (measurement.remarked) measurement.remark = words.say(std::string(claim.id) + ".remark");
    measurement.meshes = listed(each_of(about.meshes, [&](std::string_view name) { return bench.mesh(name).called(); }));
    return measurement;
} catch (const MeshError& error) {   // too large, without an operator
    return unmeasured(error);
} catch (const SolverError& error) {
    return unmeasured(error);
}

}   // namespace

const std::vector<Claim>& claim_list() {
    static const std::vector<Claim> all = [] {
        std::vector<Claim> claims;
        for (const auto* part : {&curvature_claims, &spectral_claims, &explicit_claims, &implicit_claims, &denoising_claims})
            claims.insert(claims.end(), part->begin(), part->end());
        std::ranges::stable_sort(claims, {}, &Claim::question);
        return claims;
    }();
    return all;
}

Measure::Measure(Case (*case_on)(ClaimBench&, std::string_view))
    : Measure([=](ClaimBench& bench, const MeshNames& meshes) {
          return Measurement{.cases = each_of(meshes, [&](std::string_view mesh) { return case_on(bench, mesh); })};
      }) {}

JudgedClaim judged(const Claim& claim, ClaimBench& bench) {
    JudgedClaim result{&claim, measured(claim, bench), {}};
    result.decision = decide(claim.rule, result.measurement);
    return result;
}

std::vector<JudgedClaim> judged_claims(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress,
                                       report::Section& section, std::vector<report::Plot>& plots) {
    ClaimBench bench(library, settings);
    std::vector<JudgedClaim> ledger;
    for (const Claim& claim : claim_list()) {
        progress("claim: " + claim.said());
        ledger.push_back(judged(claim, bench));
    }
    bench.enter_inputs(section);
    plots = std::move(bench.plots);
    return ledger;
}

std::string label_of(Verdict verdict) { return std::string(verdicts[int(verdict)].second) + " " + word_of(verdict); }

std::string Claim::said() const { return words.line(std::string(id) + ".said"); }

const Source& Claim::source() const {
    const auto* source = std::ranges::find_if(sources, [&](auto& s) { return id.starts_with("claims_" + std::string(s.key) + "_"); });
    if (source == sources.end())
        throw std::logic_error("the id of claim '" + std::string(id) + "' does not begin with claims_ and the key of a source");
    return *source;
}

std::string with_unit(double value, const Rule& rule) {
    const bool count = std::trunc(value) == value && std::abs(value) < 1e4;
    int digits = 3;   // more if the value would otherwise be printed as if it were the threshold
    while (digits < 8 && value != rule.threshold && readable(value, digits) == readable(rule.threshold, digits)) ++digits;
    return with_unit_of(rule, count ? plain_text(value) : readable(value, digits));
}

std::string bound_of(const Rule& rule) {
    // A threshold is a round number: as many digits as it has.
    const std::string number =
        std::abs(rule.threshold) >= 1e-4 || rule.threshold == 0 ? plain_text(rule.threshold) : readable(rule.threshold, 1);
    return words.line(rule.relation == Rule::Relation::at_most ? "at_most" : "at_least", "threshold"_a = with_unit_of(rule, number));
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
        decision.why = words.line("not_defined");
        return decision;
    }
    decision.verdict = decision.beyond.empty() ? Verdict::holds : decision.within.empty() ? Verdict::refuted : Verdict::conditional;
    const auto distance = [&](std::size_t i) {   // as a ratio if both are positive, so that sizes count alike
        const double value = measurement.cases[i].value;
        return value > 0 && rule.threshold > 0 ? std::abs(std::log(value / rule.threshold)) : 1e3 + std::abs(value - rule.threshold);
    };
    decision.deciding = *std::ranges::min_element(decision.beyond.empty() ? decision.within : decision.beyond, {}, distance);
    return decision;
}

report::Text rule_text(const JudgedClaim& judged) {
    const Rule& rule = judged.claim->rule;
    return words.say(judged.measurement.cases.size() > 1 ? "rule.cases" : "rule",
                     "quantity"_a = words.line("quantity." + std::string(rule.quantity)), "bound"_a = bound_of(rule));
}

report::Text verdict_text(const JudgedClaim& judged) {
    const auto& [verdict, within, beyond, deciding, why] = judged.decision;
    std::string word = word_of(verdict);
    word.front() = static_cast<char>(word.front() - 'a' + 'A');
    const report::Fact label = "verdict"_a = std::string(verdicts[int(verdict)].second) + "\u00a0" + word;
    if (verdict == Verdict::undecidable) return words.say("judged.undecidable", label, "why"_a = why);
    report::Text t =
        verdict == Verdict::conditional
            ? words.say("judged.conditional", label, "within"_a = values_of(judged, within), "beyond"_a = values_of(judged, beyond))
            : words.say("judged", label, "values"_a = values_of(judged, verdict == Verdict::holds ? within : beyond));
    if (!judged.measurement.figure.empty()) go_on(t, words.say("shown_in", "figure"_a = judged.measurement.figure));
    go_on(t, judged.measurement.remark);
    if (!judged.measurement.meshes.empty()) go_on(t, words.say("measured_on", "meshes"_a = judged.measurement.meshes));
    return t;
}

}   // namespace meshfolio::claims
