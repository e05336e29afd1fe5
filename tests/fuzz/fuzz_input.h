/// @file
/// Helpers of the fuzz targets: numbers from bytes, and a message if a property does not hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace meshfolio::fuzzing {

/// Crashes if a property does not hold; the fuzzer then keeps the input as a file.
inline void require(bool holds, const char* property) {
    if (holds) return;
    std::fprintf(stderr, "does not hold: %s\n", property);
    std::abort();
}

inline std::string_view text_of(const std::uint8_t* bytes, std::size_t size) { return {reinterpret_cast<const char*>(bytes), size}; }

/// Takes numbers from the front of the input; zeros at its end.
class Bytes {
public:
    Bytes(const std::uint8_t* bytes, std::size_t size) : at_(bytes), left_(size) {}

    template <class Number> Number take() {
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
