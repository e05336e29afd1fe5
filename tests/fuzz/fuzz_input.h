/// @file
/// What fuzz targets share: bytes as numbers, and a word when a property does not hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace meshfolio::fuzzing {

/// A property that does not hold is a crash, which the fuzzer keeps as a file.
inline void require(bool holds, const char* property) {
    if (holds) return;
    std::fprintf(stderr, "does not hold: %s\n", property);
    std::abort();
}

inline std::string_view text_of(const std::uint8_t* bytes, std::size_t size) { return {reinterpret_cast<const char*>(bytes), size}; }

/// Takes numbers off the front of the input; zeros when it is used up.
class Bytes {
public:
    Bytes(const std::uint8_t* bytes, std::size_t size) : at_(bytes), left_(size) {}

    template <class Number>
    Number take() {
        Number number{};
        const std::size_t length = left_ < sizeof number ? left_ : sizeof number;
        if (length > 0) std::memcpy(&number, at_, length);
        at_ += length;
        left_ -= length;
        return number;
    }
    std::size_t left() const { return left_; }

private:
    const std::uint8_t* at_;
    std::size_t left_;
};

}   // namespace meshfolio::fuzzing
