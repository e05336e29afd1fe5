/// @file
/// Shading from the heights of a picture: ambient occlusion, silhouettes and creases.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "scene/large_array.h"

namespace render {

/// A pair of opposite places to look at from a pixel.
struct Look {
    std::ptrdiff_t step;   // in the height field; −step for the opposite place
    float one_over_distance;
};
inline constexpr std::size_t occlusion_directions = 8, looks_of_direction = 4;
using Looks = std::array<std::array<Look, looks_of_direction>, occlusion_directions>;

/// The height of each pixel above the picture plane, towards the viewer [pixels], or another number; with a margin round the picture.
class HeightField {
public:
    static constexpr float nothing = -1e6F, lowest = -4e5F;   // lower surfaces count as `lowest`

    HeightField(int width, int height);

    /// Sets `count` pixels of a row to show nothing.
    void clear(int x, int y, int count);
    /// Sets pixels of a row. @param heights  −∞ if a pixel shows nothing
    void set(int x, int y, std::span<const float> heights);
    /// Returns the height at a pixel, `nothing` if it shows nothing. @param x, y  may lie up to reach() outside of the picture
    float at(int x, int y) const { return *place(x, y); }
    /// Returns the place of a height, for reading its neighbours.
    const float* place(int x, int y) const { return heights_.data() + (y + reach_) * pitch_ + reach_ + x; }

    int width() const { return width_; }
    int height() const { return height_; }
    /// The largest distance at which occlusion looks [pixels], a share of the shorter side.
    int reach() const { return reach_; }
    /// The step from one row to the next.
    std::ptrdiff_t pitch() const { return pitch_; }

private:
    int width_, height_, reach_;
    std::ptrdiff_t pitch_;
    LargeArray<float> heights_;
};

/// Computes how much of the sky each pixel sees.
class Sky {
public:
    explicit Sky(const HeightField& heights);

    /// Sets `openness` for pixels from (x, y) to the right: 1 if the surface there sees the whole half-space above it, down to 0 at the
    /// bottom of a hole. 1 on planes, however inclined, and where nothing is shown.
    void openness(int x, int y, std::span<float> openness) const;

private:
    const HeightField& heights_;
    Looks looks_;
};

/// Sets `smoothed` for pixels from (x, y) to the right: the mean of `openness` over the pixels around with a similar height, which
/// removes the streaks that the few directions of looking leave.
void smooth(const HeightField& heights, const HeightField& openness, int x, int y, std::span<float> smoothed);

/// A byte for each pixel, with a margin of one pixel of zeros round the picture.
class ByteField {
public:
    ByteField(int width, int height) : pitch_(width + 18), bytes_(static_cast<std::size_t>(pitch_ * (height + 2)), std::uint8_t{0}) {}
    /// Returns the place of a pixel's byte; the margin has x or y of −1, and of the width or height.
    std::uint8_t* place(int x, int y) { return bytes_.data() + (y + 1) * pitch_ + 1 + x; }
    const std::uint8_t* place(int x, int y) const { return bytes_.data() + (y + 1) * pitch_ + 1 + x; }
    std::ptrdiff_t pitch() const { return pitch_; }
    void clear() { std::fill(bytes_.begin(), bytes_.end(), std::uint8_t{0}); }

private:
    std::ptrdiff_t pitch_;
    LargeArray<std::uint8_t> bytes_;
};

/// Sets `creases` for pixels from (x, y) to the right: 0 where it bends by less than 25°, 255 from 50° on, such as where it ends in front
/// of another part.
void find_creases(const HeightField& heights, int x, int y, std::span<std::uint8_t> creases);

/// Sets `lines` for pixels from (x, y) to the right: the share of light (0 to 0.62) that lines along silhouettes and creases take.
void draw_lines(const ByteField& coverage, const ByteField& creases, int x, int y, std::span<float> lines);

}   // namespace render
