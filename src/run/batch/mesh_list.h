/// @file
/// The meshes of `batch`, from files, folders, patterns and lists: each once, in an order that does not depend on the file system.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace meshfolio::run {

struct BatchMesh {
    std::string file;   // as it can be opened
    std::string name;   // of its folder
};

/// Returns all meshes that the arguments name. Outputs of this program are left out.
/// @param named  files, folders, patterns such as "*.obj", and "@list.txt"
/// @param lists  files with one such name a line, relative to their own folder; empty lines and lines that begin with # do not count
/// @param out    folder of the batch
/// @throws InputError for a missing file, with the line of a list; UsageError for a mesh inside `out`, or if there is no mesh
std::vector<BatchMesh> batch_meshes(const std::vector<std::string>& named, const std::vector<std::string>& lists,
                                    const std::filesystem::path& out);

/// Returns a safe folder name for each file, by the name of the mesh: "bunny", and "bunny-2" for a second one. No two names differ by case
/// alone.
std::vector<std::string> folder_names(const std::vector<std::string>& files);

}   // namespace meshfolio::run
