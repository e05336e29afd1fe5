// The section "stability": its blocks in their order.
#include "questions/stability/parts.h"

namespace meshfolio::stability {

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("stability")};
    report::Section& section = answer.section;
    const auto meshes = meshes_for(library, settings, section);
    const auto studies = limit_studies(meshes, settings, progress, section);
    const auto flow = rebuilt_flow(*studies, settings, progress);
    const auto planes = plane_studies(*studies, settings, progress, section);
    const report::Facts facts = facts_of(*studies, *flow, *planes);
    section.answer = words.say("answer", facts);

    add_words(section, words, "method");
    add_words(section, words, "limit", facts);
    add(section, certificate_table(*studies), unit_table(*studies));
    add_top_mode_figure(answer, *studies);
    add(section, growth_plot(*studies));
    add_words(section, words, "rebuilt", facts);
    add(section, flow_table(*flow), flow_plot(*flow));
    add_words(section, words, "planes", facts);
    add_error_maps(section, *planes);
    add_place_figure(answer, *planes);
    add(section, region_table(*planes), blow_up_table(*planes));
    add_checks(section, *studies, *flow, *planes);
    add_record(section, *studies, *planes);
    return answer;
}

extern const Chapter chapter{
    .id = "stability",
    .code = {{"stability_certificate", "src/geometry/smoothing/stability_certificate.cpp"},
             {"definiteness", "src/geometry/spectrum/definiteness.cpp"},
             {"enclose_largest", "src/geometry/spectrum/eigenvalue_enclosure.cpp"},
             {"largest_eigenvalue", "src/geometry/spectrum/stability.cpp"},
             {"mode_growth", "src/geometry/smoothing/mode_growth.cpp"},
             {"LimitWatch", "src/geometry/smoothing/limit_watch.h"},
             {"smoothing_maps", "src/questions/stability/planes.cpp"},
             {"growing_modes", "src/questions/stability/planes.cpp"},
             {"ImplicitSolver::prepare", "src/geometry/smoothing/implicit_solver.cpp"},
             {"answer", "src/questions/stability/chapter.cpp"}},
    .roles = {"cube", "plane_ns", "fandisk_ns", "armadillo"},
    .cost = {.cpu = {{0.2, 22, 75}, {0.17, 10, 45}}, .memory = {{18, 350}, {3, 175}}},
    .answer = answer,
};

}   // namespace meshfolio::stability
