#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace meshfolio::cli {

/// The program of that name in the folders of PATH, when it is there and may be run.
std::optional<std::filesystem::path> found_on_path(const std::string& program);

}   // namespace meshfolio::cli
