/// @file
/// The limit of explicit steps, watched while the operator is rebuilt from step to step. Private to the layer.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/spectrum/stability.h"

namespace meshfolio {

class LimitWatch {
public:
    /// @param options  in the units of the operators; kept by reference
    explicit LimitWatch(const SmoothingOptions& options) : options_(options) {}

    bool watching() const { return options_.monitor || options_.adaptive > 0; }

    /// If watching(), stores the Gershgorin bound of μ_max of the rebuilt operator and, if monitored, μ_max itself, by Lanczos.
    /// @throws SolverError if an adaptive step has no finite bound to rely on
    void look(const OperatorWithMass& whole) {
        if (!watching()) return;
        bound_ = gershgorin_bound(whole.A, whole.M);
        if (options_.adaptive > 0 && !std::isfinite(bound_))
            throw SolverError("smoothing: the operator has no finite bound, so no step is proved stable", "repair triangles of zero area");
        top_known_ = false;
        if (!options_.monitor) return;
        try {
            top_ = largest_eigenvalue_nearly(whole, top_.mode);
            top_known_ = true;
        } catch (const SolverError&) {
            // Weights that are not finite: the run will end by itself.
        }
    }

    /// Returns the next step: options.lambda or, if that is smaller and steps are adaptive, `adaptive` times 2 over the stored bound.
    double lambda() const {
        if (!(options_.adaptive > 0) || !(bound_ > 0)) return options_.lambda;
        return std::min(options_.lambda, options_.adaptive * 2 / bound_);
    }
    /// Returns lambda() with λ times the stored bound, λμ_max and its vertex; NaN and −1 if μ_max is not known.
    StepStability step() const {
        const double h = lambda();
        return {h, h * bound_, top_known_ ? h * top_.value : std::nan(""), top_known_ ? top_.vertex : -1};
    }

private:
    const SmoothingOptions& options_;
    double bound_ = 0;        // μ_max ≤ bound_, Gershgorin
    LargestEigenvalue top_;   // of the last operator: the start of the next search
    bool top_known_ = false;
};

}   // namespace meshfolio
