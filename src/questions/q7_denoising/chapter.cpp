// Question 7: what Laplacian smoothing can do against noise, measured against the clean mesh.
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q7")};
    report::Section& section = answer.section;
    const auto meshes = meshes_for(library, settings, section);
    const auto grids = denoising_grids(meshes, settings, progress, section);
    const auto reasons = shared_reasons(*grids);
    const report::Facts facts = facts_of(*grids, *reasons);
    section.answer = words.say("answer", facts);
    // Our own clean mesh stands for fandisk, as the coursework has none.
    const bool own = std::ranges::any_of(
        meshes, [](const SharedMesh& mesh) { return mesh->input.role == "fandisk" && mesh->input.file == "fandisk_like.obj"; });
    add_words(section, words, "method", "seed"_a = settings.seed, "own"_a = own);

    add_words(section, words, "discussion.why", facts);
    add_reason_plots(section, *reasons);
    add_words(section, words, "discussion.when", facts);
    add(section, result_table(*grids));
    add_states(answer, *grids);
    add_views(answer, *grids);
    add_words(section, words, "discussion.cost", facts);
    add_losses(answer, *grids);

    begin_appendix(section);
    add_words(section, words, "discussion.further", facts);
    add(section, measure_table(*grids), gain_map(grid_with_largest_gain(*grids)), remains_table(*grids));
    add_checks(section, *grids);

    add_record(section, *grids, settings);
    return answer;
}

extern const Chapter chapter{
    .id = "q7",
    .code = {{"with_gaussian_noise", "src/mesh/vertex_noise.cpp"},
             {"smooth", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"search", "src/questions/bench/denoising_search.cpp"},
             {"shape_rms", "src/geometry/measures/mesh_error.cpp"},
             {"answer", "src/questions/q7_denoising/chapter.cpp"}},
    .roles = {"cube", "fandisk", "armadillo"},
    .cost = {.cpu = {{0.2, 50, 20}, {0.3, 9, 8.5}},
             .memory = {{14, 250}, {10, 250}},
             .lengths = &QuestionSettings::iterations,
             .length = {32, 16},
             .runs = {20, 6}},
    .answer = answer,
    .lab = &lab,
};

}   // namespace meshfolio::q7_denoising
