// Question 6: implicit (backward Euler) smoothing after Desbrun et al. 1999, eq. 9, beside the explicit method.
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q6")};
    report::Section& section = answer.section;
    const auto meshes = meshes_for(library, settings, section);
    const auto studies = implicit_studies(meshes, settings, progress, section);
    section.answer = words.say("answer", answer_facts(*studies));
    const report::Facts facts = discussion_facts(*studies);
    add_words(section, words, "method", facts);
    add_words(section, words, "results", facts);
    if (report::Table costs = cost_table(*studies); !costs.rows.empty()) add(section, std::move(costs));
    constexpr std::size_t pictured = 3;   // meshes; the appendix has the others
    add_pairs(answer, *studies, 0, pictured);
    add_words(section, words, "discussion", facts);
    if (report::Table prices = price_table(*studies); !prices.rows.empty()) add(section, std::move(prices));
    add_views(answer, *studies);
    add_gap_map(answer, *studies);

    begin_appendix(section);
    if (report::Plot gaps = gap_plot(*studies); !gaps.series.empty()) add(section, std::move(gaps));
    add_pairs(answer, *studies, pictured);
    add(section, grid_table(*studies));
    add_checks(section, *studies);
    add_record(section, *studies);
    return answer;
}

extern const Chapter chapter{
    .id = "q6",
    .code = {{"smooth", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"implicit_step", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"ImplicitSolver::prepare", "src/geometry/smoothing/implicit_solver.cpp"},
             {"answer", "src/questions/q6_implicit/chapter.cpp"}},
    .roles = {"cube", "plane_ns", "fandisk_ns"},
    .cost = {.cpu = {{0.05, 25, 30}, {0.2, 8, 14}},
             .memory = {{16, 300}, {6, 250}},
             .lengths = &QuestionSettings::iterations,
             .length = {100, 10},
             .runs = {3, 3}},
    .answer = answer,
    .lab = &lab,
};

}   // namespace meshfolio::q6_implicit
