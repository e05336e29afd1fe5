/// @file
/// The law of frozen explicit smoothing, measured: t steps multiply the coefficient of an eigenmode by (1 − λμ)ᵗ.
#pragma once

#include <cmath>
#include <vector>

#include "geometry/spectrum/stability.h"

namespace meshfolio {

struct ModeGrowth {
    double lambda = 0;            // the step [length²]
    double factor_a_step = 0;     // |1 − λμ|, predicted
    std::vector<double> factor;   // measured: |⟨X, φ⟩_M| after t = 0, 1, … steps over that at the start

    int steps() const { return static_cast<int>(factor.size()) - 1; }
    double predicted(int t) const { return std::pow(factor_a_step, t); }   // |1 − λμ|ᵗ
};

/// Measures how the mode grows in `steps` explicit steps of λ with the fixed operator, from positions X.
/// @param top  an eigenpair of the operator
/// @throws MeshError if X or the mode have another number of rows than the operator, or X has no part in the mode
ModeGrowth mode_growth(const LaplaceBeltrami& laplacian, const LargestEigenvalue& top, const Positions& X, double lambda, int steps);

/// Returns X with the mode added to each coordinate, scaled to `height` where it is largest: a symmetric mesh has no part in its top mode,
/// so that without it nothing would grow. [length]
Positions seeded(const Positions& X, const LargestEigenvalue& top, double height);

}   // namespace meshfolio
