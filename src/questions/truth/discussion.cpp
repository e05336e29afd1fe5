#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/truth/parts.h"

namespace meshfolio::truth {

namespace {

/// On which surfaces H from the cotangent formula converges on random points, one kind of area after the other.
std::string convergence_on_random_points(const GroundTruth& truth) {
    std::vector<std::string> told;
    for (const auto& [key, areas] : {std::pair{"barycentric", "barycentric"}, {"voronoi", "Voronoi"}, {"mixed", "mixed"}}) {
        std::vector<std::string> surfaces;
        for (const PanelRun* run : runs_of(truth, MeshKind::random))
            if (converges(truth, *run, key)) surfaces.push_back(run->surface);
        told.push_back(
            words.line(surfaces.empty() ? "random.nowhere" : "random.somewhere", "areas"_a = areas, "surfaces"_a = listed(surfaces)));
    }
    return listed(told);
}

report::Text about_other_estimators(const GroundTruth& truth) {
    int converging = 0, runs = 0;
    for (const PanelRun& run : truth.runs) {
        if (run.kind == MeshKind::noisy) continue;
        ++runs;
        converging += converges(truth, run, "jet") ? 1 : 0;
    }
    const auto told = [&](const char* key, Quantity quantity = Quantity::H) {
        return error_and_order(truth, "ellipsoid", MeshKind::random, quantity, key);
    };
    return words.say("other_estimators", "converging"_a = converging, "runs"_a = runs, "H"_a = told("jet"),
                     "K"_a = told("jet", Quantity::K), "exact"_a = told("corrected_exact"), "max"_a = told("corrected_max"),
                     "angle"_a = told("corrected_angle"), "area"_a = told("corrected_area"));
}

}   // namespace

void add_discussion(report::Section& section, const GroundTruth& truth) {
    using enum MeshKind;
    add_words(section, words, "discussion");
    const auto told = [&](const char* surface, MeshKind kind, const char* key, Quantity quantity = Quantity::H) {
        return error_and_order(truth, surface, kind, quantity, key);
    };
    add_paragraph(section,
                  words.say("regular", "mixed"_a = told("torus", regular, "mixed"), "K"_a = told("torus", regular, "mixed", Quantity::K),
                            "uniform"_a = told("torus", regular, "uniform")));
    const std::size_t mixed = estimator_index(Quantity::H, "mixed");
    const PanelRun& icosphere = truth.run("ellipsoid", regular);
    add_paragraph(section,
                  words.say("literally_regular", "mixed"_a = told("ellipsoid", regular, "mixed"),
                            "linf"_a = readable_percent(icosphere.finest(Quantity::H, mixed).linf, 2),
                            "linf_order"_a = words_of(truth.order(icosphere, Quantity::H, mixed, &EstimateError::linf)),
                            "band"_a = told("ellipsoid band", regular, "mixed"),
                            "pentagons"_a = readable_percent(truth.finest("sphere", regular, Quantity::H, "barycentric").linf, 3)));
    add_paragraph(
        section,
        words.say("random", "converging"_a = convergence_on_random_points(truth),
                  "barycentric"_a = told("ellipsoid", random, "barycentric"), "mixed"_a = told("ellipsoid", random, "mixed"),
                  "along_normal"_a = told("ellipsoid", random, "mixed_n"), "K"_a = told("ellipsoid", random, "mixed", Quantity::K)));
    add_paragraph(section, about_other_estimators(truth));
    add_paragraph(section, words.say("noisy", "mixed"_a = told("ellipsoid", noisy, "mixed"), "jet"_a = told("ellipsoid", noisy, "jet")));
}

}   // namespace meshfolio::truth
