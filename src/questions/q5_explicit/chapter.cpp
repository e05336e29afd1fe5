// Question 5: explicit Laplacian smoothing, the step it allows, and what a larger one does.
#include "questions/q5_explicit/parts.h"

namespace meshfolio::q5_explicit {

namespace {

/// What triangles without area would do to the limit, on the meshes that have some.
void add_faces_without_area(report::Section& section, const Studies& studies) {
    for (const ExplicitStudy& study : studies) {
        if (!(study.subject.critical_floored > 0)) continue;
        add_words(section, words, "without_area", "triangles"_a = study.subject.preflight().zero_area_faces, "mesh"_a = study.name(),
                  "critical"_a = readable(study.subject.critical, 4), "floored"_a = readable(study.subject.critical_floored, 4));
    }
}

void add_checks(report::Section& section, const ExplicitStudy& study) {
    const SmoothingSubject& subject = study.subject;
    const report::Fact mesh = "mesh"_a = subject.name();
    add(section, check_at_least(words.line("check.bound", mesh), subject.top.value, subject.top.upper_bound, 1e-9 * subject.top.value));
    const report::Check semidefinite =
        check_at_least(words.line("check.semidefinite", mesh), 0, subject.bottom.mu_low / subject.top.value, 1e-10);
    add(section, subject.bottom.semidefinite() || subject.bottom.indefinite()
                     ? semidefinite
                     : undecided(semidefinite, words.line("check.semidefinite.undecided")));
    for (std::size_t i = 0; i < study.runs.size(); ++i) {
        const SmoothingRun& run = study.runs[i];
        const report::Fact limits = "limits"_a = in_limits(subject, run.lambda);
        if (run.lambda > 0.9 * subject.critical) {
            const Amplification& a = study.amplification[i];
            add(section, check_near(words.line("check.top_mode", limits, mesh), 1, a.measured / a.predicted, 1e-4));
        }
        if (!study.stable(i)) continue;
        add(section, energy_check(words.line("check.energy", limits, mesh), run),
            check_at_most(words.line("check.barycentre", limits, mesh), 0, barycentre_drift(subject, run.result.X), 1e-10));
    }
}

void add_record(report::Section& section, const Studies& studies) {
    for (const ExplicitStudy& study : studies)
        section.parameters[words.line("parameter.critical", "mesh"_a = study.name())] = {plain_text(study.subject.critical, 6),
                                                                                         study.subject.critical, "length²"};
    section.parameters["iterations"] = studies.front().runs.front().iterations;
    section.parameters["operator"] = smoothing_words.line("parameter.operator");
    section.extent = words.line("extent", "meshes"_a = listed(names_of(studies)));
}

void add_appendix(Answer& answer, const Studies& studies) {
    report::Section& section = answer.section;
    begin_appendix(section);
    add(section, bounds_table(studies));
    add_faces_without_area(section, studies);
    for (const ExplicitStudy& study : studies) {
        if (&study != &telling(studies)) add_frames_figure(answer, study, studies);
        add(section, energy_plot(study), sweep_table(study));
    }
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q5")};
    report::Section& section = answer.section;
    const auto meshes = meshes_for(library, settings, {"cube", "plane_ns", "fandisk_ns"}, section);
    const auto studies = studies_of(meshes, "explicit smoothing", settings, progress, section, explicit_study);
    section.answer = answer_in_short(studies);
    add_paragraphs(section, {lead(studies)});
    add_words(section, words, "method");
    add(section, damping_plot());
    add_words(section, words, "results");
    add_paragraphs(section, {how_large(studies)});
    add(section, limit_table(studies));
    add_paragraphs(section, {which_step(studies), too_large(studies)});
    add_frames_figure(answer, telling(studies), studies);
    add(section, steps_table(studies));
    add_paragraphs(section, {when_to_stop(studies)});
    add_recommended_figure(answer, studies);
    add_paragraphs(section, {units_of_lambda(studies)});
    for (const ExplicitStudy& study : studies) add_checks(section, study);
    add_appendix(answer, studies);
    add_record(section, studies);
    return answer;
}

extern const Chapter chapter{
    .id = "q5",
    .code = {{"smooth", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"explicit_step", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"ExplicitRows", "src/geometry/smoothing/diffusion_kernels.cpp"},
             {"largest_eigenvalue", "src/geometry/spectrum/stability.cpp"},
             {"answer", "src/questions/q5_explicit/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q5_explicit
