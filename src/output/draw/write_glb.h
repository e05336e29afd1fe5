/// @file
/// Meshes with values at the vertices as binary glTF 2.0 (GLB), for the report's page and for other programs.
///
/// The file has one mesh with one primitive, and vertices keep their numbers. Positions have 16 bits on a grid over the box of the
/// triangles, normals 8 bits (KHR_mesh_quantization); the node's scale and translation restore the model's units. With values there are
/// also
///   COLOR_0   the colours of the values, linear light, normalised 16-bit
///   _VALUE    the values, float32; 0 where undefined
///   _DEFINED  1 where the value is defined, 0 elsewhere; present if some values are undefined
/// and the mesh's `extras` hold
///   value     {attribute, quantity, unit, range: [low, high], logarithmic, colormap, colors: ["#rrggbb", …] equally spaced over the
///              range (over its logarithm), defined: the mask's attribute or null, undefined_color}; absent without values
///   frame     {centre: [x, y, z], radius, from, up, zoom}: the ball that frames the pictures of the mesh, in the model's units, and the
///              direction of its three-quarter view; `zoom` is absent if it is 1
#pragma once

#include <optional>
#include <string>

#include "mesh/triangle_mesh.h"
#include "output/draw/figure_request.h"
#include "scene/camera.h"

namespace meshfolio::output {

/// The ball and view that frame a model: centre and radius in model units.
struct Ball {
    Vector3 centre = Vector3::Zero();
    double radius = 1;
    render::View view = render::three_quarter_view();
    double zoom = 1;   // of the pictures
};
/// Returns the smallest ball about the centre of the triangles' box that holds all their corners.
Ball ball_around(const TriangleMesh& mesh);

/// True if the mesh has triangles, finite coordinates only, and corners in more than one place.
bool can_be_a_model(const TriangleMesh& mesh);

/// Returns the mesh as the bytes of a GLB file; equal input gives equal bytes.
/// @param values  one a vertex, NaN if undefined; used only with `range`, beyond which colours but not values are clamped
/// @param frame  ball and view of the pictures, kept in `extras`; does not move the mesh
/// @throws MeshError unless can_be_a_model(mesh), or if `values` has the wrong size
std::string write_glb(const TriangleMesh& mesh, const Vector& values, const std::optional<ColorRange>& range, const Ball& frame);

}   // namespace meshfolio::output
