/// @file
/// The parts of the operator laboratory.
#pragma once

#include "questions/operators/study.h"

namespace meshfolio::operators {

inline constexpr report::Words words("operators");

using Labs = std::vector<LaboratoryMesh>;
using KnownTrials = std::vector<KnownTrial>;

/// What the numbers say, in words that follow them, and the answer.
void add_discussion(report::Section& section, const Labs& labs, const KnownTrials& known);

/// “cotangent”
inline std::string quoted(const std::string& title) { return "“" + title + "”"; }

}   // namespace meshfolio::operators
