/// @file
/// Eigenvectors in 16 bits a number: a reader's page carries those of a small mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

/// Column j is scale[j] times whole numbers between ±32767.
struct QuantisedModes {
    static constexpr int largest = 32767;
    int rows = 0;
    Vector scale;                        // largest magnitude of the column over `largest` [as the modes]
    std::vector<std::int16_t> numbers;   // column by column

    DenseMatrix restored() const;
};

/// No number moves by more than half of its column's scale, 1/65534 of the column's largest magnitude.
QuantisedModes quantised(const DenseMatrix& modes);

}   // namespace meshfolio
