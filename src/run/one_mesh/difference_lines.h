/// @file
/// The results of `compare`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/measures/surface_distance.h"
#include "run/one_mesh/fields.h"

namespace meshfolio::run {

struct DifferenceLine {
    const char* key;     // "rms"; ends with its unit where that is an angle
    const char* title;   // the same for people
    double value;        // NaN: not defined
    const char* meaning;
    bool is_count = false;
};

struct Difference {
    bool same_triangles = false;
    std::vector<DifferenceLine> lines;
    std::optional<SurfaceDistances> distances;   // where they are compared as surfaces
    std::vector<std::string> warnings;           // of searches that reached a limit
};

/// The same vertices, by number, in the same triangles?
bool have_same_triangles(const TriangleMesh& a, const TriangleMesh& b);

/// b measured against a: vertex by vertex and face by face where they have the same triangles, as two surfaces where not.
/// @param as_surfaces  in any case
/// @param accuracy     of the Hausdorff distance, from least_accuracy to most_accuracy
/// @throws MeshError if a surface has no triangle
Difference difference_of(const TriangleMesh& a, const TriangleMesh& b, bool as_surfaces = false, double accuracy = default_accuracy);

/// The object that `compare --json` prints: the lines, and of surfaces the shares of both areas at distances in equal bins.
std::string difference_json(const Difference& difference);

/// The page of `compare --html`: numbers, pictures and distances of two meshes in one file.
std::string difference_page(const PreparedMesh& a, const PreparedMesh& b, const Difference& difference, const SurfaceDistances& distances);

/// The distance of each vertex to the other surface, as a field to draw. @param diagonal  of the box of one of them
Field distance_field(Vector of_vertices, double diagonal);

inline constexpr int distance_bins = 40;   // from 0 to the Hausdorff distance

}   // namespace meshfolio::run
