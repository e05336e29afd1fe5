/// @file
/// What the operators need of the corners of triangles, for many corners at once.
#pragma once

#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Corners, quantity by quantity: they are computed in vectors. Each is seen from its own vertex, "here": its triangle runs from there to
/// `next`, on to `previous`, and back. The three corners of a triangle agree to the last bit in what they share.
struct CornerBatch {
    using Numbers = std::vector<double>;
    using Vertices = std::vector<int>;
    struct Points {
        Numbers x, y, z;
    };
    static constexpr int spare = 8;   // beyond the corners, that groups of eight can be read and written anywhere
    static constexpr int not_closed = -1;

    int size = 0;   // corners, at most as many as there is room for
    /// Makes room; what was there is lost.
    void resize(int corners, int rings);

    int first_vertex = 0;
    std::vector<int> ring_start;   // of each vertex the first of its corners, and the end

    // What it is given; the spare ones are those of any corner
    Vertices here, triangle;
    // Where the others lie
    Vertices next, previous;
    Numbers place;   // 0, 1 or 2: as which corner of its triangle `here` is stored
    // The row of a vertex with a closed fan: of each corner the places of `next` and `previous` in it, and that of the vertex itself
    Vertices place_of_next, place_of_previous;
    std::vector<int> diagonal_place;   // of each vertex; or not_closed
    // The same as in TriangleShape
    Numbers dot_here, dot_next, dot_previous;               // u · v at each corner [length²]
    Numbers squared_here, squared_next, squared_previous;   // |e|² of the edge opposite it [length²]
    Points normal;                                          // u × v [length²]
    Numbers cross;                                          // |u × v| = 2A [length²]
    // What follows from it
    Numbers cotangent_next, cotangent_previous;
    Numbers barycentric, voronoi, mixed;   // shares of `here` in the area [length²]
    Numbers angle;                         // at `here` [rad]

private:
    int room_ = 0;
};

/// From `here` and `triangle` to `place`.
void find_sides(const TriangleMesh& mesh, CornerBatch& batch);
/// From there to `cross`; positions are multiplied by `scale`.
void find_shapes(const TriangleMesh& mesh, double scale, CornerBatch& batch);
/// These need the shapes.
void find_cotangents(CornerBatch& batch);
void find_area_shares(CornerBatch& batch);   // and the cotangents
void find_angles(CornerBatch& batch);

}   // namespace meshfolio
