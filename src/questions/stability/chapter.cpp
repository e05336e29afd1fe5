// The section "stability": the limit of explicit smoothing proved, and what happens on both sides of it.
#include "questions/stability/parts.h"

namespace meshfolio::stability {

namespace {

/// 1e-8, unless the rounding of a large factor forbids it.
report::Check width_check(std::string name, const StabilityCertificate& proved) {
    constexpr double wanted = 1e-8;
    report::Check check = check_at_most(std::move(name), wanted, proved.relative_width());
    if (check.passed() || proved.rounding < 0.2 * wanted) return check;
    return undecided(std::move(check), words.line("check.width.undecided", "entries"_a = proved.factor_nonzeros));
}

/// Is undecided where semidefiniteness is neither proved nor refuted.
report::Check semidefinite_check(std::string name, const StabilityCertificate& proved) {
    const Definiteness& d = proved.bottom;
    report::Check check = check_at_least(std::move(name), 0, (d.indefinite() ? d.mu_high : d.mu_low) / proved.mu_high, 1e-10);
    if (d.semidefinite() || d.indefinite()) return check;
    return undecided(std::move(check),
                     words.line("check.semidefinite.undecided", "low"_a = readable(d.mu_low, 2), "high"_a = readable(d.mu_high, 2)));
}

void add_operator_checks(report::Section& section, const std::string& mesh, const OperatorLimit& limit) {
    const auto name = [&](std::string_view key) { return words.line(key, "operator"_a = limit.name, "mesh"_a = mesh); };
    const StabilityCertificate& proved = limit.certificate;
    const ModeGrowth& below = limit.below;
    append_checks(section, {width_check(name("check.width"), proved), semidefinite_check(name("check.semidefinite"), proved),
                            check_at_least(name("check.gershgorin"), 1, proved.top.upper_bound / proved.mu_high, 1e-8),
                            check_near(name("check.growth"), 1, over_predicted(limit.beyond), 1e-3),
                            check_at_most(name("check.decay"), 1, *std::max_element(below.factor.begin() + 1, below.factor.end())),
                            check_at_most(name("check.decay_by_law"), 0, below.factor.back() - below.predicted(below.steps()), 1e-6)});
}

void add_checks(report::Section& section, const Studies& studies, const RebuiltFlow& flow) {
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit* limit : study.operators()) add_operator_checks(section, study.name(), *limit);
        add(section, check_at_most(words.line("check.uniform", "mesh"_a = study.name()), 2, study.uniform.certificate.mu_low));
    }
    add(section, check_at_most(words.line("check.adaptive", "mesh"_a = flow.name()), 2, largest_product(flow.adaptive.run)));
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("stability")};
    report::Section& section = answer.section;
    const auto meshes = meshes_for(library, settings, {"cube", "plane_ns", "fandisk_ns", "armadillo"}, section);
    add_words(section, words, {"method", "results"});
    const auto studies = studies_of(meshes, "limit of explicit smoothing", settings, progress, section, stability_study);
    const StabilityStudy& last = studies.back();
    progress("rebuilt flow of " + last.name());
    const RebuiltFlow flow = rebuilt_flow(last, settings);
    add(section, certificate_table(studies), unit_table(studies));
    add_limiting_vertex_figures(answer, studies, settings.colormap);
    add(section, growth_table(studies));
    add(section, growth_plot(last));   // the law is one: the table has the others
    add(section, flow_table(flow), flow_plot(flow), flow_time_table(flow));
    add_discussion(section, studies, flow);
    add_checks(section, studies, flow);

    for (const StabilityStudy& study : studies) {
        const double critical = study.cotangent.critical();
        section.parameters[words.line("parameter.critical", "mesh"_a = study.name())] = {plain_text(critical, 10), critical, "length²"};
    }
    section.parameters[words.line("parameter.steps")] = studies.front().cotangent.beyond.steps();
    section.parameters["operator"] = words.line("parameter.operators");
    section.extent = words.line("extent", "meshes"_a = listed(names_of(studies)));
    section.answer = answer_of(studies);
    return answer;
}

extern const Chapter chapter{
    .id = "stability",
    .code = {{"stability_certificate", "src/geometry/smoothing/stability_certificate.cpp"},
             {"definiteness", "src/geometry/spectrum/definiteness.cpp"},
             {"enclose_largest", "src/geometry/spectrum/eigenvalue_enclosure.cpp"},
             {"largest_eigenvalue", "src/geometry/spectrum/stability.cpp"},
             {"mode_growth", "src/geometry/smoothing/mode_growth.cpp"},
             {"LimitWatch", "src/geometry/smoothing/limit_watch.h"},
             {"answer", "src/questions/stability/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::stability
