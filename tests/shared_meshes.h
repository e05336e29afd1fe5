/// @file
/// The real meshes beside the project. Tests that want them are skipped where they are not.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "source_dir.h"

namespace meshfolio::testing_tools {

inline std::filesystem::path shared_mesh_folder() {
    return std::filesystem::path(MESHFOLIO_SOURCE_DIR).parent_path() / "shared" / "meshes";
}

/// All OBJ and OFF files, sorted; none if there is no such folder.
inline std::vector<std::filesystem::path> shared_meshes() {
    std::vector<std::filesystem::path> files;
    if (!std::filesystem::exists(shared_mesh_folder())) return files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_mesh_folder())) {
        const std::string ending = entry.path().extension().string();
        if (ending == ".obj" || ending == ".off") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}   // namespace meshfolio::testing_tools
