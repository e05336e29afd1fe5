/// @file
/// The parts of question 3.
#pragma once

#include <vector>

#include "questions/bench/cotangent_study.h"
#include "questions/bench/ground_truth.h"
#include "report/document.h"

namespace meshfolio::q3_cotangent {

inline constexpr std::size_t barycentric = 0, voronoi = 1, mixed = 2;   // in area_forms

/// What the numbers say, in words that follow them. Appends its heading and its paragraphs.
void add_discussion(report::Section& section, const std::vector<CotangentComparison>& meshes,
                    const std::vector<CotangentRefinement>& refinements, const PlaneTest& plane, const GroundTruth& truth);

}   // namespace meshfolio::q3_cotangent
