/// @file
/// The provenance of a report: program, source, settings.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "report/document.h"

namespace meshfolio::submission {
class SourceListing;
}

namespace meshfolio::run {

/// Returns the listing src.txt of this program. Its index names, for each section of the report, the lines of the code that it cites.
const submission::SourceListing& own_source();

/// Returns a digest of everything that results depend on besides inputs and settings: the executable, the shared libraries in use (names,
/// sizes, dates), the processor and its features, and the variables that choose numerical kernels. Empty if it cannot be determined.
const std::string& program_identity();

/// Returns version, commit, compiler and libraries of this program, with the given settings and seed.
report::Provenance provenance_of(std::map<std::string, std::string> settings, std::uint64_t seed);

/// Returns the first difference between two provenances, in settings, libraries, program or seed but not in the choice of sections: "seed
/// 2, and not 1". Empty: none.
std::string difference(const report::Provenance& one, const report::Provenance& other);

}   // namespace meshfolio::run
