#include "geometry/stiffness_rows.h"

#include <algorithm>
#include <string>

#include "errors.h"
#include "large_pages.h"

namespace meshfolio {
namespace {

/// Corners around a vertex; nearly all have no more.
constexpr int few = 8;
static_assert(few <= CornerBatch::spare);

/// For each of eight values, how many of the first `size` of `among` are smaller.
void count_smaller(const int* among, int size, const int* values, int* count) {
    for (int i = 0; i < few; ++i) count[i] = 0;
    for (int j = 0; j < size; ++j) {
        for (int i = 0; i < few; ++i) count[i] += among[j] < values[i] ? 1 : 0;
    }
}

}   // namespace

SparseMatrix matrix_with_room_for(const Incidence& neighbours) {
    const int n = static_cast<int>(neighbours.start.size()) - 1;
    SparseMatrix C(n, n);
    for (int v = 0; v <= n; ++v) C.outerIndexPtr()[v] = neighbours.start[static_cast<std::size_t>(v)] + v;
    const int entries = C.outerIndexPtr()[n];
    C.resizeNonZeros(entries);
    prefer_large_pages(C.innerIndexPtr(), static_cast<std::size_t>(entries) * sizeof(int));
    prefer_large_pages(C.valuePtr(), static_cast<std::size_t>(entries) * sizeof(double));
    return C;
}

/// C_ii = −Σ_j C_ij, j ascending.
void StiffnessRows::write(const Ring& ring) {
    const int begin = C_.outerIndexPtr()[ring.vertex], size = C_.outerIndexPtr()[ring.vertex + 1] - begin;
    const Row row{ring.vertex, size, C_.innerIndexPtr() + begin, C_.valuePtr() + begin};
    int diagonal = ring.size + 1 == size && ring.size <= few ? write_closed_fan(ring, row) : not_closed;
    if (diagonal == not_closed) diagonal = write_sorted(ring, row);
    double sum = 0;
    for (int i = 0; i < diagonal; ++i) sum += row.value[i];
    for (int i = diagonal + 1; i < row.size; ++i) sum += row.value[i];
    row.column[diagonal] = row.vertex;
    row.value[diagonal] = 0 - sum;
}

/// Nearly always every neighbour is `next` of one corner and `previous` of another. Its place in the row is the number of smaller ones,
/// and one more above the diagonal: all are compared with all, without a sort.
/// @return  the place of the diagonal, or not_closed
int StiffnessRows::write_closed_fan(const Ring& ring, const Row& row) const {
    const int* const next = ring.batch.next.data() + ring.first;
    const int* const previous = ring.batch.previous.data() + ring.first;
    const double* const to_next = ring.batch.cotangent_previous.data() + ring.first;
    const double* const to_previous = ring.batch.cotangent_next.data() + ring.first;
    int place_of_next[few], place_of_previous[few];
    count_smaller(next, ring.size, next, place_of_next);
    count_smaller(next, ring.size, previous, place_of_previous);
    unsigned nexts = 0, previouses = 0;   // places taken
    for (int i = 0; i < ring.size; ++i) {
        nexts |= 1U << place_of_next[i];
        previouses |= 1U << place_of_previous[i];
    }
    const unsigned all = (1U << ring.size) - 1;
    if (nexts != all || previouses != all) return not_closed;
    int diagonal = 0;
    for (int i = 0; i < ring.size; ++i) {
        const int place = place_of_next[i] + (next[i] > row.vertex ? 1 : 0);
        diagonal += next[i] < row.vertex ? 1 : 0;
        row.column[place] = next[i];
        row.value[place] = 0 + to_next[i];   // +0 also where that is −0, as in the other sum
    }
    bool matches = true;
    for (int i = 0; i < ring.size; ++i) {
        const int place = place_of_previous[i] + (previous[i] > row.vertex ? 1 : 0);
        matches &= row.column[place] == previous[i] && previous[i] != row.vertex;
        row.value[place] = edge_weight(row.value[place] + to_previous[i], 2, options_);
    }
    return matches ? diagonal : not_closed;
}

/// Stable, so that the cotangents of an edge are added in the order of the triangles.
/// @return  the place of the diagonal
int StiffnessRows::write_sorted(const Ring& ring, const Row& row) {
    spokes_.clear();
    for (int i = ring.first; i < ring.first + ring.size; ++i) {
        const auto corner = static_cast<std::size_t>(i);
        spokes_.push_back({ring.batch.next[corner], ring.batch.cotangent_previous[corner]});
        spokes_.push_back({ring.batch.previous[corner], ring.batch.cotangent_next[corner]});
    }
    std::erase_if(spokes_, [&](const Spoke& spoke) { return spoke.other == row.vertex; });
    std::stable_sort(spokes_.begin(), spokes_.end(), [](const Spoke& s, const Spoke& t) { return s.other < t.other; });
    int edges = 0, diagonal = 0;
    for (auto spoke = spokes_.begin(); spoke != spokes_.end();) {
        const auto first = spoke;
        double sum = 0;
        for (; spoke != spokes_.end() && spoke->other == first->other; ++spoke) sum += spoke->cotangent;
        const int place = edges++ + (first->other > row.vertex ? 1 : 0);
        if (place >= row.size) break;
        diagonal += first->other < row.vertex ? 1 : 0;
        row.column[place] = first->other;
        row.value[place] = edge_weight(sum, spoke - first, options_);
    }
    if (edges + 1 == row.size) return diagonal;
    throw MeshError("cotangent stiffness: vertex " + std::to_string(row.vertex) + " has other neighbours than its topology says");
}

}   // namespace meshfolio
