#include "mesh/io/polygon_list.h"

#include <charconv>
#include <utility>

#include "base/at.h"
#include "base/in_quotes.h"
#include "base/number_text.h"
#include "mesh/io/text_scanner.h"
#include "mesh/io/triangulate_polygon.h"
#include "mesh/point_table.h"

namespace meshfolio {

namespace {

/// Appends the triangles of polygons to a mesh with known positions.
class Triangulation {
public:
    Triangulation(LoadedMesh& loaded, WarningTally& warnings, std::size_t polygons) : loaded_(loaded), warnings_(warnings) {
        triangles_.reserve(3 * polygons);
        loaded_.face_lines.reserve(polygons);
    }

    void add(std::span<const int> corners, long line) {
        if (corners.size() < 3) warnings_.add(line, "face with fewer than 3 vertices ignored", "faces with fewer than 3 vertices ignored");
        else if (corners.size() == 3) push(corners[0], corners[1], corners[2], line);
        else add_polygon(corners, line);
    }

    void finish() {
        const std::size_t count = triangles_.size() / 3;
        if (count > static_cast<std::size_t>(most_triangles))
            throw InputError({loaded_.file, 0}, std::to_string(count) + " triangles (limit " + std::to_string(most_triangles) + ")",
                             "simplify the mesh first");
        if (count == 0) throw InputError({loaded_.file, 0}, "no triangles", "export the mesh with its faces");
        loaded_.mesh.F = Eigen::Map<const Faces>(triangles_.data(), static_cast<Eigen::Index>(count), 3);
    }

private:
    void push(int a, int b, int c, long line) {
        triangles_.insert(triangles_.end(), {a, b, c});
        if (line > 0) loaded_.face_lines.push_back(line);
    }

    /// Counts a corner that is written twice in a row (as in a quad that is a triangle) once.
    void add_polygon(std::span<const int> corners, long line) {
        distinct_.clear();
        for (const int v : corners)
            if (distinct_.empty() || distinct_.back() != v) distinct_.push_back(v);
        while (distinct_.size() > 1 && distinct_.back() == distinct_.front()) distinct_.pop_back();
        if (distinct_.size() < corners.size())
            warnings_.add(line, "repeated corner of a polygon ignored", "polygons with repeated corners, which are ignored");
        if (distinct_.size() <= 3) return add(distinct_, line);
        if (distinct_.size() > at(max_polygon_corners))
            throw InputError(
                {loaded_.file, line},
                "polygon of " + std::to_string(distinct_.size()) + " corners (limit " + std::to_string(max_polygon_corners) + ")",
                "triangulate it before export");
        const PolygonTriangles cut = triangulated_polygon(loaded_.mesh.X(distinct_, Eigen::all));
        if (!cut.simple)
            warnings_.add(line, "polygon crosses itself or has no area; its triangles may overlap",
                          "polygons cross themselves or have no area; their triangles may overlap");
        if (cut.spikes > 0)
            warnings_.add(line, "polygon goes out and back on the same line, which is left out",
                          "polygons go out and back on the same line, which is left out");
        for (const auto& t : cut.triangles.rowwise()) push(distinct_[at(t[0])], distinct_[at(t[1])], distinct_[at(t[2])], line);
    }

    LoadedMesh& loaded_;
    WarningTally& warnings_;
    std::vector<int> triangles_;
    std::vector<int> distinct_;
};

}   // namespace

void WarningTally::add(long line, std::string_view one, std::string_view many, const std::string& example) {
    const auto kind = std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& k) { return k.many == many; });
    if (kind != kinds_.end()) ++kind->count;
    else kinds_.push_back({one, many, example, line, 1});
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

void PolygonList::add_polygon(std::span<const int> corners, long line) {
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    end_polygon(line);
}

void PolygonList::add_strip(std::span<const int> corners, long line) {
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        const std::size_t turned = i % 2;
        add_polygon(std::array{corners[i + turned], corners[i + 1 - turned], corners[i + 2]}, line);
    }
}

LoadedMesh triangulated(const PolygonList& polygons, Positions X, const std::string& file, WarningTally warnings) {
    LoadedMesh loaded{{std::move(X), {}}, file, {}, {}};
    Triangulation triangulation(loaded, warnings, polygons.size());
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

std::optional<double> value_of_type(std::string_view word, ScalarType type) {
    std::optional<double> x = parse_number(word);
    if (!x && !is_integer(type)) {   // "nan", "-inf" or "Infinity", in letters of any case
        word.remove_prefix(word.starts_with('+') ? 1 : 0);
        double number = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (error == std::errc{} && end == word.data() + word.size() && !std::isfinite(number)) x = number;
    }
    return x && fits_type(*x, type) ? x : std::nullopt;
}

void check_range(double x, const std::string& file, long line) {
    if (std::abs(x) <= largest_coordinate) return;
    throw InputError({file, line}, "coordinate out of the supported range (1e100)", "scale the mesh down");
}

}   // namespace meshfolio
