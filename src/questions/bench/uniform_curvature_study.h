/// @file
/// What question 1 measures: uniform H and angle-deficit K on the meshes it is given and on surfaces with closed form.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "geometry/operators/vertex_areas.h"
#include "questions/bench/curvature_study.h"

namespace meshfolio {

inline constexpr std::array area_forms{AreaForm::barycentric, AreaForm::voronoi, AreaForm::mixed};

struct MeshCurvature {
    CurvatureSubject subject;
    Vector length;    // ½‖Δ_uniform x‖, signed [length]
    Vector H;         // the same times 4/h² [1/length]
    Vector K;         // barycentric areas [1/length²]
    Vector areas;     // barycentric [length²]
    Vector deficit;   // [rad]
    double euler_from_angles() const;
};

MeshCurvature curvature_of(std::shared_ptr<const LibraryMesh> source);

/// Errors of the estimates on a known surface at one level.
struct UniformErrors {
    int vertices = 0, faces = 0;
    double mean_edge = 0;             // [length]
    double smallest_angle = 0;        // [rad]
    double mean_length = 0;           // mean of ½‖Δ_uniform x‖ [length]
    FieldError H;                     // ½‖Δx‖ · 4/h²
    FieldError normal_part;           // −½Δx·n · 4/h², n of the surface: what ½‖Δx‖ would be without its tangential part
    std::array<FieldError, 3> K;      // one an area form
    std::array<int, 3> undefined{};   // vertices whose area is ≤ 0
    double euler_from_angles = 0;
    int euler = 0;
};

UniformErrors uniform_errors(const SampledSurface& s);

using UniformRefinement = Refinement<UniformErrors>;
std::string area_name(AreaForm form);   // "Voronoi", for prose and tables

ErrorHistory uniform_H(const UniformRefinement& refinement);                              // L2
ErrorHistory deficit_K(const UniformRefinement& refinement, std::size_t area_form = 0);   // L2, index into area_forms

/// Over the surfaces: how many times as large the L2 error at the finest level is with jittered vertices as with regular ones.
struct JitterFactors {
    double least = INFINITY, most = 0;
    bool matter() const { return least < 0.5 || most > 2; }
};
JitterFactors jitter_factors(const std::vector<UniformRefinement>& refinements, bool gaussian);

struct AngleSum {
    std::string mesh;
    int vertices = 0, faces = 0, euler = 0;
    double measured = 0;   // Σ deficit / 2π
    bool applies = true;   // manifold, and every triangle has angles
    /// Three angles a triangle, each rounded once and added up once.
    double tolerance() const { return 8.0 * std::max(vertices, faces) * std::numeric_limits<double>::epsilon(); }
};

std::vector<AngleSum> angle_sums(const std::vector<MeshCurvature>& meshes, const std::vector<UniformRefinement>& refinements);

/// What a flat mesh shows inside, where every curvature is zero, and what its boundary would show were it not masked.
struct FlatMesh {
    const MeshCurvature* curvature = nullptr;
    double normal_part = 0;       // largest |Δx · n| inside [mean edges]
    double drift = 0;             // largest ½‖Δx‖ inside [mean edges]
    double deficit = 0;           // largest |2π − Σθ| inside [rad]
    double boundary_length = 0;   // largest ½‖Δx‖ on the boundary [mean edges]
    double boundary_K = 0;        // largest |2π − Σθ|/A there, times d²
    double turning = 0;           // Σ (π − Σθ) over the boundary / 2π
    double largest_turning = 0;   // [rad]
    int boundary_vertices = 0;
};

/// @pre the mesh has a common plane
FlatMesh flat_mesh(const MeshCurvature& c);

}   // namespace meshfolio
