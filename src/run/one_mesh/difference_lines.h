/// @file
/// The results of `compare`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/measures/surface_distance.h"
#include "run/one_mesh/fields.h"
#include "scene/sight.h"

namespace meshfolio::run {

struct DifferenceLine {
    const char* key;     // "rms"; ends with the unit of an angle
    const char* title;   // for people
    double value;        // NaN: not defined
    const char* meaning;
    bool is_count = false;
};

struct Difference {
    bool same_triangles = false;
    std::vector<DifferenceLine> lines;
    std::optional<SurfaceDistances> distances;   // if they are compared as surfaces
    std::vector<std::string> warnings;           // about searches that reached a limit
};

/// True if both meshes have equally many vertices and equal lists of triangles.
bool have_same_triangles(const TriangleMesh& a, const TriangleMesh& b);

/// Returns distances, angles and ratios of b against a: vertex by vertex and face by face if have_same_triangles(), else as two surfaces.
/// @param as_surfaces  compare surfaces even if the triangles are equal
/// @param accuracy     of the Hausdorff distance, from least_accuracy to most_accuracy
/// @throws MeshError if a surface has no triangle
Difference difference_of(const TriangleMesh& a, const TriangleMesh& b, bool as_surfaces = false, double accuracy = default_accuracy);

/// Returns the JSON of `compare --json`: key → value of each line, null if undefined; same_triangles; for surfaces a histogram of the
/// distances of both.
std::string difference_json(const Difference& difference);

/// Returns the HTML page of `compare --html`: numbers, pictures and a histogram of distances.
std::string difference_page(const PreparedMesh& a, const PreparedMesh& b, const Difference& difference, const SurfaceDistances& distances,
                            const render::Sight& sight = {});

/// Returns the distance of each vertex to a surface as a field to draw, whose colours range over 1e-9 diagonals at least.
/// @param diagonal  of the box of one of the meshes
Field distance_field(Vector of_vertices, double diagonal);

inline constexpr int distance_bins = 40;   // of the histogram, from 0 to the Hausdorff distance

}   // namespace meshfolio::run
