#include "geometry/curvature/jet_fit.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>
#include <vector>

#include "base/errors.h"
#include "base/parallel.h"
#include "geometry/curvature/two_rings.h"
#include "geometry/linear/special_values.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

constexpr int coefficients = 10;   // of a cubic in two variables

/// Pivots below this share of the largest say that the points lie near a common cubic.
constexpr double determined_from = 1e-6;

struct HK {
    double H = undefined, K = undefined;
};

/// z = f(x, y) with the derivatives of f at 0; upward normal, H > 0 where the surface bends away from it.
HK curvature_of_graph(double fx, double fy, double fxx, double fxy, double fyy) {
    const double W2 = 1 + fx * fx + fy * fy;
    return {-((1 + fy * fy) * fxx - 2 * fx * fy * fxy + (1 + fx * fx) * fyy) / (2 * W2 * std::sqrt(W2)),
            (fxx * fyy - fxy * fxy) / (W2 * W2)};
}

/// Axes of a plane and its normal, as rows.
Eigen::Matrix3d frame_of(const Vector3& normal) {
    Eigen::Matrix3d frame;
    frame.row(0) = normal.unitOrthogonal().transpose();
    frame.row(1) = normal.cross(frame.row(0).transpose()).transpose();
    frame.row(2) = normal.transpose();
    return frame;
}

class JetFitter {
    using Table = Eigen::Matrix<double, Eigen::Dynamic, coefficients + 1>;
    using Coefficients = Eigen::Matrix<double, coefficients, 1>;

public:
    JetFitter(const TriangleMesh& mesh, const MeshTopology& topology, const Positions& normals)
        : mesh_(mesh), topology_(topology), normals_(normals) {}

    HK at(int v) {
        collect_two_rings(topology_.neighbours, v, points_);
        if (points_.size() < coefficients || !(normals_.row(v).squaredNorm() > 0)) return {};
        const double unit = read_points(v);
        if (!(unit > 0)) return {};
        Coefficients a;
        if (!fitted(a)) {
            qr_.compute(table_.leftCols<coefficients>());
            qr_.setThreshold(determined_from);
            if (qr_.rank() < coefficients) return {};
            a = qr_.solve(table_.col(coefficients));
        }
        const HK scaled = curvature_of_graph(a[1], a[2], 2 * a[3], a[4], 2 * a[5]);
        return {scaled.H / unit, scaled.K / (unit * unit)};
    }

private:
    /// Monomials 1, x, y, x², xy, y², x³, x²y, xy², y³ and heights of the points in the frame of v, in the unit that is returned: the
    /// largest distance from v along the plane, so that no power of it leaves the range.
    double read_points(int v) {
        const Eigen::Matrix3d frame = frame_of(normals_.row(v).transpose());
        const auto n = static_cast<Eigen::Index>(points_.size());
        local_.resize(n, 3);
        for (Eigen::Index i = 0; i < n; ++i)
            local_.row(i) = (mesh_.X.row(points_[static_cast<std::size_t>(i)]) - mesh_.X.row(v)) * frame.transpose();
        const double unit = local_.leftCols<2>().rowwise().norm().maxCoeff();
        if (!(unit > 0)) return 0;
        local_ /= unit;
        table_.resize(n, coefficients + 1);
        for (Eigen::Index i = 0; i < n; ++i) {
            const double x = local_(i, 0), y = local_(i, 1);
            table_.row(i) << 1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y, local_(i, 2);
        }
        return unit;
    }

    /// The fit without pivots, which Eigen makes slow; false where it cannot be sure that pivots would find the points determined:
    /// their smallest is no less than the smallest singular value, and that no less than 1/‖R⁻¹‖.
    bool fitted(Coefficients& a) {
        reduced_ = table_;
        Eigen::Matrix<double, coefficients, coefficients> inverse;   // of R, upper triangle
        const double largest = reduced_.leftCols<coefficients>().colwise().squaredNorm().maxCoeff();
        for (int k = 0; k < coefficients; ++k) {
            const Eigen::Index below = reduced_.rows() - k;
            auto v = reduced_.col(k).tail(below);
            const double norm = v.norm();
            if (!(norm > 0)) return false;
            const double r = v[0] > 0 ? -norm : norm, scale = 1 / (norm * (norm + std::abs(v[0])));   // 2/|v|²
            v[0] -= r;
            for (int j = k + 1; j <= coefficients; ++j) {
                auto w = reduced_.col(j).tail(below);
                w -= scale * v.dot(w) * v;
            }
            inverse(k, k) = 1 / r;
            for (int i = 0; i < k; ++i)
                inverse(i, k) = -inverse(k, k) * inverse.row(i).segment(i, k - i).dot(reduced_.col(k).segment(i, k - i));
        }
        double squares = 0;
        for (int k = 0; k < coefficients; ++k) squares += inverse.col(k).head(k + 1).squaredNorm();
        if (!(squares * largest * determined_from * determined_from < 1)) return false;
        for (int i = 0; i < coefficients; ++i)
            a[i] = inverse.row(i).tail(coefficients - i).dot(reduced_.col(coefficients).segment(i, coefficients - i));
        return true;
    }

    const TriangleMesh& mesh_;
    const MeshTopology& topology_;
    const Positions& normals_;
    std::vector<int> points_;
    Positions local_;
    Table table_, reduced_;   // monomials of the points and their heights; the same as the fit leaves it
    Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, coefficients>> qr_;
};

}   // namespace

JetCurvature jet_curvature(const TriangleMesh& mesh, const MeshTopology& topology) {
    const int n = mesh.vertex_count();
    if (static_cast<int>(topology.nonmanifold.size()) != n) throw MeshError("jet_curvature: the topology is of another mesh");
    const Positions normals = vertex_normals(mesh);
    JetCurvature jets{Vector::Constant(n, undefined), Vector::Constant(n, undefined), 0};
    for_blocks(n, [&](int, int begin, int end) {
        JetFitter fitter(mesh, topology, normals);
        for (int v = begin; v < end; ++v) {
            if (topology.nonmanifold[static_cast<std::size_t>(v)]) continue;
            const HK jet = fitter.at(v);
            jets.H[v] = jet.H;
            jets.K[v] = jet.K;
        }
    });
    for (int v = 0; v < n; ++v) jets.unfitted += topology.vertex_faces.size(v) > 0 && std::isnan(jets.H[v]) ? 1 : 0;
    return jets;
}

}   // namespace meshfolio
