#include "scene/projection.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace render {

namespace {

bool points_backwards(const glm::dvec3& v) {
    for (int k = 0; k < 3; ++k)
        if (v[k] != 0) return v[k] < 0;
    return false;
}

/// Adding 0 turns −0 into 0.
glm::dvec3 forwards(const glm::dvec3& v) { return (points_backwards(v) ? -v : v) + 0.0; }

}   // namespace

int Axes::handedness() const { return glm::dot(glm::cross(across, up), depth) > 0 ? 1 : -1; }

std::vector<Projection> projections_of(std::span<const View> views) {
    std::vector<Projection> projections;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const glm::dvec3 right = views[i].right(), up = views[i].up, from = views[i].from;
        const Axes axes{forwards(right), forwards(up), forwards(from)};
        auto found = std::find_if(projections.begin(), projections.end(), [&](const Projection& p) { return p.axes == axes; });
        if (found == projections.end()) found = projections.insert(found, {axes, {}});
        found->placements.push_back({i, points_backwards(right), points_backwards(up), points_backwards(from)});
    }
    return projections;
}

}   // namespace render
