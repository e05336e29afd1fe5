/// @file
/// Large arrays in large pages, which take a fraction of the time to write for the first time and to read in random order.
#pragma once

#include <cstddef>
#include <vector>

#include "base/linux_only.h"

namespace meshfolio {

/// Returns `size` zeros.
template <class T>
std::vector<T> large_vector(std::size_t size) {
    std::vector<T> values;
    values.reserve(size);
    prefer_large_pages(values.data(), size * sizeof(T));
    values.resize(size);
    return values;
}

}   // namespace meshfolio
