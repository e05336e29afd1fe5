/// @file
/// Rasterization: the triangle that each sample of a tile sees, from either side. Coverage is exact: corners lie on the sample grid and all
/// tests are of integers, so that triangles with a common edge cover each sample once, without cracks and double hits.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace render {

inline constexpr std::int32_t no_triangle = -1;

/// The triangles that the samples of a block see: of the largest depth and, for the opposite view, of the smallest.
struct alignas(64) SampleBlock {
    std::array<float, block_samples> highest, lowest;      // depths
    std::array<std::int32_t, block_samples> top, bottom;   // triangles
};

/// A part of a tile in which a hidden wide triangle is skipped as a whole. Small triangles do not update its limits, which may be too wide.
struct SampleRegion {
    static constexpr int side = 8;                            // blocks
    float floor = -std::numeric_limits<float>::infinity();    // everything seen from above lies here or higher
    float ceiling = std::numeric_limits<float>::infinity();   // everything seen from below lies here or lower
};

/// Limits the time and memory that wide triangles take in all tiles of a call. The total does not depend on the number of threads.
class WideBudget {
public:
    /// Allows 800 million steps, and 500 more for each block. @param blocks  number of blocks of one picture
    explicit WideBudget(std::int64_t blocks) : steps_(800'000'000 + 500 * blocks) {}
    /// Takes steps of about 20 ns (a block drawn 4, a region tested 1, a tile met 10). @throws TooMuchOverdraw if too few are left
    void spend(std::int64_t steps);
    /// Takes entries of the lists of tiles, 4 bytes each. @throws TooMuchOverdraw if too few are left
    void list(std::int64_t entries);

private:
    std::atomic<std::int64_t> steps_, entries_ = 200'000'000;
};

/// The samples of one square of the picture.
class SampleTile {
public:
    /// @param budget  must outlive the tile; null: no limit
    explicit SampleTile(const SamplePattern& pattern, WideBudget* budget = nullptr);

    /// Empties the tile for another place. @param x, y  its upper left pixel
    void start(int x, int y);

    const SamplePattern& pattern() const { return pattern_; }
    int x() const { return x_; }   // upper left pixel
    int y() const { return y_; }
    int blocks_on_side() const { return blocks_on_side_; }
    /// Returns the first block of row number `block_row` of blocks, counted from the top of the tile.
    SampleBlock* row(int block_row) { return blocks_.data() + static_cast<std::ptrdiff_t>(block_row) * blocks_on_side_; }
    const SampleBlock* row(int block_row) const { return blocks_.data() + static_cast<std::ptrdiff_t>(block_row) * blocks_on_side_; }
    /// Remembers a wide triangle in place of the last one with its hash, one of 64. Returns true if the two are equal: the earlier one
    /// hides it.
    bool repeats(const Triangle2& oriented);
    /// Counts the steps of a wide triangle. @throws TooMuchOverdraw if the budget is spent
    void spend(int steps) {
        if ((spent_ += steps) >= purse) spend_purse();
    }
    /// Returns the region in column x and row y of the regions of the tile.
    SampleRegion& region(int x, int y) { return *(regions_.data() + std::ptrdiff_t{y} * (blocks_on_side_ / SampleRegion::side) + x); }

private:
    const SamplePattern& pattern_;
    static constexpr int purse = 1 << 14;   // steps taken from the budget at a time
    void spend_purse();

    WideBudget* budget_;
    int x_ = 0, y_ = 0, blocks_on_side_, spent_ = 0;
    std::array<Triangle2, 64> wide_;   // the last wide triangle with each hash
    std::vector<SampleBlock> blocks_;
    std::vector<SampleRegion> regions_;
};

/// Draws triangles: marks the samples at which they are highest or lowest. At equal depths the triangle drawn first stays, so that they
/// must come in ascending order. Every processor gives the same result.
void rasterize(const ProjectedScene& scene, std::span<const std::int32_t> triangles, SampleTile& tile);

/// Draws one triangle of any size exactly; leaves out triangles beyond `largest_coordinate`.
void rasterize_wide(const Triangle2& triangle, std::int32_t id, SampleTile& tile);

}   // namespace render
