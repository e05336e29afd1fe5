/// @file
/// Names for vectors of 16 lanes or as many as there are, for code that is compiled once for each instruction set (Highway).
// No #pragma once: it is included anew for every set.
#if defined(RENDER_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_VECTORS_INL_H
#undef RENDER_VECTORS_INL_H
#else
#define RENDER_VECTORS_INL_H
#endif

#include <hwy/highway.h>

#include "raster/sample_grid.h"

HWY_BEFORE_NAMESPACE();
namespace render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Ints = hn::CappedTag<std::int32_t, block_samples>;
using Floats = hn::CappedTag<float, block_samples>;
using IntVector = hn::Vec<Ints>;
using FloatVector = hn::Vec<Floats>;

}   // namespace render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
