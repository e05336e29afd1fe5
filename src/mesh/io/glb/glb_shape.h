/// @file
/// The vertices of a primitive of glTF as they are at rest: morphed by its weights (§3.7.2.2), then moved by its joints (§3.7.3.3).
#pragma once

#include <map>
#include <vector>

#include "mesh/io/glb/glb_document.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Of each skin, its joints' global transformations times their inverse bind matrices; computed once.
class GlbSkins {
public:
    GlbSkins(GlbDocument& document, const std::vector<Eigen::Matrix4d>& global) : document_(document), global_(global) {}

    const std::vector<Eigen::Matrix4d>& joints(std::size_t skin);

private:
    GlbDocument& document_;
    const std::vector<Eigen::Matrix4d>& global_;
    std::map<std::size_t, std::vector<Eigen::Matrix4d>> joints_;
};

class GlbShape {
public:
    /// @param weights  of the morph targets; those beyond its end are 0
    /// @param joints   of the node's skin; null: none
    GlbShape(GlbDocument& document, const GlbDocument::Json& primitive, const std::vector<double>& weights,
             const std::vector<Eigen::Matrix4d>* joints, WarningTally& warnings);

    std::size_t vertex_count() const { return base_.count; }
    /// How many numbers a vertex is computed from, roughly.
    std::size_t cost() const { return 1 + targets_.size() + 4 * influences_.size(); }
    /// Vertex i, morphed, in the coordinates of the node or of its skin (homogeneous).
    Eigen::Vector4d vertex(std::size_t i) const;
    /// What moves it to its place at rest. @param place  from the node to the world; not used with a skin (§3.7.3.3)
    Eigen::Matrix4d matrix(std::size_t i, const Eigen::Matrix4d& place) const;

private:
    struct Target {
        GlbAccessor moves;
        double weight;
    };
    struct Influence {
        GlbAccessor joints, weights;
    };
    void add_influences(const GlbDocument::Json& attributes);

    GlbDocument& document_;
    WarningTally& warnings_;
    const std::vector<Eigen::Matrix4d>* joints_;
    GlbAccessor base_;
    std::vector<Target> targets_;
    std::vector<Influence> influences_;
};

}   // namespace meshfolio
