// What the ground-truth panel must show, as named checks.
#include "questions/truth/parts.h"

namespace meshfolio::truth {

namespace {

/// One estimator on one surface in one kind of mesh.
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

/// Values found independently, with another program and other random points.
constexpr struct {
    const char* key;
    double expected, tolerance;
} references[]{{"H.barycentric", 0.28, 0.015},    {"H.mixed", 0.20, 0.015},         {"K.mixed", 0.18, 0.015},
               {"H.jet", 0.0041, 0.0004},         {"K.jet", 0.0084, 0.0009},        {"H.corrected_exact", 0.014, 0.002},
               {"H.corrected_max", 0.036, 0.003}, {"H.corrected_area", 0.22, 0.015}};

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

}   // namespace meshfolio::truth
