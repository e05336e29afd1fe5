#include "geometry/operators/triangle_shape.h"

#include <cmath>

#include "mesh/triangle_measures.h"

namespace meshfolio {

TriangleShape triangle_shape(double l0, double l1, double l2) {
    TriangleShape shape;
    shape.squared_edge = {l0 * l0, l1 * l1, l2 * l2};
    for (std::size_t k = 0; k < 3; ++k)
        shape.dot[k] = 0.5 * (shape.squared_edge[(k + 1) % 3] + shape.squared_edge[(k + 2) % 3] - shape.squared_edge[k]);
    std::array<double, 3> sorted{l0, l1, l2};
    std::sort(sorted.begin(), sorted.end());
    const auto [c, b, a] = sorted;
    const double sixteen_area_squared = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    shape.cross = 0.5 * std::sqrt(std::max(0.0, sixteen_area_squared));
    return shape;
}

double unit_scale(const TriangleMesh& mesh) {
    const double extent = bounding_box(mesh).extent().maxCoeff();
    if (!(extent > 0) || !std::isfinite(extent)) return 1;
    return std::ldexp(1.0, -std::clamp(std::ilogb(extent), -1000, 1000));
}

}   // namespace meshfolio
