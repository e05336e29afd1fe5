#include "geometry/denoising/noise_level.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/at.h"
#include "base/errors.h"
#include "geometry/curvature/two_rings.h"
#include "geometry/operators/uniform_laplacian.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

constexpr int coefficients = 6;                                          // of a quadratic in two variables
constexpr double lower_quartile = -0.674490, percentile_99 = 2.326348;   // of the normal distribution

struct Residual {
    double squares = 0;   // Σ r² [length²]
    int freedom = 0;      // points minus coefficients; 0: no fit
};

/// Returns the residual of a quadratic fitted to the heights of the points of X over the plane with this normal through the vertex, in
/// parameters from `plane`; freedom 0 if it cannot be fitted.
Residual residual_of_patch(const Positions& X, const Positions& plane, const std::vector<int>& patch, int vertex, const Vector3& normal) {
    const auto m = static_cast<Eigen::Index>(patch.size());
    if (m < coefficients + 2 || !(normal.squaredNorm() > 0)) return {};
    const Vector3 u = normal.unitOrthogonal(), v = normal.cross(u);
    Eigen::Matrix<double, Eigen::Dynamic, coefficients> A(m, coefficients);
    Vector height(m);
    double size = 0;
    for (Eigen::Index i = 0; i < m; ++i) size += (plane.row(patch[std::size_t(i)]) - plane.row(vertex)).squaredNorm();
    size = std::sqrt(size / static_cast<double>(m));
    if (!(size > 0)) return {};
    for (Eigen::Index i = 0; i < m; ++i) {
        const int point = patch[std::size_t(i)];
        const Vector3 along = (plane.row(point) - plane.row(vertex)) / size;
        const double a = along.dot(u), b = along.dot(v);
        A.row(i) << 1, a, b, a * a, a * b, b * b;
        height[i] = (X.row(point) - plane.row(vertex)).dot(normal);
    }
    Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, coefficients>> qr(A);
    qr.setThreshold(1e-6);
    if (qr.rank() < coefficients) return {};
    const Vector turned = qr.householderQ().adjoint() * height;
    return {turned.tail(m - coefficients).squaredNorm(), static_cast<int>(m) - coefficients};
}

struct Explained {
    double variance;   // of the noise in them [length²]
    int patches;
};

/// Returns the number of patches with residuals that noise of this variance explains, and the variance found from them; χ² cut off at its
/// 99th percentile has a smaller mean.
Explained explained_by(double variance, const std::vector<Residual>& residuals) {
    double squares = 0, freedom = 0;
    int kept = 0;
    for (const Residual& r : residuals) {
        const double limit = chi_square_quantile(percentile_99, r.freedom);
        if (!(r.squares <= variance * limit)) continue;
        squares += r.squares;
        freedom += r.freedom * chi_square_share(limit, r.freedom + 2) / chi_square_share(limit, r.freedom);
        ++kept;
    }
    return {squares / freedom, kept};
}

}   // namespace

double chi_square_quantile(double z, double k) { return k * std::pow(1 - 2 / (9 * k) + z * std::sqrt(2 / (9 * k)), 3); }

double chi_square_share(double x, double k) {
    const double z = (std::cbrt(x / k) - 1 + 2 / (9 * k)) / std::sqrt(2 / (9 * k));
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

NoiseLevel noise_level(const TriangleMesh& mesh, const MeshTopology& topology) {
    if (std::ssize(topology.vertex_faces.start) != mesh.vertex_count() + 1)
        throw MeshError("noise_level: a topology of " + std::to_string(std::ssize(topology.vertex_faces.start) - 1) +
                            " vertices for a mesh of " + std::to_string(mesh.vertex_count()),
                        "compute it from this mesh");
    const SparseMatrix U = uniform_laplacian(topology);
    Positions plane = mesh.X;   // after two half steps to the mean of the neighbours
    for (int step = 0; step < 2; ++step) plane += 0.5 * (U * plane);
    const Positions normals = vertex_normals(moved_to(mesh, plane));
    std::vector<Residual> residuals(at(mesh.vertex_count()));
    tbb::parallel_for(0, mesh.vertex_count(), [&](int v) {
        std::vector<int> patch;
        collect_two_rings(topology.neighbours, v, patch);
        residuals[at(v)] = residual_of_patch(mesh.X, plane, patch, v, normals.row(v));
    });
    std::erase_if(residuals, [](const Residual& r) { return r.freedom == 0; });

    NoiseLevel level{std::nan(""), static_cast<int>(residuals.size()), 0};
    if (residuals.empty()) return level;
    std::vector<double> ratios;   // the variance at which each residual is the lower quartile
    for (const Residual& r : residuals) ratios.push_back(r.squares / chi_square_quantile(lower_quartile, r.freedom));
    const auto quarter = ratios.begin() + std::ssize(ratios) / 4;
    std::nth_element(ratios.begin(), quarter, ratios.end());
    double variance = *quarter;
    for (int round = 0; round < 20; ++round) {
        const Explained next = explained_by(variance, residuals);
        if (next.patches == 0) break;
        level.kept = next.patches;
        const bool settled = std::abs(next.variance - variance) <= 1e-6 * variance;
        variance = next.variance;
        if (settled) break;
    }
    level.sigma = std::sqrt(variance);
    return level;
}

}   // namespace meshfolio
