/// @file
/// Finds the file of a mesh: among the user's own, in the data folders, among the bundled ones.
#pragma once

#include <compare>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/errors.h"
#include "report/document.h"

namespace meshfolio {

struct MeshRole;

/// A request for a mesh, before its file is known.
struct MeshLookup {
    enum class By { role, file, own };
    By by = By::role;
    std::string name = {};             // of the role
    std::filesystem::path path = {};   // as in the settings
    auto operator<=>(const MeshLookup&) const = default;
};

/// The file of a mesh, before it is read.
struct FoundMesh {
    std::optional<std::filesystem::path> path;   // of a file; none: `bundled_file`
    std::string_view bundled_file;
    std::string label;   // as messages call it
    std::string name;    // short_name(), or that with a number
    report::Input input;

    /// Returns the bytes of the file or of the bundled mesh. @param from_file  holds the bytes of a file. @throws InputError
    std::string_view bytes(std::string& from_file) const;
};

class MeshFinder {
public:
    /// @param listed  see MeshLibrary @throws InputError if one of `data_folders` is no folder
    MeshFinder(std::vector<std::filesystem::path> data_folders, std::vector<std::filesystem::path> own_meshes,
               const std::vector<std::filesystem::path>& listed);

    const std::vector<std::filesystem::path>& own() const { return own_; }
    /// Returns the file of a mesh. @param base  folder of relative paths for By::file
    /// @throws InputError if a By::file is nowhere; UsageError for an unknown role
    FoundMesh found(const MeshLookup& lookup, const std::filesystem::path& base) const;

private:
    std::vector<std::filesystem::path> folders_, own_;
    std::map<std::string, std::string> names_;   // path as given → name

    std::string name_of(const std::filesystem::path& path) const;
    FoundMesh found_role(const MeshRole& role) const;
    FoundMesh found_file(const std::filesystem::path& path, const std::filesystem::path& base) const;
    FoundMesh found_own(const std::filesystem::path& path) const;
};

/// Returns an InputError with the message, in which `after` replaces `before` if the message begins with it.
InputError renamed(const Error& error, const std::string& before, const std::string& after);

/// Returns the stem of a file name, made safe for ids: lower case, one _ for each run of characters outside a–z and 0–9, at most 40
/// characters; "mesh" if nothing is left.
std::string short_name(const std::filesystem::path& path);

}   // namespace meshfolio
