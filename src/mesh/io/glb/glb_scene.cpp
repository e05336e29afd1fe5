#include "mesh/io/glb/glb_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

namespace meshfolio {

namespace {

using Json = GlbDocument::Json;

/// T R S (§3.5.3); `turn` as x, y, z, w.
Eigen::Matrix4d transformation(const Vector3& move, const Eigen::Vector4d& turn, const Vector3& size) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = Eigen::Quaterniond(turn).normalized().toRotationMatrix() * size.asDiagonal();
    matrix.topRightCorner<3, 1>() = move;
    return matrix;
}

Eigen::Matrix4d matrix_of(const Json& node) {
    const auto numbers = [&](const char* key, const auto& otherwise) {
        return node.contains(key) ? node.at(key).template get<std::decay_t<decltype(otherwise)>>() : otherwise;
    };
    if (node.contains("matrix")) return Eigen::Map<const Eigen::Matrix4d>(numbers("matrix", std::array<double, 16>{}).data());
    const auto move = numbers("translation", std::array{0.0, 0.0, 0.0}), size = numbers("scale", std::array{1.0, 1.0, 1.0});
    const auto turn = numbers("rotation", std::array{0.0, 0.0, 0.0, 1.0});
    return transformation(Vector3(move.data()), Eigen::Vector4d(turn.data()), Vector3(size.data()));
}

std::vector<std::size_t> children_of(const Json& node) { return node.value("children", std::vector<std::size_t>()); }

/// Of each node, is it no child of another? Every node has one parent at most (§3.5.2).
std::vector<char> roots_of(const GlbDocument& document) {
    std::vector<char> is_root(document.size_of_list("nodes"), 1);
    for (std::size_t node = 0; node < is_root.size(); ++node) {
        for (const std::size_t child : children_of(document.entry("nodes", node))) {
            document.entry("nodes", child);
            if (std::exchange(is_root[child], 0) == 0) document.damaged("node " + std::to_string(child) + " has two parents");
        }
    }
    return is_root;
}

/// visit(node, parent) for these nodes, whose parent is −1, and all below; a parent before its children, which keep their order.
template <class Visit>
void visit_below(const GlbDocument& document, const std::vector<std::size_t>& nodes, const Visit& visit) {
    std::vector<std::pair<std::size_t, long>> left;   // the next at the end
    const auto put = [&](const std::vector<std::size_t>& next, long parent) {
        for (std::size_t i = next.size(); i-- > 0;) left.emplace_back(next[i], parent);
    };
    put(nodes, -1);
    while (!left.empty()) {
        const auto [node, parent] = left.back();
        left.pop_back();
        visit(node, parent);
        put(children_of(document.entry("nodes", node)), static_cast<long>(node));
    }
}

std::vector<std::size_t> numbers_of(const std::vector<char>& is_root) {
    std::vector<std::size_t> nodes;
    for (std::size_t node = 0; node < is_root.size(); ++node)
        if (is_root[node] != 0) nodes.push_back(node);
    return nodes;
}

}   // namespace

std::vector<Eigen::Matrix4d> global_transformations(GlbDocument& document) {
    std::vector<Eigen::Matrix4d> global(document.size_of_list("nodes"));
    std::vector<char> is_placed(global.size(), 0);
    visit_below(document, numbers_of(roots_of(document)), [&](std::size_t node, long parent) {
        is_placed[node] = 1;
        global[node] = matrix_of(document.entry("nodes", node));
        if (parent >= 0) global[node] = global[static_cast<std::size_t>(parent)] * global[node];
    });
    const auto lost = std::ranges::find(is_placed, 0);   // in no tree
    if (lost != is_placed.end()) document.damaged("node " + std::to_string(lost - is_placed.begin()) + " is its own ancestor");
    return global;
}

std::vector<std::size_t> shown_nodes(GlbDocument& document) {
    std::vector<char> is_root = roots_of(document);
    std::vector<std::size_t> roots = numbers_of(is_root), shown;
    if (document.size_of_list("scenes") > 0 || document.json().contains("scene")) {
        roots = document.entry("scenes", document.number(document.json(), "scene", 0)).value("nodes", std::vector<std::size_t>());
        for (const std::size_t root : roots) {
            document.entry("nodes", root);
            if (std::exchange(is_root[root], 0) == 0)
                document.damaged("the scene names node " + std::to_string(root) + " twice, or it has two parents");
        }
    }
    visit_below(document, roots, [&](std::size_t node, long) { shown.push_back(node); });
    return shown;
}

GlbInstances::GlbInstances(GlbDocument& document, const Json& node) {
    const Json extensions = node.value("extensions", Json::object());
    const auto instancing = extensions.find("EXT_mesh_gpu_instancing");
    if (instancing == extensions.end()) return;
    const Json& attributes = instancing->at("attributes");
    std::optional<std::size_t> count;
    const auto take = [&](const char* name, int components, std::optional<GlbAccessor>& into) {
        if (!attributes.contains(name)) return;
        into = document.accessor(attributes, name);
        if (into->components != components || count.value_or(into->count) != into->count)
            document.damaged(std::string(name) + " of instances does not fit");
        count = into->count;
    };
    take("TRANSLATION", 3, translation_);
    take("ROTATION", 4, rotation_);
    take("SCALE", 3, scale_);
    count_ = count.value_or(1);
    document.refuse_too_many(count_);
}

Eigen::Matrix4d GlbInstances::operator()(std::size_t i) const {
    const auto vector = [&](const std::optional<GlbAccessor>& of, auto otherwise) {
        if (of)
            for (int k = 0; k < of->components; ++k) otherwise[k] = (*of)(i, k);
        return otherwise;
    };
    const Vector3 move = vector(translation_, Vector3(0, 0, 0)), size = vector(scale_, Vector3(1, 1, 1));
    return transformation(move, vector(rotation_, Eigen::Vector4d(0, 0, 0, 1)), size);
}

}   // namespace meshfolio
