/// @file
/// Rows of the cotangent stiffness matrix, each put together from the corners around its vertex.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "geometry/operators/corner_rings.h"
#include "geometry/operators/cotangent_laplacian.h"

namespace meshfolio {

/// The weight C_ij of an edge from the sum of its opposite cotangents and their number.
inline double edge_weight(double cotangent_sum, std::ptrdiff_t opposite_corners, const CotangentOptions& options) {
    const bool mean = options.opposite == CotangentOptions::OppositeVertices::mean;
    const double weight = mean ? cotangent_sum / static_cast<double>(opposite_corners) : 0.5 * cotangent_sum;
    return options.clamp_negative ? std::max(weight, 0.0) : weight;
}

/// n × n with room for one entry a neighbour and one on the diagonal; of `neighbours` only the sizes count.
SparseMatrix matrix_with_room_for(const Incidence& neighbours);

/// Writes rows, which are also columns, into a matrix that has room for them. A corner of a ring holds two edges: the one to `next`, which
/// lies opposite the corner at `previous`, and the one to `previous`.
class StiffnessRows {
public:
    explicit StiffnessRows(SparseMatrix& C, const CotangentOptions& options = {}) : C_(C), options_(options) {}

    /// The batch of the ring must have its closed fans and cotangents. @throws MeshError if it has not as many neighbours as there is room
    /// for
    void write(const Ring& ring);

private:
    struct Spoke {
        int other;
        double cotangent;
    };
    struct Row {
        int vertex, size;
        int* column;
        double* value;
    };

    void write_closed_fan(const Ring& ring, const Row& row) const;
    int write_sorted(const Ring& ring, const Row& row);

    SparseMatrix& C_;
    CotangentOptions options_;
    std::vector<Spoke> spokes_;
};

}   // namespace meshfolio
