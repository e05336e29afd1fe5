#pragma once

#include <map>
#include <string>

namespace meshfolio {

/// The solver libraries in this build and their versions.
std::map<std::string, std::string> solver_versions();

}   // namespace meshfolio
