#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/operators/corner_batch.cpp"
#include <hwy/foreach_target.h>

#include "geometry/linear/vectors-inl.h"
#include "geometry/operators/arctangent-inl.h"
#include "geometry/operators/corner_batch.h"
#include "mesh/triangle_kind.h"

HWY_BEFORE_NAMESPACE();
namespace meshfolio::HWY_NAMESPACE {

void FindSides(const TriangleMesh& mesh, CornerBatch& b) {
    const Ints d;
    const int* const corners = mesh.F.data();
    for (std::size_t i = 0; i < static_cast<std::size_t>(b.size); i += lanes()) {
        const IntVector here = hn::LoadU(d, b.here.data() + i), t = hn::LoadU(d, b.triangle.data() + i);
        const IntVector first = hn::Add(t, hn::Add(t, t));
        const IntVector a0 = hn::GatherIndex(d, corners, first), a1 = hn::GatherIndex(d, corners + 1, first);
        const IntVector a2 = hn::GatherIndex(d, corners + 2, first);
        const auto second = hn::Eq(a1, here), third = hn::Eq(a2, here);
        const IntVector place = hn::IfThenElse(second, hn::Set(d, 1), hn::IfThenElseZero(third, hn::Set(d, 2)));
        hn::StoreU(hn::IfThenElse(second, a2, hn::IfThenElse(third, a0, a1)), d, b.next.data() + i);
        hn::StoreU(hn::IfThenElse(second, a0, hn::IfThenElse(third, a1, a2)), d, b.previous.data() + i);
        store(hn::PromoteTo(Doubles(), place), b.place.data() + i);
    }
}

HWY_INLINE Vec3 points_of(const TriangleMesh& mesh, const int* vertices) {
    const Doubles d;
    const auto v = hn::PromoteTo(Longs(), hn::LoadU(Ints(), vertices)), x = hn::Add(v, hn::Add(v, v));
    return {hn::GatherIndex(d, mesh.X.data(), x), hn::GatherIndex(d, mesh.X.data() + 1, x), hn::GatherIndex(d, mesh.X.data() + 2, x)};
}

void FindShapes(const TriangleMesh& mesh, double scale, CornerBatch& b) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(b.size); i += lanes()) {
        const Vec3 at_here = points_of(mesh, b.here.data() + i), at_next = points_of(mesh, b.next.data() + i);
        const Vec3 at_previous = points_of(mesh, b.previous.data() + i);
        const Vec3 here = scale * (at_previous - at_next), next = scale * (at_here - at_previous);   // edges opposite
        const Vec3 previous = scale * (at_next - at_here);
        const Number l = dot(here, here), m = dot(next, next), n = dot(previous, previous), place = numbers_at(b.place.data() + i);
        // The longest edge; of equal ones the first in the order in which the triangle is stored: here comes before next unless it is
        // corner 2, before previous if it is corner 0, next before previous unless here is corner 1.
        const Mask over_next = (l > m) | ((l == m) & (place != 2)), over_previous = (l > n) | ((l == n) & (place == 0));
        const Mask next_over = (m > n) | ((m == n) & (place != 1)), longest = over_next & over_previous;
        const Vec3 u = either(longest, next, either(next_over, previous, here));
        const Vec3 v = either(longest, previous, either(next_over, here, next));
        const Vec3 normal = cross(u, v);
        store(-dot(next, previous), b.dot_here.data() + i);
        store(-dot(previous, here), b.dot_next.data() + i);
        store(-dot(here, next), b.dot_previous.data() + i);
        store(l, b.squared_here.data() + i);
        store(m, b.squared_next.data() + i);
        store(n, b.squared_previous.data() + i);
        store(normal.x, b.normal.x.data() + i);
        store(normal.y, b.normal.y.data() + i);
        store(normal.z, b.normal.z.data() + i);
        store(square_root(dot(normal, normal)), b.cross.data() + i);
    }
}

/// Not where |u × v| is rounding: a triangle without area has neither stiffness nor mass.
HWY_INLINE Mask has_area(const CornerBatch& b, std::size_t i) {
    const Number l = numbers_at(b.squared_here.data() + i), m = numbers_at(b.squared_next.data() + i);
    return numbers_at(b.cross.data() + i) > no_area * larger(l, larger(m, numbers_at(b.squared_previous.data() + i)));
}

void FindCotangents(CornerBatch& b) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(b.size); i += lanes()) {
        const Mask sound = has_area(b, i);
        const Number divisor = either(sound, numbers_at(b.cross.data() + i), 1);
        store(either(sound, numbers_at(b.dot_next.data() + i) / divisor, 0), b.cotangent_next.data() + i);
        store(either(sound, numbers_at(b.dot_previous.data() + i) / divisor, 0), b.cotangent_previous.data() + i);
    }
}

void FindAreaShares(CornerBatch& b) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(b.size); i += lanes()) {
        const Number area = either(has_area(b, i), 0.5 * numbers_at(b.cross.data() + i), 0);
        const Number of_next = numbers_at(b.cotangent_next.data() + i) * numbers_at(b.squared_next.data() + i) * 0.125;
        const Number of_previous = numbers_at(b.cotangent_previous.data() + i) * numbers_at(b.squared_previous.data() + i) * 0.125;
        const Number cell = of_next + of_previous;
        const Mask obtuse_here = numbers_at(b.dot_here.data() + i) < 0;
        const Mask obtuse_elsewhere = (numbers_at(b.dot_next.data() + i) < 0) | (numbers_at(b.dot_previous.data() + i) < 0);
        store(area / 3, b.barycentric.data() + i);
        store(cell, b.voronoi.data() + i);
        store(either(obtuse_here, area * 0.5, either(obtuse_elsewhere, area * 0.25, cell)), b.mixed.data() + i);
    }
}

/// The angles of a triangle add up to π whatever its shape, or Gauss–Bonnet would not hold: at both ends of a side without length they are
/// right, and where all three points are one they are alike.
void FindAngles(CornerBatch& b) {
    constexpr double tan_third = 1.7320508075688772;   // tan π/3
    for (std::size_t i = 0; i < static_cast<std::size_t>(b.size); i += lanes()) {
        const Number cross = numbers_at(b.cross.data() + i), dot_here = numbers_at(b.dot_here.data() + i);
        const Mask no_angle = larger(cross, larger(dot_here, -dot_here)) <= 0;
        const Mask one_point = no_angle & (numbers_at(b.squared_here.data() + i) <= 0);
        const Number sine = either(no_angle, either(one_point, tan_third, 1), cross), cosine = either(one_point, 1, dot_here);
        store(angle_of(sine, cosine), b.angle.data() + i);
    }
}

}   // namespace meshfolio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace meshfolio {

HWY_EXPORT(FindSides);
HWY_EXPORT(FindShapes);
HWY_EXPORT(FindCotangents);
HWY_EXPORT(FindAreaShares);
HWY_EXPORT(FindAngles);

void CornerBatch::resize(int corners, int rings) {
    size = corners;
    ring_start.resize(static_cast<std::size_t>(rings) + 1);
    diagonal_place.resize(static_cast<std::size_t>(rings));
    if (corners <= room_) return;
    room_ = corners;
    const auto with_spare = static_cast<std::size_t>(room_) + spare;
    for (Vertices* vertices : {&here, &triangle, &next, &previous, &place_of_next, &place_of_previous}) vertices->resize(with_spare);
    for (Numbers* numbers : {&place, &dot_here, &dot_next, &dot_previous, &squared_here, &squared_next, &squared_previous, &normal.x,
                             &normal.y, &normal.z, &cross, &cotangent_next, &cotangent_previous, &barycentric, &voronoi, &mixed, &angle}) {
        numbers->resize(with_spare);
    }
}

void find_sides(const TriangleMesh& mesh, CornerBatch& batch) { HWY_DYNAMIC_DISPATCH(FindSides)(mesh, batch); }
void find_shapes(const TriangleMesh& mesh, double scale, CornerBatch& batch) { HWY_DYNAMIC_DISPATCH(FindShapes)(mesh, scale, batch); }
void find_cotangents(CornerBatch& batch) { HWY_DYNAMIC_DISPATCH(FindCotangents)(batch); }
void find_area_shares(CornerBatch& batch) { HWY_DYNAMIC_DISPATCH(FindAreaShares)(batch); }
void find_angles(CornerBatch& batch) { HWY_DYNAMIC_DISPATCH(FindAngles)(batch); }

}   // namespace meshfolio
#endif
