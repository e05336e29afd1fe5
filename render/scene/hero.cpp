// Views are scored on a coarse copy of the surface: cells of a grid of 40³ with the sum of the normals of the triangles in them. Sums are
// of whole numbers, so their order does not matter.
#include "scene/hero.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "rounding.h"

namespace render {

namespace {

constexpr int side = 40;

/// A cell with surface in it.
struct Patch {
    glm::dvec3 at;       // −1 to 1
    glm::dvec3 normal;   // not normalised
    double curvature;    // 0 where all normals agree, 1 where they cancel
};

struct Cell {
    std::int64_t x = 0, y = 0, z = 0, area = 0;
};

std::vector<Patch> patches_of(const Surface& surface, const Bounds& box) {
    const glm::dvec3 half = 0.5 * box.high - 0.5 * box.low, centre = 0.5 * box.low + 0.5 * box.high;
    const double scale = 1 / std::max({half.x, half.y, half.z, 1e-300});
    std::vector<Cell> cells(std::size_t{side} * side * side);
    const auto cell_of = [&](const glm::dvec3& p) {
        const auto along = [](double v) { return static_cast<std::size_t>(std::clamp((v + 1) * (side / 2.0), 0.0, side - 1.0)); };
        return (along(p.z) * side + along(p.y)) * side + along(p.x);
    };
    for (const glm::ivec3& t : surface.triangles) {
        if (!can_be_drawn(t, surface.positions)) continue;
        const auto at = [&](int k) { return (surface.positions[index(t[k])] - centre) * scale; };
        const glm::dvec3 a = at(0), b = at(1), c = at(2), n = glm::cross(b - a, c - a);
        const double length = glm::length(n);
        if (!(length > 0)) continue;
        Cell& cell = cells[cell_of((a + b + c) / 3.0)];
        const double unit = 1 << 30;
        cell.x += std::llrint(unit * n.x), cell.y += std::llrint(unit * n.y), cell.z += std::llrint(unit * n.z),
            cell.area += std::llrint(unit * length);
    }
    std::vector<Patch> patches;
    for (int i = 0; i < side * side * side; ++i) {
        const Cell& cell = cells[index(i)];
        if (cell.area == 0) continue;
        const glm::dvec3 place(i % side, i / side % side, i / (side * side)), sum(double(cell.x), double(cell.y), double(cell.z));
        patches.push_back({(place + 0.5) / (side / 2.0) - 1.0, sum, 1 - std::min(1.0, glm::length(sum) / double(cell.area))});
    }
    return patches;
}

/// What is seen of the patches: one for each place in a small picture that shows a front, and more where it is curved, near and high up: of
/// heads and faces more is to be seen than of hindquarters and feet.
double score(const std::vector<Patch>& patches, const View& view) {
    constexpr int pixels = 44;
    constexpr double curved = 12;   // how much more
    std::array<const Patch*, std::size_t{pixels} * pixels> nearest{};
    std::array<double, std::size_t{pixels} * pixels> depth{};
    for (const Patch& patch : patches) {
        const auto along = [&](const glm::dvec3& axis) {
            return std::clamp(int((glm::dot(patch.at, axis) / 1.8 + 1) * (pixels / 2.0)), 0, pixels - 1);
        };
        const std::size_t place = index(along(view.up) * pixels + along(view.right()));
        const double d = glm::dot(patch.at, view.from);
        if (nearest[place] == nullptr || d > depth[place]) nearest[place] = &patch, depth[place] = d;
    }
    double sum = 0;
    for (const Patch* patch : nearest)
        if (patch != nullptr && glm::dot(patch->normal, view.from) > 0)
            sum += 1 + curved * patch->curvature * (1 + glm::dot(patch->at, view.from)) * (1 + glm::dot(patch->at, view.up));
    return sum;
}

/// Share of the patches that have one like them, or beside it, on the other side of the middle along an axis.
double symmetry(const std::vector<Patch>& patches, int axis) {
    std::vector<char> near(std::size_t{side + 2} * (side + 2) * (side + 2));
    const auto place = [&](glm::dvec3 at) {
        const glm::ivec3 cell = glm::ivec3(glm::floor((at + 1.0) * (side / 2.0))) + 1;
        return index((cell.z * (side + 2) + cell.y) * (side + 2) + cell.x);
    };
    for (const Patch& patch : patches)
        for (int k = 0; k < 3; ++k)
            for (const double step : {-2.0 / side, 0.0, 2.0 / side}) {
                glm::dvec3 at = patch.at;
                at[axis] = -at[axis], at[k] += step;
                near[place(at)] = 1;
            }
    const auto found = std::count_if(patches.begin(), patches.end(), [&](const Patch& patch) { return near[place(patch.at)] != 0; });
    return static_cast<double>(found) / static_cast<double>(std::max<std::size_t>(1, patches.size()));
}

}   // namespace

View hero_view(const Surface& surface) {
    const Bounds box = bounds_of(surface.positions, surface.triangles);
    const std::vector<Patch> patches = patches_of(surface, box);
    const glm::dvec3 extent = box.high - box.low;
    const double along_y = symmetry(patches, 1), along_z = symmetry(patches, 2);
    const bool z_up = extent.z > 1.05 * std::min(extent.x, extent.y) && along_y > 0.85 && along_y > along_z + 0.15;
    const View usual = three_quarter_view();
    View best = usual;
    double most = 0;
    for (const int turn : {0, 20, 90, 110, 180, 200, 270, 290}) {
        const double a = glm::radians(double(turn)), c = std::cos(a), s = std::sin(a);
        const auto turned = [&](const glm::dvec3& v) {
            const glm::dvec3 about_y(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
            return z_up ? glm::dvec3(about_y.x, -about_y.z, about_y.y) : about_y;
        };
        View view = usual;
        view.from = turned(usual.from), view.up = turned(usual.up);
        const double seen = score(patches, view) * (turn == 0 ? 1.15 : 1);
        if (seen > most) most = seen, best = view;
    }
    return best;
}

}   // namespace render
