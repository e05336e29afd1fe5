/// @file
/// The parts of the operator laboratory.
#pragma once

#include "questions/operators/study.h"

namespace meshfolio::operators {

inline constexpr report::Words words("operators");

using Labs = std::vector<LaboratoryMesh>;
using KnownTrials = std::vector<KnownTrial>;

/// Adds what the numbers say, and the answer. @param shown  the mesh of the figure
void add_discussion(report::Section& section, const Labs& labs, const KnownTrials& known, const LaboratoryMesh& shown);

/// “cotangent”
inline std::string quoted(const std::string& title) { return "“" + title + "”"; }

}   // namespace meshfolio::operators
