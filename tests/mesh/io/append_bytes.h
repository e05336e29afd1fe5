/// @file
/// Numbers as the bytes of a binary file.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace meshfolio::testing {

template <class T> void append(std::string& bytes, T value, bool big_endian = false) {
    std::string raw(sizeof(T), '\0');
    std::memcpy(raw.data(), &value, sizeof(T));
    if (big_endian != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
    bytes += raw;
}

}   // namespace meshfolio::testing
