/// @file
/// Eigenvectors in 16 bits a number, for pages that contain those of a small mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

/// A matrix with column j = scale[j] times whole numbers between ±32767.
struct QuantisedModes {
    static constexpr int largest = 32767;
    int rows = 0;
    Vector scale;                        // a step [as the modes]
    std::vector<std::int16_t> numbers;   // column by column

    DenseMatrix restored() const;   // the matrix, rounded
};

/// Rounds the numbers of column j to whole multiples of peak/steps, peak being the largest magnitude in it and steps = 32767 ·
/// precision[j], at least 127.
/// @param precision  of each column, at most 1; empty: 1
QuantisedModes quantised(const DenseMatrix& modes, const Vector& precision = {});

}   // namespace meshfolio
