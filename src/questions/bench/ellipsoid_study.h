/// @file
/// The measurements of question 2: the fundamental forms of the ellipsoid against oracles, at the tip, towards the pole and on meshes.
#pragma once

#include "geometry/curvature/fundamental_forms.h"
#include "mesh/triangle_mesh.h"
#include "questions/bench/curvature_bench.h"

namespace meshfolio {

// At the tip (a, 0, 0) the flat one (b > c) bends more along ±z, the tall one (b < c) along ±y.
inline constexpr Ellipsoid flat_ellipsoid{1.7, 1.1, 0.6};
inline constexpr Ellipsoid tall_ellipsoid{1.7, 0.6, 1.1};

/// Formats the half axes: "a = 1.7, b = …".
std::string axes_text(const Ellipsoid& e);
Vector3 axes_of(const Ellipsoid& e);   // (a, b, c)

/// Deviations of the closed forms from two oracles, the largest over random points.
struct OracleErrors {
    Ellipsoid ellipsoid;
    double I = 0, II = 0;   // from central differences, over the largest entry of the form
    double K = 0, H = 0;    // from the implicit closed form, relative
    int points = 0;
};
/// Measures the largest deviations on five ellipsoids, one of them a sphere, over 200 random points each (quick: 50).
std::vector<OracleErrors> all_oracle_errors(const QuestionSettings& settings);

/// The curvatures at the tip (a, 0, 0), that is (u, v) = (0, π/2).
struct Tip {
    Ellipsoid ellipsoid;
    FundamentalForms forms;
    PrincipalCurvatures principal;
    double H = 0, K = 0;
    double worst_euler = 0;        // largest relative gap between II(t, t)/I(t, t) and Euler's formula, over unit tangents
    double worst_parameters = 0;   // between II/I and tip_curvature_by_parameters(), over (du, dv) = (cos t, sin t)
    double at_45_angle = 0, at_45_parameters = 0;

    /// True if κ_n is largest along ±y (b < c) rather than ±z (b > c).
    bool largest_along_y() const { return std::abs(principal.maximum_direction.y()) > std::abs(principal.maximum_direction.z()); }
};
/// Computes the curvatures at the tip, and the largest gaps over 360 directions.
Tip tip_of(const Ellipsoid& ellipsoid);

inline constexpr double near_pole = 1e-4;   // π − v [rad]
/// Returns K at u = 0 and near_pole. [1/length²]
double curvature_near_pole(const Ellipsoid& ellipsoid);

/// Cotangent H and angle-deficit K (Voronoi areas) at the tip of a mesh.
struct DiscreteTip {
    int vertices = 0;
    double mean_edge = 0;   // [length]
    double distance = 0;    // of the nearest vertex to (a, 0, 0) [length]
    double H = 0, K = 0;
    double H_error = 0, K_error = 0;   // relative, against the closed form at that vertex
};

/// Coarse to fine, on the (u, v) grid within 0.5 rad of the tip and on the stretched icosphere.
struct DiscreteTips {
    std::vector<DiscreteTip> grid, icosphere;
};
/// Measures the tips of both meshes at levels 2 to 5 (quick: 2 to 4); each level halves the edges.
DiscreteTips discrete_tips(const Ellipsoid& ellipsoid, bool quick);

/// Returns one error of the tips, H_error or K_error, over their mean edges.
ErrorHistory errors_of(const std::vector<DiscreteTip>& tips, double DiscreteTip::*error);

}   // namespace meshfolio
