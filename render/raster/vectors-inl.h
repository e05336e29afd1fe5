/// @file
/// Vectors of up to 16 lanes, for code that is compiled once for each instruction set (Highway).
// No #pragma once: it is included again for every set.
#if defined(RENDER_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_VECTORS_INL_H
#undef RENDER_VECTORS_INL_H
#else
#define RENDER_VECTORS_INL_H
#endif

#include <hwy/highway.h>

#include <array>

#include "scene/scene.h"

HWY_BEFORE_NAMESPACE();
namespace render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Ints = hn::CappedTag<std::int32_t, block_samples>;
using Floats = hn::CappedTag<float, block_samples>;
using IntVector = hn::Vec<Ints>;
using FloatVector = hn::Vec<Floats>;

/// A vector of vertices, component by component.
struct GridVectors {
    std::array<IntVector, 3> at;
    IntVector normal;
};

/// Loads the vertices ids[0], ids[4] …, each into four lanes.
template <class D> HWY_INLINE hn::Vec<D> every_fourth(D d, const GridVertex* vertices, const std::int32_t* ids) {
    if constexpr (hn::MaxLanes(d) == 4) {
        return hn::LoadU(d, vertices[*ids].at.data());
    } else {
        const hn::Half<D> half;
        return hn::Combine(d, every_fourth(half, vertices, ids + hn::MaxLanes(d) / 2), every_fourth(half, vertices, ids));
    }
}

/// Returns the components of the vertices with these numbers. Loads whole vertices and transposes them: at most half the time of gathering.
HWY_INLINE GridVectors grid_vectors(const GridVertex* vertices, IntVector ids) {
    const Ints d;
    const hn::Repartition<std::int64_t, Ints> pairs;
    alignas(64) std::array<std::int32_t, block_samples> id;
    hn::Store(ids, d, id.data());
    const IntVector v0 = every_fourth(d, vertices, id.data()), v1 = every_fourth(d, vertices, id.data() + 1),
                    v2 = every_fourth(d, vertices, id.data() + 2), v3 = every_fourth(d, vertices, id.data() + 3);
    const auto xy01 = hn::BitCast(pairs, hn::InterleaveLower(d, v0, v1)), xy23 = hn::BitCast(pairs, hn::InterleaveLower(d, v2, v3));
    const auto zn01 = hn::BitCast(pairs, hn::InterleaveUpper(d, v0, v1)), zn23 = hn::BitCast(pairs, hn::InterleaveUpper(d, v2, v3));
    return {{hn::BitCast(d, hn::InterleaveLower(pairs, xy01, xy23)), hn::BitCast(d, hn::InterleaveUpper(pairs, xy01, xy23)),
             hn::BitCast(d, hn::InterleaveLower(pairs, zn01, zn23))},
            hn::BitCast(d, hn::InterleaveUpper(pairs, zn01, zn23))};
}

}   // namespace render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
