/// @file
/// The meshes of a report, each read once, and values that several chapters need, each made once.
#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeinfo>
#include <vector>

#include "mesh/mesh_checks.h"
#include "questions/core/mesh_finder.h"

namespace meshfolio {

/// Values of any type by key. Thread-safe.
class OnceMap {
public:
    /// Returns the value of `key`, which lives as long as the map. The first caller makes it; others wait for this key alone.
    /// @throws what `make` throws, in all callers that waited for it; the next caller makes the value again
    const auto& value(const std::string& key, const auto& make) {
        using Value = const std::remove_cvref_t<decltype(make())>;
        return *static_cast<Value*>(pointer(key + "\n" + typeid(Value).name(), [&] { return std::make_shared<Value>(make()); }).get());
    }

private:
    using Pointer = std::shared_ptr<const void>;
    std::mutex mutex_;
    std::map<std::string, std::shared_future<Pointer>> values_;

    Pointer pointer(const std::string& key, const std::function<Pointer()>& make);
};

struct LibraryMesh {
    report::Input input;
    std::string name;   // short, for ids and file names: [a-z0-9_]
    std::shared_ptr<const PreparedMesh> prepared;
    bool is_copy = false;          // decimated
    double decimation_error = 0;   // rms distance of the file's vertices to the copy, over the box diagonal
    std::shared_ptr<OnceMap> derived = std::make_shared<OnceMap>();   // what several chapters compute from this mesh
    const TriangleMesh& mesh() const { return prepared->mesh; }
    const MeshTopology& topology() const { return prepared->topology; }
    const Preflight& preflight() const { return prepared->preflight; }
};

using SharedMesh = std::shared_ptr<const LibraryMesh>;
using LibraryMeshes = std::vector<SharedMesh>;

/// The base of studies that measure one mesh of the library.
struct OnMesh {
    SharedMesh source = {};
    const std::string& name() const { return source->name; }
    const TriangleMesh& mesh() const { return source->mesh(); }
    const MeshTopology& topology() const { return source->topology(); }
    const Preflight& preflight() const { return source->preflight(); }
};

/// Finds roles among the user's own meshes, then in the data folders by the assignment's path, then among the bundled meshes. Each file is
/// read and prepared once. Thread-safe.
class MeshLibrary {
public:
    /// Reads no mesh yet. @param listed  paths that file() will be asked for: files with the same stem get distinct names, in this order
    /// @param values  of once(), to share them with other libraries
    MeshLibrary(std::vector<std::filesystem::path> data_folders, std::vector<std::filesystem::path> own_meshes,
                const std::vector<std::filesystem::path>& listed = {}, std::shared_ptr<OnceMap> values = std::make_shared<OnceMap>());

    /// Returns the mesh of a role; if the user has own meshes, the first of them. @throws InputError if the file is unusable; UsageError
    /// for an unknown role; std::logic_error for a role that offering() leaves out
    SharedMesh role(const std::string& role) const;
    /// Returns a mesh that the settings name, looked for relative to `base`, then in the data folders, then among the bundled meshes.
    /// @throws InputError if it is nowhere or unusable
    SharedMesh file(const std::filesystem::path& path, const std::filesystem::path& base) const;

    bool has_own_meshes() const { return !finder_.own().empty(); }
    /// Returns the user's own meshes (`report MY.obj …`), which replace every list of roles. @throws InputError, MeshError
    LibraryMeshes own_meshes() const;
    /// Reads the user's own meshes before any work begins. @throws InputError that names the first unusable mesh by its path
    void open_own_meshes() const;

    /// Returns a view of this library that hands out decimated copies (mesh/decimation.h) of meshes with more than this number of vertices,
    /// each made once. @param vertices  0: no limit
    MeshLibrary limited_to(int vertices) const;
    /// Returns a view of this library in which role() throws for all other roles, so that a chapter reads only the meshes that its answer
    /// is stored under.
    MeshLibrary offering(std::vector<std::string_view> roles) const;
    /// Returns the value of `key`; the first caller makes it by make(), for this library and all copies of it. See OnceMap.
    const auto& once(const std::string& key, const auto& make) const { return values_->value(key, make); }
    /// Returns the input that a lookup finds now, without the counts of the mesh; nothing if the mesh cannot be had.
    std::optional<report::Input> input_of(const MeshLookup& lookup, const std::filesystem::path& base) const;
    /// Returns a text that is equal for equal meshes alone: names, role and SHA-256 of the bytes; else the error why it cannot be read. The
    /// mesh is not prepared.
    std::string identity_of(const MeshLookup& lookup, const std::filesystem::path& base) const;

private:
    struct Shelf;   // what has been read, shared by copies
    MeshFinder finder_;
    std::shared_ptr<Shelf> shelf_;
    int most_vertices_ = 0;                                  // 0: any number
    std::optional<std::vector<std::string_view>> offered_;   // roles; none: all
    std::shared_ptr<OnceMap> values_;                        // shared by copies

    SharedMesh loaded(const MeshLookup& lookup, const std::filesystem::path& base) const;
    SharedMesh whole(const MeshLookup& lookup, const std::filesystem::path& base) const;
    SharedMesh read(const MeshLookup& lookup, const std::filesystem::path& base) const;
};

}   // namespace meshfolio
