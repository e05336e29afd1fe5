/// @file
/// The meshes of a report, each read once.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "mesh/mesh_checks.h"
#include "questions/core/mesh_finder.h"

namespace meshfolio {

struct LibraryMesh {
    report::Input input;
    std::string name;   // short, for ids and file names: [a-z0-9_]
    std::shared_ptr<const PreparedMesh> prepared;
    bool is_copy = false;          // decimated
    double decimation_error = 0;   // rms distance of the file's vertices to the copy, over the box diagonal
    const TriangleMesh& mesh() const { return prepared->mesh; }
    const MeshTopology& topology() const { return prepared->topology; }
    const Preflight& preflight() const { return prepared->preflight; }
};

using SharedMesh = std::shared_ptr<const LibraryMesh>;
using LibraryMeshes = std::vector<SharedMesh>;

/// What is measured on one mesh of the library.
struct OnMesh {
    SharedMesh source = {};
    const std::string& name() const { return source->name; }
    const TriangleMesh& mesh() const { return source->mesh(); }
    const MeshTopology& topology() const { return source->topology(); }
    const Preflight& preflight() const { return source->preflight(); }
};

/// Everything a question looked up, each once; thread-safe.
class LookupRecord {
public:
    void add(const MeshLookup& lookup);
    std::vector<MeshLookup> lookups() const;   // sorted

private:
    mutable std::mutex mutex_;
    std::set<MeshLookup> lookups_;
};

/// Looks a role up in the user's own meshes, then the data folders by the assignment's path, then the bundled meshes
/// compiled into the program. Each file is read and prepared once; thread-safe.
class MeshLibrary {
public:
    /// @param listed  the paths later asked for by file(), so that those with the same stem get names of their own in a fixed order
    MeshLibrary(std::vector<std::filesystem::path> data_folders, std::vector<std::filesystem::path> own_meshes,
                const std::vector<std::filesystem::path>& listed = {});

    /// @throws InputError if the file is missing or unusable; UsageError for an unknown role
    SharedMesh role(const std::string& role) const;
    /// A mesh named in the settings: relative to `base`, then the data folders, then the bundled data.
    SharedMesh file(const std::filesystem::path& path, const std::filesystem::path& base) const;

    /// A mesh of an earlier report, with the bundled one that stands in for it: `path` relative to `base`, then by its whole path in any
    /// data folder, then by its bare name. An empty path is that of a mesh not to be had. The user's own mesh takes its place, too.
    SharedMesh original(const std::string& name, const std::filesystem::path& path, const std::string& stand_in,
                        const std::filesystem::path& base) const;
    /// A mesh that only a data folder may have, by its file name; null where none has it.
    SharedMesh in_data(const std::filesystem::path& file) const;

    bool has_own_meshes() const;
    /// The user's own meshes (`report MY.obj …`), which replace every list of roles. @throws InputError, MeshError
    LibraryMeshes own_meshes() const;
    /// Reads them, before any work begins. @throws InputError naming the first that cannot be used by its path
    void open_own_meshes() const;

    /// Does what an earlier report read still stand where this run would find it? @param base  folder of the settings file
    bool still_has(const report::Input& input, const std::filesystem::path& base) const { return finder_.still_has(input, base); }

    /// The same library with the same meshes, which enters into `record` what it is asked for from now on. `record` must outlive it.
    MeshLibrary recorded_in(LookupRecord& record) const;
    /// The same library, which hands out copies of at most so many vertices (mesh/decimation.h) of larger meshes, each made once; 0: the
    /// meshes themselves.
    MeshLibrary limited_to(int vertices) const;
    /// Everything that the answer to a lookup depends on, without preparing the mesh: what it is called and the SHA-256 of its bytes, or
    /// why it cannot be had. Equal words, equal mesh.
    std::string identity_of(const MeshLookup& lookup, const std::filesystem::path& base) const;

private:
    struct Shelf;   // what has been read, shared by copies
    MeshFinder finder_;
    std::shared_ptr<Shelf> shelf_;
    LookupRecord* record_ = nullptr;
    int most_vertices_ = 0;   // 0: any number

    void note(const MeshLookup& lookup) const;
    SharedMesh loaded(const MeshLookup& lookup, const std::filesystem::path& base) const;
    SharedMesh whole(const MeshLookup& lookup, const std::filesystem::path& base) const;
    SharedMesh read(const MeshLookup& lookup, const std::filesystem::path& base) const;
};

}   // namespace meshfolio
