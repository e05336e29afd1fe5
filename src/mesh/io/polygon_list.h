/// @file
/// What every reader ends with: positions and polygons of any size become a triangle mesh.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "base/errors.h"
#include "mesh/io/mesh_files.h"

namespace meshfolio {

/// Warnings of a reader: a file with 20 000 odd faces gives one line, not 20 000.
class WarningTally {
public:
    /// `one` is the whole message of a single case; of several it is "N `many`". The first one's line is kept, and its `example`
    /// stands in brackets. Cases of the same `many` are one kind.
    void add(long line, std::string_view one, std::string_view many, const std::string& example = "");

    /// One warning a kind, in the order of their first cases.
    std::vector<MeshWarning> warnings() const;

private:
    struct Kind {
        std::string_view one, many;   // string literals
        std::string example;
        long line;
        long long count;
    };
    std::vector<Kind> kinds_;
};

/// Largest magnitude of a coordinate: areas and volumes must stay within the range of a double.
inline constexpr double largest_coordinate = 1e100;

/// Three corners a triangle are counted in int elsewhere (Incidence::start).
inline constexpr long long most_triangles = std::numeric_limits<int>::max() / 3;

/// Polygons in file order, corner indices one after the other.
class PolygonList {
public:
    void reserve(std::size_t polygons);
    /// The next polygon is what was added by add_corner since the last call.
    void add_corner(int vertex) { corners_.push_back(vertex); }
    void end_polygon(long line);   // line 0: binary file

    std::size_t size() const { return first_.size() - 1; }
    std::span<const int> polygon(std::size_t i) const { return {corners_.data() + first_[i], first_[i + 1] - first_[i]}; }
    long line(std::size_t i) const { return lines_.empty() ? 0 : lines_[i]; }

private:
    std::vector<int> corners_;
    std::vector<std::size_t> first_{0};
    std::vector<long> lines_;   // empty for binary files
};

/// Triangulates. Corners must be indices of rows of X. Polygons of fewer than three corners are left out with a warning.
/// @throws InputError naming the polygon if one has more than max_polygon_corners, or if there is no triangle or too many
LoadedMesh triangulated(const PolygonList& polygons, Positions X, const std::string& file, WarningTally warnings);

/// A mesh whose file repeats a vertex for each of its faces or normals.
struct WeldedMesh {
    LoadedMesh loaded;
    std::vector<int> first;    // of each vertex, the first of the points there
    std::vector<int> vertex;   // of each point
};

/// Points with equal coordinates become one vertex, in the order of the first of them.
/// @param corners  of triangles, three each, as numbers of points; empty: the points one after the other
/// @param lines  of the triangles; empty: binary file
/// @param groups  ascending from 0: points from one of them to the next are welded with one another only; empty: all are
/// @throws InputError as `triangulated`
WeldedMesh welded(const std::vector<std::array<double, 3>>& points, std::span<const int> corners, const std::vector<long>& lines,
                  const std::string& file, WarningTally warnings, std::vector<std::size_t> groups = {});

/// A coordinate read from a file.
/// @throws InputError if `word` is not a finite decimal number or exceeds largest_coordinate
double checked_coordinate(std::string_view word, const std::string& file, long line);

/// Can a number of that type be x? Any can be one of floating point.
bool fits_type(double x, ScalarType type);

/// @throws InputError if x exceeds largest_coordinate
void check_range(double x, const std::string& file, long line);

}   // namespace meshfolio
