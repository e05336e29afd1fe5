#include "questions/bench/spectral_uses.h"

#include "geometry/measures/local_thickness.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/spectrum/spectral_reconstruction.h"

namespace meshfolio {

namespace {

/// The two operators' modes at one k, four ways.
MistakeErrors mistakes_at(const SpectralStudy& study, const Spectrum& edge_normalised, const LaplaceBeltrami& other, int k) {
    const Positions& X = study.mesh().X;
    const Vector& M = study.laplacian.M;
    MistakeErrors row;
    row.k = k;
    row.right = vertex_rms(X, reconstruct(study.spectrum, M, X, k));
    row.unmapped = vertex_rms(X, reconstruct_unmapped(study.spectrum, M, X, k));
    row.unweighted = vertex_rms(X, reconstruct_unweighted(study.spectrum, M, X, k));
    const bool known = edge_normalised.eigenvalues.size() >= k;
    row.edge_normalised = known ? vertex_rms(X, reconstruct(edge_normalised, other.M, X, k)) : undefined;
    return row;
}

/// Returns no modes where negative or missing weights leave the operator without a spectrum.
Spectrum modes_if_any(const LaplaceBeltrami& laplacian, int k) try {
    return smallest_eigenpairs(laplacian, k);
} catch (const SolverError&) {
    return {};
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

double rms_over(const std::vector<int>& vertices, const Vector& M, const Vector& distance) {
    double squares = 0, area = 0;
    for (const int v : vertices) squares += M[v] * distance[v] * distance[v], area += M[v];
    return std::sqrt(squares / area);
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

std::vector<MistakeErrors> mistake_study(const SpectralStudy& study, bool quick) {
    const int most = std::min(study.modes(), study.spectrum.dense ? 150 : quick ? 30 : 60);
    std::vector<int> counts;
    for (const int k : {5, 10, 15, 30, 60, 150}) counts.push_back(std::min(k, most));
    const LaplaceBeltrami other = laplace_operator(study.mesh(), OperatorKind::edge_normalised);
    const Spectrum edge_normalised = modes_if_any(other, most);
    return each_of(each_once(counts), [&](const int k) { return mistakes_at(study, edge_normalised, other, k); });
}

LimbStudy limb_study(const SpectralStudy& study) {
    LimbStudy result;
    if (!study.preflight().closed()) return result;
    const Vector thickness = local_thickness(study.mesh());
    std::vector<int> order = where_finite(thickness, thickness);
    std::ranges::stable_sort(order, {}, [&](int v) { return thickness[v]; });
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
