// The chapter "Ground truth": the panel of all estimators on surfaces where the curvature is known.
#include "questions/truth/parts.h"

namespace meshfolio::truth {

namespace {

/// An estimator on a surface in one kind of mesh.
struct Case {
    const char* surface;
    MeshKind kind;
    std::string key;

    std::string name(std::string_view message) const {
        const Estimator& measured = estimator(key);
        return curvature_words.line(message, "quantity"_a = symbol(measured.quantity), "estimator"_a = measured.name(),
                                    "kind"_a = name_of(kind), "surface"_a = surface);
    }
};

/// Values found by another program on other random points.
constexpr struct {
    const char* key;
    double expected, tolerance;
} references[]{{"H.barycentric", 0.28, 0.015},    {"H.mixed", 0.20, 0.015},         {"K.mixed", 0.18, 0.015},
               {"H.jet", 0.0041, 0.0004},         {"K.jet", 0.0084, 0.0009},        {"H.corrected_exact", 0.014, 0.002},
               {"H.corrected_max", 0.036, 0.003}, {"H.corrected_area", 0.22, 0.015}};

void add_discussion(report::Section& section, const GroundTruth& truth) {
    using enum MeshKind;
    const auto error = [&](const char* surface, MeshKind kind, const char* key, Norm norm = &EstimateError::l2) {   // on the finest mesh
        return readable_percent(truth.run(surface, kind).finest().error(key).*norm, norm == &EstimateError::l2 ? 2 : 3);
    };
    Names on_random_points;   // surfaces where cotangent H converges, for each area form that has some
    for (const AreaForm form : area_forms) {
        Names surfaces;
        for (const BenchRun& run : of_kind(truth.runs, MeshKind::random))
            if (run.errors(H_with(form)).order().converges()) surfaces.push_back(run.surface);
        if (!surfaces.empty())
            on_random_points.push_back(words.line("random.with", "areas"_a = area_name(form), "surfaces"_a = listed(surfaces)));
    }
    BenchRuns clean;
    std::ranges::copy_if(truth.runs, std::back_inserter(clean), [](const BenchRun& run) { return run.kind != noisy; });
    const auto jets = std::ranges::count_if(clean, [](const BenchRun& run) { return run.errors("H.jet").order().converges(); });
    add_words(section, words, "discussion", "torus_mixed"_a = error("torus", regular, "H.mixed"),
              "torus_K"_a = error("torus", regular, "K.mixed"), "torus_uniform"_a = error("torus", regular, "H.uniform"),
              "icosphere"_a = error("ellipsoid", regular, "H.mixed"),
              "icosphere_largest"_a = error("ellipsoid", regular, "H.mixed", &EstimateError::linf),
              "band"_a = error("ellipsoid band", regular, "H.mixed"),
              "pentagons"_a = error("sphere", regular, "H.barycentric", &EstimateError::linf), "somewhere"_a = listed(on_random_points),
              "barycentric"_a = error("ellipsoid", random, "H.barycentric"), "mixed"_a = error("ellipsoid", random, "H.mixed"),
              "along_normal"_a = error("ellipsoid", random, "H.mixed_n"), "K"_a = error("ellipsoid", random, "K.mixed"),
              "converging"_a = jets, "runs"_a = clean.size(), "jet_H"_a = error("ellipsoid", random, "H.jet"),
              "jet_K"_a = error("ellipsoid", random, "K.jet"), "exact"_a = error("ellipsoid", random, "H.corrected_exact"),
              "area"_a = error("ellipsoid", random, "H.corrected_area"), "noisy_mixed"_a = error("ellipsoid", noisy, "H.mixed"),
              "noisy_jet"_a = error("ellipsoid", noisy, "H.jet"));
}

}   // namespace

std::vector<report::Check> ground_truth_checks(const GroundTruth& truth) {
    using enum MeshKind;
    std::vector<report::Check> checks{pentagon_check(truth.runs)};
    const auto errors = [&](const Case& c) { return truth.errors(c.surface, c.kind, c.key); };
    const auto order_near = [&](const Case& c, double expected, double tolerance, const std::string& note = "") {
        checks.push_back(check_near(c.name("check.order"), expected, errors(c).order().exponent, tolerance, note));
    };
    const auto order_at_least = [&](const Case& c, double expected, double tolerance, const char* note) {
        checks.push_back(
            check_at_least(c.name("check.order"), expected, errors(c).order().exponent, tolerance, curvature_words.line(note)));
    };
    const auto no_convergence = [&](const Case& c) {
        checks.push_back(check_at_most(c.name("check.no_convergence.order"), truth.quick ? 0.5 : 0.3, errors(c).order().exponent));
        checks.push_back(check_at_least(c.name("check.no_convergence.error"), 0.05, errors(c).last()));
    };

    for (const char* surface : {"torus", "ellipsoid band"}) {
        for (const AreaForm form : area_forms)
            for (const std::string& key : {H_with(form), K_with(form)}) order_near({surface, regular, key}, 2, truth.quick ? 0.25 : 0.15);
        no_convergence({surface, regular, "H.uniform"});
    }
    for (const char* surface : {"ellipsoid", "torus"}) {
        for (const char* key : {"H.barycentric", "H.barycentric_n", "K.barycentric", "H.mixed", "H.mixed_n", "K.mixed"})
            no_convergence({surface, random, key});
        order_at_least({surface, random, "H.corrected_exact"}, 0.8, 0, "check.order.first");
    }
    for (const char* surface : {"ellipsoid", "ellipsoid band"})
        for (const char* key : {"H.jet", "K.jet"}) order_at_least({surface, random, key}, 2, 0.25, "check.order.second");
    const double identity = truth.run("sphere", random).finest().error("H.voronoi_n").linf;
    checks.push_back(check_at_most(curvature_words.line("check.sphere"), 0, identity, 1e-9));
    for (const char* surface : {"ellipsoid", "torus"})
        order_near({surface, noisy, "H.mixed"}, -1, 0.3, curvature_words.line("check.order.noisy"));
    for (const auto& [key, expected, tolerance] : references)
        checks.push_back(check_near(Case{"ellipsoid", random, key}.name("check.reference"), expected, truth.reference.error(key).l2,
                                    tolerance, curvature_words.line("check.reference.note")));
    return checks;
}

GroundTruth ground_truth(const MeshLibrary& library, std::uint64_t seed, bool quick, const Progress& progress) {
    return {panel_runs(library, seed, quick, progress), reference_level(library, 10000, seed), seed, quick};
}

report::Section ground_truth_section(const GroundTruth& truth) {
    report::Section section = section_of("truth");
    section.extent = words.line("extent", "of_H"_a = panel_estimators(Quantity::H).size(), "of_K"_a = panel_estimators(Quantity::K).size(),
                                "surfaces"_a = truth.runs.size() / panel_kinds.size(), "kinds"_a = panel_kinds.size());
    section.parameters = {{"seed", truth.seed}, {"refinements", truth.runs.front().levels.size()}};
    const BenchRun& random = truth.run("ellipsoid", MeshKind::random);
    const ErrorHistory mixed = random.errors("H.mixed"), jet = random.errors("H.jet");
    section.answer = words.say("answer", "converges"_a = mixed.order().converges(), "mixed"_a = readable_percent(mixed.last(), 2),
                               "jet_converges"_a = jet.order().converges(), "jet"_a = readable_percent(jet.last(), 2));
    for (const BenchRun& run : of_kind(truth.runs, MeshKind::regular)) section.parameters[run.surface] = run.dimensions;
    add_words(section, words, "method", "surfaces"_a = truth.runs.size() / panel_kinds.size(),
              "refinements"_a = truth.runs.front().levels.size(), "vertices"_a = truth.run("saddle", MeshKind::regular).finest().vertices);
    add_words(section, words, "results");
    add(section, overview(truth));
    for (const MeshKind kind : {MeshKind::regular, MeshKind::random})
        for (const Quantity quantity : {Quantity::H, Quantity::K}) add(section, convergence_plot(truth, kind, quantity));
    for (const MeshKind kind : {MeshKind::regular, MeshKind::random}) add(section, error_table(truth, kind));
    add(section, finest_table(truth));
    add_discussion(section, truth);
    append_checks(section, ground_truth_checks(truth));
    return section;
}

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    const GroundTruth truth = ground_truth(library, settings.seed, settings.quick, progress);
    Answer answer{ground_truth_section(truth)};
    if (settings.laboratory) add(answer.section, ground_truth_table(truth));
    return answer;
}

extern const Chapter chapter{
    .id = "truth",
    .code = {{"jet_curvature", "src/geometry/curvature/jet_fit.cpp"},
             {"corrected_curvature", "src/geometry/curvature/corrected_curvature.cpp"},
             {"bench_mesh", "src/questions/bench/bench_mesh.cpp"},
             {"measured", "src/questions/bench/curvature_bench.cpp"}},
    .cost = {.cpu = {{3.4, 0}, {0.9, 0}}, .memory = {{3, 0}, {2, 0}}},
    .answer = answer,
    .verifies_program = true,
};

}   // namespace meshfolio::truth
