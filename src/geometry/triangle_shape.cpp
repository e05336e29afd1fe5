#include "geometry/triangle_shape.h"

#include <cmath>
#include <utility>

#include "mesh/parallel.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

TriangleShape triangle_shape(double l0, double l1, double l2) {
    TriangleShape shape;
    shape.squared_edge = {l0 * l0, l1 * l1, l2 * l2};
    for (std::size_t k = 0; k < 3; ++k) {
        shape.dot[k] = 0.5 * (shape.squared_edge[(k + 1) % 3] + shape.squared_edge[(k + 2) % 3] - shape.squared_edge[k]);
    }
    std::array<double, 3> sorted{l0, l1, l2};
    std::sort(sorted.begin(), sorted.end());
    const auto [c, b, a] = sorted;
    const double sixteen_area_squared = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    shape.cross = 0.5 * std::sqrt(std::max(0.0, sixteen_area_squared));
    return shape;
}

namespace {

double scale_of(double extent) {
    if (!(extent > 0) || !std::isfinite(extent)) return 1;
    return std::ldexp(1.0, -std::clamp(std::ilogb(extent), -1000, 1000));
}

}   // namespace

double unit_scale(const TriangleMesh& mesh) { return scale_of(bounding_box(mesh).extent().maxCoeff()); }

double unit_scale(const TriangleMesh& mesh, const Incidence& triangles) {
    if (mesh.face_count() == 0) return unit_scale(mesh);
    const Vector3 any = mesh.X.row(mesh.F(0, 0));
    const auto boxes = of_blocks(mesh.vertex_count(), [&](int begin, int end) {
        Vector3 low = any, high = any;
        for (int v = begin; v < end; ++v) {
            if (triangles.size(v) == 0) continue;
            low = low.cwiseMin(mesh.X.row(v).transpose());
            high = high.cwiseMax(mesh.X.row(v).transpose());
        }
        return std::pair(low, high);
    });
    Vector3 low = any, high = any;
    for (const auto& [box] : boxes) {
        low = low.cwiseMin(box.first);
        high = high.cwiseMax(box.second);
    }
    return scale_of((high - low).maxCoeff());
}

}   // namespace meshfolio
