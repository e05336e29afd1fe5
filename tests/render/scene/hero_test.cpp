#include "scene/hero.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>

#include "render/shapes.h"

namespace {

using render::View;
using render_tests::Mesh;

/// A wide body with a bumpy face high up on the side towards +z.
Mesh figure() {
    Mesh mesh = render_tests::pebble();
    for (glm::dvec3& p : mesh.positions) {
        const bool is_face = p.z > 0 && p.y > 0;
        p *= 1 + (is_face ? 0.12 * std::sin(0.05 * p.x) * std::sin(0.06 * p.y) : 0);
    }
    return mesh;
}

Mesh moved(Mesh mesh, const std::function<glm::dvec3(const glm::dvec3&)>& move) {
    for (glm::dvec3& p : mesh.positions) p = move(p);
    return mesh;
}

/// Half an ellipsoid, open towards −z.
Mesh shell() {
    Mesh mesh = render_tests::grid(24);
    for (glm::dvec3& p : mesh.positions) p.z = 0.4 * (2 - p.x * p.x - p.y * p.y);
    return mesh;
}

/// A long body with a head at one end, symmetric about z = 0, y up.
Mesh animal() {
    Mesh mesh = render_tests::box({-2, 0, -0.5}, {2, 1, 0.5});
    const Mesh head = render_tests::box({2, 1, -0.3}, {2.8, 1.8, 0.3});
    for (const glm::ivec3& t : head.triangles) mesh.triangles.push_back(t + 8);
    mesh.positions.insert(mesh.positions.end(), head.positions.begin(), head.positions.end());
    for (int round = 0; round < 5; ++round) {   // into small triangles
        std::vector<glm::ivec3> parts;
        for (const glm::ivec3& t : mesh.triangles) {
            const auto middle = [&](int a, int b) {
                mesh.positions.push_back(0.5 * (mesh.positions[static_cast<std::size_t>(a)] + mesh.positions[static_cast<std::size_t>(b)]));
                return static_cast<int>(mesh.positions.size()) - 1;
            };
            const int x = middle(t.x, t.y), y = middle(t.y, t.z), z = middle(t.z, t.x);
            parts.insert(parts.end(), {{t.x, x, z}, {x, t.y, y}, {z, y, t.z}, {x, y, z}});
        }
        mesh.triangles = parts;
    }
    return mesh;
}

void expect_same(const View& a, const View& b) {
    EXPECT_LT(glm::length(a.from - b.from), 1e-12);
    EXPECT_LT(glm::length(a.up - b.up), 1e-12);
}

TEST(HeroView, IsTheUsualViewUnlessAnotherShowsMore) {
    for (const Mesh& mesh : {render_tests::box({-1, -1, -1}, {1, 1, 1}), render_tests::pebble(), render_tests::grid(4), Mesh{}})
        expect_same(render::hero_view(mesh.surface()), render::three_quarter_view());
}

TEST(HeroView, ShowsTheFrontOfAnOpenSurface) {
    EXPECT_GT(render::hero_view(shell().surface()).from.z, 0.3);
    const Mesh behind = moved(shell(), [](const glm::dvec3& p) { return glm::dvec3(-p.x, p.y, -p.z); });
    EXPECT_LT(render::hero_view(behind.surface()).from.z, -0.3);
}

TEST(HeroView, PutsZUpForModelsThatStandOnZ) {
    expect_same({"", render::hero_view(animal().surface()).from, {}}, {"", render::three_quarter_view().from, {}});
    const Mesh lying = moved(animal(), [](const glm::dvec3& p) { return glm::dvec3(p.x, -p.z, p.y); });
    EXPECT_GT(render::hero_view(lying.surface()).up.z, 0.8);
}

TEST(HeroView, DependsNeitherOnOrderNorOnScale) {
    for (const Mesh& mesh : {figure(), animal(), moved(shell(), [](const glm::dvec3& p) { return -p; })}) {
        const View view = render::hero_view(mesh.surface());
        for (const double scale : {1e-9, 0.37, 1e12})
            expect_same(view, render::hero_view(moved(mesh, [&](const glm::dvec3& p) { return scale * p; }).surface()));
        Mesh shuffled = mesh;
        std::mt19937_64 random(3);
        std::vector<int> place(mesh.positions.size());
        std::iota(place.begin(), place.end(), 0);
        std::shuffle(place.begin(), place.end(), random);
        std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), random);
        for (std::size_t i = 0; i < place.size(); ++i) shuffled.positions[static_cast<std::size_t>(place[i])] = mesh.positions[i];
        for (glm::ivec3& t : shuffled.triangles)
            t = {place[static_cast<std::size_t>(t.y)], place[static_cast<std::size_t>(t.z)], place[static_cast<std::size_t>(t.x)]};
        expect_same(view, render::hero_view(shuffled.surface()));
    }
}

TEST(HeroView, IsOneOfEightUprightViewsForAnySurface) {
    for (const Mesh& mesh :
         {figure(), moved(figure(), [](const glm::dvec3& p) { return glm::dvec3(-p.x, p.y, -p.z); }), shell(), animal()}) {
        const View view = render::hero_view(mesh.surface());
        EXPECT_EQ(view.name, "hero");
        EXPECT_NEAR(glm::length(view.from), 1, 1e-12);
        EXPECT_NEAR(glm::dot(view.from, view.up), 0, 1e-12);
        EXPECT_NEAR(view.from.y, render::three_quarter_view().from.y, 1e-12);
        const double azimuth = std::abs(std::atan2(view.from.x, view.from.z)) * 180 / std::acos(-1.0),
                     to_axis = std::min(std::fmod(azimuth, 90), 90 - std::fmod(azimuth, 90));
        EXPECT_NEAR(to_axis, 35, 1e-9);
    }
}

}   // namespace
