/// @file
/// Large pages behind large arrays: writing to an array for the first time, and reading it in random order, then take a fraction of the
/// time.
#pragma once

#include <cstddef>
#include <vector>

#include "base/linux_only.h"

namespace meshfolio {

/// `size` zeros.
template <class T>
std::vector<T> large_vector(std::size_t size) {
    std::vector<T> values;
    values.reserve(size);
    prefer_large_pages(values.data(), size * sizeof(T));
    values.resize(size);
    return values;
}

}   // namespace meshfolio
