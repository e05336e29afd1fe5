#include "geometry/measures/mesh_laws.h"
#include "questions/operators/parts.h"

namespace meshfolio::operators {

namespace {

constexpr double precise_below = 1e-8;   // |H| × mean edge of the flat square

report::Text about_precision(const KnownTrials& known) {
    Names lost;
    for (const KnownTrial& t : known)
        if (t.plane >= precise_below)
            lost.push_back(words.line("precision.lost", "operator"_a = t.made_by.title(), "H"_a = readable(t.plane)));
    return words.say("precision", "kept"_a = known.size() - lost.size(), "all"_a = known.size(), "lost"_a = listed(lost));
}

/// Reports the mesh with the most negative weights.
report::Text about_negative_weights(const Labs& labs, const Names& clean) {
    const auto share_of = [](const LaboratoryMesh& lab) {
        const OperatorScores& cotan = lab.trial(OperatorKind::cotan).scores;
        return double(cotan.negative_inside + cotan.negative_boundary) / std::max(1, cotan.weights);
    };
    const LaboratoryMesh& lab = *std::ranges::max_element(labs, {}, share_of);
    const OperatorScores& idt = lab.trial(OperatorKind::idt).scores;
    const double share = share_of(lab);
    if (share == 0) return words.say("weights.no_cotangent");
    return words.say("weights", "share"_a = readable_percent(share, 2), "mesh"_a = lab.name(), "flips"_a = lab.flips,
                     "left"_a = idt.negative_inside + idt.negative_boundary, "clean"_a = listed(clean));
}

/// Which operators have no negative weight on any mesh, what the default has, and which are indefinite.
report::Text about_weights(const Labs& labs) {
    Names clean, indefinite, open;
    bool any_negative = false;
    for (std::size_t i = 0; i < laboratory_operators().size(); ++i) {
        const std::string title = quoted(laboratory_operators()[i].title());
        bool none_negative = true;
        for (const LaboratoryMesh& lab : labs) {
            const OperatorScores& scores = lab.trials[i].scores;
            none_negative = none_negative && scores.negative_inside + scores.negative_boundary == 0;
            const Proof proof = semidefinite(scores.negative);
            if (proof == Proof::refuted)
                indefinite.push_back(title + " (" + std::to_string(scores.negative.below) + " on " + lab.name() + ")");
            const bool untold = scores.without_mass == 0 && scores.verdict == Definiteness::Verdict::undecided;
            if (proof == Proof::undecided || (proof == Proof::proved && untold)) open.push_back(title + " (" + lab.name() + ")");
        }
        if (none_negative) clean.push_back(title);
        any_negative = any_negative || !none_negative;
    }
    return report::text(about_negative_weights(labs, clean), " ",
                        !indefinite.empty() ? words.say("weights.indefinite", "operators"_a = listed(indefinite))
                        : !open.empty()     ? words.say("weights.open", "operators"_a = listed(open))
                                            : words.say(any_negative ? "weights.harmless" : "weights.none_negative"));
}

report::Text about_steps(const Labs& labs) {
    Names idt, own;
    bool helps = true, harms = true;
    constexpr double rounding = 1e-9;
    for (const LaboratoryMesh& lab : labs) {
        const double ratio = lab.trial(OperatorKind::idt).critical_ratio;
        helps = helps && ratio >= 1 - rounding;
        harms = harms && ratio <= 1 + rounding;
        idt.push_back("×" + readable(ratio) + " on " + lab.name());
        own.push_back("×" + readable(lab.trial(OperatorKind::idt_original_mass).critical_ratio));
    }
    const char* key = helps && harms ? "steps.unchanged" : helps ? "steps.never_shorter" : harms ? "steps.never_longer" : "steps.either";
    return report::text(words.say(key, "changes"_a = listed(idt)), " ", words.say("steps.own_areas", "changes"_a = listed(own)));
}

report::Text about_curvature(const KnownTrials& known) {
    const auto sphere = [](const KnownTrial& t) { return t.H_error[0]; };
    const auto ellipsoid = [](const KnownTrial& t) { return t.H_error[1]; };
    const auto best = [&](auto error) {
        const KnownTrial& t = *std::ranges::min_element(known, {}, error);
        return quoted(t.made_by.title()) + " (" + readable_percent(std::invoke(error, t)) + ")";
    };
    const KnownTrial& standard = known.front();
    return words.say("curvature", "best_sphere"_a = best(sphere), "best_ellipsoid"_a = best(ellipsoid),
                     "sphere"_a = readable_percent(sphere(standard)), "ellipsoid"_a = readable_percent(ellipsoid(standard)),
                     "best_eigenvalues"_a = best(&KnownTrial::eigenvalue_error),
                     "eigenvalues"_a = readable_percent(standard.eigenvalue_error));
}

/// Areas that are not positive leave no operator.
report::Text about_areas(const Labs& labs) {
    Names without;
    for (const LaboratoryMesh& lab : labs)
        for (const OperatorTrial& t : lab.trials)
            if (t.scores.without_mass > 0)
                without.push_back(words.line("areas.where", "vertices"_a = t.scores.without_mass, "mesh"_a = lab.name(),
                                             "operator"_a = t.made_by.title()));
    return without.empty() ? report::Text() : words.say("areas", "where"_a = listed(without));
}

report::Text answer_of(const Labs& labs) {
    const auto own_areas = [](const LaboratoryMesh& lab) { return lab.trial(OperatorKind::idt_original_mass).critical_ratio; };
    const LaboratoryMesh& lab = *std::ranges::max_element(labs, {}, own_areas);
    const double ratio = own_areas(lab);
    return ratio >= 1.01 ? words.say("answer.longer", "mesh"_a = lab.name(), "times"_a = readable(ratio, 2))
                         : words.say("answer.no_longer", "meshes"_a = listed(names_of(labs)));
}

}   // namespace

void add_discussion(report::Section& section, const Labs& labs, const KnownTrials& known) {
    add_words(section, words, "discussion");
    add_paragraphs(section, {about_precision(known), about_weights(labs), about_steps(labs), about_curvature(known), about_areas(labs)});
    section.answer = answer_of(labs);
}

}   // namespace meshfolio::operators
