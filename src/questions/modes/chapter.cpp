// The section "modes": explicit and implicit smoothing, one eigenmode at a time.
#include "questions/modes/parts.h"

namespace meshfolio::modes {

namespace {

void add_timings(report::Section& section, const ModeStudy& study) {
    for (const TriedWay& run : study.tried)
        section.timings.push_back({words.line("timing", "scheme"_a = scheme_name(run.way.scheme), "steps"_a = run.way.steps,
                                              "mesh"_a = study.name(), "energy"_a = readable_percent(study.targets[run.target].energy, 2)),
                                   run.seconds});
}

void add_checks(report::Section& section, const ModeStudy& study) {
    double damping = 0, gap = 0, energy = 0;
    int gaps = 0, runs = 0;
    for (const ModeDamping& d : study.dampings) damping = std::max(damping, d.deviation(study.eigenvalues));
    for (const SchemeGap& g : study.gaps) {
        if (!(g.lambda <= study.subject.critical && study.seen(g))) continue;
        gap = std::max(gap, std::abs(g.predicted / g.measured - 1));
        ++gaps;
    }
    for (const TriedWay& run : study.tried) {
        if (!(run.rounding < 1e-7)) continue;
        energy = std::max(energy, std::abs(run.energy / run.way.energy - 1));
        ++runs;
    }
    add(section,
        check_at_most(words.line("check.damping", "modes"_a = study.eigenvalues.size(), "mesh"_a = study.name()), law_tolerance, damping));
    if (gaps > 0) add(section, check_at_most(words.line("check.gap", "mesh"_a = study.name()), 1e-6, gap));
    if (runs > 0) add(section, check_at_most(words.line("check.energy", "runs"_a = runs, "mesh"_a = study.name()), 1e-6, energy));
}

report::Text answer_of(const ModeStudy& study) {
    const char* key = study.cheaper_nowhere(0) ? "answer.nowhere" : study.cheaper_everywhere(0) ? "answer.everywhere" : "answer.below";
    const double energy = study.crossings[0] ? study.crossings[0]->energy : 0;
    return words.say(key, "mesh"_a = study.name(), "energy"_a = readable_percent(energy, 2),
                     "least"_a = readable_percent(study.curve.back().energy, 2));
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("modes")};
    report::Section& section = answer.section;
    const auto meshes = laboratory_meshes(library, settings, section);
    add_words(section, words, {"method", "results"});
    const auto studies = studies_of(meshes, "modes", settings, progress, section, mode_study);
    const ModeStudy& first = studies.front();
    add(section, damping_plot(first, SmoothingScheme::explicit_euler), damping_plot(first, SmoothingScheme::implicit_euler),
        damping_table(studies), gap_table(studies));
    for (const ModeStudy& study : studies) {
        add(section, cost_plot(study), truth_plot(study));
        add_timings(section, study);
    }
    add(section, crossing_table(studies));
    add_discussion(section, studies);
    for (const ModeStudy& study : studies) add_checks(section, study);

    section.parameters = {{"operator", words.line("parameter.operator")},
                          {words.line("parameter.step"), {"0.95 λ_crit", 0.95, "λ_crit"}},
                          {words.line("parameter.lanczos"), lanczos_steps(settings)}};
    const Names damped = each_of(studies, [&](const ModeStudy& study) {
        return words.line(&study == &first ? "extent.modes" : "extent.more", "modes"_a = study.eigenvalues.size(), "mesh"_a = study.name());
    });
    section.extent =
        words.line("extent", "modes"_a = listed(damped), "targets"_a = first.targets.size(), "meshes"_a = listed(names_of(studies)));
    section.answer = answer_of(first);
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
