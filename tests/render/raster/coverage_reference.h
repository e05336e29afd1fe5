/// @file
/// A slow reference for the coverage of samples by another rule than the renderer's, for tests and fuzzing.
#pragma once

#include <cstdint>
#include <vector>

#include "raster/rasterizer.h"
#include "raster/tile_lists.h"
#include "render/shapes.h"

namespace render_tests {

using render::SampleBlock;
using render::SampleTile;
using render::ScreenPoint;
using render::Triangle2;

__extension__ using Wide = __int128;

/// True if the edge from a to b crosses the height of the point p + (ε, ε²) to its right. Exact.
inline bool crosses_ray(const ScreenPoint& a, const ScreenPoint& b, std::int64_t px, std::int64_t py) {
    if ((a.y <= py) == (b.y <= py)) return false;
    const ScreenPoint &low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
    // x of the crossing > px, multiplied by the positive height of the edge
    return Wide(high.x - low.x) * (py - low.y) + Wide(low.x - px) * (high.y - low.y) > 0;
}

/// The slow reference: a ray from the sample to the right crosses the outline an odd number of times. The infinitesimal shift to the
/// right and (still smaller) down settles samples on edges and corners: the top-left rule, told in another way.
inline bool covers(const Triangle2& t, std::int64_t px, std::int64_t py) {
    int crossings = 0;
    for (std::size_t k = 0; k < 3; ++k) crossings += crosses_ray(t.corner[k], t.corner[(k + 1) % 3], px, py) ? 1 : 0;
    return crossings % 2 == 1;
}

/// The picture, and the tile of it that is drawn: one in the middle, so that places have an origin.
inline constexpr int width = 192, height = 256, tile_x = 64, tile_y = 128;
inline constexpr std::int64_t left = tile_x * 256, top = tile_y * 256, side = 64 * 256;

/// One sample after the other.
struct Sample {
    std::int64_t x, y;
    float highest, lowest;
    int top, bottom;
};

/// Visits sample number `phase` of every `stride` samples, in order.
template <class Visit> void for_each_sample(const SampleTile& tile, const Visit& visit, int stride = 1, int phase = 0) {
    const render::SamplePattern& pattern = tile.pattern();
    const int blocks = tile.blocks_on_side();
    for (int number = phase; number < 16 * blocks * blocks; number += stride) {
        const int row = number / 16 / blocks, column = number / 16 % blocks;
        const auto s = static_cast<std::size_t>(number % 16);
        const SampleBlock& block = tile.row(row)[column];
        visit(Sample{left + column * pattern.block_side * 256 + pattern.x[s], top + row * pattern.block_side * 256 + pattern.y[s],
                     block.highest[s], block.lowest[s], block.top[s], block.bottom[s]});
    }
}

inline SampleTile empty_tile(int samples) {
    SampleTile tile(render::pattern_of(samples));
    tile.start(tile_x, tile_y);
    return tile;
}

/// Draws through a scene: each triangle takes the path that its size asks for.
inline SampleTile drawn(const std::vector<Triangle2>& triangles, int samples) {
    Mesh mesh;
    for (const Triangle2& t : triangles) {
        const int first = static_cast<int>(mesh.positions.size());
        for (const ScreenPoint& p : t.corner)
            mesh.positions.push_back(
                {static_cast<double>(p.x - width * 128) / 256, static_cast<double>(height * 128 - p.y) / 256, p.depth / 256});
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    const render::Surface surface = mesh.surface();
    const render::DrawOptions options{.width = width, .height = height};
    const render::Scene scene(surface, {}, options);
    const render::ProjectedScene projected(scene, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    render::WideBudget budget(0);
    const render::TileLists lists({&projected, 1}, render::pattern_of(samples), budget);
    std::vector<std::int32_t> ids;
    lists.collect(0, tile_y / 64 * lists.columns() + tile_x / 64, ids);
    SampleTile tile = empty_tile(samples);
    render::rasterize(projected, ids, tile);
    return tile;
}

inline SampleTile drawn_wide(const std::vector<Triangle2>& triangles, int samples) {
    SampleTile tile = empty_tile(samples);
    for (std::size_t i = 0; i < triangles.size(); ++i) render::rasterize_wide(triangles[i], static_cast<int>(i), tile);
    return tile;
}

/// Counts the samples with a coverage other than the reference's; stride and phase as above.
inline int disagreements(const Triangle2& t, const SampleTile& tile, int stride = 1, int phase = 0) {
    int count = 0;
    const auto compare = [&](const Sample& s) {
        const bool expected = covers(t, s.x, s.y);
        count += (s.top == 0) == expected && (s.bottom == 0) == expected ? 0 : 1;
    };
    for_each_sample(tile, compare, stride, phase);
    return count;
}

}   // namespace render_tests
