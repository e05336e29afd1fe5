/// @file
/// The parts of the section "reproductions".
#pragma once

#include "questions/core/section_tools.h"

namespace meshfolio::reproductions {

inline constexpr report::Words words("reproductions");

/// Does the experiments of the settings again: adds the table of the requirements that they cover, their blocks, the checks, the answer and
/// the parameters.
void add_reproductions(Answer& answer, const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress);

}   // namespace meshfolio::reproductions
