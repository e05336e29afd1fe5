#include "questions/bench/spectral_study.h"

#include <chrono>
#include <numeric>

#include "geometry/measures/local_thickness.h"
#include "geometry/operators/laplace_operator.h"
#include "geometry/spectrum/spectral_reconstruction.h"

namespace meshfolio {

namespace {

constexpr int all_modes_up_to = 700;   // vertices; on larger meshes the "large value" of k is 300

/// Returns the first vertices of an order, as many as hold `share` of its area.
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

/// Sums the area of the vertices with a distance above `limit`.
double area_beyond(const std::vector<int>& vertices, const Vector& M, const Vector& distance, double limit) {
    double area = 0;
    for (const int v : vertices) area += distance[v] > limit ? M[v] : 0;
    return area;
}

double median_of(const std::vector<int>& ascending_vertices, const Vector& values) {
    return values[ascending_vertices[ascending_vertices.size() / 2]];
}

}   // namespace

std::vector<int> mode_counts(const QuestionSettings& settings, int n) {
    std::vector<int> counts = settings.k;
    if (counts.empty()) {
        counts = settings.quick ? std::vector{5, 15, 60} : std::vector{5, 15, 30, 60, 150};
        if (!settings.quick) counts.push_back(n <= all_modes_up_to ? n : 300);
    }
    for (int& k : counts) k = std::clamp(k, 1, n);
    return each_once(counts);
}

SpectralStudy spectral_study(SharedMesh source, const QuestionSettings& settings) {
    SpectralStudy study;
    study.source = std::move(source);
    study.diagonal = bounding_box(study.mesh()).diagonal();
    study.laplacian = laplace_beltrami(study.mesh());
    const std::vector<int> counts = mode_counts(settings, study.vertices());
    const auto start = std::chrono::steady_clock::now();
    study.spectrum = smallest_eigenpairs(study.laplacian, counts.back());
    study.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    study.certificate = certify_spectrum(study.mesh(), study.laplacian, study.spectrum);
    const Positions& X = study.mesh().X;
    ReconstructionStream stream(study.laplacian.M, X);   // one pass over the modes for all k
    for (const int k : counts) {
        if (k > study.modes()) continue;
        const int done = stream.modes();
        stream.add(study.spectrum.eigenvectors.middleCols(done, k - done), study.spectrum.eigenvalues.segment(done, k - done));
        Reconstruction r;
        r.k = k;
        r.mesh = moved_to(study.mesh(), stream.positions());
        r.distance = (r.mesh.X - X).rowwise().norm();
        r.difference = compare_meshes(study.mesh(), r.mesh);
        study.reconstructions.push_back(std::move(r));
    }
    const int rest = study.modes() - stream.modes();   // if some vertices in use have no area
    stream.add(study.spectrum.eigenvectors.rightCols(rest), study.spectrum.eigenvalues.tail(rest));
    study.rms = stream.rms();
    for (Reconstruction& r : study.reconstructions) r.predicted_rms = study.rms[r.k];
    return study;
}

int smallest_k_below(const SpectralStudy& study, double share) {
    for (int k = 1; k <= study.modes(); ++k)
        if (study.rms[k] <= share * study.diagonal) return k;
    return 0;
}

double PowerLaw::at(double k) const { return factor * std::pow(k, -power); }

PowerLaw power_law(const SpectralStudy& study, int a, int b) {
    const Vector log_k = Vector::LinSpaced(b - a + 1, a, b).array().log(), log_rms = study.rms.segment(a, b - a + 1).array().log();
    const Vector dk = log_k.array() - log_k.mean();
    const double power = -dk.dot(log_rms) / dk.squaredNorm();
    PowerLaw law{a, b, std::exp(log_rms.mean() + power * log_k.mean()), power};
    for (int k = a; k <= b; ++k) law.deviation = std::max(law.deviation, std::exp(std::abs(std::log(study.rms[k] / law.at(k)))));
    return law;
}

std::optional<PowerLaw> fall_of_the_error(const SpectralStudy& study) {
    const int first = std::max(2, study.reconstructions.front().k);
    int last = std::min(study.modes(), study.vertices() / 2);
    while (last > first && !(study.rms[last] > 1e-9 * study.diagonal)) --last;
    if (last < first + 4) return {};
    return power_law(study, first, last);
}

double share_made_worse(const SpectralStudy& study, const Reconstruction& earlier, const Reconstruction& later) {
    const double rounding = 1e-9 * study.diagonal;
    return (later.distance.array() > earlier.distance.array() + rounding).cast<double>().mean();
}

int zero_modes(const SpectralStudy& study) { return static_cast<int>((study.spectrum.eigenvalues.array() == 0).count()); }

double wavelength(const SpectralStudy& study, int mode) {
    const double mu = study.spectrum.eigenvalues[mode - 1];
    return mu > 0 ? 2 * pi / std::sqrt(mu) : infinity;
}

Vector coefficient_sizes(const Spectrum& spectrum, const Vector& M, const Positions& X) {
    return spectral_coefficients(spectrum, M, X).rowwise().norm() / std::sqrt(M.sum());
}

double weyl_eigenvalue(double k, double area, double boundary) {
    const double root = (std::sqrt(boundary * boundary + 16 * pi * area * k) - boundary) / (2 * area);
    return root * root;
}

double weyl_eigenvalue(const SpectralStudy& study, int k) {
    double boundary = 0;
    for (const Edge& edge : study.topology().edges)
        if (edge.faces == 1) boundary += (study.mesh().X.row(edge.a) - study.mesh().X.row(edge.b)).norm();
    return weyl_eigenvalue(k, surface_area(study.mesh()), boundary);
}

double largest_parseval_gap(const SpectralStudy& study) {
    return largest_of(study.reconstructions, [](auto& r) { return std::abs(r.predicted_rms - r.difference.area_weighted_rms); });
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
