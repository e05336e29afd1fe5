#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/measures/local_thickness.h"
#include "questions/bench/spectral_uses.h"

namespace meshfolio {

namespace {

/// Vertices by ascending value; those without one are left out.
std::vector<int> ascending(const Vector& values) {
    std::vector<int> order;
    for (int v = 0; v < values.size(); ++v)
        if (std::isfinite(values[v])) order.push_back(v);
    std::ranges::stable_sort(order, {}, [&](int v) { return values[v]; });
    return order;
}

/// The first vertices of an order that hold `share` of its area.
std::vector<int> first_share(const std::vector<int>& order, const Vector& M, double share) {
    double whole = 0, sum = 0;
    for (const int v : order) whole += M[v];
    std::vector<int> first;
    for (const int v : order) {
        if (sum >= share * whole) break;
        sum += M[v];
        first.push_back(v);
    }
    return first;
}

double squared_sum(const std::vector<int>& vertices, const Vector& M, const Vector& distance) {
    double sum = 0;
    for (const int v : vertices) sum += M[v] * distance[v] * distance[v];
    return sum;
}

double rms_over(const std::vector<int>& vertices, const Vector& M, const Vector& distance) {
    double area = 0;
    for (const int v : vertices) area += M[v];
    return std::sqrt(squared_sum(vertices, M, distance) / area);
}

/// Spearman's coefficient of the ranks; ties in the order of the vertices.
double rank_correlation(const std::vector<int>& by_thickness, const Vector& error) {
    const auto n = static_cast<double>(by_thickness.size());
    std::vector<int> place(by_thickness.size()), by_error(by_thickness.size());
    std::iota(by_error.begin(), by_error.end(), 0);
    std::ranges::stable_sort(by_error, {}, [&](int i) { return error[by_thickness[i]]; });
    double sum = 0;
    for (std::size_t rank = 0; rank < by_error.size(); ++rank) {
        const double difference = static_cast<double>(rank) - by_error[rank];
        sum += difference * difference;
    }
    return 1 - 6 * sum / (n * (n * n - 1));
}

/// The share of the squared error on the tenth of the area that is farthest out.
double far_share(const SpectralStudy& study, const Vector& distance) {
    const Vector& M = study.laplacian.M;
    const Vector3 centroid = study.mesh().X.transpose() * M / M.sum();
    const Vector nearness = -(study.mesh().X.rowwise() - centroid.transpose()).rowwise().norm();
    return squared_sum(first_share(ascending(nearness), M, 0.1), M, distance) / M.dot(distance.cwiseAbs2());
}

double median_of(const std::vector<int>& ascending_vertices, const Vector& values) {
    return values[ascending_vertices[ascending_vertices.size() / 2]];
}

}   // namespace

LimbStudy limb_study(const SpectralStudy& study) {
    LimbStudy result;
    if (!study.source->prepared->preflight.closed()) return result;
    const Vector thickness = local_thickness(study.mesh());
    std::vector<int> order = ascending(thickness);
    std::erase_if(order, [&](int v) { return !(study.laplacian.M[v] > 0); });
    if (order.size() < 20) return result;
    const Vector& M = study.laplacian.M;
    const std::vector<int> thin = first_share(order, M, 0.25), thick = first_share({order.rbegin(), order.rend()}, M, 0.25);
    result.thin_diameter = median_of(thin, thickness);
    result.thick_diameter = median_of(thick, thickness);
    for (const Reconstruction& r : study.reconstructions) {
        if (r.predicted_rms < 1e-9 * study.diagonal) continue;
        result.errors.push_back({r.k, rms_over(thin, M, r.distance), rms_over(thick, M, r.distance), far_share(study, r.distance),
                                 rank_correlation(order, r.distance)});
    }
    return result;
}

}   // namespace meshfolio
