// The operator laboratory: what each way of building the Laplacian keeps and what it gives up.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/measures/mesh_laws.h"
#include "questions/bench/law_checks.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/operators/parts.h"

namespace meshfolio::operators {

namespace {

using report::check_at_least;
using report::check_at_most;
using report::check_near;
using report::math;
using report::ref;

// ---- tables -----------------------------------------------------------------------------------------------------------

/// Whether −C is proved semidefinite, else how far below 0 its spectrum goes or may go.
std::string stability_word(const OperatorScores& scores) {
    if (std::isnan(scores.lowest)) return "–";
    switch (scores.verdict) {
        case Definiteness::Verdict::semidefinite:
            return "stable";
        case Definiteness::Verdict::indefinite:
            return "none is stable: μ_min/μ_max " + readable(scores.lowest, 2);
        case Definiteness::Verdict::undecided:
            break;
    }
    return "cannot be told: μ_min/μ_max ≥ " + readable(scores.lowest, 2);
}

void add_mesh_table(report::Section& section, const LaboratoryMesh& lab) {
    report::Table table;
    table.id = id_of("operators", lab.name(), "scores");
    table.caption =
        "Operators on " + lab.name() + " (" + counted(lab.subject.mesh().vertex_count(), "vertex", "vertices") + "; " +
        counted(lab.flips, "flip") +
        " to intrinsic Delaunay). Asymmetry: max |C − Cᵀ| over max |C|. Negative weights are counted among the pairs of vertices that "
        "share an entry of C; changes "
        "are relative to the cotangent operator with barycentric areas, those of the spectrum the largest among the first ten "
        "eigenvalues above 0. λ_crit is 2/μ_max; where −C is proved indefinite no step is stable, "
        "and μ_min/μ_max says how far. λ_crit of the uniform operator has no unit, and its spectrum is scaled to fit. –: not defined.";
    table.columns = {{"operator", ""},
                     {"asymmetry of C", "", 2},
                     {"eigenvalues of −C below 0", "", 6},
                     {"weights < 0 inside", "", 6},
                     {"weights < 0 on the boundary", "", 6},
                     {"smallest weight", "", 3},
                     {"steps up to λ_crit"},
                     {"λ_crit", "length²", 4},
                     {"λ_crit, × default", "", 3},
                     {"spectrum changes by", "%", 3},
                     {"H changes by", "%", 3}};
    for (std::size_t i = 0; i < lab.trials.size(); ++i) {
        const OperatorTrial& t = lab.trials[i];
        table.rows.push_back({laboratory_operators()[i].title(), t.scores.asymmetry, double(t.scores.negative.below),
                              double(t.scores.negative_inside), double(t.scores.negative_boundary), t.scores.smallest_weight,
                              stability_word(t.scores), cell_of(t.scores.critical), cell_of(t.critical_ratio),
                              cell_of(100 * t.spectrum_shift), cell_of(100 * t.H_change)});
    }
    section.blocks.push_back(std::move(table));
}

void add_known_table(report::Section& section, const std::vector<KnownTrial>& trials) {
    report::Table table;
    table.id = "operators_known";
    table.caption =
        "Operators where the truth is known: the largest |H| × mean edge inside a flat square whose inner vertices were moved within it "
        "(0 is linear precision), the relative L2 error of H on a jittered sphere and a jittered ellipsoid, and the largest relative error "
        "of the first eight eigenvalues above 0 of that sphere.";
    table.columns = {{"operator", ""},
                     {"H of the flat square", "1 / mean edge", 2, report::Column::Best::smallest},
                     {"H of the sphere off by", "%", 3, report::Column::Best::smallest},
                     {"H of the ellipsoid off by", "%", 3, report::Column::Best::smallest},
                     {"eigenvalues off by", "%", 3, report::Column::Best::smallest}};
    for (std::size_t i = 0; i < trials.size(); ++i) {
        const KnownTrial& t = trials[i];
        table.rows.push_back({laboratory_operators()[i].title(), cell_of(t.plane), cell_of(100 * t.H_error[0]), cell_of(100 * t.H_error[1]),
                              cell_of(100 * t.eigenvalue_error)});
    }
    section.blocks.push_back(std::move(table));
}

void add_operator_list(report::Section& section) {
    report::BulletList list;
    for (const OperatorEntry& entry : operator_list())
        list.items.push_back(report::text(report::code(std::string(entry.name)), ": ", std::string(entry.description)));
    section.blocks.push_back(std::move(list));
    std::vector<std::string> other_areas;
    for (const LaboratoryOperator& tried : laboratory_operators()) {
        if (tried.area != AreaForm::barycentric) other_areas.push_back("“" + tried.title() + "”");
    }
    add_paragraph(section, "The laboratory tries the default, which has barycentric areas, with others as well: ", listed(other_areas),
                  ".");
}

// ---- the figure -------------------------------------------------------------------------------------------------------

/// One small picture an operator, all in the colours that suit the default.
void add_figure_of(Answer& answer, const LaboratoryMesh& lab) {
    const CurvatureSubject& s = lab.subject;
    output::FigureRequest request;
    request.id = id_of("operators", lab.name(), "h");
    request.title = "Mean curvature × mean edge by every operator";
    request.subtitle = s.source->input.file + ", " + counted(s.mesh().vertex_count(), "vertex", "vertices");
    request.three_quarter = true;
    for (std::size_t i = 0; i < lab.trials.size(); ++i) {
        const LaboratoryOperator& laboratory_operator = laboratory_operators()[i];
        request.panels.push_back({id_of("operators", lab.name(), laboratory_operator.id()), laboratory_operator.title(),
                                  std::shared_ptr<const TriangleMesh>(s.source->prepared, &s.mesh()), s.mean_edge * lab.trials[i].H});
    }
    request.range = output::robust_range({request.panels.front()}, "diverging", "H × mean edge", "", 0.01, 0.03);
    request.range = range_for(*request.range, request.panels);
    const std::string caption = "Mean curvature of " + lab.name() + " times its mean edge length (" + readable(s.mean_edge) +
                                ") by every operator, in one view and one colour range, that of the cotangent operator with barycentric "
                                "areas." +
                                undefined_words(s);
    std::string alt = "Small pictures of " + lab.name() + " coloured by mean curvature:";
    for (std::size_t i = 0; i < lab.trials.size(); ++i) {
        const double change = lab.trials[i].H_change;
        alt += (i > 0 ? "; " : " ") + laboratory_operators()[i].title();
        if (std::isfinite(change)) alt += ", " + readable_percent(change) + " off the first";
    }
    answer.section.blocks.push_back(report::Figure{request.id, caption, alt + "."});
    answer.figures.push_back(std::move(request));
}

// ---- checks -----------------------------------------------------------------------------------------------------------

void add_mesh_checks(report::Section& section, const LaboratoryMesh& lab) {
    const std::string on = " on " + lab.name();
    double asymmetry = 0;
    for (const OperatorTrial& trial : lab.trials) asymmetry = std::max(asymmetry, trial.scores.asymmetry);
    section.checks.push_back(check_at_most("largest |C − Cᵀ| of all operators over the largest |C|" + on, 0, asymmetry, 1e-14));
    for (const OperatorKind kind : {OperatorKind::cotan, OperatorKind::uniform, OperatorKind::cotan_no_half, OperatorKind::clamped,
                                    OperatorKind::edge_normalised, OperatorKind::idt, OperatorKind::tufted}) {
        const Inertia& negative = lab.trial(kind).scores.negative;
        const report::Check check =
            check_near("eigenvalues of −C below 0, " + std::string(operator_entry(kind).name) + on, 0, negative.below, 0);
        const bool decided = semidefinite(negative) != Proof::undecided;
        section.checks.push_back(decided ? check : report::undecided(check, cannot_be_proved(negative.delta, -negative.sigma)));
    }
    const OperatorScores& tufted = lab.trial(OperatorKind::tufted).scores;
    section.checks.push_back(
        check_near("negative weights of the tufted operator" + on, 0, tufted.negative_inside + tufted.negative_boundary, 0));
    const OperatorTrial& doubled = lab.trial(OperatorKind::cotan_no_half);
    const auto if_defined = [](report::Check check) {
        return std::isnan(check.measured) ? report::undecided(std::move(check), "vertices without mass leave no λ_crit") : check;
    };
    section.checks.push_back(if_defined(check_near("λ_crit without the ½ / λ_crit" + on, 0.5, doubled.critical_ratio, 1e-9)));
    section.checks.push_back(if_defined(check_at_least("λ_crit of the intrinsic Delaunay C with the mesh's own areas / λ_crit (Rippa)" + on,
                                                       1, lab.trial(OperatorKind::idt_original_mass).critical_ratio, 1e-9)));
    if (!lab.oriented_manifold) return;
    section.checks.push_back(check_near("negative weights of the intrinsic Delaunay operator inside" + on, 0,
                                        lab.trial(OperatorKind::idt).scores.negative_inside, 0));
}

void add_known_checks(report::Section& section, const std::vector<KnownTrial>& trials) {
    const auto plane_of = [&](OperatorKind kind) {
        for (std::size_t i = 0; i < trials.size(); ++i) {
            if (laboratory_operators()[i].kind == kind) return trials[i].plane;
        }
        return std::nan("");
    };
    for (const OperatorKind kind : {OperatorKind::cotan, OperatorKind::idt, OperatorKind::idt_original_mass}) {
        section.checks.push_back(
            check_at_most("H × mean edge of the flat square, " + std::string(operator_entry(kind).name), 0, plane_of(kind), 1e-10));
    }
    for (const OperatorKind kind : {OperatorKind::clamped, OperatorKind::edge_normalised}) {
        section.checks.push_back(
            check_at_least("H × mean edge of the flat square is lost, " + std::string(operator_entry(kind).name), 1e-3, plane_of(kind)));
    }
}

// ---- the section ------------------------------------------------------------------------------------------------------

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(
        section, "A discrete Laplacian is ", math("L = M⁻¹C"),
        ". No choice of weights has all properties of the smooth one at once, so each is scored on the same meshes: is C symmetric "
        "and ",
        math("−C"),
        " positive semidefinite (negative pivots of an LDLᵀ are counted), do linear functions on a plane give 0, are all "
        "weights ≥ 0 (then the maximum principle holds), how large a step is stable, and how far do spectrum and mean curvature "
        "move? The names are those that ",
        report::code("--operator"), " accepts:");
    add_operator_list(section);
    add_paragraph(
        section, "Intrinsic Delaunay flips ", ref("bobenko_springborn_2007"),
        " draw other straight edges over the same surface; the tufted cover ", ref("sharp_crane_2020"),
        " glues front and back of every triangle around each edge and flips there, so that boundaries and non-manifold edges need "
        "no exception.");
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
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("operators");
    const LibraryMeshes meshes = meshes_of(library, settings, section);
    add_method(section);

    add_heading(section, "Results");
    progress("operators where the truth is known");
    const std::vector<KnownTrial> known = known_trials(settings);
    add_known_table(section, known);
    add_known_checks(section, known);
    const auto labs = studies_of(meshes, "operators", settings, progress, section, laboratory_mesh);
    for (const LaboratoryMesh& lab : labs) {
        add_mesh_table(section, lab);
        add_mesh_checks(section, lab);
    }
    add_figure_of(answer, *std::max_element(labs.begin(), labs.end(), fewer_flips));
    add_discussion(section, labs, known);

    section.parameters["operators"] = std::to_string(laboratory_operators().size());
    section.extent = std::to_string(laboratory_operators().size()) + " operators scored on " + listed(names_of(labs)) +
                     " and on a plane, a sphere and an ellipsoid, where the truth is known";
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
