/// @file
/// The last steps of every reader: checks of numbers, and a triangle mesh from positions and polygons of any size.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/errors.h"
#include "mesh/io/mesh_files.h"

namespace meshfolio {

/// Warnings of a reader, one per kind: a file with 20 000 odd faces gives one line, not 20 000.
class WarningTally {
public:
    /// Counts a case of the kind `many`, a phrase in the plural. The message is `one` for one case, else "N `many`", with the line and the
    /// `example` of the first.
    void add(long line, std::string_view one, std::string_view many, const std::string& example = "");

    /// Returns one warning per kind, in the order of their first cases.
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

/// Largest magnitude of a coordinate, so that areas and volumes stay within the range of a double.
inline constexpr double largest_coordinate = 1e100;

/// Largest number of triangles: three corners each are counted by int (Incidence::start).
inline constexpr long long most_triangles = std::numeric_limits<int>::max() / 3;

/// Polygons in file order, corner indices one after the other.
class PolygonList {
public:
    void reserve(std::size_t polygons);
    void add_corner(int vertex) { corners_.push_back(vertex); }
    /// Makes the corners added since the last call the next polygon. @param line  of the file; 0: binary file
    void end_polygon(long line);

    void add_polygon(std::span<const int> corners, long line);
    /// Adds the triangles of a strip, every second one turned, so that all face the same side. @param line  of the file, for messages
    void add_strip(std::span<const int> corners, long line);

    std::size_t size() const { return first_.size() - 1; }
    std::span<const int> polygon(std::size_t i) const { return {corners_.data() + first_[i], first_[i + 1] - first_[i]}; }
    long line(std::size_t i) const { return lines_.empty() ? 0 : lines_[i]; }

private:
    std::vector<int> corners_;
    std::vector<std::size_t> first_{0};
    std::vector<long> lines_;   // empty for binary files
};

/// Returns the mesh of the triangulated polygons, with the warnings. Corners must be indices of rows of X. Polygons of fewer than three
/// corners are left out with a warning.
/// @throws InputError naming the polygon if one has more than max_polygon_corners, or if there is no triangle or too many
LoadedMesh triangulated(const PolygonList& polygons, Positions X, const std::string& file, WarningTally warnings);

/// The mesh of a file that repeats vertices.
struct WeldedMesh {
    LoadedMesh loaded;
    std::vector<int> first;    // the first point of each vertex
    std::vector<int> vertex;   // the vertex of each point
};

/// Returns the mesh in which points with equal coordinates are one vertex, in the order of their first points.
/// @param corners  three points per triangle; empty: the points in order
/// @param lines  of the triangles; empty: binary file
/// @param groups  first points of groups, ascending from 0; points are welded within a group only; empty: one group
/// @throws InputError as `triangulated`
WeldedMesh welded(const std::vector<std::array<double, 3>>& points, std::span<const int> corners, const std::vector<long>& lines,
                  const std::string& file, WarningTally warnings, std::vector<std::size_t> groups = {});

/// Returns the number that a word of a file stands for.
/// @throws InputError if `word` is not a finite decimal number or exceeds largest_coordinate
double checked_coordinate(std::string_view word, const std::string& file, long line);

/// True if the type has the value x; types of floating point have any value.
bool fits_type(double x, ScalarType type);

/// Returns the number that a word of a file stands for, or nothing if the type has no such value. NaN and infinities are values of floating
/// point.
std::optional<double> value_of_type(std::string_view word, ScalarType type);

/// Returns "1 vertex", "2 vertices" and so on.
inline std::string vertex_count(long long n) { return std::to_string(n) + (n == 1 ? " vertex" : " vertices"); }

/// Checks a coordinate. @throws InputError if |x| exceeds largest_coordinate or x is NaN
void check_range(double x, const std::string& file, long line);

}   // namespace meshfolio
