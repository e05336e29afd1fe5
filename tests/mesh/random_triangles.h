/// @file
/// Triangles between random vertices: a few vertices give every kind of neighbourhood.
#pragma once

#include <random>

#include "mesh/triangle_mesh.h"

namespace meshfolio::testing {

/// Returns triangles of three different vertices each. Integers are drawn from the generator itself, as its numbers are the same
/// everywhere.
inline TriangleMesh random_triangles(int vertices, int triangles, unsigned seed) {
    std::mt19937 random(seed);
    const auto draw = [&] { return static_cast<int>(random() % static_cast<unsigned>(vertices)); };
    TriangleMesh mesh;
    mesh.X.resize(vertices, 3);
    for (double& x : mesh.X.reshaped()) x = static_cast<double>(random() % 4);
    mesh.F.resize(triangles, 3);
    for (int t = 0; t < triangles; ++t) {
        do {
            mesh.F.row(t) << draw(), draw(), draw();
        } while (mesh.F(t, 0) == mesh.F(t, 1) || mesh.F(t, 1) == mesh.F(t, 2) || mesh.F(t, 2) == mesh.F(t, 0));
    }
    return mesh;
}

}   // namespace meshfolio::testing
