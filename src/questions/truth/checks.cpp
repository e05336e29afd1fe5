// What the ground-truth panel must show, as named checks.
#include "questions/truth/parts.h"

namespace meshfolio::truth {

namespace {

using report::check_at_least;
using report::check_at_most;
using report::check_near;

/// One estimator on one surface in one kind of mesh.
struct Case {
    std::string surface;
    MeshKind kind;
    std::string key;

    std::string check(std::string_view message) const {
        const Estimator& measured = estimator(key);
        return curvature_words.line(message, "quantity"_a = symbol(measured.quantity), "estimator"_a = measured.name(),
                                    "kind"_a = name_of(kind), "surface"_a = surface);
    }
};

class Checker {
public:
    explicit Checker(const GroundTruth& truth) : truth_(truth) {}

    void regular_meshes() {
        const BenchLevel& sphere = truth_.run("sphere", MeshKind::regular).finest();
        add(check_near(curvature_words.line("check.pentagon"), pentagon_excess(), sphere.error("H.barycentric").linf,
                       0.25 * sphere.mean_edge * sphere.mean_edge, curvature_words.line("check.pentagon.note")));
        for (const char* surface : {"torus", "ellipsoid band"}) {
            for (const AreaForm form : area_forms) {
                for (const std::string& key : {H_with(form), K_with(form)}) {
                    const Case c{surface, MeshKind::regular, key};
                    add(check_near(c.check("check.order"), 2, order(c), truth_.quick ? 0.25 : 0.15));
                }
            }
            no_convergence({surface, MeshKind::regular, "H.uniform"});
        }
    }

    void random_meshes() {
        for (const char* surface : {"ellipsoid", "torus"}) {
            for (const char* key : {"H.barycentric", "H.barycentric_n", "K.barycentric", "H.mixed", "H.mixed_n", "K.mixed"})
                no_convergence({surface, MeshKind::random, key});
            const Case exact{surface, MeshKind::random, "H.corrected_exact"};
            add(check_at_least(exact.check("check.order"), 0.8, order(exact), 0, curvature_words.line("check.order.first")));
        }
        for (const char* surface : {"ellipsoid", "ellipsoid band"}) {
            for (const char* key : {"H.jet", "K.jet"}) {
                const Case jet{surface, MeshKind::random, key};
                add(check_at_least(jet.check("check.order"), 2, order(jet), 0.25, curvature_words.line("check.order.second")));
            }
        }
        const double identity = truth_.run("sphere", MeshKind::random).finest().error("H.voronoi_n").linf;
        add(check_at_most(curvature_words.line("check.sphere"), 0, identity, 1e-9));
    }

    void noisy_meshes() {
        for (const char* surface : {"ellipsoid", "torus"}) {
            const Case noisy{surface, MeshKind::noisy, "H.mixed"};
            add(check_near(noisy.check("check.order"), -1, order(noisy), 0.3, curvature_words.line("check.order.noisy")));
        }
    }

    /// Values found independently, with another program and other random points.
    void reference_ellipsoid() {
        const auto compare = [&](const char* key, double expected, double tolerance) {
            add(check_near(Case{"ellipsoid", MeshKind::random, key}.check("check.reference"), expected, truth_.reference.error(key).l2,
                           tolerance, curvature_words.line("check.reference.note")));
        };
        compare("H.barycentric", 0.28, 0.015);
        compare("H.mixed", 0.20, 0.015);
        compare("K.mixed", 0.18, 0.015);
        compare("H.jet", 0.0041, 0.0004);
        compare("K.jet", 0.0084, 0.0009);
        compare("H.corrected_exact", 0.014, 0.002);
        compare("H.corrected_max", 0.036, 0.003);
        compare("H.corrected_area", 0.22, 0.015);
    }

    std::vector<report::Check> checks() && { return std::move(checks_); }

private:
    const GroundTruth& truth_;
    std::vector<report::Check> checks_;

    void add(report::Check check) { checks_.push_back(std::move(check)); }

    ErrorHistory errors(const Case& c) const { return truth_.errors(c.surface, c.kind, c.key); }
    double order(const Case& c) const { return errors(c).order().exponent; }

    void no_convergence(const Case& c) {
        add(check_at_most(c.check("check.no_convergence.order"), truth_.quick ? 0.5 : 0.3, order(c)));
        add(check_at_least(c.check("check.no_convergence.error"), 0.05, errors(c).last()));
    }
};

}   // namespace

std::vector<report::Check> ground_truth_checks(const GroundTruth& truth) {
    Checker checker(truth);
    checker.regular_meshes();
    checker.random_meshes();
    checker.noisy_meshes();
    checker.reference_ellipsoid();
    return std::move(checker).checks();
}

}   // namespace meshfolio::truth
