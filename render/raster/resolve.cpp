#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/resolve.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "raster/resolve.h"

HWY_BEFORE_NAMESPACE();
namespace render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Resolves whole vectors of pixels over an opaque background. Returns the number of pixels done.
std::size_t ResolveOpaque(std::span<const LinearColor> surfaces, const LinearColor& background, Rgba* pixels) {
    const hn::CappedTag<float, 16> f;
    const hn::RebindToSigned<decltype(f)> d;
    const SrgbTables& tables = srgb_tables();
    const auto* channels = reinterpret_cast<const std::int32_t*>(tables.channel.data());
    // Reads four bytes of the table at a time and uses the first.
    const auto channel = [&](auto linear) HWY_ATTR {
        const auto clamped = hn::Min(hn::Max(linear, hn::Zero(f)), hn::Set(f, 1));
        const auto step = hn::ConvertTo(d, hn::Mul(clamped, hn::Set(f, SrgbTables::steps)));
        return hn::And(hn::GatherOffset(d, channels, step), hn::Set(d, 255));
    };
    std::size_t i = 0;
    for (; i + hn::Lanes(f) <= surfaces.size(); i += hn::Lanes(f)) {
        hn::Vec<decltype(f)> r, g, b, a;
        hn::LoadInterleaved4(f, &surfaces[i].r, r, g, b, a);
        const auto rest = hn::Sub(hn::Set(f, 1), a);
        const auto red = channel(hn::Add(r, hn::Mul(rest, hn::Set(f, background.r))));
        const auto green = channel(hn::Add(g, hn::Mul(rest, hn::Set(f, background.g))));
        const auto blue = channel(hn::Add(b, hn::Mul(rest, hn::Set(f, background.b))));
        const auto packed = hn::Or(hn::Or(red, hn::ShiftLeft<8>(green)),
                                   hn::Or(hn::ShiftLeft<16>(blue), hn::Set(d, static_cast<std::int32_t>(0xff000000U))));
        hn::StoreU(packed, d, reinterpret_cast<std::int32_t*>(pixels + i));
    }
    return i;
}

/// Packs whole vectors of pixels. Returns the number of pixels done.
std::size_t Pack(std::span<const LinearColor> surfaces, Layer* layers) {
    const hn::CappedTag<float, 16> f;
    const hn::RebindToSigned<decltype(f)> d;
    const hn::Rebind<std::uint16_t, decltype(f)> u16;
    const auto packed = [&](auto x) HWY_ATTR {
        const auto scaled = hn::Add(hn::Mul(hn::Min(x, hn::Set(f, 1)), hn::Set(f, 65535)), hn::Set(f, 0.5F));
        return hn::DemoteTo(u16, hn::ConvertTo(d, scaled));
    };
    std::size_t i = 0;
    for (; i + hn::Lanes(f) <= surfaces.size(); i += hn::Lanes(f)) {
        hn::Vec<decltype(f)> r, g, b, a;
        hn::LoadInterleaved4(f, &surfaces[i].r, r, g, b, a);
        hn::StoreInterleaved4(packed(r), packed(g), packed(b), packed(a), u16, &layers[i].r);
    }
    return i;
}

/// Unpacks whole vectors of pixels. Returns the number of pixels done.
std::size_t Unpack(std::span<const Layer> layers, const float* light, LinearColor* surfaces) {
    const hn::CappedTag<float, 16> f;
    const hn::RebindToSigned<decltype(f)> d;
    const hn::Rebind<std::uint16_t, decltype(f)> u16;
    const auto unpacked = [&](auto x) HWY_ATTR { return hn::ConvertTo(f, hn::PromoteTo(d, x)); };
    const auto unit = hn::Set(f, 1.0F / 65535);
    std::size_t i = 0;
    for (; i + hn::Lanes(f) <= layers.size(); i += hn::Lanes(f)) {
        hn::Vec<decltype(u16)> r, g, b, a;
        hn::LoadInterleaved4(u16, &layers[i].r, r, g, b, a);
        const auto lit = hn::Mul(unit, hn::LoadU(f, light + i));
        hn::StoreInterleaved4(hn::Mul(lit, unpacked(r)), hn::Mul(lit, unpacked(g)), hn::Mul(lit, unpacked(b)), hn::Mul(unit, unpacked(a)),
                              f, &surfaces[i].r);
    }
    return i;
}

}   // namespace render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <algorithm>
#include <bit>

namespace render {

HWY_EXPORT(ResolveOpaque);
HWY_EXPORT(Pack);
HWY_EXPORT(Unpack);

static_assert(std::endian::native == std::endian::little, "pixels are put together as numbers");

// The rest of a row, less than a vector, takes the same steps one pixel at a time.

void resolve(std::span<const LinearColor> surfaces, Rgba background, std::span<Rgba> pixels) {
    const LinearColor ground = linear_of(background);
    const std::size_t done = background.a == 255 ? HWY_DYNAMIC_DISPATCH(ResolveOpaque)(surfaces, ground, pixels.data()) : 0;
    for (std::size_t i = done; i < surfaces.size(); ++i) {
        LinearColor color = surfaces[i];
        color += (1 - color.a) * ground;
        pixels[i] = surfaces[i].a == 0 ? background : srgb_of(color);
    }
}

void pack(std::span<const LinearColor> surfaces, std::span<Layer> layers) {
    const auto packed = [](float x) { return static_cast<std::uint16_t>(std::min(x, 1.0F) * 65535 + 0.5F); };
    for (std::size_t i = HWY_DYNAMIC_DISPATCH(Pack)(surfaces, layers.data()); i < surfaces.size(); ++i) {
        const LinearColor& c = surfaces[i];
        layers[i] = {packed(c.r), packed(c.g), packed(c.b), packed(c.a)};
    }
}

void unpack(std::span<const Layer> layers, std::span<const float> light, std::span<LinearColor> surfaces) {
    constexpr float unit = 1.0F / 65535;
    for (std::size_t i = HWY_DYNAMIC_DISPATCH(Unpack)(layers, light.data(), surfaces.data()); i < layers.size(); ++i) {
        const Layer& layer = layers[i];
        const float lit = unit * light[i];
        surfaces[i] = {lit * static_cast<float>(layer.r), lit * static_cast<float>(layer.g), lit * static_cast<float>(layer.b),
                       unit * static_cast<float>(layer.coverage)};
    }
}

}   // namespace render
#endif
