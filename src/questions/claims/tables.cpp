#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

bool decided(const JudgedClaim& judged) { return judged.decision.verdict != Verdict::undecidable; }

/// The cell of a claim that is decided; else an empty one.
template <class CellOf>
auto if_decided(CellOf cell_of) {
    return [cell_of](const JudgedClaim& j) { return decided(j) ? detail::cell(cell_of(j)) : report::Cell(); };
}

}   // namespace

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

}   // namespace meshfolio::claims
