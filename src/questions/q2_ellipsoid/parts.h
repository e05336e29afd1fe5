/// @file
/// The parts of question 2.
#pragma once

#include "questions/bench/ellipsoid_study.h"

namespace meshfolio::q2_ellipsoid {

inline constexpr report::Words words("q2");

using Oracles = std::vector<OracleErrors>;

/// The largest difference of κ_n at the tip between θ as an angle in space and θ as (du, dv) = (cos θ, sin θ), and the whole degree from 0
/// to 90 where it occurs.
struct ReadingGap {
    double gap = 0;   // of κ_n [1/length]
    int degrees = 0;
};
ReadingGap largest_gap(const Ellipsoid& e);   // of the tip (a, 0, 0)

/// Returns the number of random points on all ellipsoids together.
int total_points(const Oracles& oracles);
/// Returns K at the poles (0, 0, ±c). [1/length²]
inline double pole_limit(const Ellipsoid& e) { return e.c * e.c / (e.a * e.a * e.b * e.b); }
/// Returns "±y" or "±z", the axis nearer to a tangent at the tip.
std::string direction_text(const Vector3& t);
/// Returns x, or 0 where it is rounding, as in cos(π/2) = 6e-17.
inline double without_rounding(double x) { return std::abs(x) < 1e-15 ? 0 : x; }

/// Returns a table of the fundamental forms, normal curvatures, H and K at seven points (u, v), a row each.
report::Table forms_table(const Ellipsoid& ellipsoid);
/// Returns a table of the normal curvatures, their axes, H and K at the tips, a row for each ellipsoid.
report::Table tip_table(const std::vector<Tip>& tips);
/// Plots the normal curvature at the tip over θ from 0 to 2π, with θ as an angle (line) and as (du, dv) = (cos θ, sin θ) (dashed).
report::Plot tip_plot(const Tip& tip, const std::string& id);
/// Returns a table of H and K at the tip and their errors, a row for each mesh: first the grids, then the icospheres.
report::Table discrete_table(const Tip& exact, const DiscreteTips& tips);

/// Draws θ in the tangent plane, and the normal sections along y and z.
report::Diagram angle_diagram(const Tip& tip);
/// Adds a figure of an ellipsoid mesh of level 5 (quick: 4) coloured by the mean curvature of the closed form.
void add_ellipsoid_figure(Answer& answer, const Ellipsoid& ellipsoid, bool quick, const std::string& colormap);

}   // namespace meshfolio::q2_ellipsoid
