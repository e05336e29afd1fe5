// The section "modes": what a filter does to shape and to noise, one eigenmode at a time, and how far that is known beforehand.
#include "questions/modes/parts.h"

namespace meshfolio::modes {

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("modes")};
    report::Section& section = answer.section;
    const bool all = settings.laboratory && settings.meshes.empty() && !library.has_own_meshes();
    using Roles = std::vector<std::string_view>;   // noise is added to clean meshes only
    const Roles of_shape = all              ? Roles{"cube", "armadillo", "plane_ns", "fandisk_ns"}
                           : settings.quick ? Roles{"cube"}
                                            : Roles{"cube", "plane_ns"};
    const Roles of_noise = all ? Roles{"cube", "armadillo", "lilium", "torus"} : settings.quick ? Roles{"cube"} : Roles{"cube", "lilium"};
    const LibraryMeshes shape_meshes = meshes_for(library, settings, of_shape, section),
                        noise_meshes = meshes_for(library, settings, of_noise, section);
    const auto shapes = mode_studies(shape_meshes, settings, progress, section);
    const auto noisy = prediction_studies(noise_meshes, settings, progress, section);
    const report::Facts shape = shape_facts(*shapes), noise = noise_facts(*noisy);
    report::Facts facts = shape;
    facts.insert(facts.end(), noise.begin(), noise.end());

    add_words(section, words, "method");
    add_words(section, words, "shape", shape);
    add(section, damping_plot(*shapes));
    add_words(section, words, "noise", noise);
    add(section, expected_plot(*noisy), expected_table(*noisy));
    add_words(section, words, "own_operator", noise);
    add(section, own_operator_plot(*noisy), own_operator_table(*noisy), why_table(*noisy));
    add_words(section, words, "stopping", noise);
    add(section, rule_table(*noisy));

    add_shape_checks(section, *shapes);
    add_noise_checks(section, *noisy);
    section.answer = words.say("answer", facts);
    add_record(section, *shapes, *noisy, settings);
    return answer;
}

extern const Chapter chapter{
    .id = "modes",
    .code = {{"mode_study", "src/questions/modes/mode_study.cpp"},
             {"denoising_prediction", "src/geometry/denoising/denoising_prediction.cpp"},
             {"noise_level", "src/geometry/denoising/noise_level.cpp"},
             {"risk_estimate", "src/geometry/denoising/risk_estimate.cpp"},
             {"prediction_study", "src/questions/modes/prediction_study.cpp"},
             {"answer", "src/questions/modes/chapter.cpp"}},
    .roles = {"cube", "plane_ns", "lilium", "armadillo", "fandisk_ns", "torus"},
    .planned_roles = 3,
    .cost = {.cpu = {{0.2, 32, 40}, {0.15, 14}}, .memory = {{12, 400}, {3, 230}}},
    .answer = answer,
};

}   // namespace meshfolio::modes
