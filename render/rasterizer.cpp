// Pineda, A parallel algorithm for polygon rasterization, SIGGRAPH 1988: a sample is inside when three edge functions agree in
// sign. The top-left rule gives a sample exactly on an edge to one of the two triangles beside it.
#include "rasterizer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace render {

namespace {

__extension__ using Wide = __int128;   // edge functions of corners far outside the picture need 107 bits

/// Corners up to here (a million pixels) keep edge functions below 2⁶¹: 64-bit integers suffice.
constexpr std::int64_t largest_narrow = std::int64_t{1} << 28;
/// Triangles up to this size (63 pixels) keep edge functions at the samples round them below 2³⁰: 32-bit integers suffice.
constexpr std::int64_t largest_small = 63 * subpixels;

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

struct Box {
    std::int64_t x0, x1, y0, y1;   // both ends included
};

Box bounding_box(const Triangle2& t) {
    const ScreenPoint &a = t.corner[0], &b = t.corner[1], &c = t.corner[2];
    return {std::min(a.x, std::min(b.x, c.x)), std::max(a.x, std::max(b.x, c.x)), std::min(a.y, std::min(b.y, c.y)),
            std::max(a.y, std::max(b.y, c.y))};
}

/// The pixels that meet `box`, cut to the band.
Box pixels_of(const Box& box, const SampleBand& band) {
    return {std::max<std::int64_t>(0, floor_div(box.x0, subpixels)), std::min<std::int64_t>(band.width() - 1, floor_div(box.x1, subpixels)),
            std::max<std::int64_t>(band.first_row(), floor_div(box.y0, subpixels)),
            std::min<std::int64_t>(band.first_row() + band.rows() - 1, floor_div(box.y1, subpixels))};
}

bool comes_before(const ScreenPoint& a, const ScreenPoint& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }

/// Twice the area of `t`, made positive by exchanging two corners where needed. The first corner becomes the topmost, so that
/// doubled triangles get equal depths to the last bit whatever the order of their corners.
template <class Integer>
Integer oriented(Triangle2& t) {
    const ScreenPoint &a = t.corner[0], &b = t.corner[1], &c = t.corner[2];
    const Integer area = Integer(b.x - a.x) * Integer(c.y - a.y) - Integer(b.y - a.y) * Integer(c.x - a.x);
    if (area < 0) std::swap(t.corner[1], t.corner[2]);
    std::rotate(t.corner.begin(), std::min_element(t.corner.begin(), t.corner.end(), comes_before), t.corner.end());
    return area < 0 ? -area : area;
}

/// E(p) = (b − a) × (p − a): twice the signed area of (a, b, p), positive on the inner side of the edge from a to b.
template <class Integer, std::size_t samples>
struct EdgeFunction {
    Integer step_x, step_y;                   // from one pixel to the next
    Integer start;                            // at the upper left corner of the first pixel
    std::array<Integer, samples> to_sample;   // from that corner to each sample
    Integer bias;                             // 0 on top and left edges, which own their samples; −1 on the others

    EdgeFunction(const ScreenPoint& a, const ScreenPoint& b, const Box& pixels, const std::array<SampleOffset, samples>& offsets) {
        const Integer dx = Integer(b.x - a.x), dy = Integer(b.y - a.y);
        step_x = -dy * Integer(subpixels);
        step_y = dx * Integer(subpixels);
        start = dx * Integer(pixels.y0 * subpixels - a.y) - dy * Integer(pixels.x0 * subpixels - a.x);
        for (std::size_t s = 0; s < samples; ++s) to_sample[s] = dx * Integer(offsets[s].y) - dy * Integer(offsets[s].x);
        bias = dy < 0 || (dy == 0 && dx > 0) ? 0 : -1;
    }
};

/// A triangle set up for the pixels of a box. Depth is a convex combination of the corner depths, so that it never leaves their
/// range, however thin the triangle.
template <class Integer, std::size_t samples>
struct Setup {
    Box pixels;
    std::array<EdgeFunction<Integer, samples>, 3> edge;   // edge k is opposite to corner k
    std::array<double, 3> depth;                          // of corner k over twice the area
    double nearest;

    Setup(const Triangle2& t, Integer area, const Box& box, const std::array<SampleOffset, samples>& offsets)
        : pixels(box),
          edge{{{t.corner[1], t.corner[2], box, offsets},
                {t.corner[2], t.corner[0], box, offsets},
                {t.corner[0], t.corner[1], box, offsets}}},
          nearest(static_cast<double>(std::max(t.corner[0].depth, std::max(t.corner[1].depth, t.corner[2].depth)))) {
        for (std::size_t k = 0; k < 3; ++k) depth[k] = static_cast<double>(t.corner[k].depth) / static_cast<double>(area);
    }
    /// At the upper left corner of pixel (x, y).
    Integer at(std::size_t k, std::int64_t x, std::int64_t y) const {
        return edge[k].start + edge[k].step_x * Integer(x - pixels.x0) + edge[k].step_y * Integer(y - pixels.y0);
    }
    double depth_at(Integer e0, Integer e1, Integer e2) const {
        return static_cast<double>(e0) * depth[0] + static_cast<double>(e1) * depth[1] + static_cast<double>(e2) * depth[2];
    }
};

template <class Integer, std::size_t samples>
void fill(const Setup<Integer, samples>& t, const Box& part, std::int32_t id, SampleBand& band) {
    const auto& [edge0, edge1, edge2] = t.edge;
    Integer row0 = t.at(0, part.x0, part.y0), row1 = t.at(1, part.x0, part.y0), row2 = t.at(2, part.x0, part.y0);
    for (std::int64_t y = part.y0; y <= part.y1; ++y) {
        Visible* seen = band.pixel(static_cast<int>(part.x0), static_cast<int>(y));
        Integer corner0 = row0, corner1 = row1, corner2 = row2;
        for (std::int64_t x = part.x0; x <= part.x1; ++x, seen += samples) {
            for (std::size_t s = 0; s < samples; ++s) {
                const Integer e0 = corner0 + edge0.to_sample[s], e1 = corner1 + edge1.to_sample[s], e2 = corner2 + edge2.to_sample[s];
                if (((e0 + edge0.bias) | (e1 + edge1.bias) | (e2 + edge2.bias)) < 0) continue;
                const float z = static_cast<float>(t.depth_at(e0, e1, e2));
                if (z > seen[s].depth) seen[s] = {z, id};
            }
            corner0 += edge0.step_x, corner1 += edge1.step_x, corner2 += edge2.step_x;
        }
        row0 += edge0.step_y, row1 += edge1.step_y, row2 += edge2.step_y;
    }
}

/// No sample of `part` is inside: one edge function is negative at all four corners of it.
template <class Integer, std::size_t samples>
bool misses(const Setup<Integer, samples>& t, const Box& part) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Integer across = t.edge[k].step_x * Integer(part.x1 - part.x0 + 1), down = t.edge[k].step_y * Integer(part.y1 - part.y0 + 1);
        if (t.at(k, part.x0, part.y0) + std::max<Integer>(across, 0) + std::max<Integer>(down, 0) < 0) return true;
    }
    return false;
}

/// Everything of the triangle in `part` lies behind `farthest`: so do its plane at the four corners or all its own corners.
template <class Integer, std::size_t samples>
bool is_hidden(const Setup<Integer, samples>& t, const Box& part, float farthest) {
    double nearest = -std::numeric_limits<double>::infinity(), terms = 0;
    for (const std::int64_t y : {part.y0, part.y1 + 1})
        for (const std::int64_t x : {part.x0, part.x1 + 1}) {
            const Integer e0 = t.at(0, x, y), e1 = t.at(1, x, y), e2 = t.at(2, x, y);
            nearest = std::max(nearest, t.depth_at(e0, e1, e2));
            terms = std::max(terms, std::abs(static_cast<double>(e0) * t.depth[0]) + std::abs(static_cast<double>(e1) * t.depth[1]) +
                                        std::abs(static_cast<double>(e2) * t.depth[2]));
        }
    constexpr double rounding = 1e-6;   // more than float depths and double sums lose
    return std::min(nearest + rounding * terms, t.nearest + rounding * std::abs(t.nearest)) < static_cast<double>(farthest);
}

/// Large triangles go block by block: a block that they miss, or in which they are hidden, costs one test. So a mesh that blew up,
/// whose triangles all cover the whole picture, is still drawn in reasonable time.
template <class Integer, std::size_t samples>
void fill_blocks(const Setup<Integer, samples>& t, std::int32_t id, SampleBand& band) {
    const Box& all = t.pixels;
    for (std::int64_t block = all.x0 / SampleBand::block_width; block <= all.x1 / SampleBand::block_width; ++block) {
        const Box part{std::max(all.x0, block * SampleBand::block_width), std::min(all.x1, (block + 1) * SampleBand::block_width - 1),
                       all.y0, all.y1};
        if (misses(t, part) || is_hidden(t, part, band.farthest(static_cast<int>(block)))) continue;
        fill(t, part, id, band);
        band.update_farthest(static_cast<int>(block));
    }
}

template <class Integer, std::size_t samples>
void rasterize_with(Triangle2 t, std::int32_t id, const Box& pixels, const std::array<SampleOffset, samples>& offsets, SampleBand& band) {
    const Integer area = oriented<Integer>(t);
    if (area == 0) return;
    const Setup<Integer, samples> setup(t, area, pixels, offsets);
    if constexpr (sizeof(Integer) == sizeof(std::int32_t))
        fill(setup, pixels, id, band);
    else
        fill_blocks(setup, id, band);
}

/// With the narrowest integers that hold the edge functions.
template <std::size_t samples>
void rasterize_samples(const Triangle2& t, std::int32_t id, const std::array<SampleOffset, samples>& offsets, SampleBand& band) {
    const Box box = bounding_box(t), pixels = pixels_of(box, band);
    const std::int64_t farthest = std::max(std::max(-box.x0, box.x1), std::max(-box.y0, box.y1));
    if (pixels.x0 > pixels.x1 || pixels.y0 > pixels.y1 || farthest > largest_coordinate) return;
    if (farthest > largest_narrow)
        rasterize_with<Wide>(t, id, pixels, offsets, band);
    else if (std::max(box.x1 - box.x0, box.y1 - box.y0) > largest_small)
        rasterize_with<std::int64_t>(t, id, pixels, offsets, band);
    else
        rasterize_with<std::int32_t>(t, id, pixels, offsets, band);
}

}   // namespace

SampleBand::SampleBand(int width, int first_row, int rows, int samples)
    : width_(width),
      first_row_(first_row),
      rows_(rows),
      samples_(samples),
      seen_(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows) * static_cast<std::size_t>(samples)),
      farthest_(static_cast<std::size_t>((width - 1) / block_width + 1), -std::numeric_limits<float>::infinity()) {}

void SampleBand::update_farthest(int block) {
    const int x0 = block * block_width, x1 = std::min(x0 + block_width, width_);
    float farthest = std::numeric_limits<float>::infinity();
    for (int y = first_row_; y < first_row_ + rows_; ++y)
        for (const Visible* v = pixel(x0, y); v != pixel(x1, y); ++v) farthest = std::min(farthest, v->depth);
    farthest_[static_cast<std::size_t>(block)] = farthest;
}

void rasterize(const Triangle2& triangle, std::int32_t id, SampleBand& band) {
    if (band.samples() == 1)
        rasterize_samples(triangle, id, one_sample, band);
    else
        rasterize_samples(triangle, id, four_samples, band);
}

}   // namespace render
