#include "geometry/spectrum/engine/orthogonality_watch.h"

#include <Eigen/LU>
#include <algorithm>

#include "geometry/linear/random_numbers.h"

namespace meshfolio {

namespace {

using Small = OrthogonalityWatch::Small;

/// What orthogonalising against a block leaves.
constexpr double local = 1e-16;

double largest(const std::vector<Small>& omega, std::size_t count) {
    double worst = 0;
    for (std::size_t k = 0; k < count; ++k) worst = std::max(worst, omega[k].cwiseAbs().maxCoeff());
    return worst;
}

}   // namespace

double OrthogonalityWatch::expect(const std::vector<Small>& diagonal, const std::vector<Small>& below) {
    const std::size_t j = diagonal.size() - 1;
    if (last_.empty()) last_ = {Small::Identity()};
    norm_ = std::max({norm_, diagonal.back().norm(), below.back().norm()});
    const Small inverse = below.back().partialPivLu().inverse();
    next_.assign(j + 2, Small::Zero());
    for (std::size_t k = 0; k < j; ++k) {
        Small omega =
            below[k].transpose() * last_[k + 1] + diagonal[k] * last_[k] - last_[k] * diagonal[j] - before_[k] * below[j - 1].transpose();
        if (k > 0) omega += below[k - 1] * last_[k - 1];
        for (double& entry : omega.reshaped()) entry += 2 * rounding_ * norm_ * uniform_number(random_);
        next_[k] = omega * inverse;
    }
    next_[j].setConstant(local);
    next_[j + 1].setIdentity();
    return inverse.allFinite() ? largest(next_, j) : 1;   // a singular block has columns of rounding only
}

void OrthogonalityWatch::advance(bool clean) {
    before_ = std::move(last_);
    last_ = std::move(next_);
    if (!clean) return;
    for (std::size_t k = 0; k + 1 < before_.size(); ++k) before_[k].setConstant(local);
    for (std::size_t k = 0; k + 1 < last_.size(); ++k) last_[k].setConstant(local);
}

void OrthogonalityWatch::compare(double measured) {
    constexpr double rounding_of_the_measurement = 1e-13;
    const double expected = last_.size() > 1 ? largest(last_, last_.size() - 1) : 0;
    if (!(measured > std::max(expected, rounding_of_the_measurement))) return;
    constexpr double most_at_once = 1e3;
    rounding_ *= measured < most_at_once * expected ? measured / expected : most_at_once;   // nothing may have been expected
}

}   // namespace meshfolio
