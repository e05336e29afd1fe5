#include "scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "render/shapes.h"

namespace {

TEST(CanBeDrawn, ATriangleNeedsThreeFiniteCorners) {
    const std::vector<glm::dvec3> good = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_TRUE(render::can_be_drawn({0, 1, 2}, good));
    for (int corner = 0; corner < 3; ++corner) {
        for (const int outside : {-1, 3}) {
            glm::ivec3 triangle{0, 1, 2};
            triangle[corner] = outside;
            EXPECT_FALSE(render::can_be_drawn(triangle, good)) << corner << " " << outside;
        }
        for (int axis = 0; axis < 3; ++axis) {
            for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
                std::vector<glm::dvec3> bad = good;
                bad[static_cast<std::size_t>(corner)][axis] = value;
                EXPECT_FALSE(render::can_be_drawn({0, 1, 2}, bad)) << corner << " " << axis << " " << value;
            }
        }
    }
}

TEST(Views, RightUpAndFromAreARightHandedSystem) {
    for (const render::View& v : render::six_views) {
        EXPECT_EQ(glm::cross(v.right(), v.up), v.from) << v.name;
        EXPECT_EQ(glm::length(v.right()), 1) << v.name;
    }
}

TEST(Views, AreFoundByNameAndListedInTheErrorForAnUnknownName) {
    EXPECT_EQ(render::view_named("-y").up, glm::dvec3(0, 0, 1));
    try {
        render::view_named("top");
        FAIL();
    } catch (const std::invalid_argument& error) {
        for (const render::View& v : render::six_views) EXPECT_NE(std::string(error.what()).find(v.name), std::string::npos);
    }
}

TEST(Bounds, IgnoreTrianglesThatCannotBeDrawn) {
    render_tests::Mesh mesh = render_tests::box({-1, 2, 3}, {4, 5, 6});
    mesh.positions.push_back({100, 100, 100});            // in no triangle
    mesh.positions.push_back({std::nan(""), 1e9, 1e9});   // not finite
    mesh.triangles.push_back({0, 1, 9});
    mesh.triangles.push_back({0, 8, 77});
    const render::Bounds b = render::bounds_of(mesh.positions, mesh.triangles);
    EXPECT_EQ(b.low, glm::dvec3(-1, 2, 3));
    EXPECT_EQ(b.high, glm::dvec3(4, 5, 6));
    EXPECT_EQ(render::bounds_of({}, {}).high, glm::dvec3(0));
    mesh = render_tests::box({-1, 2, 3}, {4, 5, 6});
    mesh.positions.push_back({0, 3, 7});   // finite, farther than all on one side, and in no triangle
    EXPECT_EQ(render::bounds_of(mesh.positions, mesh.triangles).high, glm::dvec3(4, 5, 6));
}

TEST(FrameOf, TheLargestExtentFillsTheShorterSide) {
    const render::Frame frame = render::frame_of({{0, 0, 0}, {1, 5, 2}}, 300, 200, 0.9);
    EXPECT_DOUBLE_EQ(frame.pixels_per_unit * 5, 0.9 * 200);
    EXPECT_EQ(frame.centre, glm::dvec3(0.5, 2.5, 1));
}

TEST(FrameOf, IsFiniteForPointsAndForAllOfDouble) {
    const double most = std::numeric_limits<double>::max();
    for (const render::Bounds& b : {render::Bounds{{1, 1, 1}, {1, 1, 1}}, render::Bounds{glm::dvec3(-most), glm::dvec3(most)},
                                    render::Bounds{{0, 0, 0}, {5e-324, 0, 0}}, render::Bounds{{0, 0, 0}, {1e-310, 0, 0}}}) {
        const render::Frame frame = render::frame_of(b, 100, 100, 1);
        EXPECT_TRUE(std::isfinite(frame.pixels_per_unit) && frame.pixels_per_unit > 0);
        EXPECT_TRUE(std::isfinite(frame.centre.x));
    }
}

}   // namespace
