#include "geometry/curvature/jet_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "base/at.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "geometry/curvature/two_rings.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/coincident_vertices.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

constexpr int coefficients = 10;   // of a cubic in two variables

/// A smallest singular value below this share of the largest column means that the points lie near a common cubic.
constexpr double determined_from = 1e-6;

/// The residual r of the fit may change second derivatives by up to gain · |r|, where gain is the norm of their rows of the pseudoinverse:
/// 2 to 8 for two rings of even triangles, (length/width)² times that for thin ones. Thin samples of a larger gain are trusted if the
/// change is small: relative to the largest second derivative, or beside a bend by one radian over the sample.
constexpr double harmless_gain = 8, relative_error_at_most = 0.25, error_at_most = 0.05;

constexpr int most_rings = 3;

struct HK {
    double H = undefined, K = undefined;
};

/// Returns H and K of the graph z = f(x, y) from the derivatives of f; H > 0 where it bends away from its upward normal.
HK curvature_of_graph(double fx, double fy, double fxx, double fxy, double fyy) {
    const double W2 = 1 + fx * fx + fy * fy;
    return {-((1 + fy * fy) * fxx - 2 * fx * fy * fxy + (1 + fx * fx) * fyy) / (2 * W2 * std::sqrt(W2)),
            (fxx * fyy - fxy * fxy) / (W2 * W2)};
}

class JetFitter {
    using Table = Eigen::Matrix<double, Eigen::Dynamic, coefficients + 1>;
    using Square = Eigen::Matrix<double, coefficients, coefficients>;
    struct Fit {
        Eigen::Matrix<double, coefficients, 1> a;
        Vector3 spread;        // of 2a₃, a₄, 2a₅ for heights of length 1: norms of rows of the pseudoinverse
        double residual = 0;   // |r|
    };

public:
    JetFitter(const TriangleMesh& mesh, const MeshTopology& topology, const Positions& normals)
        : mesh_(mesh), topology_(topology), normals_(normals) {}

    /// Returns H and K at v from two rings as they are or, where that is not trusted, from samples scaled to a square with ever more rings.
    HK at(int v) {
        if (!(normals_.row(v).squaredNorm() > 0)) return {};
        collect_two_rings(topology_.neighbours, v, points_);
        for (int rings = 2; rings <= most_rings; ++rings) {
            if (rings > 2) add_next_ring(topology_.neighbours, points_);
            if (points_.size() < coefficients) continue;
            const double unit = read_points(v);
            if (!(unit > 0)) return {};
            HK jet = rings == 2 ? trusted_jet(1, 1) : HK{};
            if (std::isnan(jet.H)) jet = jet_of_scaled_sample();
            if (!std::isnan(jet.H)) return {jet.H / unit, jet.K / (unit * unit)};
        }
        return {};
    }

private:
    /// Sets the coordinates of the points in the frame of v and returns their unit, 0 if all lie on its normal, the largest distance from v
    /// along the plane, so that no power leaves the range.
    double read_points(int v) {
        const Vector3 normal = normals_.row(v).transpose();
        Eigen::Matrix3d frame;   // axes of the plane and its normal, as rows
        frame.row(0) = normal.unitOrthogonal().transpose();
        frame.row(1) = normal.cross(frame.row(0).transpose()).transpose();
        frame.row(2) = normal.transpose();
        const auto n = static_cast<Eigen::Index>(points_.size());
        local_.resize(n, 3);
        for (Eigen::Index i = 0; i < n; ++i) local_.row(i) = (mesh_.X.row(points_[std::size_t(i)]) - mesh_.X.row(v)) * frame.transpose();
        const double unit = local_.leftCols<2>().rowwise().norm().maxCoeff();
        if (!(unit > 0)) return 0;
        local_ /= unit;
        return unit;
    }

    Eigen::Matrix2d moments() const { return local_.leftCols<2>().transpose() * local_.leftCols<2>(); }
    /// True if the sample is less than half as wide as it is long: (λ_min/λ_max of its moments)^½ < ½.
    bool is_thin() const {
        const Eigen::Vector2d squared = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>().computeDirect(moments()).eigenvalues();
        return squared[0] < 0.25 * squared[1];
    }

    /// Returns H and K of the sample along its principal axes, scaled to a square: thin triangles hide no coefficient from the rank there.
    HK jet_of_scaled_sample() {
        Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
        axes.topLeftCorner<2, 2>() = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>().computeDirect(moments()).eigenvectors();
        local_ = (local_ * axes).eval();
        const double x = local_.col(0).cwiseAbs().maxCoeff(), y = local_.col(1).cwiseAbs().maxCoeff();
        return x > 0 && y > 0 ? trusted_jet(x, y) : HK{};
    }

    /// Returns H and K of the fit in x/x_unit and y/y_unit; NaN where it is not determined or not trusted.
    HK trusted_jet(double x_unit, double y_unit) {
        fill_table(x_unit, y_unit);
        Fit cubic;
        if (!fit(cubic)) return {};
        const auto& a = cubic.a;
        const Vector3 per_unit(1 / (x_unit * x_unit), 1 / (x_unit * y_unit), 1 / (y_unit * y_unit));
        const Vector3 second = Vector3(2 * a[3], a[4], 2 * a[5]).cwiseProduct(per_unit);
        const double gain = cubic.spread.cwiseProduct(per_unit).maxCoeff(), error = gain * cubic.residual;
        if (gain > harmless_gain && is_thin() && error > std::max(error_at_most, relative_error_at_most * second.cwiseAbs().maxCoeff()))
            return {};
        return curvature_of_graph(a[1] / x_unit, a[2] / y_unit, second[0], second[1], second[2]);
    }

    /// Fills the table with the monomials 1, x, y, x², xy, y², x³, x²y, xy², y³ and the heights.
    void fill_table(double x_unit, double y_unit) {
        table_.resize(local_.rows(), coefficients + 1);
        for (Eigen::Index i = 0; i < local_.rows(); ++i) {
            const double x = local_(i, 0) / x_unit, y = local_(i, 1) / y_unit;
            table_.row(i) << 1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y, local_(i, 2);
        }
    }

    /// Solves the least squares by modified Gram–Schmidt on the table, heights included, which becomes (Q, r); as stable as reflections
    /// (Björck 1967). Returns false where the points may not determine the fit: the smallest singular value of R is no less than 1/‖R⁻¹‖.
    bool fit(Fit& fit) {
        const double largest = table_.leftCols<coefficients>().colwise().squaredNorm().maxCoeff();
        Square inverse = Square::Zero();   // of R, upper triangle
        Eigen::Matrix<double, coefficients, coefficients + 1> R;
        for (int k = 0; k < coefficients; ++k) {
            auto q = table_.col(k);
            R(k, k) = q.norm();
            if (!(R(k, k) > 0)) return false;
            q /= R(k, k);
            for (int j = k + 1; j <= coefficients; ++j) {
                R(k, j) = q.dot(table_.col(j));
                table_.col(j) -= R(k, j) * q;
            }
            inverse(k, k) = 1 / R(k, k);
            for (int i = 0; i < k; ++i) inverse(i, k) = -inverse(k, k) * inverse.row(i).segment(i, k - i).dot(R.col(k).segment(i, k - i));
        }
        fit.a = inverse * R.col(coefficients);
        fit.residual = table_.col(coefficients).norm();
        fit.spread = Vector3(2 * inverse.row(3).norm(), inverse.row(4).norm(), 2 * inverse.row(5).norm());
        return inverse.squaredNorm() * largest * determined_from * determined_from < 1;
    }

    const TriangleMesh& mesh_;
    const MeshTopology& topology_;
    const Positions& normals_;
    std::vector<int> points_;
    Positions local_;
    Table table_;   // monomials of the points and their heights
};

/// Returns jet_curvature() of a mesh without coincident vertices.
JetCurvature jets_of(const TriangleMesh& mesh, const MeshTopology& topology) {
    const int n = mesh.vertex_count();
    const Positions normals = vertex_normals(mesh);
    JetCurvature jets{Vector::Constant(n, undefined), Vector::Constant(n, undefined)};
    for_blocks(n, [&](int, int begin, int end) {
        JetFitter fitter(mesh, topology, normals);
        for (int v = begin; v < end; ++v) {
            if (topology.nonmanifold[at(v)]) continue;
            const HK jet = fitter.at(v);
            jets.H[v] = jet.H;
            jets.K[v] = jet.K;
        }
    });
    return jets;
}

}   // namespace

JetCurvature jet_curvature(const TriangleMesh& mesh, const MeshTopology& topology) {
    if (std::ssize(topology.nonmanifold) != mesh.vertex_count())
        throw MeshError("jet_curvature: a topology of " + std::to_string(topology.nonmanifold.size()) + " vertices for a mesh of " +
                            std::to_string(mesh.vertex_count()),
                        "compute it from this mesh");
    const std::vector<VertexCopy> copies = coincident_vertices(mesh);
    const TriangleMesh joined = copies.empty() ? TriangleMesh() : with_joined_vertices(mesh, copies);
    JetCurvature jets = copies.empty() ? jets_of(mesh, topology) : jets_of(joined, topology_of(joined));
    spread(copies, jets.H);
    spread(copies, jets.K);
    return jets;
}

}   // namespace meshfolio
