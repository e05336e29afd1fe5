/// @file
/// The triangles around a vertex as it sees them: whether they form one fan, and which vertices lie around.
#pragma once

#include <vector>

#include "mesh/disjoint_sets.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

struct FanFacts {
    bool on_boundary = false;   // an edge at v has one triangle
    bool nonmanifold = false;   // an edge at v has more than two, or the triangles form more than one fan
    bool regular = true;        // one fan (or none) of different triangles that all run round v the same way
};

/// Looks at the vertices of a mesh, one after the other. Nearly all are umbrellas: up to eight triangles that form one closed fan and
/// run the same way. These are recognised by going round once; the others go the long way.
class FanReader {
public:
    FanReader(const TriangleMesh& mesh, const Incidence& vertex_faces) : mesh_(mesh), vertex_faces_(vertex_faces) {}

    FanFacts facts(int v);

private:
    /// From v along one of the edges of a triangle: `out` where the triangle runs through it away from v.
    struct Spoke {
        int other;
        bool out;
    };

    FanFacts facts_the_long_way(int v);
    void read_spokes(int v);
    int fan_count(int v);

    const TriangleMesh& mesh_;
    const Incidence& vertex_faces_;
    std::vector<Spoke> spokes_;   // sorted by `other`
    std::vector<int> ring_;       // distinct neighbours, ascending
    DisjointSets fans_{0};
};

}   // namespace meshfolio
