// The operator laboratory: what each discrete Laplacian keeps, and what it loses.
#include "questions/operators/parts.h"

namespace meshfolio::operators {

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("operators")};
    report::Section& section = answer.section;
    // For a quick look two meshes: one closed, one with a boundary.
    const LibraryMeshes meshes =
        settings.quick ? meshes_for(library, settings, {"armadillo", "lilium"}, section) : meshes_for(library, settings, section);
    add_method(section);

    add_words(section, words, "results");
    progress("operators where the truth is known");
    const auto known = add_known(section, settings);
    const auto labs = add_scores(section, meshes, settings, progress);
    const LaboratoryMesh& shown = most_flipped(*labs);
    add_figure_of(answer, shown);
    add_discussion(section, *labs, *known, shown);
    return answer;
}

extern const Chapter chapter{
    .id = "operators",
    .code = {{"laplace_operator", "src/geometry/operators/laplace_operator.cpp"},
             {"intrinsic_delaunay", "src/geometry/operators/intrinsic_delaunay.cpp"},
             {"tufted_cover", "src/geometry/operators/tufted_cover.cpp"},
             {"operator_scores", "src/geometry/measures/operator_scores.cpp"},
             {"answer", "src/questions/operators/chapter.cpp"}},
    .roles = {"armadillo", "lilium", "fandisk_ns"},
    .cost = {.cpu = {{0.45, 0, 34}, {0.2, 3.5}}, .memory = {{7, 180}, {4, 25}}},
    .answer = answer,
};

}   // namespace meshfolio::operators
