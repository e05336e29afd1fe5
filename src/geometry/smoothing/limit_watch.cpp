#include "geometry/smoothing/limit_watch.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "geometry/spectrum/stability.h"

namespace meshfolio {

void LimitWatch::look(const OperatorWithMass& whole) {
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

double LimitWatch::lambda() const {
    if (!(options_.adaptive > 0) || !(bound_ > 0)) return options_.lambda;
    return std::min(options_.lambda, options_.adaptive * 2 / bound_);
}

StepStability LimitWatch::step() const {
    StepStability step;
    step.lambda = lambda();
    step.bound = step.lambda * bound_;
    step.top = top_known_ ? step.lambda * top_.value : std::nan("");
    step.vertex = top_known_ ? top_.vertex : -1;
    return step;
}

}   // namespace meshfolio
