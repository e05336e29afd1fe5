#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "report/document.h"

namespace meshfolio::run {

/// What made this report: version, commit, compiler, libraries; settings and seed as given.
report::Provenance provenance_of(std::map<std::string, std::string> settings, std::uint64_t seed);

/// What two reports of the same inputs may still not have in common, which sections they have aside: "seed 2, and not 1". Empty: nothing.
std::string difference(const report::Provenance& one, const report::Provenance& other);

}   // namespace meshfolio::run
