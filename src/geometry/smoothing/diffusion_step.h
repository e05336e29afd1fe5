/// @file
/// Explicit steps of ∂X/∂t = LX with a fixed operator, prepared once and applied many times. Private to the layer.
#pragma once

#include <limits>
#include <vector>

#include "geometry/linear/aligned_columns.h"
#include "geometry/operators/vertices_with_mass.h"

namespace meshfolio {

/// Returns the three numbers of row vertex[i] of X, and a zero, as row i.
FourColumns gathered(const Positions& X, const std::vector<int>& vertex);
/// Stores row i as row vertex[i] of X; other rows of X stay.
void scatter(const FourColumns& rows, const std::vector<int>& vertex, Positions& X);

/// M⁻¹C by rows without its diagonal, which follows from row sums of 0.
using DifferenceRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Computes y_i = x_i + λ Σ_j w_ij (x_j − x_i) for the rows [first, last).
/// @return  true if all |y| there are at most `bound`, which is finite
bool explicit_rows(const DifferenceRows& L, double lambda, const FourColumns& X, int first, int last, double bound, FourColumns& Y);

/// The step X ↦ X + λLX, L = M⁻¹C. Each weight read serves three coordinates. Constants stay to the last bit, since only differences of
/// neighbours are weighted. Every row is a sum in fixed order: threads do not change it.
class ExplicitDiffusion {
public:
    explicit ExplicitDiffusion(const OperatorWithMass& whole);

    const std::vector<int>& vertex() const { return vertex_; }   // the vertex of each row
    /// Computes Y = X + λLX. @return true if all numbers of Y are finite and at most `bound`
    bool step(double lambda, const FourColumns& X, FourColumns& Y, double bound = std::numeric_limits<double>::max()) const;
    /// Returns X + λLX, n × 3 for the whole mesh; copies move with their vertices, vertices without mass stay.
    Positions step(double lambda, const Positions& X) const;

private:
    std::vector<int> vertex_;
    std::vector<VertexCopy> copies_;
    DifferenceRows L_;
};

}   // namespace meshfolio
