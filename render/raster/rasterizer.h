/// @file
/// Which triangle each sample of a tile sees, from either side. Coverage is exact: corners lie on the sample grid and every test is
/// one of integers, so triangles that share an edge cover each sample once, without cracks and without double hits.
#pragma once

#include <array>
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

/// The samples of one square of the picture.
class SampleTile {
public:
    explicit SampleTile(const SamplePattern& pattern);

    /// Empties it for another place. @param x, y  upper left pixel
    void start(int x, int y);

    const SamplePattern& pattern() const { return pattern_; }
    int x() const { return x_; }
    int y() const { return y_; }
    int blocks_on_side() const { return blocks_on_side_; }
    SampleBlock* row(int block_row) { return blocks_.data() + static_cast<std::ptrdiff_t>(block_row) * blocks_on_side_; }
    const SampleBlock* row(int block_row) const { return blocks_.data() + static_cast<std::ptrdiff_t>(block_row) * blocks_on_side_; }
    SampleRegion& region(int x, int y) { return *(regions_.data() + std::ptrdiff_t{y} * (blocks_on_side_ / SampleRegion::side) + x); }

private:
    const SamplePattern& pattern_;
    int x_ = 0, y_ = 0, blocks_on_side_;
    std::vector<SampleBlock> blocks_;
    std::vector<SampleRegion> regions_;
};

/// Marks the samples at which these triangles are highest or lowest. Of equal depths the one drawn first stays: draw in ascending
/// order. Gives the same result on every processor.
void rasterize(const ProjectedScene& scene, std::span<const std::int32_t> triangles, SampleTile& tile);

/// The same for one triangle of any size, exactly: corners up to `largest_coordinate`; others are left out.
void rasterize_wide(const Triangle2& triangle, std::int32_t id, SampleTile& tile);

}   // namespace render
