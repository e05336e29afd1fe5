/// @file
/// The parts of question 1.
#pragma once

#include <vector>

#include "questions/bench/ground_truth.h"
#include "questions/bench/uniform_curvature_study.h"
#include "report/document.h"

namespace meshfolio::q1_uniform {

/// What the numbers say, in words that follow them. Appends its heading and its paragraphs.
void add_discussion(report::Section& section, const std::vector<MeshCurvature>& meshes, const std::vector<UniformRefinement>& refinements,
                    const std::vector<AngleSum>& sums, const std::vector<FlatMesh>& flat, const GroundTruth& truth);

}   // namespace meshfolio::q1_uniform
