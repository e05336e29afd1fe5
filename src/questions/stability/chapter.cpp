// The section "stability": its checks, parameters and blocks in their order.
#include "questions/stability/parts.h"

namespace meshfolio::stability {

namespace {

/// Checks the proof of one limit, and the runs on either side of it.
void add_limit_checks(report::Section& section, const std::string& mesh, const OperatorLimit& limit) {
    const auto name = [&](std::string_view key) { return words.line(key, "operator"_a = limit.name, "mesh"_a = mesh); };
    const StabilityCertificate& proved = limit.certificate;
    constexpr double wanted = 1e-8;
    report::Check width = check_at_most(name("check.width"), wanted, proved.relative_width());
    if (!width.passed() && proved.rounding >= 0.2 * wanted)   // of a large factor
        width = undecided(std::move(width), words.line("check.width.undecided", "entries"_a = proved.factor_nonzeros));

    const Definiteness& bottom = proved.bottom;
    const double lowest = bottom.indefinite() ? bottom.mu_high : bottom.mu_low;
    report::Check semidefinite = check_at_least(name("check.semidefinite"), 0, lowest / proved.mu_high, 1e-10);
    if (!bottom.semidefinite() && !bottom.indefinite())
        semidefinite = undecided(std::move(semidefinite), words.line("check.semidefinite.undecided", "low"_a = readable(bottom.mu_low, 2),
                                                                     "high"_a = readable(bottom.mu_high, 2)));

    const ModeGrowth& below = limit.below;
    append_checks(section, {width, semidefinite, check_at_least(name("check.gershgorin"), 1, proved.top.upper_bound / proved.mu_high, 1e-8),
                            check_near(name("check.growth"), 1, measured_over_predicted(limit.beyond), 1e-3),
                            check_at_most(name("check.decay"), 1, *std::max_element(below.factor.begin() + 1, below.factor.end())),
                            check_at_most(name("check.decay_by_law"), 0, below.factor.back() - below.predicted(below.steps()), 1e-6)});
}

void add_plane_checks(report::Section& section, const SmoothingMaps& maps) {
    const BlowUps found = blow_ups_of({&maps, 1});
    const auto none = [&](std::string_view key, int runs, const std::string& note = "") {
        return check_near(words.line(key, "mesh"_a = maps.name()), 0, runs, 0, note);
    };
    append_checks(section, {none("check.explicit", found.within_lost), none("check.implicit", found.implicit_lost),
                            none("check.late", found.late, words.line("check.late.note"))});
    if (maps.all && found.beyond > 0) add(section, none("check.early", found.early));
    add(section, check_near(words.line("check.factorisations", "mesh"_a = maps.name()), 1,
                            double(maps.implicit_map().factorisations) / double(maps.lambdas.size()), 0));
}

void add_record(report::Section& section, const Studies& studies, const Planes& planes) {
    for (const StabilityStudy& study : studies) {
        const double critical = study.cotangent().critical();
        section.parameters[words.line("parameter.critical", "mesh"_a = study.name())] = {plain_text(critical, 10), critical, "length²"};
    }
    section.parameters[words.line("parameter.steps")] = studies.front().cotangent().beyond.steps();
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
    LibraryMeshes studied = each_of(studies, [](const StabilityStudy& study) { return study.source; });
    if (!settings.laboratory) studied.resize(std::min<std::size_t>(studied.size(), settings.quick ? 1 : 2));
    const auto planes = studies_of(studied, "planes of smoothing", settings, progress, section, smoothing_maps);
    const report::Facts facts = facts_of(studies, flow, planes);
    section.answer = words.say("answer", facts);

    add_words(section, words, "method");
    add_words(section, words, "limit", facts);
    add(section, certificate_table(studies), unit_table(studies));
    add_top_mode_figure(answer, studies);
    add(section, growth_plot(last));   // all meshes obey one law
    add_words(section, words, "rebuilt", facts);
    add(section, flow_table(flow), flow_plot(flow));
    add_words(section, words, "planes", facts);
    for (const SmoothingMaps& maps : planes) add(section, error_map(maps));
    add_place_figure(answer, planes);
    add(section, region_table(planes), blow_up_table(planes), plane_table(planes));

    for (const StabilityStudy& study : studies) {
        for (const OperatorLimit& limit : study.limits) add_limit_checks(section, study.name(), limit);
        const double mu_low = study.uniform().certificate.mu_low;
        add(section, check_at_most(words.line("check.uniform", "mesh"_a = study.name()), 2, mu_low));
    }
    add(section, check_at_most(words.line("check.adaptive", "mesh"_a = flow.name()), 2, largest_product(flow.adaptive.run)));
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
