#include "questions/operators/parts.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/measures/mesh_laws.h"
#include "questions/core/section_tools.h"

namespace meshfolio::operators {

namespace {

using report::math;
using report::ref;

constexpr double precise_below = 1e-8;   // |H| × mean edge of the flat square

std::vector<std::string> titles_where(const std::vector<KnownTrial>& known, bool (*chosen)(const KnownTrial&)) {
    std::vector<std::string> titles;
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (chosen(known[i])) titles.push_back(laboratory_operators()[i].title());
    }
    return titles;
}

std::string quoted_list(std::vector<std::string> titles) {
    for (std::string& title : titles) title = "“" + title + "”";
    return listed(titles);
}

void say_precision(report::Section& section, const std::vector<KnownTrial>& known) {
    std::vector<std::string> lost;
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (known[i].plane >= precise_below)
            lost.push_back("“" + laboratory_operators()[i].title() + "” reads " + readable(known[i].plane));
    }
    const std::vector<std::string> kept = titles_where(known, [](const KnownTrial& t) { return t.plane < precise_below; });
    report::Text text = report::text("Linear precision. ");
    if (!kept.empty()) report::extend(text, "Of an irregular flat square H is 0 to rounding by ", quoted_list(kept), ". ");
    if (!lost.empty()) report::extend(text, "The others bend it (|H| × mean edge): ", listed(lost), " (", ref("operators_known"), ").");
    section.blocks.push_back(report::Paragraph{text});
}

std::string names_of_labs(const std::vector<LaboratoryMesh>& labs) {
    std::vector<std::string> names;
    for (const LaboratoryMesh& lab : labs) names.push_back(lab.name());
    return listed(names);
}

/// Which operators have no negative weight on any mesh, and what the default has.
void say_weights(report::Section& section, const std::vector<LaboratoryMesh>& labs) {
    std::vector<std::string> clean, indefinite, open, counts;
    bool any_negative = false;
    for (std::size_t i = 0; i < laboratory_operators().size(); ++i) {
        const auto all = [&](auto holds) {
            return std::all_of(labs.begin(), labs.end(), [&](const LaboratoryMesh& lab) { return holds(lab.trials[i].scores); });
        };
        if (all([](const OperatorScores& s) { return s.negative_inside + s.negative_boundary == 0; }))
            clean.push_back(laboratory_operators()[i].title());
        else
            any_negative = true;
        for (const LaboratoryMesh& lab : labs) {
            const Inertia& negative = lab.trials[i].scores.negative;
            const std::string title = "“" + laboratory_operators()[i].title() + "” (";
            const Proof proof = semidefinite(negative);
            if (proof == Proof::refuted) indefinite.push_back(title + std::to_string(negative.below) + " on " + lab.name() + ")");
            const OperatorScores& scores = lab.trials[i].scores;
            const bool untold = scores.without_mass == 0 && scores.verdict == Definiteness::Verdict::undecided;
            if (proof == Proof::undecided || (proof == Proof::proved && untold)) open.push_back(title + lab.name() + ")");
        }
    }
    for (const LaboratoryMesh& lab : labs) {
        const OperatorScores &cotan = lab.trial(OperatorKind::cotan).scores, &idt = lab.trial(OperatorKind::idt).scores;
        const double share = double(cotan.negative_inside + cotan.negative_boundary) / std::max(1, cotan.weights);
        counts.push_back(readable_percent(share) + " on " + lab.name() + " (smallest " + readable(cotan.smallest_weight) + "; after " +
                         counted(lab.flips, "flip") + " " + std::to_string(idt.negative_inside) + " inside and " +
                         std::to_string(idt.negative_boundary) + " on the boundary are left)");
    }
    report::Text text = report::text("Maximum principle. Of the cotangent weights ", listed(counts), " are negative. ");
    if (!clean.empty())
        report::extend(text, "No weight is negative beyond rounding on any of these meshes with ", quoted_list(clean), ". ");
    if (!indefinite.empty())
        report::extend(text, "An eigenvalue of ", math("−C"), " below 0, with which even implicit smoothing may grow, was found with ",
                       listed(indefinite), ".");
    else if (!open.empty())
        report::extend(text, "No ", math("−C"), " is shown to have an eigenvalue below 0; rounding forbids to prove it of ", listed(open),
                       ".");
    else if (any_negative)
        report::extend(text, "None of the negative weights here makes an operator indefinite: no ", math("−C"),
                       " of these meshes has an eigenvalue below 0.");
    else
        report::extend(text, "No ", math("−C"), " has an eigenvalue below 0.");
    section.blocks.push_back(report::Paragraph{text});
}

void say_steps(report::Section& section, const std::vector<LaboratoryMesh>& labs) {
    std::vector<std::string> idt, own;
    bool helps = true, harms = true;
    constexpr double rounding = 1e-9;
    for (const LaboratoryMesh& lab : labs) {
        const double ratio = lab.trial(OperatorKind::idt).critical_ratio;
        helps = helps && ratio >= 1 - rounding;
        harms = harms && ratio <= 1 + rounding;
        idt.push_back("×" + readable(ratio) + " on " + lab.name());
        own.push_back("×" + readable(lab.trial(OperatorKind::idt_original_mass).critical_ratio));
    }
    add_paragraph(section, "Stable steps. Intrinsic Delaunay flips change ", math("λ_crit"), " by ", listed(idt), ": ",
                  helps && harms ? "here they change no step"
                  : helps        ? "here they never shorten the step"
                  : harms        ? "they do not lengthen it on any of these meshes, since flips shrink some vertex areas as well"
                                 : "they may lengthen the step or shorten it, since flips shrink some vertex areas as well",
                  ". With the same weights over the areas of the mesh itself it is ", listed(own),
                  "; that can never be less than 1, for flips only lower the Dirichlet energy ", ref("rippa_1990"),
                  ". Without the ½ the step is half as long and H twice as large.");
}

void say_curvature(report::Section& section, const std::vector<KnownTrial>& known) {
    const auto best = [&](auto error) {
        std::size_t at = 0;
        for (std::size_t i = 1; i < known.size(); ++i) {
            if (error(known[i]) < error(known[at])) at = i;
        }
        return "“" + laboratory_operators()[at].title() + "” (" + readable_percent(error(known[at])) + ")";
    };
    const auto sphere = [](const KnownTrial& t) { return t.H_error[0]; };
    const auto ellipsoid = [](const KnownTrial& t) { return t.H_error[1]; };
    const auto eigenvalue = [](const KnownTrial& t) { return t.eigenvalue_error; };
    const KnownTrial& standard = known.front();
    add_paragraph(section, "Curvature and spectrum. On the jittered sphere H is best by ", best(sphere), ", on the ellipsoid by ",
                  best(ellipsoid), "; the default has ", readable_percent(sphere(standard)), " and ", readable_percent(ellipsoid(standard)),
                  ". The eigenvalues of that sphere are best by ", best(eigenvalue), ", against ", readable_percent(eigenvalue(standard)),
                  " of the default.");
}

/// Areas that are not positive leave no operator; where that happens it is said.
void say_areas(report::Section& section, const std::vector<LaboratoryMesh>& labs) {
    std::vector<std::string> without;
    for (const LaboratoryMesh& lab : labs) {
        for (std::size_t i = 0; i < lab.trials.size(); ++i) {
            const int count = lab.trials[i].scores.without_mass;
            if (count > 0)
                without.push_back(counted(count, "vertex", "vertices") + " of " + lab.name() + " (“" + laboratory_operators()[i].title() +
                                  "”)");
        }
    }
    if (without.empty()) return;
    add_paragraph(section, "Areas that are not positive stand at ", listed(without),
                  "; there H is undefined, and neither a spectrum nor a stable step exists.");
}

}   // namespace

void add_discussion(report::Section& section, const std::vector<LaboratoryMesh>& labs, const std::vector<KnownTrial>& known) {
    add_heading(section, "Discussion");
    say_precision(section, known);
    say_weights(section, labs);
    say_steps(section, labs);
    say_curvature(section, known);
    say_areas(section, labs);
    const auto own_areas = [](const LaboratoryMesh& lab) { return lab.trial(OperatorKind::idt_original_mass).critical_ratio; };
    const LaboratoryMesh& lab = *std::max_element(
        labs.begin(), labs.end(), [&](const LaboratoryMesh& a, const LaboratoryMesh& b) { return own_areas(a) < own_areas(b); });
    const double ratio = own_areas(lab);
    section.findings.push_back(
        {ratio > 1 + 1e-9 ? report::text("Operators: on ", lab.name(), " intrinsic Delaunay weights over the mesh's own areas allow steps ",
                                         readable(ratio), " times as long as the cotangent operator.")
                          : report::text("Operators: intrinsic Delaunay weights over the mesh's own areas allow no longer steps than the "
                                         "cotangent operator on ",
                                         names_of_labs(labs), "."),
         6});
}

}   // namespace meshfolio::operators
