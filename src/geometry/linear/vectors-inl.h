/// @file
/// Eight numbers or as many as a vector holds, computed with as if they were one; for code that is compiled once for each instruction
/// set (Highway). Only +, −, ×, ÷, √ and comparisons, never contracted: every set gives the same bytes.
// No #pragma once: it is included anew for every set.
#if defined(MESHFOLIO_GEOMETRY_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MESHFOLIO_GEOMETRY_VECTORS_INL_H
#undef MESHFOLIO_GEOMETRY_VECTORS_INL_H
#else
#define MESHFOLIO_GEOMETRY_VECTORS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace meshfolio::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using Ints = hn::Rebind<std::int32_t, Doubles>;   // as many as doubles
using Longs = hn::Rebind<std::int64_t, Doubles>;
using IntVector = hn::Vec<Ints>;

HWY_INLINE std::size_t lanes() { return hn::Lanes(Doubles()); }

struct Mask {
    hn::Mask<Doubles> mask;
};
HWY_INLINE Mask operator&(Mask a, Mask b) { return {hn::And(a.mask, b.mask)}; }
HWY_INLINE Mask operator|(Mask a, Mask b) { return {hn::Or(a.mask, b.mask)}; }

struct Number {
    hn::Vec<Doubles> lanes;
    HWY_INLINE Number(hn::Vec<Doubles> values) : lanes(values) {}
    HWY_INLINE Number(double value) : lanes(hn::Set(Doubles(), value)) {}
};
HWY_INLINE Number operator+(Number a, Number b) { return hn::Add(a.lanes, b.lanes); }
HWY_INLINE Number operator-(Number a, Number b) { return hn::Sub(a.lanes, b.lanes); }
HWY_INLINE Number operator-(Number a) { return hn::Neg(a.lanes); }
HWY_INLINE Number operator*(Number a, Number b) { return hn::Mul(a.lanes, b.lanes); }
HWY_INLINE Number operator/(Number a, Number b) { return hn::Div(a.lanes, b.lanes); }
HWY_INLINE Mask operator<(Number a, Number b) { return {hn::Lt(a.lanes, b.lanes)}; }
HWY_INLINE Mask operator>(Number a, Number b) { return {hn::Gt(a.lanes, b.lanes)}; }
HWY_INLINE Mask operator<=(Number a, Number b) { return {hn::Le(a.lanes, b.lanes)}; }
HWY_INLINE Mask operator==(Number a, Number b) { return {hn::Eq(a.lanes, b.lanes)}; }
HWY_INLINE Mask operator!=(Number a, Number b) { return {hn::Ne(a.lanes, b.lanes)}; }
HWY_INLINE Number square_root(Number a) { return hn::Sqrt(a.lanes); }
HWY_INLINE Number either(Mask first, Number a, Number b) { return hn::IfThenElse(first.mask, a.lanes, b.lanes); }
HWY_INLINE Number larger(Number a, Number b) { return either(a > b, a, b); }

HWY_INLINE Number numbers_at(const double* values) { return hn::LoadU(Doubles(), values); }
HWY_INLINE void store(Number a, double* values) { hn::StoreU(a.lanes, Doubles(), values); }

struct Vec3 {
    Number x, y, z;
};
HWY_INLINE Vec3 operator*(Number s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
HWY_INLINE Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HWY_INLINE Number dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
HWY_INLINE Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
HWY_INLINE Vec3 either(Mask first, Vec3 a, Vec3 b) { return {either(first, a.x, b.x), either(first, a.y, b.y), either(first, a.z, b.z)}; }

}   // namespace meshfolio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
