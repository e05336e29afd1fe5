#include "mesh/io/glb/glb_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/at.h"
#include "mesh/disjoint_sets.h"
#include "mesh/point_table.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace {

/// Returns a number for each vertex, from 0; vertices with equal coordinates get equal numbers.
std::vector<int> places_of(const Positions& X) {
    PointTable table(static_cast<std::size_t>(X.rows()));
    std::vector<int> places;
    for (Eigen::Index v = 0; v < X.rows(); ++v) places.push_back(table.number_of({X(v, 0), X(v, 1), X(v, 2)}));
    return places;
}

}   // namespace

nlohmann::ordered_json GlbFrame::node(std::size_t mesh) const {
    nlohmann::ordered_json node{{"mesh", mesh}};
    if (translation.isZero(0) && scale == 1) return node;
    node["translation"] = std::array{translation[0], translation[1], translation[2]};
    node["scale"] = std::array{scale, scale, scale};
    return node;
}

GlbFrame float_frame(const TriangleMesh& mesh) {
    GlbFrame frame;
    if (stored_as_floats(mesh, frame) == mesh.X) return frame;
    const Box box = bounding_box(mesh);
    const double extent = box.extent().maxCoeff(), farthest = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
    if (farthest > extent) {
        const double step = std::ldexp(1, std::max(std::ilogb(std::max(extent, farthest * 1e-15)) - 3, -1000));
        for (int axis = 0; axis < 3; ++axis) frame.translation[axis] = std::round(box.centre()[axis] / step) * step;
    }
    const double reach = (mesh.X.rowwise() - frame.translation.transpose()).cwiseAbs().maxCoeff();
    if (reach > 0 && (reach > 1e15 || reach < 1e-15)) frame.scale = std::ldexp(1, std::max(std::ilogb(reach), -1000));
    return frame;
}

Positions stored_as_floats(const TriangleMesh& mesh, const GlbFrame& frame) {
    return Positions::NullaryExpr(mesh.X.rows(), 3, [&](Eigen::Index v, Eigen::Index axis) {
        const double stored = frame.stored(mesh.X(v, axis), static_cast<int>(axis));
        return frame.translation[axis] + frame.scale * static_cast<double>(static_cast<float>(stored));
    });
}

std::vector<int> one_part(const TriangleMesh& mesh) {
    std::vector<int> parts(at(mesh.vertex_count()), -1);
    for (const int v : mesh.F.reshaped()) parts[at(v)] = 0;
    return parts;
}

int count_of_welded(const Positions& X, const std::vector<int>& parts) {
    const std::vector<int> places = places_of(X);
    std::vector<int> last(places.size(), -1);   // of each place, the part that had it; parts ascend
    int welded = 0;
    for (std::size_t v = 0; v < parts.size(); ++v) {
        if (parts[v] < 0) continue;
        welded += last[at(places[v])] == parts[v] ? 1 : 0;
        last[at(places[v])] = parts[v];
    }
    return welded;
}

std::vector<int> parts_that_keep_apart(const TriangleMesh& mesh, const Positions& X) {
    const std::vector<int> whole = one_part(mesh);
    if (count_of_welded(X, whole) == 0) return whole;
    const int n = mesh.vertex_count();
    DisjointSets components(n);
    for (int t = 0; t < mesh.face_count(); ++t)
        for (int k = 1; k < 3; ++k) components.join(mesh.F(t, 0), mesh.F(t, k));
    const std::vector<int> places = places_of(X);
    std::vector<int> parts = whole, last_part(at(n), -1), last_component(at(n), -1);
    std::vector<char> is_done(at(n), 0);
    int part = 0;
    for (int begin = 0, end = 0; begin < n; begin = end) {   // of one component
        const int component = components.find(begin);
        if (is_done[at(component)] != 0) return whole;   // mixed
        is_done[at(component)] = 1;
        bool touches = false;
        for (end = begin; end < n && (whole[at(end)] < 0 || components.find(end) == component); ++end) {
            const std::size_t place = at(places[at(end)]);
            touches |= whole[at(end)] == 0 && last_part[place] == part && last_component[place] != component;
        }
        part += touches ? 1 : 0;
        for (int v = begin; v < end; ++v) {
            if (whole[at(v)] < 0) continue;
            parts[at(v)] = last_part[at(places[at(v)])] = part;
            last_component[at(places[at(v)])] = component;
        }
    }
    return parts;
}

}   // namespace meshfolio
