/// @file
/// Where the nodes of a glTF file stand (§3.5), and its instances.
#pragma once

#include <optional>
#include <vector>

#include "mesh/io/glb/glb_document.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio {

/// Of each node, the transformation from its own coordinates to the world: the product of those of its ancestors and its own (§3.5.3).
/// @throws InputError where a node has two parents or is its own ancestor (§3.5.2)
std::vector<Eigen::Matrix4d> global_transformations(GlbDocument& document);

/// The nodes to be shown, each before its children: those of the scene, or all where the file has no scenes (§3.5.1).
std::vector<std::size_t> shown_nodes(GlbDocument& document);

/// The places of a node's mesh within the node: one, or those of EXT_mesh_gpu_instancing.
class GlbInstances {
public:
    GlbInstances(GlbDocument& document, const GlbDocument::Json& node);

    std::size_t count() const { return count_; }
    Eigen::Matrix4d operator()(std::size_t i) const;

private:
    std::optional<GlbAccessor> translation_, rotation_, scale_;
    std::size_t count_ = 1;
};

}   // namespace meshfolio
