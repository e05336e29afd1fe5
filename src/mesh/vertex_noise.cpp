#include "mesh/vertex_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "base/errors.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

constexpr std::array kinds{
    NoiseEntry{NoiseKind::gaussian, "gaussian", "Gaussian", "Independent normal numbers on every coordinate."},
    NoiseEntry{NoiseKind::normal, "normal", "along the normal", "Independent normal numbers along the vertex normals."},
    NoiseEntry{NoiseKind::box, "box", "scaled by the box",
               "Independent normal numbers on every coordinate, each axis scaled by its extent of the bounding box."},
    NoiseEntry{NoiseKind::impulsive, "impulsive", "impulsive", "Strong normal numbers on every coordinate of one vertex in ten."},
};

/// Returns X_i + σ z_i n_i: standard normal z, n the unit vertex normals. Vertices without a normal stay.
Positions with_normal_noise(const TriangleMesh& mesh, double sigma, std::uint64_t seed) {
    NormalNumbers normal(seed);
    const Positions N = vertex_normals(mesh);
    Positions noisy = mesh.X;
    for (Eigen::Index i = 0; i < N.rows(); ++i) noisy.row(i) += sigma * normal.next() * N.row(i);
    return noisy;
}

/// Returns X with Gaussian noise on `count` rows, every set of them equally likely.
Positions with_impulsive_noise(const Positions& X, int count, double sigma, std::uint64_t seed) {
    NormalNumbers random(seed);
    Positions noisy = X;
    // Knuth 1997, algorithm 3.4.2 S: a row is chosen with probability (still to choose)/(rows left).
    int chosen = 0;
    for (Eigen::Index i = 0; i < X.rows() && chosen < count; ++i) {
        if (static_cast<double>(X.rows() - i) * random.uniform() >= count - chosen) continue;
        for (int axis = 0; axis < 3; ++axis) noisy(i, axis) += sigma * random.next();
        ++chosen;
    }
    return noisy;
}

}   // namespace

double NormalNumbers::uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }

double NormalNumbers::next() {
    if (has_spare_) {
        has_spare_ = false;
        return spare_;
    }
    // Box & Muller 1958. 1 − uniform() lies in (0, 1], so its logarithm exists.
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    const double angle = 2 * std::numbers::pi * uniform();
    spare_ = radius * std::sin(angle);
    has_spare_ = true;
    return radius * std::cos(angle);
}

Positions with_gaussian_noise(const Positions& X, const Vector3& sigma, std::uint64_t seed) {
    NormalNumbers normal(seed);
    Positions noisy = X;
    for (Eigen::Index i = 0; i < X.rows(); ++i)
        for (int axis = 0; axis < 3; ++axis) noisy(i, axis) += sigma[axis] * normal.next();
    return noisy;
}

Vector3 noise_unit(const TriangleMesh& mesh, std::string_view name) {
    if (name == "bbox") return bounding_box(mesh).extent();
    return Vector3::Constant(name == "diagonal" ? bounding_box(mesh).diagonal() : name == "h" ? mean_edge_length(mesh) : 1);
}

std::span<const NoiseEntry> noise_list() { return kinds; }

const NoiseEntry& noise_entry(NoiseKind kind) {
    return *std::find_if(kinds.begin(), kinds.end(), [&](const NoiseEntry& entry) { return entry.kind == kind; });
}

Positions with_noise(const TriangleMesh& mesh, NoiseKind kind, double sigma, std::uint64_t seed) {
    switch (kind) {
        case NoiseKind::gaussian: return with_gaussian_noise(mesh.X, Vector3::Constant(sigma), seed);
        case NoiseKind::normal: return with_normal_noise(mesh, std::sqrt(3) * sigma, seed);
        case NoiseKind::box: {
            const Vector3 extent = bounding_box(mesh).extent();
            const double diagonal = extent.norm();
            if (!(diagonal > 0)) throw MeshError("noise by the bounding box: the box has no extent", "take another kind of noise");
            return with_gaussian_noise(mesh.X, std::sqrt(3) * sigma / diagonal * extent, seed);
        }
        case NoiseKind::impulsive: {
            const int n = mesh.vertex_count(), count = std::max(1, static_cast<int>(std::lround(impulsive_share * n)));
            return with_impulsive_noise(mesh.X, count, sigma * std::sqrt(static_cast<double>(n) / count), seed);
        }
    }
    throw UsageError("there is no noise of kind number " + std::to_string(static_cast<int>(kind)), "take a kind of noise_list()");
}

}   // namespace meshfolio
