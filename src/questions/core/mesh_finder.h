/// @file
/// Where a mesh that is asked for comes from: the user's own, the data folders, the bundled ones.
#pragma once

#include <compare>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/errors.h"
#include "questions/core/mesh_roles.h"
#include "report/document.h"

namespace meshfolio {

/// A mesh as it is asked for, before anyone knows which file that is.
struct MeshLookup {
    enum class By { role, file, original, in_data, own };
    By by = By::role;
    std::string name = {};             // of the role or the original
    std::filesystem::path path = {};   // as in the settings
    std::string stand_in = {};         // bundled, for an original
    auto operator<=>(const MeshLookup&) const = default;
};

/// Where it comes from, before it is read.
struct FoundMesh {
    std::optional<std::filesystem::path> path;   // of a file; none: `bundled_file`
    std::string_view bundled_file;
    std::string label;   // as messages call it
    std::string name;    // short_name(), or that with a number
    report::Input input;

    /// Reads the file if there is one, else the bundled mesh; `from_file` keeps what was read. @throws InputError naming the label
    std::string_view bytes(std::string& from_file) const;
};

class MeshFinder {
public:
    /// @param listed  see MeshLibrary
    MeshFinder(std::vector<std::filesystem::path> data_folders, std::vector<std::filesystem::path> own_meshes,
               const std::vector<std::filesystem::path>& listed);

    const std::vector<std::filesystem::path>& own() const { return own_; }
    /// None where no data folder has it. @throws InputError where it is nowhere; UsageError for an unknown role
    std::optional<FoundMesh> found(const MeshLookup& lookup, const std::filesystem::path& base) const;
    bool still_has(const report::Input& input, const std::filesystem::path& base) const;

private:
    std::vector<std::filesystem::path> folders_, own_;
    std::map<std::string, std::string> names_;   // path as given → name

    std::string name_of(const std::filesystem::path& path) const;
    FoundMesh found_role(const MeshRole& role) const;
    FoundMesh found_file(const std::filesystem::path& path, const std::filesystem::path& base) const;
    FoundMesh found_original(const MeshLookup& lookup, const std::filesystem::path& base) const;
    std::optional<FoundMesh> found_in_data(const std::filesystem::path& file) const;
    FoundMesh found_own(const std::filesystem::path& path) const;
};

/// The same message about a file that goes by another name.
InputError renamed(const Error& error, const std::string& before, const std::string& after);

/// The stem of a file name made safe for ids: [a-z0-9_], at most 40 characters, never empty.
std::string short_name(const std::filesystem::path& path);

}   // namespace meshfolio
