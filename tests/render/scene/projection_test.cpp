#include "scene/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/shapes.h"

namespace {

using render::Image;
using render::Placement;
using render::Projection;
using render::View;
using render_tests::Mesh;

TEST(Projections, SixViewsShareThree) {
    const auto projections = render::projections_of(render::six_views);
    ASSERT_EQ(projections.size(), 3U);
    for (const Projection& p : projections) {
        ASSERT_EQ(p.placements.size(), 2U);
        EXPECT_FALSE(p.placements[0].from_below);
        EXPECT_TRUE(p.placements[1].from_below);
        // Seen from the other side, one of the directions on the screen is turned round.
        const auto mirrors = [](const Placement& a, const Placement& b) {
            return (a.mirrored_x != b.mirrored_x) + (a.mirrored_y != b.mirrored_y);
        };
        EXPECT_EQ(mirrors(p.placements[0], p.placements[1]), 1);
    }
}

TEST(Projections, APlacementRestoresItsView) {
    std::vector<View> views(render::six_views.begin(), render::six_views.end());
    views.push_back(render::three_quarter_view());
    for (const Projection& p : render::projections_of(views))
        for (const Placement& placement : p.placements) {
            const View& view = views[placement.view];
            EXPECT_EQ((placement.mirrored_x ? -p.axes.across : p.axes.across) + 0.0, view.right() + 0.0);
            EXPECT_EQ((placement.mirrored_y ? -p.axes.up : p.axes.up) + 0.0, view.up + 0.0);
            EXPECT_EQ((placement.from_below ? -p.axes.depth : p.axes.depth) + 0.0, view.from + 0.0);
        }
}

TEST(Projections, AViewIsTheSameAloneAndWithOthers) {
    const Mesh mesh = render_tests::pebble();
    const render::DrawOptions options{.width = 150, .height = 131, .range = {nullptr, -300, 300}};
    const auto together = render::draw_views(mesh.surface(), render::six_views, options);
    for (std::size_t v = 0; v < together.size(); ++v) {
        const auto alone = render::draw_views(mesh.surface(), std::array{render::six_views[v]}, options);
        EXPECT_EQ(render_tests::differing_pixels(alone[0], together[v]), 0) << render::six_views[v].name;
    }
}

/// Every point exchanged with its mirror image at x = 0, triangles turned round so that they still face outwards.
Mesh mirrored(Mesh mesh) {
    for (glm::dvec3& p : mesh.positions) p.x = -p.x;
    for (glm::ivec3& t : mesh.triangles) std::swap(t.y, t.z);
    return mesh;
}

// Coverage is decided in the shared projection by a pattern that is its own mirror image; so the picture of the mirrored model is the
// mirrored picture, up to samples that lie on an edge, and up to the lights, which stay where they are.
TEST(Projections, AMirroredModelGivesTheMirroredPicture) {
    const Mesh mesh = render_tests::pebble(), turned = mirrored(mesh);
    for (const int samples : {1, 4, 16}) {
        render::DrawOptions options{.width = 180, .height = 180, .frame = render::Frame{{0, 0, 0}, 0.171}, .range = {nullptr, -300, 300}};
        options.shading = false, options.samples = samples;
        const auto a = render::draw_views(mesh.surface(), render::six_views, options);
        const auto b = render::draw_views(turned.surface(), render::six_views, options);
        // the values are those of the original vertices, so pictures seen along x are exchanged
        for (const auto& [from, to] : {std::pair{0, 1}, std::pair{1, 0}, std::pair{2, 2}, std::pair{5, 5}}) {
            Image flipped = b[static_cast<std::size_t>(to)];
            for (int y = 0; y < flipped.height; ++y) std::reverse(&flipped.at(0, y), &flipped.at(0, y) + flipped.width);
            EXPECT_LE(render_tests::differing_pixels(a[static_cast<std::size_t>(from)], flipped), 20)
                << from << ", " << samples << " samples";
        }
    }
}

TEST(ThreeQuarterView, LooksFromTheRightFrontAndAbove) {
    const View view = render::three_quarter_view();
    EXPECT_NEAR(glm::length(view.from), 1, 1e-12);
    EXPECT_NEAR(glm::length(view.up), 1, 1e-12);
    EXPECT_NEAR(glm::dot(view.from, view.up), 0, 1e-12);
    EXPECT_TRUE(view.from.x > 0.2 && view.from.y > 0.2 && view.from.z > 0.5);
    EXPECT_GT(view.up.y, 0.8);
}

}   // namespace
