#include "geometry/measures/local_thickness.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

/// Infinite where nothing is opposite.
double thickness_at(const Positions& X, const Positions& normals, Eigen::Index p) {
    const Eigen::RowVector3d at = X.row(p), n = normals.row(p);
    double smallest = std::numeric_limits<double>::infinity();
    for (Eigen::Index q = 0; q < X.rows(); ++q) {
        const Eigen::RowVector3d behind = at - X.row(q);
        const double depth = n.dot(behind);
        if (!(depth > 0) || !(n.dot(normals.row(q)) < 0.5)) continue;
        smallest = std::min(smallest, behind.squaredNorm() / depth);
    }
    return smallest;
}

}   // namespace

Vector local_thickness(const TriangleMesh& mesh, double most_pairs) {
    const Positions normals = vertex_normals(mesh);   // 0 at unreferenced vertices, which then lie on no side
    const Eigen::Index n = mesh.X.rows();
    const auto stride = static_cast<Eigen::Index>(std::ceil(std::max(1.0, double(n) * double(n) / most_pairs)));
    Vector thickness = Vector::Constant(n, std::nan(""));
    tbb::parallel_for(Eigen::Index{0}, (n + stride - 1) / stride, [&](Eigen::Index i) {
        const double t = thickness_at(mesh.X, normals, i * stride);
        if (std::isfinite(t)) thickness[i * stride] = t;
    });
    return thickness;
}

}   // namespace meshfolio
