// The section "claims": claims of earlier reports and papers, measured again and judged by their rules.
#include <set>

#include "questions/claims/claim.h"

namespace meshfolio::claims {

namespace {

using Ledger = std::vector<JudgedClaim>;

int count_of(const Ledger& ledger, Verdict verdict) {
    return static_cast<int>(std::ranges::count_if(ledger, [&](const JudgedClaim& j) { return j.decision.verdict == verdict; }));
}

report::Text summary_of(const Ledger& ledger) {
    return words.say("summary", "claims"_a = ledger.size(), "holds"_a = count_of(ledger, Verdict::holds),
                     "conditional"_a = count_of(ledger, Verdict::conditional), "refuted"_a = count_of(ledger, Verdict::refuted),
                     "undecidable"_a = count_of(ledger, Verdict::undecidable));
}

/// Adds the message about the claims with this verdict, if there are any.
void add_claims_with(report::Section& section, const Ledger& ledger, Verdict verdict, std::string_view key) {
    report::Text claims;
    for (const JudgedClaim& j : ledger) {
        if (j.decision.verdict != verdict) continue;
        report::extend(claims, claims.empty() ? "" : ", ",
                       words.say("claim_and_source", "claim"_a = j.claim->id, "source"_a = j.claim->source().name));
    }
    if (!claims.empty()) add_words(section, words, key, "claims"_a = claims);
}

report::Table ledger_table(const Ledger& ledger) {
    const auto if_decided = [](auto cell_of_claim) {
        return [=](const JudgedClaim& j) {
            return j.decision.verdict == Verdict::undecidable ? report::Cell() : detail::cell(cell_of_claim(j));
        };
    };
    return table("claims_ledger", words.line("ledger"), ledger)
        .column("no.", {.reference = true}, [](auto& j) { return j.claim->id; })
        .column("source", {.filter = true}, [](auto& j) { return j.claim->source().name; })
        .column("question", {.filter = true, .reference = true}, [](auto& j) { return j.claim->question; })
        .column("claim", [](auto& j) { return j.claim->said(); })
        .column("verdict", {.filter = true}, [](auto& j) { return label_of(j.decision.verdict); })
        .column("deciding number", if_decided([](auto& j) { return cell_of(j.deciding_value()); }))
        .column("unit", if_decided([](auto& j) { return j.claim->rule.unit; }))
        .column("required", [](auto& j) { return bound_of(j.claim->rule); })
        .sortable();
}

report::EntryList ledger_entries(const Ledger& ledger) {
    report::EntryList list{"Claim", {}};
    for (const JudgedClaim& j : ledger) {
        const Source& source = j.claim->source();
        list.entries.push_back({std::string(j.claim->id),
                                words.say(source.citation.empty() ? "entry" : "entry.cited", "source"_a = source.name,
                                          "citation"_a = source.citation, "claim"_a = j.claim->said()),
                                {rule_text(j), verdict_text(j)}});
    }
    return list;
}

/// Checks that the rules, applied again to each case, give the verdicts of the ledger.
report::Check ledger_check(const Ledger& ledger) {
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
    return check_near(words.line("check.followed"), 0, double(std::ranges::count_if(ledger, differs)), 0);
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("claims")};
    report::Section& section = answer.section;
    std::vector<report::Plot> plots;
    const Ledger ledger = judged_claims(library, settings, progress, section, plots);
    add_words(section, words, "method", "holds"_a = label_of(Verdict::holds), "conditional"_a = label_of(Verdict::conditional),
              "refuted"_a = label_of(Verdict::refuted), "undecidable"_a = label_of(Verdict::undecidable));
    add_words(section, words, "results");
    add(section, ledger_table(ledger));
    for (report::Plot& plot : plots) add(section, std::move(plot));
    add_words(section, words, "every_claim");
    add(section, ledger_entries(ledger));
    add_words(section, words, "discussion", "summary"_a = summary_of(ledger));
    add_claims_with(section, ledger, Verdict::refuted, "discussion.refuted");
    add_claims_with(section, ledger, Verdict::conditional, "discussion.conditional");
    add_words(section, words, "discussion.rules");
    add(section, ledger_check(ledger));

    section.parameters = {{"rules", words.line("parameter.rules")}, {"noise", words.line("parameter.noise", "seed"_a = settings.seed)}};
    section.extent = report::plain(summary_of(ledger));
    section.answer = words.say("answer", "claims"_a = ledger.size(), "holds"_a = count_of(ledger, Verdict::holds));
    return answer;
}

extern const Chapter chapter{
    .id = "claims",
    .code = {{"decide", "src/questions/claims/claim.cpp"},
             {"claim_list", "src/questions/claims/claim.cpp"},
             {"ClaimBench", "src/questions/claims/parts.h"},
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
