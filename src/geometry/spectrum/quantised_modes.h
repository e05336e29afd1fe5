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

/// Rounds each column to half its scale: to 1/65534 of its largest magnitude over the precision, and to 1/254 at least.
/// @param precision  of each column, at most 1; empty: 1
QuantisedModes quantised(const DenseMatrix& modes, const Vector& precision = {});

}   // namespace meshfolio
