/// @file
/// The parts of question 5.
#pragma once

#include <vector>

#include "questions/q5_explicit/study.h"
#include "report/document.h"

namespace meshfolio::q5_explicit {

/// What the numbers say, in words that follow them. Appends its heading and its paragraphs.
void add_discussion(report::Section& section, const std::vector<ExplicitStudy>& studies);

}   // namespace meshfolio::q5_explicit
