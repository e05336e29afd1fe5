// A picture of the numbers of the triangles tells which triangle each pixel sees. A point of an isoline is visible if the pixel sees its
// own triangle, or another that is not nearer to the viewer. Segments are cut where they are hidden and joined where they cross an edge of
// two triangles.
#include "scene/isolines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <tuple>

#include "rounding.h"

namespace render {

namespace {

constexpr double step = 0.5;        // between tested points [pixels]
constexpr double tolerance = 1;     // of depths [pixels]
constexpr double steepest = 4;      // slope of a triangle that enters the tolerance
constexpr double smallest = 1;      // extent of a line: less is a dot at a peak [pixels]
constexpr double straight = 0.02;   // distance from a line at which a point is left out [pixels]

using Line = std::vector<glm::dvec2>;

/// The place where a level crosses an edge of the mesh.
using Crossing = std::tuple<double, int, int>;   // level, lower and higher vertex

/// A visible part of a segment; its ends are crossings unless the segment is hidden there.
struct Piece {
    std::array<glm::dvec2, 2> at;
    std::array<std::optional<Crossing>, 2> crossing;
};

class IsolineFinder {
public:
    IsolineFinder(const Surface& surface, const View& view, DrawOptions options) : surface_(surface), spacing_(options.isoline_spacing) {
        options.frame = frame_of(surface, view, options);
        for (const glm::dvec3& p : surface.positions) {
            const glm::dvec3 q = (p - options.frame->centre) * options.frame->pixels_per_unit;
            points_.emplace_back(0.5 * options.width + glm::dot(q, view.right()), 0.5 * options.height - glm::dot(q, view.up),
                                 glm::dot(q, view.from));
        }
        options.face_colors_from_id = true;
        options.edges = false;
        options.isoline_spacing = 0;
        options.marked_vertices = {};
        options.background = {0, 0, 0, 255};
        seen_ = draw_views({surface.positions, surface.triangles}, std::span(&view, 1), options).front();
    }

    std::vector<Line> lines() {
        for (std::size_t t = 0; t < surface_.triangles.size(); ++t)
            if (can_be_drawn(surface_.triangles[t], surface_.positions)) cross(static_cast<int>(t));
        return joined();
    }

private:
    const Surface& surface_;
    double spacing_;
    std::vector<glm::dvec3> points_;   // in the picture: x, y [pixels], and towards the viewer
    Image seen_;
    std::vector<Piece> pieces_;

    glm::dvec3 corner(int triangle, int k) const { return points_[index(surface_.triangles[index(triangle)][k])]; }

    /// Returns the triangle that a pixel sees; −1 for none.
    int triangle_at(int x, int y) const {
        if (x < 0 || y < 0 || x >= seen_.width || y >= seen_.height) return -1;
        const Rgba c = seen_.at(x, y);
        return (c.r << 16 | c.g << 8 | c.b) - 1;
    }

    bool shares_vertex(int a, int b) const {
        const glm::ivec3 &s = surface_.triangles[index(a)], &t = surface_.triangles[index(b)];
        for (int k = 0; k < 3; ++k)
            if (s[k] == t.x || s[k] == t.y || s[k] == t.z) return true;
        return false;
    }

    /// True if the plane of another triangle lies in front of a point. @param most  slope that enters the tolerance
    bool hides(int triangle, const glm::dvec3& p, double most) const {
        const glm::dvec3 a = corner(triangle, 0), n = glm::cross(corner(triangle, 1) - a, corner(triangle, 2) - a);
        if (n.z == 0) return false;
        const double slope = std::hypot(n.x, n.y) / std::abs(n.z), depth = a.z - (n.x * (p.x - a.x) + n.y * (p.y - a.y)) / n.z;
        return depth > p.z + tolerance + std::min(slope, most);
    }

    bool is_visible(int triangle, const glm::dvec3& p) const {
        const int x = static_cast<int>(std::floor(p.x)), y = static_cast<int>(std::floor(p.y));
        for (int v = y - 1; v <= y + 1; ++v)
            for (int u = x - 1; u <= x + 1; ++u)
                if (const int seen = triangle_at(u, v); seen >= 0)
                    if (seen == triangle || (shares_vertex(seen, triangle) && !hides(seen, p, INFINITY))) return true;
        const int seen = triangle_at(x, y);
        return seen >= 0 && !hides(seen, p, steepest);
    }

    /// Adds the visible pieces of all levels in a triangle. A vertex on a level counts as above it.
    void cross(int triangle) {
        const glm::ivec3& t = surface_.triangles[index(triangle)];
        const std::array<double, 3> values{surface_.values[index(t.x)], surface_.values[index(t.y)], surface_.values[index(t.z)]};
        const auto [low, high] = std::ranges::minmax(values);
        if (!std::isfinite(values[0] + values[1] + values[2])) return;
        for (double k = std::ceil(low / spacing_); k <= std::floor(high / spacing_); ++k) {
            const double level = k * spacing_;
            std::vector<std::pair<Crossing, glm::dvec3>> ends;
            for (int i = 0; i < 3; ++i) {
                int a = i, b = (i + 1) % 3;
                if ((values[index(a)] < level) == (values[index(b)] < level)) continue;
                if (t[a] > t[b]) std::swap(a, b);   // equal bits from both triangles
                const double share = (level - values[index(a)]) / (values[index(b)] - values[index(a)]);
                ends.push_back({{level, t[a], t[b]}, points_[index(t[a])] + share * (points_[index(t[b])] - points_[index(t[a])])});
            }
            if (ends.size() == 2) add_visible(triangle, ends[0], ends[1]);
        }
    }

    void add_visible(int triangle, const std::pair<Crossing, glm::dvec3>& a, const std::pair<Crossing, glm::dvec3>& b) {
        const int count = std::max(1, static_cast<int>(std::ceil(glm::distance(glm::dvec2(a.second), glm::dvec2(b.second)) / step)));
        const auto at = [&](double i) { return a.second + i / count * (b.second - a.second); };
        for (int first = 0, end = 0; first < count; first = end + 1) {
            for (end = first; end < count && is_visible(triangle, at(end + 0.5));) ++end;
            if (end == first) continue;
            pieces_.push_back({{glm::dvec2(at(first)), glm::dvec2(at(end))},
                               {first == 0 ? std::optional(a.first) : std::nullopt, end == count ? std::optional(b.first) : std::nullopt}});
        }
    }

    /// Joins pieces that end in one crossing.
    std::vector<Line> joined() const {
        struct End {
            std::size_t piece;
            int tip;
        };
        std::map<Crossing, std::vector<End>> ends;
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            for (const int tip : {0, 1})
                if (pieces_[i].crossing[index(tip)]) ends[*pieces_[i].crossing[index(tip)]].push_back({i, tip});
        std::vector<char> used(pieces_.size());
        // Returns the end of an unused piece that meets another piece's end, if only two meet there.
        const auto next = [&](std::size_t piece, int tip) -> std::optional<End> {
            const auto& crossing = pieces_[piece].crossing[index(tip)];
            if (!crossing || ends[*crossing].size() != 2) return {};
            for (const End& end : ends[*crossing])
                if (used[end.piece] == 0) return end;
            return {};
        };
        std::vector<Line> lines;
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            if (used[i] != 0) continue;
            used[i] = 1;
            Line line{pieces_[i].at[0], pieces_[i].at[1]};
            for (const int tip : {1, 0}) {   // forwards from the end, then backwards from the beginning
                std::optional<End> end = next(i, tip);
                for (; end; end = next(end->piece, 1 - end->tip)) {
                    used[end->piece] = 1;
                    line.push_back(pieces_[end->piece].at[index(1 - end->tip)]);
                }
                std::ranges::reverse(line);
            }
            const auto [low, high] = std::ranges::minmax(line, {}, &glm::dvec2::x);
            const auto [top, bottom] = std::ranges::minmax(line, {}, &glm::dvec2::y);
            if (high.x - low.x > smallest || bottom.y - top.y > smallest) lines.push_back(simplified(line));
        }
        return lines;
    }

    /// Leaves out points that lie between those that are kept.
    static Line simplified(const Line& line) {
        constexpr std::size_t longest = 64;   // points between two that are kept
        Line kept{line.front()};
        for (std::size_t last = 0, i = 1; i + 1 < line.size(); ++i) {
            const glm::dvec2 along = line[i + 1] - line[last];
            const double length = glm::length(along);
            const auto lies_between = [&](glm::dvec2 p) {
                const glm::dvec2 offset = p - line[last];
                return glm::dot(offset, along) >= 0 && glm::dot(offset, along) <= length * length &&
                       std::abs(along.x * offset.y - along.y * offset.x) <= straight * length;
            };
            if (i - last < longest && std::ranges::all_of(std::span(line).subspan(last + 1, i - last), lies_between)) continue;
            kept.push_back(line[last = i]);
        }
        kept.push_back(line.back());
        return kept;
    }
};

}   // namespace

std::vector<std::vector<glm::dvec2>> visible_isolines(const Surface& surface, const View& view, const DrawOptions& options) {
    if (options.isoline_spacing <= 0 || surface.values.empty()) return {};
    return IsolineFinder(surface, view, options).lines();
}

}   // namespace render
