/// @file
/// Seeded Gaussian noise on vertices.
#pragma once

#include <cstdint>
#include <random>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Standard normal numbers by Box–Muller over mt19937_64, whose bits the standard fixes.
/// (std::normal_distribution gives other numbers in other libraries.)
class NormalNumbers {
public:
    explicit NormalNumbers(std::uint64_t seed) : bits_(seed) {}
    double next();
    double uniform();   // in [0, 1), 53 bits

private:
    std::mt19937_64 bits_;
    double spare_ = 0;
    bool has_spare_ = false;
};

/// X + noise, iid per coordinate with standard deviation sigma[axis], row by row in x y z order. [length]
Positions with_gaussian_noise(const Positions& X, const Vector3& sigma, std::uint64_t seed);

}   // namespace meshfolio
