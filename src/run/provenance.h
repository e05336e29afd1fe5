#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "report/document.h"

namespace meshfolio::run {

/// What made this report: version, commit, compiler, libraries; settings and seed as given.
report::Provenance provenance_of(std::map<std::string, std::string> settings, std::uint64_t seed);

}   // namespace meshfolio::run
