#include "scene/sight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <stdexcept>

#include "render/shapes.h"
#include "scene/hero.h"

namespace {

using glm::dvec3;
using render::Up;
using render::View;
using render_tests::Mesh;

constexpr std::array ups{Up::x, Up::y, Up::z};

void expect_near(const View& a, const View& b, double tolerance) {
    EXPECT_LE(glm::length(a.from - b.from), tolerance) << a.name;
    EXPECT_LE(glm::length(a.up - b.up), tolerance) << a.name;
}

TEST(ViewFrom, IsOrthonormalAndRightHandedForAllAngles) {
    for (const Up up : ups)
        for (int azimuth = -360; azimuth <= 720; azimuth += 15)
            for (int elevation = -90; elevation <= 90; elevation += 10)
                for (const double roll : {0.0, 90.0, -37.0}) {
                    const View view = render::view_from({double(azimuth), double(elevation), roll}, up);
                    ASSERT_NEAR(glm::length(view.from), 1, 1e-15);
                    ASSERT_NEAR(glm::length(view.up), 1, 1e-15);
                    ASSERT_NEAR(glm::dot(view.from, view.up), 0, 1e-15);
                    ASSERT_LT(glm::length(glm::cross(view.right(), view.up) - view.from), 4e-15);
                }
}

TEST(ViewFrom, StandsWhereTheAnglesSay) {
    expect_near(render::view_from({35, 22}), render::three_quarter_view(), 1e-15);
    for (const auto& [angles, up, from, top] : {std::tuple(render::Angles{0, 0}, Up::y, dvec3(0, 0, 1), dvec3(0, 1, 0)),
                                                {{90, 0}, Up::y, dvec3(1, 0, 0), dvec3(0, 1, 0)},
                                                {{0, 90}, Up::y, dvec3(0, 1, 0), dvec3(0, 0, -1)},
                                                {{0, -90}, Up::y, dvec3(0, -1, 0), dvec3(0, 0, 1)},
                                                {{0, 0}, Up::z, dvec3(0, -1, 0), dvec3(0, 0, 1)},
                                                {{90, 0}, Up::z, dvec3(1, 0, 0), dvec3(0, 0, 1)},
                                                {{0, 90}, Up::z, dvec3(0, 0, 1), dvec3(0, 1, 0)},
                                                {{0, 0}, Up::x, dvec3(0, 0, 1), dvec3(1, 0, 0)},
                                                {{90, 0}, Up::x, dvec3(0, -1, 0), dvec3(1, 0, 0)},
                                                {{0, 0, 90}, Up::y, dvec3(0, 0, 1), dvec3(-1, 0, 0)}}) {
        const View view = render::view_from(angles, up);
        EXPECT_EQ(view.from, from);
        EXPECT_EQ(view.up, top) << "a camera at right angles looks exactly along an axis";
        EXPECT_TRUE(view.is_along_axis());
    }
}

TEST(ViewFrom, RollTurnsTheCameraAnticlockwiseAboutItsDirection) {
    for (const double roll : {-100.0, 12.0, 90.0, 180.0}) {
        const View level = render::view_from({50, -20}), rolled = render::view_from({50, -20, roll});
        EXPECT_LT(glm::length(rolled.from - level.from), 1e-15);
        EXPECT_NEAR(glm::dot(rolled.up, level.up), std::cos(glm::radians(roll)), 1e-15);
        EXPECT_NEAR(glm::dot(rolled.up, level.right()), -std::sin(glm::radians(roll)), 1e-15) << "up turns to the left";
        expect_near(render::view_from({50, -20, roll + 360}), rolled, 1e-14);
    }
}

TEST(ViewNamed, KeepsTheDirectionAndHasTheAxisUpUnlessItLooksAlong) {
    for (const Up up : ups) {
        const dvec3 top = render::turned_to(up, {0, 1, 0});
        for (const View& plain : render::six_views) {
            const View view = render::view_named(std::string(plain.name), up);
            EXPECT_EQ(view.from, plain.from);
            EXPECT_EQ(glm::cross(view.right(), view.up), view.from) << view.name;
            const double above = glm::dot(view.from, top);
            EXPECT_EQ(view.up, above == 0 ? top : -above * render::turned_to(up, {0, 0, 1})) << view.name << ": the front is below";
            EXPECT_TRUE(up != Up::y || view == plain) << view.name;
        }
        expect_near(render::view_named("hero", up), render::view_from({35, 22}, up), 1e-15);
        EXPECT_THROW(render::view_named("camera", up), std::invalid_argument);
    }
}

TEST(TurnedTo, IsARotationThatPutsTheAxisUp) {
    for (const Up up : ups) {
        const dvec3 x = render::turned_to(up, {1, 0, 0}), y = render::turned_to(up, {0, 1, 0}), z = render::turned_to(up, {0, 0, 1});
        EXPECT_EQ(glm::cross(x, y), z);
        EXPECT_EQ(y, dvec3(up == Up::x, up == Up::y, up == Up::z));
        EXPECT_EQ(render::turned_to(up, {2, 3, 5}), 2.0 * x + 3.0 * y + 5.0 * z);
    }
}

TEST(TurnedTo, AModelTurnedWithItsAxisLooksTheSame) {
    const Mesh mesh = render_tests::pebble();
    for (const Up up : {Up::x, Up::z}) {
        Mesh turned = mesh;
        for (dvec3& p : turned.positions) p = render::turned_to(up, p);
        for (const render::Angles angles : {render::Angles{0, 0}, {90, 0}, {180, 0}, {0, 90}, {0, -90}, {270, 0, 90}}) {
            const View a = render::view_from(angles), b = render::view_from(angles, up);
            const render::DrawOptions options{.width = 120, .height = 100};
            EXPECT_EQ(render::draw_views(mesh.surface(), std::span(&a, 1), options)[0].pixels,
                      render::draw_views(turned.surface(), std::span(&b, 1), options)[0].pixels)
                << angles.azimuth << ' ' << angles.elevation;
        }
    }
}

/// A slab with a bump on the side that `bump` points to, y up.
Mesh slab(const dvec3& bump) {
    Mesh mesh = render_tests::pebble();
    for (dvec3& p : mesh.positions) {
        const double along = glm::dot(p, bump) / 400;
        p *= 1 + (along > 0.3 ? 0.15 * std::sin(0.05 * p.x) * std::sin(0.06 * p.y) * std::cos(0.05 * p.z) : 0);
    }
    return mesh;
}

TEST(HeroView, WithAnAxisUpIsThatOfTheTurnedModel) {
    for (const Mesh& mesh : {slab({0, 0, 1}), slab({-1, 0, 0}), slab({0, 0, -1}), Mesh{}}) {
        const View upright = render::hero_view(mesh.surface(), Up::y);
        for (const Up up : ups) {
            Mesh turned = mesh;
            for (dvec3& p : turned.positions) p = render::turned_to(up, p);
            const View view = render::hero_view(turned.surface(), up);
            EXPECT_NEAR(glm::dot(view.from, render::turned_to(up, {0, 1, 0})), std::sin(glm::radians(22.0)), 1e-12);
            expect_near(view, {"", render::turned_to(up, upright.from), render::turned_to(up, upright.up)}, 1e-12);
        }
    }
}

TEST(ViewOf, IsTheCameraElseTheHero) {
    const Mesh mesh = slab({-1, 0, 0});
    EXPECT_EQ(render::view_of({.camera = render::Angles{10, 20, 30}}, mesh.surface()), render::view_from({10, 20, 30}));
    EXPECT_EQ(render::view_of({.camera = render::Angles{10, 20}, .up = Up::z}, mesh.surface()), render::view_from({10, 20}, Up::z));
    EXPECT_EQ(render::view_of({.up = Up::z}, mesh.surface()), render::hero_view(mesh.surface(), Up::z));
    EXPECT_EQ(render::view_of({}, mesh.surface()), render::hero_view(mesh.surface()));
}

}   // namespace
