/// @file
/// All that is measured at the vertices of a mesh in one pass over them, for large meshes: what the functions of cotangent_laplacian.h,
/// vertex_areas.h and curvature.h return one by one.
#pragma once

#include "geometry/operators/cotangent_laplacian.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

struct MeshOperators {
    SparseMatrix C;                       // laplace_beltrami
    Vector barycentric, voronoi, mixed;   // vertex_areas of each form
    Vector angle_deficit;
    Vector H, K;   // cotangent_mean_curvature and gaussian_curvature with the chosen form of area

    const Vector& areas(AreaForm form) const {
        return form == AreaForm::barycentric ? barycentric : form == AreaForm::voronoi ? voronoi : mixed;
    }
};
/// Vertex by vertex, on all processors; the same bytes whatever their number.
/// @param topology  of this mesh; its edges and neighbours may be missing
/// @throws MeshError where it sees that the topology is that of another mesh
MeshOperators mesh_operators(const TriangleMesh& mesh, const MeshTopology& topology, AreaForm area = AreaForm::barycentric);

}   // namespace meshfolio
