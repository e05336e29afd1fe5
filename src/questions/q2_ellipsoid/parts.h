/// @file
/// The parts of question 2.
#pragma once

#include "questions/bench/ellipsoid_study.h"

namespace meshfolio::q2_ellipsoid {

inline constexpr report::Words words("q2");

using Oracles = std::vector<OracleErrors>;
using PoleSteps = std::vector<PoleStep>;

/// Where the two readings of θ are farthest apart, to a degree between 0 and 90.
struct ReadingGap {
    double gap = 0;   // [1/length]
    int degrees = 0;
};
ReadingGap largest_gap(const Ellipsoid& e);

int total_points(const Oracles& oracles);
/// K at the poles.
inline double pole_limit(const Ellipsoid& e) { return e.c * e.c / (e.a * e.a * e.b * e.b); }
/// "±y", for a tangent at the tip.
std::string direction_text(const Vector3& t);
/// cos(π/2) = 6e-17 is 0.
inline double without_rounding(double x) { return std::abs(x) < 1e-15 ? 0 : x; }

report::Table forms_table(const Ellipsoid& ellipsoid);
report::Table tip_table(const std::vector<Tip>& tips);
report::Plot tip_plot(const Tip& tip, const std::string& id);
report::Table oracle_table(const Oracles& oracles);
report::Table pole_table(const Ellipsoid& ellipsoid, const PoleSteps& steps);
report::Table discrete_table(const Tip& exact, const DiscreteTips& tips);

/// θ in the tangent plane, and the normal sections along y and z.
report::Diagram angle_diagram(const Tip& tip);
void add_ellipsoid_figure(Answer& answer, const Ellipsoid& ellipsoid, bool quick, const std::string& colormap);

}   // namespace meshfolio::q2_ellipsoid
