// Tables and the figure of the operator laboratory.
#include "questions/operators/parts.h"

namespace meshfolio::operators {

namespace {

/// Whether −C is proved semidefinite, else how far below 0 its spectrum goes or may go.
std::string stability_word(const OperatorScores& scores) {
    if (std::isnan(scores.lowest)) return "–";
    if (scores.verdict == Definiteness::Verdict::semidefinite) return "stable";
    const bool proved = scores.verdict == Definiteness::Verdict::indefinite;
    return words.line(proved ? "scores.none_stable" : "scores.undecided", "lowest"_a = readable(scores.lowest, 2));
}

}   // namespace

report::Table score_table(const LaboratoryMesh& lab) {
    return table(id_of("operators", lab.name(), "scores"),
                 words.line("scores", "mesh"_a = lab.name(), "vertices"_a = lab.subject.mesh().vertex_count(), "flips"_a = lab.flips),
                 lab.trials)
        .column("operator", [](auto& t) { return t.made_by.title(); })
        .column("asymmetry of C", {.digits = 2}, [](auto& t) { return t.scores.asymmetry; })
        .column("eigenvalues of −C below 0", {.digits = 6}, [](auto& t) { return t.scores.negative.below; })
        .column("weights < 0 inside", {.digits = 6}, [](auto& t) { return t.scores.negative_inside; })
        .column("weights < 0 on the boundary", {.digits = 6}, [](auto& t) { return t.scores.negative_boundary; })
        .column("smallest weight", [](auto& t) { return t.scores.smallest_weight; })
        .column("steps up to λ_crit", [](auto& t) { return stability_word(t.scores); })
        .column("λ_crit", {.unit = "length²", .digits = 4}, [](auto& t) { return cell_of(t.scores.critical); })
        .column("λ_crit, × default", [](auto& t) { return cell_of(t.critical_ratio); })
        .column("spectrum changes by", {.unit = "%"}, [](auto& t) { return cell_of(100 * t.spectrum_shift); })
        .column("H changes by", {.unit = "%"}, [](auto& t) { return cell_of(100 * t.H_change); });
}

report::Table known_table(const KnownTrials& trials) {
    return table("operators_known", words.line("known"), trials)
        .column("operator", [](auto& t) { return t.made_by.title(); })
        .column("H of the flat square", {.unit = "1 / mean edge", .digits = 2, .best = Best::smallest},
                [](auto& t) { return cell_of(t.plane); })
        .column("H of the sphere off by", {.unit = "%", .best = Best::smallest}, [](auto& t) { return cell_of(100 * t.H_error[0]); })
        .column("H of the ellipsoid off by", {.unit = "%", .best = Best::smallest}, [](auto& t) { return cell_of(100 * t.H_error[1]); })
        .column("eigenvalues off by", {.unit = "%", .best = Best::smallest}, [](auto& t) { return cell_of(100 * t.eigenvalue_error); });
}

void add_figure_of(Answer& answer, const LaboratoryMesh& lab) {
    const CurvatureSubject& s = lab.subject;
    output::FigureRequest request{
        .id = id_of("operators", lab.name(), "h"),
        .title = words.line("figure.title"),
        .subtitle = words.line("figure.subtitle", "file"_a = s.source->input.file, "vertices"_a = s.mesh().vertex_count()),
        .layout = output::Layout::multiples};
    Names told;
    for (const OperatorTrial& t : lab.trials) {
        const std::string title = t.made_by.title();
        request.panels.push_back(panel_of(*s.source, id_of("operators", lab.name(), t.made_by.id()), title, s.mean_edge * t.H));
        told.push_back(std::isfinite(t.H_change)
                           ? words.line("figure.alt.operator", "operator"_a = title, "change"_a = readable_percent(t.H_change))
                           : title);
    }
    const auto range = output::robust_range({request.panels.front()}, "diverging", "H × mean edge", "", 0.01, 0.03);
    request.range = range_for(range, request.panels);
    add_figure(
        answer, std::move(request),
        words.line("figure.caption", "mesh"_a = lab.name(), "mean_edge"_a = readable(s.mean_edge), "undefined"_a = undefined_words(s)),
        words.line("figure.alt", "mesh"_a = lab.name(), "operators"_a = joined(told)));
}

}   // namespace meshfolio::operators
