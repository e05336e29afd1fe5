/// @file
/// One step of ∂X/∂t = LX with a fixed operator, prepared once and applied many times. Private to the layer.
#pragma once

#include <optional>

#include "geometry/sparse_factor.h"
#include "geometry/vertices_with_mass.h"

namespace meshfolio {

/// X ↦ X + λLX. Rows of X are contiguous, so each weight read serves three coordinates.
class ExplicitDiffusion {
public:
    explicit ExplicitDiffusion(const OperatorWithMass& whole);
    /// n × 3 for the whole mesh; vertices without mass stay. Every row is a sum in fixed order: threads do not change it.
    Positions step(double lambda, const Positions& X) const;

private:
    Eigen::SparseMatrix<double, Eigen::RowMajor> L_;   // M⁻¹C over all vertices
};

/// X ↦ X', (M − λC) X' = M X, three right-hand sides together.
class ImplicitDiffusion {
public:
    /// Factors M − λC; after the first time the symbolic analysis is kept as long as the pattern is.
    void prepare(OperatorWithMass whole, double lambda);
    Positions step(const Positions& X) const;
    long long factor_nonzeros() const { return factor_->nonzeros(); }

private:
    OperatorWithMass whole_;
    std::optional<SparseFactor> factor_;
};

}   // namespace meshfolio
