/// @file
/// The cotangent operator against the uniform one, on a mesh and on an irregular flat square.
#pragma once

#include "questions/bench/curvature_subject.h"

namespace meshfolio {

/// Measurements of one variant of the cotangent operator on one mesh.
struct OperatorVariant {
    std::string name;             // "clamped"
    int negative_inside = 0;      // edges with a negative weight, not on the boundary
    int negative_boundary = 0;    // boundary edges with a negative weight
    double smallest_weight = 0;   // C_ij [dimensionless]
    double inside = 0;            // largest ½‖Lx‖ inside [1 / mean edge]
    double change = 0;            // rms difference of H inside from that of the first variant, over the rms of the first; NaN if that is 0
    double boundary = 0;          // largest ½‖Lx‖ on the boundary, where it is no curvature [1 / mean edge]
};

/// Uniform and cotangent H of one mesh, with barycentric areas.
struct CotangentComparison {
    CurvatureSubject subject;
    Vector uniform, cotangent, difference;         // scaled uniform H, cotangent H, cotangent − uniform [1/length]
    double drift = 0;                              // largest |uniform H| × mean edge inside
    double precision = 0;                          // largest |cotangent H| × mean edge inside
    double rms_uniform = 0, rms_difference = 0;    // over the inside [1/length]
    double jump_uniform = 0, jump_cotangent = 0;   // rms difference of H between neighbours [1/length]
    double sign_change = 0;                        // share of vertices where the two differ in sign
    std::vector<OperatorVariant> variants;         // half sum (the default), mean of opposite vertices, clamped

    const std::string& name() const { return subject.name(); }
};
/// Computes uniform and cotangent H of the mesh, their differences, and three variants of the cotangent operator.
CotangentComparison compare_operators(SharedMesh source);

/// H of a flat square with inner vertices moved within it; the right value is 0 everywhere.
struct PlaneTest {
    TriangleMesh mesh;
    Vector uniform_H, cotangent_H;                    // times the mean edge
    double negative_weights = 0;                      // share of the edges
    double cotangent = 0, clamped = 0, uniform = 0;   // largest |H| × mean edge inside
};
/// Makes a grid of 24 × 24 vertices on the unit square, moves its inner vertices at random within the square, and computes H.
PlaneTest irregular_plane(std::uint64_t seed);

}   // namespace meshfolio
