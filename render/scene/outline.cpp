#include "scene/outline.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

#include "rounding.h"

namespace render {

namespace {

/// Hashes a number (finaliser of SplitMix64, Steele et al. 2014).
std::uint64_t scattered(std::uint64_t i) {
    i = (i + 1) * 0x9e3779b97f4a7c15U;
    i = (i ^ (i >> 30)) * 0xbf58476d1ce4e5b9U;
    i = (i ^ (i >> 27)) * 0x94d049bb133111ebU;
    return i ^ (i >> 31);
}

/// True if every edge occurs equally often in both directions, as in a closed, consistently oriented surface: then the hashes of its
/// directed edges, which differ in sign for opposite directions, sum to 0. For other surfaces that happens hardly ever.
bool is_closed(const Surface& surface) {
    const auto signed_hash = [](int from, int to) {
        const auto ends = std::minmax(from, to);
        const std::uint64_t hash = scattered(static_cast<std::uint64_t>(ends.first) << 32 | static_cast<std::uint32_t>(ends.second));
        return from < to ? hash : 0 - hash;
    };
    const std::uint64_t sum = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, surface.triangles.size(), 16384), std::uint64_t{0},
        [&](const auto& part, std::uint64_t total) {
            for (std::size_t i = part.begin(); i < part.end(); ++i) {
                const glm::ivec3& t = surface.triangles[i];
                total += signed_hash(t.x, t.y) + signed_hash(t.y, t.z) + signed_hash(t.z, t.x);
            }
            return total;
        },
        std::plus<>());
    return sum == 0;
}

/// Marks vertices that include all boundary vertices. Around an inner vertex of a consistently oriented surface the opposite edges close
/// up, so that Σ (next − previous) = 0; with hashes of the vertices that happens hardly ever elsewhere.
std::vector<bool> may_lie_on_boundary(const Surface& surface) {
    std::vector<std::uint64_t> sum(surface.positions.size(), 0);
    for (const glm::ivec3& t : surface.triangles) {
        if (!can_be_drawn(t, surface.positions)) continue;
        for (int k = 0; k < 3; ++k) sum[index(t[k])] += scattered(index(t[(k + 1) % 3])) - scattered(index(t[(k + 2) % 3]));
    }
    std::vector<bool> result(sum.size());
    std::transform(sum.begin(), sum.end(), result.begin(), [](std::uint64_t s) { return s != 0; });
    return result;
}

/// Keeps the first of equal ribbons, such as those of many triangles in one place, because it hides the others.
std::vector<Ribbon> each_once(std::vector<Ribbon> ribbons) {
    std::vector<std::size_t> order(ribbons.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto same = [&](std::size_t i, std::size_t j) { return ribbons[i].screen == ribbons[j].screen; };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return ribbons[i].screen.corner < ribbons[j].screen.corner; });
    order.erase(std::unique(order.begin(), order.end(), same), order.end());
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < order.size(); ++i) ribbons[i] = ribbons[order[i]];
    ribbons.erase(ribbons.begin() + static_cast<std::ptrdiff_t>(order.size()), ribbons.end());
    return ribbons;
}

ScreenPoint moved(const ScreenPoint& p, glm::dvec2 by) { return {p.x + std::llrint(by.x), p.y + std::llrint(by.y), p.depth}; }

}   // namespace

std::vector<BoundaryEdge> boundary_edges(const Surface& surface) {
    if (is_closed(surface)) return {};
    const std::vector<bool> candidate = may_lie_on_boundary(surface);
    std::vector<BoundaryEdge> edges;
    for (std::size_t id = 0; id < surface.triangles.size(); ++id) {
        const glm::ivec3& t = surface.triangles[id];
        if (!can_be_drawn(t, surface.positions)) continue;
        for (int k = 0; k < 3; ++k) {
            const int a = std::min(t[k], t[(k + 1) % 3]), b = std::max(t[k], t[(k + 1) % 3]);
            if (candidate[index(a)] && candidate[index(b)]) edges.push_back({a, b, static_cast<std::int32_t>(id)});
        }
    }
    std::ranges::sort(edges, {}, [](const BoundaryEdge& e) { return std::tuple(e.a, e.b, e.triangle); });
    const auto same_edge = [](const BoundaryEdge& e, const BoundaryEdge& f) { return e.a == f.a && e.b == f.b; };
    std::vector<BoundaryEdge> single;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const bool repeated = (i > 0 && same_edge(edges[i - 1], edges[i])) || (i + 1 < edges.size() && same_edge(edges[i], edges[i + 1]));
        if (!repeated) single.push_back(edges[i]);
    }
    return single;
}

std::vector<Ribbon> edge_on_ribbons(const ProjectedScene& scene, std::span<const BoundaryEdge> edges, double width) {
    const auto is_seen_edge_on = [&](const BoundaryEdge& e) {
        const Surface& surface = scene.scene.surface;
        const Frame& frame = scene.scene.frame;
        const glm::ivec3& t = surface.triangles[index(e.triangle)];
        const auto at = [&](int k) { return (surface.positions[index(t[k])] - frame.centre) * frame.pixels_per_unit; };
        const glm::dvec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
        return std::abs(glm::dot(normal, scene.axes.depth)) < 0.004 * glm::length(normal);
    };
    std::vector<BoundaryEdge> hidden;
    std::ranges::copy_if(edges, std::back_inserter(hidden), is_seen_edge_on);
    if (2 * hidden.size() < edges.size()) return {};   // parts of the rim of a curved surface
    std::vector<Ribbon> ribbons;
    for (const BoundaryEdge& e : hidden) {
        const ScreenPoint a = scene.exact_corner(e.a), b = scene.exact_corner(e.b);
        const glm::dvec2 along(b.x - a.x, b.y - a.y);
        const double length = glm::length(along);
        if (length == 0) continue;
        const glm::dvec2 across = 0.5 * width * subpixels / length * glm::dvec2(-along.y, along.x);
        const ScreenPoint a0 = moved(a, -across), a1 = moved(a, across), b0 = moved(b, -across), b1 = moved(b, across);
        ribbons.push_back({{{a0, b0, b1}}, glm::ivec3(e.a, e.b, e.b)});
        ribbons.push_back({{{a0, b1, a1}}, glm::ivec3(e.a, e.b, e.a)});
    }
    return each_once(std::move(ribbons));
}

}   // namespace render
