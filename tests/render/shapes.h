/// @file
/// Small meshes and comparisons for the renderer's tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "draw_mesh.h"

namespace render_tests {

struct Mesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::ivec3> triangles;
    std::vector<double> values = {};

    render::Surface surface() const { return {positions, triangles, values}; }
};

/// n × n squares in the plane z = 0, over [−1, 1]², facing +z.
inline Mesh grid(int n) {
    Mesh mesh;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) mesh.positions.push_back({2.0 * i / n - 1, 2.0 * j / n - 1, 0});
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({a, d, c});
        }
    return mesh;
}

/// A box from `low` to `high` with eight vertices, outward facing.
inline Mesh box(const glm::dvec3& low, const glm::dvec3& high) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back({(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z});
    mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    return mesh;
}

/// A lumpy closed surface with integer coordinates in ±512, so that moving it far away stays exact.
inline Mesh pebble() {
    constexpr int rings = 24, sectors = 40;
    Mesh mesh;
    const auto at = [](double theta, double phi) {
        const double r = 400 + 60 * std::sin(3 * theta) * std::cos(2 * phi) + 40 * std::cos(5 * phi) * std::sin(theta);
        const glm::dvec3 p = r * glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta), 0.7 * std::sin(theta) * std::sin(phi));
        return glm::dvec3(std::round(p.x), std::round(p.y), std::round(p.z));
    };
    const double pi = std::acos(-1.0);
    mesh.positions.push_back(at(0, 0));
    for (int i = 1; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) mesh.positions.push_back(at(pi * i / rings, 2 * pi * j / sectors));
    mesh.positions.push_back(at(pi, 0));
    const auto vertex = [](int i, int j) {
        return i == 0 ? 0 : i == rings ? 1 + (rings - 1) * sectors : 1 + (i - 1) * sectors + j % sectors;
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            if (i > 0) mesh.triangles.push_back({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j)});
            if (i + 1 < rings) mesh.triangles.push_back({vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j)});
        }
    for (const glm::dvec3& p : mesh.positions) mesh.values.push_back(p.x + 0.5 * p.y);
    return mesh;
}

/// Uniform in [low, high], the same on every library.
inline std::int64_t random_integer(std::mt19937_64& random, std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(high - low + 1));
}

inline int differing_pixels(const render::Image& a, const render::Image& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] == b.pixels[i] ? 0 : 1;
    return count;
}

}   // namespace render_tests
