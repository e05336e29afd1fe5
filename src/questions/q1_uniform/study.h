/// @file
/// What question 1 measures: uniform H and angle-deficit K on the meshes it is given, and how far jitter worsens them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "questions/bench/curvature_bench.h"
#include "questions/bench/curvature_subject.h"

namespace meshfolio::q1_uniform {

// The estimators of this question.
inline constexpr std::string_view uniform_H = "H.uniform", deficit_K = "K.barycentric";

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

/// What of Δx inside a curved mesh is no curvature: differences are rms, over the rms of cotangent H.
struct TangentialPart {
    double share = 0;        // of ‖Δx‖², along the surface
    double gap = 0;          // of ½‖Δx‖ · 4/h² to cotangent H
    double normal_gap = 0;   // of −½Δx·n · 4/h² to it
};
TangentialPart tangential_part(const MeshCurvature& c);

/// Over the surfaces: how many times as large the L2 error at the finest level is with jittered vertices as with regular ones.
struct JitterFactors {
    double least = INFINITY, most = 0;
    bool matter() const { return least < 0.5 || most > 2; }
};
JitterFactors jitter_factors(const BenchRuns& runs, std::string_view estimator);

struct AngleSum {
    std::string mesh;
    int vertices = 0, faces = 0, euler = 0;
    double measured = 0;   // Σ deficit / 2π
    bool applies = true;   // manifold, and every triangle has angles
    /// Three angles a triangle, each rounded once and added up once.
    double tolerance() const { return 8.0 * std::max(vertices, faces) * std::numeric_limits<double>::epsilon(); }
};

std::vector<AngleSum> angle_sums(const std::vector<MeshCurvature>& meshes, const BenchRuns& runs);

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

}   // namespace meshfolio::q1_uniform
