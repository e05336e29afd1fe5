/// @file
/// Seeded noise on vertices.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string_view>

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

/// X_i + σ z_i n_i, z standard normal, along unit vertex normals of the mesh; vertices without a normal stay. [length]
Positions with_normal_noise(const TriangleMesh& mesh, double sigma, std::uint64_t seed);

/// Every set of `count` rows is equally likely to be chosen; each of these gets Gaussian noise as above, the others stay. [length]
/// @throws MeshError for a count below 0 or beyond the rows
Positions with_impulsive_noise(const Positions& X, int count, double sigma, std::uint64_t seed);

enum class NoiseKind { gaussian, normal, box, impulsive };
inline constexpr double impulsive_share = 0.1;   // of the vertices, but at least one

struct NoiseEntry {
    NoiseKind kind;
    std::string_view name;          // "impulsive"
    std::string_view title;         // in tables and pictures
    std::string_view description;   // one sentence
};
std::span<const NoiseEntry> noise_list();
const NoiseEntry& noise_entry(NoiseKind kind);

/// Noise of any kind, equally strong: the expected squared displacement, averaged over the vertices (that have a normal, where it acts
/// along normals), is 3σ², as that of σ per coordinate.
///   gaussian   σ per coordinate
///   normal     √3 σ along the vertex normal
///   box        √3 σ e_a/|e| on axis a, e the extents of the bounding box: a share s of every extent when σ = s|e|/√3
///   impulsive  σ √(n/k) per coordinate on k = impulsive_share · n vertices
Positions with_noise(const TriangleMesh& mesh, NoiseKind kind, double sigma, std::uint64_t seed);

}   // namespace meshfolio
