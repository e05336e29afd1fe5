/// @file
/// The parts of question 1: uniform H and angle-deficit K on meshes, and how much jitter worsens them on known surfaces.
#pragma once

#include <limits>

#include "questions/bench/curvature_bench.h"
#include "questions/bench/curvature_subject.h"

namespace meshfolio::q1_uniform {

inline constexpr report::Words words("q1");

// Keys of the estimators of this question.
inline constexpr std::string_view uniform_H = "H.uniform", normal_H = "H.uniform_own_n", deficit_K = "K.barycentric";

/// Curvatures at the n vertices of a mesh; NaN where undefined.
struct MeshCurvature {
    CurvatureSubject subject;
    Vector length;      // ½‖Δ_uniform x‖, signed [length]
    Vector H;           // length times 4/h² [1/length]
    Vector K;           // with barycentric areas [1/length²]
    Vector cotangent;   // H of question 3, for comparison [1/length]
    Vector areas;       // barycentric [length²]
    Vector deficit;     // angle deficit [rad]
    const std::string& name() const { return subject.name(); }
};
using Meshes = std::vector<MeshCurvature>;
/// Computes the uniform, scaled uniform and cotangent H, K, areas and angle deficits of one mesh.
MeshCurvature curvature_of(SharedMesh source);

/// Median of some values in the quarter of the vertices where another value is smallest, and in the quarter where it is largest.
struct Contrast {
    double least = 0, most = 0;   // NaN with fewer than eight vertices
};
/// Computes the medians of `values` over the quarter of the vertices with the smallest `by` and the quarter with the largest.
Contrast contrast(const Vector& values, const Vector& by);

/// The part of Δx that lies along a curved surface and is no curvature. The gaps are rms differences, over the rms of cotangent H.
struct TangentialPart {
    Vector shares;           // share of ‖Δx‖² along the surface at each vertex
    double share = 0;        // share of Σ ‖Δx‖²
    double gap = 0;          // between ½‖Δx‖ · 4/h² and cotangent H
    double normal_gap = 0;   // between −½Δx·n · 4/h² and cotangent H, with the mesh's own n
    Contrast length;         // of the shares, between vertices of small and of large |½‖Δx‖|

    bool explains() const { return share > 1e-3 && normal_gap < 0.9 * gap; }
};
/// Measures the tangential part over the vertices where scaled uniform and cotangent H are finite.
TangentialPart tangential_part(const MeshCurvature& c);

/// A vertex is flat if |K| and |cotangent H| are below this share of their colour ranges; ½‖Δx‖ is drift there.
inline constexpr double flat_within = 0.1;
struct FlatParts {
    int vertices = 0;
    double share = 0;      // of the vertices with curvature
    double coloured = 0;   // share of the flat vertices where |½‖Δx‖| is beyond flat_within of its own range
    double drift = 0;      // median tangential share of the flat vertices

    /// True if the flat parts are large enough to be seen and their drift looks like curvature.
    bool mislead() const { return vertices >= 20 && share > 0.02 && coloured > 0.25 && drift > 0.5; }
};
/// Measures the flat vertices of one mesh; all values are 0 if there are none.
FlatParts flat_parts(const MeshCurvature& c);

/// The picture of uniform H compared with that of cotangent H.
struct Picture {
    double correlation = 0;                    // rank_correlation() of ½‖Δx‖ and cotangent H
    double spread = 0, cotangent_spread = 0;   // 98th over 2nd percentile of values of one sign; 0 if there are both signs

    bool is_even() const { return cotangent_spread > 0 && cotangent_spread < 1.2; }   // the surface is evenly curved
    bool varies_where_truth_does_not() const { return is_even() && spread > 1.5 * cotangent_spread; }
};
/// Compares ½‖Δ_uniform x‖ with cotangent H on one mesh.
Picture picture_of(const MeshCurvature& c);
/// True if the mesh is flat or evenly curved, so that one view shows all of it.
bool looks_alike_from_all_sides(const MeshCurvature& c);

/// Shares of the vertices with positive and with negative K, however small. Rounding counts as 0.
struct SignsOfK {
    SignsByDistance all;
    double white = 0;   // share of the vertices where |K| is below white_within of its colour range
};
inline constexpr double white_within = 0.05;
/// Returns the shares of the vertices with positive and with negative K, near to and far from the box centre, and with K near 0.
SignsOfK signs_of_K(const MeshCurvature& c);

/// The few vertices of valence other than six, and the largest relative distance of K from its median.
struct IrregularVertices {
    std::vector<int> vertices;
    double off = 0, off_elsewhere = 0;   // at these vertices; at all others
    double off_with_voronoi = 0;         // at these vertices, of K with Voronoi areas from the median with Voronoi areas

    bool ringed() const { return stand_out() && off > 0.1; }   // worth looking for
    bool seen() const { return off > 0.25; }                   // in a colour range about 0
    bool stand_out() const { return !vertices.empty() && off > 5 * off_elsewhere; }
    bool area_is_why() const { return off_with_voronoi < 0.2 * off; }
};
/// Finds the irregular vertices where K is defined; none if K has both signs, or if more than a twentieth of these vertices are irregular.
IrregularVertices irregular_vertices(const MeshCurvature& c);

/// Gauss–Bonnet on one mesh: Σ deficit / 2π beside the Euler characteristic.
struct AngleSum {
    std::string mesh;
    int vertices = 0, faces = 0, euler = 0;
    double measured = 0;   // Σ deficit / 2π
    bool applies = true;   // the mesh is manifold and every triangle has angles
    /// Returns 8 max(vertices, faces) ε, the rounding of three angles per triangle, each rounded once and added once.
    double tolerance() const { return 8.0 * std::max(vertices, faces) * std::numeric_limits<double>::epsilon(); }
};
using AngleSums = std::vector<AngleSum>;
/// Returns the sum of the deficits of each mesh, then that of the finest mesh of each run.
AngleSums angle_sums(const Meshes& meshes, const BenchRuns& runs);

/// Values of a flat mesh, whose curvature is zero: inside, and on the boundary, where pictures mask them.
struct FlatMesh {
    const MeshCurvature* curvature = nullptr;
    double normal_part = 0;       // largest |Δx · n| inside [mean edges]
    double drift = 0;             // largest ½‖Δx‖ inside [mean edges]
    double deficit = 0;           // largest |2π − Σθ| inside [rad]
    double boundary_length = 0;   // largest ½‖Δx‖ on the boundary [mean edges]
    double turning = 0;           // Σ (π − Σθ) over the boundary / 2π
    int boundary_vertices = 0;
};
/// Measures a mesh in one plane. @pre c.subject.plane_normal is set
FlatMesh flat_mesh(const MeshCurvature& c);

/// Curvature × mean edge below this cannot be seen in any picture; coordinates of six digits leave as much.
inline constexpr double visible = 1e-4;

/// Draws Δx and its parts on a one-ring of a sphere, its angle deficit, and the three forms of area on a flat ring with an obtuse triangle.
report::Diagram ring_diagram();
/// Draws a cap, a saddle and a cylinder with their κ₁, κ₂, H and K.
report::Diagram sign_diagram();

/// Adds figures of ½‖Δx‖ and K of each mesh side by side: six views, but one view for meshes that look alike from all sides unless all do.
void add_figures(Answer& answer, const Meshes& meshes);
/// Adds a figure of the tangential shares [%] on the meshes that are not in one plane, a panel each.
void add_tangential_figure(Answer& answer, const Meshes& meshes, const std::string& colormap);

struct Drifting {
    const MeshCurvature* mesh;
    TangentialPart part;
};
/// Returns the curved mesh with the largest part of ‖Δx‖² along the surface; none if that is at most 1 % everywhere.
std::optional<Drifting> most_drifting(const Meshes& meshes);

/// Returns a table of the L∞ errors of K on the finest meshes [%], a row for each form of area, a column for each run.
report::Table area_table(const BenchRuns& runs);

/// Sets the answer of the section and adds its first paragraph.
void add_answer(report::Section& section, const BenchRuns& runs);
/// Adds the discussion. @param panel  runs on all surfaces
void add_discussion(report::Section& section, const Meshes& meshes, const std::vector<FlatMesh>& flat, const BenchRuns& runs,
                    const BenchRuns& panel, const AngleSums& sums, const std::optional<Drifting>& drifting);

}   // namespace meshfolio::q1_uniform
