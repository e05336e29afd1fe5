/// @file
/// A mesh with values at its vertices as binary glTF 2.0 (GLB): to be turned in the report's page, or opened by other programs.
///
/// One mesh, one primitive. Vertices keep their numbers. Positions are 16-bit numbers on a grid over the box of the triangles, normals
/// 8-bit (KHR_mesh_quantization); the node's scale and translation lead back to the model's units. With values there are also
///   COLOR_0   their colours in the map, linear light, normalised 16-bit
///   _VALUE    the values themselves, float32; 0 where undefined
///   _DEFINED  1 where the value is defined, 0 where not; only when some are undefined
/// and the mesh's `extras` hold
///   value     {attribute, quantity, unit, range: [low, high], logarithmic, colormap, colors: ["#rrggbb", …] equally spaced over the
///              range (over its logarithm), defined: the mask's attribute or null, undefined_color}; absent without values
///   frame     {centre: [x, y, z], radius, from, up}: the ball that pictures of the mesh are framed on, in the model's units, and the
///   direction
///              that a picture from three quarters is seen from
#pragma once

#include <optional>
#include <string>

#include "mesh/triangle_mesh.h"
#include "output/draw/figure_request.h"
#include "scene/camera.h"

namespace meshfolio::output {

struct Ball {
    Vector3 centre = Vector3::Zero();
    double radius = 1;
    render::View view = render::three_quarter_view();   // of its pictures from three quarters
};
/// About the centre of the box of the triangles' corners, reaching the farthest of them.
Ball ball_around(const TriangleMesh& mesh);

/// Does the mesh have triangles, finite coordinates only, and corners that are not all one point?
bool can_be_a_model(const TriangleMesh& mesh);

/// The same bytes for the same input.
/// @param values  one a vertex, NaN where undefined; used only with `range`; values beyond it are clamped in colour only
/// @throws MeshError unless can_be_a_model, and if `values` has the wrong size
std::string write_glb(const TriangleMesh& mesh, const Vector& values, const std::optional<ColorRange>& range, const Ball& frame);

}   // namespace meshfolio::output
