/// @file
/// The meshes of the questions on curvature, and the colours of their figures.
#pragma once

#include "questions/core/section_tools.h"

namespace meshfolio {

struct CurvatureSubject : OnMesh {
    double diagonal = 0;                   // of the bounding box [length]
    double mean_edge = 0;                  // [length]
    int interior = 0;                      // vertices in use, manifold and not on the boundary
    std::optional<Vector3> plane_normal;   // unit; set when all vertices in use lie in one plane
    Positions centred;                     // n × 3, about the box centre [length]
    Positions uniform;                     // n × 3, Δ_uniform x, boundary included [length]

    bool inside(int vertex) const;   // in use, manifold and not on the boundary
    /// True if a ½‖Δ_uniform x‖ of this length can come from the decimals of the file: above 1e-9 mean edges, at most ½√3
    /// coordinate_step().
    bool is_rounding(double length) const;
};
/// Measures the sizes of the mesh, its inner vertices, its common plane, and Δ_uniform x.
CurvatureSubject curvature_subject(SharedMesh source);

/// Returns the largest of 1, 0.1, …, 10⁻⁸ that divides all coordinates, as in a file with a fixed number of decimals; 0 if none does.
double coordinate_step(const TriangleMesh& mesh);

/// Returns the unit normal of the plane that holds all vertices in use, to 1e-6 box diagonals; nothing if there is no such plane, or if the
/// triangles cover it more than once.
std::optional<Vector3> common_plane_normal(const TriangleMesh& mesh);

/// Returns the largest |value| over the finite values with `chosen(vertex)`, or over all finite values; 0 if there are none.
template <class Predicate> double largest_magnitude(const Vector& values, Predicate chosen) {
    double most = 0;
    for (int i = 0; i < values.size(); ++i)
        if (chosen(i) && std::isfinite(values[i])) most = std::max(most, std::abs(values[i]));
    return most;
}
inline double largest_magnitude(const Vector& values) {
    return largest_magnitude(values, [](int) { return true; });
}

/// Returns value[a] − value[b] of every edge (a, b), in the order of topology.edges.
Vector differences_along_edges(const Vector& values, const MeshTopology& topology);
/// Measures the roughness of a field of finite values: the 90th percentile of |difference| along edges over that of |value|; 0 for zeros.
double roughness(const Vector& values, const MeshTopology& topology);

/// Computes Spearman's rank correlation over the vertices where both values are finite; 0 if one field is constant.
double rank_correlation(const Vector& a, const Vector& b);

/// Makes a panel with the mesh moved by its box centre and scaled into the unit ball, so that meshes of any size fit one frame.
output::Panel unit_ball_panel(const CurvatureSubject& subject, std::string name, std::string label, Vector values);
/// Gives the panel a diverging colour range of its own, from −`end` to `end`, with the shares of its values beyond.
void set_own_range(output::Panel& panel, double end, std::string quantity, std::string unit);
/// Returns the share of the finite values with |value| > `range`; 0 without finite values.
double share_beyond(const Vector& values, double range);

/// Shares of the finite values above and below 0, by the distance of the vertices from the box centre.
struct SignsByDistance {
    double positive = 0, negative = 0;   // over all vertices
    double outer_positive = 0;           // over the fifth that is farthest from the centre
    double inner_negative = 0;           // over the nearer half

    /// True if positive values crowd outside and negative ones inside.
    bool caps_outside() const { return outer_positive > std::max(0.5, positive + 0.1) && inner_negative > 1.1 * negative; }
};
/// Computes the shares of n values; a share over no vertices is 0.
SignsByDistance signs_by_distance(const CurvatureSubject& subject, const Vector& values);

/// Returns the range `shared` with the shares of the panels' values that lie below and above it.
output::ColorRange range_for(output::ColorRange shared, const std::vector<output::Panel>& panels);

/// Returns the upper end of output::robust_range() of these values with diverging colours, symmetric about 0; at least half of `floor`.
double diverging_range(const Vector& values, double floor = 0);

/// Returns the output::robust_range() of all panels with its lower end at 0, and with the shares of values beyond it.
output::ColorRange range_from_zero(const std::vector<output::Panel>& panels, std::string colormap, std::string quantity, double floor,
                                   std::string unit = "");

/// Counts of the vertices in use without curvature. A boundary vertex that is not manifold counts as non-manifold only.
struct UndefinedVertices {
    int boundary = 0, nonmanifold = 0;
    void operator+=(const UndefinedVertices& other) { boundary += other.boundary, nonmanifold += other.nonmanifold; }
};
/// Counts the vertices of the mesh that are in use and have no curvature.
UndefinedVertices undefined_vertices(const CurvatureSubject& subject);
/// Returns a space and the sentence of a caption with the counts of vertices without curvature and their colour; empty if both are 0.
std::string undefined_words(const UndefinedVertices& vertices);
inline std::string undefined_words(const CurvatureSubject& subject) { return undefined_words(undefined_vertices(subject)); }

}   // namespace meshfolio
