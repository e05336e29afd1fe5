#include "questions/core/mesh_library.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <set>

#include "base/errors.h"
#include "base/file_bytes.h"
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

constexpr const char* own_role = "your mesh";

std::optional<fs::path> first_that_exists(const std::vector<fs::path>& candidates) {
    const auto it = std::ranges::find_if(candidates, may_be_there);
    return it == candidates.end() ? std::nullopt : std::optional(*it);
}

/// How the report enters a file, before it is read.
report::Input input_of(std::string_view role, std::string_view asked, const fs::path& file, bool stand_in = false) {
    return {std::string(role), std::string(asked), file.filename().string(), stand_in, "", 0, 0};
}

/// `path` in the first of `folders` that has it, by the path itself or by the bare file name.
std::optional<fs::path> in_folders(const std::vector<fs::path>& folders, const fs::path& path) {
    std::vector<fs::path> candidates;
    for (const fs::path& folder : folders) {
        candidates.push_back(folder / path);
        candidates.push_back(folder / path.filename());
    }
    return first_that_exists(candidates);
}

/// The same message about a file that goes by another name.
InputError renamed(const Error& error, const std::string& before, const std::string& after) {
    const std::string message = error.what(), where = printable(before);
    return InputError({}, message.starts_with(where) ? after + message.substr(where.size()) : message);
}

/// Messages name the file as it was asked for, not where the machine keeps it: they end up in the report.
std::string bytes_of(const fs::path& path, const std::string& label) try { return read_file(path); } catch (const InputError& error) {
    throw renamed(error, path.string(), label);
}

/// Reads the file if there is one, else the bundled mesh; `from_file` keeps what was read.
std::string_view bytes_of(const std::optional<fs::path>& path, std::string_view bundled_file, const std::string& label,
                          std::string& from_file) {
    if (path) return from_file = bytes_of(*path, label);
    if (const auto embedded = bundled_mesh(bundled_file)) return *embedded;
    throw InputError({std::string(bundled_file)}, "is not among the bundled meshes of this build");
}

}   // namespace

std::string short_name(const fs::path& path) {
    std::string name;
    for (const char c : mesh_name(path.string())) {
        const char lower = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        const bool good = (lower >= 'a' && lower <= 'z') || (lower >= '0' && lower <= '9');
        if (good) name += lower;
        if (!good && !name.empty() && name.back() != '_') name += '_';
    }
    name.resize(std::min<std::size_t>(name.size(), 40));
    while (name.ends_with('_')) name.pop_back();
    return name.empty() ? "mesh" : name;
}

/// Where a mesh comes from, before it is read.
struct MeshLibrary::Found {
    std::optional<fs::path> path;   // of a file; none: `bundled_file`
    std::string_view bundled_file;
    std::string label;   // as messages call it
    std::string name;
    report::Input input;
};

struct MeshLibrary::Shelf {
    std::mutex mutex;
    using Key = std::pair<MeshLookup, fs::path>;   // and the base folder
    std::map<Key, SharedMesh> meshes;
    std::map<Key, std::exception_ptr> unusable;   // a mesh that cannot be had is looked for once, too
    std::mutex copies_mutex;
    std::map<std::pair<SharedMesh, int>, SharedMesh> copies;   // and their vertices at most
    std::mutex digest_mutex;
    std::map<std::string, std::string> digests;   // by path, or the name of a bundled mesh

    /// Holds the lock while decimating, for several sections want the same copy. Isolated, so that a waiting thread takes no task that
    /// locks.
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
        small.is_copy = true;
        small.prepared =
            std::make_shared<const PreparedMesh>(prepare_mesh({decimated(source->mesh(), vertices), mesh->prepared->file, {}, {}}));
        // The error is printed with two digits, so a sample of the vertices is enough.
        const ClosestPoint surface(small.mesh());
        const int stride = 1 + whole.vertex_count() / most_measured, measured = (whole.vertex_count() - 1) / stride + 1;
        double sum = 0;
        for (int i = 0; i < measured; ++i) sum += surface.squared_distance(whole.X.row(stride * i));
        small.decimation_error = std::sqrt(sum / measured) / bounding_box(whole).diagonal();
        return made = std::make_shared<const LibraryMesh>(std::move(small));
    }

    /// Hashes the bytes of each file once.
    std::string digest(const Found& where) {
        const std::lock_guard lock(digest_mutex);
        const std::string key = where.path ? "file " + where.path->string() : "bundled " + std::string(where.bundled_file);
        if (const auto it = digests.find(key); it != digests.end()) return it->second;
        std::string from_file;
        return digests[key] = sha256(bytes_of(where.path, where.bundled_file, where.label, from_file));
    }
};

MeshLibrary::MeshLibrary(std::vector<fs::path> data_folders, std::vector<fs::path> own_meshes, const std::vector<fs::path>& listed)
    : folders_(std::move(data_folders)), own_(std::move(own_meshes)), shelf_(std::make_shared<Shelf>()) {
    for (const fs::path& folder : folders_) {
        std::error_code error;
        if (fs::is_directory(folder, error)) continue;
        const std::string meant = near_names(folder);
        throw InputError({folder.string()}, "is not a folder of meshes", meant.empty() ? "correct --data" : meant);
    }
    std::set<std::string> taken;
    for (const std::vector<fs::path>& paths : {own_, listed})
        for (const fs::path& path : paths) {
            if (names_.contains(path.string())) continue;
            std::string name = short_name(path);
            for (int number = 2; !taken.insert(name).second; ++number) name = short_name(path) + "_" + std::to_string(number);
            names_[path.string()] = name;
        }
}

std::string MeshLibrary::name_of(const fs::path& path) const {
    const auto it = names_.find(path.string());
    return it == names_.end() ? short_name(path) : it->second;
}

MeshLibrary::Found MeshLibrary::found_role(const MeshRole& role) const {
    const auto path = role.asked.empty() ? std::nullopt : in_folders(folders_, role.asked);
    const fs::path file = path.value_or(role.bundled);
    const std::string label = path ? std::string(role.asked) : file.filename().string();
    return {path, role.bundled, label, short_name(file), input_of(role.role, role.asked, file, !path && !role.asked.empty())};
}

MeshLibrary::Found MeshLibrary::found_file(const fs::path& path, const fs::path& base) const {
    const std::string name = name_of(path);
    const auto file = may_be_there(base / path) ? base / path : in_folders(folders_, path);
    if (file) return {file, {}, path.string(), name, input_of(name, "", path)};
    const MeshRole* role = role_of_path(path.string());
    if (role == nullptr)
        throw InputError({path.string()}, "no such mesh beside the settings file, in the data folders or among the bundled meshes",
                         "`meshfolio list` names the bundled ones");
    const bool stand_in = path.filename() != role->bundled && path.string() + ".obj" != role->bundled;
    return {{}, role->bundled, std::string(role->bundled), name, input_of(name, stand_in ? path.string() : "", role->bundled, stand_in)};
}

MeshLibrary::Found MeshLibrary::found_original(const MeshLookup& lookup, const fs::path& base) const {
    std::vector<fs::path> candidates;
    if (!lookup.path.empty()) {
        candidates.push_back(base / lookup.path);
        for (const fs::path& folder : folders_) candidates.push_back(folder / lookup.path);
        for (const fs::path& folder : folders_) candidates.push_back(folder / lookup.path.filename());
    }
    const auto path = first_that_exists(candidates);
    const std::string file = path ? path->filename().string() : lookup.stand_in;
    const std::string asked = lookup.path.empty() ? lookup.name : lookup.path.generic_string();
    return {path, lookup.stand_in, file, short_name(file), input_of(lookup.name, asked, file, !path)};
}

std::optional<MeshLibrary::Found> MeshLibrary::found_in_data(const fs::path& file) const {
    const auto path = in_folders(folders_, file);
    if (!path) return {};
    const std::string name = name_of(file);
    return Found{path, {}, file.string(), name, input_of(name, file.string(), file)};
}

MeshLibrary::Found MeshLibrary::found_own(const fs::path& path) const {
    return {path, {}, path.filename().string(), name_of(path), input_of(own_role, "", path)};
}

std::optional<MeshLibrary::Found> MeshLibrary::found(const MeshLookup& lookup, const fs::path& base) const {
    switch (lookup.by) {
        case MeshLookup::By::role:
            return found_role(role_named(lookup.name));
        case MeshLookup::By::file:
            return found_file(lookup.path, base);
        case MeshLookup::By::original:
            return found_original(lookup, base);
        case MeshLookup::By::in_data:
            return found_in_data(lookup.path);
        default:
            return found_own(lookup.path);
    }
}

SharedMesh MeshLibrary::loaded(const MeshLookup& lookup, const fs::path& base) const {
    const auto mesh = whole(lookup, base);
    return mesh && most_vertices_ > 0 ? shelf_->decimated_to(most_vertices_, mesh) : mesh;
}

SharedMesh MeshLibrary::whole(const MeshLookup& lookup, const fs::path& base) const {
    note(lookup);
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
    const std::optional<Found> where = found(lookup, base);
    if (!where) return nullptr;
    std::string from_file;
    const std::string_view bytes = bytes_of(where->path, where->bundled_file, where->label, from_file);
    auto mesh = std::make_shared<LibraryMesh>();
    // The ending of the file decides the format; the label may be a role's path.
    mesh->prepared = std::make_shared<const PreparedMesh>(prepare_mesh(parse_mesh(bytes, where->label)));
    mesh->input = where->input;
    mesh->input.sha256 = sha256(bytes);
    mesh->input.vertices = mesh->prepared->mesh.vertex_count();
    mesh->input.triangles = mesh->prepared->mesh.face_count();
    mesh->name = where->name;
    return mesh;
}

SharedMesh MeshLibrary::role(const std::string& name) const {
    if (!own_.empty()) return own_meshes().front();
    return loaded({.by = MeshLookup::By::role, .name = name}, {});
}

SharedMesh MeshLibrary::file(const fs::path& path, const fs::path& base) const {
    return loaded({.by = MeshLookup::By::file, .path = path}, base);
}

SharedMesh MeshLibrary::original(const std::string& name, const fs::path& path, const std::string& stand_in, const fs::path& base) const {
    if (!own_.empty()) return own_meshes().front();
    return loaded({.by = MeshLookup::By::original, .name = name, .path = path, .stand_in = stand_in}, base);
}

SharedMesh MeshLibrary::in_data(const fs::path& file) const { return loaded({.by = MeshLookup::By::in_data, .path = file}, {}); }

bool MeshLibrary::has_own_meshes() const {
    note({.by = MeshLookup::By::own});   // whoever asks depends on the answer
    return !own_.empty();
}

LibraryMeshes MeshLibrary::own_meshes() const {
    LibraryMeshes meshes;
    for (const fs::path& path : own_) meshes.push_back(loaded({.by = MeshLookup::By::own, .path = path}, {}));
    return meshes;
}

void MeshLibrary::open_own_meshes() const {
    for (const fs::path& path : own_) {
        try {
            loaded({.by = MeshLookup::By::own, .path = path}, {});
        } catch (const Error& error) {
            throw renamed(error, found_own(path).label, path.string());
        }
    }
}

bool MeshLibrary::still_has(const report::Input& input, const fs::path& base) const {
    if (own_.empty() == (input.role == own_role)) return false;
    const bool is_asked = !input.asked.empty();
    if (input.stand_in && is_asked && (in_folders(folders_, input.asked) || may_be_there(base / input.asked))) return false;
    std::vector<fs::path> names{input.file}, candidates;
    if (is_asked) names.emplace_back(input.asked);
    for (const MeshRole& role : mesh_role_list())
        if (!role.asked.empty() && fs::path(role.asked).filename() == input.file) names.emplace_back(role.asked);
    for (const auto& [path, name] : names_)   // the user's own, those of the settings
        if (fs::path(path).filename() == input.file) names.emplace_back(path);
    for (const fs::path& name : names) {
        candidates.push_back(own_.empty() ? base / name : name);
        for (const fs::path& folder : folders_) candidates.push_back(folder / name);
    }
    const auto is_it = [&](const fs::path& path) {
        std::error_code error;
        return fs::is_regular_file(path, error) && sha256_of_file(path) == input.sha256;
    };
    const auto embedded = bundled_mesh(input.file);
    return (own_.empty() && embedded && sha256(*embedded) == input.sha256) || std::ranges::any_of(candidates, is_it);
}

// ---- what a question looked up --------------------------------------------------------------------------------------------

void LookupRecord::add(const MeshLookup& lookup) {
    const std::lock_guard lock(mutex_);
    lookups_.insert(lookup);
}

std::vector<MeshLookup> LookupRecord::lookups() const {
    const std::lock_guard lock(mutex_);
    return {lookups_.begin(), lookups_.end()};
}

MeshLibrary MeshLibrary::limited_to(int vertices) const {
    MeshLibrary library = *this;
    library.most_vertices_ = vertices;
    return library;
}

MeshLibrary MeshLibrary::recorded_in(LookupRecord& record) const {
    MeshLibrary library = *this;
    library.record_ = &record;
    return library;
}

void MeshLibrary::note(const MeshLookup& lookup) const {
    if (record_ != nullptr) record_->add(lookup);
}

std::string MeshLibrary::identity_of(const MeshLookup& lookup, const fs::path& base) const try {
    const std::optional<Found> where = found(lookup, base);
    if (!where) return "none";
    const report::Input& input = where->input;
    std::string words;
    for (const std::string& word : {where->name, where->label, input.role, input.asked, input.file, std::string(where->bundled_file)})
        words += std::to_string(word.size()) + ":" + word;
    words += input.stand_in ? "stand-in " : "itself ";
    return words + shelf_->digest(*where);
} catch (const Error& error) {
    return std::string("error ") + error.what();
}

}   // namespace meshfolio
