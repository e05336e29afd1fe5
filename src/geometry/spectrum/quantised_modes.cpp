#include "geometry/spectrum/quantised_modes.h"

#include <algorithm>
#include <cmath>

namespace meshfolio {

QuantisedModes quantised(const DenseMatrix& modes, const Vector& precision) {
    QuantisedModes result{static_cast<int>(modes.rows()), Vector(modes.cols()), {}};
    result.numbers.reserve(static_cast<std::size_t>(modes.size()));
    for (Eigen::Index j = 0; j < modes.cols(); ++j) {
        const double peak = modes.col(j).cwiseAbs().maxCoeff();
        const double most = QuantisedModes::largest;
        const double steps = precision.size() > 0 ? std::clamp(std::ceil(precision[j] * most), 127.0, most) : most;
        const double scale = result.scale[j] = peak > 0 ? peak / steps : 1;
        for (const double value : modes.col(j)) result.numbers.push_back(static_cast<std::int16_t>(std::lround(value / scale)));
    }
    return result;
}

DenseMatrix QuantisedModes::restored() const {
    const Eigen::Map<const Eigen::Matrix<std::int16_t, Eigen::Dynamic, Eigen::Dynamic>> whole(numbers.data(), rows, scale.size());
    return whole.cast<double>() * scale.asDiagonal();
}

}   // namespace meshfolio
