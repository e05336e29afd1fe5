#include <algorithm>
#include <chrono>
#include <cmath>

#include "geometry/spectrum/spectral_reconstruction.h"
#include "geometry/spectrum/stability.h"
#include "questions/bench/spectral_uses.h"
#include "questions/core/value_lists.h"

namespace meshfolio {

namespace {

constexpr int highest_degree = 1500;

/// k near 15 with the widest relative gap behind it, so that the cutoff cuts no cluster; 0 where there are too few modes.
int cutoff_near_fifteen(const Vector& mu) {
    int best = 0;
    double widest = 0;
    for (int k = 10; k <= 20 && k < mu.size(); ++k) {
        const double gap = mu[k - 1] > 0 ? mu[k] / mu[k - 1] - 1 : 0;
        if (gap <= widest) continue;
        widest = gap;
        best = k;
    }
    return best;
}

/// A polynomial of degree d tells frequencies apart down to about bound/d²: degrees in units of √(bound/cutoff).
std::vector<int> degrees_for(const LowPassStudy& study, bool quick) {
    const double unit = std::sqrt(study.bound / study.cutoff);
    std::vector<int> degrees;
    double times = 1;
    while (times < (quick ? 17 : 24)) {
        degrees.push_back(std::clamp(static_cast<int>(std::round(times * unit)), 1, highest_degree));
        times *= std::sqrt(2);
    }
    return each_once(degrees);
}

double distance_between(const SpectralStudy& study, const Positions& a, const Positions& b) {
    const Vector& M = study.laplacian.M;
    return std::sqrt(M.dot((a - b).rowwise().squaredNorm()) / M.sum());
}

double error_from_response(const SpectralStudy& study, const ChebyshevFilter& filter, int k, const Vector& energies) {
    double sum = 0;
    for (Eigen::Index i = 0; i < energies.size(); ++i) {
        const double off = response(filter, study.spectrum.eigenvalues[i]) - (i < k ? 1 : 0);
        sum += off * off * energies[i];
    }
    return std::sqrt(sum / study.laplacian.M.sum());
}

}   // namespace

LowPassStudy low_pass_study(const SpectralStudy& study, bool quick) {
    const Vector &mu = study.spectrum.eigenvalues, &M = study.laplacian.M;
    const Positions& X = study.mesh().X;
    LowPassStudy result;
    result.k = cutoff_near_fifteen(mu);
    if (result.k == 0) return result;
    result.cutoff = 0.5 * (mu[result.k - 1] + mu[result.k]);
    const OperatorWithMass whole = operator_with_mass(study.laplacian);
    result.bound = gershgorin_bound(whole.A, whole.M);
    const Vector gains = mu.unaryExpr([&](double m) { return low_pass_response(LowPass::smooth, result.cutoff, m); });
    result.unknown = gains[gains.size() - 1] * study.rms[study.modes()];
    const Positions ideal = reconstruct(study.spectrum, M, X, result.k), smooth = filtered(study.spectrum, M, X, gains, 0);
    const Vector energies = spectral_coefficients(study.spectrum, M, X).rowwise().squaredNorm();

    std::vector<ChebyshevFilter> filters;
    const std::vector<int> degrees = degrees_for(result, quick);
    for (const LowPass kind : {LowPass::ideal, LowPass::smooth})
        for (const int degree : degrees) filters.push_back(chebyshev_low_pass(kind, result.cutoff, result.bound, degree));
    const auto start = std::chrono::steady_clock::now();
    const std::vector<Positions> rebuilt = filtered(filters, study.laplacian, X);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (std::size_t i = 0; i < degrees.size(); ++i) {
        result.errors.push_back({degrees[i], distance_between(study, rebuilt[i], ideal),
                                 distance_between(study, rebuilt[degrees.size() + i], smooth),
                                 error_from_response(study, filters[i], result.k, energies), operations(filters[i], study.laplacian)});
    }
    return result;
}

}   // namespace meshfolio
