#include "geometry/operators/vertex_areas.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/errors.h"
#include "geometry/operator_test_meshes.h"

namespace meshfolio {
namespace {

using namespace testing;

constexpr AreaForm forms[] = {AreaForm::barycentric, AreaForm::voronoi, AreaForm::mixed};

TEST(VertexAreas, AddUpToTheSurface) {
    for (const TriangleMesh& mesh : {irregular_sphere(3), irregular_plane(12), torus_mesh(20, 9, 2, 0.7), cube_mesh(4), fan(5, 0.3)}) {
        for (const AreaForm form : forms) {
            EXPECT_NEAR(vertex_areas(mesh, form).sum() / surface_area(mesh), 1, 1e-12) << name_of(form);
        }
    }
}

TEST(VertexAreas, EquilateralTriangleGivesAThirdToEach) {
    const TriangleMesh mesh = triangle({0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0), 0});
    for (const AreaForm form : forms) {
        for (const double area : vertex_areas(mesh, form)) EXPECT_NEAR(area, std::sqrt(3.0) / 3, 1e-15) << name_of(form);
    }
}

TEST(VertexAreas, RightTriangleGivesHalfToItsRightAngle) {
    const TriangleMesh mesh = triangle({0, 0, 0}, {3, 0, 0}, {0, 4, 0});
    for (const AreaForm form : {AreaForm::voronoi, AreaForm::mixed}) {
        EXPECT_LT((vertex_areas(mesh, form) - Vector3(3, 1.5, 1.5)).norm(), 1e-14) << name_of(form);
    }
    EXPECT_LT((vertex_areas(mesh, AreaForm::barycentric) - Vector3(2, 2, 2)).norm(), 1e-14);
}

// Sides 1 and 1 around 120°, area √3/4: the circumcentre lies outside. Voronoi gives all to the obtuse corner and (−3/√3 + √3)/8 = 0 to
// the others; Meyer's rule gives ½, ¼, ¼.
TEST(VertexAreas, ObtuseTriangle) {
    const double A = std::sqrt(3.0) / 4;
    const TriangleMesh mesh = triangle({0, 0, 0}, {1, 0, 0}, {-0.5, std::sqrt(3.0) / 2, 0});
    EXPECT_LT((vertex_areas(mesh, AreaForm::voronoi) - Vector3(A, 0, 0)).norm(), 1e-15);
    EXPECT_LT((vertex_areas(mesh, AreaForm::mixed) - Vector3(A / 2, A / 4, A / 4)).norm(), 1e-15);
    const TriangleMesh flatter = triangle({0, 0, 0}, {1, 0, 0}, {-0.9, 0.2, 0});
    EXPECT_LT(vertex_areas(flatter, AreaForm::voronoi)[1], 0);
    EXPECT_GT(vertex_areas(flatter, AreaForm::mixed).minCoeff(), 0);
}

TEST(VertexAreas, ObtuseCornerIsFoundInAnyPlace) {
    const Vector3 tip(0, 0, 0), left(-1, 0.1, 0), right(1, 0.1, 0);
    const double A = 0.1;
    EXPECT_LT((vertex_areas(triangle(tip, left, right), AreaForm::mixed) - Vector3(A / 2, A / 4, A / 4)).norm(), 1e-15);
    EXPECT_LT((vertex_areas(triangle(right, tip, left), AreaForm::mixed) - Vector3(A / 4, A / 2, A / 4)).norm(), 1e-15);
    EXPECT_LT((vertex_areas(triangle(left, right, tip), AreaForm::mixed) - Vector3(A / 4, A / 4, A / 2)).norm(), 1e-15);
}

TEST(VertexAreas, AreIntrinsic) {
    const TriangleMesh mesh = irregular_sphere(3);
    for (const AreaForm form : forms) {
        const Vector from_lengths = vertex_areas(mesh.F, mesh.vertex_count(), edge_lengths(mesh), form);
        EXPECT_LT(largest_relative_difference(from_lengths, vertex_areas(mesh, form)), 1e-12) << name_of(form);
    }
}

TEST(VertexAreas, FollowMotionScaleAndOrder) {
    const TriangleMesh mesh = irregular_sphere(2);
    const Renamed shuffled = with_shuffled_vertices(mesh);
    for (const AreaForm form : forms) {
        const Vector A = vertex_areas(mesh, form);
        EXPECT_LT(largest_relative_difference(vertex_areas(rotated_and_moved(mesh), form), A), 1e-12);
        EXPECT_LT(largest_relative_difference(vertex_areas(scaled(mesh, 3), form), 9 * A), 1e-13);
        EXPECT_LT(largest_relative_difference(in_original_order(vertex_areas(shuffled.mesh, form), shuffled.name), A), 1e-14);
    }
}

TEST(VertexAreas, HugeAndTinyUnits) {
    const TriangleMesh mesh = irregular_sphere(1);
    for (const AreaForm form : forms) {
        const Vector A = vertex_areas(mesh, form);
        for (const double s : {1e100, 1e30, 1e-30, 1e-100}) {
            EXPECT_LT(largest_relative_difference(vertex_areas(scaled(mesh, s), form) / (s * s), A), 1e-13) << name_of(form) << " " << s;
        }
    }
}

TEST(VertexAreas, UnreferencedVerticesHaveNone) {
    TriangleMesh mesh = fan(6);
    mesh.X.conservativeResize(8, 3);
    mesh.X.row(7) << 1e90, 0, 0;
    for (const AreaForm form : forms) {
        EXPECT_EQ(vertex_areas(mesh, form)[7], 0);
        EXPECT_NEAR(vertex_areas(mesh, form).sum(), 1.5 * std::sqrt(3.0), 1e-14);
    }
}

TEST(VertexAreas, TrianglesWithoutAreaAddNothing) {
    for (const TriangleMesh& mesh : {triangle({0, 0, 0}, {1, 0, 0}, {3, 0, 0}), triangle({0, 0, 0}, {0, 0, 0}, {3, 0, 0}),
                                     triangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1}), triangle({0, 0, 0}, {1, 1e-14, 0}, {3, 0, 0})}) {
        for (const AreaForm form : forms) EXPECT_LT(vertex_areas(mesh, form).cwiseAbs().maxCoeff(), 1e-13) << name_of(form);
    }
}

// Two triangles with all corners at one vertex: the flat torus of a single square.
TEST(VertexAreas, GluedCornersAllCount) {
    const FlatTorus torus = flat_torus(1, 1, std::sqrt(2.0));
    for (const AreaForm form : forms) EXPECT_NEAR(vertex_areas(torus.F, 1, torus.lengths, form)[0], 1, 1e-15);
}

TEST(VertexAreas, NamesGoBothWays) {
    for (const AreaForm form : forms) EXPECT_EQ(area_form_named(std::string(name_of(form))), form);
    EXPECT_THROW(area_form_named("Voronoi"), UsageError);
    EXPECT_THROW(area_form_named(""), UsageError);
}

TEST(VertexAreas, RefusesSizesThatDoNotFit) {
    const TriangleMesh mesh = fan(5);
    CornerValues lengths = edge_lengths(mesh);
    EXPECT_THROW(vertex_areas(mesh.F, 5, lengths, AreaForm::mixed), MeshError);
    EXPECT_THROW(vertex_areas(mesh.F, 6, lengths.topRows(4), AreaForm::mixed), MeshError);
    lengths(2, 1) = -1;
    EXPECT_THROW(vertex_areas(mesh.F, 6, lengths, AreaForm::mixed), MeshError);
    lengths(2, 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(vertex_areas(mesh.F, 6, lengths, AreaForm::mixed), MeshError);
}

}   // namespace
}   // namespace meshfolio
