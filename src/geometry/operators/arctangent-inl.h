/// @file
/// The angle of a triangle's corner, without a branch or a table, so that several are computed at once.
// No #pragma once: it is included anew for every instruction set.
#if defined(MESHFOLIO_ARCTANGENT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MESHFOLIO_ARCTANGENT_INL_H
#undef MESHFOLIO_ARCTANGENT_INL_H
#else
#define MESHFOLIO_ARCTANGENT_INL_H
#endif

#include <limits>

#include "geometry/linear/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meshfolio::HWY_NAMESPACE {

/// atan t for |t| ≤ tan π/8: t + t³ R(t²), R through atan at the Chebyshev points of [0, tan² π/8]; off by 8e-18 of it before rounding.
HWY_INLINE Number arctangent_of_small(Number t) {
    constexpr double R[] = {-0.3333333333333333,   0.19999999999995516, -0.14285714284665682, 0.11111111015187018,
                            -0.0909090457530649,   0.07692183125376892, -0.06664510525508936, 0.05858140904866328,
                            -0.050854078345894844, 0.03923044778479309, -0.019175404711104935};
    const Number z = t * t;
    Number sum = R[10];
    for (int k = 9; k >= 0; --k) sum = sum * z + R[k];
    return t + t * (z * sum);
}

/// atan2(sine, cosine) in [0, π] for sine ≥ 0, to 2 units in the last place; 0 where both are 0. Any common factor will do. [rad]
/// With s ≤ c the smaller and larger of sine and |cosine|: atan s/c, or π/4 + atan (s − c)/(s + c) above π/8.
HWY_INLINE Number angle_of(Number sine, Number cosine) {
    constexpr double quarter = 0x1.921fb54442d18p-1, rest_of_quarter = 0x1.1a62633145c07p-55;   // π/4 = quarter + rest
    constexpr double tan_eighth = 0.41421356237309503;
    const Mask obtuse = cosine < 0;
    const Number x = either(obtuse, -cosine, cosine);
    const Mask flat = sine <= x;
    const Number s = either(flat, sine, x), c = either(flat, x, sine);
    const Mask wide = s > tan_eighth * c;
    const Number above = either(wide, s - c, s), below = either(wide, s + c, c);
    const Number small = arctangent_of_small(above / either(below > 0, below, std::numeric_limits<double>::min()));
    // θ = quarters · π/4 ± (atan of the small one)
    const Number octant = either(wide, 1, 0);
    const Number steep = either(flat, octant, 2 - octant), up = either(flat, small, -small);
    const Number quarters = either(obtuse, 4 - steep, steep), turned = either(obtuse, -up, up);
    return quarters * quarter + (quarters * rest_of_quarter + turned);
}

}   // namespace meshfolio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
