#include "questions/core/mesh_finder.h"

#include <algorithm>
#include <set>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/lower_case.h"
#include "base/sha256.h"
#include "mesh/io/mesh_files.h"
#include "questions/core/mesh_roles.h"

namespace meshfolio {

namespace fs = std::filesystem;

namespace {

/// Returns true for a path that exists and is no folder.
bool is_no_folder(const fs::path& path) {
    std::error_code unknown;
    return may_be_there(path) && !fs::is_directory(path, unknown);
}

std::optional<fs::path> first_that_exists(const std::vector<fs::path>& candidates) {
    const auto it = std::ranges::find_if(candidates, is_no_folder);
    return it == candidates.end() ? std::nullopt : std::optional(*it);
}

/// Returns the entry of a file in the report, before it is read.
report::Input input_of(std::string_view role, std::string_view asked, const fs::path& file, bool stand_in = false) {
    return {std::string(role), std::string(asked), file.filename().string(), stand_in, "", 0, 0};
}

/// Returns `path` in the first folder that has it, by the path itself or by the bare file name.
std::optional<fs::path> in_folders(const std::vector<fs::path>& folders, const fs::path& path) {
    std::vector<fs::path> candidates;
    for (const fs::path& folder : folders) {
        candidates.push_back(folder / path);
        candidates.push_back(folder / path.filename());
    }
    return first_that_exists(candidates);
}

}   // namespace

std::string short_name(const fs::path& path) {
    std::string name;
    for (const char c : lower_case(mesh_name(path.string()))) {
        const bool good = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        if (good) name += c;
        if (!good && !name.empty() && name.back() != '_') name += '_';
    }
    name.resize(std::min<std::size_t>(name.size(), 40));
    while (name.ends_with('_')) name.pop_back();
    return name.empty() ? "mesh" : name;
}

MeshFinder::MeshFinder(std::vector<fs::path> data_folders, std::vector<fs::path> own_meshes, const std::vector<fs::path>& listed)
    : folders_(std::move(data_folders)), own_(std::move(own_meshes)) {
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

std::string MeshFinder::name_of(const fs::path& path) const {
    const auto it = names_.find(path.string());
    return it == names_.end() ? short_name(path) : it->second;
}

FoundMesh MeshFinder::found_role(const MeshRole& role) const {
    const auto path = role.asked.empty() ? std::nullopt : in_folders(folders_, role.asked);
    const fs::path file = path.value_or(role.bundled);
    const std::string label = path ? std::string(role.asked) : file.filename().string();
    return {path, role.bundled, label, short_name(file), input_of(role.role, role.asked, file, !path && !role.asked.empty())};
}

FoundMesh MeshFinder::found_file(const fs::path& path, const fs::path& base) const {
    const std::string name = name_of(path);
    const MeshRole* role = role_of_path(path.string());
    const bool is_beside = is_no_folder(base / path) || (role == nullptr && may_be_there(base / path));   // reading a folder reports it
    const auto file = is_beside ? base / path : in_folders(folders_, path);
    if (file) return {file, {}, path.string(), name, input_of(name, "", path)};
    if (role == nullptr)
        throw InputError({path.string()}, "no such mesh beside the settings file, in the data folders or among the bundled meshes",
                         "`meshfolio list` names the bundled ones");
    const bool stand_in = path.filename() != role->bundled && path.string() + ".obj" != role->bundled;
    return {{}, role->bundled, std::string(role->bundled), name, input_of(name, stand_in ? path.string() : "", role->bundled, stand_in)};
}

FoundMesh MeshFinder::found_own(const fs::path& path) const {
    return {path, {}, path.filename().string(), name_of(path), input_of(name_of(path), "", path)};
}

FoundMesh MeshFinder::found(const MeshLookup& lookup, const fs::path& base) const {
    switch (lookup.by) {
        case MeshLookup::By::role: return found_role(role_named(lookup.name));
        case MeshLookup::By::file: return found_file(lookup.path, base);
        default: return found_own(lookup.path);
    }
}

InputError renamed(const Error& error, const std::string& before, const std::string& after) {
    const std::string message = error.what(), where = printable(before);
    return InputError({}, message.starts_with(where) ? after + message.substr(where.size()) : message);
}

std::string_view FoundMesh::bytes(std::string& from_file) const {
    if (path) {
        try {
            return from_file = read_file(*path);
        } catch (const InputError& error) {   // not where the machine keeps it: messages end up in the report
            throw renamed(error, path->string(), label);
        }
    }
    if (const auto embedded = bundled_mesh(bundled_file)) return *embedded;
    throw InputError({std::string(bundled_file)}, "is not among the bundled meshes of this build", "`meshfolio list` names them");
}

}   // namespace meshfolio
