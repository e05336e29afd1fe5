// Question 5: explicit Laplacian smoothing, the step it allows, and what a larger one does.
#include "questions/q5_explicit/parts.h"

namespace meshfolio::q5_explicit {

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q5")};
    report::Section& section = answer.section;
    const auto meshes = meshes_for(library, settings, section);
    const auto studies = explicit_studies(meshes, settings, progress, section);
    const report::Facts facts = facts_of(*studies);
    section.answer = words.say("answer", facts);
    add_words(section, words, "method");
    add(section, wave_diagram());
    add_words(section, words, "method.limit");
    add(section, damping_plot());
    add_words(section, words, "limit", facts);
    add(section, limit_table(*studies));
    add_words(section, words, "step", facts);
    add(section, energy_plot(*studies));
    add_words(section, words, "beyond", facts);
    add_frames_figure(answer, *studies);
    add_words(section, words, "stop", facts);
    add_recommended_figure(answer, *studies);
    add_checks(section, *studies);
    begin_appendix(section);
    add_words(section, words, "units", facts);
    add_appendix(section, *studies);
    add_record(section, *studies);
    return answer;
}

extern const Chapter chapter{
    .id = "q5",
    .code = {{"smooth", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"explicit_step", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"explicit_rows", "src/geometry/smoothing/diffusion_step.cpp"},
             {"largest_eigenvalue", "src/geometry/spectrum/stability.cpp"},
             {"answer", "src/questions/q5_explicit/chapter.cpp"}},
    .roles = {"cube", "plane_ns", "fandisk_ns"},
    .cost = {.cpu = {{0.3, 24, 0}, {0.05, 17.8}},
             .memory = {{13, 250}, {6, 180}},
             .lengths = &QuestionSettings::iterations,
             .length = {50, 20}},
    .answer = answer,
    .lab = &lab,
    .batch = {{"lambda_critical", "limits-lambda-crit"}},
};

}   // namespace meshfolio::q5_explicit
