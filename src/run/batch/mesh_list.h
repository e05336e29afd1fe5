/// @file
/// The meshes of `batch` from files, folders, patterns and lists: each once, in an order independent of the file system.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace meshfolio::run {

struct BatchMesh {
    std::string file;   // as it can be opened
    std::string name;   // of its folder
};

/// @param named  files; folders, which stand for all meshes in them that belong to no output of ours; patterns such as "*.obj", likewise;
///               "@list.txt"
/// @param lists  files with one of these a line, relative to their own folder; empty lines and those that begin with # aside
/// @param out    must contain no mesh
/// @throws InputError for what is not there, naming the line of a list; UsageError for a mesh inside `out` or for none at all
std::vector<BatchMesh> batch_meshes(const std::vector<std::string>& named, const std::vector<std::string>& lists,
                                    const std::filesystem::path& out);

/// A safe name of its own for each file: "bunny", and "bunny-2" for the second of that name, whatever the case of its letters.
std::vector<std::string> folder_names(const std::vector<std::string>& files);

}   // namespace meshfolio::run
