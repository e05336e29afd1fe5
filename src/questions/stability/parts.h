/// @file
/// The parts of the section "stability".
#pragma once

#include "questions/stability/study.h"

namespace meshfolio::stability {

inline constexpr report::Words words("stability");

using Studies = std::vector<StabilityStudy>;

report::Table certificate_table(const Studies& studies);
report::Table unit_table(const Studies& studies);
report::Table growth_table(const Studies& studies);
report::Plot growth_plot(const StabilityStudy& study);
report::Table flow_table(const RebuiltFlow& flow);
report::Table flow_time_table(const RebuiltFlow& flow);
report::Plot flow_plot(const RebuiltFlow& flow);

/// Two figures: every mesh seen along the normal of its limiting vertex, coloured by |φ_max|; and the triangles around it, by φ_max.
void add_limiting_vertex_figures(Answer& answer, const Studies& studies, const std::string& colormap);

/// The triangles within `rings` edges of a vertex, turned so that its normal faces the three-quarter view.
struct Neighbourhood {
    TriangleMesh mesh;
    Eigen::VectorXi original;   // row i is vertex original[i] of the whole mesh
    int vertex = -1;            // the vertex itself among the rows
};
Neighbourhood neighbourhood(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, int rings);

/// The verdict in one sentence.
report::Text answer_of(const Studies& studies);
void add_discussion(report::Section& section, const Studies& studies, const RebuiltFlow& flow);

}   // namespace meshfolio::stability
