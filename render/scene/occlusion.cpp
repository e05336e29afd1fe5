// Horizons in opposite directions (Bavoil, Sainz, Dimitrov, Image-space horizon-based ambient occlusion, SIGGRAPH 2008 talks): if they
// rise by α and β, the sky between them is π − α − β wide. On a plane α = −β, so that it does not darken itself without any need for
// normals. All pixels look at the same places around them, so that neighbouring pixels are the lanes of a vector.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/occlusion.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <array>
#include <cmath>

#include "scene/occlusion.h"

#ifndef RENDER_OCCLUSION_CONSTANTS
#define RENDER_OCCLUSION_CONSTANTS
namespace render {

/// Largest sum of the sines of α and β without darkening, for the folds between the triangles of a coarse mesh.
inline constexpr float least_bend = 0.2F;

/// sin² of the angles at which creases and contours begin to be drawn, 25°, and are drawn in full, 50°.
inline constexpr float least_crease = 0.18F, full_crease = 0.59F;
/// Shares of the linear light that full lines take; 0.62 looks like black of 35 % in sRGB.
inline constexpr float silhouette_ink = 0.62F, crease_ink = 0.9F;

}   // namespace render
#endif

HWY_BEFORE_NAMESPACE();
namespace render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Returns the sine of the angle with this tangent.
template <class D> HWY_INLINE hn::Vec<D> sine(D d, hn::Vec<D> tangent) {
    return hn::Div(tangent, hn::Sqrt(hn::Add(hn::Set(d, 1), hn::Mul(tangent, tangent))));
}

/// Returns the rise from one height to another. Beyond `reach` it falls again: such a part stands in front and is no wall of a hollow.
template <class D> HWY_INLINE hn::Vec<D> rise(D d, hn::Vec<D> from, const float* to, hn::Vec<D> twice_reach) {
    const auto difference = hn::Sub(hn::LoadU(d, to), from);
    return hn::Min(difference, hn::Sub(twice_reach, difference));
}

void Openness(const float* heights, std::size_t count, float reach, const Looks& looks, float* openness) {
    const hn::CappedTag<float, 16> d;
    const auto zero = hn::Zero(d), lowest = hn::Set(d, -1e9F), twice_reach = hn::Set(d, 2 * reach);
    for (std::size_t x = 0; x < count; x += hn::Lanes(d)) {
        const auto from = hn::LoadU(d, heights + x);
        if (hn::AllTrue(d, hn::Lt(from, hn::Set(d, HeightField::nothing / 2)))) {
            hn::StoreU(hn::Set(d, 1), d, openness + x);
            continue;
        }
        auto hidden = zero;
        for (const auto& direction : looks) {
            auto ahead = lowest, behind = lowest;
            for (const Look& look : direction) {
                const auto scale = hn::Set(d, look.one_over_distance);
                ahead = hn::Max(ahead, hn::Mul(scale, rise(d, from, heights + x + look.step, twice_reach)));
                behind = hn::Max(behind, hn::Mul(scale, rise(d, from, heights + x - look.step, twice_reach)));
            }
            // No darkening: the sum of the sines is below that of the tangents, or below 0.
            if (hn::AllTrue(d, hn::Lt(hn::Add(ahead, behind), hn::Set(d, 0.99F * least_bend)))) continue;
            hidden = hn::Add(hidden, hn::Max(zero, hn::Sub(hn::Add(sine(d, ahead), sine(d, behind)), hn::Set(d, least_bend))));
        }
        const auto sky = hn::Sub(hn::Set(d, 1), hn::Mul(hidden, hn::Set(d, 0.5F / occlusion_directions)));
        hn::StoreU(hn::Mul(sky, sky), d, openness + x);   // squared, because less light reaches a hollow than its share of the sky
    }
}

void Smooth(const float* heights, const float* openness, std::ptrdiff_t pitch, std::size_t count, float one_over_range, float* smoothed) {
    const hn::CappedTag<float, 16> d;
    const auto one = hn::Set(d, 1), falling = hn::Set(d, one_over_range);
    for (std::size_t x = 0; x < count; x += hn::Lanes(d)) {
        const auto height = hn::LoadU(d, heights + x);
        auto sum = hn::Zero(d), weights = hn::Zero(d);
        for (std::ptrdiff_t down = -2; down <= 2; down += 2)
            for (std::ptrdiff_t across = -2; across <= 2; across += 2) {
                const auto place = static_cast<std::ptrdiff_t>(x) + down * pitch + across;
                const auto apart = hn::Abs(hn::Sub(hn::LoadU(d, heights + place), height));
                const auto weight = hn::Max(hn::Zero(d), hn::Sub(one, hn::Mul(apart, falling)));
                sum = hn::Add(sum, hn::Mul(weight, hn::LoadU(d, openness + place)));
                weights = hn::Add(weights, weight);
            }
        hn::StoreU(hn::Div(sum, weights), d, smoothed + x);
    }
}

/// Returns sin² of the angle by which the surface bends at a pixel, from the cross product of the directions to either side; 1 beyond a
/// right angle, 0 beside pixels that show nothing.
template <class D> HWY_INLINE hn::Vec<D> bend(D d, const float* at, std::ptrdiff_t step) {
    const auto one = hn::Set(d, 1), before = hn::LoadU(d, at - step), here = hn::LoadU(d, at), after = hn::LoadU(d, at + step);
    const auto a = hn::Sub(here, before), b = hn::Sub(after, here), across = hn::Sub(b, a), along = hn::Add(one, hn::Mul(a, b));
    const auto lengths = hn::Mul(hn::Add(one, hn::Mul(a, a)), hn::Add(one, hn::Mul(b, b)));
    const auto sine = hn::IfThenElse(hn::Lt(along, hn::Zero(d)), one, hn::Div(hn::Mul(across, across), lengths));
    return hn::IfThenElseZero(hn::Gt(hn::Min(before, after), hn::Set(d, HeightField::nothing / 2)), sine);
}

void Creases(const float* heights, std::ptrdiff_t pitch, std::size_t count, float* creases) {
    const hn::CappedTag<float, 16> d;
    for (std::size_t x = 0; x < count; x += hn::Lanes(d)) {
        const auto is_seen = hn::Gt(hn::LoadU(d, heights + x), hn::Set(d, HeightField::nothing / 2));
        const auto bent = hn::Max(bend(d, heights + x, 1), bend(d, heights + x, pitch));
        const auto above = hn::Mul(hn::Sub(bent, hn::Set(d, least_crease)), hn::Set(d, 1 / (full_crease - least_crease)));
        hn::StoreU(hn::IfThenElseZero(is_seen, hn::Min(hn::Max(above, hn::Zero(d)), hn::Set(d, 1))), d, creases + x);
    }
}

/// Draws silhouettes where a neighbour has less coverage, and creases spread over three pixels to hide steps.
void Lines(const std::uint8_t* coverage, const std::uint8_t* creases, std::ptrdiff_t pitch, std::size_t count, float* lines) {
    const hn::CappedTag<float, 16> d;
    const hn::RebindToSigned<decltype(d)> ints;
    const hn::Rebind<std::uint16_t, decltype(d)> words;
    const hn::Rebind<std::uint8_t, decltype(d)> bytes;
    for (std::size_t x = 0; x < count; x += hn::Lanes(d)) {
        const auto at = [&](const std::uint8_t* field, std::ptrdiff_t step) HWY_ATTR { return hn::LoadU(bytes, field + x + step); };
        const auto least = hn::Min(hn::Min(at(coverage, -1), at(coverage, 1)), hn::Min(at(coverage, -pitch), at(coverage, pitch)));
        const auto row = [&](std::ptrdiff_t step) HWY_ATTR {
            const auto wide = [&](std::ptrdiff_t beside) HWY_ATTR { return hn::PromoteTo(words, at(creases, step + beside)); };
            return hn::Add(hn::Add(wide(-1), wide(1)), hn::ShiftLeft<1>(wide(0)));
        };
        const auto spread = hn::Add(hn::Add(row(-pitch), row(pitch)), hn::ShiftLeft<1>(row(0)));
        const auto falling = hn::Xor(least, hn::Set(bytes, 255));
        const auto outside = hn::Mul(hn::ConvertTo(d, hn::PromoteTo(ints, falling)), hn::Set(d, silhouette_ink / 255));
        const auto inside = hn::Mul(hn::ConvertTo(d, hn::PromoteTo(ints, spread)), hn::Set(d, crease_ink / (255 * 16)));
        hn::StoreU(hn::Min(hn::Add(outside, inside), hn::Set(d, silhouette_ink)), d, lines + x);
    }
}

}   // namespace render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>

namespace render {

HWY_EXPORT(Openness);
HWY_EXPORT(Smooth);
HWY_EXPORT(Creases);
HWY_EXPORT(Lines);

namespace {

/// Directions with looks on exact lines, so that an inclined plane does not look bent.
constexpr std::array<std::array<int, 2>, occlusion_directions> directions{
    {{1, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 1}, {-1, 2}, {-1, 1}, {-2, 1}}};
/// Distances along even and odd directions, as shares of the reach.
constexpr std::array<std::array<double, looks_of_direction>, 2> distances{{{0.12, 0.28, 0.55, 1.0}, {0.18, 0.4, 0.7, 0.9}}};

Looks looks_on(const HeightField& heights) {
    Looks looks;
    for (std::size_t i = 0; i < looks.size(); ++i) {
        const auto [x, y] = directions[i];
        const double length = std::hypot(x, y);
        for (std::size_t k = 0; k < looks_of_direction; ++k) {
            const double multiple = std::max(1.0, std::floor(distances[i % 2][k] * heights.reach() / length));
            looks[i][k] = {static_cast<std::ptrdiff_t>(multiple) * (x + y * heights.pitch()), static_cast<float>(1 / (multiple * length))};
        }
    }
    return looks;
}

/// Calls find(begin, count, found) for stretches of the result and converts what it finds. Vectors may write beyond found + count.
template <class T, class Find, class Convert = std::identity>
void in_whole_vectors(std::span<T> result, const Find& find, const Convert& convert = {}) {
    std::array<float, 1024> found;
    for (std::size_t begin = 0; begin < result.size(); begin += found.size()) {
        const std::size_t count = std::min(found.size(), result.size() - begin);
        find(begin, count, found.data());
        std::transform(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count),
                       result.begin() + static_cast<std::ptrdiff_t>(begin), convert);
    }
}

}   // namespace

HeightField::HeightField(int width, int height)
    : width_(width),
      height_(height),
      reach_(2 + static_cast<int>(0.045 * std::min(width, height))),
      pitch_(width + 2 * reach_ + 16),   // vectors read up to 16 pixels beyond
      heights_(static_cast<std::size_t>(pitch_ * (height + 2 * reach_))) {
    tbb::parallel_for(tbb::blocked_range<float*>(heights_.data(), heights_.data() + heights_.size(), 1 << 17),
                      [](const auto& part) { std::fill(part.begin(), part.end(), nothing); });
}

void HeightField::clear(int x, int y, int count) { std::fill_n(heights_.begin() + (y + reach_) * pitch_ + reach_ + x, count, nothing); }

void HeightField::set(int x, int y, std::span<const float> heights) {
    float* row = heights_.data() + (y + reach_) * pitch_ + reach_ + x;
    std::transform(heights.begin(), heights.end(), row, [](float h) { return std::isinf(h) ? nothing : std::max(h, lowest); });
}

Sky::Sky(const HeightField& heights) : heights_(heights), looks_(looks_on(heights)) {}

void Sky::openness(int x, int y, std::span<float> openness) const {
    in_whole_vectors(openness, [&](std::size_t begin, std::size_t count, float* found) {
        HWY_DYNAMIC_DISPATCH(Openness)
        (heights_.place(x + static_cast<int>(begin), y), count, static_cast<float>(heights_.reach()), looks_, found);
    });
}

void smooth(const HeightField& heights, const HeightField& openness, int x, int y, std::span<float> smoothed) {
    in_whole_vectors(smoothed, [&](std::size_t begin, std::size_t count, float* found) {
        const int from = x + static_cast<int>(begin);
        HWY_DYNAMIC_DISPATCH(Smooth)
        (heights.place(from, y), openness.place(from, y), heights.pitch(), count, 4.0F / static_cast<float>(heights.reach()), found);
    });
}

void find_creases(const HeightField& heights, int x, int y, std::span<std::uint8_t> creases) {
    const auto find = [&](std::size_t begin, std::size_t count, float* found) {
        HWY_DYNAMIC_DISPATCH(Creases)(heights.place(x + static_cast<int>(begin), y), heights.pitch(), count, found);
    };
    in_whole_vectors(creases, find, [](float crease) { return static_cast<std::uint8_t>(255 * crease + 0.5F); });
}

void draw_lines(const ByteField& coverage, const ByteField& creases, int x, int y, std::span<float> lines) {
    in_whole_vectors(lines, [&](std::size_t begin, std::size_t count, float* found) {
        const int from = x + static_cast<int>(begin);
        HWY_DYNAMIC_DISPATCH(Lines)(coverage.place(from, y), creases.place(from, y), creases.pitch(), count, found);
    });
}

}   // namespace render
#endif
