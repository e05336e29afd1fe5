// The section "modes": explicit and implicit smoothing, one eigenmode at a time.
#include "questions/modes/parts.h"

namespace meshfolio::modes {

namespace {

constexpr std::size_t accurate = std::size(implicit_steps), matched = accurate + 1;   // implicit ways

report::Text about_laws(const Studies& studies) {
    double worst = 0;
    Eigen::Index modes = 0;
    for (const ModeStudy& study : studies) {
        modes += study.eigenvalues.size();
        for (const ModeDamping& d : study.dampings) worst = std::max(worst, d.deviation(study.eigenvalues));
    }
    const ModeDamping& close = studies.front().dampings[1];
    return report::text(words.say(worst < law_tolerance ? "laws" : "laws.off", "modes"_a = modes, "worst"_a = readable(worst, 2)), " ",
                        words.say("laws.limit", "steps"_a = close.steps,
                                  "left"_a = readable_percent(std::abs(close.law(studies.front().subject.top.value)), 2)));
}

/// What a distance is in a picture of a thousand pixels.
report::Text seen_in_a_picture(double of_box) {
    return words.say(of_box < 1e-3 ? "same.invisible" : of_box < 1e-2 ? "same.beside" : "same.no");
}

report::Text about_gap(const ModeStudy& study) {
    const SchemeGap* largest = nullptr;   // by share of the motion
    double widest = 0;                    // of the box
    double worst = 0, worst_leading = 0;
    int compared = 0;
    for (const SchemeGap& gap : study.gaps) {
        if (gap.lambda > study.subject.critical || !(gap.motion > 0)) continue;
        if (!largest || gap.measured / gap.motion > largest->measured / largest->motion) largest = &gap;
        widest = std::max(widest, gap.measured);
        if (!study.seen(gap)) continue;
        ++compared;
        worst = std::max(worst, std::abs(gap.predicted / gap.measured - 1));
        worst_leading = std::max(worst_leading, std::abs(gap.leading / gap.measured - 1));
    }
    if (!largest) return {};
    report::Text t = words.say("same", "mesh"_a = study.name(), "step"_a = readable(largest->lambda / study.subject.critical, 2),
                               "steps"_a = largest->steps, "gap"_a = readable_percent(largest->measured, 2),
                               "share"_a = readable_percent(largest->measured / largest->motion, 2));
    go_on(t, seen_in_a_picture(widest));
    if (compared > 0)
        go_on(t, words.say("same.predicted", "worst"_a = readable(worst, 1), "first_order"_a = readable_percent(worst_leading, 2)));
    return t;
}

/// "below 12 % of the energy", "everywhere", "nowhere".
std::string where_cheaper(const ModeStudy& study, std::size_t which) {
    if (study.cheaper_nowhere(which)) return words.line("cheaper.nowhere");
    if (study.cheaper_everywhere(which)) return words.line("cheaper.everywhere");
    return words.line("cheaper.below", "energy"_a = readable_percent(study.crossings[which]->energy, 2));
}

report::Text about_costs(const ModeStudy& study) {
    Names ways;
    for (std::size_t which = 0; which < std::size(implicit_steps); ++which)
        ways.push_back(words.line("cheaper.way", "steps"_a = implicit_steps[which], "where"_a = where_cheaper(study, which)));
    const SmoothingTarget& last = study.curve.back();
    const std::string least = readable_percent(last.energy, 2);
    const auto error = [](const SmoothingWay& way) { return readable_percent(way.error, 2); };
    report::Text t = words.say("cheaper", "mesh"_a = study.name(), "step"_a = readable(study.implicit_step / study.explicit_step, 2),
                               "factorisation"_a = readable(study.factor.factorisation / study.explicit_step, 2), "least"_a = least,
                               "ways"_a = listed(ways));
    const std::string explicitly =
        last.explicit_way.steps > 0 ? words.line("not_the_same.explicit", "error"_a = error(last.explicit_way)) : "";
    go_on(t, words.say("not_the_same", "least"_a = least, "one"_a = error(last.implicit_ways.front()), "explicit"_a = explicitly));
    go_on(t, words.say("true_enough", "accuracy"_a = readable_percent(implicit_accuracy, 1), "accurate"_a = where_cheaper(study, accurate),
                       "matched"_a = where_cheaper(study, matched)));
    return t;
}

/// The energies where one way of smoothing becomes cheaper, over all meshes.
struct Border {
    std::string where;   // "between 5 % and 12 % of the energy", "at 5 % of the energy"; empty where there is no border on any mesh
    int never = 0, everywhere = 0;   // meshes on which it is nowhere, and at every energy looked at, the cheaper one

    bool on_some() const { return never + everywhere > 0; }
};
Border border(const Studies& studies, std::size_t which) {
    Border found;
    double least = infinity, most = 0;
    for (const ModeStudy& study : studies) {
        found.never += study.cheaper_nowhere(which) ? 1 : 0;
        found.everywhere += study.cheaper_everywhere(which) ? 1 : 0;
        if (study.cheaper_nowhere(which) || study.cheaper_everywhere(which)) continue;
        least = std::min(least, study.crossings[which]->energy);
        most = std::max(most, study.crossings[which]->energy);
    }
    const std::string low = readable_percent(least, 2), high = readable_percent(most, 2);
    if (most > 0) found.where = words.line(low == high ? "border.at" : "border.between", "least"_a = low, "most"_a = high);
    return found;
}

report::Text rule(const Studies& studies) {
    const Border one = border(studies, 0), exact = border(studies, accurate);
    if (one.where.empty() && one.everywhere == 0) return words.say("rule.never");
    if (one.where.empty()) return words.say(one.never > 0 ? "rule.always_or_never" : "rule.always");
    const std::string error = readable_percent(implicit_accuracy, 1);
    const std::string by_one = words.line(one.on_some() ? "border.one.on_some" : "border.one", "where"_a = one.where);
    if (exact.where.empty()) return words.say("rule.border", "one"_a = by_one, "error"_a = error);
    return words.say("rule.borders", "one"_a = by_one,
                     "accurate"_a = words.line(exact.on_some() ? "border.accurate.on_some" : "border.accurate", "where"_a = exact.where,
                                               "error"_a = error));
}

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
    add_words(section, words, "discussion");
    add_paragraphs(section, {about_laws(studies)});
    for (const ModeStudy& study : studies) add_paragraphs(section, {about_gap(study), about_costs(study)});
    add_paragraphs(section, {rule(studies)});
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
             {"factor_operations", "src/geometry/linear/sparse_factor.cpp"},
             {"mode_study", "src/questions/modes/study.cpp"},
             {"CostModel", "src/questions/modes/costs.cpp"},
             {"answer", "src/questions/modes/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::modes
