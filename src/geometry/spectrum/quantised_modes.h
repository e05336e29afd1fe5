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
    Vector scale;                        // a step [as the modes]
    std::vector<std::int16_t> numbers;   // column by column

    DenseMatrix restored() const;
};

/// No number moves by more than half of its column's scale: of its largest magnitude, 1/65534 over the precision, and at most 1/254.
/// @param precision  of each column, 1 at most; empty: 1
QuantisedModes quantised(const DenseMatrix& modes, const Vector& precision = {});

}   // namespace meshfolio
