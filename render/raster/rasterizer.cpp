// Pineda, A parallel algorithm for polygon rasterization, SIGGRAPH 1988: a sample is inside if three edge functions agree in sign.
//
// The fast path is for triangles up to 63 pixels, with edge functions that fit 32 bits. It has two steps over vectors:
//   1. set up as many triangles at once as a vector has lanes: fetch the corners, orient them, compute edge functions and depth;
//   2. draw them one after the other, a block of 16 samples (or a vector of them) at a time.
// Highway compiles this once for each instruction set and chooses the best one at run time. Without fused multiply-add and approximations,
// all sets give the same bits.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/rasterizer.cpp"
#include <hwy/foreach_target.h>

#include <hwy/cache_control.h>

#include "raster/rasterizer.h"
#include "raster/vectors-inl.h"
#include "rounding.h"

HWY_BEFORE_NAMESPACE();
namespace render::HWY_NAMESPACE {

/// Larger triangles take the slow path.
constexpr int largest_small = 63 * subpixels;

/// A number for each of the triangles that are set up together.
using Lanes = std::array<std::int32_t, block_samples>;
using FloatLanes = std::array<float, block_samples>;

/// Triangles ready to be drawn. The edge function E(p) = dx·y − dy·x + start, with p from the corner of the first block, is not negative
/// inside; edge k is opposite to corner k. The depth at p is depth + depth1·E₁ + depth2·E₂ (barycentric coordinates).
struct alignas(64) SmallTriangles {
    enum Kind : std::int32_t { unseen, small, wide };
    Lanes kind;
    std::array<Lanes, 3> dx, dy, start, across, down;   // the latter two: from a block to the next
    FloatLanes depth, depth1, depth2;
    Lanes first_column, last_column, first_row, last_row;   // blocks
};

/// One corner of each triangle of a vector: grid steps from the corner of the tile, and depth.
struct TileCorner {
    IntVector x, y, depth;
};

struct TileCornerFetcher {
    const GridVertex* vertices;
    const std::int32_t* triangles;
    std::size_t across, up, depth;
    IntVector left, top;

    TileCornerFetcher(const ProjectedScene& projected, const SampleTile& tile)
        : vertices(projected.vertices),
          triangles(&projected.scene.surface.triangles[0].x),
          across(index(projected.component[0])),
          up(index(projected.component[1])),
          depth(index(projected.component[2])),
          left(hn::Set(Ints(), projected.scene.width * half_pixel - tile.x() * subpixels)),
          top(hn::Set(Ints(), projected.scene.height * half_pixel - tile.y() * subpixels)) {}
    TileCorner corner(IntVector id, int k) const {
        const Ints d;
        const IntVector in_triangles = hn::Add(hn::Add(id, hn::ShiftLeft<1>(id)), hn::Set(d, k));
        const GridVectors v = grid_vectors(vertices, hn::GatherIndex(d, triangles, in_triangles));
        return {hn::Add(left, v.at[across]), hn::Sub(top, v.at[up]), v.at[depth]};
    }
};

HWY_INLINE void select(hn::Mask<Ints> take, const TileCorner& from, TileCorner& to) {
    to = {hn::IfThenElse(take, from.x, to.x), hn::IfThenElse(take, from.y, to.y), hn::IfThenElse(take, from.depth, to.depth)};
}

/// Exchanges b and c if the area is negative, then rotates the topmost corner (of these the leftmost) to the front, so that coincident
/// triangles get equal depths to the last bit, whatever the order of their corners. Returns twice the area.
HWY_INLINE IntVector orient(TileCorner& a, TileCorner& b, TileCorner& c, IntVector left, IntVector top) {
    const IntVector area = hn::Sub(hn::Mul(hn::Sub(b.x, a.x), hn::Sub(c.y, a.y)), hn::Mul(hn::Sub(b.y, a.y), hn::Sub(c.x, a.x)));
    const auto is_negative = hn::Lt(area, hn::Zero(Ints()));
    const TileCorner old_a = a, old_b = b;
    select(is_negative, c, b);
    select(is_negative, old_b, c);
    const auto place = [&](const TileCorner& p) HWY_ATTR { return hn::Add(hn::ShiftLeft<14>(hn::Sub(p.y, top)), hn::Sub(p.x, left)); };
    const IntVector of_a = place(a), of_b = place(b), of_c = place(c);
    const auto b_first = hn::And(hn::Lt(of_b, of_a), hn::Lt(of_b, of_c));
    const auto c_first = hn::And(hn::Lt(of_c, of_a), hn::Lt(of_c, of_b));
    const TileCorner oriented_b = b;
    select(b_first, b, a), select(b_first, c, b), select(b_first, old_a, c);
    const TileCorner after_a = a;
    select(c_first, c, a), select(c_first, oriented_b, c), select(c_first, after_a, b);
    return hn::Abs(area);
}

/// @param x, y  of the first block
HWY_INLINE void set_edge(const TileCorner& from, const TileCorner& to, IntVector x, IntVector y, int shift, std::size_t k, std::size_t lane,
                         SmallTriangles& result) {
    const Ints d;
    const IntVector dx = hn::Sub(to.x, from.x), dy = hn::Sub(to.y, from.y), zero = hn::Zero(d);
    // Samples on top and left edges belong to the triangle.
    const auto owns_samples = hn::Or(hn::Lt(dy, zero), hn::And(hn::Eq(dy, zero), hn::Gt(dx, zero)));
    const IntVector start = hn::Sub(hn::Mul(dx, hn::Sub(y, from.y)), hn::Mul(dy, hn::Sub(x, from.x)));
    hn::StoreU(dx, d, result.dx[k].data() + lane);
    hn::StoreU(dy, d, result.dy[k].data() + lane);
    hn::StoreU(hn::Sub(start, hn::IfThenElse(owns_samples, zero, hn::Set(d, 1))), d, result.start[k].data() + lane);
    hn::StoreU(hn::ShiftLeftSame(hn::Neg(dy), shift), d, result.across[k].data() + lane);
    hn::StoreU(hn::ShiftLeftSame(dx, shift), d, result.down[k].data() + lane);
}

/// The first and the last block with a sample line between low and high.
struct BlockSpan {
    IntVector first, last;

    BlockSpan(IntVector low, IntVector high, const SampleTile& tile) {
        const Ints d;
        const SamplePattern& pattern = tile.pattern();
        const int pitch = pattern.pitch_shift(), lines = pattern.block_shift() - pitch;
        const IntVector first_line = hn::ShiftRightSame(hn::Add(low, hn::Set(d, pattern.pitch - 1 - pattern.first)), pitch);
        const IntVector last_line = hn::ShiftRightSame(hn::Sub(high, hn::Set(d, pattern.first)), pitch);
        first = hn::Max(hn::ShiftRightSame(first_line, lines), hn::Zero(d));
        last = hn::Min(hn::ShiftRightSame(last_line, lines), hn::Set(d, tile.blocks_on_side() - 1));
    }
    void store(std::int32_t* to_first, std::int32_t* to_last) const {
        hn::StoreU(first, Ints(), to_first), hn::StoreU(last, Ints(), to_last);
    }
};

/// Sets up a vector of triangles, into the lanes of `result` from `lane` on.
HWY_INLINE void set_up(const TileCornerFetcher& fetch, const std::int32_t* ids, const SampleTile& tile, std::size_t lane,
                       SmallTriangles& result) {
    const Ints d;
    const Floats f;
    const IntVector id = hn::LoadU(d, ids);
    TileCorner a = fetch.corner(id, 0), b = fetch.corner(id, 1), c = fetch.corner(id, 2);
    const auto is_far = hn::Lt(hn::Min(a.depth, hn::Min(b.depth, c.depth)), hn::Set(d, GridVertex::far_off + 1));
    const IntVector left = hn::Min(a.x, hn::Min(b.x, c.x)), right = hn::Max(a.x, hn::Max(b.x, c.x));
    const IntVector top = hn::Min(a.y, hn::Min(b.y, c.y)), bottom = hn::Max(a.y, hn::Max(b.y, c.y));
    const auto is_large = hn::Gt(hn::Max(hn::Sub(right, left), hn::Sub(bottom, top)), hn::Set(d, largest_small));
    const IntVector area = orient(a, b, c, left, top);

    const BlockSpan columns(left, right, tile), rows(top, bottom, tile);
    columns.store(result.first_column.data() + lane, result.last_column.data() + lane);
    rows.store(result.first_row.data() + lane, result.last_row.data() + lane);
    const int shift = tile.pattern().block_shift();
    const IntVector x = hn::ShiftLeftSame(columns.first, shift), y = hn::ShiftLeftSame(rows.first, shift);
    set_edge(b, c, x, y, shift, 0, lane, result);
    set_edge(c, a, x, y, shift, 1, lane, result);
    set_edge(a, b, x, y, shift, 2, lane, result);
    const FloatVector inverse_area = hn::Div(hn::Set(f, 1.0F), hn::ConvertTo(f, area));
    const auto slope = [&](const TileCorner& p) HWY_ATTR { return hn::Mul(hn::ConvertTo(f, hn::Sub(p.depth, a.depth)), inverse_area); };
    hn::StoreU(hn::ConvertTo(f, a.depth), f, result.depth.data() + lane);
    hn::StoreU(slope(b), f, result.depth1.data() + lane);
    hn::StoreU(slope(c), f, result.depth2.data() + lane);

    const IntVector kind = hn::IfThenElse(hn::Eq(area, hn::Zero(d)), hn::Set(d, SmallTriangles::unseen), hn::Set(d, SmallTriangles::small));
    hn::StoreU(hn::IfThenElse(hn::Or(is_far, is_large), hn::Set(d, SmallTriangles::wide), kind), d, result.kind.data() + lane);
}

/// An edge function at a vector of samples, with its steps from block to block.
struct EdgeAtSamples {
    IntVector row, across, down;

    EdgeAtSamples(const SmallTriangles& t, std::size_t k, std::size_t i, IntVector x, IntVector y) {
        const Ints d;
        const IntVector to_sample = hn::Sub(hn::Mul(hn::Set(d, t.dx[k][i]), y), hn::Mul(hn::Set(d, t.dy[k][i]), x));
        row = hn::Add(hn::Set(d, t.start[k][i]), to_sample);
        across = hn::Set(d, t.across[k][i]), down = hn::Set(d, t.down[k][i]);
    }
};

/// Sets depth and triangle of the samples in the mask.
HWY_INLINE void see(hn::Mask<Ints> closer, FloatVector z, IntVector id, FloatVector old_depth, float* depth, std::int32_t* triangle) {
    const Ints d;
    const Floats f;
    hn::Store(hn::IfThenElse(hn::RebindMask(f, closer), z, old_depth), f, depth);
    hn::Store(hn::IfThenElse(closer, id, hn::Load(d, triangle)), d, triangle);
}

/// Draws triangle i of `t`, without branches on coverage: for a few blocks, a wrong prediction costs more.
HWY_INLINE void draw(const SmallTriangles& t, std::size_t i, std::int32_t id, SampleTile& tile) {
    const Ints d;
    const Floats f;
    const SamplePattern& pattern = tile.pattern();
    const IntVector ids = hn::Set(d, id), minus_one = hn::Set(d, -1);
    const FloatVector depth = hn::Set(f, t.depth[i]), depth1 = hn::Set(f, t.depth1[i]), depth2 = hn::Set(f, t.depth2[i]);
    for (std::size_t s = 0; s < block_samples; s += hn::Lanes(d)) {
        const IntVector x = hn::LoadU(d, pattern.x.data() + s), y = hn::LoadU(d, pattern.y.data() + s);
        EdgeAtSamples edge0(t, 0, i, x, y), edge1(t, 1, i, x, y), edge2(t, 2, i, x, y);
        for (int row = t.first_row[i]; row <= t.last_row[i]; ++row) {
            IntVector e0 = edge0.row, e1 = edge1.row, e2 = edge2.row;
            SampleBlock* block = tile.row(row) + t.first_column[i];
            for (int column = t.first_column[i]; column <= t.last_column[i]; ++column, ++block) {
                const auto inside = hn::Gt(hn::Or(e0, hn::Or(e1, e2)), minus_one);
                const FloatVector z = hn::Add(depth, hn::Add(hn::Mul(hn::ConvertTo(f, e1), depth1), hn::Mul(hn::ConvertTo(f, e2), depth2)));
                const FloatVector highest = hn::Load(f, block->highest.data() + s), lowest = hn::Load(f, block->lowest.data() + s);
                const auto above = hn::And(inside, hn::RebindMask(d, hn::Gt(z, highest)));
                const auto below = hn::And(inside, hn::RebindMask(d, hn::Lt(z, lowest)));
                see(above, z, ids, highest, block->highest.data() + s, block->top.data() + s);
                see(below, z, ids, lowest, block->lowest.data() + s, block->bottom.data() + s);
                e0 = hn::Add(e0, edge0.across), e1 = hn::Add(e1, edge1.across), e2 = hn::Add(e2, edge2.across);
            }
            edge0.row = hn::Add(edge0.row, edge0.down), edge1.row = hn::Add(edge1.row, edge1.down);
            edge2.row = hn::Add(edge2.row, edge2.down);
        }
    }
}

/// Prefetches the corners of the batch after the next, and the triangles two batches later.
HWY_INLINE void prefetch(const ProjectedScene& scene, std::span<const std::int32_t> ids, std::size_t begin) {
    const std::span<const glm::ivec3> triangles = scene.scene.surface.triangles;
    if (begin + 5 * std::size_t{block_samples} > ids.size()) return;
    for (std::size_t i = begin + 2 * std::size_t{block_samples}; i < begin + 3 * std::size_t{block_samples}; ++i) {
        hwy::Prefetch(&triangles[static_cast<std::size_t>(ids[i + 2 * std::size_t{block_samples}])]);
        const glm::ivec3& t = triangles[static_cast<std::size_t>(ids[i])];
        for (int k = 0; k < 3; ++k) hwy::Prefetch(scene.vertices + t[k]);
    }
}

void RasterizeAll(const ProjectedScene& scene, std::span<const std::int32_t> triangles, SampleTile& tile) {
    const TileCornerFetcher fetch(scene, tile);
    SmallTriangles ready;
    Lanes ids;
    for (std::size_t begin = 0; begin < triangles.size(); begin += block_samples) {
        const std::size_t count = std::min<std::size_t>(block_samples, triangles.size() - begin);
        for (std::size_t i = 0; i < block_samples; ++i) ids[i] = triangles[begin + std::min(i, count - 1)];
        prefetch(scene, triangles, begin);
        for (std::size_t lane = 0; lane < count; lane += hn::Lanes(Ints())) set_up(fetch, ids.data() + lane, tile, lane, ready);
        for (std::size_t i = 0; i < count; ++i)
            if (ready.kind[i] == SmallTriangles::small) draw(ready, i, ids[i], tile);
            else if (ready.kind[i] == SmallTriangles::wide) rasterize_wide(scene.exact_triangle(ids[i]), ids[i], tile);
    }
}

}   // namespace render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <algorithm>
#include <bit>
#include <utility>

#include "draw_mesh.h"

namespace render {

HWY_EXPORT(RasterizeAll);

SampleTile::SampleTile(const SamplePattern& pattern, WideBudget* budget)
    : pattern_(pattern),
      budget_(budget),
      blocks_on_side_(tile_side / pattern.block_side),
      blocks_(static_cast<std::size_t>(blocks_on_side_ * blocks_on_side_)),
      regions_(static_cast<std::size_t>(blocks_on_side_ * blocks_on_side_ / (SampleRegion::side * SampleRegion::side))) {}

void SampleTile::start(int x, int y) {
    static constexpr SampleBlock empty = [] {
        SampleBlock b{};
        b.highest.fill(-std::numeric_limits<float>::infinity()), b.lowest.fill(std::numeric_limits<float>::infinity());
        b.top.fill(no_triangle), b.bottom.fill(no_triangle);
        return b;
    }();
    x_ = x, y_ = y, spent_ = 0;
    wide_.fill({});
    std::fill(blocks_.begin(), blocks_.end(), empty);
    std::fill(regions_.begin(), regions_.end(), SampleRegion{});
}

bool SampleTile::repeats(const Triangle2& oriented) {
    std::uint64_t hash = 0;
    for (const ScreenPoint& p : oriented.corner)
        for (const std::uint64_t part :
             {static_cast<std::uint64_t>(p.x), static_cast<std::uint64_t>(p.y), std::bit_cast<std::uint64_t>(p.depth)})
            hash = (std::rotl(hash, 5) ^ part) * 0x9E3779B97F4A7C15U;   // golden ratio, Knuth 6.4
    return oriented == std::exchange(wide_[hash >> 58], oriented);
}

void SampleTile::spend_purse() {
    if (budget_ != nullptr) budget_->spend(spent_);
    spent_ = 0;
}

void WideBudget::spend(std::int64_t steps) {
    if ((steps_ -= steps) < 0) throw TooMuchOverdraw();
}

void WideBudget::list(std::int64_t entries) {
    if ((entries_ -= entries) < 0) throw TooMuchOverdraw();
}

void rasterize(const ProjectedScene& scene, std::span<const std::int32_t> triangles, SampleTile& tile) {
    if (!triangles.empty()) HWY_DYNAMIC_DISPATCH(RasterizeAll)(scene, triangles, tile);
}

}   // namespace render
#endif
