#include "geometry/measures/local_thickness.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "geometry/linear/special_values.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

Vector local_thickness(const TriangleMesh& mesh, double most_pairs) {
    const Positions normals = vertex_normals(mesh);   // 0 at unreferenced vertices, which then lie on no side
    const Eigen::Index n = mesh.X.rows();
    const auto stride = static_cast<Eigen::Index>(std::ceil(std::max(1.0, double(n) * double(n) / most_pairs)));
    Vector thickness = Vector::Constant(n, undefined);
    tbb::parallel_for(Eigen::Index{0}, (n + stride - 1) / stride, [&](Eigen::Index i) {
        const Eigen::Index p = i * stride;
        const Eigen::RowVector3d at = mesh.X.row(p), normal = normals.row(p);
        double smallest = infinity;
        for (Eigen::Index q = 0; q < n; ++q) {
            const Eigen::RowVector3d behind = at - mesh.X.row(q);
            const double depth = normal.dot(behind);
            if (!(depth > 0) || !(normal.dot(normals.row(q)) < 0.5)) continue;
            smallest = std::min(smallest, behind.squaredNorm() / depth);
        }
        if (std::isfinite(smallest)) thickness[p] = smallest;
    });
    return thickness;
}

}   // namespace meshfolio
