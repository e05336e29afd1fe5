#include "mesh/io/polygon_list.h"

#include <cmath>
#include <limits>
#include <utility>

#include "base/at.h"
#include "base/in_quotes.h"
#include "base/number_text.h"
#include "mesh/io/text_scanner.h"
#include "mesh/io/triangulate_polygon.h"
#include "mesh/point_table.h"

namespace meshfolio {

namespace {

/// Appends the triangles of polygons to a mesh whose positions are known.
class Triangulation {
public:
    Triangulation(LoadedMesh& loaded, WarningTally& warnings) : loaded_(loaded), warnings_(warnings) {}

    void add(std::span<const int> corners, long line) {
        if (corners.size() < 3)
            warnings_.add(line, "face with fewer than 3 vertices ignored", "faces with fewer than 3 vertices ignored");
        else if (corners.size() == 3)
            push(corners[0], corners[1], corners[2], line);
        else
            add_polygon(corners, line);
    }

    void finish() {
        if (triangles_.size() / 3 > static_cast<std::size_t>(most_triangles)) {
            throw InputError({loaded_.file, 0},
                             std::to_string(triangles_.size() / 3) + " triangles (limit " + std::to_string(most_triangles) + ")",
                             "simplify the mesh first");
        }
        loaded_.mesh.F = Eigen::Map<const Faces>(triangles_.data(), static_cast<Eigen::Index>(triangles_.size() / 3), 3);
        if (loaded_.mesh.F.rows() == 0) throw InputError({loaded_.file, 0}, "no triangles", "export the mesh with its faces");
    }

    void reserve(std::size_t triangles) {
        triangles_.reserve(3 * triangles);
        loaded_.face_lines.reserve(triangles);
    }

private:
    void push(int a, int b, int c, long line) {
        triangles_.insert(triangles_.end(), {a, b, c});
        if (line > 0) loaded_.face_lines.push_back(line);
    }

    /// A corner written twice in a row (a quad that is a triangle) is one corner.
    void add_polygon(std::span<const int> corners, long line) {
        distinct_.clear();
        for (const int v : corners)
            if (distinct_.empty() || distinct_.back() != v) distinct_.push_back(v);
        while (distinct_.size() > 1 && distinct_.back() == distinct_.front()) distinct_.pop_back();
        if (distinct_.size() < corners.size())
            warnings_.add(line, "repeated corner of a polygon ignored", "polygons with repeated corners, which are ignored");
        if (distinct_.size() <= 3) return add(distinct_, line);
        if (distinct_.size() > static_cast<std::size_t>(max_polygon_corners)) {
            throw InputError(
                {loaded_.file, line},
                "polygon of " + std::to_string(distinct_.size()) + " corners (limit " + std::to_string(max_polygon_corners) + ")",
                "triangulate it before export");
        }
        Positions X(static_cast<Eigen::Index>(distinct_.size()), 3);
        for (Eigen::Index i = 0; i < X.rows(); ++i) X.row(i) = loaded_.mesh.X.row(distinct_[static_cast<std::size_t>(i)]);
        const PolygonTriangles cut = triangulated_polygon(X);
        if (!cut.simple) {
            warnings_.add(line, "polygon crosses itself or has no area; its triangles may overlap",
                          "polygons cross themselves or have no area; their triangles may overlap");
        }
        if (cut.spikes > 0) {
            warnings_.add(line, "polygon goes out and back on the same line, which is left out",
                          "polygons go out and back on the same line, which is left out");
        }
        const auto vertex = [&](Eigen::Index t, int k) { return distinct_[static_cast<std::size_t>(cut.triangles(t, k))]; };
        for (Eigen::Index t = 0; t < cut.triangles.rows(); ++t) push(vertex(t, 0), vertex(t, 1), vertex(t, 2), line);
    }

    LoadedMesh& loaded_;
    WarningTally& warnings_;
    std::vector<int> triangles_;
    std::vector<int> distinct_;
};

}   // namespace

void WarningTally::add(long line, std::string_view one, std::string_view many, const std::string& example) {
    const auto kind = std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& k) { return k.many == many; });
    if (kind != kinds_.end())
        ++kind->count;
    else
        kinds_.push_back({one, many, example, line, 1});
}

std::vector<MeshWarning> WarningTally::warnings() const {
    std::vector<MeshWarning> warnings;
    for (const Kind& kind : kinds_) {
        std::string message = kind.count == 1 ? std::string(kind.one) : std::to_string(kind.count) + " " + std::string(kind.many);
        if (!kind.example.empty()) message += kind.count == 1 ? " (" + kind.example + ")" : " (first " + kind.example + ")";
        warnings.push_back({std::move(message), kind.line});
    }
    return warnings;
}

void PolygonList::reserve(std::size_t polygons) {
    corners_.reserve(3 * polygons);
    first_.reserve(polygons + 1);
}

void PolygonList::end_polygon(long line) {
    first_.push_back(corners_.size());
    if (line > 0) lines_.push_back(line);
}

LoadedMesh triangulated(const PolygonList& polygons, Positions X, const std::string& file, WarningTally warnings) {
    LoadedMesh loaded;
    loaded.mesh.X = std::move(X);
    loaded.file = file;
    Triangulation triangulation(loaded, warnings);
    triangulation.reserve(polygons.size());
    for (std::size_t i = 0; i < polygons.size(); ++i) triangulation.add(polygons.polygon(i), polygons.line(i));
    triangulation.finish();
    loaded.warnings = warnings.warnings();
    return loaded;
}

WeldedMesh welded(const std::vector<std::array<double, 3>>& points, std::span<const int> corners, const std::vector<long>& lines,
                  const std::string& file, WarningTally warnings, std::vector<std::size_t> groups) {
    if (groups.empty()) groups = {0};
    groups.push_back(points.size());
    std::vector<int> number(points.size()), first;
    for (std::size_t group = 0; group + 1 < groups.size(); ++group) {
        PointTable table(groups[group + 1] - groups[group]);
        const auto before = static_cast<int>(first.size());
        for (std::size_t i = groups[group]; i < groups[group + 1]; ++i) {
            number[i] = before + table.number_of(points[i]);
            if (at(number[i]) == first.size()) first.push_back(static_cast<int>(i));
        }
    }
    const std::size_t count = corners.empty() ? points.size() : corners.size();
    PolygonList triangles;
    triangles.reserve(count / 3);
    for (std::size_t i = 0; i < count; ++i) {
        triangles.add_corner(number[corners.empty() ? i : at(corners[i])]);
        if (i % 3 == 2) triangles.end_polygon(lines.empty() ? 0 : lines[i / 3]);
    }
    Positions X(static_cast<Eigen::Index>(first.size()), 3);
    for (Eigen::Index v = 0; v < X.rows(); ++v)
        X.row(v) = Eigen::Map<const Vector3>(points[at(first[static_cast<std::size_t>(v)])].data()).array() + 0.0;   // −0 is 0
    return {triangulated(triangles, std::move(X), file, std::move(warnings)), std::move(first), std::move(number)};
}

double checked_coordinate(std::string_view word, const std::string& file, long line) {
    const std::optional<double> x = parse_number(word);
    if (!x)
        throw InputError({file, line}, in_quotes(word) + " is not a finite number", "coordinates are decimal numbers such as 0.5 or -1e-3");
    check_range(*x, file, line);
    return *x;
}

bool fits_type(double x, ScalarType type) {
    return with_zero_of(type, [&](auto zero) {
        using Limits = std::numeric_limits<decltype(zero)>;
        return !Limits::is_integer ||
               (x >= static_cast<double>(Limits::lowest()) && x <= static_cast<double>(Limits::max()) && x == std::trunc(x));
    });
}

void check_range(double x, const std::string& file, long line) {
    if (std::abs(x) <= largest_coordinate) return;
    throw InputError({file, line}, "coordinate out of the supported range (1e100)", "scale the mesh down");
}

}   // namespace meshfolio
