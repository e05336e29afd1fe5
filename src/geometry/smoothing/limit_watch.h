/// @file
/// The limit of explicit steps, watched while the operator is rebuilt from step to step. Private to the layer.
#pragma once

#include "geometry/operators/vertices_with_mass.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/spectrum/stability.h"

namespace meshfolio {

class LimitWatch {
public:
    /// @param options  in the units of the operators that will be looked at; kept by reference
    explicit LimitWatch(const SmoothingOptions& options) : options_(options) {}

    bool watching() const { return options_.monitor || options_.adaptive > 0; }
    /// To be told of every new operator. @throws SolverError if an adaptive step has no finite bound to rely on
    void look(const OperatorWithMass& whole);
    /// The step with the operator looked at last: λ, cut where adaptive.
    double lambda() const;
    /// What is known of that step.
    StepStability step() const;

private:
    const SmoothingOptions& options_;
    double bound_ = 0;        // μ_max ≤ bound_, Gershgorin
    LargestEigenvalue top_;   // of the operator looked at last: where the next search begins
    bool top_known_ = false;
};

}   // namespace meshfolio
