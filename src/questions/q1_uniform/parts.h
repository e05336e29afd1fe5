/// @file
/// What question 1 measures, uniform H and angle-deficit K on its meshes and how far jitter worsens them, and what it shows of it.
#pragma once

#include <limits>

#include "questions/bench/curvature_bench.h"
#include "questions/bench/curvature_subject.h"

namespace meshfolio::q1_uniform {

inline constexpr report::Words words("q1");

// The estimators of this question.
inline constexpr std::string_view uniform_H = "H.uniform", normal_H = "H.uniform_own_n", deficit_K = "K.barycentric";

struct MeshCurvature {
    CurvatureSubject subject;
    Vector length;      // ½‖Δ_uniform x‖, signed [length]
    Vector H;           // the same times 4/h² [1/length]
    Vector K;           // barycentric areas [1/length²]
    Vector cotangent;   // H of question 3, to compare with [1/length]
    Vector areas;       // barycentric [length²]
    Vector deficit;     // [rad]
    const std::string& name() const { return subject.name(); }
};

MeshCurvature curvature_of(SharedMesh source);

/// Medians of values in the quarter of the vertices where something else is smallest, and in that where it is largest.
struct Contrast {
    double least = 0, most = 0;   // NaN with fewer than eight vertices
};
Contrast contrast(const Vector& values, const Vector& by);

/// What of Δx inside a curved mesh is no curvature: differences are rms, over the rms of cotangent H.
struct TangentialPart {
    Vector shares;           // of ‖Δx‖² at each vertex, along the surface
    double share = 0;        // of Σ ‖Δx‖²
    double dark = 0;         // of the vertices, where the share is above 0.9
    double gap = 0;          // of ½‖Δx‖ · 4/h² to cotangent H
    double normal_gap = 0;   // of −½Δx·n · 4/h² to it, with the mesh's own n
    Contrast length;         // of the shares: where |½‖Δx‖| is small, and where it is large

    bool explains() const { return share > 1e-3 && normal_gap < 0.9 * gap; }
};
TangentialPart tangential_part(const MeshCurvature& c);

/// A vertex is flat where |K| and |cotangent H| are below this share of their colour ranges; ½‖Δx‖ is drift there.
inline constexpr double flat_within = 0.1;
struct FlatParts {
    int vertices = 0;
    double share = 0;      // of the vertices with curvature
    double coloured = 0;   // of these, the share where |½‖Δx‖| is beyond flat_within of its own range
    double drift = 0;      // median tangential share there

    /// Enough to be seen, and drift that is taken for curvature.
    bool mislead() const { return vertices >= 20 && share > 0.02 && coloured > 0.25 && drift > 0.5; }
};
FlatParts flat_parts(const MeshCurvature& c);

/// What the picture of uniform H shows beside that of cotangent H.
struct Picture {
    double correlation = 0;                    // rank_correlation() of the two
    double spread = 0, cotangent_spread = 0;   // 98th over 2nd percentile where there is one sign; 0 where there are two

    bool is_even() const { return cotangent_spread > 0 && cotangent_spread < 1.2; }   // so is the surface
    bool varies_where_truth_does_not() const { return is_even() && spread > 1.5 * cotangent_spread; }
};
Picture picture_of(const MeshCurvature& c);
/// Flat or evenly curved: does one view show all of it?
bool looks_alike_from_all_sides(const MeshCurvature& c);

/// Where K is positive or negative, however little. Rounding is neither.
struct SignsOfK {
    SignsByDistance all;
    double white = 0;   // share where |K| is below white_within of its colour range
};
inline constexpr double white_within = 0.05;
SignsOfK signs_of_K(const MeshCurvature& c);

/// K at the few vertices of valence other than six: its largest relative distance from the median, there, elsewhere, and there with Voronoi
/// areas, from the median of K with those.
struct IrregularVertices {
    std::vector<int> vertices;
    double off = 0, off_elsewhere = 0, off_with_voronoi = 0;

    bool ringed() const { return stand_out() && off > 0.1; }   // where less is off there is nothing to look for
    bool seen() const { return off > 0.25; }                   // in a colour range about 0
    bool stand_out() const { return !vertices.empty() && off > 5 * off_elsewhere; }
    bool area_is_why() const { return off_with_voronoi < 0.2 * off; }
};
/// Finds irregular vertices where K has one sign and at most a twentieth of the vertices are irregular; else none.
IrregularVertices irregular_vertices(const MeshCurvature& c);

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

/// Curvature × mean edge below this cannot be seen in any picture: coordinates written with six digits leave as much.
inline constexpr double visible = 1e-4;

using Meshes = std::vector<MeshCurvature>;
using AngleSums = std::vector<AngleSum>;

/// How far Σ deficit / 2π is from χ at most, where that applies.
double euler_gap(const AngleSums& sums);

/// Counts the vertices with area ≤ 0 on all finest meshes.
int without_K(const BenchRuns& runs, AreaForm form);

/// Δx and its parts, the angle deficit, and the three areas, each of a real ring.
report::Diagram ring_diagram();

/// κ₁, κ₂, H and K of a cap, a saddle and a cylinder.
report::Diagram sign_diagram();

/// H and K of each mesh side by side: in six views, and those that look alike from every side in one.
void add_figures(Answer& answer, const Meshes& meshes);
/// Shows where Δx lies along the surface, on the curved meshes.
void add_tangential_figure(Answer& answer, const Meshes& meshes, const std::string& colormap);

/// The curved mesh with the largest part of ‖Δx‖² along the surface, if there is one.
struct Drifting {
    const MeshCurvature* mesh;
    TangentialPart part;
};
std::optional<Drifting> most_drifting(const Meshes& meshes);

report::Text answer_of(const BenchRuns& runs);
report::Text lead_of(const BenchRuns& runs);
/// @param panel  runs on all surfaces
void add_discussion(report::Section& section, const Meshes& meshes, const std::vector<FlatMesh>& flat, const BenchRuns& runs,
                    const BenchRuns& panel, const AngleSums& sums, const std::optional<Drifting>& drifting);
/// What is said in the appendix: the boundary of flat meshes.
void add_flat_boundaries(report::Section& section, const std::vector<FlatMesh>& flat);

}   // namespace meshfolio::q1_uniform
