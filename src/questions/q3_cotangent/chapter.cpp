// Question 3: mean curvature from the cotangent Laplace–Beltrami operator, beside that of the uniform Laplacian.
#include "questions/q3_cotangent/parts.h"

namespace meshfolio::q3_cotangent {

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q3")};
    report::Section& section = answer.section;
    const auto sources = meshes_for(library, settings, section);
    Comparisons meshes;
    for (const auto& source : sources) {
        progress("cotangent curvature of " + source->name);
        meshes.push_back(compare_operators(source));
    }
    const Disagreements with_jets = each_of(meshes, disagreement_with_jet);
    const BenchRuns runs = question_runs(library, settings, progress);
    const PlaneTest plane = irregular_plane(settings.seed);
    const BenchRuns panel = panel_runs(library, settings.seed, settings.quick, progress);

    section.answer = answer_of(runs);
    add_paragraphs(section, {lead_of(runs, plane, panel)});
    add_words(section, words, "method");
    add(section, weight_diagram());
    add_words(section, words, "results");
    add_comparison_figure(answer, meshes, with_jets);
    add_plane_figure(answer, meshes, plane, settings.colormap);
    add(section, error_table(runs, &EstimateError::l2, "l2", "L2"));
    add_discussion(section, meshes, with_jets, runs, plane, panel);
    add_checks(section, runs, plane, meshes);

    begin_appendix(section);
    add_limits(section, meshes, runs);
    add(section, error_table(runs, &EstimateError::linf, "linf", "L∞"), difference_table(meshes), variant_table(meshes),
        error_curves(runs));
    add_trust(section, indicator_trials(library, runs, settings));
    for (std::size_t m = 0; m < meshes.size(); ++m)   // a mesh that is flat, or all boundary, has no H to doubt
        if (with_jets[m].rms > 0) add_disagreement(answer, meshes[m], with_jets[m], settings.colormap);

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
             {"cotangent_stiffness", "src/geometry/operators/cotangent_laplacian.cpp"},
             {"corner_cotangents", "src/geometry/operators/cotangent_laplacian.cpp"},
             {"vertex_areas", "src/geometry/operators/vertex_areas.cpp"},
             {"cotangent_mean_curvature", "src/geometry/curvature/curvature.cpp"},
             {"uniform_mean_curvature_scaled", "src/geometry/curvature/curvature.cpp"},
             {"compare_operators", "src/questions/bench/cotangent_study.cpp"},
             {"jet_curvature", "src/geometry/curvature/jet_fit.cpp"},
             {"answer", "src/questions/q3_cotangent/chapter.cpp"}},
    .roles = {"lilium", "plane"},
    .cost = {.cpu = {{1.6, 1, 2.6}, {1.5, 0, 2.6}}, .memory = {{40, 42}, {9, 42}}},
    .answer = answer,
};

}   // namespace meshfolio::q3_cotangent
