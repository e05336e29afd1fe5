// The denoising laboratory: kinds of noise, levels and methods against each other, each method at its best within the same budget.
#include "questions/methods/parts.h"

namespace meshfolio::methods {

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("methods")};
    report::Section& section = answer.section;
    const auto laboratory = denoising_laboratory(library, settings, progress, section);
    add_method(section, *laboratory);
    add_words(section, words, "results");
    add(section, subject_table(*laboratory), winner_table(*laboratory), gain_table(*laboratory));
    add_gain_plot(section, *laboratory);
    add_method_figure(answer, *laboratory, settings.laboratory);
    add_words(section, words, "discussion", facts_of(*laboratory));
    add_checks(section, *laboratory);
    section.answer = answer_of(*laboratory);
    add_record(section, *laboratory, settings);
    return answer;
}

extern const Chapter chapter{
    .id = "methods",
    .code = {{"with_noise", "src/mesh/vertex_noise.cpp"},
             {"denoise", "src/geometry/denoising/denoising_methods.cpp"},
             {"filtered_normals", "src/geometry/denoising/normal_filters.cpp"},
             {"conformalised", "src/geometry/denoising/denoising_methods.cpp"},
             {"with_volumes", "src/geometry/denoising/component_size.cpp"},
             {"search", "src/questions/bench/denoising_search.cpp"},
             {"answer", "src/questions/methods/chapter.cpp"}},
    .roles = {"cube", "armadillo", "plane", "fandisk_ns", "lilium"},
    .planned_roles = 2,
    .cost = {.cpu = {{0.9, 0.2}, {0.05, 0.2}}, .memory = {{7, 25}, {4, 5}}},
    .answer = answer,
};

}   // namespace meshfolio::methods
