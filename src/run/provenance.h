/// @file
/// The program as what made a report.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "report/document.h"

namespace meshfolio::submission {
class SourceListing;
}

namespace meshfolio::run {

/// src.txt of this program, with the index of all sections of the report.
const submission::SourceListing& own_source();

/// What results depend on besides inputs and settings: a digest of the running executable, of the names, sizes and dates of the shared
/// libraries in use, of the processor's kind and abilities, and of the variables that choose among numerical kernels. Empty where it cannot
/// be determined. Computed once.
const std::string& program_identity();

/// What made this report: version, commit, compiler, libraries; settings and seed as given.
report::Provenance provenance_of(std::map<std::string, std::string> settings, std::uint64_t seed);

/// What two reports of the same inputs may still not have in common, which sections they have aside: "seed 2, and not 1". Empty: nothing.
std::string difference(const report::Provenance& one, const report::Provenance& other);

}   // namespace meshfolio::run
