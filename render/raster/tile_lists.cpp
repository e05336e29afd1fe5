// One pass over the triangles serves all projections: it fetches their corners once, for as many triangles at a time as a vector has lanes.
// Parts of the triangles are sorted by counting, each by itself, so that the lists do not depend on the number of threads.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/tile_lists.cpp"
#include <hwy/foreach_target.h>

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <limits>

#include "raster/tile_lists.h"
#include "raster/vectors-inl.h"

#ifndef RENDER_TILE_CODES
#define RENDER_TILE_CODES

namespace render {

/// The tiles that a triangle meets: the number of one tile; or, negative, the first of several with the numbers of further ones across and
/// down, or `exact` if exact coordinates must decide. The number of all tiles stands for a triangle without samples.
struct TileCode {
    static constexpr int across_shift = 16, down_shift = 23, most_more = 127;
    static constexpr std::int32_t several = std::numeric_limits<std::int32_t>::min(), exact = several | 1 << 30;
};

/// The rows and columns of samples, and the tiles that they belong to.
struct SampleLines {
    int first, pitch, pitch_shift, tile_shift;     // the latter: log2 of the lines of a tile
    std::array<std::int32_t, 2> columns_of_rows;   // as in SamplePattern
    std::int32_t columns, rows;                    // of tiles
};

}   // namespace render
#endif

HWY_BEFORE_NAMESPACE();
namespace render::HWY_NAMESPACE {

/// The boxes of a vector of triangles, component by component.
struct Boxes {
    std::array<IntVector, 3> low, high;
    hn::Mask<Ints> is_known;   // indices in range

    Boxes(const std::int32_t* triangles, const ProjectedScene& projected) {
        const Ints d;
        IntVector a, b, c;
        hn::LoadInterleaved3(d, triangles, a, b, c);
        const IntVector count = hn::Set(d, static_cast<std::int32_t>(projected.scene.vertices.size())), minus_one = hn::Set(d, -1);
        is_known = hn::And(hn::Gt(hn::Min(a, hn::Min(b, c)), minus_one), hn::Lt(hn::Max(a, hn::Max(b, c)), count));
        const GridVectors pa = grid_vectors(projected.vertices, hn::IfThenElseZero(is_known, a)),
                          pb = grid_vectors(projected.vertices, hn::IfThenElseZero(is_known, b)),
                          pc = grid_vectors(projected.vertices, hn::IfThenElseZero(is_known, c));
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = hn::Min(pa.at[k], hn::Min(pb.at[k], pc.at[k]));
            high[k] = hn::Max(pa.at[k], hn::Max(pb.at[k], pc.at[k]));
        }
    }
};

/// The first and the last sample line in [low, high], and their tiles.
struct LineSpan {
    IntVector begin, end, first, last;
    hn::Mask<Ints> is_empty;

    LineSpan(IntVector low, IntVector high, const SampleLines& lines, std::int32_t tiles) {
        const Ints d;
        begin = hn::ShiftRightSame(hn::Add(low, hn::Set(d, lines.pitch - 1 - lines.first)), lines.pitch_shift);
        end = hn::ShiftRightSame(hn::Sub(high, hn::Set(d, lines.first)), lines.pitch_shift);
        first = hn::Max(hn::ShiftRightSame(begin, lines.tile_shift), hn::Zero(d));
        last = hn::Min(hn::ShiftRightSame(end, lines.tile_shift), hn::Set(d, tiles - 1));
        is_empty = hn::Or(hn::Gt(begin, end), hn::Gt(first, last));
    }
};

/// True for boxes that hold no sample and have one or two rows of samples and up to eight columns. Rows and columns repeat after two
/// pixels: bit c of byte r is set if column c of row r has a sample.
HWY_INLINE hn::Mask<Ints> holds_no_sample(const LineSpan& columns, const LineSpan& rows, const SampleLines& lines) {
    const Ints d;
    const hn::RebindToUnsigned<Ints> u;
    const auto byte_of = [&](IntVector row) HWY_ATTR {
        const auto upper = hn::Ne(hn::And(row, hn::Set(d, 4)), hn::Zero(d));
        const IntVector four = hn::IfThenElse(upper, hn::Set(d, lines.columns_of_rows[1]), hn::Set(d, lines.columns_of_rows[0]));
        const IntVector shift = hn::ShiftLeft<3>(hn::And(row, hn::Set(d, 3)));
        return hn::And(hn::Shr(hn::BitCast(u, four), hn::BitCast(u, shift)), hn::Set(u, 255));
    };
    const auto some = hn::Or(byte_of(rows.begin), byte_of(rows.end));
    const auto from = hn::BitCast(u, hn::And(columns.begin, hn::Set(d, 7)));
    const IntVector wide = hn::Sub(columns.end, columns.begin), high = hn::Sub(rows.end, rows.begin);
    const auto is_small = hn::And(hn::Lt(wide, hn::Set(d, 8)), hn::Lt(high, hn::Set(d, 2)));
    const auto behind =
        hn::Shl(hn::Set(u, 2), hn::BitCast(u, hn::Min(hn::Max(wide, hn::Zero(d)), hn::Set(d, 7))));   // the bit after the last column
    const auto seen = hn::And(hn::Shr(hn::Or(some, hn::ShiftLeft<8>(some)), from), hn::Sub(behind, hn::Set(u, 1)));
    return hn::And(is_small, hn::Eq(hn::BitCast(d, seen), hn::Zero(d)));
}

/// Returns the TileCode of each triangle of a vector.
HWY_INLINE IntVector tile_codes(const Boxes& box, const ProjectedScene& projected, const SampleLines& lines) {
    const Ints d;
    const auto across = static_cast<std::size_t>(projected.component[0]), up = static_cast<std::size_t>(projected.component[1]);
    const IntVector middle_x = hn::Set(d, projected.scene.width * (subpixels / 2)),
                    middle_y = hn::Set(d, projected.scene.height * (subpixels / 2));
    const LineSpan x(hn::Add(middle_x, box.low[across]), hn::Add(middle_x, box.high[across]), lines, lines.columns);
    const LineSpan y(hn::Sub(middle_y, box.high[up]), hn::Sub(middle_y, box.low[up]), lines, lines.rows);
    const IntVector tile = hn::Add(hn::Mul(y.first, hn::Set(d, lines.columns)), x.first), most = hn::Set(d, TileCode::most_more);
    const IntVector more_x = hn::Sub(x.last, x.first), more_y = hn::Sub(y.last, y.first);
    const IntVector more = hn::Or(hn::ShiftLeft<TileCode::across_shift>(more_x), hn::ShiftLeft<TileCode::down_shift>(more_y));
    const IntVector several = hn::Or(hn::Set(d, TileCode::several), hn::Or(tile, more)), exact = hn::Set(d, TileCode::exact);
    const IntVector met = hn::IfThenElse(hn::Eq(more, hn::Zero(d)), tile, several);
    const auto off_grid = hn::Lt(box.low[0], hn::Set(d, GridVertex::far_off + 1));
    const auto is_nowhere = hn::Or(hn::Or(x.is_empty, y.is_empty), holds_no_sample(x, y, lines));
    const IntVector nowhere = hn::Set(d, lines.columns * lines.rows);
    const IntVector near = hn::IfThenElse(is_nowhere, nowhere, hn::IfThenElse(hn::Gt(hn::Max(more_x, more_y), most), exact, met));
    return hn::IfThenElse(box.is_known, hn::IfThenElse(off_grid, exact, near), nowhere);
}

/// Prefetches the corners of triangles.
HWY_INLINE void prefetch(const glm::ivec3* triangles, std::size_t count, const ProjectedScene& projected) {
    for (std::size_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) hwy::Prefetch(projected.vertices + static_cast<std::ptrdiff_t>(triangles[i][k]));
}

/// Sets codes[p · stride + i] for projection p and triangle begin + i, up to `end`. Writes whole vectors: `codes` has room for 15 more.
void FindTiles(std::span<const ProjectedScene> projections, const SampleLines& lines, std::size_t begin, std::size_t end,
               std::int32_t* codes, std::size_t stride) {
    const Ints d;
    constexpr std::size_t ahead = 32;
    const auto& triangles = projections[0].scene.surface.triangles;
    for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
        const std::size_t count = std::min(hn::Lanes(d), end - i);
        std::array<glm::ivec3, block_samples> some{};   // the last triangles, so that vectors do not read beyond the end
        if (i + ahead + hn::Lanes(d) <= triangles.size()) prefetch(&triangles[i + ahead], hn::Lanes(d), projections[0]);
        if (count < hn::Lanes(d)) std::copy_n(&triangles[i], count, some.begin());
        const std::int32_t* corners = count < hn::Lanes(d) ? &some[0].x : &triangles[i].x;
        Boxes box(corners, projections[0]);
        for (std::size_t p = 0; p < projections.size(); ++p) {
            if (p > 0 && projections[p].vertices != projections[p - 1].vertices) box = Boxes(corners, projections[p]);
            hn::StoreU(tile_codes(box, projections[p], lines), d, codes + p * stride + (i - begin));
        }
    }
}

}   // namespace render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <tbb/parallel_for.h>

namespace render {

HWY_EXPORT(FindTiles);

namespace {

/// Numbers of triangles in a part, many more than it has lists, so that their starts take little memory.
constexpr std::size_t smallest_part = 8192, triangles_per_list = 8;

/// A rectangle of tiles with both ends; empty if x0 > x1.
struct TileRange {
    std::int64_t x0 = 1, x1 = 0, y0 = 1, y1 = 0;
};

/// Returns the first and the last tile with a sample line in [low, high]; (1, 0) if there is none.
std::pair<std::int64_t, std::int64_t> tiles_between(std::int64_t low, std::int64_t high, const SampleLines& lines, std::int64_t tiles) {
    const std::int64_t begin = (low - lines.first + lines.pitch - 1) >> lines.pitch_shift, end = (high - lines.first) >> lines.pitch_shift;
    if (begin > end) return {1, 0};
    return {std::max<std::int64_t>(0, begin >> lines.tile_shift), std::min(tiles - 1, end >> lines.tile_shift)};
}

/// Returns the tiles that a triangle meets, from its exact coordinates.
TileRange range_of(const ProjectedScene& projected, std::int32_t id, const SampleLines& lines) {
    const glm::ivec3& t = projected.scene.surface.triangles[static_cast<std::size_t>(id)];
    const std::int32_t lowest = std::min({projected.vertices[t.x].at[0], projected.vertices[t.y].at[0], projected.vertices[t.z].at[0]});
    if (lowest == GridVertex::undefined) return {};
    const std::array<ScreenPoint, 3> corner = projected.exact_triangle(id).corner;
    const auto [left, right] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
    const auto [top, bottom] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
    if (std::max(std::max(-left, right), std::max(-top, bottom)) > largest_coordinate) return {};
    const auto [x0, x1] = tiles_between(left, right, lines, lines.columns);
    const auto [y0, y1] = tiles_between(top, bottom, lines, lines.rows);
    return y0 <= y1 ? TileRange{x0, x1, y0, y1} : TileRange{};
}

/// Sorts the triangles [begin, end) by projection and tile.
TileListPart sorted_part(std::span<const ProjectedScene> projections, const SampleLines& lines, std::size_t begin, std::size_t end,
                         WideBudget& budget) {
    const std::size_t count = end - begin, stride = count + block_samples;
    std::vector<std::int32_t> codes(projections.size() * stride);
    HWY_DYNAMIC_DISPATCH(FindTiles)(projections, lines, begin, end, codes.data(), stride);
    const std::size_t lists = static_cast<std::size_t>(lines.columns * lines.rows) + 1;   // the last one for triangles without samples
    const auto range_in = [&](std::int32_t code) {
        const std::int32_t tile = code & 0xffff, x = tile % lines.columns, y = tile / lines.columns;
        return TileRange{x, x + (code >> TileCode::across_shift & TileCode::most_more), y,
                         y + (code >> TileCode::down_shift & TileCode::most_more)};
    };
    const auto for_each_entry = [&](const auto& visit) {
        for (std::size_t p = 0; p < projections.size(); ++p)
            for (std::size_t i = 0; i < count; ++i) {
                const std::int32_t code = codes[p * stride + i], id = static_cast<std::int32_t>(begin + i);
                if (code >= 0) {
                    visit(p * lists + static_cast<std::size_t>(code), id);
                    continue;
                }
                const TileRange range = code == TileCode::exact ? range_of(projections[p], id, lines) : range_in(code);
                for (std::int64_t y = range.y0; y <= range.y1; ++y)
                    for (std::int64_t x = range.x0; x <= range.x1; ++x)
                        visit(p * lists + static_cast<std::size_t>(y * lines.columns + x), id);
            }
    };
    TileListPart part;
    part.start.assign(projections.size() * lists + 2, 0);
    for_each_entry([&](std::size_t list, std::int32_t) { ++part.start[list + 2]; });
    for (std::size_t i = 2; i < part.start.size(); ++i) part.start[i] += part.start[i - 1];
    budget.list(part.start.back());
    part.triangles.resize(part.start.back());
    for_each_entry([&](std::size_t list, std::int32_t id) { part.triangles[part.start[list + 1]++] = id; });
    return part;
}

}   // namespace

TileLists::TileLists(std::span<const ProjectedScene> projections, const SamplePattern& pattern, WideBudget& budget)
    : columns_((projections[0].scene.width - 1) / tile_side + 1), rows_((projections[0].scene.height - 1) / tile_side + 1) {
    static_assert(tile_side * subpixels == 1 << 14);
    const std::size_t count = projections[0].scene.surface.triangles.size();
    const std::size_t part_size =
        std::max(smallest_part, triangles_per_list * projections.size() * static_cast<std::size_t>(columns_ * rows_));
    parts_.resize((count + part_size - 1) / part_size);
    const int shift = pattern.pitch_shift();
    const SampleLines lines{pattern.first, pattern.pitch, shift, 14 - shift, pattern.columns_of_rows, columns_, rows_};
    tbb::parallel_for(std::size_t{0}, parts_.size(), [&](std::size_t i) {
        parts_[i] = sorted_part(projections, lines, i * part_size, std::min(count, (i + 1) * part_size), budget);
    });
}

void TileLists::collect(std::size_t projection, int tile, std::vector<std::int32_t>& triangles) const {
    triangles.clear();
    const std::size_t list = projection * static_cast<std::size_t>(columns_ * rows_ + 1) + static_cast<std::size_t>(tile);
    for (const TileListPart& part : parts_)
        triangles.insert(triangles.end(), part.triangles.begin() + part.start[list], part.triangles.begin() + part.start[list + 1]);
}

}   // namespace render
#endif
