#include "geometry/smoothing/position_rows.h"

#include "base/parallel.h"

namespace meshfolio {

FourColumns gathered(const Positions& X, const std::vector<int>& vertex) {
    FourColumns rows(static_cast<Eigen::Index>(vertex.size()));
    for_each_index(static_cast<int>(vertex.size()), [&](int i) {
        const int v = vertex[static_cast<std::size_t>(i)];
        double* const row = rows.row(i);
        for (int c = 0; c < 3; ++c) row[c] = X(v, c);
        row[3] = 0;
    });
    return rows;
}

void scatter(const FourColumns& rows, const std::vector<int>& vertex, Positions& X) {
    for_each_index(static_cast<int>(vertex.size()), [&](int i) {
        const int v = vertex[static_cast<std::size_t>(i)];
        for (int c = 0; c < 3; ++c) X(v, c) = rows.row(i)[c];
    });
}

}   // namespace meshfolio
