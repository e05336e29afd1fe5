#include "geometry/operators/intrinsic_input.h"

#include "base/errors.h"

namespace meshfolio {

void require_corner_values(const std::string& function, const Faces& F, int vertex_count, const CornerValues& values) {
    if (values.rows() != F.rows()) {
        throw MeshError(function + ": corner values for " + std::to_string(values.rows()) + " triangles, but there are " +
                        std::to_string(F.rows()));
    }
    if (F.rows() > 0 && (F.minCoeff() < 0 || F.maxCoeff() >= vertex_count)) {
        throw MeshError(function + ": a triangle names vertex " + std::to_string(F.minCoeff() < 0 ? F.minCoeff() : F.maxCoeff()) + " of " +
                        std::to_string(vertex_count));
    }
}

void require_lengths(const std::string& function, const CornerValues& lengths) {
    for (Eigen::Index t = 0; t < lengths.rows(); ++t) {
        if (!lengths.row(t).allFinite() || lengths.row(t).minCoeff() < 0) {
            throw MeshError(function + ": triangle " + std::to_string(t) + " has an edge length that is negative or not finite");
        }
    }
}

}   // namespace meshfolio
