#include "scene/outline.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>

#include "render/shapes.h"

namespace {

using render_tests::Mesh;

/// Counts every edge in a map.
std::size_t boundary_by_counting(const Mesh& mesh) {
    std::map<std::pair<int, int>, int> count;
    for (const glm::ivec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) ++count[std::minmax(t[k], t[(k + 1) % 3])];
    std::size_t single = 0;
    for (const auto& [edge, n] : count) single += n == 1 ? 1 : 0;
    return single;
}

TEST(BoundaryEdges, ClosedSurfacesHaveNone) {
    EXPECT_TRUE(render::boundary_edges(render_tests::pebble().surface()).empty());
    EXPECT_TRUE(render::boundary_edges(render_tests::box({0, 0, 0}, {1, 1, 1}).surface()).empty());
}

TEST(BoundaryEdges, AreFoundForHolesAndInconsistentOrientation) {
    std::mt19937_64 random(1);
    for (int round = 0; round < 30; ++round) {
        Mesh mesh = render_tests::pebble();
        for (int i = 0; i < 40 * (round % 5); ++i)   // holes
            mesh.triangles.erase(mesh.triangles.begin() +
                                 render_tests::random_integer(random, 0, static_cast<std::int64_t>(mesh.triangles.size()) - 1));
        for (int i = 0; i < 10 * (round % 3); ++i) {   // inconsistent orientation
            glm::ivec3& t = mesh.triangles[static_cast<std::size_t>(
                render_tests::random_integer(random, 0, static_cast<std::int64_t>(mesh.triangles.size()) - 1))];
            std::swap(t.x, t.y);
        }
        const auto edges = render::boundary_edges(mesh.surface());
        ASSERT_EQ(edges.size(), boundary_by_counting(mesh)) << "round " << round;
        for (const render::BoundaryEdge& e : edges) {
            const glm::ivec3& t = mesh.triangles[static_cast<std::size_t>(e.triangle)];
            ASSERT_TRUE((t.x == e.a || t.y == e.a || t.z == e.a) && (t.x == e.b || t.y == e.b || t.z == e.b));
        }
    }
}

}   // namespace
