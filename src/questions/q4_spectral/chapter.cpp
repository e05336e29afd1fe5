// Question 4: meshes rebuilt from the k smoothest eigenvectors of the cotangent Laplace–Beltrami operator.
#include "geometry/measures/mesh_facts.h"
#include "questions/bench/law_checks.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

namespace {

void add_checks(report::Section& section, const SpectralStudy& study) {
    const auto of_diagonal = [&](const char* key, double length, double tolerance = 1e-9) {
        add(section, report::within_rounding(check_at_most(words.line(key, "mesh"_a = study.name()), 0, length / study.diagonal, tolerance),
                                             coordinate_spacing(study.mesh()) / study.diagonal));
    };
    const int needles = study.preflight().needle_faces + study.preflight().zero_area_faces;
    append_checks(section, spectrum_checks(study.certificate, " on " + study.name(),
                                           needles > 0 ? words.line("check.needles", "faces"_a = needles) : ""));
    of_diagonal("check.parseval", largest_parseval_gap(study));
    of_diagonal("check.no_rise", largest_rise(study.rms), 1e-12);
    if (study.modes() == study.vertices()) of_diagonal("check.all_modes", study.reconstructions.back().difference.max);
}

/// Adds the rebuilt meshes, and the parameters, timings and extent of the section.
void add_record(Answer& answer, const Subjects& subjects) {
    report::Section& section = answer.section;
    Names done;
    for (const Subject& subject : subjects) {
        const SpectralStudy& study = subject.study;
        Names counts;
        std::vector<int> numbers;
        for (const Reconstruction& r : study.reconstructions) {
            numbers.push_back(r.k);
            counts.push_back(std::to_string(r.k));
            const std::string file = id_of(study, "k" + counts.back()) + ".ply";
            answer.meshes.push_back({file, std::make_shared<const TriangleMesh>(r.mesh)});
            section.output_meshes.push_back("meshes/" + file);
        }
        done.push_back(words.line("extent.mesh", "mesh"_a = study.name(), "counts"_a = listed(counts)));
        section.parameters["k on " + study.name()] = {listed(counts), numbers};
        section.parameters["solver on " + study.name()] = study.spectrum.dense ? "dense" : "shift-invert Lanczos";
        section.timings.push_back({"eigenpairs of " + study.name(), study.seconds});
    }
    section.parameters["area form"] = "barycentric";
    section.extent = words.line("extent", "meshes"_a = listed(done),
                                "iterated"_a = std::ranges::any_of(subjects, [](const Subject& s) { return !s.study.spectrum.dense; }));
}

/// Adds the results on one mesh, each figure and table after the paragraph that explains it.
void add_results(Answer& answer, const Subject& subject, const report::Facts& facts) {
    report::Section& section = answer.section;
    const SpectralStudy& study = subject.study;
    add_words(section, words, "pictures", facts);
    add_reconstruction_figure(answer, study);
    add_words(section, words, "better", facts);
    add(section, error_table(subject), error_plot(study));
    for (const char* key : {"rate", "modes"}) add_words(section, words, key, facts);
    add_eigenfunction_figure(answer, study);
    if (study.modes() > zero_modes(study) + 1) add(section, spectrum_plot(study));
    add_words(section, words, "thin", facts);
    if (subject.limbs.measured()) add(section, limb_table(study, subject.limbs));
    add_words(section, words, "large", facts);
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q4")};
    report::Section& section = answer.section;
    const auto meshes = meshes_for(library, settings, section);
    const Subjects subjects = studies_of(meshes, "eigenpairs", settings, progress, section, subject_of);
    const report::Facts first = facts_of(subjects, 0);
    section.answer = words.say("answer", first);
    for (const char* key : {"lead", "method", "solvers"}) add_words(section, words, key, first);
    add_words(section, words, "results");
    for (std::size_t i = 0; i < subjects.size(); ++i) {
        add_results(answer, subjects[i], facts_of(subjects, i));
        add_checks(section, subjects[i].study);
    }
    begin_appendix(section);
    for (const Subject& subject : subjects) add_further_figure(answer, subject.study);
    add_record(answer, subjects);
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
