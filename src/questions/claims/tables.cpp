#include "questions/claims/parts.h"
#include "questions/core/table.h"

namespace meshfolio::claims {

namespace {

bool decided(const JudgedClaim& judged) { return judged.decision.verdict != Verdict::undecidable; }

/// The cell of a claim that is decided; else an empty one.
template <class CellOf>
auto if_decided(CellOf cell_of) {
    return [cell_of](const JudgedClaim& j) { return decided(j) ? detail::cell(cell_of(j)) : report::Cell(); };
}

const std::vector<Case>& deciding_cases(const JudgedClaim& judged) {
    static const std::vector<Case> none;
    return decided(judged) ? judged.measurement.cases : none;
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
        .column("true if", [](auto& j) { return words_of(j.claim->rule); })
        .column("decided by", {.reference = true},
                if_decided([](auto& j) { return j.measurement.figure.empty() ? std::string(measurements) : j.measurement.figure; }))
        .sortable();
}

report::Table measurement_table(const std::vector<JudgedClaim>& judged) {
    const auto side = [](auto& row) {
        if (!std::isfinite(row.part.value)) return report::Cell();
        return report::Cell(row.whole.claim->rule.satisfied_by(row.part.value) ? "yes" : "no");
    };
    return table(std::string(measurements), words.line("measurements"), parts_within(judged, deciding_cases))
        .column("claim", {.filter = true, .reference = true}, [](auto& row) { return row.whole.claim->id; })
        .column("quantity", [](auto& row) { return quantity_of(row.whole.claim->rule); })
        .column("case", [](auto& row) { return row.part.condition; })
        .column("measured", {.digits = 4}, [](auto& row) { return cell_of(row.part.value); })
        .column("unit", [](auto& row) { return row.whole.claim->rule.unit; })
        .column("true if", [](auto& row) { return words_of(row.whole.claim->rule); })
        .column("on that side", {.filter = true}, side)
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
