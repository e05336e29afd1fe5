// The section "stability": the limit of explicit smoothing proved, and what explicit and implicit runs do on both sides of it.
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

void add_limit_checks(report::Section& section, const Studies& studies, const RebuiltFlow& flow) {
    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit* limit : study.operators()) add_operator_checks(section, study.name(), *limit);
        add(section, check_at_most(words.line("check.uniform", "mesh"_a = study.name()), 2, study.uniform.certificate.mu_low));
    }
    add(section, check_at_most(words.line("check.adaptive", "mesh"_a = flow.name()), 2, largest_product(flow.adaptive.run)));
}

void add_plane_checks(report::Section& section, const SmoothingMaps& maps) {
    const auto name = [&](std::string_view key) { return words.line(key, "mesh"_a = maps.name()); };
    const int last = maps.iterations.back();
    int below = 0, implicit = 0, late = 0, early = 0, compared = 0;
    for (std::size_t step = 0; step < maps.lambdas.size(); ++step) {
        const double lambda = maps.lambdas[step];
        const int blow_up = maps.explicit_map.blow_up[step];
        implicit += maps.implicit_map.blow_up[step] > 0 ? 1 : 0;
        below += lambda < maps.subject.critical && blow_up > 0 ? 1 : 0;
        if (lambda <= maps.subject.critical) continue;
        const double latest = 1.1 * maps.known_modes().latest(lambda) + 1;
        late += latest < last && !(blow_up > 0 && blow_up <= latest) ? 1 : 0;
        if (!maps.all) continue;
        ++compared;
        const int earliest = maps.all->earliest(lambda, last);
        early += blow_up > 0 && (earliest == 0 || blow_up < earliest) ? 1 : 0;
    }
    append_checks(section, {check_near(name("check.explicit"), 0, below, 0), check_near(name("check.implicit"), 0, implicit, 0),
                            check_near(name("check.late"), 0, late, 0, words.line("check.late.note"))});
    if (compared > 0) add(section, check_near(name("check.early"), 0, early, 0));
    add(section, check_near(name("check.factorisations"), 1, double(maps.implicit_map.factorisations) / double(maps.lambdas.size()), 0));
}

/// The planes are of two meshes at most, of one in a quick look, of all in the laboratory.
LibraryMeshes meshes_of_planes(const Studies& studies, const QuestionSettings& settings) {
    LibraryMeshes meshes = each_of(studies, [](const StabilityStudy& study) { return study.source; });
    const std::size_t most = settings.laboratory ? meshes.size() : settings.quick ? 1 : 2;
    meshes.resize(std::min(meshes.size(), most));
    return meshes;
}

void add_record(report::Section& section, const Studies& studies, const Planes& planes) {
    for (const StabilityStudy& study : studies) {
        const double critical = study.cotangent.critical();
        section.parameters[words.line("parameter.critical", "mesh"_a = study.name())] = {plain_text(critical, 10), critical, "length²"};
    }
    section.parameters[words.line("parameter.steps")] = studies.front().cotangent.beyond.steps();
    section.parameters["operator"] = words.line("parameter.operators");
    for (const SmoothingMaps& maps : planes) {
        const auto relative = each_of(maps.lambdas, [&](double lambda) { return lambda / maps.subject.critical; });
        section.parameters[words.line("parameter.plane", "mesh"_a = maps.name())] = {
            words.line("parameter.plane.value", "steps"_a = relative.size(), "first"_a = readable(relative.front()),
                       "last"_a = readable(relative.back()), "iterations"_a = maps.iterations.back()),
            relative};
    }
    section.extent = words.line("extent", "meshes"_a = listed(names_of(studies)), "planes"_a = listed(names_of(planes)));
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("stability")};
    report::Section& section = answer.section;
    const auto meshes = meshes_for(library, settings, section);
    const auto studies = studies_of(meshes, "limit of explicit smoothing", settings, progress, section, stability_study);
    const StabilityStudy& last = studies.back();
    progress("rebuilt flow of " + last.name());
    const RebuiltFlow flow = rebuilt_flow(last, settings);
    const auto planes = studies_of(meshes_of_planes(studies, settings), "planes of smoothing", settings, progress, section, smoothing_maps);
    const report::Facts facts = facts_of(studies, flow, planes);
    section.answer = words.say("answer", facts);

    add_words(section, words, "method");
    add_words(section, words, "limit", facts);
    add(section, certificate_table(studies), unit_table(studies));
    add_top_mode_figure(answer, studies);
    add(section, growth_plot(last));   // the law is one
    add_words(section, words, "rebuilt", facts);
    add(section, flow_table(flow), flow_plot(flow));
    add_words(section, words, "planes", facts);
    for (const SmoothingMaps& maps : planes) add(section, error_map(maps));
    add_place_figure(answer, planes);
    add(section, region_table(planes), blow_up_table(planes), plane_table(planes));

    add_limit_checks(section, studies, flow);
    for (const SmoothingMaps& maps : planes) add_plane_checks(section, maps);
    add_record(section, studies, planes);
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
             {"smoothing_maps", "src/questions/stability/planes.cpp"},
             {"growing_modes", "src/questions/stability/planes.cpp"},
             {"ImplicitSolver::prepare", "src/geometry/smoothing/implicit_solver.cpp"},
             {"answer", "src/questions/stability/chapter.cpp"}},
    .roles = {"cube", "plane_ns", "fandisk_ns", "armadillo"},
    .cost = {.cpu = {{0.2, 22, 75}, {0.17, 10, 45}}, .memory = {{18, 350}, {3, 175}}},
    .answer = answer,
};

}   // namespace meshfolio::stability
