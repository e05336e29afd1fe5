/// @file
/// Which triangle each sample of a picture sees. Coverage is exact: corners lie on a grid of 1/256 pixel and every test is
/// one of integers, so triangles that share an edge cover each sample once, without cracks and without double hits.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace render {

/// Grid steps per pixel.
inline constexpr std::int64_t subpixels = 256;

/// A corner on the screen: x to the right and y down in 1/256 pixel, depth in pixels, larger is nearer.
struct ScreenPoint {
    std::int64_t x = 0, y = 0;
    float depth = 0;
};

/// Corners up to here are drawn exactly (2⁴⁴ pixels from the corner of the picture); triangles that reach farther are left out.
inline constexpr std::int64_t largest_coordinate = std::int64_t{1} << 52;

struct Triangle2 {
    std::array<ScreenPoint, 3> corner;
};

/// Where the samples lie in a pixel, from its upper left corner in 1/256 pixel.
struct SampleOffset {
    std::int64_t x, y;
};
/// One: the centre. Four: a rotated grid, in which no two samples share a row or a column.
inline constexpr std::array<SampleOffset, 1> one_sample{{{128, 128}}};
inline constexpr std::array<SampleOffset, 4> four_samples{{{96, 32}, {224, 96}, {32, 160}, {160, 224}}};

/// What a sample sees.
struct Visible {
    static constexpr std::int32_t nothing = -1;
    float depth = -std::numeric_limits<float>::infinity();
    std::int32_t triangle = nothing;
};

/// The samples of a band of picture rows; those of a pixel lie side by side.
class SampleBand {
public:
    /// @param samples  1 or 4 per pixel
    SampleBand(int width, int first_row, int rows, int samples);

    int width() const { return width_; }
    int first_row() const { return first_row_; }
    int rows() const { return rows_; }
    int samples() const { return samples_; }
    std::span<const SampleOffset> offsets() const {
        return samples_ == 1 ? std::span<const SampleOffset>(one_sample) : std::span<const SampleOffset>(four_samples);
    }

    /// The samples of one pixel; x and y count from the corner of the picture.
    Visible* pixel(int x, int y) {
        return seen_.data() +
               static_cast<std::size_t>(samples_) *
                   (static_cast<std::size_t>(y - first_row_) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
    }
    /// A depth than which no sample of the block of columns from block × block_width on is farther. It may lag behind: small
    /// triangles do not update it.
    static constexpr int block_width = 32;
    float farthest(int block) const { return farthest_[static_cast<std::size_t>(block)]; }
    void update_farthest(int block);

    std::span<const Visible> at(int x, int y) { return {pixel(x, y), static_cast<std::size_t>(samples_)}; }

private:
    int width_, first_row_, rows_, samples_;
    std::vector<Visible> seen_;
    std::vector<float> farthest_;
};

/// Marks the samples that `triangle` covers and is nearest at. Of equal depths the one drawn first stays: draw in ascending id.
void rasterize(const Triangle2& triangle, std::int32_t id, SampleBand& band);

}   // namespace render
