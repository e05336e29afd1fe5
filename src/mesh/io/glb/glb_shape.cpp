#include "mesh/io/glb/glb_shape.h"

#include <cmath>

#include "base/at.h"

namespace meshfolio {

using Json = GlbDocument::Json;

const std::vector<Eigen::Matrix4d>& GlbSkins::joints(std::size_t skin) {
    const auto [found, is_new] = joints_.try_emplace(skin);
    std::vector<Eigen::Matrix4d>& matrices = found->second;
    if (!is_new) return matrices;
    const Json& json = document_.entry("skins", skin);
    for (const std::size_t node : json.at("joints").get<std::vector<std::size_t>>()) {
        document_.entry("nodes", node);
        matrices.push_back(global_[node]);
    }
    if (!json.contains("inverseBindMatrices")) return matrices;   // identities
    const GlbAccessor inverse = document_.accessor(document_.number(json, "inverseBindMatrices", 0));
    if (inverse.components != 16 || inverse.count < matrices.size()) document_.damaged("inverse bind matrices do not fit the joints");
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
    if (joints_ != nullptr) add_influences(primitive.at("attributes"));
}

/// JOINTS_0 and WEIGHTS_0, then those of 1, 2, … (§3.7.3.1).
void GlbShape::add_influences(const Json& attributes) {
    for (int set = 0; attributes.contains("JOINTS_" + std::to_string(set)); ++set) {
        const std::string number = std::to_string(set);
        influences_.push_back({document_.accessor(attributes, "JOINTS_" + number), document_.accessor(attributes, "WEIGHTS_" + number)});
        GlbAccessor &joints = influences_.back().joints, &weights = influences_.back().weights;
        if (joints.components != 4 || weights.components != 4 || joints.count != base_.count || weights.count != base_.count ||
            !is_integer(joints.type))
            document_.damaged("joints or weights do not fit the positions");
        joints.normalized = false;
        weights.normalized = is_integer(weights.type);
    }
    if (influences_.empty()) document_.damaged("a skinned mesh has no joints");
}

/// Σ w J / Σ w over the joints. A vertex without weights follows its first joint, as three.js has it.
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
