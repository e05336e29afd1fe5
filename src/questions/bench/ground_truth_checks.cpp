// What the ground-truth panel must show, as named checks.
#include "questions/bench/cotangent_study.h"
#include "questions/bench/ground_truth.h"

namespace meshfolio {

namespace {

using report::check_at_least;
using report::check_at_most;
using report::check_near;

/// One estimator on one surface in one kind of mesh.
struct Case {
    std::string surface;
    MeshKind kind;
    Quantity quantity;
    std::string key;

    std::string estimator() const { return estimators_of(quantity)[estimator_index(quantity, key)].name(); }
    std::string check(std::string_view message) const {
        return curvature_words.line(message, "quantity"_a = symbol(quantity), "estimator"_a = estimator(), "kind"_a = name_of(kind),
                                    "surface"_a = surface);
    }
};

class Checker {
public:
    explicit Checker(const GroundTruth& truth) : truth_(truth) {}

    void regular_meshes() {
        const PanelRun& sphere = truth_.run("sphere", MeshKind::regular);
        const double h = sphere.levels.back().mean_edge;
        add(check_near(curvature_words.line("check.pentagon"), pentagon_excess(),
                       sphere.finest(Quantity::H, estimator_index(Quantity::H, "barycentric")).linf, 0.25 * h * h,
                       curvature_words.line("check.pentagon.note")));
        for (const char* surface : {"torus", "ellipsoid band"}) {
            for (const char* area : {"barycentric", "voronoi", "mixed"}) {
                for (const Quantity quantity : {Quantity::H, Quantity::K}) {
                    const Case c{surface, MeshKind::regular, quantity, area};
                    add(check_near(c.check("check.order"), 2, order(c), truth_.quick ? 0.25 : 0.15));
                }
            }
            no_convergence({surface, MeshKind::regular, Quantity::H, "uniform"});
        }
    }

    void random_meshes() {
        for (const char* surface : {"ellipsoid", "torus"}) {
            for (const std::string area : {"barycentric", "mixed"}) {
                no_convergence({surface, MeshKind::random, Quantity::H, area});
                no_convergence({surface, MeshKind::random, Quantity::H, area + "_n"});
                no_convergence({surface, MeshKind::random, Quantity::K, area});
            }
            const Case exact{surface, MeshKind::random, Quantity::H, "corrected_exact"};
            add(check_at_least(exact.check("check.order"), 0.8, order(exact), 0, curvature_words.line("check.order.first")));
        }
        for (const char* surface : {"ellipsoid", "ellipsoid band"}) {
            for (const Quantity quantity : {Quantity::H, Quantity::K}) {
                const Case jet{surface, MeshKind::random, quantity, "jet"};
                add(check_at_least(jet.check("check.order"), 2, order(jet), 0.25, curvature_words.line("check.order.second")));
            }
        }
        add(check_at_most(curvature_words.line("check.sphere"), 0, truth_.finest("sphere", MeshKind::random, Quantity::H, "voronoi_n").linf,
                          1e-9));
    }

    void noisy_meshes() {
        for (const char* surface : {"ellipsoid", "torus"}) {
            const Case noisy{surface, MeshKind::noisy, Quantity::H, "mixed"};
            add(check_near(noisy.check("check.order"), -1, order(noisy), 0.3, curvature_words.line("check.order.noisy")));
        }
    }

    /// Values found independently, with another program and other random points.
    void reference_ellipsoid() {
        const auto compare = [&](Quantity quantity, const char* key, double expected, double tolerance) {
            const auto& errors = quantity == Quantity::H ? truth_.reference.H : truth_.reference.K;
            add(check_near(Case{"ellipsoid", MeshKind::random, quantity, key}.check("check.reference"), expected,
                           errors[estimator_index(quantity, key)].l2, tolerance, curvature_words.line("check.reference.note")));
        };
        compare(Quantity::H, "barycentric", 0.28, 0.015);
        compare(Quantity::H, "mixed", 0.20, 0.015);
        compare(Quantity::K, "mixed", 0.18, 0.015);
        compare(Quantity::H, "jet", 0.0041, 0.0004);
        compare(Quantity::K, "jet", 0.0084, 0.0009);
        compare(Quantity::H, "corrected_exact", 0.014, 0.002);
        compare(Quantity::H, "corrected_max", 0.036, 0.003);
        compare(Quantity::H, "corrected_area", 0.22, 0.015);
    }

    std::vector<report::Check> checks() && { return std::move(checks_); }

private:
    const GroundTruth& truth_;
    std::vector<report::Check> checks_;

    void add(report::Check check) { checks_.push_back(std::move(check)); }

    double order(const Case& c) const { return truth_.order(c.surface, c.kind, c.quantity, c.key).order; }

    void no_convergence(const Case& c) {
        add(check_at_most(c.check("check.no_convergence.order"), truth_.quick ? 0.5 : 0.3, order(c)));
        add(check_at_least(c.check("check.no_convergence.error"), 0.05, truth_.finest(c.surface, c.kind, c.quantity, c.key).l2));
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

}   // namespace meshfolio
