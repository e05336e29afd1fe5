/// @file
/// The meshes of the assignment, and the bundled files that stand for them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace meshfolio {

struct TriangleMesh;

struct MeshRole {
    std::string_view role;               // "armadillo"
    std::string_view asked;              // "decompose/armadillo.obj"; empty: not of the assignment
    std::string_view bundled;            // "creature.obj" in data/
    TriangleMesh (*clean)() = nullptr;   // makes a noisy bundled mesh without its noise, vertex by vertex; null: it has no noise
};
/// Returns all roles, the five of the assignment first.
std::span<const MeshRole> mesh_role_list();

/// Returns the role of this name. @throws UsageError if there is none
const MeshRole& role_named(const std::string& name);
/// Returns the role that a path stands for: the assignment's path or file name, a bundled file, or its stem such as "torus"; null: none.
const MeshRole* role_of_path(const std::string& path);

/// Returns the bytes of a file of data/ as compiled into the program; nothing if there is none.
std::optional<std::string_view> bundled_mesh(std::string_view file);

}   // namespace meshfolio
