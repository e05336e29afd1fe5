/// @file
/// Large pages behind large arrays: writing to an array for the first time, and reading it in random order, then take a fraction of the
/// time.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meshfolio {

/// To be called before the memory is written to. Only a hint: where the system has no large pages nothing happens.
inline void prefer_large_pages(void* begin, std::size_t bytes) {
    constexpr std::size_t page = 4096, worth_it = std::size_t{8} << 20;
    if (bytes < worth_it) return;
    const std::size_t to_page = (page - reinterpret_cast<std::uintptr_t>(begin) % page) % page;
    ::madvise(static_cast<char*>(begin) + to_page, (bytes - to_page) / page * page, MADV_HUGEPAGE);
}

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
