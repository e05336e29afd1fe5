// Question 4: meshes rebuilt from the k smoothest eigenvectors of the cotangent Laplace–Beltrami operator.
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q4")};
    report::Section& section = answer.section;
    const auto meshes = meshes_for(library, settings, section);
    const auto subjects = spectral_subjects(meshes, settings, progress, section);
    const report::Facts first = facts_of(*subjects, 0);
    section.answer = words.say("answer", first);
    for (const char* key : {"lead", "method", "solvers"}) add_words(section, words, key, first);
    add_words(section, words, "results");
    add_results(answer, *subjects);
    begin_appendix(section);
    add_further_figures(answer, *subjects);
    add_record(answer, *subjects);
    return answer;
}

extern const Chapter chapter{
    .id = "q4",
    .code = {{"smallest_eigenpairs", "src/geometry/spectrum/laplace_spectrum.cpp"},
             {"certify_spectrum", "src/geometry/spectrum/spectrum_certificate.cpp"},
             {"reconstruct", "src/geometry/spectrum/spectral_reconstruction.cpp"},
             {"reconstruction_rms", "src/geometry/spectrum/spectral_reconstruction.cpp"},
             {"local_thickness", "src/geometry/measures/local_thickness.cpp"},
             {"answer", "src/questions/q4_spectral/chapter.cpp"}},
    .roles = {"armadillo"},
    .cost = {.cpu = {{1.8, 22, 10}, {0.3, 7.6}},
             .memory = {{42, 1000, 230}, {6, 430}},
             .lengths = &QuestionSettings::k,
             .length = {300, 60}},
    .answer = answer,
    .lab = &lab,
};

}   // namespace meshfolio::q4_spectral
