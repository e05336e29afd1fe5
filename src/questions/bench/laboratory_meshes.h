/// @file
/// Which meshes the sections take that look at smoothing itself.
#pragma once

#include <memory>
#include <vector>

#include "questions/core/chapter.h"

namespace meshfolio {

/// As meshes_for(): cube, noisy plane, noisy fandisk and armadillo in the laboratory, of them what fits its budget in a report.
/// @throws InputError if one is missing or unusable
std::vector<std::shared_ptr<const LibraryMesh>> laboratory_meshes(const MeshLibrary& library, const QuestionSettings& settings,
                                                                  report::Section& section);

}   // namespace meshfolio
