// A row holds the neighbours of a vertex in ascending order and the vertex among them. The place of a neighbour is the number of smaller
// ones, and one more above the diagonal: all are compared with all, without a sort.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/operators/closed_fans.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "geometry/operators/closed_fans.h"

HWY_BEFORE_NAMESPACE();
namespace meshfolio::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int most = CornerBatch::spare;   // triangles around a vertex; nearly all have no more

/// Whether every neighbour is `next` of one corner and `previous` of another: n powers of two below 2^n add up to 2^n − 1 only if all are
/// different, so the sum of 2^rank tells.
HWY_INLINE int diagonal_of_closed_fan(int vertex, int size, const int* next, const int* previous, int* place_of_next,
                                      int* place_of_previous) {
    const hn::CappedTag<int, most> d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1), here = hn::Set(d, vertex);
    auto powers = zero, below = zero, unknown = zero;
    for (int i = 0; i < size; i += static_cast<int>(hn::Lanes(d))) {
        const auto nexts = hn::LoadU(d, next + i), previouses = hn::LoadU(d, previous + i);
        auto rank_of_next = zero, rank_of_previous = zero, known = zero;   // −1 for true
        for (int j = 0; j < size; ++j) {
            const auto other = hn::Set(d, next[j]);
            rank_of_next = hn::Sub(rank_of_next, hn::VecFromMask(d, hn::Lt(other, nexts)));
            rank_of_previous = hn::Sub(rank_of_previous, hn::VecFromMask(d, hn::Lt(other, previouses)));
            known = hn::Or(known, hn::VecFromMask(d, hn::Eq(other, previouses)));
        }
        const auto of_fan = hn::VecFromMask(d, hn::Lt(hn::Iota(d, i), hn::Set(d, size)));
        const auto next_below = hn::VecFromMask(d, hn::Lt(nexts, here)), previous_below = hn::VecFromMask(d, hn::Lt(previouses, here));
        const auto both = hn::Add(hn::Shl(one, rank_of_next), hn::ShiftLeft<16>(hn::Shl(one, rank_of_previous)));
        powers = hn::Add(powers, hn::And(of_fan, both));
        below = hn::Sub(below, hn::And(of_fan, next_below));
        unknown = hn::Or(unknown, hn::AndNot(known, of_fan));
        hn::StoreU(hn::Add(rank_of_next, hn::Add(one, next_below)), d, place_of_next + i);
        hn::StoreU(hn::Add(rank_of_previous, hn::Add(one, previous_below)), d, place_of_previous + i);
    }
    const int all = (1 << size) - 1;
    const bool closed = hn::AllTrue(d, hn::Eq(unknown, zero)) && hn::GetLane(hn::SumOfLanes(d, powers)) == (all << 16) + all;
    return closed ? hn::GetLane(hn::SumOfLanes(d, below)) : CornerBatch::not_closed;
}

void FindClosedFans(CornerBatch& b) {
    for (std::size_t ring = 0; ring + 1 < b.ring_start.size(); ++ring) {
        const int begin = b.ring_start[ring], size = b.ring_start[ring + 1] - begin;
        b.diagonal_place[ring] = size > most ? CornerBatch::not_closed
                                             : diagonal_of_closed_fan(b.first_vertex + static_cast<int>(ring), size, b.next.data() + begin,
                                                                      b.previous.data() + begin, b.place_of_next.data() + begin,
                                                                      b.place_of_previous.data() + begin);
    }
}

}   // namespace meshfolio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace meshfolio {

HWY_EXPORT(FindClosedFans);

void find_closed_fans(CornerBatch& batch) { HWY_DYNAMIC_DISPATCH(FindClosedFans)(batch); }

}   // namespace meshfolio
#endif
