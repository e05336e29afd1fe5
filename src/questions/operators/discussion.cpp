#include "geometry/measures/mesh_laws.h"
#include "questions/operators/parts.h"

namespace meshfolio::operators {

namespace {

/// |H| × mean edge of the flat square: below it is rounding.
bool is_precise(const KnownTrial& t) { return t.plane < 1e-8; }

int negative_weights(const OperatorScores& scores) { return scores.negative_inside + scores.negative_boundary; }

double negative_share(const LaboratoryMesh& lab) {
    const OperatorScores& cotan = lab.trial(OperatorKind::cotan).scores;
    return double(negative_weights(cotan)) / std::max(1, cotan.weights);
}

/// Is −C neither proved semidefinite nor refuted on this mesh, or only its count?
bool is_open(const OperatorScores& scores) {
    const Proof proof = semidefinite(scores.negative);
    const bool untold = scores.without_mass == 0 && scores.verdict == Definiteness::Verdict::undecided;
    return proof == Proof::undecided || (proof == Proof::proved && untold);
}

/// “title”, with the meshes where `holds` is true in brackets; nothing where it is on none.
Names operators_where(const Labs& labs, auto holds) {
    Names names;
    for (std::size_t i = 0; i < laboratory_operators().size(); ++i) {
        const Names on = names_where(labs, [&](const LaboratoryMesh& lab) { return holds(lab.trials[i].scores); });
        if (!on.empty()) names.push_back(quoted(laboratory_operators()[i].title()) + " (" + listed(on) + ")");
    }
    return names;
}

Names never_negative(const Labs& labs) {
    Names names;
    for (std::size_t i = 0; i < laboratory_operators().size(); ++i)
        if (std::ranges::all_of(labs, [&](const LaboratoryMesh& lab) { return negative_weights(lab.trials[i].scores) == 0; }))
            names.push_back(quoted(laboratory_operators()[i].title()));
    return names;
}

/// λ_crit over that of the default, least and largest over the meshes.
std::string ratios(const Labs& labs, OperatorKind kind) {
    std::vector<double> each;
    for (const LaboratoryMesh& lab : labs)
        if (const double ratio = lab.trial(kind).critical_ratio; std::isfinite(ratio)) each.push_back(ratio);
    if (each.empty()) return "";
    return span_of(readable(std::ranges::min(each)), readable(std::ranges::max(each)));
}

bool on_all(const Labs& labs, auto holds) {
    return std::ranges::all_of(labs, [&](const LaboratoryMesh& lab) { return holds(lab.trial(OperatorKind::idt).critical_ratio); });
}

std::string best(const KnownTrials& known, auto error) { return quoted(std::ranges::min_element(known, {}, error)->made_by.title()); }

report::Facts facts_of(const Labs& labs, const KnownTrials& known, const LaboratoryMesh& shown) {
    constexpr double rounding = 1e-9;
    Names lost, without_mass;
    for (const KnownTrial& t : known)
        if (!is_precise(t)) lost.push_back(quoted(t.made_by.title()));
    for (const LaboratoryMesh& lab : labs)
        for (const OperatorTrial& t : lab.trials)
            if (t.scores.without_mass > 0)
                without_mass.push_back(words.line("areas.where", "vertices"_a = t.scores.without_mass, "mesh"_a = lab.name(),
                                                  "operator"_a = t.made_by.title()));
    const LaboratoryMesh& most = *std::ranges::max_element(labs, {}, negative_share);
    const Names clean = never_negative(labs);
    const bool helps = on_all(labs, [](double ratio) { return ratio >= 1 - rounding; });
    const bool harms = on_all(labs, [](double ratio) { return ratio <= 1 + rounding; });
    return {"lost"_a = listed(lost),
            "negative"_a = negative_share(most) > 0,
            "share"_a = readable_percent(negative_share(most), 2),
            "mesh"_a = most.name(),
            "left"_a = negative_weights(most.trial(OperatorKind::idt).scores),
            "clean"_a = listed(clean),
            "any_negative"_a = clean.size() < laboratory_operators().size(),
            "indefinite"_a = listed(operators_where(labs, [](auto& s) { return semidefinite(s.negative) == Proof::refuted; })),
            "open"_a = listed(operators_where(labs, is_open)),
            "changes"_a = ratios(labs, OperatorKind::idt),
            "unchanged"_a = helps && harms,
            "longer"_a = helps && !harms,
            "shorter"_a = harms && !helps,
            "either"_a = !helps && !harms,
            "own_areas"_a = ratios(labs, OperatorKind::idt_original_mass),
            "best_sphere"_a = best(known, [](const KnownTrial& t) { return t.H_error[0]; }),
            "best_ellipsoid"_a = best(known, [](const KnownTrial& t) { return t.H_error[1]; }),
            "best_eigenvalues"_a = best(known, &KnownTrial::eigenvalue_error),
            "figure"_a = id_of("operators", shown.name(), "h"),
            "shown"_a = shown.name(),
            "without_mass"_a = listed(without_mass)};
}

report::Text answer_of(const Labs& labs) {
    const auto own_areas = [](const LaboratoryMesh& lab) { return lab.trial(OperatorKind::idt_original_mass).critical_ratio; };
    const LaboratoryMesh& lab = *std::ranges::max_element(labs, {}, own_areas);
    return words.say("answer", "mesh"_a = lab.name(), "longer"_a = own_areas(lab) >= 1.01, "times"_a = readable(own_areas(lab), 2));
}

}   // namespace

void add_discussion(report::Section& section, const Labs& labs, const KnownTrials& known, const LaboratoryMesh& shown) {
    add_words(section, words, "discussion", facts_of(labs, known, shown));
    section.answer = answer_of(labs);
}

}   // namespace meshfolio::operators
