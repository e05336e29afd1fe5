// Question 6: implicit (backward Euler) smoothing after Desbrun et al. 1999, eq. 9, beside the explicit method.
#include "questions/core/chapter.h"
#include "base/number_text.h"
#include "questions/core/study_list.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

using report::check_at_most;
using report::check_near;

void add_checks(report::Section& section, const ImplicitStudy& study) {
    const report::Fact mesh = "mesh"_a = study.name();
    section.checks.push_back(
        check_near(words.line("check.damping", "modes"_a = study.damped_modes, mesh), 1, 1 + study.worst_damping, 1e-6));
    for (std::size_t l = 0; l < study.lambdas.size(); ++l) {
        const report::Fact limits = "limits"_a = in_limits(study.subject, study.lambdas[l]);
        section.checks.push_back(energy_check(words.line("check.energy", limits, mesh), study.implicit_runs[l]));
    }
    section.checks.push_back(check_at_most(words.line("check.huge_step", mesh), 1, study.huge_step_energy, 0));
}

void add_timings(report::Section& section, const ImplicitStudy& study) {
    const report::Fact mesh = "mesh"_a = study.name();
    section.timings.push_back({words.line("timing.implicit", mesh), study.cost.implicit_seconds});
    if (study.cost.reached()) section.timings.push_back({words.line("timing.explicit", mesh), study.cost.explicit_seconds});
}

report::Finding finding(const ImplicitStudy& study) {
    return {words.say("finding", "mesh"_a = study.name(), "limits"_a = in_limits(study.subject, study.lambdas.back()),
                      "deviation"_a = readable(study.worst_damping, 1)),
            70};
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("q6");
    const auto meshes = meshes_for(library, settings, {"cube", "plane_ns", "fandisk_ns"}, section);
    add_words(section, words, "method");

    add_words(section, words, "results");
    const auto studies = studies_of(meshes, "implicit smoothing", settings, progress, section, implicit_study);
    for (const ImplicitStudy& study : studies) {
        add_figures(answer, study);
        add_before_after(answer, study, settings.colormap);
        add(section, grid_table(study));
        add_checks(section, study);
        add_timings(section, study);
    }
    add(section, cost_table(studies));
    add_discussion(section, studies);

    const ImplicitStudy& last = studies.back();
    std::vector<std::string> times;
    for (const int t : last.iterations) times.push_back(std::to_string(t));
    section.parameters = {{"iterations", listed(times)}, {"operator", smoothing_words.line("parameter.operator")}};
    section.extent =
        words.line("extent", "steps"_a = last.lambdas.size(), "counts"_a = listed(times), "meshes"_a = listed(names_of(studies)));
    section.findings.push_back(finding(last));
    return answer;
}

extern const Chapter chapter{
    .id = "q6",
    .code = {{"smooth", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"implicit_step", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"ImplicitSolver::prepare", "src/geometry/smoothing/implicit_solver.cpp"},
             {"answer", "src/questions/q6_implicit/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q6_implicit
