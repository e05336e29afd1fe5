#include "mesh/io/glb/glb_scene.h"

#include <Eigen/Geometry>
#include <set>
#include <utility>

namespace meshfolio {

namespace {

using Json = GlbDocument::Json;

/// Returns T R S (§3.5.3). @param turn  a quaternion x, y, z, w
Eigen::Matrix4d transformation(const Vector3& move, const Eigen::Vector4d& turn, const Vector3& size) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = Eigen::Quaterniond(turn).normalized().toRotationMatrix() * size.asDiagonal();
    matrix.topRightCorner<3, 1>() = move;
    return matrix;
}

/// Returns the transformation from a node to its parent.
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

/// Returns the nodes that are no child of another. Every node has one parent at most (§3.5.2).
std::set<std::size_t> roots_of(const GlbDocument& document) {
    const std::size_t nodes = document.size_of_list("nodes");
    std::set<std::size_t> roots;
    for (std::size_t node = 0; node < nodes; ++node) roots.insert(roots.end(), node);
    for (std::size_t node = 0; node < nodes; ++node) {
        for (const std::size_t child : children_of(document.entry("nodes", node))) {
            document.entry("nodes", child);
            if (roots.erase(child) == 0) document.damaged("node " + std::to_string(child) + " has two parents");
        }
    }
    return roots;
}

/// Calls visit(node, parent) for the roots, with parent −1, and all nodes below: parents before children, which keep their order.
template <class Roots, class Visit> void visit_all(const GlbDocument& document, const Roots& roots, const Visit& visit) {
    std::vector<std::pair<std::size_t, long>> left;   // the next one is the last
    const auto put = [&](const auto& next, long parent) {
        for (auto node = next.rbegin(); node != next.rend(); ++node) left.emplace_back(*node, parent);
    };
    put(roots, -1);
    while (!left.empty()) {
        const auto [node, parent] = left.back();
        left.pop_back();
        visit(node, parent);
        put(children_of(document.entry("nodes", node)), static_cast<long>(node));
    }
}

}   // namespace

std::vector<Eigen::Matrix4d> global_transformations(GlbDocument& document) {
    std::vector<Eigen::Matrix4d> global(document.size_of_list("nodes"));
    std::vector<char> is_placed(global.size(), 0);
    visit_all(document, roots_of(document), [&](std::size_t node, long parent) {
        is_placed[node] = 1;
        global[node] = matrix_of(document.entry("nodes", node));
        if (parent >= 0) global[node] = global[static_cast<std::size_t>(parent)] * global[node];
    });
    const auto lost = std::ranges::find(is_placed, 0);   // in no tree
    if (lost != is_placed.end()) document.damaged("node " + std::to_string(lost - is_placed.begin()) + " is its own ancestor");
    return global;
}

std::vector<std::size_t> shown_nodes(GlbDocument& document) {
    std::set<std::size_t> roots = roots_of(document);
    std::vector<std::size_t> shown;
    const auto show = [&](std::size_t node, long) { shown.push_back(node); };
    if (document.size_of_list("scenes") == 0 && !document.json().contains("scene")) {
        visit_all(document, roots, show);
        return shown;
    }
    const Json& scene = document.entry("scenes", document.number(document.json(), "scene", 0));
    const auto nodes = scene.value("nodes", std::vector<std::size_t>());
    for (const std::size_t node : nodes) {
        document.entry("nodes", node);
        if (roots.erase(node) == 0) document.damaged("the scene names node " + std::to_string(node) + " twice, or it has two parents");
    }
    visit_all(document, nodes, show);
    return shown;
}

std::vector<Eigen::Matrix4d> instances_of(GlbDocument& document, const Json& node) {
    const Json extensions = node.value("extensions", Json::object());
    const auto instancing = extensions.find("EXT_mesh_gpu_instancing");
    if (instancing == extensions.end()) return {Eigen::Matrix4d::Identity()};
    const Json& attributes = instancing->at("attributes");
    std::optional<std::size_t> count;
    const auto accessor = [&](const char* name, int components) {
        std::optional<GlbAccessor> found;
        if (!attributes.contains(name)) return found;
        found = document.accessor(attributes, name);
        if (found->components != components || count.value_or(found->count) != found->count)
            document.damaged(std::string(name) + " of instances does not fit");
        count = found->count;
        return found;
    };
    const auto translation = accessor("TRANSLATION", 3), rotation = accessor("ROTATION", 4), scale = accessor("SCALE", 3);
    document.refuse_too_many(count.value_or(1));
    std::vector<Eigen::Matrix4d> places;
    for (std::size_t i = 0; i < count.value_or(1); ++i) {
        const auto vector = [&](const std::optional<GlbAccessor>& of, auto otherwise) {
            for (int k = 0; of && k < of->components; ++k) otherwise[k] = (*of)(i, k);
            return otherwise;
        };
        places.push_back(transformation(vector(translation, Vector3(0, 0, 0)), vector(rotation, Eigen::Vector4d(0, 0, 0, 1)),
                                        vector(scale, Vector3(1, 1, 1))));
    }
    return places;
}

std::vector<Eigen::Matrix4d> joints_of(GlbDocument& document, std::size_t skin, const std::vector<Eigen::Matrix4d>& global) {
    const Json& json = document.entry("skins", skin);
    std::vector<Eigen::Matrix4d> matrices;
    for (const std::size_t node : json.at("joints").get<std::vector<std::size_t>>()) {
        document.entry("nodes", node);
        matrices.push_back(global[node]);
    }
    if (!json.contains("inverseBindMatrices")) return matrices;   // identities
    const GlbAccessor inverse = document.accessor(document.number(json, "inverseBindMatrices", 0));
    if (inverse.components != 16 || inverse.count < matrices.size()) document.damaged("inverse bind matrices do not fit the joints");
    for (std::size_t joint = 0; joint < matrices.size(); ++joint)
        matrices[joint] *= Eigen::Matrix4d::NullaryExpr(
            [&](Eigen::Index row, Eigen::Index column) { return inverse(joint, static_cast<int>(4 * column + row)); });
    return matrices;
}

GlbShape::GlbShape(GlbDocument& document, const Json& primitive, const std::vector<double>& weights,
                   const std::vector<Eigen::Matrix4d>* joints, WarningTally& warnings)
    : document_(document), warnings_(warnings), joints_(joints), base_(document.accessor(primitive.at("attributes"), "POSITION")) {
    if (base_.components != 3) document.damaged("positions are not VEC3");
    const auto targets = primitive.find("targets");
    document.spend(weights.size());
    for (std::size_t t = 0; targets != primitive.end() && t < std::min(targets->size(), weights.size()); ++t) {
        if (weights[t] == 0 || !targets->at(t).contains("POSITION")) continue;
        targets_.push_back({document.accessor(targets->at(t), "POSITION"), weights[t]});
        if (targets_.back().moves.components != 3 || targets_.back().moves.count != base_.count)
            document.damaged("a morph target does not fit the positions");
    }
    if (joints_ == nullptr) return;
    const Json& attributes = primitive.at("attributes");
    for (int set = 0; attributes.contains("JOINTS_" + std::to_string(set)); ++set) {   // and WEIGHTS_0, then those of 1, 2, … (§3.7.3.1)
        const std::string number = std::to_string(set);
        influences_.push_back({document.accessor(attributes, "JOINTS_" + number), document.accessor(attributes, "WEIGHTS_" + number)});
        GlbAccessor &indices = influences_.back().joints, &shares = influences_.back().weights;
        if (indices.components != 4 || shares.components != 4 || indices.count != base_.count || shares.count != base_.count ||
            !is_integer(indices.type))
            document.damaged("joints or weights do not fit the positions");
        indices.normalized = false;
        shares.normalized = is_integer(shares.type);
    }
    if (influences_.empty()) document.damaged("a skinned mesh has no joints");
}

// Σ w J / Σ w over the joints. A vertex without weights follows its first joint, as in three.js.
Eigen::Matrix4d GlbShape::matrix(std::size_t i, const Eigen::Matrix4d& place) const {
    if (influences_.empty()) return place;
    constexpr double rounded = 0.01;   // four weights in 8 bits
    const auto joint = [&](const Influence& set, int k) -> const Eigen::Matrix4d& {
        const double number = set.joints(i, k);
        if (!(number >= 0 && number < static_cast<double>(joints_->size())))
            document_.damaged("vertex " + std::to_string(i) + ": joint out of range (" + std::to_string(joints_->size()) + " joints)");
        return (*joints_)[static_cast<std::size_t>(number)];
    };
    Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
    double total = 0;
    for (const Influence& set : influences_) {
        for (int k = 0; k < 4; ++k) {
            const double weight = set.weights(i, k);
            if (!(weight >= 0 && std::isfinite(weight)))
                document_.damaged("vertex " + std::to_string(i) + ": a weight is below 0 or no number");
            if (weight == 0) continue;
            sum += weight * joint(set, k);
            total += weight;
        }
    }
    if (std::abs(total - 1) > rounded)
        warnings_.add(0, "vertex whose weights of joints do not sum to 1: they are divided by their sum",
                      "vertices have weights of joints that do not sum to 1: they are divided by their sum");
    return total > 0 ? Eigen::Matrix4d(sum / total) : joint(influences_[0], 0);
}

Eigen::Vector4d GlbShape::vertex(std::size_t i) const {
    Eigen::Vector4d x(base_(i, 0), base_(i, 1), base_(i, 2), 1);
    for (const Target& target : targets_)
        for (int k = 0; k < 3; ++k) x[k] += target.weight * target.moves(i, k);
    return x;
}

}   // namespace meshfolio
