// shape_distances() with the vector instructions of this processor, chosen at run time (Highway). A triangle is a lane, measured once for
// its three corners; operations are those of squared_distance_to_triangle(): the same bytes on every processor. Without vectors this was
// the most expensive function of the default report (2.9 s of 45).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/measures/shape_distances.cpp"
#include <hwy/foreach_target.h>

#include "geometry/measures/mesh_error.h"

#include <hwy/highway.h>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include "base/errors.h"
#include "geometry/measures/closest_point.h"

HWY_BEFORE_NAMESPACE();
namespace meshfolio::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<double, 8>;
using Numbers = hn::Vec<Lanes>;

struct Three {
    Numbers x, y, z;
};
HWY_INLINE Three operator-(const Three& a, const Three& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
HWY_INLINE Numbers Dot(const Three& a, const Three& b) {   // in a fixed order
    return hn::Add(hn::Mul(a.x, b.x), hn::Add(hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)));
}
HWY_INLINE Numbers Minor(Numbers a, Numbers d, Numbers b, Numbers c) { return hn::Sub(hn::Mul(a, d), hn::Mul(b, c)); }
HWY_INLINE Three Cross(const Three& a, const Three& b) {
    return {Minor(a.y, b.z, a.z, b.y), Minor(a.z, b.x, a.x, b.z), Minor(a.x, b.y, a.y, b.x)};
}
template <class Mask> HWY_INLINE Three Chosen(Mask mask, const Three& a, const Three& b) {
    return {hn::IfThenElse(mask, a.x, b.x), hn::IfThenElse(mask, a.y, b.y), hn::IfThenElse(mask, a.z, b.z)};
}

/// Triangles, a lane each.
struct Triangles {
    Three a, b, c, ab, ac, bc, normal;
    Numbers squared_twice_area, longest;
};

/// Returns squared distances; NaN if a triangle is too narrow for them.
HWY_INLINE Numbers SquaredDistances(const Triangles& t, const Three& p) {
    const Lanes d;
    const Numbers zero = hn::Zero(d), one = hn::Set(d, 1.0);
    const Three from_a = p - t.a, from_b = p - t.b, from_c = p - t.c;
    const Numbers squared_to_a = Dot(from_a, from_a), along_normal = Dot(t.normal, from_a);
    const Numbers squared_height = hn::Mul(hn::Div(along_normal, t.squared_twice_area), along_normal);
    const Numbers ab_a = Dot(t.ab, from_a), ac_a = Dot(t.ac, from_a), ab_b = Dot(t.ab, from_b), ac_b = Dot(t.ac, from_b),
                  ab_c = Dot(t.ab, from_c), ac_c = Dot(t.ac, from_c);
    const Numbers of_c = Minor(ab_a, ac_b, ab_b, ac_a), of_b = Minor(ab_c, ac_a, ab_a, ac_c), of_a = Minor(ab_b, ac_c, ab_c, ac_b);
    const Numbers to_c = hn::Sub(ac_b, ab_b), to_b = hn::Sub(ab_c, ac_c);
    const auto at_a = hn::And(hn::Le(ab_a, zero), hn::Le(ac_a, zero)), at_b = hn::And(hn::Ge(ab_b, zero), hn::Le(ac_b, ab_b)),
               at_c = hn::And(hn::Ge(ac_c, zero), hn::Le(ab_c, ac_c));
    const auto on_ab = hn::And(hn::Le(of_c, zero), hn::And(hn::Ge(ab_a, zero), hn::Le(ab_b, zero)));
    const auto on_ac = hn::And(hn::Le(of_b, zero), hn::And(hn::Ge(ac_a, zero), hn::Le(ac_c, zero)));
    const auto on_bc = hn::And(hn::Le(of_a, zero), hn::And(hn::Ge(to_c, zero), hn::Ge(to_b, zero)));

    // The last choice counts: corners before sides, and these in the order ab, ac, bc.
    Three base = from_b, side = t.bc;
    Numbers part = to_c, whole = hn::Add(to_c, to_b);
    const auto choose = [&](auto mask, const Three& from, const Three& along, Numbers share, Numbers of) HWY_ATTR {
        base = Chosen(mask, from, base);
        side = Chosen(mask, along, side);
        part = hn::IfThenElse(mask, share, part);
        whole = hn::IfThenElse(mask, of, whole);
    };
    choose(on_ac, from_a, t.ac, ac_a, hn::Sub(ac_a, ac_c));
    choose(on_ab, from_a, t.ab, ab_a, hn::Sub(ab_a, ab_b));
    choose(at_c, from_c, t.ab, zero, one);
    choose(at_b, from_b, t.ab, zero, one);
    choose(at_a, from_a, t.ab, zero, one);
    const Numbers along = hn::Div(part, whole);
    const Three off = base - Three{hn::Mul(along, side.x), hn::Mul(along, side.y), hn::Mul(along, side.z)};
    const auto beside = hn::Or(hn::Or(at_a, hn::Or(at_b, at_c)), hn::Or(on_ab, hn::Or(on_ac, on_bc)));
    const Numbers squared = hn::IfThenElse(beside, Dot(off, off), squared_height);
    const Numbers least = hn::Max(hn::Mul(hn::Set(d, 1e-6), t.longest), hn::Mul(hn::Set(d, 1e-18), squared_to_a));
    const auto wide = hn::Gt(t.squared_twice_area, hn::Mul(t.longest, least));
    return hn::IfThenElse(wide, squared, hn::Set(d, std::numeric_limits<double>::quiet_NaN()));
}

/// Lowers nearest[v] to the squared distance of row v of X from each triangle of the clean mesh around v.
void LowerToShape(const TriangleMesh& clean, const Positions& X, Vector& nearest) {
    const Lanes d;
    const hn::RebindToSigned<Lanes> whole;
    const hn::CappedTag<double, 1> one;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int first = 0; first < clean.face_count(); first += lanes) {
        const int count = std::min(lanes, clean.face_count() - first);
        alignas(64) std::int64_t place[3][8];   // of the first coordinate of each corner
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < lanes; ++i) place[k][i] = 3 * std::int64_t{clean.F(first + std::min(i, count - 1), k)};
        const auto corners = [&](const Positions& of, int k) HWY_ATTR {
            const auto x = hn::Load(whole, place[k]);
            return Three{hn::GatherIndex(d, of.data(), x), hn::GatherIndex(d, of.data() + 1, x), hn::GatherIndex(d, of.data() + 2, x)};
        };
        Triangles t{corners(clean.X, 0), corners(clean.X, 1), corners(clean.X, 2), {}, {}, {}, {}, {}, {}};
        t.ab = t.b - t.a, t.ac = t.c - t.a, t.bc = t.c - t.b;
        t.normal = Cross(t.ab, t.ac);
        t.squared_twice_area = Dot(t.normal, t.normal);
        t.longest = hn::Max(Dot(t.ab, t.ab), hn::Max(Dot(t.ac, t.ac), Dot(t.bc, t.bc)));
        for (int k = 0; k < 3; ++k) {
            alignas(64) double squared[8];
            const Numbers found = SquaredDistances(t, corners(X, k));
            hn::Store(found, d, squared);
            const bool measured = hn::AllTrue(d, hn::Ge(found, hn::Zero(d)));
            for (int i = 0; i < count; ++i) {
                const auto corner = [&](int j) -> Vector3 { return clean.X.row(clean.F(first + i, j)); };
                const int v = clean.F(first + i, k);
                double* const least = nearest.data() + v;
                if (!measured && !(squared[i] >= 0))
                    squared[i] = squared_distance_to_triangle(X.row(v), corner(0), corner(1), corner(2), *least);
                hn::Store(hn::Min(hn::Load(one, squared + i), hn::Load(one, least)), one, least);   // a branch would be guessed wrong
            }
        }
    }
}

}   // namespace meshfolio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace meshfolio {

HWY_EXPORT(LowerToShape);

Vector shape_distances(const TriangleMesh& clean, const Positions& X) {
    if (clean.X.rows() != X.rows())
        throw MeshError("the clean mesh has " + std::to_string(clean.X.rows()) + " vertices, the other " + std::to_string(X.rows()),
                        "compare meshes with the same vertices");
    Vector nearest = (X - clean.X).rowwise().squaredNorm();
    HWY_DYNAMIC_DISPATCH(LowerToShape)(clean, X, nearest);
    return nearest.cwiseSqrt();
}

}   // namespace meshfolio
#endif
