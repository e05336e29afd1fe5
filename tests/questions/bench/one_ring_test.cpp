#include "questions/bench/one_ring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "geometry/curvature/curvature.h"
#include "geometry/linear/special_values.h"
#include "geometry/operators/cotangent_laplacian.h"
#include "mesh/samples/sample_shapes.h"

namespace meshfolio {
namespace {

using report::DiagramPoint;

/// Signed, by the shoelace formula.
double area_of(const std::vector<DiagramPoint>& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const DiagramPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        twice += p[0] * q[1] - p[1] * q[0];
    }
    return twice / 2;
}

double angle_between(DiagramPoint p, DiagramPoint q) { return std::atan2(p[0] * q[1] - p[1] * q[0], p[0] * q[0] + p[1] * q[1]); }

FlatRing ring_of(const SampleRing& sample) { return flat_ring(sample.mesh, sample.topology, sample.vertex); }

int obtuse_in(const FlatRing& ring) {
    int obtuse = 0;
    for (int t = 0; t < ring.triangles(); ++t) obtuse += is_obtuse(ring, t) ? 1 : 0;
    return obtuse;
}

const SampleRing flat_samples[]{obtuse_ring_in_a_plane(), uneven_ring_in_a_plane()};

TEST(FlatRing, GapEqualsTheAngleDeficit) {
    for (const SampleRing& sample : {ring_on_a_sphere(), obtuse_ring_in_a_plane(), uneven_ring_in_a_plane()})
        EXPECT_NEAR(ring_of(sample).gap(), angle_deficit(sample.mesh, sample.topology)[sample.vertex], 1e-12);
}

TEST(FlatRing, KeepsLengthsAndAnglesOfTheMesh) {
    const SampleRing sample = ring_on_a_sphere();
    const FlatRing ring = ring_of(sample);
    const std::vector<int> order = ring_in_order(sample.mesh, sample.topology, sample.vertex);
    ASSERT_EQ(ring.corners.size(), order.size() + 1);
    const auto edge = [&](std::size_t t) -> Vector3 {
        return (sample.mesh.X.row(order[t % order.size()]) - sample.mesh.X.row(sample.vertex)).transpose();
    };
    for (std::size_t t = 0; t < order.size(); ++t) {
        EXPECT_NEAR(std::hypot(ring.corners[t][0], ring.corners[t][1]), edge(t).norm(), 1e-12);
        EXPECT_NEAR(angle_between(ring.corners[t], ring.corners[t + 1]), std::acos(edge(t).normalized().dot(edge(t + 1).normalized())),
                    1e-12);
    }
}

// The drawn cell has the area that divides K, in each form, even if a circumcentre lies beyond its triangle.
TEST(Cells, AreasEqualVertexAreas) {
    for (const SampleRing& sample : flat_samples) {
        const FlatRing ring = ring_of(sample);
        for (const AreaForm form : {AreaForm::barycentric, AreaForm::voronoi, AreaForm::mixed}) {
            const double area = vertex_areas(sample.mesh, form)[sample.vertex];
            EXPECT_NEAR(area_of(cell_of(ring, form)), area, 1e-12) << name_of(form);
            double parts = 0;
            for (int t = 0; t < ring.triangles(); ++t) parts += area_of(cell_in_triangle(ring, t, form));
            EXPECT_NEAR(parts, area, 1e-12) << name_of(form);
        }
    }
}

TEST(Cells, MixedEqualsVoronoiWithoutObtuseTriangles) {
    const SampleRing &obtuse = flat_samples[0], &acute = flat_samples[1];
    EXPECT_EQ(obtuse_in(ring_of(obtuse)), 1);
    EXPECT_EQ(obtuse_in(ring_of(acute)), 0);
    EXPECT_EQ(cell_of(ring_of(acute), AreaForm::mixed), cell_of(ring_of(acute), AreaForm::voronoi));
    EXPECT_NE(cell_of(ring_of(obtuse), AreaForm::mixed), cell_of(ring_of(obtuse), AreaForm::voronoi));
}

TEST(OneRing, FindsTheSmallestAngleAtAnyCorner) {
    const TriangleMesh ball = icosphere(0);
    EXPECT_NEAR(smallest_angle_around(ball, topology_of(ball), 0), pi / 3, 1e-12);
    TriangleMesh needle;
    needle.X = Positions{{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}};
    needle.F = Faces{{0, 1, 2}};
    EXPECT_NEAR(smallest_angle_around(needle, topology_of(needle), 0), std::atan(0.1), 1e-12) << "at vertex 1";
}

// Question 3 explains with this why cotangents cancel the drift: w_ij (x_j − x_i) turned by 90° is a side of the Voronoi cell.
TEST(Cells, VoronoiSidesAreWeightedEdgesTurnedByAQuarter) {
    const SampleRing& sample = flat_samples[1];
    const FlatRing ring = ring_of(sample);
    const SparseMatrix C = laplace_beltrami(sample.mesh).C;
    const std::vector<int> order = ring_in_order(sample.mesh, sample.topology, sample.vertex);
    const int n = ring.triangles();
    for (int j = 0; j < n; ++j) {
        const DiagramPoint from = cell_in_triangle(ring, (j + n - 1) % n, AreaForm::voronoi)[2];
        const DiagramPoint to = cell_in_triangle(ring, j, AreaForm::voronoi)[2];
        const double weight = C.coeff(sample.vertex, order[static_cast<std::size_t>(j)]);
        const DiagramPoint edge = ring.corners[static_cast<std::size_t>(j)];
        EXPECT_NEAR(to[0] - from[0], -weight * edge[1], 1e-12);
        EXPECT_NEAR(to[1] - from[1], weight * edge[0], 1e-12);
    }
}

}   // namespace
}   // namespace meshfolio
