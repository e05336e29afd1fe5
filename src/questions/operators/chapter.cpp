// The operator laboratory: what each way of building the Laplacian keeps and what it gives up.
#include "geometry/measures/mesh_laws.h"
#include "questions/bench/law_checks.h"
#include "questions/operators/parts.h"

namespace meshfolio::operators {

namespace {

void add_mesh_checks(report::Section& section, const LaboratoryMesh& lab) {
    const auto add_check = [&](report::Check check) { add(section, std::move(check)); };
    const auto name = [&](const char* key) { return words.line(key, "mesh"_a = lab.name()); };
    double asymmetry = 0;
    for (const OperatorTrial& trial : lab.trials) asymmetry = std::max(asymmetry, trial.scores.asymmetry);
    add_check(check_at_most(name("check.asymmetry"), 0, asymmetry, 1e-14));
    for (const OperatorKind kind : {OperatorKind::cotan, OperatorKind::uniform, OperatorKind::cotan_no_half, OperatorKind::clamped,
                                    OperatorKind::edge_normalised, OperatorKind::idt, OperatorKind::tufted}) {
        const Inertia& negative = lab.trial(kind).scores.negative;
        const report::Check check = check_near(
            words.line("check.semidefinite", "operator"_a = operator_entry(kind).name, "mesh"_a = lab.name()), 0, negative.below, 0);
        const bool decided = semidefinite(negative) != Proof::undecided;
        add_check(decided ? check : undecided(check, cannot_be_proved(negative.delta, -negative.sigma)));
    }
    const OperatorScores& tufted = lab.trial(OperatorKind::tufted).scores;
    add_check(check_near(name("check.tufted"), 0, tufted.negative_inside + tufted.negative_boundary, 0));
    const auto if_defined = [](report::Check check) {
        return std::isnan(check.measured) ? undecided(std::move(check), words.line("check.without_mass")) : check;
    };
    const auto critical_ratio = [&](OperatorKind kind) { return lab.trial(kind).critical_ratio; };
    add_check(if_defined(check_near(name("check.without_half"), 0.5, critical_ratio(OperatorKind::cotan_no_half), 1e-9)));
    const report::Check rippa = if_defined(check_at_least(name("check.rippa"), 1, critical_ratio(OperatorKind::idt_original_mass), 1e-9));
    const int without_area = lab.subject.preflight().zero_area_faces;
    add_check(without_area > 0 && rippa.failed() ? undecided(rippa, words.line("check.without_area", "faces"_a = without_area)) : rippa);
    if (lab.oriented_manifold) add_check(check_near(name("check.delaunay"), 0, lab.trial(OperatorKind::idt).scores.negative_inside, 0));
}

void add_known_checks(report::Section& section, const KnownTrials& trials) {
    const auto plane_of = [&](OperatorKind kind) {
        return std::ranges::find(trials, kind, [](const KnownTrial& t) { return t.made_by.kind; })->plane;
    };
    const auto name = [](const char* key, OperatorKind kind) { return words.line(key, "operator"_a = operator_entry(kind).name); };
    for (const OperatorKind kind : {OperatorKind::cotan, OperatorKind::idt, OperatorKind::idt_original_mass})
        add(section, check_at_most(name("check.precise", kind), 0, plane_of(kind), 1e-10));
    for (const OperatorKind kind : {OperatorKind::clamped, OperatorKind::edge_normalised})
        add(section, check_at_least(name("check.lost", kind), 1e-3, plane_of(kind)));
}

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

/// For each of its vertices: where operators differ most, pictures tell most.
bool fewer_flips(const LaboratoryMesh& a, const LaboratoryMesh& b) {
    return double(a.flips) * b.subject.mesh().vertex_count() < double(b.flips) * a.subject.mesh().vertex_count();
}

/// Two meshes for a quick look: one closed, one with a boundary.
LibraryMeshes meshes_of(const MeshLibrary& library, const QuestionSettings& settings, report::Section& section) {
    if (settings.quick) return meshes_for(library, settings, {"armadillo", "lilium"}, section);
    return meshes_for(library, settings, {"armadillo", "lilium", "fandisk_ns"}, section);
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("operators")};
    report::Section& section = answer.section;
    const LibraryMeshes meshes = meshes_of(library, settings, section);
    add_method(section);

    add_words(section, words, "results");
    progress("operators where the truth is known");
    const KnownTrials known = known_trials(settings);
    add(section, known_table(known));
    add_known_checks(section, known);
    const Labs labs = studies_of(meshes, "operators", settings, progress, section, laboratory_mesh);
    for (const LaboratoryMesh& lab : labs) {
        add(section, score_table(lab));
        add_mesh_checks(section, lab);
    }
    add_figure_of(answer, *std::ranges::max_element(labs, fewer_flips));
    add_discussion(section, labs, known);

    const std::size_t operators = laboratory_operators().size();
    section.parameters["operators"] = operators;
    section.extent = words.line("extent", "operators"_a = operators, "meshes"_a = listed(names_of(labs)));
    return answer;
}

extern const Chapter chapter{
    .id = "operators",
    .code = {{"laplace_operator", "src/geometry/operators/laplace_operator.cpp"},
             {"intrinsic_delaunay", "src/geometry/operators/intrinsic_delaunay.cpp"},
             {"tufted_cover", "src/geometry/operators/tufted_cover.cpp"},
             {"operator_scores", "src/geometry/measures/operator_scores.cpp"},
             {"answer", "src/questions/operators/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::operators
