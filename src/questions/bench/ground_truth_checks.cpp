// What the ground-truth panel must show, as named checks.
#include <cmath>

#include "questions/bench/ground_truth.h"

namespace meshfolio {

namespace {

using report::check_at_least;
using report::check_at_most;
using report::check_near;

/// Barycentric H of a flat regular pentagon cap over its true value, less 1.
double pentagon_excess() { return 3 / std::tan(54 * M_PI / 180) / (2 * std::sin(72 * M_PI / 180)) - 1; }

const std::string& estimator_name(Quantity quantity, const std::string& key) {
    return estimators_of(quantity)[estimator_index(quantity, key)].name;
}

class Checker {
public:
    explicit Checker(const GroundTruth& truth) : truth_(truth) {}

    void regular_meshes() {
        const PanelRun& sphere = truth_.run("sphere", MeshKind::regular);
        const double h = sphere.levels.back().mean_edge;
        add(check_near("barycentric H on the icosphere, L∞, stalls at 3 cot 54°/(2 sin 72°) − 1", pentagon_excess(),
                       sphere.finest(Quantity::H, estimator_index(Quantity::H, "barycentric")).linf, 0.25 * h * h,
                       "the tolerance is h²/4"));
        for (const char* surface : {"torus", "ellipsoid band"}) {
            for (const char* area : {"barycentric", "voronoi", "mixed"}) {
                second_order(surface, MeshKind::regular, Quantity::H, area);
                second_order(surface, MeshKind::regular, Quantity::K, area);
            }
            no_convergence(surface, MeshKind::regular, Quantity::H, "uniform");
        }
    }

    void random_meshes() {
        for (const char* surface : {"ellipsoid", "torus"}) {
            for (const char* area : {"barycentric", "mixed"}) {
                no_convergence(surface, MeshKind::random, Quantity::H, area);
                no_convergence(surface, MeshKind::random, Quantity::H, std::string(area) + "_n");
                no_convergence(surface, MeshKind::random, Quantity::K, area);
            }
            add(check_at_least(title("order", "corrected_exact", Quantity::H, surface, MeshKind::random), 0.8,
                               order(surface, MeshKind::random, Quantity::H, "corrected_exact"), 0, "theory says 1"));
        }
        for (const char* surface : {"ellipsoid", "ellipsoid band"}) {
            for (const Quantity quantity : {Quantity::H, Quantity::K}) {
                add(check_at_least(title("order", "jet", quantity, surface, MeshKind::random), 2,
                                   order(surface, MeshKind::random, quantity, "jet"), 0.25, "second order or better"));
            }
        }
        add(check_at_most("−½Δx·n with Voronoi areas and exact normals is 1/R at any points of a sphere, L∞", 0,
                          truth_.finest("sphere", MeshKind::random, Quantity::H, "voronoi_n").linf, 1e-9));
    }

    void noisy_meshes() {
        for (const char* surface : {"ellipsoid", "torus"}) {
            add(check_near(title("order", "mixed", Quantity::H, surface, MeshKind::noisy), -1,
                           order(surface, MeshKind::noisy, Quantity::H, "mixed"), 0.3,
                           "noise in proportion to h makes H worse as h falls"));
        }
    }

    /// Values found independently, with another program and other random points.
    void reference_ellipsoid() {
        const auto compare = [&](Quantity quantity, const char* key, double expected, double tolerance) {
            const auto& errors = quantity == Quantity::H ? truth_.reference.H : truth_.reference.K;
            add(check_near("L2 error of " + symbol(quantity) + ", " + estimator_name(quantity, key) +
                               ", 10 000 random points on the ellipsoid 1.5, 1, 0.7",
                           expected, errors[estimator_index(quantity, key)].l2, tolerance,
                           "expected: a reference whose half axes are inferred"));
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
    void add(report::Check check) { checks_.push_back(std::move(check)); }

    double order(const std::string& surface, MeshKind kind, Quantity quantity, const std::string& key) const {
        return truth_.order(surface, kind, quantity, key).order;
    }

    static std::string title(const char* what, const std::string& key, Quantity quantity, const std::string& surface, MeshKind kind) {
        return std::string(what) + " of " + symbol(quantity) + ", " + estimator_name(quantity, key) + ", " + std::string(name_of(kind)) +
               " " + surface + ", L2";
    }

    void second_order(const std::string& surface, MeshKind kind, Quantity quantity, const std::string& key) {
        add(check_near(title("order", key, quantity, surface, kind), 2, order(surface, kind, quantity, key), truth_.quick ? 0.25 : 0.15));
    }

    void no_convergence(const std::string& surface, MeshKind kind, Quantity quantity, const std::string& key) {
        add(check_at_most(title("no convergence: order", key, quantity, surface, kind), truth_.quick ? 0.5 : 0.3,
                          order(surface, kind, quantity, key)));
        add(check_at_least(title("no convergence: finest error", key, quantity, surface, kind), 0.05,
                           truth_.finest(surface, kind, quantity, key).l2));
    }

    const GroundTruth& truth_;
    std::vector<report::Check> checks_;
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
