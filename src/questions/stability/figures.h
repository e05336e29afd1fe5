/// @file
/// Pictures of the mode that sets the limit of explicit smoothing.
#pragma once

#include <string>
#include <vector>

#include "questions/core/chapter.h"
#include "questions/stability/study.h"

namespace meshfolio::stability {

/// Two figures of small multiples: every mesh seen along the normal of its limiting vertex, and the triangles around that vertex;
/// coloured by |φ_max| over its largest value, near by with its sign, the vertex ringed.
void add_limiting_vertex_figures(Answer& answer, const std::vector<StabilityStudy>& studies, const std::string& colormap);

/// The triangles within `rings` edges of a vertex, turned so that its normal faces the three-quarter view.
struct Neighbourhood {
    TriangleMesh mesh;
    Eigen::VectorXi original;   // row i is vertex original[i] of the whole mesh
    int vertex = -1;            // the vertex itself among the rows
};
Neighbourhood neighbourhood(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, int rings);

}   // namespace meshfolio::stability
