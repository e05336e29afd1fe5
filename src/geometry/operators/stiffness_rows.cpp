#include "geometry/operators/stiffness_rows.h"

#include <algorithm>
#include <string>

#include "base/errors.h"
#include "base/large_pages.h"

namespace meshfolio {
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
    int diagonal = ring.size + 1 == size ? ring.batch.diagonal_place[static_cast<std::size_t>(ring.index)] : CornerBatch::not_closed;
    if (diagonal == CornerBatch::not_closed) {
        diagonal = write_sorted(ring, row);
    } else {
        write_closed_fan(ring, row);
    }
    double sum = 0;
    for (int i = 0; i < diagonal; ++i) sum += row.value[i];
    for (int i = diagonal + 1; i < row.size; ++i) sum += row.value[i];
    row.column[diagonal] = row.vertex;
    row.value[diagonal] = 0 - sum;
}

/// Every neighbour is `next` of one corner and `previous` of another.
void StiffnessRows::write_closed_fan(const Ring& ring, const Row& row) const {
    const CornerBatch& b = ring.batch;
    const auto first = static_cast<std::size_t>(ring.first), end = first + static_cast<std::size_t>(ring.size);
    for (std::size_t i = first; i < end; ++i) {
        row.column[b.place_of_next[i]] = b.next[i];
        row.value[b.place_of_next[i]] = 0 + b.cotangent_previous[i];   // +0 also where that is −0, as in the other sum
    }
    for (std::size_t i = first; i < end; ++i) {
        double& value = row.value[b.place_of_previous[i]];
        value = edge_weight(value + b.cotangent_next[i], 2, options_);
    }
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
