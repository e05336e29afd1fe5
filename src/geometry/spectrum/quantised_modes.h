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

/// Rounds the columns. No number moves by more than half of its column's scale: of its largest magnitude 1/65534 over the precision, at
/// most 1/254.
/// @param precision  of each column, at most 1; empty: 1
QuantisedModes quantised(const DenseMatrix& modes, const Vector& precision = {});

}   // namespace meshfolio
