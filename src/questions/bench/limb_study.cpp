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

/// The area of those that are farther off than `limit`.
double area_beyond(const std::vector<int>& vertices, const Vector& M, const Vector& distance, double limit) {
    double area = 0;
    for (const int v : vertices) area += distance[v] > limit ? M[v] : 0;
    return area;
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
    const std::vector<int> thin = first_share(order, M, 0.25), thick = first_share({order.rbegin(), order.rend()}, M, 0.25),
                           thinner_half = first_share(order, M, 0.5);
    result.thin_diameter = median_of(thin, thickness);
    result.thick_diameter = median_of(thick, thickness);
    for (const Reconstruction& r : study.reconstructions) {
        if (r.predicted_rms < 1e-9 * study.diagonal) continue;
        const double limit = seen_error * study.diagonal;
        result.errors.push_back({r.k, rms_over(thin, M, r.distance), rms_over(thick, M, r.distance),
                                 area_beyond(thinner_half, M, r.distance, limit) / area_beyond(order, M, r.distance, limit)});
    }
    return result;
}

}   // namespace meshfolio
