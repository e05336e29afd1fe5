/// @file
/// What the operators need of the corners of triangles, for many corners at once.
#pragma once

#include <vector>

namespace meshfolio {

/// Corners, quantity by quantity: loops over them compile to vector instructions. Each is seen from its own vertex v, "here": its
/// triangle runs from v to `next`, on to `previous`, and back. The three corners of a triangle agree to the last bit in what they share.
struct CornerBatch {
    using Numbers = std::vector<double>;
    using Vertices = std::vector<int>;
    struct Points {
        Numbers x, y, z;
    };
    static constexpr int spare = 8;   // beyond the corners, that groups of eight can be read and written anywhere

    int size = 0;   // corners, at most as many as there is room for
    /// Makes room; what was there is lost.
    void resize(int corners);

    // What it is given
    Points at_here, at_next, at_previous;
    Vertices next, previous;
    Numbers place;   // 0, 1 or 2: as which corner of its triangle v is stored
    // The same as in TriangleShape
    Numbers dot_here, dot_next, dot_previous;               // u · v at each corner [length²]
    Numbers squared_here, squared_next, squared_previous;   // |e|² of the edge opposite it [length²]
    Points normal;                                          // u × v [length²]
    Numbers cross;                                          // |u × v| = 2A [length²]
    // What follows from it
    Numbers cotangent_next, cotangent_previous;
    Numbers barycentric, voronoi, mixed;   // shares of v in the area [length²]
    Numbers angle;                         // at v [rad]

private:
    int room_ = 0;
};

/// From the points times `scale` to `cross`.
void find_shapes(CornerBatch& batch, double scale);
/// These need the shapes.
void find_cotangents(CornerBatch& batch);
void find_area_shares(CornerBatch& batch);   // and the cotangents
void find_angles(CornerBatch& batch);

}   // namespace meshfolio
