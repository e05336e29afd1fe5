#include "mesh/vertex_noise.h"

#include <cmath>
#include <numbers>

namespace meshfolio {

double NormalNumbers::uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }

double NormalNumbers::next() {
    if (has_spare_) {
        has_spare_ = false;
        return spare_;
    }
    // Box & Muller 1958. 1 − uniform() lies in (0, 1], whose logarithm exists.
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    const double angle = 2 * std::numbers::pi * uniform();
    spare_ = radius * std::sin(angle);
    has_spare_ = true;
    return radius * std::cos(angle);
}

Positions with_gaussian_noise(const Positions& X, const Vector3& sigma, std::uint64_t seed) {
    NormalNumbers normal(seed);
    Positions noisy = X;
    for (Eigen::Index i = 0; i < X.rows(); ++i) {
        for (int axis = 0; axis < 3; ++axis) noisy(i, axis) += sigma[axis] * normal.next();
    }
    return noisy;
}

}   // namespace meshfolio
