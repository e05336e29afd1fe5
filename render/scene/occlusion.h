/// @file
/// What the heights of a picture say of form: how much of the sky each pixel sees (ambient occlusion), and where lines run.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
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

/// 0 to 255 a pixel, with a margin of one round the picture, which is 0.
class ByteField {
public:
    ByteField(int width, int height) : pitch_(width + 18), bytes_(static_cast<std::size_t>(pitch_ * (height + 2)), std::uint8_t{0}) {}
    std::uint8_t* place(int x, int y) { return bytes_.data() + (y + 1) * pitch_ + 1 + x; }
    const std::uint8_t* place(int x, int y) const { return bytes_.data() + (y + 1) * pitch_ + 1 + x; }
    std::ptrdiff_t pitch() const { return pitch_; }
    void clear() { std::fill(bytes_.begin(), bytes_.end(), std::uint8_t{0}); }

private:
    std::ptrdiff_t pitch_;
    LargeArray<std::uint8_t> bytes_;
};

/// For pixels from (x, y) on: 255 where the surface has a crease or one part ends before another.
void find_creases(const HeightField& heights, int x, int y, std::span<std::uint8_t> creases);

/// The share of the light that silhouettes and creases take from pixels from (x, y) on: lines of 1 to 1.5 pixels.
void draw_lines(const ByteField& coverage, const ByteField& creases, int x, int y, std::span<float> lines);

}   // namespace render
