/// @file
/// The constants of each component span the null space of −C, known beforehand. Private to the layer.
#pragma once

#include "geometry/linear/aligned_columns.h"
#include "geometry/operators/vertices_with_mass.h"

namespace meshfolio {

class ZeroModes {
public:
    ZeroModes(const SparseMatrix& A, const Vector& M);
    int count() const { return components_.count; }
    /// n × count: M^½ on a component, normalised.
    DenseMatrix first(int count) const;
    void project_out(Eigen::Ref<Vector> y) const;
    void project_out(EightColumns& Y, bool parallel = false) const;   // parallel: by several threads
    /// The same with row order[i] as row i.
    ZeroModes reordered(const std::vector<int>& order) const;

private:
    Components components_;
    Vector y_;   // all of them added up; their supports are disjoint
};

}   // namespace meshfolio
