#include "mesh/vertex_fans.h"

#include <algorithm>
#include <array>

#include "base/at.h"
#include "mesh/prefetch.h"

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

/// Whether up to eight triangles around v form one closed fan and run the same way: each is followed, across the edge to `previous`, by one
/// whose `next` that is, and going on so leads round through all of them. `render` of 776 k triangles takes 1.4 times as long without.
bool is_umbrella(const TriangleMesh& mesh, const Incidence& vertex_faces, int v) {
    constexpr int most = 8, ahead = 64;
    const int triangles = vertex_faces.size(v);
    if (triangles < 3 || triangles > most) return false;   // two closed by each other are the same triangle
    const int* const faces = vertex_faces.begin(v);
    const int* const last = vertex_faces.item.data() + vertex_faces.item.size() - 1;
    std::array<Sides, most> sides;
    for (int i = 0; i < triangles; ++i) {
        prefetch(corners_of(mesh, last - faces > ahead + i ? faces[i + ahead] : *last));   // triangles lie anywhere in memory
        sides[at(i)] = sides_at(corners_of(mesh, faces[i]), v);
    }
    int t = 0;
    for (int steps = 1; steps <= triangles; ++steps) {
        const int end = sides[at(t)].previous;
        for (t = 0; t < triangles && sides[at(t)].next != end;) ++t;
        if (t == triangles) return false;
        if (t == 0) return steps == triangles;
    }
    return false;
}

}   // namespace

FanFacts FanReader::facts(int v) {
    if (vertex_faces_.size(v) == 0 || is_umbrella(mesh_, vertex_faces_, v)) return {};
    return facts_the_long_way(v);
}

FanFacts FanReader::facts_the_long_way(int v) {
    read_spokes(v);
    FanFacts facts;
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
    const bool one_triangle_twice = ring_.size() == 2 && !facts.on_boundary;
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
    for (const Spoke& s : spokes_)
        if (ring_.empty() || ring_.back() != s.other) ring_.push_back(s.other);
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

}   // namespace meshfolio
