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
public:
    JetFitter(const TriangleMesh& mesh, const MeshTopology& topology, const Positions& normals)
        : mesh_(mesh), topology_(topology), normals_(normals) {}

    HK at(int v) {
        collect_two_rings(topology_.neighbours, v, points_);
        if (points_.size() < coefficients || !(normals_.row(v).squaredNorm() > 0)) return {};
        const double unit = read_points(v);
        if (!(unit > 0)) return {};
        qr_.compute(monomials_);
        qr_.setThreshold(determined_from);
        if (qr_.rank() < coefficients) return {};
        const Eigen::Matrix<double, coefficients, 1> a = qr_.solve(heights_);
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
        for (Eigen::Index i = 0; i < n; ++i) {
            local_.row(i) = (mesh_.X.row(points_[static_cast<std::size_t>(i)]) - mesh_.X.row(v)) * frame.transpose();
        }
        const double unit = local_.leftCols<2>().rowwise().norm().maxCoeff();
        if (!(unit > 0)) return 0;
        local_ /= unit;
        monomials_.resize(n, coefficients);
        for (Eigen::Index i = 0; i < n; ++i) {
            const double x = local_(i, 0), y = local_(i, 1);
            monomials_.row(i) << 1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y;
        }
        heights_ = local_.col(2);
        return unit;
    }

    const TriangleMesh& mesh_;
    const MeshTopology& topology_;
    const Positions& normals_;
    std::vector<int> points_;
    Positions local_;
    Eigen::Matrix<double, Eigen::Dynamic, coefficients> monomials_;
    Vector heights_;
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
