// The section "reproductions": the experiments of four earlier reports, done again with their own parameters.
#include "questions/reproductions/parts.h"

namespace meshfolio::reproductions {

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("reproductions")};
    add_words(answer.section, words, "method", "own"_a = settings.own_experiments);
    add_reproductions(answer, library, settings, progress);
    return answer;
}

extern const Chapter chapter{
    .id = "reproductions",
    .code = {{"read_experiments", "src/run/settings/experiment_reader.cpp"},
             {"experiment_meshes", "src/questions/reproductions/study.cpp"},
             {"smoothing_experiment", "src/questions/reproductions/study.cpp"},
             {"noisy_experiment", "src/questions/reproductions/study.cpp"},
             {"curvature_experiment", "src/questions/reproductions/field_study.cpp"},
             {"reconstruction_experiment", "src/questions/reproductions/field_study.cpp"},
             {"answer", "src/questions/reproductions/chapter.cpp"}},
    .roles = {"armadillo"},
    .cost = {.cpu = {{0.8, 40}, {0.2, 22}}, .memory = {{36, 125}, {10, 75}}},
    .answer = answer,
    .on_request = true,
};

}   // namespace meshfolio::reproductions
