// The section "modes": explicit and implicit smoothing, one eigenmode at a time.
#include "questions/modes/parts.h"

#include "base/number_text.h"
#include "questions/bench/laboratory_meshes.h"
#include "questions/core/chapter.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"

namespace meshfolio::modes {

namespace {

using report::math;
using report::ref;

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(section, "With a fixed operator neither scheme mixes the modes: an explicit step multiplies mode ", math("i"), " by ",
                  math("1 − λμ_i"), ", an implicit one divides it by ", math("1 + λμ_i"),
                  ". To measure this for every mode, also for those that a symmetric mesh has none of, coordinates are made that have each "
                  "mode in them with coefficient 1. What the two schemes differ by at equal ",
                  math("λ"), " and ", math("t"), " is then known beforehand:");
    add_formula(section, "scheme_gap", "modes_eq_gap");
    add_paragraph(section, "The sum needs no modes: Gauss quadrature by Lanczos from the coordinates gives it on a mesh of any size ",
                  ref("golub_meurant_1994"),
                  ". The same measure tells the energy that a filter will leave and its distance from the exact "
                  "flow ",
                  math("e^{TL}X"), " of the same energy, and so how many steps of which ", math("λ"),
                  " a given smoothness takes. Operations are counted from the pattern: three multiply–adds for each entry of ", math("C"),
                  " in an explicit step, and those of the factor ", ref("davis_2006"), " in an implicit one.");
}

void add_timings(report::Section& section, const ModeStudy& study) {
    for (const TriedWay& run : study.tried) {
        section.timings.push_back({(run.way.scheme == SmoothingScheme::explicit_euler ? "explicit, " : "implicit, ") +
                                       counted(run.way.steps, "step") + ": " + study.name() + " to " +
                                       readable_percent(study.targets[run.target].energy, 2) + " of its energy",
                                   run.seconds});
    }
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("modes");
    const auto meshes = laboratory_meshes(library, settings, section);
    add_method(section);

    add_heading(section, "Results");
    const auto studies = studies_of(meshes, "modes", settings, progress, section, mode_study);
    const ModeStudy& first = studies.front();
    section.blocks.emplace_back(damping_plot(first, SmoothingScheme::explicit_euler));
    section.blocks.emplace_back(damping_plot(first, SmoothingScheme::implicit_euler));
    section.blocks.emplace_back(damping_table(studies));
    section.blocks.emplace_back(gap_table(studies));
    for (const ModeStudy& study : studies) {
        section.blocks.emplace_back(cost_plot(study));
        section.blocks.emplace_back(truth_plot(study));
        section.blocks.emplace_back(cost_table(study));
        add_timings(section, study);
    }
    section.blocks.emplace_back(crossing_table(studies));
    add_discussion(section, studies);
    append_checks(section, mode_checks(studies));

    section.parameters["operator"] = "cotangent, of the input, barycentric areas";
    section.parameters["explicit step of the comparison of costs"] = "0.95 λ_crit";
    section.parameters["steps of Lanczos for each coordinate"] = std::to_string(lanczos_steps(settings));
    std::vector<std::string> damped;
    for (const ModeStudy& study : studies)
        damped.push_back(std::to_string(study.eigenvalues.size()) + (damped.empty() ? " modes of " : " of ") + study.name());
    section.extent = "damping of " + listed(damped) + ", the gap between the schemes and the cost of " +
                     counted(static_cast<int>(first.targets.size()), "target") + " on " + listed(names_of(studies)) +
                     ", predicted and measured";
    const auto& crossing = first.crossings.front();
    section.findings.push_back(
        {report::text("Is implicit smoothing cheaper? On ", first.name(),
                      " one implicit step takes fewer operations than explicit smoothing ",
                      !crossing ? std::string("nowhere")
                      : crossing->energy >= first.curve.front().energy
                          ? std::string("for every smoothness looked at")
                          : "once no more than " + readable_percent(crossing->energy, 2) + " of the energy is to be left",
                      " (", ref("modes_crossing"), ")."),
         60});
    return answer;
}

extern const Chapter chapter{
    .id = "modes",
    .code = {{"spectral_measure", "src/geometry/spectrum/spectral_measure.cpp"},
             {"factor_operations", "src/geometry/linear/factor_operations.cpp"},
             {"mode_study", "src/questions/modes/study.cpp"},
             {"CostModel", "src/questions/modes/costs.cpp"},
             {"answer", "src/questions/modes/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::modes
