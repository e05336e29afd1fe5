#include "geometry/spectrum/quantised_modes.h"

#include <cmath>

namespace meshfolio {

QuantisedModes quantised(const DenseMatrix& modes) {
    QuantisedModes result{static_cast<int>(modes.rows()), Vector(modes.cols()), {}};
    result.numbers.reserve(static_cast<std::size_t>(modes.size()));
    for (Eigen::Index j = 0; j < modes.cols(); ++j) {
        const double peak = modes.col(j).cwiseAbs().maxCoeff();
        const double scale = result.scale[j] = peak > 0 ? peak / QuantisedModes::largest : 1;
        for (const double value : modes.col(j)) result.numbers.push_back(static_cast<std::int16_t>(std::lround(value / scale)));
    }
    return result;
}

DenseMatrix QuantisedModes::restored() const {
    const Eigen::Map<const Eigen::Matrix<std::int16_t, Eigen::Dynamic, Eigen::Dynamic>> whole(numbers.data(), rows, scale.size());
    return whole.cast<double>() * scale.asDiagonal();
}

}   // namespace meshfolio
