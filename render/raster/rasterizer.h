/// @file
/// Which triangle each sample of a tile sees, from either side. Coverage is exact: corners lie on the sample grid and every test is
/// one of integers, so triangles that share an edge cover each sample once, without cracks and without double hits.
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

/// What the samples of a block see: the triangle of the largest depth and, for the opposite view, of the smallest.
struct alignas(64) SampleBlock {
    std::array<float, block_samples> highest, lowest;      // depths
    std::array<std::int32_t, block_samples> top, bottom;   // triangles
};

/// Part of a tile in which wide triangles can be refused at once. Small ones do not update its limits, which may therefore lag behind.
struct SampleRegion {
    static constexpr int side = 8;                            // blocks
    float floor = -std::numeric_limits<float>::infinity();    // everything seen from above lies here or higher
    float ceiling = std::numeric_limits<float>::infinity();   // everything seen from below lies here or lower
};

/// Bounds the time and memory that wide triangles take in all tiles of a call together. The total does not depend on threads.
class WideBudget {
public:
    /// @param blocks  of one picture
    explicit WideBudget(std::int64_t blocks) : steps_(800'000'000 + 500 * blocks) {}
    /// Takes steps of about 20 ns: a block drawn is four, a region looked at one, a tile met ten. @throws TooMuchOverdraw when too little
    /// is left
    void spend(std::int64_t steps);
    /// Takes entries of the lists of tiles, 4 bytes each. @throws TooMuchOverdraw
    void list(std::int64_t entries);

private:
    std::atomic<std::int64_t> steps_, entries_ = 200'000'000;
};

/// The samples of one square of the picture.
class SampleTile {
public:
    /// @param budget  must outlive the tile; null: without limit
    explicit SampleTile(const SamplePattern& pattern, WideBudget* budget = nullptr);

    /// Empties it for another place. @param x, y  upper left pixel
    void start(int x, int y);

    const SamplePattern& pattern() const { return pattern_; }
    int x() const { return x_; }
    int y() const { return y_; }
    int blocks_on_side() const { return blocks_on_side_; }
    SampleBlock* row(int block_row) { return blocks_.data() + static_cast<std::ptrdiff_t>(block_row) * blocks_on_side_; }
    const SampleBlock* row(int block_row) const { return blocks_.data() + static_cast<std::ptrdiff_t>(block_row) * blocks_on_side_; }
    /// Remembers a wide triangle. @return whether it was the last of its hash already, so that it is hidden behind itself
    bool repeats(const Triangle2& oriented);
    /// Counts what a wide triangle takes. @throws TooMuchOverdraw
    void spend(int steps) {
        if ((spent_ += steps) >= purse) spend_purse();
    }
    SampleRegion& region(int x, int y) { return *(regions_.data() + std::ptrdiff_t{y} * (blocks_on_side_ / SampleRegion::side) + x); }

private:
    const SamplePattern& pattern_;
    static constexpr int purse = 1 << 14;   // steps that are taken from the budget at a time
    void spend_purse();

    WideBudget* budget_;
    int x_ = 0, y_ = 0, blocks_on_side_, spent_ = 0;
    std::array<Triangle2, 64> wide_;   // drawn before, by hash
    std::vector<SampleBlock> blocks_;
    std::vector<SampleRegion> regions_;
};

/// Marks the samples at which these triangles are highest or lowest. Of equal depths the one drawn first stays: draw in ascending
/// order. Gives the same result on every processor.
void rasterize(const ProjectedScene& scene, std::span<const std::int32_t> triangles, SampleTile& tile);

/// The same for one triangle of any size, exactly: corners up to `largest_coordinate`; others are left out.
void rasterize_wide(const Triangle2& triangle, std::int32_t id, SampleTile& tile);

}   // namespace render
