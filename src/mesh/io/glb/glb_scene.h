/// @file
/// The scene of a glTF file at rest: the places of its nodes (§3.5), instances, joints, and the vertices of its primitives.
#pragma once

#include <vector>

#include "mesh/io/glb/glb_document.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Returns, for each node, the transformation from its own coordinates to the world: the product of those of its ancestors and its own
/// (§3.5.3). @throws InputError if a node has two parents or is its own ancestor (§3.5.2)
std::vector<Eigen::Matrix4d> global_transformations(GlbDocument& document);

/// Returns the nodes of the scene, or all if the file has no scenes (§3.5.1), each before its children.
std::vector<std::size_t> shown_nodes(GlbDocument& document);

/// Returns the transformations from a node's mesh to the node: the identity, or those of EXT_mesh_gpu_instancing.
std::vector<Eigen::Matrix4d> instances_of(GlbDocument& document, const GlbDocument::Json& node);

/// Returns, for each joint of a skin, its global transformation times its inverse bind matrix. @param global  of all nodes
std::vector<Eigen::Matrix4d> joints_of(GlbDocument& document, std::size_t skin, const std::vector<Eigen::Matrix4d>& global);

/// The vertices of a primitive: morphed by weights (§3.7.2.2), then moved by joints (§3.7.3.3).
class GlbShape {
public:
    /// @param weights  of the morph targets; those beyond its end are 0
    /// @param joints   of the node's skin; null: none
    GlbShape(GlbDocument& document, const GlbDocument::Json& primitive, const std::vector<double>& weights,
             const std::vector<Eigen::Matrix4d>* joints, WarningTally& warnings);

    std::size_t vertex_count() const { return base_.count; }
    /// Returns about the number of matrices and vectors from which a vertex is computed.
    std::size_t cost() const { return 1 + targets_.size() + 4 * influences_.size(); }
    /// Returns vertex i, morphed, in homogeneous coordinates of the node or of its skin.
    Eigen::Vector4d vertex(std::size_t i) const;
    /// Returns the transformation of vertex i to the world. @param place  of the node; not used with a skin (§3.7.3.3)
    Eigen::Matrix4d matrix(std::size_t i, const Eigen::Matrix4d& place) const;

private:
    struct Target {
        GlbAccessor moves;
        double weight;
    };
    struct Influence {
        GlbAccessor joints, weights;
    };

    GlbDocument& document_;
    WarningTally& warnings_;
    const std::vector<Eigen::Matrix4d>* joints_;
    GlbAccessor base_;
    std::vector<Target> targets_;
    std::vector<Influence> influences_;
};

}   // namespace meshfolio
