/// @file
/// Ambient occlusion from the heights of a picture: how much of the sky each pixel sees.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "scene/large_array.h"

namespace render {

/// A place to look at, and the one opposite.
struct Look {
    std::ptrdiff_t step;   // in the height field
    float one_over_distance;
};
inline constexpr std::size_t occlusion_directions = 8, looks_of_direction = 4;   // each direction with its opposite
using Looks = std::array<std::array<Look, looks_of_direction>, occlusion_directions>;

/// Heights above the picture plane towards the viewer, in pixels, with a margin round the picture; or another number a pixel.
class HeightField {
public:
    static constexpr float nothing = -1e6F, lowest = -4e5F;   // what lies lower is taken to lie there

    HeightField(int width, int height);

    /// A stretch of a row shows nothing.
    void clear(int x, int y, int count);
    /// @param heights  −∞ where a pixel shows nothing
    void set(int x, int y, std::span<const float> heights);
    /// @param x, y  may lie up to reach() outside of the picture
    float at(int x, int y) const { return *place(x, y); }
    const float* place(int x, int y) const { return heights_.data() + (y + reach_) * pitch_ + reach_ + x; }

    int width() const { return width_; }
    int height() const { return height_; }
    /// How far occlusion looks, in pixels: a share of the shorter side.
    int reach() const { return reach_; }
    /// From a row to the next.
    std::ptrdiff_t pitch() const { return pitch_; }

private:
    int width_, height_, reach_;
    std::ptrdiff_t pitch_;
    LargeArray<float> heights_;
};

/// Where pixels look for what hides the sky; the same places round all of them.
class Sky {
public:
    explicit Sky(const HeightField& heights);

    /// For pixels from (x, y) on: 1 where one sees the whole half-space above it, down to 0 at the bottom of a hole. Planes see all of
    /// it, however inclined, and so does what shows nothing.
    void openness(int x, int y, std::span<float> openness) const;

private:
    const HeightField& heights_;
    Looks looks_;
};

/// The mean of `openness` round pixels from (x, y) on, over what lies about as high: looks are few, and single ones leave streaks.
void smooth(const HeightField& heights, const HeightField& openness, int x, int y, std::span<float> smoothed);

}   // namespace render
