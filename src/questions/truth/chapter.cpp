// The chapter "Ground truth": the panel of all estimators on surfaces where the curvature is known.
#include <cmath>

#include "questions/core/section_tools.h"
#include "questions/truth/parts.h"

namespace meshfolio::truth {

namespace {

void add_method(report::Section& section, const GroundTruth& truth) {
    std::vector<std::string> surfaces;
    for (const PanelRun* run : runs_of(truth, MeshKind::regular))
        surfaces.push_back(words.line("method.surface", "surface"_a = run->surface, "dimensions"_a = run->dimensions));
    add_words(section, words, "method", "surfaces"_a = listed(surfaces), "refinements"_a = truth.runs.front().levels.size(),
              "vertices"_a = truth.run("saddle", MeshKind::regular).levels.back().vertices);
}

report::Text finding(const GroundTruth& truth) {
    const PanelRun& run = truth.run("ellipsoid", MeshKind::random);
    const auto does = [&](const char* key) {
        return words.line(converges(truth, run, key) ? "finding.converges" : "finding.does_not_converge");
    };
    const auto told = [&](const char* key) { return error_and_order(truth, run.surface, run.kind, Quantity::H, key); };
    return words.say("finding", "mixed_does"_a = does("mixed"), "mixed"_a = told("mixed"), "jet_does"_a = does("jet"),
                     "jet"_a = told("jet"));
}

}   // namespace

Behaviour behaviour_of(const FittedOrder& order) {
    if (std::isnan(order.order) || order.order >= 1.5) return Behaviour::second;   // without an order: exact
    return order.order >= 0.5 ? Behaviour::first : Behaviour::none;
}

std::vector<const PanelRun*> runs_of(const GroundTruth& truth, MeshKind kind) {
    std::vector<const PanelRun*> runs;
    for (const PanelRun& run : truth.runs)
        if (run.kind == kind) runs.push_back(&run);
    return runs;
}

bool converges(const GroundTruth& truth, const PanelRun& run, const std::string& estimator) {
    return behaviour_of(truth.order(run, Quantity::H, estimator_index(Quantity::H, estimator))) != Behaviour::none;
}

report::Section ground_truth_section(const GroundTruth& truth) {
    report::Section section = section_of("truth");
    section.extent = words.line("extent", "of_H"_a = estimators_of(Quantity::H).size(), "of_K"_a = estimators_of(Quantity::K).size(),
                                "surfaces"_a = runs_of(truth, MeshKind::regular).size(), "kinds"_a = mesh_kinds.size());
    section.parameters = {{"seed", std::to_string(truth.seed)}, {"refinements", std::to_string(truth.runs.front().levels.size())}};
    add_method(section, truth);
    add_words(section, words, "results");
    add(section, overview(truth));
    const Norm norms[]{{&EstimateError::l2, "l2", "L2"}, {&EstimateError::linf, "linf", "L∞"}};
    for (const MeshKind kind : mesh_kinds) {
        for (const Quantity quantity : quantities) add(section, convergence_plot(truth, kind, quantity));
        for (const Norm& norm : norms) {
            add(section, error_table(truth, kind, norm));
            add(section, order_table(truth, kind, norm));
        }
    }
    add_discussion(section, truth);
    append_checks(section, ground_truth_checks(truth));
    section.findings = {{finding(truth), 79}};
    return section;
}

Answer answer(const MeshLibrary&, const QuestionSettings& settings, const Progress& progress) {
    return {ground_truth_section(*shared_ground_truth(settings, progress)), {}, {}};
}

extern const Chapter chapter{
    .id = "truth",
    .code = {{"jet_curvature", "src/geometry/curvature/jet_fit.cpp"},
             {"corrected_curvature", "src/geometry/curvature/corrected_curvature.cpp"},
             {"truth_mesh", "src/questions/bench/ground_truth_meshes.cpp"},
             {"panel_level", "src/questions/bench/ground_truth.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::truth
