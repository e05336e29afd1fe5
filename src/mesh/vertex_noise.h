/// @file
/// Seeded noise on vertices.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Standard normal numbers by Box–Muller over mt19937_64: the standard fixes its bits, but not those of std::normal_distribution.
class NormalNumbers {
public:
    explicit NormalNumbers(std::uint64_t seed) : bits_(seed) {}
    /// Returns the next normal number, of mean 0 and variance 1.
    double next();
    /// Returns a number distributed uniformly in [0, 1), of 53 bits.
    double uniform();

private:
    std::mt19937_64 bits_;
    double spare_ = 0;
    bool has_spare_ = false;
};

/// Returns X plus independent normal noise, of standard deviation sigma[axis], drawn row by row in the order x y z. [length]
Positions with_gaussian_noise(const Positions& X, const Vector3& sigma, std::uint64_t seed);

inline const std::vector<std::string> noise_units{"raw", "bbox", "diagonal", "h"};
/// Returns σ = 1 along each axis in a unit of noise_units: 1, the extents of the bounding box, its diagonal, the mean edge. [length]
Vector3 noise_unit(const TriangleMesh& mesh, std::string_view name);

enum class NoiseKind { gaussian, normal, box, impulsive };
inline constexpr double impulsive_share = 0.1;   // of the vertices, but at least one

struct NoiseEntry {
    NoiseKind kind;
    std::string_view name;          // "impulsive"
    std::string_view title;         // in tables and pictures
    std::string_view description;   // one sentence
};
/// Returns the entries of all kinds.
std::span<const NoiseEntry> noise_list();
/// Returns the entry of one kind in noise_list().
const NoiseEntry& noise_entry(NoiseKind kind);

/// Returns the positions with noise of the given kind. All kinds are equally strong: the expected squared displacement, averaged over the
/// vertices (that have a normal, for `normal`), is 3σ².
///   gaussian   σ per coordinate
///   normal     √3 σ along the vertex normal
///   box        √3 σ e_a/|e| on axis a, e the extents of the bounding box: a share s of every extent when σ = s|e|/√3
///   impulsive  σ √(n/k) per coordinate on k = impulsive_share · n vertices
Positions with_noise(const TriangleMesh& mesh, NoiseKind kind, double sigma, std::uint64_t seed);

}   // namespace meshfolio
