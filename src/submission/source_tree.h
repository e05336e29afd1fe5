/// @file
/// The project's own files as they were when this program was built: what src.txt lists and what the source archive holds.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace meshfolio::submission {

struct SourceFile {
    std::string path;         // "src/main.cpp"
    std::string_view bytes;   // compiled in
};

/// All of them, sorted by path: what git holds, meshes and pictures too.
std::vector<SourceFile> source_tree();

/// The words of `build_packages` in tests/setup.sh: the Debian packages that building takes.
/// @throws std::logic_error if `setup_script` has no such list
std::vector<std::string> build_packages(std::string_view setup_script);

}   // namespace meshfolio::submission
