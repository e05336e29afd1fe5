/// @file
/// The area A_i that belongs to a vertex: an integral over the triangles around it, in each of three forms.
#pragma once

#include <string>
#include <string_view>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

enum class AreaForm { barycentric, voronoi, mixed };

/// Returns "barycentric", "voronoi" or "mixed".
std::string_view name_of(AreaForm form);
/// Returns the form of this name.
/// @throws UsageError naming the known forms
AreaForm area_form_named(const std::string& name);

/// Returns n areas; 0 for unreferenced vertices. [length²]
/// barycentric: a third of the triangles around. voronoi: Σ (cot α |e|² + cot β |e|²)/8, the circumcentric cell, which may be
/// ≤ 0 at obtuse triangles. mixed: Meyer et al. 2003, voronoi in non-obtuse triangles, else ½ or ¼ of the triangle.
/// A triangle whose area is rounding noise (|u × v| ≤ 1e-12 of its longest squared edge) adds nothing to voronoi areas.
Vector vertex_areas(const TriangleMesh& mesh, AreaForm form);
/// Returns n areas from the m × 3 edge lengths of glued intrinsic triangles; corners of a triangle may be the same vertex.
/// @throws MeshError if the sizes do not fit, an index is not a vertex, or a length is negative or not finite
Vector vertex_areas(const Faces& F, int vertex_count, const CornerValues& lengths, AreaForm form);

}   // namespace meshfolio
