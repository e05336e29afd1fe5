/// @file
/// Which file stands for which mesh of the assignment.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh_checks.h"
#include "report/document.h"

namespace meshfolio {

/// A mesh the questions ask for by its role.
struct MeshRole {
    std::string_view role;      // "armadillo"
    std::string_view asked;     // "decompose/armadillo.obj"; empty: not of the assignment
    std::string_view bundled;   // "creature.ply" in data/
};
std::span<const MeshRole> mesh_role_list();

struct LibraryMesh {
    report::Input input;
    std::string name;   // short, for ids and file names: [a-z0-9_]
    std::shared_ptr<const PreparedMesh> prepared;
    const TriangleMesh& mesh() const { return prepared->mesh; }
};

/// Looks a role up in the user's own meshes, then the data folders by the assignment's path, then the bundled meshes
/// compiled into the program. Each file is read and prepared once; thread-safe.
class MeshLibrary {
public:
    MeshLibrary(std::vector<std::filesystem::path> data_folders, std::vector<std::filesystem::path> own_meshes);

    /// @throws InputError if the file is missing or unusable; UsageError for an unknown role
    std::shared_ptr<const LibraryMesh> role(const std::string& role) const;
    /// A mesh named in the settings: relative to `base`, then the data folders, then the bundled data.
    std::shared_ptr<const LibraryMesh> file(const std::filesystem::path& path, const std::filesystem::path& base) const;

    bool has_own_meshes() const { return !own_.empty(); }
    /// The user's own meshes (`report MY.obj …`), which replace every list of roles.
    std::vector<std::shared_ptr<const LibraryMesh>> own_meshes() const;

private:
    std::vector<std::filesystem::path> folders_, own_;
    mutable std::mutex mutex_;
    mutable std::map<std::string, std::shared_ptr<const LibraryMesh>> cache_;
    std::shared_ptr<const LibraryMesh> load(const std::string& key, const std::filesystem::path& path, report::Input input) const;
};

}   // namespace meshfolio
