/// @file
/// What question 2 measures: the fundamental forms of the ellipsoid against oracles, at the tip, towards the pole and on meshes.
#pragma once

#include "geometry/curvature/fundamental_forms.h"
#include "mesh/triangle_mesh.h"
#include "questions/bench/curvature_bench.h"

namespace meshfolio {

/// Three different half axes, b > c: along ±z the tip bends more than along ±y. Exchanged, b < c: the other way round.
inline constexpr Ellipsoid flat_ellipsoid{1.7, 1.1, 0.6};
inline constexpr Ellipsoid tall_ellipsoid{1.7, 0.6, 1.1};

std::string axes_text(const Ellipsoid& e);   // "a = 1.7, b = …"
Vector3 axes_of(const Ellipsoid& e);

/// The closed forms against two oracles, at random points.
struct OracleErrors {
    Ellipsoid ellipsoid;
    double I = 0, II = 0;   // largest deviation from central differences, over the largest entry of the form
    double K = 0, H = 0;    // largest relative deviation from the implicit closed form
    int points = 0;
};

/// Measures the errors on five ellipsoids, one of them a sphere.
std::vector<OracleErrors> all_oracle_errors(const QuestionSettings& settings);

/// The point (a, 0, 0), that is (u, v) = (0, π/2).
struct Tip {
    Ellipsoid ellipsoid;
    FundamentalForms forms;   // at (u, v) = (0, π/2)
    PrincipalCurvatures principal;
    double H = 0, K = 0;
    double worst_euler = 0;        // largest relative gap between II(t, t)/I(t, t) and Euler's formula, over directions
    double worst_parameters = 0;   // the same for a raw (du, dv)
    double at_45_angle = 0, at_45_parameters = 0;

    /// Where κ_n is largest: along ±y when b < c, along ±z when b > c.
    bool largest_along_y() const { return std::abs(principal.maximum_direction.y()) > std::abs(principal.maximum_direction.z()); }
};
Tip tip_of(const Ellipsoid& ellipsoid);

struct PoleStep {
    double distance = 0;               // π − v [rad]
    double area_element_squared = 0;   // EG − F² [length⁴]
    double K = 0;                      // [1/length²]
};
/// Along u = 0, at shrinking distances π − v from the south pole.
std::vector<PoleStep> towards_the_pole(const Ellipsoid& ellipsoid);

/// Cotangent H and angle-deficit K (Voronoi areas) at the tip of a mesh, and how far they are from the forms.
struct DiscreteTip {
    int vertices = 0;
    double mean_edge = 0;   // [length]
    double distance = 0;    // of the nearest vertex to (a, 0, 0) [length]
    double H = 0, K = 0;
    double H_error = 0, K_error = 0;   // relative, against the closed form at that vertex
};

struct DiscreteTips {
    std::vector<DiscreteTip> grid;        // the (u, v) grid within 0.5 rad of the tip, refined
    std::vector<DiscreteTip> icosphere;   // the stretched icosphere, refined
};
DiscreteTips discrete_tips(const Ellipsoid& ellipsoid, bool quick);

ErrorHistory errors_of(const std::vector<DiscreteTip>& tips, double DiscreteTip::*error);

}   // namespace meshfolio
