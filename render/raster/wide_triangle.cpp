// A tile is divided into regions; a region that the triangle misses, or in which it is hidden from both sides, costs one test. A mesh that
// blew up such that all triangles cover the whole picture takes time proportional to triangles times tiles: 0.1 ms a triangle at 1024 ×
// 1024. A triangle that repeats another costs a comparison, and WideBudget ends drawing that would take minutes.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "raster/rasterizer.h"

namespace render {

namespace {

__extension__ using Integer = __int128;   // for edge functions of corners far off, which need 107 bits

/// Makes the area of `t` positive by an exchange of two corners if needed, and returns it doubled. Rotates the topmost corner to the front,
/// so that coincident triangles get equal depths to the last bit, whatever the order of their corners.
Integer oriented(Triangle2& t) {
    const ScreenPoint &a = t.corner[0], &b = t.corner[1], &c = t.corner[2];
    const Integer area = Integer(b.x - a.x) * Integer(c.y - a.y) - Integer(b.y - a.y) * Integer(c.x - a.x);
    if (area < 0) std::swap(t.corner[1], t.corner[2]);
    const auto place = [](const ScreenPoint& p) { return std::pair(p.y, p.x); };
    std::rotate(t.corner.begin(), std::ranges::min_element(t.corner, {}, place), t.corner.end());
    return area < 0 ? -area : area;
}

/// A rectangle of blocks of a tile, with both ends.
struct Blocks {
    int x0, x1, y0, y1;
};

/// E(p) = (b − a) × (p − a) + bias, not negative at the samples on the inner side of the edge from a to b.
struct EdgeFunction {
    std::int64_t dx, dy;
    Integer at_tile;   // the value at the upper left corner of the tile

    EdgeFunction(const ScreenPoint& a, const ScreenPoint& b, const SampleTile& tile)
        : dx(b.x - a.x),
          dy(b.y - a.y),
          at_tile(value(std::int64_t{subpixels} * tile.x() - a.x, std::int64_t{subpixels} * tile.y() - a.y) - (owns_samples() ? 0 : 1)) {}
    bool owns_samples() const { return dy < 0 || (dy == 0 && dx > 0); }   // top and left edges
    Integer value(std::int64_t x, std::int64_t y) const { return Integer(dx) * y - Integer(dy) * x; }
    Integer at(std::int64_t x, std::int64_t y) const { return at_tile + value(x, y); }
};

/// The plane through the corners, with depths clamped to those of the corners, which matters for thin triangles.
struct DepthPlane {
    double at_corner, across, down, lowest, highest;
    std::int64_t x, y;   // of the first corner

    DepthPlane(const Triangle2& t, Integer area) : at_corner(t.corner[0].depth), x(t.corner[0].x), y(t.corner[0].y) {
        const ScreenPoint &a = t.corner[0], &b = t.corner[1], &c = t.corner[2];
        const double bz = b.depth - a.depth, cz = c.depth - a.depth, twice_area = static_cast<double>(area);
        const auto d = [](std::int64_t p, std::int64_t q) { return static_cast<double>(p - q); };
        across = (bz * d(c.y, a.y) - cz * d(b.y, a.y)) / twice_area;
        down = (cz * d(b.x, a.x) - bz * d(c.x, a.x)) / twice_area;
        lowest = std::min(a.depth, std::min(b.depth, c.depth));
        highest = std::max(a.depth, std::max(b.depth, c.depth));
    }
    double at(std::int64_t px, std::int64_t py) const {
        return std::clamp(at_corner + across * static_cast<double>(px - x) + down * static_cast<double>(py - y), lowest, highest);
    }
};

class WideTriangle {
public:
    WideTriangle(const Triangle2& t, Integer area, std::int32_t id, SampleTile& tile)
        : edges_{{{t.corner[0], t.corner[1], tile}, {t.corner[1], t.corner[2], tile}, {t.corner[2], t.corner[0], tile}}},
          depth_(t, area),
          id_(id),
          tile_(tile),
          shift_(tile.pattern().block_shift()) {}

    void draw(const Blocks& all) {
        for (int y = all.y0 / side; y <= all.y1 / side; ++y)
            for (int x = all.x0 / side; x <= all.x1 / side; ++x) {
                const Blocks part{std::max(all.x0, x * side), std::min(all.x1, (x + 1) * side - 1), std::max(all.y0, y * side),
                                  std::min(all.y1, (y + 1) * side - 1)};
                SampleRegion& region = tile_.region(x, y);
                tile_.spend(1);
                if (misses(part) || is_hidden(part, region)) continue;
                tile_.spend(4 * (part.x1 - part.x0 + 1) * (part.y1 - part.y0 + 1));
                const bool full = fills(part);
                for (int by = part.y0; by <= part.y1; ++by)
                    for (int bx = part.x0; bx <= part.x1; ++bx) full ? fill_block(bx, by) : draw_block(bx, by);
                update(region, x, y);
            }
    }

private:
    static constexpr int side = SampleRegion::side;

    std::int64_t steps(int blocks) const { return std::int64_t{blocks} << shift_; }

    /// True if an edge function is negative at all four corners.
    bool misses(const Blocks& part) const {
        return std::any_of(edges_.begin(), edges_.end(), [&](const EdgeFunction& e) {
            return e.at(steps(e.dy > 0 ? part.x0 : part.x1 + 1), steps(e.dx > 0 ? part.y1 + 1 : part.y0)) < 0;
        });
    }
    /// True if all edge functions are positive at all four corners.
    bool fills(const Blocks& part) const {
        return std::all_of(edges_.begin(), edges_.end(), [&](const EdgeFunction& e) {
            return e.at(steps(e.dy > 0 ? part.x1 + 1 : part.x0), steps(e.dx > 0 ? part.y0 : part.y1 + 1)) > 0;
        });
    }

    /// True if every sample of the region sees other triangles above and below this one.
    bool is_hidden(const Blocks& part, const SampleRegion& region) const {
        double low = depth_.highest, high = depth_.lowest;
        const std::int64_t left = std::int64_t{subpixels} * tile_.x(), top = std::int64_t{subpixels} * tile_.y();
        for (const int y : {part.y0, part.y1 + 1})
            for (const int x : {part.x0, part.x1 + 1}) {
                const double z = depth_.at(left + steps(x), top + steps(y));
                low = std::min(low, z), high = std::max(high, z);
            }
        const double rounding = 1e-6 * (std::abs(low) + std::abs(high));   // more than float depths lose
        return high + rounding < double(region.floor) && low - rounding > double(region.ceiling);
    }

    /// Sets the limits of the region at (x, y) from its samples.
    void update(SampleRegion& region, int x, int y) {
        region = {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
        const int left = x * side;
        for (int by = y * side; by < (y + 1) * side; ++by)
            for (const SampleBlock* b = tile_.row(by) + left; b != tile_.row(by) + left + side; ++b)
                for (std::size_t s = 0; s < block_samples; ++s) {
                    region.floor = std::min(region.floor, b->highest[s]);
                    region.ceiling = std::max(region.ceiling, b->lowest[s]);
                }
    }

    void draw_block(int bx, int by) {
        const Blocks block{bx, bx, by, by};
        if (misses(block)) return;
        fills(block) ? fill_block(bx, by) : draw_samples(bx, by);
    }

    using Depths = std::array<float, block_samples>;

    /// Draws all samples of a block. Depths lie between those of the corners, so that float suffices inside the block.
    void fill_block(int bx, int by) {
        const SamplePattern& pattern = tile_.pattern();
        const auto corner = static_cast<float>(depth_.at(tile_.x() * subpixels + steps(bx), tile_.y() * subpixels + steps(by)));
        const auto across = static_cast<float>(depth_.across), down = static_cast<float>(depth_.down);
        const auto lowest = static_cast<float>(depth_.lowest), highest = static_cast<float>(depth_.highest);
        Depths z;
        for (std::size_t s = 0; s < block_samples; ++s) {
            const float plane = corner + (across * static_cast<float>(pattern.x[s]) + down * static_cast<float>(pattern.y[s]));
            z[s] = std::min(std::max(plane, lowest), highest);
        }
        see(z, id_, tile_.row(by)[bx]);
    }
    /// Draws the samples of a block that lie inside the triangle.
    void draw_samples(int bx, int by) {
        const SamplePattern& pattern = tile_.pattern();
        const std::int64_t x0 = steps(bx), y0 = steps(by);
        const std::int64_t left = std::int64_t{subpixels} * tile_.x() + x0, top = std::int64_t{subpixels} * tile_.y() + y0;
        Depths z;
        for (std::size_t s = 0; s < block_samples; ++s) {
            const std::int64_t x = pattern.x[s], y = pattern.y[s];
            const auto is_outside = [&](const EdgeFunction& edge) { return edge.at(x0 + x, y0 + y) < 0; };
            const bool outside = std::any_of(edges_.begin(), edges_.end(), is_outside);
            z[s] = outside ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(depth_.at(left + x, top + y));
        }
        see(z, id_, tile_.row(by)[bx]);
    }
    /// Sets depth and triangle of the samples that see depth z; NaN is never seen.
    static void see(const Depths& z, std::int32_t id, SampleBlock& block) {
        for (std::size_t s = 0; s < block_samples; ++s) block.top[s] = z[s] > block.highest[s] ? id : block.top[s];
        for (std::size_t s = 0; s < block_samples; ++s) block.bottom[s] = z[s] < block.lowest[s] ? id : block.bottom[s];
        for (std::size_t s = 0; s < block_samples; ++s) block.highest[s] = z[s] > block.highest[s] ? z[s] : block.highest[s];
        for (std::size_t s = 0; s < block_samples; ++s) block.lowest[s] = z[s] < block.lowest[s] ? z[s] : block.lowest[s];
    }

    std::array<EdgeFunction, 3> edges_;
    DepthPlane depth_;
    std::int32_t id_;
    SampleTile& tile_;
    int shift_;
};

/// Returns the first and the last block of the tile that meet [low, high] on one axis.
std::pair<int, int> blocks_between(std::int64_t low, std::int64_t high, int tile_origin, const SampleTile& tile) {
    const int shift = tile.pattern().block_shift();
    const std::int64_t origin = std::int64_t{tile_origin} * subpixels, last = tile.blocks_on_side() - 1;
    return {static_cast<int>(std::clamp<std::int64_t>((low - origin) >> shift, 0, last + 1)),
            static_cast<int>(std::clamp<std::int64_t>((high - origin) >> shift, -1, last))};
}

}   // namespace

void rasterize_wide(const Triangle2& triangle, std::int32_t id, SampleTile& tile) {
    Triangle2 t = triangle;
    const auto [left, right] = std::minmax({t.corner[0].x, t.corner[1].x, t.corner[2].x});
    const auto [top, bottom] = std::minmax({t.corner[0].y, t.corner[1].y, t.corner[2].y});
    const std::int64_t farthest = std::max(std::max(-left, right), std::max(-top, bottom));
    if (farthest > largest_coordinate) return;
    const auto [x0, x1] = blocks_between(left, right, tile.x(), tile);
    const auto [y0, y1] = blocks_between(top, bottom, tile.y(), tile);
    if (x0 > x1 || y0 > y1) return;
    tile.spend(10);
    const Integer area = oriented(t);
    if (area != 0 && !tile.repeats(t)) WideTriangle(t, area, id, tile).draw({x0, x1, y0, y1});
}

}   // namespace render
