/// @file
/// What the questions on curvature share: the meshes they look at, and their colours.
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
    /// Is a ½‖Δ_uniform x‖ of this size left by coordinates that are rounded to so many decimals? Not by doubles.
    bool is_rounding(double length) const;
};
CurvatureSubject curvature_subject(SharedMesh source);

/// The smallest of 1, 0.1, …, 10⁻⁸ that all coordinates are multiples of, as in a file of so many decimals; 0 if there is none.
double coordinate_step(const TriangleMesh& mesh);

/// The unit normal of the plane all vertices in use lie in, to 1e-6 box diagonals; nothing when they do not.
std::optional<Vector3> common_plane_normal(const TriangleMesh& mesh);

/// Largest |value| over the finite values whose vertex satisfies `chosen`; 0 when there is none.
template <class Predicate>
double largest_magnitude(const Vector& values, Predicate chosen) {
    double most = 0;
    for (int i = 0; i < values.size(); ++i)
        if (chosen(i) && std::isfinite(values[i])) most = std::max(most, std::abs(values[i]));
    return most;
}
double largest_magnitude(const Vector& values);

/// Measures how rough a picture is: the 90th percentile of |difference| along edges over that of |value|, of finite values; 0 for zeros.
double roughness(const Vector& values, const MeshTopology& topology);

/// Spearman's rank correlation over the vertices where both are finite; 0 where one is constant.
double rank_correlation(const Vector& a, const Vector& b);

/// A panel that fits into one frame with meshes of any size: in the unit ball.
output::Panel unit_ball_panel(const CurvatureSubject& subject, std::string name, std::string label, Vector values);
/// Gives the panel diverging colours of its own, from −`end` to `end`: values of meshes are not compared.
void set_own_range(output::Panel& panel, double end, std::string quantity, std::string unit);
/// The share of the finite values beyond ± `range`.
double share_beyond(const Vector& values, double range);

/// Shares of the finite values above and below 0, by the distance of the vertices from the box centre.
struct SignsByDistance {
    double positive = 0, negative = 0;   // of all
    double outer_positive = 0;           // of the fifth that is farthest from the centre
    double inner_negative = 0;           // of the nearer half

    bool caps_outside() const { return outer_positive > std::max(0.5, positive + 0.1) && inner_negative > 1.1 * negative; }
};
SignsByDistance signs_by_distance(const CurvatureSubject& subject, const Vector& values);

/// `shared` with the clipped shares of these panels.
output::ColorRange range_for(const output::ColorRange& shared, const std::vector<output::Panel>& panels);

/// The end of the diverging colours that show these values, symmetric about 0; at least half of `floor`.
double diverging_range(const Vector& values, double floor = 0);

/// Robust range of unsigned values, from 0 on, with the clipped shares of the panels.
output::ColorRange range_from_zero(const std::vector<output::Panel>& panels, std::string colormap, std::string quantity, double floor,
                                   std::string unit = "");

/// Vertices in use without curvature.
struct UndefinedVertices {
    int boundary = 0, nonmanifold = 0;   // those on the boundary that are not manifold are among the latter
    void operator+=(const UndefinedVertices& other) { boundary += other.boundary, nonmanifold += other.nonmanifold; }
};
UndefinedVertices undefined_vertices(const CurvatureSubject& subject);
/// A space and a sentence that says what their colour is, or nothing where there are none: for captions.
std::string undefined_words(const UndefinedVertices& vertices);
inline std::string undefined_words(const CurvatureSubject& subject) { return undefined_words(undefined_vertices(subject)); }

}   // namespace meshfolio
