// The section "claims": what earlier reports and papers say, measured again and judged, each by its rule.
#include "questions/claims/parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/number_text.h"
#include "questions/claims/claim_bench.h"
#include "questions/claims/claim_list.h"
#include "questions/core/section_tools.h"

namespace meshfolio::claims {

namespace {

constexpr std::string_view measurements = "claims_measurements";

std::string shown(Verdict verdict) { return std::string(symbol_of(verdict)) + " " + std::string(word_of(verdict)); }

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(
        section,
        "S0 to S3 are four earlier reports on this coursework; to their claims come some of the papers that the methods are taken from. "
        "Each claim is told in words of our own and turned into a rule: one quantity, one threshold, and the cases that the claim does "
        "not exclude. Some rules (low noise, noise beyond repair, the operator of ",
        report::math("A_i + A_j"),
        ", Taubin's and Rippa's claims, small steps) were put more exactly after a first measurement had shown them to test "
        "something else than is claimed; the others stand as they were first written. A few claims are theorems, which only a fault "
        "of this program could refute. The verdict follows from the rule and the numbers alone, on any mesh:");
    section.blocks.push_back(report::BulletList{
        {report::text(report::strong(shown(Verdict::holds)), " – every case is on the right side of the threshold;"),
         report::text(report::strong(shown(Verdict::conditional)), " – some cases are: the claim needs the condition that is named;"),
         report::text(report::strong(shown(Verdict::refuted)), " – no case is;"),
         report::text(report::strong(shown(Verdict::undecidable)),
                      " – what was measured here would be about something else, or this run does not measure it; the reason is given.")}});
    add_paragraph(
        section,
        "The deciding number is the one nearest to the threshold among those that turn the scale. What a claim is about is settled "
        "before anything is measured. A claim about any mesh may be measured on another than its author used: steps are then the same "
        "multiples of its largest stable step, lengths and noise the same multiples of its mean edge. A claim about one mesh itself, with "
        "a step or a number of iterations or modes that belongs to its triangles, is decided by that mesh alone. A claim about a kind of "
        "mesh is decided by that mesh or a bundled one of its kind, never by one's own. A mesh that lacks what a claim speaks of (sharp "
        "edges, negative weights) is left out, and a claim that compares meshes needs different ones.");
}

/// By source: "S0: holds 5, refuted 2 and …".
report::Text by_source(const std::vector<JudgedClaim>& judged) {
    std::map<std::string, std::map<Verdict, int>> counts;
    for (const JudgedClaim& j : judged)
        ++counts[j.claim->citation.empty() ? std::string(j.claim->source) : "The papers"][j.decision.verdict];
    report::Text t;
    for (const auto& [source, verdicts] : counts) {
        std::vector<std::string> parts;
        for (const auto& [verdict, n] : verdicts) parts.push_back(std::string(word_of(verdict)) + " " + std::to_string(n));
        report::extend(t, t.empty() ? "" : " ", report::strong(source + ":"), " ", listed(parts), ".");
    }
    return t;
}

report::Text with_verdict(const std::vector<JudgedClaim>& judged, Verdict verdict, const std::string& beginning) {
    report::Text t;
    for (const JudgedClaim& j : judged) {
        if (j.decision.verdict != verdict) continue;
        report::extend(t, t.empty() ? beginning : ", ", report::ref(std::string(j.claim->id)), " (", std::string(j.claim->source), ")");
    }
    if (!t.empty()) report::extend(t, ".");
    return t;
}

/// The refuted claim whose percentage is farthest from its threshold, as a ratio; other units do not compare.
const JudgedClaim* most_refuted(const std::vector<JudgedClaim>& judged) {
    const auto off = [](const JudgedClaim& j) {
        return std::abs(std::log(std::abs(j.measurement.cases[j.decision.deciding].value / j.claim->rule.threshold)));
    };
    const JudgedClaim* most = nullptr;
    for (const JudgedClaim& j : judged) {
        if (j.decision.verdict != Verdict::refuted || j.claim->rule.unit != "%" || !std::isfinite(off(j))) continue;
        if (most == nullptr || off(j) > off(*most)) most = &j;
    }
    return most;
}

void add_discussion(report::Section& section, const std::vector<JudgedClaim>& judged) {
    add_heading(section, "Discussion");
    section.blocks.push_back(report::Paragraph{ledger_summary(judged)});
    section.blocks.push_back(report::Paragraph{by_source(judged)});
    for (const auto& [verdict, beginning] :
         {std::pair{Verdict::refuted, "Refuted are "}, std::pair{Verdict::conditional, "A condition is needed by "}}) {
        if (report::Text t = with_verdict(judged, verdict, beginning); !t.empty())
            section.blocks.push_back(report::Paragraph{std::move(t)});
    }
    if (const JudgedClaim* most = most_refuted(judged)) {
        add_paragraph(section, "Of the refuted claims about percentages, the farthest from its threshold, by their ratio, is ",
                      report::ref(std::string(most->claim->id)), ": ", beginning_of(most->claim->rule), " ",
                      with_unit(most->measurement.cases[most->decision.deciding].value, most->claim->rule), " where ",
                      words_of(most->claim->rule), " would have been needed.");
    }
    add_paragraph(section, "A verdict is about the claim as the rule puts it; whoever reads a claim otherwise finds all numbers in ",
                  report::ref(std::string(measurements)), ".");
}

}   // namespace

int count_of(const std::vector<JudgedClaim>& judged, Verdict verdict) {
    return static_cast<int>(
        std::count_if(judged.begin(), judged.end(), [&](const JudgedClaim& j) { return j.decision.verdict == verdict; }));
}

report::Table ledger_table(const std::vector<JudgedClaim>& judged) {
    report::Table table;
    table.id = "claims_ledger";
    table.caption = "The ledger: who claims what, and what measuring says.";
    table.columns = {{"no."},  {"source"},  {"question"},  {"claim"}, {"verdict"}, {"deciding number", "", 3},
                     {"unit"}, {"true if"}, {"decided by"}};
    for (const char* name : {"no.", "question", "decided by"}) {
        std::find_if(table.columns.begin(), table.columns.end(), [&](const report::Column& c) { return c.name == name; })->reference = true;
    }
    for (const char* name : {"source", "question", "verdict"}) {
        std::find_if(table.columns.begin(), table.columns.end(), [&](const report::Column& c) { return c.name == name; })->filter = true;
    }
    table.sortable = true;
    for (const JudgedClaim& j : judged) {
        const bool decided = j.decision.verdict != Verdict::undecidable;
        const std::string figure = j.measurement.figure.empty() ? std::string(measurements) : j.measurement.figure;
        table.rows.push_back({std::string(j.claim->id), std::string(j.claim->source), std::string(j.claim->question),
                              std::string(j.claim->words), shown(j.decision.verdict),
                              cell_of(decided ? j.measurement.cases[j.decision.deciding].value : std::nan("")),
                              decided ? report::Cell(std::string(j.claim->rule.unit)) : report::Cell(), words_of(j.claim->rule),
                              decided ? report::Cell(figure) : report::Cell()});
    }
    return table;
}

report::Table measurement_table(const std::vector<JudgedClaim>& judged) {
    report::Table table;
    table.id = measurements;
    table.caption =
        "Every case of every claim that was measured: the quantity, and whether it is on the side of the threshold that the claim needs.";
    table.columns = {{"claim"}, {"quantity"}, {"case"}, {"measured", "", 4}, {"unit"}, {"true if"}, {"on that side"}};
    table.columns.front().reference = true;
    table.columns.front().filter = table.columns.back().filter = true;
    table.sortable = true;
    for (const JudgedClaim& j : judged) {
        if (j.decision.verdict == Verdict::undecidable) continue;
        for (const Case& c : j.measurement.cases) {
            const bool finite = std::isfinite(c.value);
            table.rows.push_back({std::string(j.claim->id), std::string(j.claim->rule.quantity), c.condition, cell_of(c.value),
                                  std::string(j.claim->rule.unit), words_of(j.claim->rule),
                                  finite ? report::Cell(std::string(j.claim->rule.satisfied_by(c.value) ? "yes" : "no")) : report::Cell()});
        }
    }
    return table;
}

report::EntryList ledger_entries(const std::vector<JudgedClaim>& judged) {
    report::EntryList list{"Claim", {}};
    for (const JudgedClaim& j : judged) {
        report::Text title = report::text(std::string(j.claim->source));
        if (!j.claim->citation.empty()) report::extend(title, " ", report::ref(std::string(j.claim->citation)));
        report::extend(title, ": ", std::string(j.claim->words));
        list.entries.push_back({std::string(j.claim->id), std::move(title), {rule_text(j), verdict_text(j)}});
    }
    return list;
}

std::vector<report::Check> ledger_checks(const std::vector<JudgedClaim>& judged) {
    std::vector<report::Check> checks;
    const report::Table table = ledger_table(judged), cases = measurement_table(judged);
    int counted_again = 0;
    for (const Verdict verdict : {Verdict::holds, Verdict::conditional, Verdict::refuted, Verdict::undecidable}) {
        const auto in_table = std::count_if(table.rows.begin(), table.rows.end(),
                                            [&](const auto& row) { return std::get<std::string>(row[4]) == shown(verdict); });
        counted_again += static_cast<int>(in_table);
    }
    checks.push_back(
        report::check_near("Verdicts in the ledger, counted one kind after the other", double(judged.size()), counted_again, 0));
    // What the table says of the cases must lead to the same verdicts.
    std::map<std::string, std::set<std::string>> sides;
    for (const auto& row : cases.rows) {
        if (const auto* side = std::get_if<std::string>(&row[6])) sides[std::get<std::string>(row[0])].insert(*side);
    }
    int other = 0;
    for (const JudgedClaim& j : judged) {
        const auto& side = sides[std::string(j.claim->id)];
        const Verdict again = side.empty()           ? Verdict::undecidable
                              : side.size() == 2     ? Verdict::conditional
                              : side.contains("yes") ? Verdict::holds
                                                     : Verdict::refuted;
        other += again == j.decision.verdict ? 0 : 1;
    }
    checks.push_back(report::check_near("Verdicts that do not follow from the table of measurements", 0, other, 0));
    return checks;
}

report::Text ledger_summary(const std::vector<JudgedClaim>& judged) {
    const int total = static_cast<int>(judged.size());
    const auto number = [&](Verdict verdict, const char* one, const char* many) {
        const int n = count_of(judged, verdict);
        return std::to_string(n) + (n == 1 ? one : many);
    };
    return report::text("Of ", counted(total, "claim"), " of earlier reports and papers, each with a rule of its own, ",
                        number(Verdict::holds, " holds, ", " hold, "),
                        number(Verdict::conditional, " holds with a condition, ", " hold with a condition, "),
                        number(Verdict::refuted, " is refuted, and ", " are refuted, and "),
                        std::to_string(count_of(judged, Verdict::undecidable)), " cannot be decided here.");
}

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("claims");
    ClaimBench bench(library, settings);
    std::vector<JudgedClaim> ledger;
    for (const Claim& claim : claim_list()) {
        progress("claim: " + std::string(claim.words));
        ledger.push_back(judged(claim, bench));
    }
    section.inputs = bench.inputs();
    section.warnings = bench.warnings();

    add_method(section);
    add_heading(section, "Results");
    section.blocks.emplace_back(ledger_table(ledger));
    for (report::Plot& plot : bench.plots) section.blocks.emplace_back(std::move(plot));
    add_heading(section, "Every claim, its rule and its verdict");
    section.blocks.emplace_back(ledger_entries(ledger));
    section.blocks.emplace_back(measurement_table(ledger));
    add_discussion(section, ledger);
    append_checks(section, ledger_checks(ledger));

    section.parameters["rules"] = "one quantity and one threshold a claim";
    section.parameters["noise"] = "Gaussian, seed " + std::to_string(settings.seed);
    section.extent = report::plain(ledger_summary(ledger));
    report::Text finding = ledger_summary(ledger);
    if (const JudgedClaim* refuted = most_refuted(ledger)) {
        report::extend(finding, " For instance “", std::string(refuted->claim->words), "” (", std::string(refuted->claim->source),
                       ") is refuted: ", beginning_of(refuted->claim->rule), " ",
                       with_unit(refuted->measurement.cases[refuted->decision.deciding].value, refuted->claim->rule), ", true if ",
                       words_of(refuted->claim->rule), ".");
    }
    section.findings.push_back({std::move(finding), 82});
    return answer;
}

extern const Chapter chapter{
    .id = "claims",
    .code = {{"decide", "src/questions/claims/claim.cpp"},
             {"claim_list", "src/questions/claims/claim_list.cpp"},
             {"ClaimBench", "src/questions/claims/claim_bench.h"},
             {"report_mesh", "src/questions/core/stand_ins.cpp"},
             {"answer", "src/questions/claims/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::claims
