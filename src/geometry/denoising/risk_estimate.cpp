#include "geometry/denoising/risk_estimate.h"

#include <algorithm>
#include <string>

#include "base/errors.h"

namespace meshfolio {

Vector RiskEstimate::risk(double sigma) const {
    const double variance = sigma * sigma;
    return (residual + 2 * variance * divergence).array() - numbers * variance;
}

int RiskEstimate::best(double sigma) const {
    const Vector all = risk(sigma);
    double least = divergence[0];
    Eigen::Index best = 0;
    for (Eigen::Index t = 1; t < all.size() && divergence[t] <= least + 0.05 * numbers; ++t) {
        least = std::min(least, divergence[t]);
        if (all[t] < all[best]) best = t;
    }
    return static_cast<int>(best);
}

int RiskEstimate::by_discrepancy(double sigma) const {
    const double noise = numbers * sigma * sigma;
    const auto first = std::find_if(residual.begin(), residual.end() - 1, [&](double moved) { return moved >= noise; });
    return static_cast<int>(first - residual.begin());
}

RiskEstimate risk_estimate(const Trajectory& run, const Trajectory& moved, const Positions& direction, double amount) {
    if (run.empty() || run.size() != moved.size())
        throw MeshError("risk_estimate: runs of " + std::to_string(run.size()) + " and " + std::to_string(moved.size()) + " states",
                        "give two runs of equal length, at least one state each");
    const auto length = static_cast<Eigen::Index>(run.size());
    RiskEstimate estimate{Vector(length), Vector(length), static_cast<double>(direction.size())};
    for (std::size_t t = 0; t < run.size(); ++t) {
        const auto i = static_cast<Eigen::Index>(t);
        estimate.residual[i] = (run[t] - run[0]).squaredNorm();
        estimate.divergence[i] = direction.cwiseProduct(moved[t] - run[t]).sum() / amount;
    }
    return estimate;
}

}   // namespace meshfolio
