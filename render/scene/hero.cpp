// Views are scored on a coarse copy of the surface: a grid of 40³ cells, each with the sum of the normals of its triangles. The sums are of
// integers, so that their order does not matter.
#include "scene/hero.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <vector>

#include "rounding.h"

namespace render {

namespace {

constexpr int side = 40;

/// A cell that contains surface.
struct Patch {
    glm::dvec3 at;       // −1 to 1
    glm::dvec3 normal;   // not normalised
    double curvature;    // 0 where all normals agree, 1 where they cancel
};

/// Returns the box of all finite positions, of unused ones too.
Bounds box_of(std::span<const glm::dvec3> positions) {
    Bounds box{glm::dvec3(std::numeric_limits<double>::max()), glm::dvec3(std::numeric_limits<double>::lowest())};
    for (const glm::dvec3& p : positions)
        if (std::isfinite(p.x + p.y + p.z)) box = {glm::min(box.low, p), glm::max(box.high, p)};
    return box.low.x <= box.high.x ? box : Bounds{};
}

/// Maps the longest side of a box to −1 … 1.
struct Unit {
    glm::dvec3 centre, half;
    double scale;

    explicit Unit(const Bounds& box)
        : centre(0.5 * box.low + 0.5 * box.high),
          half(0.5 * box.high - 0.5 * box.low),
          scale(1 / std::max({half.x, half.y, half.z, 1e-300})) {}
    glm::dvec3 operator()(const glm::dvec3& p) const { return (p - centre) * scale; }
};

/// Marks about 3000 vertices of a large mesh, chosen by a hash of their places, or all vertices of a small one.
std::vector<char> chosen_vertices(std::span<const glm::dvec3> positions, const Unit& unit) {
    const std::uint64_t one_in = std::max<std::size_t>(1, positions.size() / 3000);
    std::vector<char> chosen(positions.size(), one_in == 1 ? 1 : 0);
    if (one_in == 1) return chosen;
    const std::uint64_t limit = ~std::uint64_t{0} / one_in;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3 p = unit(positions[i]) * double(1 << 20);   // fine enough to tell neighbours apart
        if (!(std::abs(p.x) + std::abs(p.y) + std::abs(p.z) < 1e12)) continue;
        const auto bits = [](double v) { return static_cast<std::uint64_t>(std::llrint(v)); };
        std::uint64_t hash = (bits(p.x) * 0x9e3779b97f4a7c15U ^ bits(p.y)) * 0xbf58476d1ce4e5b9U ^ bits(p.z);
        hash = (hash ^ hash >> 31) * 0x94d049bb133111ebU;
        chosen[i] = hash < limit ? 1 : 0;
    }
    return chosen;
}

std::vector<Patch> patches_of(const Surface& surface, const Bounds& box) {
    const Unit unit(box);
    const std::vector<char> chosen = chosen_vertices(surface.positions, unit);
    struct Cell {
        std::int64_t x = 0, y = 0, z = 0, area = 0;
    };
    std::vector<Cell> cells(std::size_t{side} * side * side);
    const auto cell_of = [&](const glm::dvec3& p) {
        const auto along = [](double v) { return static_cast<std::size_t>(std::clamp((v + 1) * (side / 2.0), 0.0, side - 1.0)); };
        return (along(p.z) * side + along(p.y)) * side + along(p.x);
    };
    const auto is_chosen = [&](int v) { return static_cast<std::size_t>(v) < chosen.size() && chosen[index(v)] != 0; };
    for (const glm::ivec3& t : surface.triangles) {
        if (!(is_chosen(t.x) || is_chosen(t.y) || is_chosen(t.z)) || !can_be_drawn(t, surface.positions)) continue;
        const glm::dvec3 a = unit(surface.positions[index(t.x)]), b = unit(surface.positions[index(t.y)]),
                         c = unit(surface.positions[index(t.z)]), n = glm::cross(b - a, c - a);
        Cell& cell = cells[cell_of((a + b + c) / 3.0)];
        const double scale = std::int64_t{1} << 40;
        cell.x += std::llrint(scale * n.x), cell.y += std::llrint(scale * n.y), cell.z += std::llrint(scale * n.z);
        cell.area += std::llrint(scale * glm::length(n));
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

/// Scores a view by a small picture of the patches: 1 for each pixel that shows a front, and more if it is curved, near and high up,
/// because heads and faces tell more than hindquarters and feet.
double score(const std::vector<Patch>& patches, const View& view) {
    constexpr int pixels = 44;
    constexpr double curved = 12;   // weight of curved fronts
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

/// Returns the share of the patches with a mirror image along an axis among the patches, up to one cell.
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

View hero_view(const Surface& surface, std::optional<Up> up) {
    const Bounds box = box_of(surface.positions);
    const std::vector<Patch> patches = patches_of(surface, box);
    const glm::dvec3 extent = box.high - box.low;
    const double along_y = symmetry(patches, 1), along_z = symmetry(patches, 2);
    const bool looks_z_up = extent.z > 1.05 * std::min(extent.x, extent.y) && along_y > 0.85 && along_y > along_z + 0.15;
    const Up top = up.value_or(looks_z_up ? Up::z : Up::y);
    const View usual = three_quarter_view();
    View best = view_named("hero", up.value_or(Up::y));
    double most = 0;
    for (const int turn : {0, 20, 90, 110, 180, 200, 270, 290}) {
        const double a = glm::radians(double(turn)), c = std::cos(a), s = std::sin(a);
        const auto turned = [&](const glm::dvec3& v) { return turned_to(top, {c * v.x + s * v.z, v.y, c * v.z - s * v.x}); };
        View view = usual;
        view.from = turned(usual.from), view.up = turned(usual.up);
        const double seen = score(patches, view) * (turn == 0 ? 1.15 : 1);
        if (seen > most) most = seen, best = view;
    }
    return best;
}

View view_of(const Sight& sight, const Surface& surface) {
    return sight.camera ? view_from(*sight.camera, sight.up.value_or(Up::y)) : hero_view(surface, sight.up);
}

}   // namespace render
