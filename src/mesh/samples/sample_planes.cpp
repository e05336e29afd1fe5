// Open surfaces over a square.
#include "mesh/edge_flips.h"
#include "mesh/samples/sample_parts.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/vertex_noise.h"

namespace meshfolio {

namespace {

double saddle_height(double x, double y) { return 0.5 * (x * x - y * y); }

}   // namespace

TriangleMesh saddle_sample(int subdivide) {
    TriangleMesh mesh = grid_mesh(33, 33, 2, 2);
    const auto onto_saddle = [](const Vector3& p) { return Vector3(p.x(), p.y(), saddle_height(p.x(), p.y())); };
    mesh.X.leftCols<2>().array() -= 1;
    for (int v = 0; v < mesh.vertex_count(); ++v) mesh.X.row(v) = onto_saddle(mesh.X.row(v));
    return subdivided_onto(mesh, subdivide, onto_saddle);
}

TriangleMesh uneven_plane_sample(int subdivide) {
    constexpr int points = 45;
    constexpr double spacing = 0.05, width = spacing * (points - 1), jitter = 0.25 * spacing;
    TriangleMesh mesh = grid_mesh(points, points, width, width);
    NormalNumbers random(45);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        for (int axis = 0; axis < 2; ++axis) {
            const double step = jitter * (2 * random.uniform() - 1);
            const int place = axis == 0 ? v % points : v / points;
            if (place > 0 && place + 1 < points) mesh.X(v, axis) += step;   // the outline stays a square
        }
    }
    mesh.F = delaunay_flipped(mesh);
    for (int i = 0; i < subdivide; ++i) mesh = subdivide_midpoint(mesh);
    return mesh;
}

}   // namespace meshfolio
