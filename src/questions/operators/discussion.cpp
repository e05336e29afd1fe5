#include "geometry/measures/mesh_laws.h"
#include "questions/operators/parts.h"
#include "questions/operators/study.h"

namespace meshfolio::operators {

namespace {

int negative_weights(const OperatorScores& scores) { return scores.negative_inside + scores.negative_boundary; }

/// Returns the share of negative weights of the default operator.
double negative_share(const LaboratoryMesh& lab) {
    const OperatorScores& cotan = lab.trial(OperatorKind::cotan).scores;
    return double(negative_weights(cotan)) / std::max(1, cotan.weights);
}

/// True if −C is neither proved semidefinite nor refuted on a mesh, or only by the count of its eigenvalues.
bool is_open(const OperatorScores& scores) {
    const Proof proof = semidefinite(scores.negative);
    const bool only_counted = scores.without_mass == 0 && scores.verdict == Definiteness::Verdict::undecided;
    return proof == Proof::undecided || (proof == Proof::proved && only_counted);
}

/// Returns the quoted titles of the operators for which `holds` is true on some mesh, with these meshes in brackets.
Names operators_where(const Labs& labs, auto holds) {
    Names names;
    for (std::size_t i = 0; i < laboratory_operators().size(); ++i) {
        const Names on = names_where(labs, [&](const LaboratoryMesh& lab) { return holds(lab.trials[i].scores); });
        if (!on.empty()) names.push_back(quoted(laboratory_operators()[i].title()) + " (" + listed(on) + ")");
    }
    return names;
}

/// Returns the range of λ_crit over that of the default on all meshes, as text; empty if none is defined.
std::string ratios(const Labs& labs, OperatorKind kind) {
    std::vector<double> each;
    for (const LaboratoryMesh& lab : labs)
        if (const double ratio = lab.trial(kind).critical_ratio; std::isfinite(ratio)) each.push_back(ratio);
    if (each.empty()) return "";
    return span_of(readable(std::ranges::min(each)), readable(std::ranges::max(each)));
}

/// Returns the quoted title of the operator with the least error.
std::string best(const KnownTrials& known, auto error) { return quoted(std::ranges::min_element(known, {}, error)->made_by.title()); }

}   // namespace

void add_discussion(report::Section& section, const Labs& labs, const KnownTrials& known, const LaboratoryMesh& shown) {
    constexpr double rounding = 1e-9, flat = 1e-8;   // of ratios; of |H| × mean edge
    Names lost, without_mass;
    for (const KnownTrial& t : known)
        if (!(t.plane < flat)) lost.push_back(quoted(t.made_by.title()));
    for (const LaboratoryMesh& lab : labs)
        for (const OperatorTrial& t : lab.trials)
            if (t.scores.without_mass > 0)
                without_mass.push_back(words.line("areas.where", "vertices"_a = t.scores.without_mass, "mesh"_a = lab.name(),
                                                  "operator"_a = t.made_by.title()));
    const LaboratoryMesh& most = *std::ranges::max_element(labs, {}, negative_share);
    Names clean;   // operators without negative weights
    for (std::size_t i = 0; i < laboratory_operators().size(); ++i)
        if (std::ranges::all_of(labs, [&](const LaboratoryMesh& lab) { return negative_weights(lab.trials[i].scores) == 0; }))
            clean.push_back(quoted(laboratory_operators()[i].title()));
    const auto changes = each_of(labs, [](const LaboratoryMesh& lab) { return lab.trial(OperatorKind::idt).critical_ratio; });
    const bool helps = std::ranges::all_of(changes, [](double ratio) { return ratio >= 1 - rounding; });
    const bool harms = std::ranges::all_of(changes, [](double ratio) { return ratio <= 1 + rounding; });
    add_words(section, words, "discussion", "lost"_a = listed(lost), "negative"_a = negative_share(most) > 0,
              "share"_a = readable_percent(negative_share(most), 2), "mesh"_a = most.name(),
              "left"_a = negative_weights(most.trial(OperatorKind::idt).scores), "clean"_a = listed(clean),
              "any_negative"_a = clean.size() < laboratory_operators().size(),
              "indefinite"_a = listed(operators_where(labs, [](auto& s) { return semidefinite(s.negative) == Proof::refuted; })),
              "open"_a = listed(operators_where(labs, is_open)), "changes"_a = ratios(labs, OperatorKind::idt),
              "unchanged"_a = helps && harms, "longer"_a = helps && !harms, "shorter"_a = harms && !helps, "either"_a = !helps && !harms,
              "own_areas"_a = ratios(labs, OperatorKind::idt_original_mass),
              "best_sphere"_a = best(known, [](const KnownTrial& t) { return t.H_error[0]; }),
              "best_ellipsoid"_a = best(known, [](const KnownTrial& t) { return t.H_error[1]; }),
              "best_eigenvalues"_a = best(known, &KnownTrial::eigenvalue_error), "figure"_a = id_of("operators", shown.name(), "h"),
              "shown"_a = shown.name(), "without_mass"_a = listed(without_mass));
    const auto own_areas = [](const LaboratoryMesh& lab) { return lab.trial(OperatorKind::idt_original_mass).critical_ratio; };
    const LaboratoryMesh& longest = *std::ranges::max_element(labs, {}, own_areas);
    section.answer = words.say("answer", "mesh"_a = longest.name(), "longer"_a = own_areas(longest) >= 1.01,
                               "times"_a = readable(own_areas(longest), 2));
}

}   // namespace meshfolio::operators
