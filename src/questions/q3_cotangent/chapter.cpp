// Question 3: mean curvature from the cotangent Laplace–Beltrami operator, beside that of the uniform Laplacian.
#include "questions/q3_cotangent/parts.h"

namespace meshfolio::q3_cotangent {

namespace {

void add_checks(report::Section& section, const BenchRuns& runs, const PlaneTest& plane, const Comparisons& meshes) {
    for (const AreaForm form : area_forms) {
        const Order order = run_on(runs, "torus", MeshKind::regular).errors(H_with(form)).order();
        add(section, check_near(words.line("check.order", "areas"_a = area_name(form)), 2, order.exponent, 0.2));
    }
    add(section, pentagon_check(runs), check_at_most(words.line("check.linear_precision"), 0, plane.cotangent, 1e-10));
    for (const CotangentComparison& c : meshes) {
        if (!c.subject.plane_normal || c.subject.interior == 0) continue;
        const report::Check flat =
            check_at_most(words.line("check.flat", "mesh"_a = c.name()), 0, c.precision, 1e-5, words.line("check.flat.note"));
        const bool has_area = c.subject.preflight().zero_area_faces == 0;
        add(section, has_area || !flat.failed() ? flat : undecided(flat, words.line("check.flat.without_area")));
    }
}

report::Text about_trials(const std::vector<IndicatorTrial>& trials) {
    double off = 0, found = 1;
    int large = 0;
    for (const auto& [mesh, on] : trials) {
        if (on.actual < 0.05) continue;
        ++large;
        off = std::max(off, std::abs(on.indicated / on.actual - 1));
        found = std::min(found, on.found);
    }
    const IndicatorTrial& best = *std::ranges::min_element(trials, {}, [](const IndicatorTrial& t) { return t.indicator.actual; });
    report::Text t = words.say("trust.second_estimate");
    if (large > 0)
        go_on(t, words.say("trust.large", "meshes"_a = large, "off"_a = readable_percent(rounded_up(off, 2), 2),
                           "found"_a = readable_percent(rounded_down(found, 2), 2)));
    go_on(t, words.say("trust.small", "mesh"_a = best.mesh, "indicated"_a = readable_percent(best.indicator.indicated, 2),
                       "actual"_a = readable_percent(best.indicator.actual, 2)));
    return t;
}

report::Text about_disagreement(const CotangentComparison& c, const Disagreement& d) {
    report::Text t = words.say("trust.mesh", "mesh"_a = c.name(), "rms"_a = readable_percent(d.rms),
                               "median"_a = readable_percent(d.median), "concentration"_a = readable_percent(d.concentration, 2));
    if (d.without_jet > 0) go_on(t, words.say("trust.without_jet", "vertices"_a = d.without_jet));
    return t;
}

}   // namespace

void add_error_indicator(Answer& answer, const Comparisons& meshes, const BenchRuns& runs, const QuestionSettings& settings) {
    report::Section& section = answer.section;
    add_words(section, words, "trust");
    const std::vector<IndicatorTrial> trials = indicator_trials(runs, settings);
    add_paragraphs(section, {about_trials(trials)});
    add(section, indicator_table(trials));
    for (const CotangentComparison& c : meshes) {
        const Disagreement d = disagreement_with_jet(c);
        if (!std::isfinite(d.rms) || d.rms == 0) continue;   // flat, or nothing inside: no H to doubt
        add_disagreement_figure(answer, c, d, settings.colormap);
        add_paragraphs(section, {about_disagreement(c, d)});
    }
    const IndicatorTrial& random = trials.back();
    add(section,
        check_near(words.line("check.indicator", "mesh"_a = random.mesh), 1, random.indicator.indicated / random.indicator.actual, 0.05));
}

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q3")};
    report::Section& section = answer.section;
    const auto sources = meshes_for(library, settings, {"lilium", "plane"}, section);
    Comparisons meshes;
    for (const auto& source : sources) {
        progress("cotangent curvature of " + source->name);
        meshes.push_back(compare_operators(source));
    }
    const BenchRuns runs = question_runs(settings, progress);
    const PlaneTest plane = irregular_plane(settings.seed);
    const BenchRuns panel = panel_runs(settings.seed, settings.quick, progress);

    section.answer = answer_of(runs);
    add_paragraphs(section, {lead_of(runs, plane, panel)});
    add_words(section, words, "method");
    add(section, weight_diagram());
    add_words(section, words, "results");
    add_comparison_figure(answer, meshes);
    add_plane_figure(answer, plane, settings.colormap);
    add(section, error_table(runs, &EstimateError::l2, "l2", "L2"));
    add_discussion(section, meshes, runs, plane, panel);
    add_checks(section, runs, plane, meshes);

    begin_appendix(section);
    add_words(section, words, "appendix");
    add(section, error_table(runs, &EstimateError::linf, "linf", "L∞"), order_table(runs), difference_table(meshes), variant_table(meshes),
        convergence_plot(runs));
    add_limits(section, meshes, runs);
    add_error_indicator(answer, meshes, runs, settings);

    const std::size_t levels = runs.front().levels.size();
    int most_vertices = 0;
    for (const BenchRun& run : runs) most_vertices = std::max(most_vertices, run.finest().vertices);
    section.parameters = {{"area form", words.line("parameter.areas")},
                          {"negative weights", words.line("parameter.negative_weights")},
                          {"levels of refinement", levels},
                          {"seed of the jitter", settings.seed}};
    section.extent = words.line("extent", "meshes"_a = listed(names_of(meshes)), "levels"_a = levels, "vertices"_a = most_vertices);
    return answer;
}

extern const Chapter chapter{
    .id = "q3",
    .code = {{"laplace_beltrami", "src/geometry/operators/cotangent_laplacian.cpp"},
             {"corner_cotangents", "src/geometry/operators/cotangent_laplacian.cpp"},
             {"vertex_areas", "src/geometry/operators/vertex_areas.cpp"},
             {"cotangent_mean_curvature", "src/geometry/curvature/curvature.cpp"},
             {"uniform_mean_curvature_scaled", "src/geometry/curvature/curvature.cpp"},
             {"compare_operators", "src/questions/bench/cotangent_study.cpp"},
             {"jet_curvature", "src/geometry/curvature/jet_fit.cpp"},
             {"answer", "src/questions/q3_cotangent/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q3_cotangent
