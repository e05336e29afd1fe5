/// @file
/// What question 3 measures: the cotangent operator against the uniform one, on the meshes it is given, on surfaces with closed form and
/// on the plane.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "geometry/operators/cotangent_laplacian.h"
#include "questions/bench/curvature_study.h"
#include "questions/bench/uniform_curvature_study.h"

namespace meshfolio {

/// Errors of H on a known surface at one level.
struct CotangentErrors {
    int vertices = 0;
    double mean_edge = 0;             // [length]
    double smallest_angle = 0;        // [rad]
    double negative_weights = 0;      // share of the edges
    FieldError uniform;               // ½‖Δ_uniform x‖ · 4/h²
    std::array<FieldError, 3> H;      // cotangent, one an area form
    std::array<int, 3> undefined{};   // vertices whose area is ≤ 0
    FieldError clamped;               // barycentric areas, negative weights set to 0
};
CotangentErrors cotangent_errors(const SampledSurface& s);

using CotangentRefinement = Refinement<CotangentErrors>;
ErrorHistory cotangent_H(const CotangentRefinement& refinement, std::size_t area_form, double FieldError::*norm = &FieldError::l2);
ErrorHistory scaled_uniform_H(const CotangentRefinement& refinement);   // L2

/// Barycentric H of a flat regular pentagon cap over its true value, less 1: where L∞ on the icosphere stalls, at its twelve vertices of
/// valence 5.
double pentagon_excess();

/// One way of building the operator, on one mesh.
struct OperatorVariant {
    std::string name;             // "clamped"
    int negative_inside = 0;      // edges with a negative weight, not on the boundary
    int negative_boundary = 0;    // boundary edges with a negative weight
    double smallest_weight = 0;   // C_ij [dimensionless]
    double inside = 0;            // largest ½‖Lx‖ inside [1 / mean edge]
    double change = 0;            // rms difference of H inside to the first variant, over the rms of the first; NaN when that is 0
    double boundary = 0;          // largest ½‖Lx‖ on the boundary, where it is no curvature [1 / mean edge]
};

/// Both estimates on one mesh, barycentric areas.
struct CotangentComparison {
    CurvatureSubject subject;
    Vector uniform, cotangent, difference;         // scaled uniform H, cotangent H, cotangent − uniform [1/length]
    double drift = 0;                              // largest ½‖Δ_uniform x‖ · 4/h² inside, as mean curvature × mean edge
    double precision = 0;                          // largest |cotangent H| × mean edge inside
    double rms_uniform = 0, rms_difference = 0;    // over the inside [1/length]
    double jump_uniform = 0, jump_cotangent = 0;   // rms difference of H between neighbours [1/length]
    double sign_change = 0;                        // share of vertices where the two differ in sign
    std::vector<OperatorVariant> variants;         // half sum (the default), mean of opposite vertices, clamped
};
CotangentComparison compare_operators(std::shared_ptr<const LibraryMesh> source);

/// A flat square whose inner vertices were moved within it: every curvature is zero, whatever the triangles.
struct PlaneTest {
    TriangleMesh mesh;
    Vector uniform_H, cotangent_H, clamped_H;         // times the mean edge
    double negative_weights = 0;                      // share of the edges
    double cotangent = 0, clamped = 0, uniform = 0;   // largest |H| × mean edge inside
};
PlaneTest irregular_plane(std::uint64_t seed);

}   // namespace meshfolio
