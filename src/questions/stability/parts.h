/// @file
/// What the section "stability" shows of its two studies, the limit of explicit smoothing and the planes of steps and iterations.
#pragma once

#include "questions/stability/planes.h"
#include "questions/stability/study.h"

namespace meshfolio::stability {

inline constexpr report::Words words("stability");

using Studies = std::vector<StabilityStudy>;
using Planes = std::vector<SmoothingMaps>;

/// What a mode has grown to over what the law says.
double over_predicted(const ModeGrowth& growth);

report::Table certificate_table(const Studies& studies);
/// The limit in other units, and the vertex that sets it.
report::Table unit_table(const Studies& studies);
report::Plot growth_plot(const StabilityStudy& study);
report::Table flow_table(const RebuiltFlow& flow);
report::Plot flow_plot(const RebuiltFlow& flow);
/// The error over the plane, or the motion if no clean mesh is known; explicit beside implicit.
report::Map error_map(const SmoothingMaps& maps);
report::Table region_table(const Planes& planes);
/// All that was measured over the planes, for programs.
report::Table plane_table(const Planes& planes);
report::Table blow_up_table(const Planes& planes);

/// One figure: every mesh seen along the normal of its limiting vertex, and below it the triangles around, coloured by the top mode.
void add_top_mode_figure(Answer& answer, const Studies& studies);
/// The lettered places of the planes, a row a mesh.
void add_place_figure(Answer& answer, const Planes& planes);

/// The triangles within `rings` edges of a vertex, turned so that its normal faces the three-quarter view.
struct Neighbourhood {
    TriangleMesh mesh;
    Eigen::VectorXi original;   // row i is vertex original[i] of the whole mesh
    int vertex = -1;            // the vertex itself among the rows
};
Neighbourhood neighbourhood(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, int rings);

/// Of all cells that are compared, the one in which the schemes are farthest apart; none if none is.
struct Gap {
    const SmoothingMaps* maps = nullptr;
    std::size_t cell = 0;
    double apart = 0, last = 0;   // there; at most after all iterations, on any mesh
};
Gap largest_gap(const Planes& planes);

/// What answer and discussion state.
report::Facts facts_of(const Studies& studies, const RebuiltFlow& flow, const Planes& planes);

}   // namespace meshfolio::stability
