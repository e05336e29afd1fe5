#include "questions/core/mesh_library.h"

#include <tbb/task_arena.h>

#include <exception>

#include "base/errors.h"
#include "base/sha256.h"
#include "geometry/measures/closest_point.h"
#include "mesh/decimation.h"
#include "mesh/io/mesh_files.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {

namespace fs = std::filesystem;

namespace {

constexpr int largest_copy = 100000;   // vertices
constexpr int most_measured = 20000;   // vertices whose distance to a copy is taken

}   // namespace

OnceMap::Pointer OnceMap::pointer(const std::string& key, const std::function<Pointer()>& make) {
    std::promise<Pointer> promise;
    std::unique_lock lock(mutex_);
    const auto [entry, is_first] = values_.try_emplace(key);
    if (is_first) entry->second = promise.get_future().share();
    const std::shared_future<Pointer> value = entry->second;
    lock.unlock();
    if (!is_first) return value.get();
    try {
        // Isolated: a loop inside must not take a task that waits for the same key.
        promise.set_value(tbb::this_task_arena::isolate(make));
    } catch (...) {
        lock.lock();
        values_.erase(key);
        lock.unlock();
        promise.set_exception(std::current_exception());
    }
    return value.get();
}

struct MeshLibrary::Shelf {
    std::mutex mutex;
    using Key = std::pair<MeshLookup, fs::path>;   // and the base folder
    std::map<Key, SharedMesh> meshes;
    std::map<Key, std::exception_ptr> unusable;   // a mesh that cannot be had is looked for once, too
    std::mutex copies_mutex;
    std::map<std::pair<SharedMesh, int>, SharedMesh> copies;   // and their vertices at most
    std::mutex digest_mutex;
    std::map<std::string, std::string> digests;   // by path, or the name of a bundled mesh

    /// Holds the lock while decimating: several sections want the same copy, and one mesh at a time is decimated, as the planned memory
    /// says. Isolated, so that a waiting thread takes no task that locks.
    SharedMesh decimated_to(int vertices, const SharedMesh& mesh) {
        if (mesh->mesh().vertex_count() <= vertices) return mesh;
        const std::lock_guard lock(copies_mutex);
        return tbb::this_task_arena::isolate([&] { return copy(vertices, mesh); });
    }

    /// Makes a small copy from the copy ten times as large, so that a large mesh is decimated once.
    SharedMesh copy(int vertices, const SharedMesh& mesh) {
        const TriangleMesh& whole = mesh->mesh();
        if (whole.vertex_count() <= vertices) return mesh;
        SharedMesh& made = copies[{mesh, vertices}];
        if (made) return made;
        const SharedMesh source = vertices < largest_copy ? copy(std::min(10 * vertices, largest_copy), mesh) : mesh;
        LibraryMesh small = *mesh;
        small.derived = std::make_shared<OnceMap>();
        small.is_copy = true;
        small.prepared =
            std::make_shared<const PreparedMesh>(prepare_mesh({small_copy(source->mesh(), vertices), mesh->prepared->file, {}, {}}));
        // The error is printed with two digits, so a sample of the vertices is enough.
        const ClosestPoint surface(small.mesh());
        const int stride = 1 + whole.vertex_count() / most_measured, measured = (whole.vertex_count() - 1) / stride + 1;
        double sum = 0;
        for (int i = 0; i < measured; ++i) sum += surface.squared_distance(whole.X.row(stride * i));
        small.decimation_error = std::sqrt(sum / measured) / bounding_box(whole).diagonal();
        return made = std::make_shared<const LibraryMesh>(std::move(small));
    }

    /// Hashes the bytes of each file once.
    std::string digest(const FoundMesh& where) {
        const std::lock_guard lock(digest_mutex);
        const std::string key = where.path ? "file " + where.path->string() : "bundled " + std::string(where.bundled_file);
        if (const auto it = digests.find(key); it != digests.end()) return it->second;
        std::string from_file;
        return digests[key] = sha256(where.bytes(from_file));
    }
};

MeshLibrary::MeshLibrary(std::vector<fs::path> data_folders, std::vector<fs::path> own_meshes, const std::vector<fs::path>& listed,
                         std::shared_ptr<OnceMap> values)
    : finder_(std::move(data_folders), std::move(own_meshes), listed), shelf_(std::make_shared<Shelf>()), values_(std::move(values)) {}

SharedMesh MeshLibrary::loaded(const MeshLookup& lookup, const fs::path& base) const {
    const auto mesh = whole(lookup, base);
    return most_vertices_ > 0 ? shelf_->decimated_to(most_vertices_, mesh) : mesh;
}

SharedMesh MeshLibrary::whole(const MeshLookup& lookup, const fs::path& base) const {
    // Held while reading: a mesh that two questions want is read once. Isolated as in decimated_to().
    const std::lock_guard lock(shelf_->mutex);
    const Shelf::Key key(lookup, base);
    if (const auto it = shelf_->meshes.find(key); it != shelf_->meshes.end()) return it->second;
    if (const auto it = shelf_->unusable.find(key); it != shelf_->unusable.end()) std::rethrow_exception(it->second);
    try {
        return shelf_->meshes[key] = tbb::this_task_arena::isolate([&] { return read(lookup, base); });
    } catch (const Error&) {
        shelf_->unusable[key] = std::current_exception();
        throw;
    }
}

SharedMesh MeshLibrary::read(const MeshLookup& lookup, const fs::path& base) const {
    const FoundMesh where = finder_.found(lookup, base);
    std::string from_file;
    const std::string_view bytes = where.bytes(from_file);
    auto mesh = std::make_shared<LibraryMesh>();
    // The ending of the file decides the format; the label may be a role's path.
    mesh->prepared = std::make_shared<const PreparedMesh>(prepare_mesh(parse_mesh(bytes, where.label)));
    mesh->input = where.input;
    mesh->input.sha256 = sha256(bytes);
    mesh->input.vertices = mesh->prepared->mesh.vertex_count();
    mesh->input.triangles = mesh->prepared->mesh.face_count();
    mesh->name = where.name;
    return mesh;
}

SharedMesh MeshLibrary::role(const std::string& name) const {
    if (!finder_.own().empty()) return own_meshes().front();
    if (offered_ && std::ranges::find(*offered_, name) == offered_->end())
        throw std::logic_error("the chapter reads the role '" + name + "', which is missing in Chapter::roles");
    return loaded({.by = MeshLookup::By::role, .name = name}, {});
}

SharedMesh MeshLibrary::file(const fs::path& path, const fs::path& base) const {
    return loaded({.by = MeshLookup::By::file, .path = path}, base);
}

LibraryMeshes MeshLibrary::own_meshes() const {
    LibraryMeshes meshes;
    for (const fs::path& path : finder_.own()) meshes.push_back(loaded({.by = MeshLookup::By::own, .path = path}, {}));
    return meshes;
}

void MeshLibrary::open_own_meshes() const {
    for (const fs::path& path : finder_.own()) {
        try {
            loaded({.by = MeshLookup::By::own, .path = path}, {});
        } catch (const Error& error) {
            throw renamed(error, path.filename().string(), path.string());
        }
    }
}

MeshLibrary MeshLibrary::limited_to(int vertices) const {
    MeshLibrary library = *this;
    library.most_vertices_ = vertices;
    return library;
}

MeshLibrary MeshLibrary::offering(std::vector<std::string_view> roles) const {
    MeshLibrary library = *this;
    library.offered_ = std::move(roles);
    return library;
}

std::optional<report::Input> MeshLibrary::input_of(const MeshLookup& lookup, const fs::path& base) const try {
    FoundMesh where = finder_.found(lookup, base);
    where.input.sha256 = shelf_->digest(where);
    return std::move(where.input);
} catch (const Error&) {
    return {};
}

std::string MeshLibrary::identity_of(const MeshLookup& lookup, const fs::path& base) const try {
    const FoundMesh where = finder_.found(lookup, base);
    const report::Input& input = where.input;
    std::string words;
    for (const std::string& word : {where.name, where.label, input.role, input.asked, input.file, std::string(where.bundled_file)})
        words += std::to_string(word.size()) + ":" + word;
    words += input.stand_in ? "stand-in " : "itself ";
    return words + shelf_->digest(where);
} catch (const Error& error) {
    return std::string("error ") + error.what();
}

}   // namespace meshfolio
