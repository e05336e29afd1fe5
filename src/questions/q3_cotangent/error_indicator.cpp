#include "questions/q3_cotangent/parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/curvature/curvature.h"
#include "geometry/curvature/jet_fit.h"
#include "questions/bench/ground_truth_meshes.h"

namespace meshfolio::q3_cotangent {

namespace {

/// Below this, mean curvature × mean edge is rounding and no scale to divide by.
constexpr double flat = 1e-6;

std::vector<double> descending_finite(const Vector& values) {
    std::vector<double> finite;
    std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](double v) { return std::isfinite(v); });
    std::sort(finite.rbegin(), finite.rend());
    return finite;
}

double sum_of_squares(const std::vector<double>& values, std::size_t first) {
    return std::accumulate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(first), 0.0,
                           [](double sum, double v) { return sum + v * v; });
}

/// Of the tenth of the vertices where `error` is largest, the share in the tenth where `indicator` is. Both without NaN.
double share_found(const Vector& error, const Vector& indicator) {
    const auto n = error.size();
    const std::size_t tenth = std::max<std::size_t>(1, static_cast<std::size_t>(n) / 10);
    const auto worst = [&](const Vector& values) {
        std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
        std::iota(order.begin(), order.end(), 0);
        const auto larger = [&](Eigen::Index a, Eigen::Index b) { return values[a] != values[b] ? values[a] > values[b] : a < b; };
        std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(tenth), order.end(), larger);
        order.resize(tenth);
        std::sort(order.begin(), order.end());
        return order;
    };
    const auto a = worst(error), b = worst(indicator);
    std::vector<Eigen::Index> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return double(both.size()) / double(tenth);
}

IndicatorTrial trial_on(std::string name, const TriangleMesh& mesh, const MeshTopology& topology, const Vector& truth,
                        const Vector& areas) {
    const Vector cotangent = cotangent_mean_curvature(mesh, topology, laplace_beltrami(mesh));
    const Vector jet = jet_curvature(mesh, topology).H;
    std::vector<Eigen::Index> both;
    for (Eigen::Index i = 0; i < truth.size(); ++i) {
        if (std::isfinite(cotangent[i]) && std::isfinite(jet[i])) both.push_back(i);
    }
    const Vector A = areas(both), H = truth(both);
    const Vector error = (cotangent(both) - H).cwiseAbs(), indicator = (cotangent(both) - jet(both)).cwiseAbs();
    const double scale = A.dot(H.cwiseAbs2());
    return {std::move(name), static_cast<int>(both.size()), std::sqrt(A.dot(indicator.cwiseAbs2()) / scale),
            std::sqrt(A.dot(error.cwiseAbs2()) / scale), share_found(error, indicator)};
}

}   // namespace

Disagreement disagreement_with_jet(const CotangentComparison& c) {
    const CurvatureSubject& s = c.subject;
    const Vector jet = jet_curvature(s.mesh(), s.topology()).H;
    Disagreement d;
    d.size = (c.cotangent - jet).cwiseAbs();
    double scale = 0;
    for (int i = 0; i < d.size.size(); ++i) {
        d.without_jet += s.inside(i) && std::isfinite(c.cotangent[i]) && !std::isfinite(jet[i]) ? 1 : 0;
        if (std::isfinite(d.size[i])) scale += c.cotangent[i] * c.cotangent[i];
    }
    const std::vector<double> sizes = descending_finite(d.size);
    if (sizes.empty()) return d;
    const double rms_H = std::sqrt(scale / double(sizes.size()));
    const double total = sum_of_squares(sizes, sizes.size());
    d.rms = rms_H * s.mean_edge > flat ? std::sqrt(total / double(sizes.size())) / rms_H : std::nan("");
    d.median = rms_H * s.mean_edge > flat ? sizes[sizes.size() / 2] / rms_H : std::nan("");
    d.concentration = total > 0 ? sum_of_squares(sizes, std::max<std::size_t>(1, sizes.size() / 100)) / total : 0;
    return d;
}

std::vector<IndicatorTrial> indicator_trials(const QuestionSettings& settings) {
    const int level = refinement_levels(settings.quick).back();
    std::vector<IndicatorTrial> trials;
    for (const Triangulation triangulation : {Triangulation::regular, Triangulation::jittered}) {
        for (const KnownSurface& surface : known_surfaces()) {
            const SampledSurface s = sampled(surface, level, triangulation, settings.seed);
            trials.push_back(trial_on(name_of(triangulation) + " " + surface.name, s.mesh, s.topology, s.H, s.areas));
        }
    }
    const TruthMesh random = random_ellipsoid({1.5, 1, 0.7}, settings.quick ? 2500 : 10000, settings.seed);
    trials.push_back(trial_on(words.line("trust.random"), random.mesh, random.topology, random.H, random.areas));
    return trials;
}

}   // namespace meshfolio::q3_cotangent
