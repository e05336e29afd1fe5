/// @file
/// What the numbers of the operator laboratory say.
#pragma once

#include <vector>

#include "questions/operators/study.h"
#include "report/document.h"

namespace meshfolio::operators {

/// Appends the heading, the paragraphs and a finding.
void add_discussion(report::Section& section, const std::vector<LaboratoryMesh>& labs, const std::vector<KnownTrial>& known);

}   // namespace meshfolio::operators
