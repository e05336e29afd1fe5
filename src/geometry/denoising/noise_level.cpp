#include "geometry/denoising/noise_level.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/errors.h"
#include "geometry/curvature/two_rings.h"
#include "geometry/operators/uniform_laplacian.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

constexpr int coefficients = 6;   // of a quadratic in two variables
// Of the normal distribution.
constexpr double lower_quartile = -0.674490, percentile_99 = 2.326348;

/// Two half steps to the mean of the neighbours.
Positions smoothed(Positions X, const MeshTopology& topology) {
    const SparseMatrix U = uniform_laplacian(topology);
    for (int step = 0; step < 2; ++step) X += 0.5 * (U * X);
    return X;
}

struct Residual {
    double squares = 0;   // Σ r² [length²]
    int freedom = 0;      // points less coefficients; 0: no fit
};

/// Of the heights of the points of `X` over the plane with that normal, over the parameters of the points of `plane`.
Residual residual_of_patch(const Positions& X, const Positions& plane, const std::vector<int>& patch, int vertex, const Vector3& normal) {
    const auto m = static_cast<Eigen::Index>(patch.size());
    if (m < coefficients + 2 || !(normal.squaredNorm() > 0)) return {};
    const Vector3 u = normal.unitOrthogonal(), v = normal.cross(u);
    Eigen::Matrix<double, Eigen::Dynamic, coefficients> A(m, coefficients);
    Vector height(m);
    double size = 0;
    for (Eigen::Index i = 0; i < m; ++i) size += (plane.row(patch[static_cast<std::size_t>(i)]) - plane.row(vertex)).squaredNorm();
    size = std::sqrt(size / static_cast<double>(m));
    if (!(size > 0)) return {};
    for (Eigen::Index i = 0; i < m; ++i) {
        const int point = patch[static_cast<std::size_t>(i)];
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

/// The variance of which a quarter of the patches have the lower quartile of the residual or less.
double variance_at_lower_quartile(const std::vector<Residual>& residuals) {
    std::vector<double> ratio;
    for (const Residual& r : residuals) ratio.push_back(r.squares / chi_square_quantile(lower_quartile, r.freedom));
    const auto quarter = ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 4);
    std::nth_element(ratio.begin(), quarter, ratio.end());
    return *quarter;
}

struct Explained {
    double variance;   // of the noise in them [length²]
    int patches;
};

/// The patches whose residual noise of that variance explains; χ² cut off at its 99th percentile has a smaller mean.
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
    if (topology.vertex_faces.start.size() != static_cast<std::size_t>(mesh.vertex_count()) + 1)
        throw MeshError("noise_level: the topology is of another mesh");
    const Positions plane = smoothed(mesh.X, topology), normals = vertex_normals(moved_to(mesh, plane));
    std::vector<Residual> residuals(static_cast<std::size_t>(mesh.vertex_count()));
    tbb::parallel_for(0, mesh.vertex_count(), [&](int v) {
        std::vector<int> patch;
        collect_two_rings(topology.neighbours, v, patch);
        residuals[static_cast<std::size_t>(v)] = residual_of_patch(mesh.X, plane, patch, v, normals.row(v));
    });
    std::erase_if(residuals, [](const Residual& r) { return r.freedom == 0; });

    NoiseLevel level{std::nan(""), static_cast<int>(residuals.size()), 0};
    if (residuals.empty()) return level;
    double variance = variance_at_lower_quartile(residuals);
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
