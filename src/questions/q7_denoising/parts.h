/// @file
/// The parts of question 7.
#pragma once

#include <vector>

#include "questions/bench/denoising_study.h"
#include "report/document.h"

namespace meshfolio::q7_denoising {

/// What the numbers say, in words that follow them. Appends its heading and its paragraphs.
void add_discussion(report::Section& section, const std::vector<DenoisingStudy>& studies);

}   // namespace meshfolio::q7_denoising
