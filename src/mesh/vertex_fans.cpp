#include "mesh/vertex_fans.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace meshfolio {

namespace {

/// A triangle around v runs from v to `next`, on to `previous`, and back.
struct Sides {
    int next, previous;
};

const int* corners_of(const TriangleMesh& mesh, int t) { return mesh.F.data() + 3 * static_cast<std::size_t>(t); }

Sides sides_at(const int* corner, int v) {
    const int k = (corner[1] == v ? 1 : 0) + (corner[2] == v ? 2 : 0);
    constexpr int next[] = {1, 2, 0}, previous[] = {2, 0, 1};
    return {corner[next[k]], corner[previous[k]]};   // NOLINT(clang-analyzer-core.uninitialized.ArraySubscript): corners differ, no k is 3
}

/// Four integers computed with as one (an extension of GCC and Clang); comparisons give −1 where they hold, 0 where not.
using Four = int __attribute__((vector_size(16)));

Four four_at(const int* values) {
    Four four;
    std::memcpy(&four, values, sizeof(four));
    return four;
}

void store(const Four& four, int* values) { std::memcpy(values, &four, sizeof(four)); }

constexpr int most = 8;
constexpr int none = std::numeric_limits<int>::max();   // larger than every vertex

/// The sides of up to eight triangles. Slots without one fit to nothing.
struct SmallFan {
    int next[most] = {none, none, none, none, none, none, none, none};
    int previous[most] = {-1, -1, -1, -1, -1, -1, -1, -1};
    int size;

    SmallFan(const TriangleMesh& mesh, const Incidence& vertex_faces, int v) : size(vertex_faces.size(v)) {
        const int* const faces = vertex_faces.begin(v);
        const int* const last = vertex_faces.item.data() + vertex_faces.item.size() - 1;
        for (int i = 0; i < size; ++i) {
            // Triangles lie anywhere in memory: those of the vertices to come are sent for in time.
            constexpr int ahead = 64;
            __builtin_prefetch(corners_of(mesh, last - faces > ahead + i ? faces[i + ahead] : *last));
            const Sides sides = sides_at(corners_of(mesh, faces[i]), v);
            next[i] = sides.next;
            previous[i] = sides.previous;
        }
    }

    /// Whether each triangle is followed, across the edge to `previous`, by exactly one that begins there, and going on so leads
    /// round through all of them.
    bool is_closed_cycle() const {
        int link[most] = {};   // the follower, or −1 where there is not exactly one
        for (int half = 0; half < most; half += 4) {
            const Four end = four_at(previous + half);
            Four follower{}, followers{};
            for (int j = 0; j < most; ++j) {
                const Four follows = end == next[j];
                followers -= follows;
                follower += follows & j;
            }
            store(follower | (followers != 1), link + half);
        }
        int steps = 1, i = link[0];
        for (; i > 0 && steps < size; ++steps) i = link[i];
        return i == 0 && steps == size;
    }

    int smallest() const { return *std::min_element(std::begin(next), std::end(next)); }

    /// Writes `next` in ascending order: the place of each is the number of smaller ones.
    void sort_next(std::array<int, most + 1>& sorted) const {
        int place[most] = {};
        for (int half = 0; half < most; half += 4) {
            const Four value = four_at(next + half);
            Four smaller{};
            for (int j = 0; j < most; ++j) smaller -= value > next[j];
            store(smaller, place + half);
        }
        for (int i = 0; i < most; ++i) sorted[static_cast<std::size_t>(place[i])] = next[i];
    }
};

}   // namespace

FanFacts FanReader::facts(int v) {
    const int triangles = vertex_faces_.size(v);
    if (triangles == 0) return {0, v, false, false, true};
    if (triangles >= 3 && triangles <= most) {   // two closed by each other are the same triangle
        const SmallFan fan(mesh_, vertex_faces_, v);
        if (fan.is_closed_cycle()) return {triangles, std::min(v, fan.smallest()), false, false, true};
    }
    return facts_the_long_way(v);
}

FanFacts FanReader::facts_the_long_way(int v) {
    read_spokes(v);
    FanFacts facts;
    facts.ring_size = static_cast<int>(ring_.size());
    facts.smallest_neighbour = std::min(v, ring_.front());
    for (auto spoke = spokes_.begin(); spoke != spokes_.end();) {
        const auto end = std::find_if(spoke, spokes_.end(), [&](const Spoke& s) { return s.other != spoke->other; });
        const auto sides = end - spoke;
        const auto out = std::count_if(spoke, end, [](const Spoke& s) { return s.out; });
        if (sides == 1) facts.on_boundary = true;
        if (sides > 2) facts.nonmanifold = true;
        if (out > 1 || sides - out > 1) facts.regular = false;
        spoke = end;
    }
    if (fan_count(v) > 1) facts.nonmanifold = true;
    const bool one_triangle_twice = facts.ring_size == 2 && !facts.on_boundary;
    if (facts.nonmanifold || one_triangle_twice) facts.regular = false;
    return facts;
}

void FanReader::read_spokes(int v) {
    spokes_.clear();
    for (const int* t = vertex_faces_.begin(v); t != vertex_faces_.end(v); ++t) {
        const Sides sides = sides_at(corners_of(mesh_, *t), v);
        spokes_.push_back({sides.next, true});
        spokes_.push_back({sides.previous, false});
    }
    std::sort(spokes_.begin(), spokes_.end(), [](const Spoke& s, const Spoke& u) { return s.other < u.other; });
    ring_.clear();
    for (const Spoke& s : spokes_) {
        if (ring_.empty() || ring_.back() != s.other) ring_.push_back(s.other);
    }
}

/// Sets of triangles joined through edges at v: parts of its link.
int FanReader::fan_count(int v) {
    const auto place = [&](int w) { return static_cast<int>(std::lower_bound(ring_.begin(), ring_.end(), w) - ring_.begin()); };
    int parts = static_cast<int>(ring_.size());
    fans_.reset(parts);
    for (const int* t = vertex_faces_.begin(v); t != vertex_faces_.end(v); ++t) {
        const Sides sides = sides_at(corners_of(mesh_, *t), v);
        if (fans_.join(place(sides.next), place(sides.previous))) --parts;
    }
    return parts;
}

std::span<const int> FanReader::ring(int v, bool interior) {
    const int triangles = vertex_faces_.size(v);
    if (!interior || triangles > most) {
        read_spokes(v);
        return ring_;
    }
    SmallFan(mesh_, vertex_faces_, v).sort_next(sorted_);   // all neighbours are `next` of one triangle each
    return std::span<const int>(sorted_).first(static_cast<std::size_t>(triangles));
}

}   // namespace meshfolio
