/// @file
/// Random numbers for start vectors, the same on every machine. Private to the layer.
#pragma once

#include <cstdint>

namespace meshfolio {

/// Advances `state` and returns the next random number, uniform in [−½, ½) (splitmix64, Steele et al. 2014).
inline double uniform_number(std::uint64_t& state) {
    state += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53 - 0.5;
}

}   // namespace meshfolio
