// Question 6: implicit (backward Euler) smoothing after Desbrun et al. 1999, eq. 9, beside the explicit method.
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

void add_checks(report::Section& section, const ImplicitStudy& study) {
    const report::Fact mesh = "mesh"_a = study.name();
    add(section, check_near(words.line("check.damping", "modes"_a = study.damped_modes, mesh), 1, 1 + study.worst_damping, 1e-6));
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        const report::Fact limits = "limits"_a = in_limits(study.subject, study.lambdas[l]);
        add(section, energy_check(words.line("check.energy", limits, mesh), study.implicit_runs[l]));
    }
    add(section, check_at_most(words.line("check.huge_step", mesh), 1, study.huge_step_energy, 0));
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q6")};
    report::Section& section = answer.section;
    const auto meshes = meshes_for(library, settings, {"cube", "plane_ns", "fandisk_ns"}, section);
    const auto studies = studies_of(meshes, "implicit smoothing", settings, progress, section, implicit_study);
    section.answer = answer_of(studies);
    add_paragraphs(section, {summary_of(studies)});
    add_words(section, words, {"method", "results"});
    const bool has_views = std::ranges::any_of(studies, [](const ImplicitStudy& study) { return study.good() != nullptr; });
    const output::ColorRange colours = colours_of(studies);
    const auto pictured = studies.begin() + std::min<std::size_t>(3, studies.size());
    add_paragraphs(section, {rule_of(studies)});
    if (report::Table costs = cost_table(studies); !costs.rows.empty()) add(section, std::move(costs));
    for (auto study = studies.begin(); study != studies.end(); ++study) {
        if (study < pictured) add_matrix(answer, *study, colours, !has_views);
        add_paragraphs(section, {reading_of(*study)});
    }
    add_views(answer, studies, colours);
    add_paragraphs(section, {comparison_of(studies), larger_steps_of(studies)});
    if (report::Table prices = price_table(studies); !prices.rows.empty()) add(section, std::move(prices));
    add_paragraphs(section, {price_of(studies), quality_of(studies), verdict_of(studies)});

    begin_appendix(section);
    if (report::Plot gaps = gap_plot(studies); !gaps.series.empty()) add(section, std::move(gaps));
    for (auto study = pictured; study != studies.end(); ++study) add_matrix(answer, *study, colours, !has_views);
    for (const ImplicitStudy& study : studies) {
        add(section, grid_table(study));
        add_checks(section, study);
    }

    const ImplicitStudy& last = studies.back();
    const Names times = each_of(last.iterations, [&](const int t) { return std::to_string(t); });
    section.parameters = {{"iterations", {listed(times), last.iterations}}, {"operator", smoothing_words.line("parameter.operator")}};
    section.extent =
        words.line("extent", "steps"_a = last.lambdas.size(), "counts"_a = listed(times), "meshes"_a = listed(names_of(studies)));
    return answer;
}

extern const Chapter chapter{
    .id = "q6",
    .code = {{"smooth", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"implicit_step", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"ImplicitSolver::prepare", "src/geometry/smoothing/implicit_solver.cpp"},
             {"answer", "src/questions/q6_implicit/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q6_implicit
