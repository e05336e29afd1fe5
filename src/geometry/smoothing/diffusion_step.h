/// @file
/// Explicit steps of ∂X/∂t = LX with a fixed operator, prepared once and applied many times. Private to the layer.
#pragma once

#include <limits>

#include "geometry/operators/vertices_with_mass.h"
#include "geometry/smoothing/diffusion_kernels.h"

namespace meshfolio {

/// X ↦ X + λLX, L = M⁻¹C. Each weight read serves three coordinates; constants stay to the last bit, since only differences of
/// neighbours are weighted. Every row is a sum in fixed order: threads do not change it.
class ExplicitDiffusion {
public:
    explicit ExplicitDiffusion(const OperatorWithMass& whole);

    const std::vector<int>& vertex() const { return vertex_; }   // of each row
    /// @return whether all numbers of Y are finite and at most `bound`
    bool step(double lambda, const FourColumns& X, FourColumns& Y, double bound = std::numeric_limits<double>::max()) const;
    /// n × 3 for the whole mesh; vertices without mass stay.
    Positions step(double lambda, const Positions& X) const;

private:
    std::vector<int> vertex_;
    DifferenceRows L_;
};

/// Rows of M⁻¹C without their diagonal.
DifferenceRows difference_rows(const OperatorWithMass& whole);

}   // namespace meshfolio
