// Blocks are handled one at a time, with their 16 samples in the lanes of one, two or four vectors. Every sample looks at the other three
// of its pixel; the first of those that see the same triangle becomes the fragment. There are no branches on the triangles.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/fragments.cpp"
#include <hwy/foreach_target.h>

#include "raster/fragments.h"
#include "raster/vectors-inl.h"

#ifndef RENDER_FRAGMENT_PATTERN
#define RENDER_FRAGMENT_PATTERN

namespace render {

/// For each lane i, the data of lane i XOR k, for k from 0 to 3: the samples of its pixel. With one sample a pixel, only k = 0.
struct Neighbours {
    std::array<std::array<std::int32_t, block_samples>, 4> bit;   // among the samples of the pixel
    std::array<std::array<float, block_samples>, 4> x, y;         // from the upper left corner of the block
    std::array<std::int32_t, block_samples> pixel;                // row · tile_side + column, in the block
    int count;
};

/// Least difference of heights between two surfaces in a pixel [pixels].
inline constexpr float largest_step = 8;

/// Row m holds the numbers of the bits that are set in m, in order, then the others.
inline constexpr auto kept_first = [] {
    std::array<std::array<std::uint8_t, 8>, 256> rows{};
    for (unsigned m = 0; m < 256; ++m) {
        std::size_t next = 0;
        for (const unsigned bit : {1U, 0U})
            for (unsigned i = 0; i < 8; ++i)
                if ((m >> i & 1U) == bit) rows[m][next++] = static_cast<std::uint8_t>(i);
    }
    return rows;
}();

}   // namespace render
#endif

HWY_BEFORE_NAMESPACE();
namespace render::HWY_NAMESPACE {

/// The samples of a pixel that see the same triangle.
struct Group {
    IntVector bits;
    FloatVector count, x, y;   // sums

    HWY_INLINE void add(hn::Mask<Ints> same, const Neighbours& n, std::size_t k, std::size_t s) {
        const Ints d;
        const Floats f;
        const auto same_float = hn::RebindMask(f, same);
        bits = hn::Or(bits, hn::IfThenElseZero(same, hn::LoadU(d, n.bit[k].data() + s)));
        count = hn::Add(count, hn::IfThenElseZero(same_float, hn::Set(f, 1)));
        x = hn::Add(x, hn::IfThenElseZero(same_float, hn::LoadU(f, n.x[k].data() + s)));
        y = hn::Add(y, hn::IfThenElseZero(same_float, hn::LoadU(f, n.y[k].data() + s)));
    }
};

/// Moves the lanes of a mask to the front. Highway's Compress does so on processors with an instruction for it; for others, GCC 12 copies
/// its table onto the stack at every call, which takes a quarter of all drawing.
class Front {
public:
#if HWY_TARGET <= HWY_AVX3
    HWY_INLINE explicit Front(hn::Mask<Ints> kept) : kept_(kept) {}
    HWY_INLINE IntVector of(IntVector v) const { return hn::Compress(v, kept_); }
    HWY_INLINE FloatVector of(FloatVector v) const { return hn::Compress(v, hn::RebindMask(Floats(), kept_)); }

private:
    hn::Mask<Ints> kept_;
#else
    static_assert(hn::MaxLanes(Ints()) <= 8);
    HWY_INLINE explicit Front(hn::Mask<Ints> kept) : lanes_(hn::IndicesFromVec(Ints(), row_of(kept))) {}
    HWY_INLINE IntVector of(IntVector v) const { return hn::TableLookupLanes(v, lanes_); }
    HWY_INLINE FloatVector of(FloatVector v) const { return hn::BitCast(Floats(), of(hn::BitCast(Ints(), v))); }

private:
    static HWY_INLINE IntVector row_of(hn::Mask<Ints> kept) {
        const hn::Rebind<std::uint8_t, Ints> bytes;
        alignas(16) std::array<std::uint8_t, 16> bits{};
        hn::StoreMaskBits(Ints(), kept, bits.data());
        return hn::PromoteTo(Ints(), hn::LoadU(bytes, kept_first[bits[0]].data()));
    }

    decltype(hn::IndicesFromVec(Ints(), IntVector())) lanes_;
#endif
};

/// Appends the fragments of the samples of a block from s on.
HWY_INLINE void collect(const Neighbours& n, const std::int32_t* triangles, std::size_t s, int first_pixel, float left, float top,
                        Fragments& fragments) {
    const Ints d;
    const Floats f;
    const IntVector seen = hn::Load(d, triangles + s), own_bit = hn::LoadU(d, n.bit[0].data() + s);
    const auto is_seen = hn::Gt(seen, hn::Set(d, no_triangle));
    if (hn::AllFalse(d, is_seen)) return;
    Group group{own_bit, hn::Set(f, 1), hn::LoadU(f, n.x[0].data() + s), hn::LoadU(f, n.y[0].data() + s)};
    if (n.count == 4) {
        group.add(hn::Eq(seen, hn::Shuffle2301(seen)), n, 1, s);
        group.add(hn::Eq(seen, hn::Shuffle1032(seen)), n, 2, s);
        group.add(hn::Eq(seen, hn::Shuffle0123(seen)), n, 3, s);
    }
    const auto is_first = hn::Eq(hn::And(group.bits, hn::Sub(own_bit, hn::Set(d, 1))), hn::Zero(d));
    const auto kept = hn::And(is_seen, is_first);
    const Front front(kept);
    const FloatVector one_over_count = hn::Div(hn::Set(f, 1), group.count);
    const std::size_t i = fragments.count;
    const IntVector pixel = hn::Add(hn::LoadU(d, n.pixel.data() + s), hn::Set(d, first_pixel));
    hn::StoreU(front.of(seen), d, fragments.triangle.data() + i);
    hn::StoreU(front.of(pixel), d, fragments.pixel.data() + i);
    const auto keep = [&](FloatVector v, Fragments::Column<float>& column) HWY_ATTR { hn::StoreU(front.of(v), f, column.data() + i); };
    keep(hn::Add(hn::Set(f, left), hn::Mul(group.x, one_over_count)), fragments.x);
    keep(hn::Sub(hn::Set(f, top), hn::Mul(group.y, one_over_count)), fragments.y);
    keep(hn::Mul(group.count, hn::Set(f, 1.0F / static_cast<float>(n.count))), fragments.weight);
    fragments.count += hn::CountTrue(d, kept);
}

void CollectRow(const Neighbours& n, const SampleTile& tile, int block_row, float left, float top, bool from_below, Fragments& fragments) {
    const int side = tile.pattern().block_side;
    for (int column = 0; column < tile.blocks_on_side(); ++column) {
        const SampleBlock& block = tile.row(block_row)[column];
        const std::int32_t* triangles = from_below ? block.bottom.data() : block.top.data();
        for (std::size_t s = 0; s < block_samples; s += hn::Lanes(Ints()))
            collect(n, triangles, s, column * side, left + static_cast<float>(column * side * subpixels), top, fragments);
    }
}

void CollectHeights(const SampleTile& tile, int block_row, bool from_below, float* heights) {
    const Floats f;
    const SamplePattern& pattern = tile.pattern();
    const int side = pattern.block_side;
    const FloatVector scale = hn::Set(f, (from_below ? -1.0F : 1.0F) / subpixels);
    for (int column = 0; column < tile.blocks_on_side(); ++column) {
        const SampleBlock& block = tile.row(block_row)[column];
        const float* depths = from_below ? block.lowest.data() : block.highest.data();
        alignas(64) std::array<float, block_samples> nearest;
        for (std::size_t s = 0; s < block_samples; s += hn::Lanes(f)) {
            FloatVector height = hn::Mul(scale, hn::Load(f, depths + s));
            if (pattern.per_pixel == 4) {
                const FloatVector beside = hn::Shuffle2301(height), upper = hn::Max(height, beside), lower = hn::Min(height, beside);
                const FloatVector other_upper = hn::Shuffle1032(upper), other_lower = hn::Shuffle1032(lower);
                const FloatVector first = hn::Max(upper, other_upper);
                const FloatVector inner = hn::Min(upper, other_upper), outer = hn::Max(lower, other_lower);
                const FloatVector second = hn::Max(inner, outer), third = hn::Min(inner, outer);
                height = hn::IfThenElse(hn::Lt(second, hn::Set(f, -1e37F)), first, second);
                const auto one_surface = hn::Lt(hn::Sub(second, third), hn::Set(f, largest_step));
                height = hn::IfThenElse(one_surface, hn::Mul(hn::Set(f, 0.5F), hn::Add(second, third)), height);
            }
            hn::Store(height, f, nearest.data() + s);
        }
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const int sample = (y * side + x) * pattern.per_pixel;
                heights[y * tile_side + column * side + x] = nearest[static_cast<std::size_t>(sample)];
            }
    }
}

}   // namespace render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <algorithm>
#include <bit>
#include <limits>

namespace render {

HWY_EXPORT(CollectRow);
HWY_EXPORT(CollectHeights);

namespace {

Neighbours neighbours_in(const SamplePattern& pattern) {
    Neighbours n{};
    n.count = pattern.per_pixel;
    for (std::size_t i = 0; i < block_samples; ++i) {
        const int pixel = static_cast<int>(i) / pattern.per_pixel;
        n.pixel[i] = pixel / pattern.block_side * tile_side + pixel % pattern.block_side;
        for (std::size_t k = 0; k < static_cast<std::size_t>(pattern.per_pixel); ++k) {
            const std::size_t other = i ^ k;
            n.bit[k][i] = 1 << other % static_cast<std::size_t>(pattern.per_pixel);
            n.x[k][i] = static_cast<float>(pattern.x[other]), n.y[k][i] = static_cast<float>(pattern.y[other]);
        }
    }
    return n;
}

/// Appends the fragments of a pixel with 16 samples. The sums are of integers, so that their order does not matter.
void collect_pixel(const std::array<std::int32_t, block_samples>& seen, int pixel, float left, float top, Fragments& fragments) {
    const SamplePattern& pattern = sixteen_samples;
    for (unsigned rest = (1U << block_samples) - 1; rest != 0;) {
        const std::int32_t id = seen[static_cast<std::size_t>(std::countr_zero(rest))];
        unsigned same = 0;
        for (std::size_t s = 0; s < block_samples; ++s) same |= (seen[s] == id ? 1U : 0U) << s;
        rest &= ~same;
        if (id == no_triangle) continue;
        int x = 0, y = 0;
        for (std::size_t s = 0; s < block_samples; ++s) {
            const int mask = -static_cast<int>(same >> s & 1U);
            x += mask & pattern.x[s], y += mask & pattern.y[s];
        }
        const auto count = static_cast<float>(std::popcount(same));
        const std::size_t i = fragments.count++;
        fragments.triangle[i] = id, fragments.pixel[i] = pixel, fragments.weight[i] = count / block_samples;
        fragments.x[i] = left + static_cast<float>(x) / count, fragments.y[i] = top - static_cast<float>(y) / count;
    }
}

/// Returns the mean height of the nearest surface if at least half of the samples see it, else of the surface behind it.
float height_of_pixel(const std::array<float, block_samples>& depths, float scale) {
    constexpr float none = -std::numeric_limits<float>::infinity();
    float nearest = none, behind = none, sum = 0, sum_behind = 0;
    int count = 0, count_behind = 0;
    for (const float depth : depths) nearest = std::max(nearest, scale * depth);
    for (const float depth : depths) {
        const float height = scale * depth;
        const bool is_near = height > nearest - largest_step;
        sum += is_near ? height : 0, count += is_near ? 1 : 0;
        behind = std::max(behind, is_near ? none : height);
    }
    if (2 * count >= block_samples || behind == none) return nearest == none ? none : sum / static_cast<float>(count);
    for (const float depth : depths) {
        const float height = scale * depth;
        if (height > nearest - largest_step || height <= behind - largest_step) continue;
        sum_behind += height, ++count_behind;
    }
    return sum_behind / static_cast<float>(count_behind);
}

}   // namespace

void collect_fragments(const SampleTile& tile, int block_row, int width, int height, bool from_below, Fragments& fragments) {
    static const Neighbours of_one = neighbours_in(one_sample), of_four = neighbours_in(four_samples);
    const SamplePattern& pattern = tile.pattern();
    const auto left = static_cast<float>(tile.x() * subpixels - width * half_pixel);
    const auto top = static_cast<float>(height * half_pixel - (tile.y() + block_row * pattern.block_side) * subpixels);
    fragments.count = 0;
    if (pattern.per_pixel == block_samples) {
        for (int x = 0; x < tile_side; ++x) {
            const SampleBlock& block = tile.row(block_row)[x];
            collect_pixel(from_below ? block.bottom : block.top, x, left + static_cast<float>(x * subpixels), top, fragments);
        }
        return;
    }
    HWY_DYNAMIC_DISPATCH(CollectRow)(pattern.per_pixel == 1 ? of_one : of_four, tile, block_row, left, top, from_below, fragments);
}

void collect_heights(const SampleTile& tile, int block_row, bool from_below, std::span<float, std::size_t{tile_side} * 4> heights) {
    if (tile.pattern().per_pixel < block_samples) return HWY_DYNAMIC_DISPATCH(CollectHeights)(tile, block_row, from_below, heights.data());
    for (std::size_t x = 0; x < tile_side; ++x) {
        const SampleBlock& block = tile.row(block_row)[x];
        heights[x] = height_of_pixel(from_below ? block.lowest : block.highest, (from_below ? -1.0F : 1.0F) / subpixels);
    }
}

}   // namespace render
#endif
