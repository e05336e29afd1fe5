#include "questions/core/mesh_roles.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/errors.h"
#include "embedded_data.h"
#include "mesh/samples/sample_parts.h"
#include "mesh/samples/sample_shapes.h"

namespace meshfolio {

namespace fs = std::filesystem;

namespace {

constexpr std::array<MeshRole, 13> roles{{
    {"plane", "curvatures/plane.obj", "plane.obj"},
    {"lilium", "curvatures/lilium_s.obj", "lily.obj"},
    {"armadillo", "decompose/armadillo.obj", "creature.obj"},
    {"plane_ns", "smoothing/plane_ns.obj", "plane_noisy.obj", [] { return uneven_plane_sample(0); }},
    {"fandisk_ns", "smoothing/fandisk_ns.obj", "fandisk_noisy.obj", [] { return make_sample("fandisk_like"); }},
    {"cube", "", "cube.obj"},
    {"cube8", "", "cube8.obj"},
    {"sphere", "", "sphere.obj"},
    {"ellipsoid", "", "ellipsoid.obj"},
    {"torus", "", "torus.obj"},
    {"bumpy_cube", "", "bumpy_cube.obj"},
    {"saddle", "", "saddle.obj"},
    {"fandisk", "", "fandisk_like.obj"},
}};

}   // namespace

std::span<const MeshRole> mesh_role_list() { return roles; }

const MeshRole& role_named(const std::string& name) {
    const auto it = std::ranges::find_if(roles, [&](const MeshRole& role) { return role.role == name; });
    if (it == roles.end()) throw UsageError("no mesh has the role '" + name + "'", "`meshfolio list` names the roles under meshes");
    return *it;
}

std::optional<std::string_view> bundled_mesh(std::string_view file) {
    for (const auto& entry : meshfolio_embedded::embedded_data())
        if (entry.name == file) return entry.bytes;
    return {};
}

const MeshRole* role_of_path(const std::string& path) {
    const auto stands_for = [&](const MeshRole& role) {
        return path == role.asked || path == role.bundled || path + ".obj" == role.bundled ||
               (!role.asked.empty() && fs::path(path).filename() == fs::path(role.asked).filename());
    };
    const auto it = std::ranges::find_if(roles, stands_for);
    return it == roles.end() ? nullptr : &*it;
}

}   // namespace meshfolio
