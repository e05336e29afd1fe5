#include "geometry/measures/mesh_laws.h"
#include "questions/bench/law_checks.h"
#include "questions/operators/parts.h"
#include "questions/operators/study.h"

namespace meshfolio::operators {

namespace {

/// Returns "stable" if −C is proved semidefinite, else words with the lowest value of its spectrum; "–" if that is not known.
std::string stability_word(const OperatorScores& scores) {
    if (std::isnan(scores.lowest)) return "–";
    if (scores.verdict == Definiteness::Verdict::semidefinite) return "stable";
    const bool proved = scores.verdict == Definiteness::Verdict::indefinite;
    return words.line(proved ? "scores.none_stable" : "scores.undecided", "lowest"_a = readable(scores.lowest, 2));
}

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
        .column("H changes by", {.unit = "%"}, [](auto& t) { return cell_of(100 * t.H_change); })
        .file_only();
}

/// One operator on all meshes.
struct Summary {
    const Labs& labs;
    std::size_t index;   // in laboratory_operators()

    /// Return the largest and the smallest value that is defined; an empty cell if none is.
    report::Cell largest(auto value) const { return cell_of(-least(-1, value)); }
    report::Cell smallest(auto value) const { return cell_of(least(1, value)); }

private:
    double least(double sign, auto value) const {
        double found = infinity;
        for (const LaboratoryMesh& lab : labs)
            if (const double x = std::invoke(value, lab.trials[index]); std::isfinite(x)) found = std::min(found, sign * x);
        return found;
    }
};

/// Returns the share of negative weights [%].
double negative_percent(const OperatorTrial& t) {
    return 100.0 * (t.scores.negative_inside + t.scores.negative_boundary) / std::max(1, t.scores.weights);
}

/// Returns a table of the worst values over the meshes, a row for each operator.
report::Table summary_table(const Labs& labs) {
    std::vector<Summary> rows;
    for (std::size_t i = 0; i < laboratory_operators().size(); ++i) rows.push_back({labs, i});
    return table("operators_scores", words.line("summary", "meshes"_a = listed(names_of(labs))), rows)
        .column("operator", [](auto& row) { return laboratory_operators()[row.index].title(); })
        .column("eigenvalues of −C below 0", {.digits = 6},
                [](auto& row) { return row.largest([](auto& t) { return t.scores.negative.below; }); })
        .column("weights < 0", {.unit = "%", .digits = 2}, [](auto& row) { return row.largest(negative_percent); })
        .column("λ_crit, least", {.unit = "× default"}, [](auto& row) { return row.smallest(&OperatorTrial::critical_ratio); })
        .column("λ_crit, most", {.unit = "× default"}, [](auto& row) { return row.largest(&OperatorTrial::critical_ratio); })
        .column("spectrum changes by", {.unit = "%"}, [](auto& row) { return row.largest([](auto& t) { return 100 * t.spectrum_shift; }); })
        .column("H changes by", {.unit = "%"}, [](auto& row) { return row.largest([](auto& t) { return 100 * t.H_change; }); });
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

void add_mesh_checks(report::Section& section, const LaboratoryMesh& lab) {
    const auto name = [&](const char* key) { return words.line(key, "mesh"_a = lab.name()); };
    double asymmetry = 0;
    for (const OperatorTrial& trial : lab.trials) asymmetry = std::max(asymmetry, trial.scores.asymmetry);
    add(section, check_at_most(name("check.asymmetry"), 0, asymmetry, 1e-14));
    for (const OperatorKind kind : {OperatorKind::cotan, OperatorKind::uniform, OperatorKind::cotan_no_half, OperatorKind::clamped,
                                    OperatorKind::edge_normalised, OperatorKind::idt, OperatorKind::tufted}) {
        const Inertia& negative = lab.trial(kind).scores.negative;
        const report::Check check = check_near(
            words.line("check.semidefinite", "operator"_a = operator_entry(kind).name, "mesh"_a = lab.name()), 0, negative.below, 0);
        const bool decided = semidefinite(negative) != Proof::undecided;
        add(section, decided ? check : undecided(check, cannot_be_proved(negative.delta, -negative.sigma)));
    }
    const OperatorScores& tufted = lab.trial(OperatorKind::tufted).scores;
    add(section, check_near(name("check.tufted"), 0, tufted.negative_inside + tufted.negative_boundary, 0));
    const auto if_defined = [](report::Check check) {
        return std::isnan(check.measured) ? undecided(std::move(check), words.line("check.without_mass")) : check;
    };
    const auto critical_ratio = [&](OperatorKind kind) { return lab.trial(kind).critical_ratio; };
    add(section, if_defined(check_near(name("check.without_half"), 0.5, critical_ratio(OperatorKind::cotan_no_half), 1e-9)));
    const report::Check rippa = if_defined(check_at_least(name("check.rippa"), 1, critical_ratio(OperatorKind::idt_original_mass), 1e-9));
    const int without_area = lab.subject.preflight().zero_area_faces;
    add(section, without_area > 0 && rippa.failed() ? undecided(rippa, words.line("check.without_area", "faces"_a = without_area)) : rippa);
    if (lab.oriented_manifold) add(section, check_near(name("check.delaunay"), 0, lab.trial(OperatorKind::idt).scores.negative_inside, 0));
}

}   // namespace

void add_method(report::Section& section) {
    add_words(section, words, "method");
    report::BulletList list;
    for (const OperatorEntry& entry : operator_list())
        list.items.push_back(report::text(report::code(std::string(entry.name)), ": ", std::string(entry.description)));
    add(section, std::move(list));
    Names others;
    for (const LaboratoryOperator& tried : laboratory_operators())
        if (tried.area != AreaForm::barycentric) others.push_back(quoted(tried.title()));
    add_words(section, words, "method.others", "others"_a = listed(others));
}

std::shared_ptr<const KnownTrials> add_known(report::Section& section, const QuestionSettings& settings) {
    auto shared = std::make_shared<const KnownTrials>(known_trials(settings));
    const KnownTrials& trials = *shared;
    add(section, known_table(trials));
    const auto plane_of = [&](OperatorKind kind) {
        return std::ranges::find(trials, kind, [](const KnownTrial& t) { return t.made_by.kind; })->plane;
    };
    const auto name = [](const char* key, OperatorKind kind) { return words.line(key, "operator"_a = operator_entry(kind).name); };
    for (const OperatorKind kind : {OperatorKind::cotan, OperatorKind::idt, OperatorKind::idt_original_mass})
        add(section, check_at_most(name("check.precise", kind), 0, plane_of(kind), 1e-10));
    for (const OperatorKind kind : {OperatorKind::clamped, OperatorKind::edge_normalised})
        add(section, check_at_least(name("check.lost", kind), 1e-3, plane_of(kind)));
    return shared;
}

std::shared_ptr<const Labs> add_scores(report::Section& section, const LibraryMeshes& meshes, const QuestionSettings& settings,
                                       const Progress& progress) {
    auto labs = std::make_shared<const Labs>(studies_of(meshes, "operators", settings, progress, section, laboratory_mesh));
    add(section, summary_table(*labs));
    for (const LaboratoryMesh& lab : *labs) {
        add(section, score_table(lab));
        add_mesh_checks(section, lab);
    }
    const std::size_t operators = laboratory_operators().size();
    section.parameters["operators"] = operators;
    section.extent = words.line("extent", "operators"_a = operators, "meshes"_a = listed(names_of(*labs)));
    return labs;
}

const LaboratoryMesh& most_flipped(const Labs& labs) {
    const auto flips = [](const LaboratoryMesh& lab) { return double(lab.flips) / lab.subject.mesh().vertex_count(); };
    return *std::ranges::max_element(labs, {}, flips);
}

void add_figure_of(Answer& answer, const LaboratoryMesh& lab) {
    const CurvatureSubject& s = lab.subject;
    output::FigureRequest request{
        .id = id_of("operators", lab.name(), "h"),
        .title = words.line("figure.title"),
        .subtitle = words.line("figure.subtitle", "file"_a = s.source->input.file, "vertices"_a = s.mesh().vertex_count()),
        .layout = output::Layout::multiples};
    Names described;
    for (const OperatorTrial& t : lab.trials) {
        const std::string title = t.made_by.title();
        request.panels.push_back(panel_of(*s.source, id_of("operators", lab.name(), t.made_by.id()), title, s.mean_edge * t.H));
        described.push_back(std::isfinite(t.H_change)
                                ? words.line("figure.alt.operator", "operator"_a = title, "change"_a = readable_percent(t.H_change))
                                : title);
    }
    const auto range = output::robust_range({request.panels.front()}, "diverging", "H × mean edge", "", 0.01, 0.03);
    request.range = range_for(range, request.panels);
    add_figure(
        answer, std::move(request),
        words.line("figure.caption", "mesh"_a = lab.name(), "mean_edge"_a = readable(s.mean_edge), "undefined"_a = undefined_words(s)),
        words.line("figure.alt", "mesh"_a = lab.name(), "operators"_a = joined(described)));
}

}   // namespace meshfolio::operators
