// The section "claims": what earlier reports and papers say, measured again and judged, each by its rule.
#include <set>

#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

int count_of(const std::vector<JudgedClaim>& judged, Verdict verdict) {
    return static_cast<int>(std::ranges::count_if(judged, [&](const JudgedClaim& j) { return j.decision.verdict == verdict; }));
}

void add_claims_with(report::Section& section, const std::vector<JudgedClaim>& judged, Verdict verdict, std::string_view key) {
    report::Text claims;
    for (const JudgedClaim& j : judged) {
        if (j.decision.verdict != verdict) continue;
        report::extend(claims, claims.empty() ? "" : ", ",
                       words.say("claim_and_source", "claim"_a = j.claim->id, "source"_a = j.claim->source().name));
    }
    if (!claims.empty()) add_words(section, words, key, "claims"_a = claims);
}

void add_discussion(report::Section& section, const std::vector<JudgedClaim>& judged) {
    add_words(section, words, "discussion", "summary"_a = ledger_summary(judged));
    add_claims_with(section, judged, Verdict::refuted, "discussion.refuted");
    add_claims_with(section, judged, Verdict::conditional, "discussion.conditional");
    add_words(section, words, "discussion.rules");
}

bool decided(const JudgedClaim& judged) { return judged.decision.verdict != Verdict::undecidable; }

/// The cell of a claim that is decided; else an empty one.
template <class CellOf>
auto if_decided(CellOf cell_of) {
    return [cell_of](const JudgedClaim& j) { return decided(j) ? detail::cell(cell_of(j)) : report::Cell(); };
}

report::Table ledger_table(const std::vector<JudgedClaim>& judged) {
    return table("claims_ledger", words.line("ledger"), judged)
        .column("no.", {.reference = true}, [](auto& j) { return j.claim->id; })
        .column("source", {.filter = true}, [](auto& j) { return j.claim->source().name; })
        .column("question", {.filter = true, .reference = true}, [](auto& j) { return j.claim->question; })
        .column("claim", [](auto& j) { return j.claim->said(); })
        .column("verdict", {.filter = true}, [](auto& j) { return shown(j.decision.verdict); })
        .column("deciding number", if_decided([](auto& j) { return cell_of(j.deciding_value()); }))
        .column("unit", if_decided([](auto& j) { return j.claim->rule.unit; }))
        .column("required", [](auto& j) { return words_of(j.claim->rule); })
        .sortable();
}

report::EntryList ledger_entries(const std::vector<JudgedClaim>& judged) {
    report::EntryList list{"Claim", {}};
    for (const JudgedClaim& j : judged) {
        const Source& source = j.claim->source();
        list.entries.push_back({std::string(j.claim->id),
                                words.say(source.citation.empty() ? "entry" : "entry.cited", "source"_a = source.name,
                                          "citation"_a = source.citation, "claim"_a = j.claim->said()),
                                {rule_text(j), verdict_text(j)}});
    }
    return list;
}

}   // namespace

report::Check ledger_check(const std::vector<JudgedClaim>& judged) {
    const auto differs = [](const JudgedClaim& j) {
        std::set<bool> sides;   // of the threshold
        if (j.measurement.undecidable.empty())
            for (const Case& c : j.measurement.cases)
                if (std::isfinite(c.value)) sides.insert(j.claim->rule.satisfied_by(c.value));
        const Verdict again = sides.empty()          ? Verdict::undecidable
                              : sides.size() == 2    ? Verdict::conditional
                              : sides.contains(true) ? Verdict::holds
                                                     : Verdict::refuted;
        return again != j.decision.verdict;
    };
    return check_near(words.line("check.followed"), 0, double(std::ranges::count_if(judged, differs)), 0);
}

report::Text ledger_summary(const std::vector<JudgedClaim>& judged) {
    return words.say("summary", "claims"_a = judged.size(), "holds"_a = count_of(judged, Verdict::holds),
                     "conditional"_a = count_of(judged, Verdict::conditional), "refuted"_a = count_of(judged, Verdict::refuted),
                     "undecidable"_a = count_of(judged, Verdict::undecidable));
}

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("claims")};
    report::Section& section = answer.section;
    ClaimBench bench(library, settings);
    std::vector<JudgedClaim> ledger;
    for (const Claim& claim : claim_list()) {
        progress("claim: " + claim.said());
        ledger.push_back(judged(claim, bench));
    }
    section.inputs = bench.inputs();
    section.warnings = bench.warnings();

    add_words(section, words, "method", "holds"_a = shown(Verdict::holds), "conditional"_a = shown(Verdict::conditional),
              "refuted"_a = shown(Verdict::refuted), "undecidable"_a = shown(Verdict::undecidable));
    add_words(section, words, "results");
    add(section, ledger_table(ledger));
    for (report::Plot& plot : bench.plots) add(section, std::move(plot));
    add_words(section, words, "every_claim");
    add(section, ledger_entries(ledger));
    add_discussion(section, ledger);
    add(section, ledger_check(ledger));

    section.parameters = {{"rules", words.line("parameter.rules")}, {"noise", words.line("parameter.noise", "seed"_a = settings.seed)}};
    section.extent = report::plain(ledger_summary(ledger));
    section.answer = words.say("answer", "claims"_a = ledger.size(), "holds"_a = count_of(ledger, Verdict::holds));
    return answer;
}

extern const Chapter chapter{
    .id = "claims",
    .code = {{"decide", "src/questions/claims/claim.cpp"},
             {"claim_list", "src/questions/claims/claim.cpp"},
             {"ClaimBench", "src/questions/claims/claim_bench.h"},
             {"report_mesh", "src/questions/core/stand_ins.cpp"},
             {"answer", "src/questions/claims/chapter.cpp"}},
    .roles = {"armadillo", "plane", "lilium", "plane_ns", "fandisk_ns", "cube", "cube8", "sphere", "ellipsoid", "torus", "bumpy_cube",
              "saddle", "fandisk"},
    .planned_roles = 1,
    .cost = {.cpu = {{1.5, 0.2}, {0.3, 0.2}}, .memory = {{7, 6}, {1, 6}}},
    .answer = answer,
    .on_request = true,
};

}   // namespace meshfolio::claims
