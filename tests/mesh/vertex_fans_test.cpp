#include <gtest/gtest.h>

#include <map>
#include <set>

#include "mesh/mesh_topology.h"
#include "mesh/random_triangles.h"
#include "mesh/small_meshes.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

/// The edges at v by their other ends, each with the numbers of triangles that run through it away from v and towards v.
struct SlowFan {
    std::map<int, std::array<int, 2>> edges;
    std::vector<std::array<int, 2>> triangles;   // next and previous vertex

    SlowFan(const TriangleMesh& mesh, int v) {
        for (int t = 0; t < mesh.face_count(); ++t) {
            for (int k = 0; k < 3; ++k) {
                if (mesh.F(t, k) != v) continue;
                const int next = mesh.F(t, (k + 1) % 3), previous = mesh.F(t, (k + 2) % 3);
                ++edges[next][0];
                ++edges[previous][1];
                triangles.push_back({next, previous});
            }
        }
    }

    /// Returns how many neighbours can be reached from the first one through triangles.
    std::size_t reach_of_first() const {
        std::set<int> reached;
        if (!edges.empty()) reached.insert(edges.begin()->first);
        for (std::size_t before = 0; before < reached.size();) {
            before = reached.size();
            for (const auto& [a, b] : triangles) {
                if (reached.contains(a) || reached.contains(b)) reached.insert({a, b});
            }
        }
        return reached.size();
    }

    template <class Condition> bool any_edge(Condition condition) const {
        return std::any_of(edges.begin(), edges.end(), [&](const auto& e) { return condition(e.second[0], e.second[1]); });
    }

    bool on_boundary() const {
        return any_edge([](int out, int in) { return out + in == 1; });
    }
    bool nonmanifold() const {
        return reach_of_first() < edges.size() || any_edge([](int out, int in) { return out + in > 2; });
    }
    bool regular() const {
        const bool one_way = !any_edge([](int out, int in) { return out > 1 || in > 1; });
        return !nonmanifold() && one_way && (edges.size() != 2 || on_boundary());
    }
};

void expect_true_fans(const TriangleMesh& mesh) {
    const Incidence around = triangles_around(mesh);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const SlowFan slow(mesh, v);
        const VertexFan fan = fan_around(mesh, around, v);
        EXPECT_EQ(fan.on_boundary, slow.on_boundary()) << v;
        EXPECT_EQ(fan.nonmanifold, slow.nonmanifold()) << v;
        EXPECT_EQ(fan.regular, slow.regular()) << v;
    }
}

/// n triangles round vertex 0.
TriangleMesh umbrella(int n) {
    std::vector<std::array<int, 3>> triangles;
    for (int i = 0; i < n; ++i) triangles.push_back({1 + i, 1 + (i + 1) % n, 0});
    TriangleMesh mesh = mesh_of({}, triangles);
    mesh.X = Positions::Zero(n + 1, 3);
    return mesh;
}

}   // namespace

TEST(VertexFans, FollowTheDefinitionsAmongRandomTriangles) {
    for (unsigned seed = 0; seed < 400; ++seed)
        expect_true_fans(random_triangles(4 + static_cast<int>(seed % 5), 3 + static_cast<int>(seed % 13), seed));
}

TEST(VertexFans, FollowTheDefinitionsOnSurfaces) {
    for (const TriangleMesh& mesh : {tetrahedron(), unit_cube(), torus(7, 5), flat_grid(4, 5), moebius_strip(7)}) expect_true_fans(mesh);
}

TEST(VertexFans, UmbrellasOfEverySizeAreRegular) {
    for (int n = 3; n <= 20; ++n) {
        const TriangleMesh mesh = umbrella(n);
        expect_true_fans(mesh);
        const Incidence around = triangles_around(mesh);
        EXPECT_TRUE(fan_around(mesh, around, 0).regular) << n;
    }
}

TEST(VertexFans, AnUmbrellaWithOneTriangleChangedIsNoUmbrella) {
    for (int n = 4; n <= 9; ++n) {
        for (int t = 0; t < n; ++t) {
            for (int k = 0; k < 2; ++k) {
                for (int v = 1; v <= n; ++v) {
                    TriangleMesh mesh = umbrella(n);
                    mesh.F(t, k) = v;
                    if (mesh.F(t, 0) != mesh.F(t, 1)) expect_true_fans(mesh);
                }
            }
        }
    }
}

TEST(VertexFans, TwoUmbrellasAtOneVertexAreNotOne) {
    for (int n = 3; n <= 5; ++n) {
        TriangleMesh two = joined(umbrella(n), umbrella(8 - n));
        for (int& v : two.F.reshaped()) v = v == n + 1 ? 0 : v;
        expect_true_fans(two);
        const Incidence around = triangles_around(two);
        EXPECT_TRUE(fan_around(two, around, 0).nonmanifold) << n;
    }
}
