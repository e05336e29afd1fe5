// The chapter "Ground truth": the panel of all estimators on surfaces where the curvature is known.
#include "questions/truth/parts.h"

namespace meshfolio::truth {

namespace {

void add_method(report::Section& section, const GroundTruth& truth) {
    for (const BenchRun& run : of_kind(truth.runs, MeshKind::regular)) section.parameters[run.surface] = run.dimensions;
    add_words(section, words, "method", "surfaces"_a = truth.runs.size() / panel_kinds.size(),
              "refinements"_a = truth.runs.front().levels.size(),
              "vertices"_a = truth.run("saddle", MeshKind::regular).levels.back().vertices);
}

report::Text answer_of(const GroundTruth& truth) {
    const BenchRun& run = truth.run("ellipsoid", MeshKind::random);
    const ErrorHistory mixed = run.errors("H.mixed"), jet = run.errors("H.jet");
    const auto does = [](const ErrorHistory& errors) {
        return words.line(errors.order().converges() ? "answer.converges" : "answer.does_not_converge");
    };
    return words.say("answer", "mixed_does"_a = does(mixed), "mixed"_a = readable_percent(mixed.last(), 2), "jet_does"_a = does(jet),
                     "jet"_a = readable_percent(jet.last(), 2));
}

}   // namespace

GroundTruth ground_truth(std::uint64_t seed, bool quick, const Progress& progress) {
    return {panel_runs(seed, quick, progress), reference_level(10000, seed), seed, quick};
}

report::Section ground_truth_section(const GroundTruth& truth) {
    report::Section section = section_of("truth");
    section.extent = words.line("extent", "of_H"_a = panel_estimators(Quantity::H).size(), "of_K"_a = panel_estimators(Quantity::K).size(),
                                "surfaces"_a = truth.runs.size() / panel_kinds.size(), "kinds"_a = panel_kinds.size());
    section.parameters = {{"seed", truth.seed}, {"refinements", truth.runs.front().levels.size()}};
    section.answer = answer_of(truth);
    add_method(section, truth);
    add_words(section, words, "results");
    add(section, overview(truth));
    for (const MeshKind kind : {MeshKind::regular, MeshKind::random})
        for (const Quantity quantity : {Quantity::H, Quantity::K}) add(section, convergence_plot(truth, kind, quantity));
    for (const MeshKind kind : panel_kinds) {
        add(section, error_table(truth, kind));
        add(section, order_table(truth, kind));
    }
    add_discussion(section, truth);
    append_checks(section, ground_truth_checks(truth));
    return section;
}

Answer answer(const MeshLibrary&, const QuestionSettings& settings, const Progress& progress) {
    return {ground_truth_section(ground_truth(settings.seed, settings.quick, progress)), {}, {}};
}

extern const Chapter chapter{
    .id = "truth",
    .code = {{"jet_curvature", "src/geometry/curvature/jet_fit.cpp"},
             {"corrected_curvature", "src/geometry/curvature/corrected_curvature.cpp"},
             {"bench_mesh", "src/questions/bench/bench_mesh.cpp"},
             {"measured", "src/questions/bench/curvature_bench.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::truth
